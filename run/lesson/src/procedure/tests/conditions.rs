//! Each condition, met and not met.

use super::*;

/// A run of one step with that condition, before its first observation.
fn fresh(condition: &str) -> Run {
    let step = format!("condition = {condition}");
    Run {
        procedure: Procedure::new(lesson(&[("one", &step)], &[]), Mode::Guided),
        t: 10.0,
        said: Vec::new(),
    }
}

/// A run of one step with that condition, after one observation of the unchanged bench.
fn one(condition: &str) -> Run {
    let step = format!("condition = {condition}");
    Run::new(lesson(&[("one", &step)], &[]), Mode::Guided)
}

/// Whether the first observation of a bench with `change` meets the condition.
fn at_once(condition: &str, change: &dyn Fn(&mut Sight)) -> bool {
    let mut run = fresh(condition);
    run.look(STEP, change);
    run.status("one") == Status::Done
}

/// Whether `long` seconds of observations of a bench with `change` meet the condition.
fn seen(condition: &str, long: f64, change: &dyn Fn(&mut Sight)) -> bool {
    let mut run = one(condition);
    run.look(long, change);
    run.status("one") == Status::Done
}

/// Whether these events meet the condition.
fn heard(condition: &str, events: &[Event]) -> bool {
    let mut run = one(condition);
    for event in events {
        run.hear(std::slice::from_ref(event));
    }
    run.status("one") == Status::Done
}

#[test]
fn lifted_is_in_a_hand() {
    let lifted = "{ lifted = { flask = \"a\" } }";
    assert!(!seen(lifted, 1.0, &|_| {}));
    assert!(!seen(lifted, 1.0, &|it| it.flasks[1].held = true));
    assert!(seen(lifted, STEP, &|it| it.flasks[0].held = true));
}

/// A flask that was never lifted was not put down; one that stands for a moment is not yet, and one that lies never.
#[test]
fn put_down_was_lifted_and_stands() {
    let put_down = "{ put-down = { flask = \"a\" } }";
    assert!(!seen(put_down, 5.0, &|_| {}));
    let mut run = one(put_down);
    run.look(0.5, &|it| {
        (it.flasks[0].held, it.flasks[0].standing) = (true, false)
    });
    run.look(2.0, &|it| it.flasks[0].standing = false);
    assert_eq!(run.status("one"), Status::Open);
    run.wait(0.4);
    assert_eq!(run.status("one"), Status::Open);
    run.wait(0.3);
    assert_eq!(run.status("one"), Status::Done);
    // Somebody holds it on the bench.
    assert!(!seen(put_down, 3.0, &|it| it.flasks[0].held = true));
    // The other flask does not matter.
    let mut run = one(put_down);
    run.look(0.5, &|it| it.flasks[1].held = true);
    run.wait(1.0);
    assert_eq!(run.status("one"), Status::Open);
}

#[test]
fn poured_adds_up_from_one_flask_into_another() {
    let poured = "{ poured = { from = \"a\", into = \"b\", at_least_ml = 10 } }";
    let first = pour([11.0, 12.0], 6.0, 3.0, 0.98);
    let second = pour([13.0, 14.0], 4.0, 3.0, 0.98);
    assert!(!heard(poured, std::slice::from_ref(&first)));
    assert!(heard(poured, &[first.clone(), second.clone()]));
    let elsewhere = |change: &dyn Fn(&mut Pour)| {
        let mut pours = [first.clone(), second.clone()];
        for pour in &mut pours {
            let Event::Poured(pour) = pour else { panic!() };
            change(pour);
        }
        heard(poured, &pours)
    };
    assert!(!elsewhere(&|it| it.into = None));
    assert!(!elsewhere(&|it| it.into = Some("a".to_owned())));
    assert!(!elsewhere(&|it| it.from = "b".to_owned()));
    // A pour before the lesson does not count.
    assert!(!elsewhere(&|it| (it.t_s, it.until_s) = (8.0, 10.0)));
    assert!(elsewhere(&|it| (it.t_s, it.until_s) = (8.0, 10.1)));
}

