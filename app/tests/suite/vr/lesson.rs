//! A session that goes through a lesson: what is said of it is in the recording, with what its user asked for, and a replay that judges
//! the lesson says the same.

use std::path::Path;
use std::sync::mpsc::{Sender, channel};

use crate::vr::common::{Trouble, Worn, hash, options, pour, session_with};
use crate::vr::loss::judged;
use crate::vr::pour::lesson;
use vitriol_gpu::Gpu;
use vitriol_lesson::procedure::{Progress, Verdict, Why};
use vitriol_lesson::{Language, Lesson, Mode};
use vitriol_run::{Action, Judging};
use vitriol_session::decision::Decision;
use vitriol_session::session::{Course, SessionOutcome};
use vitriol_session::stand_in::StandIn;
use vitriol_tests::gpu;
use vitriol_xr::Turn;
use vitriol_xr::track::Track;

/// Presses keys, each before a frame.
struct Presses {
    keys: Sender<Decision>,
    acts: Vec<(u64, Action)>,
}

impl Trouble for Presses {
    fn turn(&mut self, _: &mut StandIn, after: u64) -> Option<Turn> {
        for (_, act) in self.acts.iter().filter(|(frame, _)| *frame == after) {
            self.keys.send(Decision::Act(act.clone())).unwrap();
        }
        None
    }
}

/// A session of so many frames, 30 a second, of who pours as the track does and presses these keys.
fn taught(
    gpu: &Gpu,
    folder: &Path,
    (lesson, mode): (&Lesson, Mode),
    frames: u64,
    acts: &[(u64, Action)],
) -> (SessionOutcome, Track) {
    let (keys, decisions) = channel();
    let acts = acts.to_vec();
    let trouble = Presses { keys, acts };
    let mut headset = Worn::new(gpu, pour().sample_track(), 30.0, frames, trouble);
    let mut options = options(folder);
    options.course = Some(Course {
        lesson: lesson.clone(),
        mode,
        language: Language::De,
    });
    session_with(&mut headset, options, decisions)
}

/// What the recording says of the lesson; a replay that judges it says the same, to the bit, and ends in the same state.
fn said_and_replayed(
    gpu: &Gpu,
    outcome: &SessionOutcome,
    track: Track,
    (lesson, mode): (&Lesson, Mode),
) -> Vec<Progress> {
    let said = track.progress.iter();
    let said: Vec<Progress> = said
        .map(|(_, json)| serde_json::from_str(json).unwrap())
        .collect();
    let scene = track.metadata.scene.clone();
    let replay = judged(gpu, track, Judging::new(lesson.clone(), mode, &scene));
    assert_eq!(replay.progress, said);
    assert_eq!(replay.state_hash, hash(outcome));
    let verdict = outcome.verdict.clone().unwrap();
    assert_eq!(Verdict::retold(lesson, mode, &said), [verdict]);
    said
}

fn asked(track: &Track) -> Vec<Action> {
    let switches = track.frames.iter().flat_map(|frame| &frame.scenario);
    let actions = switches.filter_map(|it| Action::of(it).unwrap());
    actions.filter(Action::is_of_lesson).collect()
}

#[test]
fn hint_and_skip_are_recorded_and_replay() {
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let acts = [
        (5, Action::Hint(None)),
        // It is shown already, and a guided lesson has no such button.
        (8, Action::Hint(None)),
        (10, Action::Finish),
        (12, Action::Skip(None)),
        // It comes with the last frame.
        (39, Action::Skip(None)),
    ];
    let (outcome, track) = taught(&gpu, folder.path(), (&lesson(), Mode::Guided), 41, &acts);
    let step = |id: &str| Some(id.to_owned());
    let expected = [
        Action::Hint(step("lift")),
        Action::Skip(step("lift")),
        Action::Skip(step("pour")),
    ];
    assert_eq!(asked(&track), expected);
    let made = &track.metadata.parameters;
    let of_lesson = ["lesson", "lesson_hash", "mode", "language"].map(|key| made[key].as_str());
    assert_eq!(of_lesson, ["water", lesson().hash(), "guided", "de"]);
    let said = said_and_replayed(&gpu, &outcome, track, (&lesson(), Mode::Guided));
    let hints = said.iter().filter_map(|it| match it {
        Progress::HintDue { id, asked, t_s } => Some((id.as_str(), *asked, *t_s)),
        _ => None,
    });
    let hints: Vec<_> = hints.collect();
    assert_eq!(hints.len(), 1, "{hints:?}");
    let (id, asked, t_s) = hints[0];
    // The fifth frame's steps end at 5 / 30 s.
    assert!(
        (id, asked) == ("lift", true) && (0.13..0.2).contains(&t_s),
        "{t_s}"
    );
    let skipped = said.iter().filter_map(|it| match it {
        Progress::StepFailed { id, why, .. } => (*why == Why::Skipped).then_some(id.as_str()),
        _ => None,
    });
    assert_eq!(skipped.collect::<Vec<_>>(), ["lift", "pour"]);
}

