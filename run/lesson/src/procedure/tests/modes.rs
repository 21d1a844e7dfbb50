//! Modes, hints, time, points; beginning again; the same twice.

use super::*;

pub(super) const LIFT: &str = "condition = { lifted = { flask = \"a\" } }\nhint_after_s = 5";
pub(super) const POUR: &str = "condition = { poured = { from = \"a\", into = \"b\", at_least_ml = 5, at_most_ml_s = 4 } }\nhint_after_s = 5";

fn lifts(it: &mut Sight) {
    it.flasks[0].held = true;
}

#[test]
fn guided_shows_one_step_at_a_time_and_hints_when_they_are_due() {
    let mut run = Run::new(lesson(&[("one", LIFT), ("two", POUR)], &[]), Mode::Guided);
    assert_eq!(run.procedure.state().number, Some(1));
    run.wait(4.8);
    assert_eq!(run.hints(), 0);
    run.wait(10.0);
    assert_eq!(run.hints(), 1);
    assert!(run.procedure.state().steps[0].hint);
    run.look(STEP, &lifts);
    let state = run.procedure.state();
    assert_eq!(
        (state.number, state.steps.len(), state.over),
        (Some(2), 2, false)
    );
    assert!(!state.steps[0].hint && state.steps[0].hints == 1);
    // Since its own beginning, and since its failure again.
    run.wait(4.8);
    assert_eq!(run.hints(), 1);
    run.hear(&[pour([run.t - 1.0, run.t], 9.0, 9.0, 0.98)]);
    run.wait(4.8);
    assert_eq!(run.hints(), 1);
    run.wait(1.0);
    assert_eq!(run.hints(), 2);
}

#[test]
fn free_opens_all_steps_and_hints_are_asked_for() {
    let mut run = Run::new(lesson(&[("one", LIFT), ("two", POUR)], &[]), Mode::Free);
    run.hear(&[pour([11.0, 12.0], 5.0, 2.0, 0.98)]);
    assert_eq!(run.both(), [Status::Open, Status::Done]);
    run.wait(60.0);
    assert_eq!(run.hints(), 0);
    let hint = run.procedure.ask_hint("one", run.t);
    assert!(matches!(hint, Some(Progress::HintDue { asked: true, .. })));
    assert_eq!(run.procedure.ask_hint("two", run.t), None);
    assert_eq!(run.procedure.ask_hint("three", run.t), None);
    assert_eq!(run.line("one").hints, 1);
    // It is reported once.
    run.wait(STEP);
    assert_eq!(run.hints(), 0);
}

#[test]
fn an_examination_gives_no_hints_and_no_second_try() {
    let steps = [("one", POUR), ("two", LIFT)];
    let mut run = Run::new(lesson(&steps, &[]), Mode::Examination);
    run.wait(60.0);
    assert_eq!(run.procedure.ask_hint("one", run.t), None);
    assert_eq!(run.hints(), 0);
    run.hear(&[pour([run.t - 1.0, run.t], 6.0, 9.0, 0.98)]);
    assert_eq!(run.status("one"), Status::Missed);
    run.hear(&[pour([run.t, run.t + 1.0], 6.0, 2.0, 0.98)]);
    assert_eq!(run.status("one"), Status::Missed);
    assert!(!Mode::Examination.tells() && !Mode::Examination.one_at_a_time());
    let verdict = run.procedure.verdict();
    assert_eq!((verdict.points, verdict.of), (0, 20));
    run.look(STEP, &lifts);
    assert_eq!(run.procedure.verdict().points, 10);
    assert!(run.procedure.state().over);
}

#[test]
fn a_step_whose_time_is_up_is_missed_and_the_next_begins() {
    for mode in Mode::ALL {
        let first = format!("{POUR}\ntime_limit_s = 20");
        let second = format!("{LIFT}\nafter = [\"one\"]");
        let mut run = Run::new(lesson(&[("one", &first), ("two", &second)], &[]), mode);
        run.wait(19.9);
        assert_eq!(run.status("one"), Status::Open);
        // A failure gives no more time.
        if mode != Mode::Examination {
            run.hear(&[pour([11.0, 12.0], 6.0, 9.0, 0.98)]);
        }
        run.wait(0.3);
        assert_eq!(run.both(), [Status::Missed, Status::Open]);
        assert_eq!(run.line("one").why, Some(Why::TimeUp { limit_s: 20.0 }));
    }
}

#[test]
fn a_step_is_left_out_and_a_lesson_finished_by_who_says_so() {
    let mut run = Run::new(lesson(&[("one", LIFT), ("two", POUR)], &[]), Mode::Guided);
    assert!(run.procedure.skip("two", 11.0).is_empty());
    let said = run.procedure.skip("one", 11.0);
    assert!(matches!(
        said[0],
        Progress::StepFailed {
            why: Why::Skipped,
            missed: true,
            ..
        }
    ));
    assert!(matches!(said[1], Progress::StepBegun { .. }));
    let said = run.procedure.finish(12.0);
    assert!(matches!(
        said[0],
        Progress::StepFailed {
            why: Why::NotDone,
            ..
        }
    ));
    assert_eq!(said.last(), Some(&Progress::Over { t_s: 12.0 }));
    assert!(run.procedure.finish(13.0).is_empty());
}

