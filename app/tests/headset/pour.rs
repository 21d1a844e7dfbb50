//! A pour, seen through OpenXR, recorded and replayed.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use vitriol_experiment::stage;
use vitriol_experiment::switches::SWITCH_SOLVER;
use vitriol_gpu::{Gpu, Options, PlainLoader};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::monado::{self, Rig};
use vitriol_xr::track::{Keyframes, Track, load};
use vitriol_xr::{PoseFrame, Side};

use crate::drive::{self, Driver};
use crate::program::{self, Program};

/// Share of its speed at which the track is driven: so much slower is the software driver.
pub const SPEED: f64 = 0.5;

/// The program, seen to have the runtime's focus, and the track that is driven from now on; and where it is recorded.
pub fn begin(rig: &Rig) -> (Driver, Program, PathBuf) {
    let scene = program::scene(rig.folder());
    let recording = rig.folder().join("session.mcap");
    let driver = Driver::start(rig, drive::track(), SPEED);
    let program = Program::start(&scene, &recording);
    program.says("Focused");
    std::thread::sleep(Duration::from_secs(1));
    driver.go();
    (driver, program, recording)
}

#[test]
fn a_driven_pour_is_seen_recorded_and_replayed() {
    let Some(rig) = monado::enter("pour::a_driven_pour_is_seen_recorded_and_replayed") else {
        return;
    };
    let (driver, program, recording) = begin(&rig);
    driver.wait();
    std::thread::sleep(Duration::from_secs(2));
    let report = program.end();
    assert_eq!(report["lost_particles"], 0);
    assert_eq!(report["nan_particles"], 0);
    assert_eq!(report["recording"]["unwritten"], 0);

    let track = load(recording.to_str().unwrap()).unwrap();
    whole(&track, report["steps"].as_u64().unwrap());
    keeps_pace(follows(&track, &drive::track()));
    let replayed = replay(&track);
    assert_eq!(report["state_hash"], replayed.hash.as_str());
    assert!(replayed.lifted > 0.82, "lifted to {}", replayed.lifted);
    // 150 mL were in it; what a coarse pour spills is no matter here.
    assert!(replayed.poured > 0.05, "{} kg poured", replayed.poured);
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

/// The recorded hand goes the driven hand's way, in its order. Gives for each step at which the
/// hand moves where the track's time is 0 on the runtime's clock, s.
///
/// Between two display frames it goes straight. At 2.5 m/s², the most on this track, that leaves
/// out a Δt²/8 = 3 mm in Δt = 0.1 s of the track, which is 4 frames of 20 Hz at half speed: more
/// than any two frames lay apart on two busy cores. The rest is for the turn.
pub fn follows(recorded: &Track, driven: &Keyframes) -> Vec<f64> {
    const STEP: f64 = 0.002;
    const WINDOW: usize = 200;
    let samples: Vec<PoseFrame> = (0..=(driven.duration / STEP) as u32)
        .map(|n| driven.sample(0, f64::from(n) * STEP))
        .collect();
    let (mut at, mut worst) = (0, 0.0_f32);
    let mut zeros = Vec::new();
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
        let sample = &samples[at];
        let next = &samples[(at + 1).min(samples.len() - 1)];
        if f64::from(apart(sample, next)) > 0.1 * STEP {
            zeros.push(1e-9 * frame.info.xr_time as f64 - at as f64 * STEP / SPEED);
        }
    }
    assert!(worst < 0.01, "off by {worst}");
    assert!(at + 100 > samples.len(), "the end was not seen");
    zeros
}

/// It goes at the driven hand's pace. The runtime does not predict what it is driven by, and its
/// frames come in whole periods: the hand is as late as the frame, two periods more or less. A step
/// that took its pose from another time would drift away.
fn keeps_pace(mut zeros: Vec<f64>) {
    zeros.sort_by(f64::total_cmp);
    let middle = zeros[zeros.len() / 2];
    let near = zeros.iter().filter(|zero| (*zero - middle).abs() < 0.1);
    assert!(near.count() * 10 > zeros.len() * 9, "{zeros:?}");
}

/// What a replay came to.
pub struct Replayed {
    pub hash: String,
    /// Highest place of the first flask's base, m.
    pub lifted: f32,
    /// What the second flask holds at the end, kg.
    pub poured: f64,
}

/// Replays on a device of its own; every flask must go as it was recorded, bit by bit.
pub fn replay(track: &Track) -> Replayed {
    let gpu = Gpu::open(&mut PlainLoader::default(), &Options::default()).unwrap();
    let library = Arc::new(Library::embedded());
    let scene = Scene::load(&track.metadata.scene)
        .unwrap()
        .with_preset(Preset::Balanced);
    let mut world = World::new(&gpu, &library, &scene, track.metadata.seed).unwrap();
    let mut lifted: f32 = 0.0;
    // The last frame is the end and no step.
    for (frame, flasks) in track.frames.iter().zip(&track.stage_from_flasks) {
        if flasks.is_empty() {
            break;
        }
        // What the session did to keep pace with the runtime's display.
        let solver = frame.scenario.iter().filter(|it| it.key == SWITCH_SOLVER);
        for (substeps, iterations) in solver.filter_map(|it| it.value.split_once('x')) {
            let effort = [substeps, iterations].map(|number| number.parse().unwrap());
            world.set_effort(effort).unwrap();
        }
        let hands = stage::hands(&frame.hands, &scene);
        world.step(&StepInput { hands }).unwrap();
        assert_eq!(&stage::flasks(&world), flasks, "step {}", frame.step);
        lifted = lifted.max(flasks[0].position.y);
    }
    let measured = world.measure().unwrap();
    Replayed {
        hash: format!("{:016x}", world.snapshot().unwrap().solver.hash()),
        lifted,
        poured: measured.in_flasks[1],
    }
}
