//! Drops that stay where they came to rest: on gloves and bare hands, which they go along with, on bench and floor; and splashes on the
//! goggles.
//!
//! They are made of what observations list, some steps after it happened, and nothing that is simulated depends on them.

use std::f64::consts::PI;

use glam::{Mat3, Vec3};
use vitriol_render::{Bone, MOST_RESTING, RestingDrop};
use vitriol_sim::bodies::Worn;
use vitriol_sim::scene::ToolKind;
use vitriol_sim::solver::{Census, HARMFUL, Landed, Onto, Skin};
use vitriol_sim::world::World;

use crate::hands::ACROSS;

/// Most liquid that stays in one place, m³: a drop of water from a normal dropper (European Pharmacopoeia, 2.1.1). More runs off.
const HOLDS: f64 = 0.05e-6;
/// The smallest drop that is kept, m³: half a ball of 0.04 mm, a tenth of a pixel at arm's length. Chosen.
const LEAST: f64 = 1e-13;
/// How much water takes a drop off a hand, over its own volume. Chosen: it leaves a tenth of the concentration.
const RINSES: f64 = 10.0;
/// Places on the way of a drop at which it is looked for in a hand: at 3 m/s 2 mm apart. Chosen.
const LOOKS: u32 = 16;

/// Liquid times its acid fraction that covers the goggles, m³: a drop of 0.05 mL leaves a stain a centimetre wide, and goggles have some
/// twenty of those. Chosen.
const COVERED: f64 = 1e-6;
/// The share of the goggles that any acid covers: one of the six splashes that are drawn.
const LEAST_COVERED: f64 = 1.0 / 6.0;

/// Where a drop lies.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Lies {
    /// On a hand.
    Hand {
        /// 0 for the left one, 1 for the right one.
        hand: usize,
        /// The bone.
        bone: usize,
        /// The share of the way from its first end to the other.
        share: f32,
        /// To where from the bone's axis, of length 1, in its [`frame`].
        out: Vec3,
    },
    /// On bench or floor, in the scene's stage, real metres.
    At(Vec3),
}

/// A drop that stays.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mark {
    lies: Lies,
    /// m³ at real size.
    volume: f64,
    /// Acid mass fraction.
    acid: f32,
}

impl Mark {
    /// Its middle on the surface that it lies on; `None` on a hand that is not there.
    fn place(&self, hands: [&[Bone]; 2]) -> Option<Vec3> {
        let (hand, index, share, out) = match self.lies {
            Lies::At(place) => return Some(place),
            Lies::Hand {
                hand,
                bone,
                share,
                out,
            } => (hand, bone, share, out),
        };
        let bones = *hands.get(hand)?;
        let bone = bones.get(index)?;
        let [a, b] = bone.ends;
        let [at_a, at_b] = bone.radii;
        let radius = at_a + share * (at_b - at_a);
        Some(a.lerp(b, share) + radius * (frame(bones, index)? * out))
    }

    fn is_on(&self, skin: usize) -> bool {
        matches!(self.lies, Lies::Hand { hand, .. } if hand == skin)
    }
}

/// The drops of a scene since its start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// At most [`MOST_RESTING`], the largest ones.
    marks: Vec<Mark>,
    /// Liquid times its acid fraction that came to the face, m³ at real size; `None` before any did.
    face: Option<f64>,
    /// What the user wears.
    worn: Worn,
}

impl Marks {
    /// Takes in an observation that was made with these bones of the hands, real metres; `length_scale` is the scene's.
    pub fn take(&mut self, census: &Census, hands: [&[Bone]; 2], length_scale: f64) {
        let real = length_scale.powi(3);
        for (skin, touching) in Skin::ALL.into_iter().zip(&census.skin) {
            self.rinse(skin as usize, real * touching.rinsed);
        }
        let face = &census.skin[Skin::Face as usize].came;
        // Hot water leaves no splash.
        if face.particles > 0 && face.acid >= HARMFUL {
            *self.face.get_or_insert(0.0) += real * face.volume * face.acid;
        }
        for landed in &census.landed {
            let volume = real * landed.volume;
            let Some(lies) = lies(landed, hands, length_scale as f32) else {
                continue;
            };
            if volume >= LEAST {
                let acid = landed.acid;
                self.add(Mark { lies, volume, acid }, hands);
            }
        }
        if self.marks.len() > MOST_RESTING {
            // Stable: of equal ones the older stay.
            self.marks.sort_by(|a, b| b.volume.total_cmp(&a.volume));
            self.marks.truncate(MOST_RESTING);
        }
    }

