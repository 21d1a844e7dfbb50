//! Tools in a hand, look by look: what a lesson judges is met by a track that does it, and missed by one that leaves it out.

use std::path::Path;

use vitriol_experiment::{Looks, stage};
use vitriol_gpu::QueueKind;
use vitriol_lesson::procedure::{Progress, Verdict};
use vitriol_lesson::{Lesson, Mode, Procedure, Sight};
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::World;
use vitriol_tests::gpu;
use vitriol_xr::track::{Keyframes, builtin};

/// The emergency's scene with few and large particles and long steps: where the water goes is all that counts.
fn scene() -> Scene {
    let mut scene = Scene::builtin("acid-on-glove").unwrap();
    scene.scale.spacing = 0.005;
    scene.scale.frame_time = 1.0 / 30.0;
    scene.solver.substeps = 10;
    scene
}

/// What is seen behind each step of a track.
fn go_through(track: &str, scene: &Scene, mut each: impl FnMut(&Sight, &[vitriol_lesson::Event])) {
    let gpu = gpu::device();
    let track = track.replace("rate_hz = 90", "rate_hz = 30");
    let track = Keyframes::parse(&track, Path::new("track.toml")).unwrap();
    let track = track.sample_track();
    let mut world = World::new(&gpu, &Library::embedded(), scene, 1).unwrap();
    let mut looks = Looks::of(&scene.name, scene);
    let mut t = 0.0;
    for frame in &track.frames {
        let input = stage::input(frame, scene);
        world.step(&input).unwrap();
        t += scene.scale.frame_time;
        looks.look(&mut world, QueueKind::Main, frame, t).unwrap();
        while let Some(looked) = looks.wait().unwrap() {
            each(&looked.sight, &looked.events);
        }
    }
    each(&Sight::default(), &looks.end());
}

fn judged(track: &str) -> (Verdict, Vec<Progress>) {
    let lesson = Lesson::builtin("emergency").unwrap();
    let mut judge = Procedure::new(lesson, Mode::Guided);
    let mut last = Sight::default();
    let mut said = Vec::new();
    go_through(track, &scene(), |sight, events| {
        if !sight.flasks.is_empty() {
            last.clone_from(sight);
        }
        said.extend(judge.advance(&last, events));
    });
    (judge.verdict(), said)
}

fn done(said: &[Progress]) -> Vec<&str> {
    let done = said.iter().filter_map(|it| match it {
        Progress::StepDone { id, .. } => Some(id.as_str()),
        _ => None,
    });
    done.collect()
}

#[test]
fn an_emergency_is_met_as_it_should_be() {
    let (verdict, said) = judged(builtin::text("emergency").unwrap());
    let all = ["rinse-glove", "glove-off", "rinse-hand", "put-down", "wipe"];
    assert_eq!(done(&said), all, "{said:#?}");
    assert_eq!((verdict.points, verdict.of), (100, 100), "{verdict:#?}");
}

/// Who keeps the glove on rinses no hand, however much water comes.
#[test]
fn a_glove_that_stays_on_is_missed() {
    let text = builtin::text("emergency").unwrap();
    let pulls = "{ t = 7.2, squeeze = 1.0 },";
    assert_eq!(text.matches(pulls).count(), 1);
    let (verdict, said) = judged(&text.replace(pulls, "{ t = 7.2 },"));
    assert_eq!(done(&said), ["rinse-glove"], "{said:#?}");
    // 25 of 85, and as much of the rules' 10 and 5.
    assert_eq!(verdict.points, 25 + 2 + 1);
}

/// Goggles and gloves lie there at first. They are put on one after the other.
#[test]
fn who_dresses_is_seen_to() {
    let mut scene = scene();
    scene.liquids.retain(|liquid| liquid.acid_fraction > 0.0);
    scene.tools.iter_mut().for_each(|tool| tool.worn = false);
    let track = "
name = \"dress\"
duration = 4.0
rate_hz = 90
head = [ { t = 0.0, position = [0.0, 1.2, 0.0] } ]
right = [
  { t = 0.0, position = [-0.40, 0.79, -0.22] },
  { t = 0.4, position = [-0.40, 0.79, -0.28] },
  { t = 0.5, squeeze = 1.0 },
  { t = 1.3, position = [0.0, 1.17, -0.02] },
  { t = 1.4, squeeze = 0.0 },
  { t = 2.2, position = [-0.42, 0.86, -0.52] },
  { t = 2.3, squeeze = 1.0 },
  { t = 2.5, squeeze = 0.0 },
  { t = 3.0, position = [0.1, 0.86, -0.3] },
]
left = [
  { t = 0.0, position = [-0.10, 0.9, -0.3] },
  { t = 2.6, position = [-0.15, 0.9, -0.3] },
  { t = 3.2, position = [-0.45, 0.85, -0.48] },
  { t = 3.3, squeeze = 1.0 },
]
";
    let mut seen = Vec::new();
    go_through(track, &scene, |sight, _| {
        if let (Some(goggles), Some(gloves)) = (sight.goggles, sight.gloves)
            && seen.last().map(|&(_, it)| it) != Some([goggles, gloves[0], gloves[1]])
        {
            seen.push((sight.t_s, [goggles, gloves[0], gloves[1]]));
        }
    });
    let states: Vec<_> = seen.iter().map(|(_, it)| *it).collect();
    let expected = [
        [false; 3],
        [true, false, false],
        [true, false, true],
        [true; 3],
    ];
    assert_eq!(states, expected, "{seen:?}");
    let when = |n: usize, from: f64, to: f64| {
        assert!((from..to).contains(&seen[n].0), "{seen:?}");
    };
    when(1, 1.3, 1.5);
    when(2, 2.2, 2.4);
    when(3, 3.2, 3.4);
}
