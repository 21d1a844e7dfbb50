//! From a driven track through a session to its recording and that recording's replay.

use crate::vr::common::{Calm, Worn, apart, carried, hash, pour, run};
use crate::vr::seen::keep;
use image::ColorType;
use std::path::Path;
use vitriol_lesson::procedure::Verdict;
use vitriol_lesson::{Language, Lesson, Mode};
use vitriol_session::clock::MOST_STEPS;
use vitriol_session::session::Course;
use vitriol_session::stand_in::EPOCH;
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Preset;
use vitriol_sim::world::{StepInput, World};
use vitriol_tests::gpu;
use vitriol_xr::Side;
use vitriol_xr::track::{Keyframes, Track};

/// Steps a world through a track by hand, as who reads the docs would, and asks that its flasks are
/// where the recording says, bit for bit; the hash of the end.
fn replayed(gpu: &vitriol_gpu::Gpu, track: &Track) -> u64 {
    let scene = carried(track).get(&track.metadata.scene).unwrap();
    let scene = scene.with_preset(Preset::Balanced);
    let library = Library::embedded();
    let mut world = World::new(gpu, &library, &scene, track.metadata.seed).unwrap();
    let steps = track.frames.len() - 1;
    for (frame, flasks) in track
        .frames
        .iter()
        .zip(&track.stage_from_flasks)
        .take(steps)
    {
        let hands = frame.hands.each_ref().map(|hand| Hand {
            stage_from_grip: Pose {
                position: hand.stage_from_grip.position,
                orientation: hand.stage_from_grip.orientation,
            },
            squeeze: hand.squeeze.max(hand.trigger),
            present: hand.active && hand.valid,
        });
        world.step(&StepInput::of_hands(hands)).unwrap();
        assert_eq!(flasks.len(), world.poses().len());
        for (recorded, pose) in flasks.iter().zip(world.poses()) {
            assert_eq!(recorded.position, pose.position, "step {}", frame.step);
            assert_eq!(recorded.orientation, pose.orientation);
        }
    }
    world.snapshot().unwrap().solver.hash()
}

/// Lift, pour, pour slowly, and put down.
pub fn lesson() -> Lesson {
    let step = |id: &str, after: &str, condition: &str| {
        format!(
            "[[step]]\nid = \"{id}\"\nafter = [{after}]\npoints = 10\n[step.condition.{condition}\n"
        )
    };
    let of_source = "flask = \"source\"";
    let poured = "poured]\nfrom = \"source\"\ninto = \"target\"\nat_least_ml = 60";
    let steps = [
        step("lift", "", &format!("lifted]\n{of_source}")),
        step("pour", "\"lift\"", poured),
        // No wrist pours at a millilitre a second.
        step("slowly", "\"lift\"", &format!("{poured}\nat_most_ml_s = 1")),
        step("put-down", "\"pour\"", &format!("put-down]\n{of_source}")),
    ];
    let said = ["lift", "pour", "slowly", "put-down"]
        .map(|id| format!("step.{id}.text = \"Do {id}.\"\nstep.{id}.hint = \"How to {id}.\"\n"));
    let head = "version = 1\nname = \"water\"\nscene = \"small.toml\"\nmodes = [\"free\"]\n";
    let texts = "[texts.en]\ntitle = \"Water\"\nsummary = \"Pour water.\"\n";
    let text = [head, &steps.concat(), texts, &said.concat()].concat();
    Lesson::parse(&text, "water.toml").unwrap()
}

/// What the track does meets the lesson's steps, but for the one that it does too fast.
fn meets_its_lesson(verdict: &Verdict) {
    let met: Vec<_> = verdict.lines.iter().map(|line| line.met).collect();
    assert_eq!(met, [true, true, false, true], "{verdict:#?}");
    assert_eq!((verdict.points, verdict.of), (30, 40));
    // Too fast, and then not done until the end.
    assert_eq!(verdict.lines[2].failures, 2);
    // By the keyframes: it is gripped at 0.8 s, poured until 6.7 s and let go of at 9.4 s.
    let at = |line: usize| verdict.lines[line].evidence_s.unwrap();
    assert!((0.7..1.0).contains(&at(0)), "{}", at(0));
    assert!((3.0..7.5).contains(&at(1)), "{}", at(1));
    // It has stood for half a second then.
    assert!((9.3..10.1).contains(&at(3)), "{}", at(3));
}

