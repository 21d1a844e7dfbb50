//! A pour, seen through OpenXR, recorded and replayed.

use std::sync::Arc;
use std::time::Duration;

use vitriol::experiment;
use vitriol_gpu::{Gpu, Options, PlainLoader};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::monado;
use vitriol_xr::track::{Keyframes, Track, load};
use vitriol_xr::{PoseFrame, Side};

use crate::drive::{self, Driver};
use crate::program::{self, Program};

/// Share of its speed at which the track is driven: so much slower is the software driver.
const SPEED: f64 = 0.5;

#[test]
fn a_driven_pour_is_seen_recorded_and_replayed() {
    let Some(rig) = monado::enter("pour::a_driven_pour_is_seen_recorded_and_replayed") else {
        return;
    };
    let scene = program::scene(rig.folder());
    let recording = rig.folder().join("pour.mcap");
    let driver = Driver::start(&rig, drive::track(), SPEED);
    let program = Program::start(&scene, &recording);
    program.says("Focused");
    std::thread::sleep(Duration::from_secs(1));
    driver.go();
    driver.wait();
    std::thread::sleep(Duration::from_secs(2));
    let report = program.end();
    assert_eq!(report["lost_particles"], 0);
    assert_eq!(report["nan_particles"], 0);
    assert_eq!(report["recording"]["unwritten"], 0);

    let track = load(recording.to_str().unwrap()).unwrap();
    whole(&track, report["steps"].as_u64().unwrap());
    follows(&track, &drive::track());
    let replayed = replay(&track);
    assert_eq!(report["state_hash"], replayed.hash.as_str());
    assert!(replayed.lifted > 0.85, "lifted to {}", replayed.lifted);
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

/// How far a frame's right hand is from where the track has it at `t`: metres, with a quarter
/// turn and a whole squeeze as far as 10 cm.
fn apart(frame: &PoseFrame, driven: &PoseFrame) -> f32 {
    let (is, was) = (frame.hand(Side::Right), driven.hand(Side::Right));
    let (is_at, was_at) = (is.stage_from_grip, was.stage_from_grip);
    let turned = is_at.orientation.angle_between(was_at.orientation);
    is_at.position.distance(was_at.position)
        + 0.1 * turned / std::f32::consts::FRAC_PI_2
        + 0.1 * (is.squeeze - was.squeeze).abs()
}

/// The recorded hand goes the driven hand's way, in its order and at its pace.
pub fn follows(recorded: &Track, driven: &Keyframes) {
    const STEP: f64 = 0.002;
    let samples: Vec<PoseFrame> = (0..=(driven.duration / STEP) as u32)
        .map(|n| driven.sample(0, f64::from(n) * STEP))
        .collect();
    let mut at = 0;
    let mut worst: f32 = 0.0;
    let mut pace = Vec::new();
    for frame in &recorded.frames {
        let hand = frame.hand(Side::Right);
        // The runtime's first frames know of no controller.
        if !(hand.active && hand.valid) {
            assert_eq!(at, 0, "step {}: the hand is gone", frame.step);
            continue;
        }
        // The nearest within what a frame's gap can leave out, and never back.
        let ahead = samples[at..].iter().take((0.4 / STEP) as usize);
        let distances = ahead.map(|sample| apart(frame, sample)).enumerate();
        let (past, distance) = distances.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        at += past;
        worst = worst.max(distance);
        let t = at as f64 * STEP;
        pace.push((frame.info.xr_time as f64 * 1e-9, t));
        let head = frame.stage_from_view.position;
        let wanted = samples[at].stage_from_view.position;
        assert!(head.distance(wanted) < 0.02, "step {}: {head}", frame.step);
    }
    eprintln!("worst {worst}, through to {}", at as f64 * STEP);
    assert!(
        at as f64 * STEP > driven.duration - 0.2,
        "the end was not seen"
    );
    let _ = pace;
    assert!(worst < 0.01, "{worst}");
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
        let length = scene.scale.length_scale;
        let hands = frame
            .hands
            .each_ref()
            .map(|hand| experiment::grip(hand, length));
        world.step(&StepInput { hands }).unwrap();
        assert_eq!(&experiment::flasks(&world), flasks, "step {}", frame.step);
        lifted = lifted.max(flasks[0].position.y);
    }
    let measured = world.measure().unwrap();
    Replayed {
        hash: format!("{:016x}", world.snapshot().unwrap().solver.hash()),
        lifted,
        poured: measured.in_flasks[1],
    }
}