/// CLP: from 15 % on acid burns, below 5 % it does not irritate.
#[test]
fn poured_is_of_the_liquid_that_was_asked_for() {
    let with = |liquid: &str, acid| {
        let poured = format!(
            "{{ poured = {{ from = \"a\", into = \"b\", liquid = \"{liquid}\", at_least_ml = 1 }} }}"
        );
        heard(&poured, &[pour([11.0, 12.0], 2.0, 1.0, acid)])
    };
    for (acid, is_acid, is_water) in [
        (0.0, false, true),
        (0.049, false, true),
        (0.05, false, false),
        (0.149, false, false),
        (0.15, true, false),
        (0.98, true, false),
    ] {
        assert_eq!(with("acid", acid), is_acid, "{acid}");
        assert_eq!(with("water", acid), is_water, "{acid}");
        assert!(with("any", acid));
    }
}

#[test]
fn poured_too_fast_or_too_much_is_a_failure() {
    let poured = "{ poured = { from = \"a\", into = \"b\", at_least_ml = 10, at_most_ml = 15, at_most_ml_s = 5 } }";
    assert!(heard(poured, &[pour([11.0, 14.0], 15.0, 5.0, 0.98)]));
    let mut run = one(poured);
    run.hear(&[pour([11.0, 14.0], 12.0, 5.1, 0.98)]);
    assert!(matches!(run.whys()[..], [Why::TooFast { .. }]));
    let mut run = one(poured);
    run.hear(&[pour([11.0, 14.0], 8.0, 4.0, 0.98)]);
    assert!(run.whys().is_empty());
    run.hear(&[pour([15.0, 18.0], 8.0, 4.0, 0.98)]);
    let [
        Why::TooMuch {
            volume_m3,
            limit_m3,
        },
    ] = run.whys()[..]
    else {
        panic!("{:?}", run.said)
    };
    assert!((volume_m3 - 16e-6).abs() < 1e-12 && (limit_m3 - 15e-6).abs() < 1e-12);
    assert_eq!(run.status("one"), Status::Open);
}

/// A pour that goes on passes a concentration, and does not hold it.
#[test]
fn holds_is_an_amount_of_a_concentration_for_a_while() {
    let holds = "{ holds = { flask = \"b\", at_least_ml = 170, acid_from_percent = 15, acid_to_percent = 20, for_s = 3 } }";
    let is = |volume_ml: f64, acid: f64, long: f64| {
        seen(holds, long, &|it| {
            (it.flasks[1].volume_m3, it.flasks[1].acid) = (volume_ml * 1e-6, acid);
        })
    };
    assert!(is(171.0, 0.18, 3.2) && is(171.0, 0.15, 3.2) && is(171.0, 0.2, 3.2));
    assert!(!is(171.0, 0.149, 9.0) && !is(171.0, 0.201, 9.0));
    assert!(!is(169.0, 0.18, 9.0));
    assert!(!is(171.0, 0.18, 2.9));
    let mut run = one(holds);
    let full = |it: &mut Sight| (it.flasks[1].volume_m3, it.flasks[1].acid) = (171e-6, 0.18);
    run.look(2.0, &full);
    run.wait(STEP);
    run.look(2.0, &full);
    assert_eq!(run.status("one"), Status::Open);
    // The default is two seconds.
    let holds = holds.replace(", for_s = 3", "");
    assert!(!seen(&holds, 1.8, &full) && seen(&holds, 2.2, &full));
}

#[test]
fn temperature_is_between_its_ends() {
    let is = |ends: &str, celsius: Option<f64>| {
        let temperature = format!("{{ temperature = {{ flask = \"b\", {ends} }} }}");
        at_once(&temperature, &|it| it.flasks[1].temperature_c = celsius)
    };
    assert!(is("at_least_c = 30", Some(30.0)) && !is("at_least_c = 30", Some(29.9)));
    assert!(is("at_most_c = 30", Some(30.0)) && !is("at_most_c = 30", Some(30.1)));
    assert!(!is("at_least_c = 25, at_most_c = 30", Some(24.0)));
    assert!(!is("at_most_c = 30", None));
}

type Set<'a> = &'a dyn Fn(&mut Sight, Option<bool>);