/// A prediction, and an explanation whose first answer is right.
fn asking() -> Lesson {
    let text = r#"
version = 1
name = "asking"
scene = "small.toml"
modes = ["guided"]
[[step]]
id = "predict"
points = 10
condition = { answered = { answers = 2 } }
[[step]]
id = "explain"
points = 10
condition = { answered = { answers = 3, right = 1 } }
[texts.en]
title = "Asking"
summary = "Two questions."
step.predict = { text = "What?", hint = "Say it.", answers = ["This.", "That."] }
step.explain = { text = "Why?", hint = "Think.", answers = ["So.", "Thus.", "No."] }
"#;
    Lesson::parse(text, "asking.toml").unwrap()
}

#[test]
fn answers_are_recorded_and_replay() {
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let answer = |step: Option<&str>, answer| Action::Answer {
        step: step.map(str::to_owned),
        answer,
    };
    let acts = [
        // There is no third one yet.
        (3, answer(None, 3)),
        (5, answer(None, 2)),
        (10, answer(None, 3)),
        // Nothing is asked any more.
        (15, answer(None, 1)),
    ];
    let lesson = asking();
    let guided = (&lesson, Mode::Guided);
    let (outcome, track) = taught(&gpu, folder.path(), guided, 20, &acts);
    let expected = [answer(Some("predict"), 2), answer(Some("explain"), 3)];
    assert_eq!(asked(&track), expected);
    let verdict = outcome.verdict.clone().unwrap();
    let points: Vec<_> = verdict.lines.iter().map(|line| line.points).collect();
    assert_eq!(points, [10, 0]);
    let wrong = Why::WrongAnswer {
        answer: 3,
        right: 1,
    };
    assert_eq!(verdict.lines[1].why, Some(wrong));
    let said = said_and_replayed(&gpu, &outcome, track, guided);
    assert!(matches!(said.last(), Some(Progress::Over { .. })));
}

mod long {
    use super::*;

    /// Who says that all is done a tenth of a second behind the last drop has poured: it is not known yet, and counts.
    #[test]
    fn an_examination_ends_when_its_user_says_so() {
        let gpu = gpu::device();
        let folder = tempfile::tempdir().unwrap();
        // By the keyframes it is poured until 6.7 s.
        let acts = [
            (30, Action::Hint(None)),
            (40, Action::Skip(None)),
            (204, Action::Finish),
        ];
        let (outcome, track) = taught(
            &gpu,
            folder.path(),
            (&lesson(), Mode::Examination),
            215,
            &acts,
        );
        assert_eq!(asked(&track), [Action::Finish]);
        let verdict = outcome.verdict.clone().unwrap();
        let met: Vec<_> = verdict.lines.iter().map(|line| line.met).collect();
        assert_eq!(met, [true, true, false, false], "{verdict:#?}");
        let put_down = &verdict.lines[3];
        assert_eq!(put_down.why, Some(Why::NotDone));
        let said = said_and_replayed(&gpu, &outcome, track, (&lesson(), Mode::Examination));
        assert!(matches!(said.last(), Some(Progress::Over { t_s }) if (6.7..7.0).contains(t_s)));
    }
}
