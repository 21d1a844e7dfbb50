//! Glass that breaks in a replay: in its picture, its sound, its counts, and only where the track says so.

use crate::device::common::{BEFORE, coloured, frame};
use glam::{Quat, Vec3};
use vitriol_run::track::key;
use vitriol_run::{Colour, Failure};
use vitriol_shaders::Library;
use vitriol_sound::Sound;
use vitriol_tests::gpu;
use vitriol_xr::{Hand, Pose, PoseFrame, Switch};

/// A hand lifts the beaker by 0.7 m, waits, and lets go; 60 steps after that it has broken.
const LIFTS: u64 = 5;
const LIFTED: u64 = LIFTS + 63;
const LETS_GO: u64 = LIFTED + 5;
const ENDS: u64 = LETS_GO + 75;

fn step(n: u64) -> PoseFrame {
    let lifted = (n.clamp(LIFTS, LIFTED) - LIFTS) as f32 / 90.0;
    let at = Vec3::new(0.05, 0.80 + lifted, -0.40);
    let mut frame = frame(n, Pose::new(BEFORE, Quat::IDENTITY));
    frame.hands[1] = Hand {
        active: true,
        valid: true,
        squeeze: f32::from(u8::from((2..LETS_GO).contains(&n))),
        stage_from_grip: Pose::new(at, Quat::IDENTITY),
        ..Hand::default()
    };
    frame
}

fn glass(value: &str) -> Switch {
    Switch {
        key: key::GLASS.into(),
        value: value.into(),
    }
}

/// Pixels of the greenish edge that broken glass has; bench, walls and water are grey or bluish.
fn edges(picture: &[u8]) -> usize {
    let pixels = picture.chunks_exact(4);
    let is_green = |p: &&[u8]| p[1] > p[0].saturating_add(14) && p[1].saturating_add(2) >= p[2];
    pixels.filter(is_green).count()
}

#[test]
fn a_dropped_beaker_lies_in_shards() {
    let device = gpu::device();
    for value in ["holds", "breaks"] {
        let mut laboratory = coloured(&device, None, Library::embedded(), Colour::Liquid);
        for n in 0..ENDS {
            let mut frame = step(n);
            if n == 0 {
                frame.scenario.push(glass(value));
            }
            laboratory.step(&frame).unwrap();
            // What is in it is known from samples before.
            if n == LETS_GO {
                laboratory.sample(1.0).unwrap();
            }
        }
        let breaks = value == "breaks";
        let seen = edges(laboratory.picture(0).unwrap());
        assert_eq!(seen > 30, breaks, "{value}: {seen}");
        let heard = laboratory.heard().unwrap();
        let cracks = heard
            .events
            .iter()
            .filter(|it| matches!(it.sound, Sound::Break(_)));
        assert_eq!(cracks.count(), usize::from(breaks), "{value}");
        let counters = laboratory.outcome().unwrap().counters;
        assert_eq!(counters.flasks_broken, u64::from(breaks), "{value}");
        // What lies there has not flown over a rim.
        let sample = laboratory.sample(2.0).unwrap();
        let above: f64 = sample.above_rim_kg.values().sum();
        assert!(!breaks || above == 0.0, "{above}");
        assert!(!breaks || sample.highest_drop_m.is_none(), "{sample:?}");
    }
}

#[test]
fn glass_that_does_neither_is_refused() {
    let device = gpu::device();
    let mut laboratory = coloured(&device, None, Library::embedded(), Colour::Liquid);
    let mut frame = step(0);
    frame.scenario.push(glass("melts"));
    let error = laboratory.step(&frame).unwrap_err();
    assert!(matches!(error, Failure::Input(_)));
    let said = error.to_string();
    assert!(
        said.contains("\"melts\"") && said.contains("holds or breaks"),
        "{said}"
    );
}

/// What a student asked of a lesson in another version's words is nothing to a replay that judges none.
#[test]
fn a_wish_without_a_judge_is_let_pass() {
    let device = gpu::device();
    let mut laboratory = coloured(&device, None, Library::embedded(), Colour::Liquid);
    let mut frame = step(0);
    frame.scenario.push(Switch {
        key: "lesson".into(),
        value: "sing a song".into(),
    });
    laboratory.step(&frame).unwrap();
}
