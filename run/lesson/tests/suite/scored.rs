//! The same two attempts from their events to points.

use proptest::prelude::*;
use vitriol_lesson::{Cause, Criterion, Incident, Pour, Score, Skin, Surface, Tone, What};

use crate::said::{attempts, said, score, untouched};

fn points(score: &Score, criterion: Criterion) -> Option<(u32, u32)> {
    let line = score.lines.iter().find(|it| it.criterion == criterion);
    line.map(|it| (it.points, it.of))
}

/// Drops that boiling threw onto a hand may be too few for a boil-over: its points stay, and nobody is praised for it.
#[test]
fn boiling_that_reaches_skin_did_not_go_well() {
    let [wrong, mut right] = attempts();
    let is_burn = |it: &Incident| {
        matches!(it.what, What::OnSkin { .. }) && matches!(it.cause, Cause::Boiling { .. })
    };
    right.incidents = wrong.incidents.into_iter().filter(is_burn).collect();
    assert!(!right.incidents.is_empty());
    let kept = points(&score(&right), Criterion::NothingThrownOut);
    assert_eq!(kept, Some((15, 15)));
    let mut said = said(&right).into_iter();
    assert!(said.all(|it| it.text != "Nothing boiled over."));
}

/// Against the default rubric, by hand.
#[test]
fn points_are_what_the_rubric_says() {
    let [wrong, right] = attempts().map(|it| score(&it));
    let of = |score: &Score| Criterion::ALL.map(|it| points(score, it).unwrap());
    // 12.3 mL/s between 5 and 20: 15 · 7.7/15 = 7.7; 134 °C, above 100; 2.6 mL of 5 spilt: 10 · 2.4/5 =
    // 4.8; on skin five drops and a quarter, where one leaves no points.
    assert_eq!(
        of(&wrong),
        [(0, 25), (7, 15), (0, 15), (0, 15), (4, 10), (0, 15), (0, 5)]
    );
    assert_eq!((wrong.points, wrong.of), (11, 100));
    // 0.078 mL of 5: 10 · 4.922/5 = 9.8.
    assert_eq!(
        of(&right),
        [
            (25, 25),
            (15, 15),
            (15, 15),
            (15, 15),
            (9, 10),
            (15, 15),
            (5, 5)
        ]
    );
    assert_eq!((right.points, right.of), (99, 100));
    for line in wrong.lines.iter().chain(&right.lines) {
        assert!(
            !line.evidence.is_empty() && !line.rule.is_empty(),
            "{line:?}"
        );
    }
    // Evidence for points that are withheld for an incident has its moment.
    for line in &wrong.lines {
        assert!(line.evidence.iter().any(|it| it.t_s.is_some()), "{line:?}");
    }
}

#[test]
fn who_does_nothing_has_no_score() {
    let none = score(&untouched());
    assert_eq!((none.points, none.of), (0, 0));
    assert_eq!(none.left_out.len(), Criterion::ALL.len());
    let said = said(&untouched());
    assert_eq!(said.len(), 1);
    assert_eq!(said[0].text, "Nothing was poured.");
    // Nor does a student who touches nothing and lets a flask fall.
    let [wrong, _] = attempts();
    let mut attempt = untouched();
    attempt
        .incidents
        .push(wrong.incidents.last().unwrap().clone());
    assert_eq!(
        points(&score(&attempt), Criterion::GlassWhole),
        Some((0, 5))
    );
}

/// Only water moved, where acid stood beside it: no point for a dilution, and no hundred per cent.
#[test]
fn who_dilutes_nothing_has_no_points_for_it() {
    let mut attempt = untouched();
    attempt.pours = vec![Pour {
        t_s: 1.0,
        until_s: 3.0,
        from: "target".into(),
        into: Some("third".into()),
        volume_m3: 50e-6,
        fastest_m3_s: 30e-6,
        acid: 0.0,
        met: None,
        bare_face: false,
    }];
    let with_acid = score(&attempt);
    for criterion in &Criterion::ALL[..3] {
        assert_eq!(points(&with_acid, *criterion).unwrap().0, 0);
    }
    assert!(with_acid.points < with_acid.of);
    // Where there is no acid, none is asked for.
    attempt.contents.remove("source");
    let without = score(&attempt);
    assert_eq!((without.points, without.of), (45, 45));
    let why: Vec<_> = without.left_out.iter().map(|it| it.why.as_str()).collect();
    assert_eq!(
        why,
        ["The scene has no acid and water in separate vessels."; 3]
    );
}

