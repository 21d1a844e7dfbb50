//! Everything that a session offers, with one hand alone, sitting.

use std::path::Path;

use crate::vr::common::{Trouble, Worn, heard, run};
use crate::vr::panel::{decisions, on_panel, place_of, press_from};
use glam::{Quat, Vec3};
use vitriol_gpu::Gpu;
use vitriol_run::Action;
use vitriol_run::choices::CHOICES;
use vitriol_run::track::key;
use vitriol_session::decision::Decision;
use vitriol_session::handle::middles;
use vitriol_session::panel::Panel;
use vitriol_session::workbench::TAKEN_UP;
use vitriol_shaders::Library;
use vitriol_sim::bodies::GRIP_REACH;
use vitriol_sim::scene::Scene;
use vitriol_tests::gpu;
use vitriol_xr::track::Keyframes;
use vitriol_xr::{Hand, HeadsetFrame, Pose, Side, Switch};

/// At 45 Hz: presses A (X), the panel's button for the same, holds B (Y), grips, lifts and puts down the flask, raises the bench by its
/// handle, and chooses another scene on the panel, which has risen too.
const PRESSES: u64 = 10;
const POINTS: u64 = 15;
const HOLDS: u64 = 30;
const LETS_GO: u64 = HOLDS + 46;
const GRIPS: u64 = LETS_GO + 10;
const RAISES: u64 = GRIPS + 40;
const CHOOSES: u64 = RAISES + 40;
const ENDS: u64 = CHOOSES + 60;
const RAISED: f32 = 0.10;

struct Alone {
    side: Side,
    /// The panel's buttons for the same as A and for another scene, pixels.
    recentre: [f32; 2],
    scene: [f32; 2],
}

impl Alone {
    /// Where the hand is and where it aims, and whether trigger and squeeze are pulled.
    fn hand(&self, after: u64) -> (Vec3, Vec3, [bool; 2]) {
        let side = [-1.0, 1.0][self.side as usize];
        // A trigger that is pulled at a flask would grip it.
        let before_panel = Vec3::new(0.0, 1.0, -0.2);
        let steps = |from: u64| after.clamp(from, from + 10).saturating_sub(from) as f32;
        match after {
            POINTS..HOLDS => {
                let pulls = after == POINTS + 5;
                (before_panel, on_panel(self.recentre), [pulls, false])
            }
            RAISES..CHOOSES => {
                // The bar is about (±0.30, 0.735, -0.065).
                let up = 0.1 * RAISED * steps(RAISES + 10);
                let at = Vec3::new(0.30 * side, 0.75 + up, -0.05);
                let closed = (RAISES + 5..RAISES + 30).contains(&after);
                (at, at + Vec3::NEG_Y, [false, closed])
            }
            CHOOSES.. => {
                let pulls = (CHOOSES + 5..CHOOSES + 53).contains(&after);
                let target = on_panel(self.scene) + RAISED * Vec3::Y;
                (before_panel, target, [pulls, false])
            }
            // The flask stands at (-0.12, 0.75, -0.40), 36 mm in radius.
            _ => {
                let up = 0.005 * (steps(GRIPS + 4) - steps(GRIPS + 18));
                let at = Vec3::new(-0.12 + 0.045 * side, 0.80 + up, -0.40);
                let closed = (GRIPS + 2..GRIPS + 30).contains(&after);
                (at, at + Vec3::NEG_Y, [false, closed])
            }
        }
    }
}

impl Trouble for Alone {
    fn awaits(&self, after: u64) -> bool {
        let taken_up = [(LETS_GO + 1, 1), (ENDS - 2, 2)];
        let mut waits = taken_up.iter();
        waits.any(|(at, count)| after == *at && heard(TAKEN_UP) < *count)
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        let (at, aims, [trigger, squeeze]) = self.hand(after);
        let turn = Quat::from_rotation_arc(Vec3::NEG_Z, (aims - at).normalize());
        let hand = Hand {
            active: true,
            valid: true,
            tracked: true,
            stage_from_grip: Pose::new(at, Quat::IDENTITY),
            stage_from_aim: Pose::new(at, turn),
            button_a: after == PRESSES,
            button_b: (HOLDS..LETS_GO).contains(&after),
            trigger: f32::from(u8::from(trigger)),
            squeeze: f32::from(u8::from(squeeze)),
            ..Hand::default()
        };
        frame.poses.hands = [Hand::default(), Hand::default()];
        frame.poses.hands[self.side as usize] = hand;
    }
}

