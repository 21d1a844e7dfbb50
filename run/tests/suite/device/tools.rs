//! Tools in a hand, look by look: what a lesson judges is met by a track that does it, and missed by one that leaves it out.

use std::path::Path;

use vitriol_gpu::QueueKind;
use vitriol_lesson::procedure::{Progress, Verdict};
use vitriol_lesson::{Lesson, Mode, Procedure, Sight};
use vitriol_run::{Action, Looks, stage};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Feature, Scene};
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

/// What is seen behind each step of a track, which is sampled once a step of the scene.
fn go_through(track: &str, scene: &Scene, mut each: impl FnMut(&Sight, &[vitriol_lesson::Event])) {
    let gpu = gpu::device();
    let rate = format!("rate_hz = {:.0}", scene.scale.frame_time.recip());
    let track = track.replace("rate_hz = 90", &rate);
    let track = Keyframes::parse(&track, Path::new("track.toml")).unwrap();
    let track = track.sample_track();
    let mut world = World::new(&gpu, &Library::embedded(), scene, 1).unwrap();
    let mut looks = Looks::of(&scene.name, scene);
    let mut t = 0.0;
    for frame in &track.frames {
        let near = stage::near_from_stage(frame, scene);
        let input = stage::input(frame, scene);
        world.step(&input).unwrap();
        let before = t;
        t += scene.scale.frame_time;
        looks
            .look(&mut world, QueueKind::Main, &near, [before, t])
            .unwrap();
        while let Some(looked) = looks.wait().unwrap() {
            each(&looked.sight, &looked.events);
        }
    }
    each(&Sight::default(), &looks.end());
}

/// What a track spells beside its poses, with its times, s.
fn actions(track: &str) -> Vec<(f64, Action)> {
    let track = Keyframes::parse(track, Path::new("track.toml")).unwrap();
    let frames = track.sample_track().frames.into_iter();
    let spelt = frames.flat_map(|frame| {
        let t = frame.time_ns as f64 * 1e-9;
        frame.scenario.into_iter().map(move |switch| (t, switch))
    });
    spelt
        .filter_map(|(t, switch)| Some((t, Action::of(&switch).unwrap()?)))
        .collect()
}

fn judged(track: &str) -> (Verdict, Vec<Progress>) {
    let lesson = Lesson::builtin("emergency").unwrap();
    judged_by((lesson, Mode::Guided), track, &scene())
}

