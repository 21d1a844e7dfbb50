//! A run: what is done before its steps is recorded with them, and a replay of that is the same run.

use glam::Quat;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_lesson::procedure::Progress;
use vitriol_lesson::{Lesson, Mode};
use vitriol_run::run::TrackRecording;
use vitriol_run::{Action, Judging, Run, Scenes, Setup, on_device};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::World;
use vitriol_tests::gpu;
use vitriol_xr::Pose;
use vitriol_xr::track::{Track, TrackMetadata};

use crate::device::common::{BEFORE, frame};

/// A beaker with 40 mL of water in 320 particles, as a scene's text, with that frame time.
fn text(frame_time: &str) -> String {
    let mut scene = Scene::builtin_text("beaker").unwrap().to_owned();
    for (from, to) in [
        ("spacing = 0.0025", "spacing = 0.005"),
        ("substeps = 10", "substeps = 4"),
        ("particles = 13894", "volume_ml = 40.0"),
        ("frame_time = 0.011111111111111", frame_time),
    ] {
        assert!(scene.contains(from), "{from}");
        scene = scene.replacen(from, to, 1);
    }
    scene
}

const OWN: &str = "frame_time = 0.011111111111111";
const SLOWER: &str = "frame_time = 0.02";

fn world(gpu: &Gpu, frame_time: &str) -> World {
    let scene = Scene::parse(&text(frame_time), "test").unwrap();
    World::new(gpu, &Library::embedded(), &scene, 7).unwrap()
}

fn step(run: &mut Run) {
    // Number and time are the run's.
    let poses = frame(99, Pose::new(BEFORE, Quat::IDENTITY));
    run.step(QueueKind::Main, &poses).unwrap();
}

#[test]
fn steps_are_recorded_with_what_is_done_before_them_and_replay() {
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("x.mcap");
    let metadata = TrackMetadata {
        scene: "a".into(),
        seed: 7,
        scenes: [("a", OWN), ("b", SLOWER)]
            .map(|(name, time)| (name.to_owned(), text(time)))
            .into(),
        ..TrackMetadata::default()
    };
    let mut run = Run::new("a", world(&gpu, OWN));
    run.record(TrackRecording::create(&file, &metadata).unwrap());
    run.act(Action::Leap("here".into())).unwrap();
    step(&mut run);
    step(&mut run);
    run.end_attempt().unwrap();
    run.bring_up(Action::Scene("b".into()), world(&gpu, SLOWER));
    run.act(Action::Solver([5, 2])).unwrap();
    step(&mut run);
    run.end_attempt().unwrap();
    assert_eq!((run.scene(), run.time().steps()), ("b", 3));
    let hash = run.world.snapshot().unwrap().solver.hash();
    let recorded = run.finish_recording(hash).unwrap();
    assert_eq!((recorded.steps, recorded.unwritten), (3, 0));

    let track = Track::open(&file).unwrap();
    assert_eq!(track.outcome["state_hash"], format!("{hash:016x}"));
    let frames = track.frames.iter();
    let said: Vec<_> = frames
        .map(|frame| {
            let values = frame.scenario.iter().map(|it| it.value.as_str());
            (frame.step, frame.time_ns, values.collect::<Vec<_>>())
        })
        .collect();
    // The scene comes before the switches of its settings; the last frame marks the end.
    let expected = [
        (0, 0, vec!["here"]),
        (1, 11_111_111, vec![]),
        (2, 22_222_222, vec!["b", "5x2"]),
        (3, 42_222_222, vec![]),
    ];
    assert_eq!(said, expected);

    let mut scenes = Scenes::default();
    scenes.carry(&track.metadata);
    let scene = scenes.get("a").unwrap();
    let setup = Setup::without_pictures(&scene, ("a", &scenes), Preset::Balanced, 7);
    let mut replay = on_device(&gpu, &setup).unwrap();
    for frame in &track.frames[..3] {
        replay.step(frame).unwrap();
    }
    let outcome = replay.outcome().unwrap();
    assert_eq!(outcome.state_hash, hash);
    assert_eq!(outcome.effort, [5, 2]);
}

/// What is asked of a lesson counts from the next step on, and not for a scene that is brought up before it.
#[test]
fn what_is_asked_of_a_lesson_waits_for_a_step() {
    let gpu = gpu::device();
    let mut run = Run::new("a", world(&gpu, OWN));
    let lesson = Lesson::builtin("dilute").unwrap();
    run.judge(Judging::new(lesson, Mode::Guided, "a"));
    let hint = || Action::Hint(Some("dress".into()));
    let hinted = |run: &Run| -> Vec<f64> {
        let due = run.progress().iter().filter_map(|it| match it {
            Progress::HintDue { t_s, .. } => Some(*t_s),
            _ => None,
        });
        due.collect()
    };
    step(&mut run);
    run.act(hint()).unwrap();
    assert!(run.awaits_step());
    run.end_attempt().unwrap();
    run.bring_up(Action::Start(Some("a".into())), world(&gpu, OWN));
    step(&mut run);
    assert!(!run.awaits_step());
    while run.wait(0).unwrap().is_some() {}
    assert!(hinted(&run).is_empty());
    run.act(hint()).unwrap();
    step(&mut run);
    while run.wait(0).unwrap().is_some() {}
    assert_eq!(hinted(&run), [run.time().seconds()]);
}
