//! The hands leap while one of them holds a full flask: the user is recentred, by button or by the runtime, takes the headset
//! off and on again elsewhere, or is found again by another session. Nothing is spilt, and the recording replays.

use glam::{Quat, Vec3};
use vitriol_gpu::Gpu;
use vitriol_run::track::key;
use vitriol_session::stand_in::StandIn;
use vitriol_tests::gpu;
use vitriol_xr::{HeadsetFrame, Pause, Pose, PoseFrame, Turn};

use crate::vr::common::{Trouble, Worn, hash, pour, run, switched};
use crate::vr::loss::replayed;

/// 1.6 s at 30 Hz: the flask is lifted, upright, and carried to the side.
const LEAP: u64 = 48;

/// How the hands come to leap.
enum How {
    /// Not at all.
    Calm,
    /// She looks aside and presses A.
    Button,
    /// The runtime moves the stage, and says so.
    Runtime,
    /// The headset is off for some turns, and the hand goes on meanwhile.
    Off,
    /// Another session has its stage elsewhere.
    Renewed(Gpu),
}

impl How {
    fn name(&self) -> &'static str {
        match self {
            Self::Calm => "calm",
            Self::Button => "button",
            Self::Runtime => "runtime",
            Self::Off => "off",
            Self::Renewed(_) => "renewed",
        }
    }
}

struct Leaping {
    how: How,
    turns: u32,
}

/// The stage elsewhere, with all that is in it.
pub fn move_all(poses: &mut PoseFrame, there: &Pose) {
    poses.stage_from_view = there.compose(&poses.stage_from_view);
    for hand in &mut poses.hands {
        hand.stage_from_grip = there.compose(&hand.stage_from_grip);
        hand.stage_from_aim = there.compose(&hand.stage_from_aim);
    }
}

impl Trouble for Leaping {
    fn turn(&mut self, headset: &mut StandIn, after: u64) -> Option<Turn> {
        if after != LEAP || self.turns == 3 {
            return None;
        }
        self.turns += 1;
        match &self.how {
            How::Off => Some(Turn::Paused { cause: Pause::Off }),
            How::Renewed(_) if self.turns < 3 => Some(Turn::Lost {
                cause: "the test took the runtime away".into(),
            }),
            How::Renewed(then) => {
                headset.move_to(then).unwrap();
                Some(Turn::Renewed)
            }
            _ => None,
        }
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        if after < LEAP {
            return;
        }
        let elsewhere = Pose::new(Vec3::new(2.0, 0.3, 1.0), Quat::from_rotation_y(1.0));
        match self.how {
            How::Calm => {}
            How::Button => {
                // 0.1 m at the flask: a hand would have 9 m/s.
                let head = &mut frame.poses.stage_from_view.orientation;
                *head = Quat::from_rotation_y(0.25) * *head;
                frame.poses.hands[0].active = true;
                frame.poses.hands[0].button_a = after == LEAP;
            }
            How::Runtime => {
                move_all(&mut frame.poses, &elsewhere);
                frame.recentred = after == LEAP;
            }
            How::Off => {
                frame.poses.hands[1].stage_from_grip.position += Vec3::new(0.1, 0.05, 0.05);
            }
            How::Renewed(_) => move_all(&mut frame.poses, &elsewhere),
        }
    }
}

/// What is left in the flask (kg), and how it moves (J), 0.4 s after the leap; and that the recording says the same.
fn carried(how: How, leaps: usize) -> (f64, f64) {
    let gpu = gpu::device();
    let name = how.name();
    let trouble = Leaping { how, turns: 0 };
    let mut headset = Worn::new(&gpu, pour().sample_track(), 30.0, LEAP + 12, trouble);
    let (outcome, track) = run(&mut headset, |_| ());
    let world = &outcome.world;
    assert_eq!(world.holder(0), Some(1), "{name}");
    let measured = world.measure().unwrap();
    assert_eq!(switched(&track, key::PLACEMENT), 1 + leaps, "{name}");
    let expected = hash(&outcome);
    assert_eq!(replayed(&gpu, track), expected, "{name}");
    (measured.in_flasks[0], measured.kinetic_energy)
}

mod long {
    use super::*;

    #[test]
    fn nothing_is_spilt_where_the_hands_leap() {
        let (full, calm) = carried(How::Calm, 0);
        assert!((full - 0.15).abs() < 1e-3, "{full} kg");
        let another = gpu::another_device(|_| {});
        for how in [
            How::Button,
            How::Runtime,
            How::Off,
            How::Renewed(Gpu::clone(&another)),
        ] {
            let name = how.name();
            let (left, energy) = carried(how, 1);
            assert_eq!(left, full, "{name}");
            // She goes on in another direction than that in which the liquid sways.
            assert!(energy < 1.5 * calm, "{name}: {energy} J of {calm}");
        }
    }
}
