//! The bench is raised by a handle at its edge: nothing stirs in the scene, the other hand keeps what it holds, and a recording
//! replays.

use std::path::Path;

use glam::Vec3;
use vitriol_gpu::Gpu;
use vitriol_run::track::key;
use vitriol_session::session::SessionOutcome;
use vitriol_tests::gpu;
use vitriol_xr::track::{Keyframes, Track};

use crate::vr::common::{Calm, Worn, hash, nobody, options_where, session_with};
use crate::vr::loss::replayed;

/// She sits, so the scene is where the stage is. The right hand lifts the flask of 150 mL at (-0.12, 0.75, -0.40); the left one is at
/// its handle, whose bar is about (-0.30, 0.735, -0.065), closes at 0.5 s, and goes up by `RISES` from 0.7 to 1.2 s. It opens at
/// 1.4 s and goes on without the bench.
const TRACK: &str = r#"
name = "raises"
scene = "two-flasks"
seed = 1
duration = 2.0
rate_hz = 90
head = [ { t = 0.0, position = [0.0, 1.20, 0.0] }, { t = 1.2, position = [0.0, 1.20, 0.0] }, { t = 1.4, position = [0.0, 1.21, 0.0] } ]
left = [
  { t = 0.0, position = [-0.29, 0.76, -0.05] },
  { t = 0.4, squeeze = 0.0 },
  { t = 0.5, squeeze = 1.0 },
  { t = 0.7, position = [-0.29, 0.76, -0.05] },
  { t = 1.2, position = [-0.29, RISES, -0.05] },
  { t = 1.4, squeeze = 1.0, position = [-0.29, RISES, -0.05] },
  { t = 1.5, squeeze = 0.0, position = [-0.29, RISES, -0.05] },
  { t = 1.9, position = [-0.29, 1.10, -0.05] },
]
right = [
  { t = 0.0, position = [-0.075, 0.80, -0.40] },
  { t = 0.2, squeeze = 1.0 },
  { t = 0.5, position = [-0.075, 0.90, -0.40] },
  { t = 2.0, squeeze = 1.0, position = [-0.075, 0.90, -0.40] },
]
"#;

/// A session in which the left hand rises to `to` (m), with the scene's text changed.
fn run(gpu: &Gpu, to: f32, change: impl Fn(String) -> String) -> (SessionOutcome, Track) {
    let text = TRACK.replace("RISES", &to.to_string());
    run_at(gpu, &text, (90.0, 178), change)
}

/// The same with those keyframes, at that rate and for so many frames.
fn run_at(
    gpu: &Gpu,
    text: &str,
    (rate_hz, frames): (f64, u64),
    change: impl Fn(String) -> String,
) -> (SessionOutcome, Track) {
    let folder = tempfile::tempdir().unwrap();
    let track = Keyframes::parse(text, Path::new("raises.toml")).unwrap();
    let mut headset = Worn::new(gpu, track.sample_track(), rate_hz, frames, Calm);
    let options = options_where(folder.path(), change);
    session_with(&mut headset, options, nobody())
}

/// When the bench was put somewhere, s, and at what height, m.
fn heights(track: &Track) -> Vec<(f64, f32)> {
    let of = |frame: &vitriol_xr::PoseFrame| {
        let placed = frame.scenario.iter().filter(|it| it.key == key::PLACEMENT);
        let y = |value: &str| value.split(' ').nth(1).unwrap().parse().unwrap();
        let time = 1e-9 * frame.time_ns as f64;
        placed.map(|it| (time, y(&it.value))).collect::<Vec<_>>()
    };
    track.frames.iter().flat_map(of).collect()
}