#[test]
fn where_no_heat_is_modelled_none_is_judged() {
    let [_, mut right] = attempts();
    let pours = right.pours.iter_mut().filter_map(|it| it.met.as_mut());
    pours.for_each(|it| it.temperature_c = None);
    let ending = right.ending.as_mut().unwrap();
    ending.hottest = None;
    ending
        .contents
        .values_mut()
        .for_each(|it| it.temperature_c = None);
    let score = score(&right);
    assert_eq!(points(&score, Criterion::StayedCool), None);
    assert_eq!((score.points, score.of), (84, 85));
    let said = said(&right);
    assert_eq!(said.last().unwrap().tone, Tone::Good);
    assert!(
        said.iter()
            .any(|it| it.text == "At the end the beaker with water holds: 180 mL of 19 % acid.")
    );
}

#[test]
fn a_recording_that_breaks_off_says_so() {
    let [_, mut right] = attempts();
    right.ending = None;
    assert_eq!(points(&score(&right), Criterion::StayedCool), None);
    let said = said(&right);
    assert_eq!(
        said.last().unwrap().text,
        "The recording breaks off before the attempt ends."
    );
}

fn what() -> impl Strategy<Value = What> {
    let flask = || "target".to_owned();
    let volume = || 0.0..2e-5;
    prop_oneof![
        volume().prop_map(move |volume_m3| What::WaterIntoAcid {
            flask: flask(),
            met_acid: 0.96,
            volume_m3
        }),
        volume().prop_map(move |rate_m3_s| What::PouredTooFast {
            flask: flask(),
            rate_m3_s,
            limit_m3_s: 5e-6
        }),
        (volume(), 0.0..1.0).prop_map(move |(volume_m3, acid)| What::BoiledOver {
            flask: flask(),
            volume_m3,
            acid
        }),
        (volume(), 0.0..1.0).prop_map(|(volume_m3, acid)| What::Spilt {
            surface: Surface::Floor,
            volume_m3,
            acid
        }),
        (volume(), any::<bool>()).prop_map(|(volume_m3, protected)| What::OnSkin {
            skin: Skin::Face,
            volume_m3,
            acid: 0.5,
            temperature_c: None,
            protected
        }),
        any::<bool>().prop_map(move |broke| What::Dropped {
            flask: flask(),
            speed_m_s: 2.0,
            broke
        }),
        (40.0..200.0).prop_map(move |temperature_c| What::Hot {
            flask: flask(),
            temperature_c
        }),
    ]
}

/// A worse incident of the same kind: larger volume, higher rate or temperature, or broken glass.
fn worse(what: &What) -> What {
    let mut what = what.clone();
    match &mut what {
        What::WaterIntoAcid { volume_m3, .. }
        | What::BoiledOver { volume_m3, .. }
        | What::Spilt { volume_m3, .. }
        | What::OnSkin { volume_m3, .. } => *volume_m3 *= 1.5,
        What::PouredTooFast { rate_m3_s, .. } => *rate_m3_s *= 1.5,
        What::Dropped { broke, .. } => *broke = true,
        What::Hot { temperature_c, .. } => *temperature_c += 20.0,
    }
    what
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// In any attempt, done or not: another incident, or a worse one, never gives points, nor a better share.
    #[test]
    fn more_that_goes_wrong_never_scores_more(whats in prop::collection::vec(what(), 1..5), which in 0..3) {
        let [wrong, right] = attempts();
        let mut attempt = [wrong, right, untouched()][which as usize].clone();
        let incident = |what| Incident {
            t_s: 1.0, until_s: 2.0, what, cause: Cause::Unknown, place_m: [0.0; 3],
        };
        let mut before = score(&attempt);
        for what in whats {
            for what in [what.clone(), worse(&what)] {
                attempt.incidents.push(incident(what));
                let after = score(&attempt);
                prop_assert!(after.points <= before.points);
                prop_assert!(after.of >= before.of);
                for line in &after.lines {
                    let (had, _) = points(&before, line.criterion).unwrap_or((0, 0));
                    prop_assert!(line.points <= had, "{:?}", line);
                }
                before = after;
                attempt.incidents.pop();
            }
            attempt.incidents.push(incident(what));
            before = score(&attempt);
        }
    }
}