/// A rule is worth the share of its points that the steps earned of theirs; a student who does nothing has none.
#[test]
fn points_are_for_what_was_done() {
    let rules = [
        ("order", "{ never = \"boiled-over\" }"),
        ("clean", "{ spilt = { at_most_ml = 1 } }"),
    ];
    let run = |lifted: bool, boiled: bool| {
        let steps = [("one", LIFT), ("two", POUR)];
        let mut run = Run::new(lesson(&steps, &rules), Mode::Free);
        if lifted {
            run.look(STEP, &lifts);
        }
        if boiled {
            run.hear(&[boiled_over(10.05)]);
        }
        run.procedure.finish(20.0);
        let verdict = run.procedure.verdict();
        assert_eq!((verdict.of, verdict.lines.len()), (40, 4));
        assert_eq!(
            verdict.points,
            verdict.lines.iter().map(|it| it.points).sum::<u32>()
        );
        verdict.lines.iter().map(|it| it.points).collect::<Vec<_>>()
    };
    assert_eq!(run(true, false), [10, 0, 5, 5]);
    assert_eq!(run(true, true), [10, 0, 0, 5]);
    assert_eq!(run(false, false), [0, 0, 0, 0]);
}

#[test]
fn it_begins_again_with_its_scene() {
    let mut run = Run::new(
        lesson(
            &[("one", LIFT), ("two", POUR)],
            &[("order", "{ never = \"boiled-over\" }")],
        ),
        Mode::Guided,
    );
    run.look(1.0, &lifts);
    run.hear(&[boiled_over(10.5)]);
    assert!(!run.line("order").met && run.status("two") == Status::Open);
    let from = run.said.len();
    run.hear(&[ended(run.t), begun(run.t)]);
    assert!(run.line("order").met);
    assert_eq!(run.both(), [Status::Open, Status::Waiting]);
    assert!(!run.procedure.state().over);
    let again = run.said[from..]
        .iter()
        .filter(|it| matches!(it, Progress::Begun { .. }));
    assert_eq!(again.count(), 1);
    run.look(STEP, &lifts);
    assert_eq!(run.status("one"), Status::Done);
    // A flask that was lifted before the restart does not count as lifted.
    let body = "condition = { put-down = { flask = \"a\" } }";
    let mut run = Run::new(lesson(&[("one", body)], &[]), Mode::Guided);
    run.look(1.0, &lifts);
    run.hear(&[begun(run.t)]);
    run.wait(2.0);
    assert_eq!(run.status("one"), Status::Open);
}

/// A recording stores progress, and a replay gives the same progress.
#[test]
fn the_same_looks_give_the_same_progress_which_is_kept_as_json() {
    let body = format!(
        "{POUR}\ntime_limit_s = 60\nkeep = [{{ spilt = {{ at_most_ml = 1 }} }}, \"gloves\"]"
    );
    let all = || {
        let mut said = Vec::new();
        for mode in Mode::ALL {
            let rules = [("order", "{ never = \"boiled-over\" }")];
            let mut run = Run::new(lesson(&[("one", LIFT), ("two", &body)], &rules), mode);
            run.wait(7.0);
            run.look(STEP, &lifts);
            run.hear(&[pour([11.0, 12.0], 6.0, 9.0, 0.98), boiled_over(11.5)]);
            run.look(1.0, &|it| it.gloves = Some([false; 2]));
            run.hear(&[pour([18.2, 19.0], 6.0, 2.0, 0.98), spilt(18.5, 2.0)]);
            run.hear(&[ended(run.t)]);
            said.push((run.said, run.procedure.verdict(), run.procedure.state()));
        }
        said
    };
    let said = all();
    assert_eq!(said, all());
    for (progress, verdict, state) in said {
        assert!(progress.len() > 5);
        let json = serde_json::to_string(&progress).unwrap();
        assert_eq!(
            serde_json::from_str::<Vec<Progress>>(&json).unwrap(),
            progress
        );
        let json = serde_json::to_string(&verdict).unwrap();
        assert_eq!(serde_json::from_str::<Verdict>(&json).unwrap(), verdict);
        let json = serde_json::to_string(&state).unwrap();
        assert_eq!(serde_json::from_str::<State>(&json).unwrap(), state);
    }
    assert!(Progress::schema().contains("evidence_s"));
}

#[test]
fn a_mode_has_its_name() {
    for mode in Mode::ALL {
        assert_eq!(mode.to_string().parse(), Ok(mode));
        assert_eq!(serde_json::to_string(&mode).unwrap(), format!("\"{mode}\""));
    }
    let error = "exam".parse::<Mode>().unwrap_err().to_string();
    assert!(error.contains("guided, free, examination"));
}
