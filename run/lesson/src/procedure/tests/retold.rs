//! Verdicts from recorded progress, against those of the judge.

use super::modes::{LIFT, POUR};
use super::*;

/// A session in which all kinds of things happen: a failure and a second try, a hint, a step left out, a rule broken, another beginning.
fn eventful(mode: Mode) -> (Lesson, Run) {
    let steps = [
        ("one", POUR.to_owned()),
        ("two", LIFT.to_owned()),
        ("three", format!("{POUR}\ntime_limit_s = 20")),
        ("four", LIFT.to_owned()),
    ];
    let steps = steps.each_ref().map(|(id, body)| (*id, body.as_str()));
    let rules = [
        ("calm", "{ never = \"boiled-over\" }"),
        ("whole", "{ never = \"dropped\" }"),
    ];
    let lesson = lesson(&steps, &rules);
    let mut run = Run::new(lesson.clone(), mode);
    run.wait(6.0);
    // Too fast, and then not.
    run.hear(&[pour([run.t - 1.0, run.t], 9.0, 9.0, 0.98)]);
    run.hear(&[boiled_over(run.t)]);
    run.wait(2.0);
    run.hear(&[pour([run.t - 1.0, run.t], 9.0, 2.0, 0.98)]);
    let hint = run.procedure.ask_hint("two", run.t);
    run.said.extend(hint);
    let skipped = run.procedure.skip("two", run.t);
    run.said.extend(skipped);
    run.wait(30.0);
    (lesson, run)
}

#[test]
fn what_was_said_comes_to_what_was_judged() {
    for mode in Mode::ALL {
        let (lesson, mut run) = eventful(mode);
        let before = run.procedure.verdict();
        assert_eq!(Verdict::retold(&lesson, mode, &run.said), [before]);
        let finished = run.procedure.finish(run.t);
        run.said.extend(finished);
        let first = run.procedure.verdict();
        // The first step was done at its second try, where there is one.
        let again = first.lines[0].met && first.lines[0].failures == 1;
        assert_eq!(again, mode.tries_again());
        // And begun again.
        run.hear(&[begun(run.t)]);
        run.look(STEP, &|sight| sight.flasks[0].held = true);
        let second = run.procedure.verdict();
        assert_ne!(first, second);
        let retold = Verdict::retold(&lesson, mode, &run.said);
        assert_eq!(retold, [first, second], "{mode}");
        // As a recording stores it.
        let kept = serde_json::to_string(&run.said).unwrap();
        let read: Vec<Progress> = serde_json::from_str(&kept).unwrap();
        assert_eq!(Verdict::retold(&lesson, mode, &read), retold);
    }
}

#[test]
fn what_is_said_of_no_lesson_counts_for_nothing() {
    let (lesson, run) = eventful(Mode::Free);
    assert!(Verdict::retold(&lesson, Mode::Free, &[]).is_empty());
    let other = Progress::StepDone {
        t_s: 1.0,
        id: "five".to_owned(),
        evidence_s: 1.0,
    };
    // Progress before any beginning, and of a step that does not exist.
    let said = [vec![other.clone()], run.said, vec![other]].concat();
    let retold = Verdict::retold(&lesson, Mode::Free, &said);
    assert_eq!(retold, [run.procedure.verdict()]);
}

#[test]
fn a_word_says_what_became_of_each() {
    let words = |mode| {
        let (_, mut run) = eventful(mode);
        run.procedure.finish(run.t);
        let lines = run.procedure.verdict().lines;
        lines
            .iter()
            .map(|it| it.became().name())
            .collect::<Vec<_>>()
    };
    // Done at the second try, left out, out of time, not come to.
    let guided = ["done", "missed", "missed", "missed", "broken", "kept"];
    assert_eq!(words(Mode::Guided), guided);
    // Two pour at once, too fast; the third tries again as the first does.
    let free = ["done", "missed", "done", "missed", "broken", "kept"];
    assert_eq!(words(Mode::Free), free);
    let examination = ["failed", "missed", "failed", "missed", "broken", "kept"];
    assert_eq!(words(Mode::Examination), examination);
}

/// Buttons fit half the panel, and each line the whole of it, in each language.
#[test]
fn what_stands_around_the_steps_fits_the_panel() {
    use crate::{Language, Texts};
    for language in Language::ALL {
        let texts = Texts::of(language).unwrap();
        let wide = if language == Language::Zh { 2 } else { 1 };
        let length = |text: String| wide * text.chars().count();
        let panel = &texts.panel;
        for button in [&panel.hint, &panel.skip, &panel.finish] {
            assert!((2..=26).contains(&length(button.text())), "{language}");
        }
        for label in [&panel.steps, &panel.more] {
            let line = label.fill(&[("number", "50")]);
            assert!(line.contains("50") && length(line) < 50, "{language}");
        }
    }
}
