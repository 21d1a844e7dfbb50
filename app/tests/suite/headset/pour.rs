//! A pour, seen through OpenXR, recorded and replayed.

use std::path::PathBuf;
use std::sync::Arc;

use vitriol_gpu::{Gpu, Options, PlainLoader};
use vitriol_run::track::key;
use vitriol_run::{Scenes, stage};
use vitriol_shaders::Library;
use vitriol_sim::scene::Preset;
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::monado::{self, Rig};
use vitriol_xr::track::{Keyframes, Track, load};
use vitriol_xr::{PoseFrame, Side};

use crate::headset::drive::{self, Driver, shows};
use crate::headset::program::{self, Program, Seen};

/// The program, which has seen the track's start for some frames, and the track; and where it is recorded.
pub fn begin(rig: &Rig) -> (Driver, Program, PathBuf) {
    let scene = program::scene(rig.folder());
    let recording = rig.folder().join("session.mcap");
    let driver = Driver::start(rig, drive::track());
    let mut program = Program::start(&scene, &recording);
    driver.arrive(&mut program);
    program.frames(10);
    (driver, program, recording)
}

/// Every step is there, once, and the end.
pub fn whole(track: &Track, steps: u64) {
    assert!(!track.recovered);
    assert_eq!(track.frames.len() as u64, steps + 1);
    for (index, frame) in track.frames.iter().enumerate() {
        assert_eq!(frame.step, index as u64);
    }
}

/// How far a frame's head and right hand are from where the track has them: metres, with a quarter
/// turn and a whole squeeze of the hand as far as 10 cm.
fn apart(frame: &PoseFrame, driven: &PoseFrame) -> f32 {
    let (is, was) = (frame.hand(Side::Right), driven.hand(Side::Right));
    let (is_at, was_at) = (is.stage_from_grip, was.stage_from_grip);
    let turned = is_at.orientation.angle_between(was_at.orientation);
    let (head, head_was) = (frame.stage_from_view, driven.stage_from_view);
    is_at.position.distance(was_at.position)
        + head.position.distance(head_was.position)
        + 0.1 * turned / std::f32::consts::FRAC_PI_2
        + 0.1 * (is.squeeze - was.squeeze).abs()
}

/// The recorded hand goes the driven hand's way, in its order.
///
/// Between two display frames it goes straight. At 2.5 m/s², the most on this track, that leaves
/// out a Δt²/8 = 0.8 mm in a tick of the track. The rest is for the turn.
pub fn follows(recorded: &Track, driven: &Keyframes) {
    const STEP: f64 = 0.002;
    const WINDOW: usize = 200;
    let samples: Vec<PoseFrame> = (0..=(driven.duration / STEP) as u32)
        .map(|n| driven.sample(0, f64::from(n) * STEP))
        .collect();
    let (mut at, mut worst) = (0, 0.0_f32);
    for frame in &recorded.frames {
        let hand = frame.hand(Side::Right);
        // The runtime's first frames know of no controller.
        if !(hand.active && hand.valid) {
            assert_eq!(at, 0, "step {}: the hand is gone", frame.step);
            continue;
        }
        // The nearest of what comes next, and never back; of a hand that stands, the last.
        let ahead = &samples[at..samples.len().min(at + WINDOW)];
        let distances: Vec<f32> = ahead.iter().map(|sample| apart(frame, sample)).collect();
        let least = distances.iter().copied().fold(f32::INFINITY, f32::min);
        worst = worst.max(least);
        at += distances.iter().rposition(|d| *d <= least + 1e-5).unwrap();
    }
    eprintln!("off the track by {worst}");
    assert!(worst < 0.01, "off by {worst}");
    assert!(at + 100 > samples.len(), "the end was not seen");
}

