//! Liquid where it should not be: how much lies beside the flasks, and where acid touched the user.

use glam::Vec3;
use serde::Serialize;
use vitriol_render::{Bone, MOST_BONES};
use vitriol_sim::bodies::Worn;
use vitriol_sim::solver::{Census, HARMFUL, Skin};
use vitriol_xr::Side;

/// Liquid times its acid fraction that blackens all of a bone of a glove, m³: 0.3 mL would cover a finger's front, 20 cm², 0.15 mm deep. Our choice.
const BLACK: f64 = 0.3e-6;

/// How long a touch by acid is felt, ns: longer than a pulse of liquid that stirs, so that it is told from that.
const FELT: i64 = 400_000_000;
/// Touches that come sooner after the last are of the same splash, ns.
const SAME: i64 = 1_000_000_000;

/// What lies beside the flasks, in real mL.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spilt {
    /// On the bench.
    pub bench: f64,
    /// On the floor.
    pub floor: f64,
}

/// Acid that touched a part of the user.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Touched {
    /// Splashes.
    pub times: u32,
    /// mL of liquid that hurts (5 % acid and more), of all of them.
    pub liquid_ml: f64,
}

/// Acid that touched the user since the session began, by part of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Contacts {
    /// The left hand.
    pub left_hand: Touched,
    /// The right hand.
    pub right_hand: Touched,
    /// The face.
    pub face: Touched,
}

impl Contacts {
    fn at(&mut self, skin: Skin) -> &mut Touched {
        match skin {
            Skin::Left => &mut self.left_hand,
            Skin::Right => &mut self.right_hand,
            Skin::Face => &mut self.face,
        }
    }
}

/// Counts liquid beside the flasks and acid that touched the user, and marks gloves with it.
#[derive(Debug, Default)]
pub(super) struct Spills {
    /// What lies beside the flasks now.
    pub spilt: Spilt,
    /// Touches of the session.
    pub contacts: Contacts,
    /// By hand and bone, how black the glove is, 0 to 1.
    stains: [[f32; MOST_BONES]; 2],
    /// By skin, whether it was touched on this bench, and when last, ns.
    touched: [Option<i64>; 3],
    /// What the user wears.
    worn: Worn,
}

impl Spills {
    /// Another bench, or this one anew: bench and gloves are clean. What happened stays counted.
    pub fn clean(&mut self) {
        *self = Self {
            contacts: self.contacts,
            worn: self.worn,
            ..Self::default()
        };
    }

    /// What the user wears now: a hand without its glove, or with another one, has no marks.
    pub fn wears(&mut self, worn: Worn) {
        let before = std::mem::replace(&mut self.worn, worn);
        if let (Some(before), Some(now)) = (before.gloves, worn.gloves) {
            for (stains, (before, now)) in self.stains.iter_mut().zip(before.into_iter().zip(now)) {
                if before != now {
                    *stains = [0.0; MOST_BONES];
                }
            }
        }
    }

    /// Takes in an observation, in the frame that is shown at `now` (ns). `length_scale` is the scene's, and `hands` are the bones that the
    /// observation was made with, real metres. Returns whose skin was touched by a new splash.
    pub fn take(
        &mut self,
        census: &Census,
        length_scale: f64,
        hands: [&[Bone]; 2],
        now: i64,
    ) -> Vec<Skin> {
        let real = length_scale.powi(3);
        self.spilt = Spilt {
            bench: 1e6 * real * census.table.volume,
            floor: 1e6 * real * census.floor.volume,
        };
        let mut new = Vec::new();
        for (skin, held) in Skin::ALL.into_iter().zip(&census.skin) {
            let came = &held.came;
            // Hot water leaves no mark.
            if came.particles == 0 || came.acid < HARMFUL {
                continue;
            }
            let liquid = real * came.volume;
            let acid = liquid * came.acid;
            let last = self.touched[skin as usize].replace(now);
            let touched = self.contacts.at(skin);
            touched.liquid_ml += 1e6 * liquid;
            if last.is_none_or(|last| !(0..=SAME).contains(&(now - last))) {
                touched.times += 1;
                new.push(skin);
            }
            if let Some(side) = side(skin) {
                let at = length_scale * came.position;
                let stains = &mut self.stains[side as usize];
                stain(stains, hands[side as usize], at.as_vec3(), acid);
            }
        }
        new
    }

    /// Blackens a hand's bones where acid touched them.
    pub fn mark(&self, side: Side, bones: &mut [Bone]) {
        for (bone, stain) in bones.iter_mut().zip(self.stains[side as usize]) {
            bone.stain = stain;
        }
    }

    /// How strongly that hand feels acid at `now` (ns), 0 to 1: on it, or in the face, which has no vibrator of its own.
    pub fn felt(&self, side: Side, now: i64) -> f32 {
        let own = match side {
            Side::Left => Skin::Left,
            Side::Right => Skin::Right,
        };
        let recent = |skin: Skin| {
            self.touched[skin as usize].is_some_and(|at| (0..FELT).contains(&(now - at)))
        };
        f32::from(u8::from(recent(own) || recent(Skin::Face)))
    }

