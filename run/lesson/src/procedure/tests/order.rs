//! Which step a pour or an incident counts for, although it is known only later.

use super::*;

const POUR: &str = "condition = { poured = { from = \"a\", into = \"b\", at_least_ml = 5 } }";
const LIFT: &str = "condition = { lifted = { flask = \"a\" } }";

/// The next step begins where the last drop of this one fell, not where that was known.
#[test]
fn a_pour_that_begins_before_the_one_before_is_known_counts() {
    let lesson = lesson(&[("one", POUR), ("two", POUR)], &[]);
    let mut run = Run::new(lesson, Mode::Guided);
    run.wait(5.0);
    run.hear(&[pour([11.0, 12.0], 5.0, 2.0, 0.98)]);
    assert_eq!(run.both(), [Status::Done, Status::Open]);
    assert_eq!(run.line("one").evidence_s, Some(12.0));
    let said_at = run.t;
    run.hear(&[pour([12.5, 13.0], 5.0, 2.0, 0.98)]);
    assert_eq!(run.status("two"), Status::Done);
    let done = run.said.iter().find_map(|it| match it {
        Progress::StepDone {
            t_s, evidence_s, ..
        } => Some((*t_s, *evidence_s)),
        _ => None,
    });
    assert_eq!(done, Some((said_at, 12.0)));
}

/// Two pours that are reported at once are two; one that was over before the second step does not count for it.
#[test]
fn each_pour_counts_once() {
    let lesson = lesson(&[("one", POUR), ("two", POUR)], &[]);
    let pours = [
        pour([11.0, 12.0], 5.0, 2.0, 0.98),
        pour([12.5, 13.0], 5.0, 2.0, 0.98),
    ];
    let mut run = Run::new(lesson.clone(), Mode::Guided);
    run.hear(&pours[..1]);
    assert_eq!(run.status("two"), Status::Open);
    run.hear(&pours[..1]);
    assert_eq!(run.status("two"), Status::Open);
    let mut run = Run::new(lesson, Mode::Guided);
    run.hear(&pours);
    assert_eq!(run.status("two"), Status::Done);
}

/// An incident in a pour is reported with the pour, or after it.
#[test]
fn what_went_wrong_in_a_step_fails_it_whenever_it_is_known() {
    let body = format!("{POUR}\nkeep = [{{ never = \"boiled-over\" }}]");
    let good = pour([11.0, 13.0], 5.0, 2.0, 0.98);
    let start = || Run::new(lesson(&[("one", &body), ("two", LIFT)], &[]), Mode::Guided);

    let mut run = start();
    run.wait(4.0);
    run.hear(&[good.clone(), boiled_over(12.0)]);
    assert_eq!(run.status("one"), Status::Open);

    let mut run = start();
    run.wait(4.0);
    run.hear(std::slice::from_ref(&good));
    assert_eq!(run.status("one"), Status::Done);
    // That incident is of the second step, which does not forbid it.
    run.hear(&[boiled_over(13.1)]);
    assert_eq!(run.status("one"), Status::Done);
    run.hear(&[boiled_over(12.0)]);
    assert_eq!(run.status("one"), Status::Missed);
    assert_eq!(run.status("two"), Status::Open);
    let Some(Progress::StepFailed {
        missed, evidence_s, ..
    }) = run.said.last()
    else {
        panic!("{:?}", run.said)
    };
    assert_eq!((*missed, *evidence_s), (true, 12.0));
    // And before the step, or the lesson.
    let mut run = start();
    run.hear(&[boiled_over(9.9)]);
    assert!(run.whys().is_empty());
}

/// A step that is done is not failed by what went wrong before it, or in a try that failed already.
#[test]
fn what_went_wrong_before_a_step_is_not_of_it() {
    let body = format!("{POUR}\nkeep = [{{ never = \"boiled-over\" }}]");
    let mut run = Run::new(lesson(&[("one", POUR), ("two", &body)], &[]), Mode::Guided);
    run.wait(8.0);
    run.hear(&[pour([11.0, 12.0], 5.0, 2.0, 0.98)]);
    run.hear(&[pour([12.5, 13.0], 5.0, 2.0, 0.98)]);
    run.hear(&[boiled_over(11.5)]);
    assert_eq!(run.status("two"), Status::Done);
    run.hear(&[boiled_over(12.7)]);
    assert_eq!(run.status("two"), Status::Missed);
}

