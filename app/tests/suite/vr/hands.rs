//! Hands: one takes over from the other, and feels what it holds.

use std::path::Path;

use crate::vr::common::{self, Calm, Trouble, Worn, hash, pour};
use crate::vr::loss::replayed;
use glam::{Quat, Vec3};
use vitriol_session::latch::Grip;
use vitriol_tests::gpu;
use vitriol_xr::track::{Keyframes, Track};
use vitriol_xr::{Hand, HeadsetFrame, Joints, Pose};

/// The left hand grips the flask, shakes it, and gives it to the right one, which lifts it and then
/// lets it fall. The flask stands at (-0.12, 0.75, -0.40), 36 mm in radius, 95 mm high.
const TRACK: &str = r#"
name = "from-hand-to-hand"
scene = "two-flasks"
seed = 1
duration = 2.4
rate_hz = 90
head = [ { t = 0.0, position = [0.0, 1.20, 0.0] } ]
left = [
  { t = 0.0, position = [-0.165, 0.80, -0.40] },
  { t = 0.2, squeeze = 1.0 },
  { t = 0.5, position = [-0.165, 0.95, -0.40] },
  { t = 0.6, position = [-0.125, 0.95, -0.40] },
  { t = 0.7, position = [-0.165, 0.95, -0.40] },
  { t = 0.8, position = [-0.125, 0.95, -0.40] },
  { t = 0.9, position = [-0.165, 0.95, -0.40] },
  { t = 1.5, squeeze = 1.0 },
  { t = 1.6, squeeze = 0.0 },
  { t = 2.0, position = [-0.40, 0.95, -0.40] },
]
right = [
  { t = 0.0, position = [-0.075, 0.95, -0.30] },
  { t = 1.0, position = [-0.075, 0.95, -0.40] },
  { t = 1.2, trigger = 1.0 },
  { t = 1.6, trigger = 1.0 },
  { t = 2.0, position = [-0.025, 1.05, -0.40] },
  { t = 2.2, trigger = 1.0 },
  { t = 2.3, trigger = 0.0 },
]
"#;

#[test]
fn a_flask_changes_hands_and_is_felt() {
    let gpu = gpu::device();
    let keyframes = Keyframes::parse(TRACK, Path::new("hands.toml")).unwrap();
    let frames = (45.0 * 2.39) as u64 + 1;
    let mut headset = Worn::new(&gpu, keyframes.sample_track(), 45.0, frames, Calm);
    let (outcome, track) = common::run(&mut headset, |_| ());
    let felt = headset.felt;
    // Where it was at 2.1 s: the right hand has it.
    let until = track.frames.iter().filter(|it| it.time_ns <= 2_100_000_000);
    let flasks = track.stage_from_flasks[..until.count()].iter().rev();
    let had = flasks.flatten().next().unwrap().position;
    // 5 cm to the right and 10 cm up from where the left one had it.
    assert!((had.x - (-0.12 + 0.05)).abs() < 5e-3, "{had}");
    assert!((had.y - (0.75 + 0.15 + 0.10)).abs() < 5e-3, "{had}");
    // The left hand felt the shaking while it held it, the right one nothing then; at rest in the
    // right hand it is the weaker. Frames of 1/45 s.
    let at = |seconds: f64| (45.0 * seconds) as usize;
    let most = |side: usize, from: f64, to: f64| {
        let felt = felt[at(from)..at(to)].iter();
        felt.map(|felt| felt[side]).fold(0.0, f32::max)
    };
    assert_eq!(most(0, 0.0, 0.1), 0.0, "it holds nothing");
    let shaken = most(0, 0.6, 1.0);
    assert!(shaken > 0.3, "{shaken}");
    assert_eq!(most(1, 0.6, 1.0), 0.0);
    assert_eq!(most(0, 1.8, 2.1), 0.0, "it has let go");
    assert!(most(1, 1.4, 1.6) > 0.0);
    assert!(track.frames.len() > 180);

    // And let go it falls, at rest some 0.25 m lower after a while.
    assert_eq!(outcome.world.holder(0), None);
    assert!(outcome.world.poses()[0].position.y < had.y - 5e-3);
}

/// A bare hand about an axis that stands, its palm to the user: thumb and four fingers so far (m) from the axis, on opposite
/// sides. A finger's skin is 8 mm from its joint.
fn bare(axis: Vec3, reach: f32) -> (Hand, Joints) {
    let mut joints = Joints([(axis + Vec3::Z * 0.06, 0.008); 26]);
    joints.0[Joints::THUMB].0 = axis + Vec3::NEG_X * reach;
    for (n, finger) in Joints::FINGERS.into_iter().enumerate() {
        joints.0[finger].0 = axis + Vec3::X * reach + Vec3::Y * (0.02 * (n as f32 - 1.5));
    }
    let hand = Hand {
        active: true,
        valid: true,
        tracked: true,
        stage_from_grip: Pose::new(axis + Vec3::Z * 0.05, Quat::IDENTITY),
        ..Hand::default()
    };
    (hand, joints)
}