    /// A drop that falls on another one becomes one with it.
    fn add(&mut self, new: Mark, hands: [&[Bone]; 2]) {
        let at = new.place(hands);
        let covers = |mark: &Mark| match (mark.place(hands), at) {
            (Some(place), Some(at)) => f64::from(place.distance(at)) < cap_radius(mark.volume),
            _ => false,
        };
        match self.marks.iter_mut().find(|mark| covers(mark)) {
            Some(under) => {
                let volume = under.volume + new.volume;
                under.acid += (new.volume / volume) as f32 * (new.acid - under.acid);
                under.volume = volume.min(HOLDS);
            }
            None => self.marks.push(Mark {
                volume: new.volume.min(HOLDS),
                ..new
            }),
        }
    }

    /// Water (m³) that came to that skin takes drops off it, the oldest first.
    fn rinse(&mut self, skin: usize, water: f64) {
        let mut left = water / RINSES;
        for mark in self.marks.iter_mut().filter(|mark| mark.is_on(skin)) {
            let off = mark.volume.min(left);
            mark.volume -= off;
            left -= off;
        }
        self.marks.retain(|mark| mark.volume >= LEAST);
    }

    /// What the user wears now: a hand without its glove, or with another one, has no drops on it.
    pub fn wears(&mut self, worn: Worn) {
        let before = std::mem::replace(&mut self.worn, worn);
        let (Some(before), Some(now)) = (before.gloves, worn.gloves) else {
            return;
        };
        for (hand, (before, now)) in before.into_iter().zip(now).enumerate() {
            if before != now {
                self.marks.retain(|mark| !mark.is_on(hand));
            }
        }
    }

    /// How much of the goggles is covered, 0 to 1: a splash of six at once; nothing is seen through while they are off.
    pub fn goggles(&self) -> f32 {
        let worn = self.worn.goggles != Some(false);
        let face = self.face.filter(|_| worn);
        face.map_or(0.0, |acid| {
            (acid / COVERED).clamp(LEAST_COVERED, 1.0) as f32
        })
    }

    /// The cloths of `world` take off what they lie on.
    pub fn wiped(&mut self, world: &World) {
        let scale = world.scene().scale.length_scale as f32;
        for (tool, pose) in world.scene().tools.iter().zip(world.tools()) {
            if tool.kind == ToolKind::Cloth {
                let [radius, height] = tool.kind.cylinder().map(|m| m as f32);
                let foot = scale * pose.position;
                self.wipe([foot, foot + height * (pose.orientation * Vec3::Y)], radius);
            }
        }
    }

    /// Takes off what lies on bench and floor as near to the line between two places as `radius`, real metres.
    fn wipe(&mut self, ends: [Vec3; 2], radius: f32) {
        self.marks.retain(|mark| match mark.lies {
            Lies::At(place) => place.distance(nearest_to(ends, place).1) > radius,
            Lies::Hand { .. } => true,
        });
    }

    /// The drops as they are drawn with these bones of the hands, real metres.
    pub fn drawn(&self, hands: [&[Bone]; 2]) -> Vec<RestingDrop> {
        let drawn = self.marks.iter().filter_map(|mark| {
            Some(RestingDrop {
                position: mark.place(hands)?,
                radius: cap_radius(mark.volume) as f32,
                acid: mark.acid,
            })
        });
        drawn.collect()
    }
}

/// Radius of half a ball of that volume: V = 2/3 π r³.
fn cap_radius(volume: f64) -> f64 {
    (1.5 * volume / PI).cbrt()
}

/// The share of the way between two places, and the place there, that is nearest to `at`.
fn nearest_to([a, b]: [Vec3; 2], at: Vec3) -> (f32, Vec3) {
    let along = b - a;
    let share = (at - a).dot(along) / along.length_squared().max(1e-12);
    let share = share.clamp(0.0, 1.0);
    (share, a + share * along)
}

/// How far a place is from a bone's surface, m; negative inside.
fn apart(bone: &Bone, at: Vec3) -> f32 {
    let (share, axis) = nearest_to(bone.ends, at);
    let [a, b] = bone.radii;
    at.distance(axis) - (a + share * (b - a))
}

/// Where a drop lies that came to rest; `None` in the face, where [`Marks::goggles`] shows it.
fn lies(landed: &Landed, hands: [&[Bone]; 2], scale: f32) -> Option<Lies> {
    let to = scale * landed.position;
    let hand = match landed.onto {
        Onto::Table | Onto::Floor => return Some(Lies::At(to)),
        Onto::Skin(Skin::Face) => return None,
        Onto::Skin(skin) => skin as usize,
    };
    let bones = *hands.get(hand)?;
    let (bone, at) = met(bones, to - scale * landed.way, to)?;
    let (share, axis) = nearest_to(bones.get(bone)?.ends, at);
    let out = frame(bones, bone)?.transpose() * (at - axis).normalize_or(Vec3::Y);
    Some(Lies::Hand {
        hand,
        bone,
        share,
        out,
    })
}

