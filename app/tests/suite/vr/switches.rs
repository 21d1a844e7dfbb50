//! Each thing that can be switched is in the recording, and replays.

use std::sync::mpsc::{Sender, channel};

use crate::vr::common::{Trouble, Worn, hash, heard, options, pour, session_with};
use crate::vr::leap::move_all;
use crate::vr::loss::replayed;
use glam::{Quat, Vec3};
use vitriol_run::Action;
use vitriol_run::track::key;
use vitriol_session::decision::Decision;
use vitriol_session::workbench::TAKEN_UP;
use vitriol_tests::gpu;
use vitriol_xr::{HeadsetFrame, Pose};

/// Holds B, moves the stage and presses A, then chooses a scene; each once, when what came before
/// has been built.
struct Restless {
    decisions: Sender<Decision>,
    scene: String,
    moved: bool,
}

/// At 60 Hz it takes 60 frames more.
const B: u64 = 15;
const HELD: u64 = B + 61;
const A: u64 = 100;
const SCENE: u64 = 120;

impl Trouble for Restless {
    fn awaits(&self, after: u64) -> bool {
        (after == HELD + 1 && heard(TAKEN_UP) < 1) || (after == SCENE + 1 && heard(TAKEN_UP) < 2)
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        frame.poses.hands[0].active = true;
        frame.poses.hands[0].button_b = (B..HELD).contains(&after);
        frame.poses.hands[0].button_a = after == A;
        if after == SCENE {
            self.decisions
                .send(Decision::Act(Action::Scene(self.scene.clone())))
                .unwrap();
        }
        self.moved |= after == A;
        if self.moved {
            let there = Pose::new(Vec3::new(2.0, 0.3, 1.0), Quat::from_rotation_y(1.0));
            move_all(&mut frame.poses, &there);
        }
    }
}

mod long {
    use super::*;

    #[test]
    fn start_placement_and_scene_replay() {
        let gpu = gpu::device();
        let folder = tempfile::tempdir().unwrap();
        // Another frame time than the first scene's, and other particles.
        let other = std::fs::read_to_string(crate::vr::common::scene(folder.path())).unwrap();
        let other = other
            .replace("frame_time = 0.011111111111111", "frame_time = 0.02")
            .replace("volume_ml = 150.0", "volume_ml = 90.0");
        let other_file = folder.path().join("other.toml");
        std::fs::write(&other_file, other).unwrap();
        let (sender, decisions) = channel();
        let trouble = Restless {
            decisions: sender,
            scene: "other.toml".into(),
            moved: false,
        };
        let mut headset = Worn::new(&gpu, pour().sample_track(), 60.0, 180, trouble);
        let mut options = options(folder.path());
        let other = options.plan.scenes.open(other_file.to_str().unwrap());
        assert_eq!(other.unwrap(), "other.toml");
        let (outcome, track) = session_with(&mut headset, options, decisions);
        assert_eq!(outcome.bench.plan.scene, "other.toml");

        let switched: Vec<&str> = track
            .frames
            .iter()
            .flat_map(|frame| &frame.scenario)
            .map(|switch| switch.key.as_str())
            .collect();
        assert_eq!(
            switched,
            [key::PLACEMENT, key::START, key::PLACEMENT, key::SCENE]
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
}