/// The right hand comes to the flask open, closes round it, lifts it at 1.5 m/s, and opens.
struct Bare {
    /// How near the fingers come to the flask's axis, m.
    closes_to: f32,
}

/// At 90 Hz.
const CLOSES: u64 = 20;
const LIFTS: u64 = 30;
const LIFTED: u64 = LIFTS + 18;
const OPENS: u64 = LIFTED + 10;

impl Trouble for Bare {
    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        let up = 1.5 / 90.0 * after.clamp(LIFTS, LIFTED).saturating_sub(LIFTS) as f32;
        let axis = Vec3::new(-0.12, 0.80 + up, -0.40);
        let reach = match (CLOSES..OPENS).contains(&after) {
            true => self.closes_to,
            // A hand at rest before it.
            false => 0.036 + 0.008 + 0.03,
        };
        let (hand, joints) = bare(axis, reach);
        frame.poses.stage_from_view = Pose::new(Vec3::new(0.0, 1.2, 0.0), Quat::IDENTITY);
        frame.poses.hands = [Hand::default(), hand];
        frame.joints = [None, Some(joints)];
    }
}

/// The right hand presses beside the flask, lets the button go, lifts the flask, and presses again.
struct Presses;

impl Trouble for Presses {
    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        let up = 0.01 * after.clamp(30, 50).saturating_sub(30) as f32;
        let (mut hand, _) = bare(Vec3::new(-0.12, 0.80 + up, -0.40), 0.0);
        let presses = (20..25).contains(&after) || (60..65).contains(&after);
        hand.squeeze = if presses { 1.0 } else { 0.0 };
        frame.poses.stage_from_view = Pose::new(Vec3::new(0.0, 1.2, 0.0), Quat::IDENTITY);
        frame.poses.hands = [Hand::default(), hand];
    }
}

/// Height at which the flask is still after so many frames of one step each, of which the first has none; `None` where it moves. Over the
/// table a hand holds it then: without one it falls by 0.6 mm or more in a step of 1/90 s.
fn height_after(frames: u64, track: &Track) -> Option<f32> {
    let height = |index: usize| track.stage_from_flasks[index][0].position.y;
    let [before, now] = [frames as usize - 3, frames as usize - 2].map(height);
    ((now - before).abs() < 1e-4).then_some(now)
}

mod long {
    use super::*;

    #[test]
    fn one_press_grips_and_the_next_lets_go() {
        let gpu = gpu::device();
        let run = |grip: Grip, frames: u64| {
            let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, frames, Presses);
            let (outcome, track) = common::run(&mut headset, |options| options.grip = grip);
            let world = &outcome.world;
            let held = height_after(58, &track);
            (world.holder(0), held, world.poses()[0].position.y)
        };
        let (holder, held, height) = run(Grip::Toggle, 80);
        assert!(
            held.is_some_and(|held| (held - 0.95).abs() < 5e-3),
            "{held:?}"
        );
        assert!(holder.is_none() && height < 0.94, "{height}");
        // Held, the button would have had to stay pressed.
        assert_eq!(run(Grip::Hold, 58).0, None);
    }

    /// The flask is 36 mm in radius and stands at 0.75 m.
    #[test]
    fn a_bare_hand_grips_what_it_closes_round() {
        let gpu = gpu::device();
        let run = |closes_to: f32, frames: u64| {
            let trouble = Bare { closes_to };
            let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, frames, trouble);
            let (outcome, track) = common::run(&mut headset, |_| ());
            let world = &outcome.world;
            let held = height_after(OPENS, &track);
            let found = (world.holder(0), held, world.poses()[0].position.y);
            assert_eq!(replayed(&gpu, track), hash(&outcome));
            found
        };
        let is_lifted =
            |held: Option<f32>| held.is_some_and(|held| (held - (0.75 + 0.30)).abs() < 0.02);
        // Fingers go into the glass, and touch it.
        let (holder, held, _) = run(0.02, OPENS);
        assert_eq!(holder, Some(1));
        assert!(is_lifted(held), "{held:?}");
        let (holder, held, height) = run(0.036 + 0.008, OPENS + 10);
        assert!(is_lifted(held), "{held:?}");
        assert_eq!(holder, None, "it has opened");
        assert!(height < 1.04, "and the flask falls: {height}");
        // As bent as before, but 20 mm off.
        assert_eq!(run(0.064, OPENS).0, None);
    }
}