/// The bone that is met first on a way, and the place there; the one that is passed most closely where none is met.
fn met(bones: &[Bone], from: Vec3, to: Vec3) -> Option<(usize, Vec3)> {
    let mut best: Option<(f32, usize, Vec3)> = None;
    for look in 0..=LOOKS {
        let at = from.lerp(to, look as f32 / LOOKS as f32);
        let all = bones.iter().map(|bone| apart(bone, at)).enumerate();
        let (bone, free) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        if best.is_none_or(|(least, ..)| free < least) {
            best = Some((free, bone, at));
        }
        if free <= 0.0 {
            break;
        }
    }
    best.map(|(_, bone, at)| (bone, at))
}

/// Axes of a bone that turn with it: the last is along it, and the first as far as can be across the hand, about which fingers bend.
fn frame(bones: &[Bone], bone: usize) -> Option<Mat3> {
    let along = |bone: &Bone| bone.ends[1] - bone.ends[0];
    let axis = along(bones.get(bone)?).normalize_or(Vec3::Y);
    // The knuckles' own bone is across the hand: for it the thumb is in their place.
    let references = [ACROSS, 0].into_iter().filter_map(|n| bones.get(n));
    let aside = references
        .map(along)
        .map(|whole| (whole, whole.reject_from_normalized(axis)))
        .find(|(whole, part)| part.length() > 0.2 * whole.length())
        .map_or_else(
            || axis.any_orthonormal_vector(),
            |(_, part)| part.normalize(),
        );
    Some(Mat3::from_cols(aside, axis.cross(aside), axis))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use glam::Quat;
    use vitriol_render::Finish;
    use vitriol_sim::solver::Came;

    fn bone(ends: [Vec3; 2]) -> Bone {
        Bone {
            ends,
            radii: [0.008; 2],
            finish: Finish::Glove,
            stain: 0.0,
        }
    }

    fn drop(onto: Onto, position: Vec3, volume: f64) -> Landed {
        Landed {
            onto,
            position,
            way: Vec3::new(0.0, -0.03, 0.0),
            volume,
            acid: 0.0,
        }
    }

    fn census(landed: Vec<Landed>) -> Census {
        Census {
            landed,
            ..Census::default()
        }
    }

    /// A ball of radius r has 4/3 π r³, so half a ball of 1 mm has 2.0944 µL.
    #[test]
    fn half_a_ball_has_the_drops_volume() {
        assert!((cap_radius(2.094_395e-9) - 1e-3).abs() < 1e-9);
        assert!((cap_radius(8.0 * 2.094_395e-9) - 2e-3).abs() < 1e-9);
    }

    /// A drop falls through a finger, in a scene twice as large as real: it lies on top, and goes along when the hand is turned and moved.
    #[test]
    fn a_drop_on_a_hand_goes_along_with_it() {
        let hand = [
            bone([Vec3::new(0.0, 1.0, 0.05), Vec3::new(0.04, 1.0, 0.05)]),
            bone([Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 1.0, 0.03)]),
        ];
        let under = 2.0 * Vec3::new(0.0, 0.991, 0.01);
        let landed = Landed {
            way: 2.0 * Vec3::new(0.0, -0.03, 0.0),
            ..drop(Onto::Skin(Skin::Right), under, 8.0 * 1e-9)
        };
        let mut marks = Marks::default();
        marks.take(&census(vec![landed]), [&[], &hand], 0.5);
        let [lies] = marks.drawn([&[], &hand])[..] else {
            unreachable!("one drop")
        };
        assert!(lies.position.distance(Vec3::new(0.0, 1.008, 0.01)) < 1e-4);
        assert!((f64::from(lies.radius) - cap_radius(1e-9)).abs() < 1e-7);
        let turn = Quat::from_rotation_z(1.0) * Quat::from_rotation_x(0.4);
        let moved = |at: Vec3| turn * at + Vec3::new(0.3, -0.2, 0.1);
        let later = hand.map(|it| bone(it.ends.map(moved)));
        let there = marks.drawn([&[], &later])[0].position;
        assert!(there.distance(moved(lies.position)) < 1e-5, "{there}");
        // A hand that is not seen has none that is seen, and another glove is clean.
        assert_eq!(marks.drawn([&hand, &[]]), []);
        let worn = |right| Worn {
            goggles: None,
            gloves: Some([true, right]),
        };
        marks.wears(worn(true));
        assert_eq!(marks.drawn([&[], &hand]).len(), 1);
        marks.wears(worn(false));
        assert_eq!(marks.drawn([&[], &hand]), []);
    }

    /// 0.3 mL of 50 % to the face, in a scene twice as large as real, are 0.15 mL of acid: less than one splash of six has. Ten times as much
    /// covers all. Water leaves none, and nothing is seen through goggles that are off.
    #[test]
    fn acid_in_the_face_covers_the_goggles() {
        let mut marks = Marks::default();
        let splash = |marks: &mut Marks, acid: f64, volume: f64| {
            let mut census = Census::default();
            census.skin[Skin::Face as usize].came = Came {
                particles: 1,
                volume: 8.0 * volume,
                acid,
                ..Came::default()
            };
            marks.take(&census, [&[], &[]], 0.5);
            marks.goggles()
        };
        assert_eq!(splash(&mut marks, 0.0, 1e-6), 0.0);
        assert_eq!(splash(&mut marks, 0.5, 0.3e-6), 1.0 / 6.0);
        let half = splash(&mut marks, 0.5, 0.7e-6);
        assert!((half - 0.5).abs() < 1e-6, "{half}");
        assert_eq!(splash(&mut marks, 0.5, 3e-6), 1.0);
        for (on, seen) in [(Some(false), 0.0), (Some(true), 1.0), (None, 1.0)] {
            marks.wears(Worn {
                goggles: on,
                gloves: None,
            });
            assert_eq!(marks.goggles(), seen, "{on:?}");
        }
    }

    /// More drops than are drawn: the largest stay, and a cloth takes off those that it lies on.
    #[test]
    fn the_largest_stay_until_they_are_wiped() {
        let at = |n: usize| Vec3::new(0.01 * n as f32, 0.75, 0.0);
        let number = MOST_RESTING + 20;
        let all = (0..number).map(|n| drop(Onto::Table, at(n), 1e-12 * (n + 1) as f64));
        let mut marks = Marks::default();
        marks.take(&census(all.collect()), [&[], &[]], 1.0);
        let drawn = marks.drawn([&[], &[]]);
        assert_eq!(drawn.len(), MOST_RESTING);
        assert!(drawn.iter().all(|it| it.position.x > at(19).x));
        marks.wipe([at(number - 1), at(number - 1) + 0.02 * Vec3::Y], 0.035);
        // Of those 1 cm apart the last four.
        assert_eq!(marks.drawn([&[], &[]]).len(), MOST_RESTING - 4);
    }

    /// Two parts of water and one of acid of 90 % by volume: 30 %.
    #[test]
    fn a_drop_has_the_acid_of_what_fell_there() {
        let at = Vec3::new(0.0, 0.75, 0.0);
        let acid = Landed {
            acid: 0.9,
            ..drop(Onto::Table, at, 5e-9)
        };
        let mut marks = Marks::default();
        marks.take(&census(vec![drop(Onto::Table, at, 1e-8)]), [&[], &[]], 1.0);
        marks.take(&census(vec![acid]), [&[], &[]], 1.0);
        let [lies] = marks.drawn([&[], &[]])[..] else {
            unreachable!("one drop")
        };
        assert!((lies.acid - 0.3).abs() < 1e-6, "{lies:?}");
    }

    /// What falls on a drop joins it, up to a drop's 0.05 mL; ten times as much water takes it off a hand.
    #[test]
    fn drops_join_and_are_rinsed_off() {
        let hand = [bone([Vec3::ZERO, Vec3::new(0.0, 0.0, 0.03)])];
        let landed = drop(Onto::Skin(Skin::Left), Vec3::new(0.0, -0.01, 0.01), 15e-9);
        let mut marks = Marks::default();
        for count in 1..=5 {
            marks.take(&census(vec![landed]), [&hand, &[]], 1.0);
            let drawn = marks.drawn([&hand, &[]]);
            assert_eq!(drawn.len(), 1);
            let volume = (15e-9 * f64::from(count)).min(0.05e-6);
            assert!((f64::from(drawn[0].radius) - cap_radius(volume)).abs() < 1e-7);
        }
        let mut water = Census::default();
        water.skin[0].rinsed = 0.3e-6;
        marks.take(&water, [&hand, &[]], 1.0);
        assert_eq!(marks.drawn([&hand, &[]]).len(), 1);
        marks.take(&water, [&hand, &[]], 1.0);
        assert_eq!(marks.drawn([&hand, &[]]), []);
    }
}