fn alone(gpu: &Gpu, side: Side) {
    const TRACK: &str = r#"
name = "sits"
scene = "two-flasks"
seed = 1
duration = 1.0
rate_hz = 90
head = [ { t = 0.0, position = [0.0, 1.20, 0.0] } ]
"#;
    let track = Keyframes::parse(TRACK, Path::new("sits.toml")).unwrap();
    let scene = CHOICES[4].scene;
    let trouble = Alone {
        side,
        recentre: place_of(gpu, &Decision::Recentre),
        scene: place_of(gpu, &Decision::Act(Action::Scene(scene.into()))),
    };
    let mut headset = Worn::new(gpu, track.sample_track(), 45.0, ENDS, trouble);
    let (outcome, track) = run(&mut headset, |_| ());
    let switches: Vec<_> = track
        .frames
        .iter()
        .flat_map(|frame| &frame.scenario)
        .filter(|switch| [key::PLACEMENT, key::START, key::SCENE].contains(&&*switch.key))
        .collect();
    let keys: Vec<&str> = switches.iter().map(|switch| switch.key.as_str()).collect();
    // At the start, by button, by panel, and from the start.
    let expected = [key::PLACEMENT, key::PLACEMENT, key::PLACEMENT, key::START];
    assert_eq!(keys[..4], expected, "{side:?}: {keys:?}");
    // Then it rises, and the other scene stands as high.
    let (last, raised) = keys[4..].split_last().unwrap();
    assert_eq!(*last, key::SCENE, "{side:?}: {keys:?}");
    assert!(raised.iter().all(|key| *key == key::PLACEMENT));
    let height =
        |switch: &Switch| -> f32 { switch.value.split(' ').nth(1).unwrap().parse().unwrap() };
    let risen = height(switches[switches.len() - 2]) - height(switches[2]);
    assert!((risen - RAISED).abs() < 1e-3, "{side:?}: {risen}");
    assert_eq!(outcome.bench.plan.scene, scene);
    let flasks = track.stage_from_flasks.iter();
    let heights = flasks.filter_map(|all| Some(all.first()?.position.y));
    let lifted = heights.fold(0.0, f32::max) - 0.75;
    assert!((lifted - 0.05).abs() < 5e-3, "{side:?}: {lifted}");
}

#[test]
fn all_is_done_with_the_right_hand_alone() {
    alone(&gpu::device(), Side::Right);
}

mod long {
    use super::*;

    #[test]
    fn all_is_done_with_the_left_hand_alone() {
        alone(&gpu::device(), Side::Left);
    }
}

/// From the acromion to the middle of what the hand grips, m: the 5th percentile of women of Hong Kong, whose arms are the
/// shortest of Pheasant's tables (Bodyspace, dimension 25, shoulder-grip length; of British women it is 0.555 m).
const ARM: f32 = 0.525;
/// Seated, below the eyes at 1.20 m and aside from the middle, m.
const SHOULDERS: [Vec3; 2] = [Vec3::new(-0.16, 1.0, 0.0), Vec3::new(0.16, 1.0, 0.0)];

/// Either arm reaches each flask that can be lifted and each handle with a grip's own reach, without leaning.
#[test]
fn either_arm_reaches_all() {
    for choice in CHOICES {
        let scene = Scene::builtin(choice.scene).unwrap();
        let scale = scene.scale.length_scale as f32;
        // The emergency leaves the acid's beaker where it stands.
        let left = |flask: &str| (choice.scene, flask) == ("acid-on-glove", "acid");
        let free = scene.flasks.iter();
        let free = free.filter(|flask| !flask.fixed && !left(&flask.name));
        let flasks = free.map(|flask| {
            let half = 0.5 * flask.profile.rim_height();
            let radius = scale * flask.profile.outer_radius_at(half) as f32;
            let pose = &flask.stage_from_flask;
            let middle = scale * pose.transform_point(Vec3::Y * half as f32);
            (flask.name.clone(), middle, radius)
        });
        let handles = middles(&scene).unwrap();
        let handles = handles.map(|at| ("handle".to_owned(), at, 0.0));
        for (name, at, radius) in flasks.chain(handles) {
            for shoulder in SHOULDERS {
                let away = shoulder.distance(at) - radius - GRIP_REACH;
                assert!(away < ARM, "{name} of {}: {away} m", choice.scene);
            }
        }
    }
}

/// Each button is pressed with either hand beside the elbow, the arm bent: by its ray.
#[test]
fn either_hand_presses_each_button_from_its_place() {
    let gpu = gpu::device();
    let mut panel = Panel::new(&gpu, &Library::embedded()).unwrap();
    for decision in decisions() {
        let button = place_of(&gpu, &decision);
        for shoulder in SHOULDERS {
            let from = shoulder + Vec3::new(0.0, -0.25, -0.30);
            assert!(shoulder.distance(from) < ARM);
            let pressed = press_from(&mut panel, from, button, 1.2);
            assert_eq!(pressed.as_ref(), Some(&decision), "{from}");
        }
    }
}