#[test]
fn what_is_worn_is_on_or_off() {
    let set: [(&str, Set<'_>); 2] = [
        ("goggles", &|it, on| it.goggles = on),
        ("gloves", &|it, on| it.gloves = on.map(|on| [on; 2])),
    ];
    for (gear, set) in set {
        for on in [true, false] {
            let worn = format!("{{ {gear} = {{ on = {on} }} }}");
            let with = |is| at_once(&worn, &|it| set(it, is));
            assert!(with(Some(on)) && !with(Some(!on)) && !with(None), "{worn}");
        }
    }
}

#[test]
fn the_sash_is_between_its_ends() {
    let is = |ends: &str, height: Option<f64>| {
        let sash = format!("{{ sash = {{ {ends} }} }}");
        at_once(&sash, &|it| it.sash_m = height)
    };
    assert!(is("at_most_m = 0.3", Some(0.3)) && !is("at_most_m = 0.3", Some(0.31)));
    assert!(is("at_least_m = 0.3", Some(0.3)) && !is("at_least_m = 0.3", Some(0.29)));
    assert!(!is("at_most_m = 0.3", None));
}

/// The rod moves in that liquid: 3 s in all, with breaks.
#[test]
fn stirred_is_time_in_which_the_rod_moves_in_the_liquid() {
    let stirred = "{ stirred = { flask = \"b\", at_least_s = 3 } }";
    let rod = |flask: &str, speed_m_s| {
        let flask = Some(flask.to_owned());
        move |it: &mut Sight| {
            it.rod = Some(Dip {
                flask: flask.clone(),
                speed_m_s,
            });
        }
    };
    let mut run = one(stirred);
    run.look(2.0, &rod("b", 0.02));
    run.look(5.0, &rod("b", 0.019));
    run.look(5.0, &rod("a", 0.2));
    run.look(5.0, &|it| it.rod = None);
    assert_eq!(run.status("one"), Status::Open);
    run.look(0.8, &rod("b", 0.2));
    assert_eq!(run.status("one"), Status::Open);
    run.look(0.4, &rod("b", 0.2));
    assert_eq!(run.status("one"), Status::Done);
}

#[test]
fn measured_is_a_thermometer_that_stays_in_the_liquid() {
    let measured = "{ measured = { flask = \"b\", for_s = 2 } }";
    let dip = |flask: &str| {
        let flask = Some(flask.to_owned());
        move |it: &mut Sight| {
            it.thermometer = Some(Dip {
                flask: flask.clone(),
                speed_m_s: 0.0,
            });
        }
    };
    assert!(seen(measured, 2.2, &dip("b")));
    assert!(!seen(measured, 9.0, &dip("a")));
    let mut run = one(measured);
    run.look(1.5, &dip("b"));
    run.wait(STEP);
    run.look(1.5, &dip("b"));
    assert_eq!(run.status("one"), Status::Open);
}

#[test]
fn wiped_is_what_lies_there() {
    for (surface, other) in [("bench", "floor"), ("floor", "bench")] {
        let wiped = format!("{{ wiped = {{ surface = \"{surface}\", at_most_ml = 1 }} }}");
        let with = |place: &str, ml: f64| {
            at_once(&wiped, &|it| match place {
                "bench" => it.bench_m3 = ml * 1e-6,
                _ => it.floor_m3 = ml * 1e-6,
            })
        };
        assert!(with(surface, 1.0) && !with(surface, 1.1) && with(other, 9.0));
    }
}

/// Water that came before the step began does not count.
#[test]
fn rinsed_is_water_since_the_step_began() {
    let rinsed = "{ rinsed = { hand = \"right-hand\", at_least_ml = 50 } }";
    let mut run = fresh(rinsed);
    run.look(1.0, &|it| it.rinsed_m3 = Some([0.0, 40e-6]));
    run.look(1.0, &|it| it.rinsed_m3 = Some([90e-6, 89e-6]));
    run.look(1.0, &|it| it.rinsed_m3 = None);
    assert_eq!(run.status("one"), Status::Open);
    run.look(STEP, &|it| it.rinsed_m3 = Some([90e-6, 90e-6]));
    assert_eq!(run.status("one"), Status::Done);
}

/// Acid is poured while, or before, a hand holds the other flask: a pour stays met, a hold only while it lasts.
#[test]
fn all_are_so_at_one_time_and_any_is_enough() {
    let parts = "[{ lifted = { flask = \"b\" } }, { any = [{ temperature = { flask = \"a\", at_least_c = 50 } }, { poured = { from = \"a\", into = \"b\", at_least_ml = 5 } }] }]";
    let lifts = |it: &mut Sight| it.flasks[1].held = true;
    let mut run = one(&format!("{{ all = {parts} }}"));
    run.look(1.0, &lifts);
    run.hear(&[pour([11.0, 12.0], 6.0, 1.0, 0.98)]);
    run.wait(1.0);
    assert_eq!(run.status("one"), Status::Open);
    run.look(STEP, &lifts);
    assert_eq!(run.status("one"), Status::Done);

    let mut run = one(&format!("{{ all = {parts} }}"));
    run.look(1.0, &|it| it.flasks[0].temperature_c = Some(60.0));
    assert_eq!(run.status("one"), Status::Open);
    run.look(STEP, &|it| {
        it.flasks[0].temperature_c = Some(60.0);
        lifts(it);
    });
    assert_eq!(run.status("one"), Status::Done);

    assert!(seen(&format!("{{ any = {parts} }}"), STEP, &lifts));
    assert!(heard(
        &format!("{{ any = {parts} }}"),
        &[pour([11.0, 12.0], 6.0, 1.0, 0.98)]
    ));
    assert!(!seen(&format!("{{ any = {parts} }}"), 1.0, &|_| {}));
}

/// Evidence is that of the first part of an `any`, and of the last part of an `all`.
#[test]
fn evidence_is_of_the_first_or_the_last() {
    let measured = "{ measured = { flask = \"a\", for_s = 1 } }";
    let poured = |from: &str, into: &str| {
        format!("{{ poured = {{ from = \"{from}\", into = \"{into}\", at_least_ml = 5 }} }}")
    };
    let [there, back] = [poured("a", "b"), poured("b", "a")];
    let any = format!("{{ all = [{{ any = [{measured}, {there}] }}, {back}] }}");
    let all = format!("{{ all = [{measured}, {there}, {back}] }}");
    for (condition, evidence_s) in [(any, 10.0), (all, 12.0)] {
        let mut run = fresh(&condition);
        run.t = 8.0;
        let dips = |it: &mut Sight| it.thermometer.as_mut().unwrap().flask = Some("a".into());
        run.look(STEP, &dips);
        let mut last = sight(12.0);
        dips(&mut last);
        let there = pour([8.5, 9.0], 9.0, 2.0, 0.98);
        let mut back = pour([9.5, 10.0], 9.0, 2.0, 0.98);
        if let Event::Poured(pour) = &mut back {
            (pour.from, pour.into) = ("b".to_owned(), Some("a".to_owned()));
        }
        run.procedure.advance(&last, &[there, back]);
        assert_eq!(run.line("one").evidence_s, Some(evidence_s), "{condition}");
    }
}

/// What is left of a step that asks for a pour, and for lifting or stirring.
#[test]
fn what_is_met_is_not_left() {
    let poured = "{ poured = { from = \"a\", into = \"b\", at_least_ml = 5 } }";
    let lifted = "{ lifted = { flask = \"a\" } }";
    let stirred = "{ stirred = { flask = \"b\", at_least_s = 3 } }";
    let mut run = one(&format!(
        "{{ all = [{poured}, {{ any = [{lifted}, {stirred}] }}] }}"
    ));
    let left = |run: &Run| -> Vec<&'static str> {
        let names = run.procedure.left().into_iter().map(|it| match it {
            Condition::Poured(_) => "poured",
            Condition::Lifted(_) => "lifted",
            Condition::Stirred(_) => "stirred",
            _ => "other",
        });
        names.collect()
    };
    assert_eq!(left(&run), ["poured", "lifted", "stirred"]);
    // One of the two is enough, while it lasts.
    run.look(STEP, &|it| it.flasks[0].held = true);
    assert_eq!(left(&run), ["poured"]);
    run.wait(STEP);
    assert_eq!(left(&run), ["poured", "lifted", "stirred"]);
    run.hear(&[pour([10.1, 10.2], 6.0, 2.0, 0.98)]);
    assert_eq!(left(&run), ["lifted", "stirred"]);
    run.look(STEP, &|it| it.flasks[0].held = true);
    assert_eq!(run.status("one"), Status::Done);
    assert!(left(&run).is_empty());
}