/// A failed try is not mended by the rest of its own pour.
#[test]
fn a_new_try_begins_with_a_new_pour() {
    let body = POUR.replace("at_least_ml = 5", "at_least_ml = 5, at_most_ml_s = 4");
    let mut run = Run::new(lesson(&[("one", &body)], &[]), Mode::Guided);
    run.wait(4.0);
    run.hear(&[pour([11.0, 12.0], 9.0, 8.0, 0.98)]);
    let again = run.t;
    run.hear(&[pour([again - 1.0, again + 1.0], 9.0, 2.0, 0.98)]);
    assert_eq!(run.status("one"), Status::Open);
    run.hear(&[pour([again, again + 2.0], 4.0, 2.0, 0.98)]);
    assert_eq!(run.status("one"), Status::Open);
    run.hear(&[pour([again + 3.0, again + 4.0], 1.0, 2.0, 0.98)]);
    assert_eq!(run.status("one"), Status::Done);
    let line = run.line("one");
    // Half of ten points.
    assert_eq!(
        (line.met, line.failures, line.points, line.of),
        (true, 1, 5, 10)
    );
}

/// A spill of the last moment is known a second after the last step.
#[test]
fn rules_are_judged_after_the_last_step_for_what_began_before() {
    let rules = [
        ("order", "{ never = \"boiled-over\" }"),
        ("cool", "{ cool = { flask = \"b\", below_c = 60 } }"),
    ];
    let start = || {
        let mut run = Run::new(lesson(&[("one", LIFT)], &rules), Mode::Guided);
        run.wait(1.0);
        run.look(STEP, &|it| it.flasks[0].held = true);
        assert!(run.procedure.state().over);
        run
    };
    let mut run = start();
    run.hear(&[boiled_over(11.0)]);
    assert!(!run.line("order").met);
    run.hear(&[boiled_over(11.05)]);
    assert_eq!(run.whys().len(), 1);
    let mut run = start();
    run.hear(&[boiled_over(11.2)]);
    run.look(1.0, &|it| it.flasks[1].temperature_c = Some(99.0));
    assert!(run.line("order").met && run.line("cool").met);
    // And with the attempt's end, not after it.
    let mut run = start();
    run.hear(&[boiled_over(11.0), ended(11.2)]);
    assert!(!run.line("order").met);
    let mut run = start();
    run.hear(&[ended(11.2)]);
    run.hear(&[boiled_over(11.0)]);
    assert!(run.line("order").met);
}

/// The finder's last events have the last pour and the end together.
#[test]
fn a_pour_that_is_known_at_the_end_counts() {
    let mut run = Run::new(
        lesson(&[("one", POUR), ("two", LIFT)], &[]),
        Mode::Examination,
    );
    run.wait(2.0);
    run.hear(&[pour([11.0, 12.0], 6.0, 2.0, 0.98), ended(12.1)]);
    assert_eq!(run.both(), [Status::Done, Status::Missed]);
    assert_eq!(run.line("two").why, Some(Why::NotDone));
    assert!(run.procedure.state().over);
}

/// Several steps are open at a time, but one waits for those of its `after`, done or missed.
#[test]
fn a_step_begins_after_those_it_names() {
    let second = format!("{LIFT}\nafter = [\"one\"]");
    let third = "condition = { poured = { from = \"a\", into = \"b\", at_least_ml = 1 } }";
    let steps = [("one", POUR), ("two", &*second), ("three", third)];
    for mode in [Mode::Free, Mode::Examination] {
        let mut run = Run::new(lesson(&steps, &[]), mode);
        run.look(1.0, &|it| it.flasks[0].held = true);
        let of = |run: &Run| ["one", "two", "three"].map(|id| run.status(id));
        assert_eq!(of(&run), [Status::Open, Status::Waiting, Status::Open]);
        run.hear(&[pour([11.0, 11.2], 2.0, 2.0, 0.98)]);
        assert_eq!(of(&run), [Status::Open, Status::Waiting, Status::Done]);
        run.procedure.skip("one", run.t);
        assert_eq!(of(&run), [Status::Missed, Status::Open, Status::Done]);
        run.look(STEP, &|it| it.flasks[0].held = true);
        assert_eq!(of(&run), [Status::Missed, Status::Done, Status::Done]);
    }
    // In `guided` one is open at a time, in their order.
    let run = Run::new(lesson(&steps, &[]), Mode::Guided);
    assert_eq!(run.status("three"), Status::Waiting);
}

/// A step that an observation opens takes in the same observation, however many steps open in turn.
#[test]
fn what_is_so_already_is_done_at_once() {
    let goggles = "condition = { goggles = { on = true } }";
    let ids = ["one", "two", "three", "four", "five", "six"];
    let run = Run::new(lesson(&ids.map(|id| (id, goggles)), &[]), Mode::Guided);
    assert!(ids.iter().all(|id| run.status(id) == Status::Done));
    // Each begins and is done; before and after them the lesson.
    assert_eq!(run.said.len(), 14, "{:?}", run.said);
}
