//! Each requirement, kept and breached: as a rule, and while a step is open.

use super::*;

/// Why a rule `keep` is broken, while the one step waits for a flask to be lifted.
fn broken(keep: &str, looks: &dyn Fn(&mut Sight), events: &[Event]) -> Vec<Why> {
    let step = ("one", "condition = { lifted = { flask = \"a\" } }");
    let mut run = Run::new(lesson(&[step], &[("rule", keep)]), Mode::Free);
    run.look(0.5, looks);
    run.look(0.5, looks);
    run.hear(events);
    let line = run.line("rule");
    assert_eq!(line.met, run.whys().is_empty());
    assert_eq!(line.why, run.whys().first().cloned());
    run.whys()
}

/// An incident of each kind that a lesson can forbid, as in a recording.
const FORBIDDEN: &str = r#"
{"kind":"water-into-acid","flask":"b","met_acid":0.98,"volume_m3":1e-6}
{"kind":"poured-too-fast","flask":"b","rate_m3_s":9e-6,"limit_m3_s":5e-6}
{"kind":"boiled-over","flask":"b","volume_m3":1e-6,"acid":0.5}
{"kind":"hot","flask":"b","temperature_c":70.0}
{"kind":"on-skin","skin":"left-hand","volume_m3":1e-6,"acid":0.5,"temperature_c":null,"protected":true}
{"kind":"dropped","flask":"b","speed_m_s":2.0,"broke":false}
"#;

#[test]
fn what_must_not_happen_is_of_its_kind() {
    let whats = FORBIDDEN.trim().lines();
    let whats: Vec<What> = whats.map(|it| serde_json::from_str(it).unwrap()).collect();
    for kind in whats.iter().map(What::kind) {
        let keep = format!("{{ never = \"{kind}\" }}");
        for what in &whats {
            let other = what.kind();
            let why = broken(&keep, &|_| {}, &[incident(10.5, what.clone())]);
            assert_eq!(why.len(), usize::from(kind == other), "{kind}, {other}");
        }
        assert!(broken(&keep, &|_| {}, &[spilt(10.5, 9.0)]).is_empty());
        // An incident that began before the lesson does not count.
        assert!(broken(&keep, &|_| {}, &[incident(9.9, whats[0].clone())]).is_empty());
    }
}

/// Spills add up.
#[test]
fn spilt_is_all_that_was_spilt() {
    let keep = "{ spilt = { at_most_ml = 1 } }";
    assert!(broken(keep, &|_| {}, &[spilt(10.1, 0.5), spilt(10.2, 0.5)]).is_empty());
    let why = broken(keep, &|_| {}, &[spilt(10.1, 0.5), spilt(10.2, 0.6)]);
    let [Why::Spilt { volume_m3, .. }] = why[..] else {
        panic!("{why:?}")
    };
    assert!((volume_m3 - 1.1e-6).abs() < 1e-12);
    assert!(broken(keep, &|_| {}, &[boiled_over(10.1)]).is_empty());
}

#[test]
fn cool_is_below_a_temperature() {
    let keep = "{ cool = { flask = \"b\", below_c = 60 } }";
    let at = |flask: usize, celsius| {
        broken(keep, &|it| it.flasks[flask].temperature_c = celsius, &[]).len()
    };
    assert_eq!(at(1, Some(59.9)), 0);
    assert_eq!(at(1, Some(60.0)), 1);
    assert_eq!(at(0, Some(99.0)), 0);
    assert_eq!(at(1, None), 0);
}

#[test]
fn gear_and_sash_are_kept() {
    assert_eq!(
        broken("\"goggles\"", &|it| it.goggles = Some(false), &[]).len(),
        1
    );
    assert_eq!(
        broken("\"goggles\"", &|it| it.gloves = Some([true, false]), &[]).len(),
        0
    );
    assert_eq!(
        broken("\"gloves\"", &|it| it.gloves = Some([true, false]), &[]).len(),
        1
    );
    assert_eq!(
        broken("\"gloves\"", &|it| it.goggles = Some(false), &[]).len(),
        0
    );
    let sash = "{ sash = { at_most_m = 0.4 } }";
    assert_eq!(broken(sash, &|_| {}, &[]).len(), 0);
    assert_eq!(broken(sash, &|it| it.sash_m = Some(0.41), &[]).len(), 1);
}

/// A breach is one failure, however long it lasts; nothing counts meanwhile; after it has ended, the next is another.
#[test]
fn a_step_fails_once_while_what_it_keeps_is_not_so() {
    let body = "condition = { measured = { flask = \"b\", for_s = 1 } }\nkeep = [\"goggles\", { never = \"boiled-over\" }]";
    let mut run = Run::new(lesson(&[("one", body)], &[]), Mode::Free);
    let measures = |on: bool| {
        move |it: &mut Sight| {
            it.goggles = Some(on);
            it.thermometer = Some(Dip {
                flask: Some("b".to_owned()),
                speed_m_s: 0.0,
            });
        }
    };
    run.look(0.5, &measures(true));
    run.look(5.0, &measures(false));
    assert_eq!(
        run.whys(),
        [Why::NotWorn {
            gear: Gear::Goggles
        }]
    );
    assert_eq!(run.status("one"), Status::Open);
    // The half second from before the breach does not count.
    run.look(0.8, &measures(true));
    assert_eq!(run.status("one"), Status::Open);
    run.look(STEP, &measures(false));
    assert_eq!(run.whys().len(), 2);
    run.look(1.2, &measures(true));
    assert_eq!(run.status("one"), Status::Done);
    assert_eq!(run.line("one").failures, 2);
}

/// Spills count for the try in which they happen.
#[test]
fn a_new_try_begins_with_nothing_spilt() {
    let body =
        "condition = { lifted = { flask = \"a\" } }\nkeep = [{ spilt = { at_most_ml = 1 } }]";
    let mut run = Run::new(lesson(&[("one", body)], &[]), Mode::Free);
    run.wait(1.0);
    run.hear(&[spilt(10.5, 2.0)]);
    run.wait(1.0);
    run.hear(&[spilt(run.t, 0.6)]);
    assert_eq!(run.whys().len(), 1);
    run.hear(&[spilt(run.t, 0.6)]);
    assert_eq!(run.whys().len(), 2);
}

/// Liquid that is poured without goggles does not count, even after they are on again.
#[test]
fn nothing_counts_while_something_is_not_kept() {
    let body = "condition = { poured = { from = \"a\", into = \"b\", at_least_ml = 5 } }\nkeep = [\"goggles\"]";
    let mut run = Run::new(lesson(&[("one", body)], &[]), Mode::Free);
    let bare = |it: &mut Sight| it.goggles = Some(false);
    run.look(1.0, &bare);
    let from = run.t + 1.0;
    run.look(5.0, &bare);
    run.hear(&[pour([from, from + 1.0], 9.0, 2.0, 0.98)]);
    run.wait(1.0);
    assert_eq!(run.status("one"), Status::Open);
    run.hear(&[pour([run.t, run.t], 9.0, 2.0, 0.98)]);
    assert_eq!(run.status("one"), Status::Done);
}