#[test]
fn a_hand_at_the_handle_raises_the_bench() {
    let gpu = gpu::device();
    let (still, track) = run(&gpu, 0.76, |scene| scene);
    let [(_, height)] = heights(&track)[..] else {
        panic!("it has moved");
    };
    assert!(height.abs() < 1e-6, "{height}");
    let full = still.world.measure().unwrap();

    let (outcome, track) = run(&gpu, 0.86, |scene| scene);
    let placed = heights(&track);
    // As high as the hand has gone, not beyond, and only while it goes up.
    let (last, height) = *placed.last().unwrap();
    assert!((height - 0.10).abs() < 1e-3, "{height}");
    assert!(last < 1.25, "{last}");
    assert!(placed[1].0 > 0.65 && placed.len() > 30, "{placed:?}");
    assert!(placed.windows(2).all(|pair| pair[1].1 >= pair[0].1));
    // Time went on.
    assert_eq!(outcome.steps, still.steps);
    // The other hand has the flask where it was in the room, so it is lower in the scene; and all that was in it.
    let world = &outcome.world;
    assert_eq!(world.holder(0), Some(1));
    let lower = still.world.poses()[0].position - world.poses()[0].position;
    assert!((lower - 0.10 * Vec3::Y).length() < 2e-3, "{lower}");
    let measured = world.measure().unwrap();
    assert_eq!(measured.in_flasks[0], full.in_flasks[0]);
    assert!((full.in_flasks[0] - 0.15).abs() < 1e-3);
    // What stands on the bench has not moved.
    let apart = (world.poses()[1].position - still.world.poses()[1].position).length();
    assert!(apart < 1e-5, "{apart}");
    let expected = hash(&outcome);
    assert_eq!(replayed(&gpu, track), expected);
}

/// The highest that the first flask was, m.
fn highest(track: &Track) -> f32 {
    let flasks = track.stage_from_flasks.iter();
    let heights = flasks.filter_map(|all| Some(all.first()?.position.y));
    heights.fold(0.0, f32::max)
}

mod long {
    use super::*;

    /// 0.3 m below the eyes it stops, though hand and head go on: from 1.20 to 1.21 m.
    #[test]
    fn the_bench_is_not_raised_to_the_eyes() {
        let gpu = gpu::device();
        let (_, track) = run(&gpu, 1.00, |scene| scene);
        let heights: Vec<f32> = heights(&track).iter().map(|(_, height)| *height).collect();
        let highest = heights.iter().copied().fold(0.0, f32::max);
        assert!((highest - 0.15).abs() < 1e-3, "{highest}");
    }

    /// A flask within reach comes first: 4 cm from the hand, which is 2 cm from the bar.
    #[test]
    fn a_flask_is_gripped_before_the_handle() {
        let gpu = gpu::device();
        let near = |scene: String| {
            let near = "position = [-0.29, 0.75, -0.125]\nfixed";
            let moved = scene.replacen("position = [-0.12, 0.75, -0.40]\nfixed", near, 1);
            assert_ne!(moved, scene);
            moved
        };
        let (outcome, track) = run(&gpu, 0.86, near);
        assert_eq!(heights(&track).len(), 1);
        // It was lifted by 10 cm and let go.
        let lifted = highest(&track);
        assert!((lifted - 0.85).abs() < 3e-3, "{lifted}");
        assert_eq!(outcome.world.holder(0), None);

        // Nor does the bench move where the hand closes on its way up, in a frame without a step: until there is one nobody holds
        // the flask. Every fourth frame has one.
        let mut rising = TRACK.replace("RISES", "0.86");
        for (from, to) in [
            (
                "{ t = 0.5, squeeze = 1.0 }",
                "{ t = 0.51, squeeze = 1.0, position = [-0.29, 0.78, -0.05] }",
            ),
            (
                "t = 0.7, position = [-0.29, 0.76,",
                "t = 0.7, position = [-0.29, 0.82,",
            ),
        ] {
            assert!(rising.contains(from));
            rising = rising.replacen(from, to, 1);
        }
        let rising = rising.replacen("rate_hz = 90", "rate_hz = 360", 1);
        let (_, track) = run_at(&gpu, &rising, (360.0, 250), near);
        assert_eq!(heights(&track).len(), 1);
        let lifted = highest(&track);
        assert!(lifted > 0.77, "{lifted}");
    }
}
