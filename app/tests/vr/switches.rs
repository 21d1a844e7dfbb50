//! Each thing that can be switched is in the recording, and replays.

use std::sync::mpsc::{Sender, channel};

use crate::common::{Trouble, Worn, hash, pour, session};
use crate::loss::replayed;
use glam::{Quat, Vec3};
use vitriol::vr::decision::Decision;
use vitriol::vr::placement::SWITCH_PLACEMENT;
use vitriol::vr::stand_in::StandIn;
use vitriol_experiment::switches::{SWITCH_SCENE, SWITCH_START};
use vitriol_tests::gpu;
use vitriol_xr::{HeadsetFrame, Pose, Turn};

/// Presses B, moves the stage and presses A, then chooses a scene; each once and in time for the
/// next to be built.
struct Restless {
    frames: u32,
    decisions: Sender<Decision>,
    scene: String,
    moved: bool,
}

const B: u32 = 15;
const A: u32 = 40;
const SCENE: u32 = 60;

impl Trouble for Restless {
    fn turn(&mut self, _: &mut StandIn) -> Option<Turn> {
        // Time to build a bench, whatever else the machine does.
        if [B + 1, SCENE + 1].contains(&self.frames) {
            std::thread::sleep(std::time::Duration::from_secs(8));
        }
        None
    }

    fn frame(&mut self, frame: &mut HeadsetFrame) {
        frame.poses.hands[0].active = true;
        frame.poses.hands[0].button_b = self.frames == B;
        frame.poses.hands[0].button_a = self.frames == A;
        if self.frames == SCENE {
            self.decisions
                .send(Decision::Scene(self.scene.clone()))
                .unwrap();
        }
        self.moved |= self.frames == A;
        if self.moved {
            let there = Pose::new(Vec3::new(2.0, 0.3, 1.0), Quat::from_rotation_y(1.0));
            let poses = &mut frame.poses;
            poses.stage_from_view = there.compose(&poses.stage_from_view);
            for hand in &mut poses.hands {
                hand.stage_from_grip = there.compose(&hand.stage_from_grip);
                hand.stage_from_aim = there.compose(&hand.stage_from_aim);
            }
        }
        self.frames += 1;
    }
}

#[test]
fn start_placement_and_scene_replay() {
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    // Another frame time than the first scene's, and other particles.
    let other = std::fs::read_to_string(crate::common::scene(folder.path())).unwrap();
    let other = other
        .replace("frame_time = 0.011111111111111", "frame_time = 0.02")
        .replace("volume_ml = 150.0", "volume_ml = 90.0");
    let other_file = folder.path().join("other.toml");
    std::fs::write(&other_file, other).unwrap();
    let (sender, decisions) = channel();
    let trouble = Restless {
        frames: 0,
        decisions: sender,
        scene: other_file.to_str().unwrap().into(),
        moved: false,
    };
    let mut headset = Worn::new(&gpu, pour().sample_track(), 60.0, 120, trouble);
    let (outcome, track) = session(&mut headset, folder.path(), decisions);
    assert_eq!(outcome.bench.plan.scene, other_file.to_str().unwrap());

    let switched: Vec<&str> = track
        .frames
        .iter()
        .flat_map(|frame| &frame.scenario)
        .map(|switch| switch.key.as_str())
        .collect();
    assert_eq!(
        switched,
        [
            SWITCH_PLACEMENT,
            SWITCH_START,
            SWITCH_PLACEMENT,
            SWITCH_SCENE
        ]
    );
    // The bench has followed the user: in the scene nothing has moved but by what she did.
    let first = track.frames[0].stage_from_view.position;
    let last = track.frames[track.frames.len() - 1]
        .stage_from_view
        .position;
    assert!((first - last).length() < 0.1, "{first} {last}");
    let expected = hash(&outcome);
    assert_eq!(replayed(&gpu, track), expected);
}