#[test]
fn a_slow_display_is_shown_in_slow_motion_and_never_more_steps() {
    let gpu = gpu::device();
    // Nine steps would be due in each frame.
    let mut headset = Worn::new(&gpu, pour().sample_track(), 10.0, 12, Calm);
    let (outcome, track) = run(&mut headset, |_| ());
    assert_eq!(outcome.steps, u64::from(MOST_STEPS) * 11);
    let shown = 11.0 / 10.0;
    // Display times are whole nanoseconds.
    assert!((outcome.simulated + outcome.slowed - shown).abs() < 1e-6);
    // The hands went all their way: the last step is at the last frame's time.
    let last = &track.frames[track.frames.len() - 2];
    assert_eq!(last.info.xr_time, EPOCH + 1_100_000_000);
    assert_eq!(replayed(&gpu, &track), hash(&outcome));
}

#[test]
fn what_is_shown_is_what_was_drawn() {
    let gpu = gpu::device();
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, 20, Calm);
    run(&mut headset, |_| ());
    assert_eq!(headset.shown.len(), 20);
    let targets = &headset.inner.targets;
    let colour: Vec<u8> = gpu::read_back(&gpu, &targets.colour).get().unwrap();
    let depth = targets.depth.as_ref().unwrap();
    let depth: Vec<f32> = gpu::read_back(&gpu, depth).get().unwrap();
    // Down there is the bench, some half a metre away; both eyes see something, each its own.
    let eyes: Vec<&[u8]> = colour.chunks_exact(4 * 96 * 64).collect();
    assert_ne!(eyes[0], eyes[1]);
    for (eye, picture) in eyes.iter().enumerate() {
        let lit = picture.chunks_exact(4).filter(|p| p[0] > 20).count();
        assert!(lit > 96 * 64 / 2, "eye {eye}: {lit} pixels");
        let middle = depth[eye * 48 * 32 + 20 * 48 + 24];
        let distance = headset.shown[0].near / middle;
        assert!((0.3..1.0).contains(&distance), "eye {eye}: {distance} m");
        // The hidden corner is nearest, and black.
        assert_eq!(depth[eye * 48 * 32], 1.0);
        assert_eq!(picture[..3], [0, 0, 0]);
    }
    keep("stand-in", [96, 128], &colour, ColorType::Rgba8);
}

mod long {
    use super::*;

    #[test]
    fn a_poured_flask_is_recorded_and_replays() {
        let gpu = gpu::device();
        // A moment longer, in which the flask stands.
        let last = "{ t = 9.6, position = [-0.084, 0.845, -0.330] },";
        let text = vitriol_xr::track::builtin::text("two-flasks").unwrap();
        let longer = text.replace(last, &format!("{last}\n  {{ t = 10.2 }},"));
        let longer = longer.replace("duration = 9.6", "duration = 10.2");
        assert_eq!(longer.matches("10.2").count(), 2);
        let keyframes = Keyframes::parse(&longer, Path::new("longer.toml")).unwrap();
        // Three steps in each frame, the last ones of the track included.
        let mut headset = Worn::new(&gpu, keyframes.sample_track(), 30.0, 306, Calm);
        let course = Course {
            lesson: lesson(),
            mode: Mode::Free,
            language: Language::En,
        };
        let (outcome, track) = run(&mut headset, |options| options.course = Some(course));
        meets_its_lesson(outcome.verdict.as_ref().unwrap());
        assert_eq!(outcome.steps, 3 * 305);
        assert_eq!(outcome.slowed, 0.0);

        // It was poured: 150 mL were in the first.
        let measured = outcome.world.measure().unwrap();
        let [source, target] = measured.in_flasks[..] else {
            panic!("two flasks");
        };
        assert!(target > 0.8 * (source + target), "{source} {target}");
        assert_eq!(measured.lost_particles, 0);
        // And the flask was put back to where it stood, and let go.
        let stood = outcome.world.scene().flasks[0].stage_from_flask;
        let stands = outcome.world.poses()[0];
        assert!((stands.position - stood.position).length() < 5e-3);
        assert_eq!(outcome.world.holder(0), None);

        // Each step has the poses of its own time. Between two frames of the display, 33 ms apart,
        // hands that speed up by 10 m/s², as at the end, leave the straight line by 10 · 0.033²/8 =
        // 1.4 mm.
        for (n, frame) in track.frames.iter().enumerate() {
            assert_eq!(frame.step, n as u64);
            let driven = keyframes.sample(0, 1e-9 * (frame.info.xr_time - EPOCH) as f64);
            for side in Side::BOTH {
                let (found, expected) = (frame.hand(side), driven.hand(side));
                assert_eq!(found.active, expected.active);
                let (m, rad) = apart(&found.stage_from_grip, &expected.stage_from_grip);
                assert!(m < 1.5e-3 && rad < 0.02, "step {n}: {m} m, {rad} rad");
                assert!((found.squeeze - expected.squeeze).abs() < 0.1);
            }
            let (m, _) = apart(&frame.stage_from_view, &driven.stage_from_view);
            assert!(m < 1e-3, "step {n}: {m} m");
        }
        assert_eq!(replayed(&gpu, &track), hash(&outcome));
    }
}