    /// Whose skin has acid on it on this bench.
    pub fn touched(&self, skin: Skin) -> bool {
        self.touched[skin as usize].is_some()
    }
}

fn side(skin: Skin) -> Option<Side> {
    match skin {
        Skin::Left => Some(Side::Left),
        Skin::Right => Some(Side::Right),
        Skin::Face => None,
    }
}

/// Adds acid (m³, as [`BLACK`]) at a place to the bone that is nearest to it.
fn stain(stains: &mut [f32; MOST_BONES], bones: &[Bone], at: Vec3, acid: f64) {
    let apart = |bone: &Bone| {
        let [a, b] = bone.ends;
        let along = b - a;
        let share = (at - a).dot(along) / along.length_squared().max(1e-12);
        at.distance(a + share.clamp(0.0, 1.0) * along) - bone.radii[0].min(bone.radii[1])
    };
    let nearest = (bones.iter().zip(stains))
        .min_by(|(one, _), (other, _)| apart(one).total_cmp(&apart(other)));
    if let Some((_, stain)) = nearest {
        *stain = (*stain + (acid / BLACK) as f32).min(1.0);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use glam::DVec3;
    use vitriol_render::Finish;
    use vitriol_sim::solver::{Came, Touching};

    fn finger(x: f32) -> Bone {
        Bone::new(
            Finish::Glove,
            [Vec3::new(x, 1.0, 0.0), Vec3::new(x, 1.0, 0.03)],
            [0.008, 0.007],
        )
    }

    /// A scene twenty times as large as real, in which 0.06 real mL of 50 % come to the right hand, next to its second finger.
    #[test]
    fn acid_blackens_the_finger_that_it_comes_to() {
        let bones = [finger(0.0), finger(0.02), finger(0.04)];
        let splash = |volume: f64| {
            let mut census = Census::default();
            census.table.volume = 8000.0 * 12e-6;
            census.skin[1] = Touching {
                came: Came {
                    particles: 4,
                    volume: 8000.0 * volume,
                    acid: 0.5,
                    position: 20.0 * DVec3::new(0.021, 1.009, 0.01),
                    ..Came::default()
                },
                particles: 4,
                rinsed: 0.0,
            };
            census
        };
        let mut spills = Spills::default();
        let hands = [&[][..], &bones[..]];
        assert_eq!(spills.take(&splash(0.06e-6), 0.05, hands, 7), [Skin::Right]);
        assert!(
            (spills.spilt.bench - 12.0).abs() < 1e-9,
            "{:?}",
            spills.spilt
        );
        assert!((spills.contacts.right_hand.liquid_ml - 0.06).abs() < 1e-9);
        let mut drawn = bones;
        spills.mark(Side::Right, &mut drawn);
        assert_eq!(drawn[0].stain, 0.0);
        assert!((drawn[1].stain - 0.1).abs() < 1e-6, "{:?}", drawn[1]);
        // Felt by that hand alone, for a while; what follows at once is the same splash.
        assert_eq!(
            [Side::Left, Side::Right].map(|side| spills.felt(side, 8)),
            [0.0, 1.0]
        );
        assert_eq!(spills.felt(Side::Right, 7 + FELT), 0.0);
        assert_eq!(spills.take(&splash(3e-6), 0.05, hands, 7 + FELT), []);
        assert_eq!(spills.contacts.right_hand.times, 1);
        spills.mark(Side::Right, &mut drawn);
        assert_eq!(drawn[1].stain, 1.0);
        // Another glove is clean, and while none is on, nothing is seen on it.
        let worn = |glove| Worn {
            goggles: Some(true),
            gloves: Some([true, glove]),
        };
        spills.wears(worn(true));
        spills.mark(Side::Right, &mut drawn);
        assert_eq!(drawn[1].stain, 1.0);
        spills.wears(worn(false));
        spills.mark(Side::Right, &mut drawn);
        assert_eq!(drawn[1].stain, 0.0);
        // The face is felt by both.
        let mut face = Census::default();
        face.skin[2] = splash(1e-6).skin[1];
        assert_eq!(spills.take(&face, 0.05, hands, 3 * SAME), [Skin::Face]);
        assert_eq!(
            Side::BOTH.map(|side| spills.felt(side, 3 * SAME)),
            [1.0, 1.0]
        );
        // A bench anew is clean, and remembers.
        spills.clean();
        spills.mark(Side::Right, &mut drawn);
        assert_eq!((drawn[1].stain, spills.touched(Skin::Face)), (0.0, false));
        assert_eq!(
            (spills.contacts.face.times, spills.spilt),
            (1, Spilt::default())
        );
    }
}
