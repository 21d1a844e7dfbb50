//! Hands: one takes over from the other, and feels what it holds.

use std::path::Path;

use crate::common::{Calm, Worn, nobody, session};
use vitriol_tests::gpu;
use vitriol_xr::track::Keyframes;

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
    let folder = tempfile::tempdir().unwrap();
    let keyframes = Keyframes::parse(TRACK, Path::new("hands.toml")).unwrap();
    let run = |seconds: f64| {
        let frames = (45.0 * seconds) as u64 + 1;
        let folder = tempfile::tempdir_in(folder.path()).unwrap();
        let mut headset = Worn::new(&gpu, keyframes.sample_track(), 45.0, frames, Calm);
        let (outcome, track) = session(&mut headset, folder.path(), nobody());
        (outcome, track, headset.felt)
    };
    let (outcome, track, felt) = run(2.1);
    let world = &outcome.bench.world;
    assert_eq!(world.holder(0), Some(1), "the right hand has it");
    // With it went the flask: 5 cm to the right and 10 cm up from where the left one had it.
    let height = world.poses()[0].position.y;
    assert!((height - (0.75 + 0.15 + 0.10)).abs() < 5e-3, "{height}");
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
    let (outcome, _, _) = run(2.39);
    assert_eq!(outcome.bench.world.holder(0), None);
    assert!(outcome.bench.world.poses()[0].position.y < height - 5e-3);
}