/// Each step has the pose of its own time: as far from what was driven into the display frame before
/// it to what was driven into the one after as its time lies between theirs.
pub fn keeps_time(recorded: &Track, seen: &[Seen], sent: &[PoseFrame]) {
    let mut at = 0;
    let mut shown = |frame: &Seen| {
        frame.right.as_ref()?;
        // What it showed before, or what was sent next.
        let next = sent[at..].iter().position(|sent| shows(frame, sent));
        at += next.expect("a frame shows what was not sent");
        Some(&sent[at])
    };
    let frames: Vec<_> = seen
        .iter()
        .map(|frame| (frame.time, shown(frame)))
        .collect();
    let mut around = frames.windows(2).peekable();
    let mut worst = 0.0_f32;
    for frame in &recorded.frames {
        let hand = frame.hand(Side::Right);
        if !(hand.active && hand.valid) {
            continue;
        }
        let time = frame.info.xr_time;
        // Times of a runtime that was started again may begin anew.
        while around
            .next_if(|pair| !(pair[0].0 < time && time <= pair[1].0))
            .is_some()
        {}
        let Some([(before, Some(from)), (after, Some(to))]) = around.peek() else {
            panic!("step {}: no frames around {time} ns", frame.step);
        };
        let s = (time - before) as f64 / (after - before) as f64;
        worst = worst.max(apart(frame, &from.between(to, s as f32)));
    }
    // An angle from the cosine of its half has 5e-4 rad of 32 bits; a frame is some 10 mm.
    assert!(worst < 2e-4, "off by {worst}");
}

/// What a replay came to.
pub struct Replayed {
    pub hash: String,
    /// Highest place of the first flask's base, m.
    pub lifted: f32,
    /// What the two flasks hold at the end, kg.
    pub kept: f64,
    pub poured: f64,
}

/// Replays on a device of its own; every flask must go as it was recorded, bit by bit.
pub fn replay(track: &Track) -> Replayed {
    let gpu = Gpu::open(&mut PlainLoader::default(), &Options::default()).unwrap();
    let library = Arc::new(Library::embedded());
    let mut scenes = Scenes::default();
    scenes.carry(&track.metadata);
    let scene = scenes.get(&track.metadata.scene).unwrap();
    let scene = scene.with_preset(Preset::Balanced);
    let mut world = World::new(&gpu, &library, &scene, track.metadata.seed).unwrap();
    let mut lifted: f32 = 0.0;
    // The last frame is the end and no step.
    for (frame, flasks) in track.frames.iter().zip(&track.stage_from_flasks) {
        if flasks.is_empty() {
            break;
        }
        // What the session did to keep pace with the runtime's display.
        let solver = frame.scenario.iter().filter(|it| it.key == key::SOLVER);
        for (substeps, iterations) in solver.filter_map(|it| it.value.split_once('x')) {
            let effort = [substeps, iterations].map(|number| number.parse().unwrap());
            world.set_effort(effort).unwrap();
        }
        if frame.scenario.iter().any(|it| it.key == key::PLACEMENT) {
            world.hands_leap();
        }
        let hands = stage::input(frame, &scene).hands;
        world.step(&StepInput::of_hands(hands)).unwrap();
        assert_eq!(&stage::flasks(&world), flasks, "step {}", frame.step);
        lifted = lifted.max(flasks[0].position.y);
    }
    let measured = world.measure().unwrap();
    Replayed {
        hash: format!("{:016x}", world.snapshot().unwrap().solver.hash()),
        lifted,
        kept: measured.in_flasks[0],
        poured: measured.in_flasks[1],
    }
}

mod long {
    use super::*;

    #[test]
    fn a_driven_pour_is_seen_recorded_and_replayed() {
        let Some(rig) =
            monado::enter("headset::pour::long::a_driven_pour_is_seen_recorded_and_replayed")
        else {
            return;
        };
        let (mut driver, mut program, recording) = begin(&rig);
        driver.finish(&mut program);
        program.frames(20);
        let (report, seen) = program.end();
        assert_eq!(report["lost_particles"], 0);
        assert_eq!(report["nan_particles"], 0);
        assert_eq!(report["recording"]["unwritten"], 0);

        let track = load(recording.to_str().unwrap()).unwrap();
        whole(&track, report["steps"].as_u64().unwrap());
        follows(&track, &drive::track());
        keeps_time(&track, &seen, &driver.sent);
        let replayed = replay(&track);
        assert_eq!(report["state_hash"], replayed.hash.as_str());
        assert!(replayed.lifted > 0.82, "lifted to {}", replayed.lifted);
        // 150 mL were in it; what a coarse pour spills is no matter here.
        assert!(replayed.poured > 0.05, "{} kg poured", replayed.poured);
    }
}
