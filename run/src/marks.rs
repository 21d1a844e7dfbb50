//! Drops that stay where they came to rest: on gloves, bare hands and the outside of flasks, which they go along with, on bench and floor;
//! and splashes on the goggles.
//!
//! They are made of what observations list, some steps after it happened, and nothing that is simulated depends on them.

#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use glam::{Mat3, Vec3};
use vitriol_render::{Bone, MOST_RESTING, RestingDrop};
use vitriol_sim::bodies::Worn;
use vitriol_sim::pose::Pose;
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

/// Most drops on glass, of [`MOST_RESTING`]. They have these places to themselves and no others, so that they take none from skin. Chosen.
const ON_GLASS: usize = 32;

/// Liquid times its acid fraction that covers the goggles, m³: a drop of 0.05 mL leaves a stain a centimetre wide, and goggles have some
/// twenty of those. Chosen.
const COVERED: f64 = 1e-6;
/// The share of the goggles that any acid covers: one of the six splashes that are drawn.
const LEAST_COVERED: f64 = 1.0 / 6.0;

/// What drops go along with.
#[derive(Clone, Copy, Debug)]
pub struct Carriers<'a> {
    /// Bones of the left and of the right hand, real metres.
    pub hands: [&'a [Bone]; 2],
    /// stage_from_flask of each flask, m of the scene.
    pub flasks: &'a [Pose],
    /// Real metres that a metre of the scene is.
    pub length_scale: f64,
}

impl<'a> Carriers<'a> {
    /// The flasks of `world` as they are now, and these bones of the hands, real metres.
    pub fn of(world: &'a World, hands: &'a [Vec<Bone>; 2]) -> Self {
        Self {
            hands: hands.each_ref().map(Vec::as_slice),
            flasks: world.poses(),
            length_scale: world.scene().scale.length_scale,
        }
    }
}

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
    /// On the outside of a flask.
    Flask {
        /// Its number.
        flask: usize,
        /// Where, in its frame, real metres.
        at: Vec3,
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
    fn place(&self, on: Carriers<'_>) -> Option<Vec3> {
        let (hand, index, share, out) = match self.lies {
            Lies::At(place) => return Some(place),
            Lies::Flask { flask, at } => {
                let pose = on.flasks.get(flask)?;
                return Some(on.length_scale as f32 * pose.position + pose.transform_vector(at));
            }
            Lies::Hand {
                hand,
                bone,
                share,
                out,
            } => (hand, bone, share, out),
        };
        let bones = *on.hands.get(hand)?;
        let bone = bones.get(index)?;
        let [a, b] = bone.ends;
        let [at_a, at_b] = bone.radii;
        let radius = at_a + share * (at_b - at_a);
        Some(a.lerp(b, share) + radius * (frame(bones, index)? * out))
    }

    fn is_on(&self, skin: usize) -> bool {
        matches!(self.lies, Lies::Hand { hand, .. } if hand == skin)
    }

    fn is_on_glass(&self) -> bool {
        matches!(self.lies, Lies::Flask { .. })
    }
}

/// The drops of a scene since its start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// At most [`MOST_RESTING`], the largest ones, of which at most [`ON_GLASS`] are on flasks and those behind the others.
    marks: Vec<Mark>,
    /// Liquid times its acid fraction that came to the face, m³ at real size; `None` before any did.
    face: Option<f64>,
    /// What the user wears.
    worn: Worn,
}

impl Marks {
    /// Takes in an observation that was made with these hands and flasks.
    pub fn take(&mut self, census: &Census, on: Carriers<'_>) {
        let real = on.length_scale.powi(3);
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
            let Some(lies) = lies(landed, on) else {
                continue;
            };
            if volume >= LEAST {
                let acid = landed.acid;
                self.add(Mark { lies, volume, acid }, on);
            }
        }
        let (mut glass, mut others): (Vec<_>, Vec<_>) =
            self.marks.drain(..).partition(Mark::is_on_glass);
        keep_largest(&mut others, MOST_RESTING - ON_GLASS);
        keep_largest(&mut glass, ON_GLASS);
        self.marks.append(&mut others);
        self.marks.append(&mut glass);
    }

    /// A drop that falls on another one becomes one with it.
    fn add(&mut self, new: Mark, on: Carriers<'_>) {
        let at = new.place(on);
        let covers = |mark: &Mark| match (mark.place(on), at) {
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

    /// The cloths of `world` take off what they lie on, and what was on a flask that broke is gone.
    pub fn wiped(&mut self, world: &World) {
        self.broke(|flask| world.is_broken(flask));
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
            Lies::Hand { .. } | Lies::Flask { .. } => true,
        });
    }

    fn broke(&mut self, is_broken: impl Fn(usize) -> bool) {
        self.marks
            .retain(|mark| !matches!(mark.lies, Lies::Flask { flask, .. } if is_broken(flask)));
    }

    /// The drops as they are drawn with these hands and flasks.
    pub fn drawn(&self, on: Carriers<'_>) -> Vec<RestingDrop> {
        let drawn = self.marks.iter().filter_map(|mark| {
            Some(RestingDrop {
                position: mark.place(on)?,
                radius: cap_radius(mark.volume) as f32,
                acid: mark.acid,
            })
        });
        drawn.collect()
    }
}

/// Keeps so many marks at most.
fn keep_largest(marks: &mut Vec<Mark>, most: usize) {
    if marks.len() > most {
        // Stable: of equal ones the older stay.
        marks.sort_by(|a, b| b.volume.total_cmp(&a.volume));
        marks.truncate(most);
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
fn lies(landed: &Landed, on: Carriers<'_>) -> Option<Lies> {
    let scale = on.length_scale as f32;
    let to = scale * landed.position;
    let hand = match landed.onto {
        Onto::Table | Onto::Floor => return Some(Lies::At(to)),
        Onto::Flask(flask) => return Some(Lies::Flask { flask, at: to }),
        Onto::Skin(Skin::Face) => return None,
        Onto::Skin(skin) => skin as usize,
    };
    let bones = *on.hands.get(hand)?;
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