fn judged_by(
    (lesson, mode): (Lesson, Mode),
    track: &str,
    scene: &Scene,
) -> (Verdict, Vec<Progress>) {
    let mut judge = Procedure::new(lesson, mode);
    let mut last = Sight::default();
    let mut said = Vec::new();
    let mut actions = actions(track).into_iter().peekable();
    go_through(track, scene, |sight, events| {
        if !sight.flasks.is_empty() {
            last.clone_from(sight);
        }
        while let Some((_, action)) = actions.next_if(|(t, _)| *t <= last.t_s) {
            if let Action::Answer {
                step: Some(step),
                answer,
            } = action
            {
                said.extend(judge.answer(&step, answer, last.t_s));
            }
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

/// The fume hood's scene, coarse and changed, and its user dressed.
fn hood(change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = Scene::builtin("fume-hood").unwrap();
    scene.scale.spacing = 0.007;
    scene.scale.frame_time = 1.0 / 30.0;
    scene.tools.iter_mut().for_each(|tool| tool.worn = true);
    change(&mut scene);
    scene
}

/// The bar is 0.5 m over the bench, and down to 0.35 m is asked for: a hand that goes down by 0.2 m does it, by 0.1 m does not.
#[test]
fn a_sash_is_pulled_down_or_not_far_enough() {
    let scene = hood(|scene| scene.liquids.truncate(1));
    for (down, expected) in [(0.2, &["dress", "sash"][..]), (0.1, &["dress"])] {
        let track = format!(
            "
name = \"sash\"
duration = 2.0
rate_hz = 90
head = [ {{ t = 0.0, position = [0.0, 1.2, 0.0] }} ]
right = [ {{ t = 0.0, position = [0.1, 0.9, 0.0] }} ]
left = [
  {{ t = 0.0, position = [-0.2, 1.26, -0.11] }},
  {{ t = 0.2, squeeze = 1.0 }},
  {{ t = 1.2, position = [-0.2, {}, -0.11] }},
  {{ t = 1.4, squeeze = 0.0 }},
]
",
            1.26 - down
        );
        let lesson = Lesson::builtin("examination").unwrap();
        let (_, said) = judged_by((lesson, Mode::Examination), &track, &scene);
        assert_eq!(done(&said), expected, "{said:#?}");
    }
}

/// A lesson whose steps wait for no other.
fn in_any_order(name: &str) -> Lesson {
    let text = Lesson::builtin_text(name).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with("after = "));
    let text: String = lines.flat_map(|line| [line, "\n"]).collect();
    Lesson::parse(&text, "any-order.toml").unwrap()
}

/// Rod and thermometer, one in each hand, are dipped 4 cm over the bench into 160 mL, or held over them; and the beaker with acid is lifted and put down. What
/// the beaker holds is of the right concentration, or is not.
fn handling(dip: f64) -> String {
    let mut stirred = String::new();
    for n in 0..16 {
        let [x, z] = [[0.12, -0.38], [0.10, -0.40], [0.12, -0.42], [0.14, -0.40]][n % 4];
        let t = 3.6 + 0.25 * n as f64;
        stirred += &format!("{{ t = {t:.2}, position = [{x}, {dip}, {z}], ease = \"linear\" }},\n");
    }
    format!(
        "
name = \"handling\"
duration = 13.0
rate_hz = 90
head = [ {{ t = 0.0, position = [0.0, 1.2, 0.0] }} ]
left = [
  {{ t = 0.0, position = [0.30, 0.90, -0.46] }},
  {{ t = 0.6, position = [0.30, 0.757, -0.46] }},
  {{ t = 0.8, squeeze = 1.0 }},
  {{ t = 1.4, position = [0.30, 1.0, -0.46] }},
  {{ t = 2.6, position = [0.14, 1.14, -0.40], rotation = {{ roll = -90 }} }},
  {{ t = 3.4, position = [0.14, {dip}, -0.40] }},
  {stirred}
  {{ t = 8.4, position = [0.14, 1.14, -0.40] }},
]
right = [
  {{ t = 0.0, position = [0.30, 0.90, -0.54] }},
  {{ t = 0.6, position = [0.30, 0.756, -0.54] }},
  {{ t = 0.8, squeeze = 1.0 }},
  {{ t = 1.4, position = [0.30, 1.0, -0.54] }},
  {{ t = 2.6, position = [0.12, 1.14, -0.40], rotation = {{ roll = -90 }} }},
  {{ t = 3.4, position = [0.12, {dip}, -0.40] }},
  {{ t = 7.6, position = [0.12, {dip}, -0.40] }},
  {{ t = 8.4, position = [0.12, 1.14, -0.40] }},
  {{ t = 9.2, position = [0.30, 1.0, -0.54], rotation = {{ roll = 0 }} }},
  {{ t = 9.6, position = [0.30, 0.80, -0.54] }},
  {{ t = 9.8, squeeze = 0.0 }},
  {{ t = 10.8, position = [-0.084, 0.845, -0.40] }},
  {{ t = 11.0, squeeze = 1.0 }},
  {{ t = 11.5, position = [-0.084, 0.90, -0.40] }},
  {{ t = 12.0, position = [-0.084, 0.845, -0.40] }},
  {{ t = 12.2, squeeze = 0.0 }},
]
"
    )
}

#[test]
fn what_hands_do_with_tools_and_glass_is_judged() {
    let diluted = |acid: f64| {
        hood(|scene| {
            scene.liquids.remove(0);
            scene.liquids[0].acid_fraction = acid;
            scene.liquids[0].volume = 175e-6;
        })
    };
    let cases = [
        (
            0.995,
            0.18,
            &["dress", "concentration", "stir", "measure"][..],
        ),
        (1.10, 0.25, &["dress"]),
    ];
    for (dip, acid, expected) in cases {
        let free = (in_any_order("dilute"), Mode::Free);
        let (_, said) = judged_by(free, &handling(dip), &diluted(acid));
        let done = done(&said);
        for id in ["dress", "stir", "measure", "concentration"] {
            assert_eq!(done.contains(&id), expected.contains(&id), "{id}: {done:?}");
        }
        // Both tracks do that.
        assert!(
            done.contains(&"lift") && done.contains(&"put-down"),
            "{done:?}"
        );
    }
}

/// 30 °C and more are asked for in the target.
#[test]
fn a_temperature_is_met_and_missed() {
    let track = "
name = \"still\"
duration = 0.5
rate_hz = 90
head = [ { t = 0.0, position = [0.0, 1.2, 0.0] } ]
right = [ { t = 0.0, position = [0.1, 0.9, 0.0] } ]
left = [ { t = 0.0, position = [-0.1, 0.9, 0.0] } ]
";
    for (celsius, met) in [(35.0, true), (25.0, false)] {
        let scene = hood(|scene| {
            scene.liquids.remove(0);
            scene.liquids[0].temperature = celsius;
        });
        let free = (in_any_order("wrong-order"), Mode::Free);
        let (_, said) = judged_by(free, track, &scene);
        assert_eq!(done(&said).contains(&"heat"), met, "{celsius}: {said:?}");
    }
}

mod long {
    use super::*;

    #[test]
    fn an_emergency_is_met_as_it_should_be() {
        let (verdict, said) = judged(builtin::text("emergency").unwrap());
        let all = ["rinse-glove", "glove-off", "rinse-hand", "put-down", "wipe"];
        assert_eq!(done(&said), all, "{said:#?}");
        assert_eq!((verdict.points, verdict.of), (100, 100), "{verdict:#?}");
    }

    /// By its own track, with few particles and without what boils: each step is done while it is asked for, and none fails.
    #[test]
    fn the_lesson_of_hot_acid_is_gone_through_by_its_track() {
        let mut scene = Scene::builtin("hot-acid").unwrap();
        for feature in [Feature::Evaporation, Feature::Losses, Feature::Segregation] {
            (scene, _) = scene.without(feature);
        }
        scene.scale.spacing = 0.008;
        scene.solver.substeps = 3;
        scene.solver.iterations = 1;
        let lesson = Lesson::builtin("wrong-order-hot").unwrap();
        let track = builtin::text("wrong-order-hot").unwrap();
        let (verdict, said) = judged_by((lesson, Mode::Guided), track, &scene);
        let all = [
            "dress", "predict", "lift", "pour", "put-down", "observe", "explain", "look",
        ];
        assert_eq!(done(&said), all, "{said:#?}");
        assert_eq!((verdict.points, verdict.of), (100, 100), "{verdict:#?}");
    }

    /// The hands of its own track, over water alone: acid that is poured so slowly needs more particles than a test has time for.
    #[test]
    fn the_track_of_the_dilution_handles_its_tools() {
        let mut scene = Scene::builtin("acid-into-water").unwrap();
        scene.liquids.remove(0);
        for feature in [Feature::Evaporation, Feature::Losses, Feature::Segregation] {
            (scene, _) = scene.without(feature);
        }
        scene.scale.spacing = 0.009;
        scene.scale.frame_time = 1.0 / 30.0;
        scene.solver.substeps = 6;
        scene.solver.iterations = 1;
        let free = (in_any_order("dilute"), Mode::Free);
        let track = builtin::text("dilute").unwrap();
        let (_, said) = judged_by(free, track, &scene);
        let done = done(&said);
        for id in ["dress", "lift", "stir", "put-down", "measure", "wipe"] {
            assert!(done.contains(&id), "{id}: {done:?}");
        }
        // The first portion's stirring, which is over before the second one is poured.
        let stirred = said.iter().find_map(|it| match it {
            Progress::StepDone { id, evidence_s, .. } if id == "stir" => Some(*evidence_s),
            _ => None,
        });
        assert!((25.0..30.0).contains(&stirred.unwrap()), "{stirred:?}");
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
}
