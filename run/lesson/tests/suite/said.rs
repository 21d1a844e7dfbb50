//! Two attempts from their events to words, points and rows.

use std::sync::LazyLock;

use proptest::prelude::*;
use vitriol_lesson::{
    Attempt, Cause, Criterion, Event, Incident, Language, Pour, Rubric, Score, Sentence, Skin,
    Surface, Texts, Tone, What, layered, sentences,
};
use vitriol_sim::scene::Scene;

/// Water poured into acid, then acid into water, as a recording has them.
pub(super) fn attempts() -> [Attempt; 2] {
    let events: Vec<Event> = serde_json::from_str(include_str!("../events.json")).unwrap();
    Attempt::all(events).try_into().unwrap()
}

pub(super) static TEXTS: LazyLock<Texts> = LazyLock::new(|| Texts::english().unwrap());

pub(super) fn score(attempt: &Attempt) -> Score {
    Score::of(attempt, &Rubric::default(), &TEXTS)
}

fn said(attempt: &Attempt) -> Vec<Sentence> {
    let said = sentences(attempt, &score(attempt), &TEXTS);
    // Between number and unit stands a space that no line breaks at.
    let plain = |sentence: Sentence| Sentence {
        text: sentence.text.replace('\u{a0}', " "),
        more: sentence.more.map(|it| it.replace('\u{a0}', " ")),
        ..sentence
    };
    said.into_iter().map(plain).collect()
}

fn points(score: &Score, criterion: Criterion) -> Option<(u32, u32)> {
    let line = score.lines.iter().find(|it| it.criterion == criterion);
    line.map(|it| (it.points, it.of))
}

/// An attempt with a flask of acid and one of water, in which nobody did anything.
fn untouched() -> Attempt {
    let [_, mut attempt] = attempts();
    attempt.pours.clear();
    attempt.incidents.clear();
    let ending = attempt.ending.as_mut().unwrap();
    ending.contents = attempt.contents.clone();
    ending.hottest.as_mut().unwrap().temperature_c = 20.9;
    attempt
}

#[test]
fn the_wrong_order_is_told_with_its_causes() {
    let [wrong, _] = attempts();
    let said = said(&wrong);
    let (caps, said) = said.split_at(2);
    let caps: Vec<_> = caps.iter().map(|it| it.text.as_str()).collect();
    assert_eq!(
        caps,
        [
            "At most 40 of 100 points: water was poured into acid.",
            "At most 40 of 100 points: concentrated or hot acid got on bare skin.",
        ]
    );
    let bad = said.iter().filter(|it| it.tone == Tone::Bad);
    // Each with its cause, danger and remedy.
    let bad: Vec<_> = bad
        .flat_map(|it| [it.text.as_str(), it.more.as_deref().unwrap_or("")])
        .collect();
    assert_eq!(
        bad,
        [
            "Water was poured into 96 % acid, the wrong order: 25 mL in 3.1 s, at most 12 mL/s, into the beaker with 98 % acid.",
            "Water floats on the acid, boils at once where they meet, and throws acid out.",
            "Acid and water came together too fast in the beaker with 98 % acid: 12 mL/s, where 5.0 mL/s is safe.",
            "The heat comes faster than the liquid can spread it.",
            "Liquid in the beaker with 98 % acid reached 134 °C.",
            "Acid and water gave off heat as they mixed in the beaker with 98 % acid. \
             Liquid this hot burns skin at once, and a thin glove does not help.",
            "The beaker with 98 % acid boiled over and threw out: 3.4 mL of 71 % acid.",
            "Acid this concentrated burns skin and can blind: 15 % is enough.",
            "On the skin of the right hand: 0.21 mL of 68 % acid.",
            "The liquid in the beaker with 98 % acid was boiling. Rinse at once, with plenty of water.",
            "On the goggles: 0.047 mL of 68 % acid.",
            "The liquid in the beaker with 98 % acid was boiling. What was worn there kept it off the skin: rinse it, take it off, and rinse the skin.",
            "Spilt on the bench: 2.6 mL of 71 % acid.",
            "The liquid in the beaker with 98 % acid was boiling. Wipe it up before someone touches it.",
            "The beaker with water hit something at 3.8 m/s and broke.",
            "",
        ]
    );
    // Each danger is named once: at the first incident that has it. In the order of the film, and the pour is not described twice.
    let times: Vec<f64> = said.iter().filter_map(|it| it.t_s).collect();
    assert!(times.is_sorted(), "{times:?}");
    assert_eq!(
        said.iter().filter(|it| it.text.contains("oured")).count(),
        1
    );
    assert!(!said.iter().any(|it| it.tone == Tone::Good), "{said:?}");
}

/// That moving layers mixed them is said of what boiled over.
#[test]
fn layers_that_were_moved_are_a_cause_in_words() {
    let [mut attempt, _] = attempts();
    for incident in &mut attempt.incidents {
        if matches!(incident.what, What::BoiledOver { .. }) {
            incident.cause = Cause::Swirling {
                flask: "target".into(),
            };
        }
    }
    let words = "Acid and water lay in layers in the beaker with 98 % acid. Moving it mixed them, and all the heat of mixing came at once.";
    let said = said(&attempt);
    let mut more = said.iter().filter_map(|it| it.more.as_deref());
    assert!(more.any(|it| it.starts_with(words)), "{said:?}");
}

/// A title says what was done, and nothing where acid and water stayed apart. The wrong order comes first.
#[test]
fn a_title_says_what_was_done() {
    let [wrong, right] = attempts();
    let wrong_order = "Water was poured into concentrated acid";
    let done = |attempts: &[Attempt]| TEXTS.done(attempts);
    assert_eq!(
        done(std::slice::from_ref(&wrong)).as_deref(),
        Some(wrong_order)
    );
    assert_eq!(
        done(std::slice::from_ref(&right)).as_deref(),
        Some("Acid was poured into water")
    );
    assert_eq!(done(&[right, wrong]).as_deref(), Some(wrong_order));
    assert_eq!(done(&[untouched()]), None);
}

/// Whatever is said of these attempts, in each language, has no name of a flask from the scene's file.
#[test]
fn no_sentence_has_a_flasks_name_from_its_file() {
    for language in Language::ALL {
        let texts = Texts::of(language).unwrap();
        for attempt in attempts() {
            let score = Score::of(&attempt, &Rubric::default(), &texts);
            let evidence = score.lines.iter().flat_map(|line| &line.evidence);
            let evidence: Vec<String> = evidence.map(|it| it.text.clone()).collect();
            let said = sentences(&attempt, &score, &texts).into_iter();
            let said = said.flat_map(|it| [Some(it.text), it.more]).flatten();
            for text in said.chain(evidence) {
                let named = ["source", "target", "{", "}"];
                assert!(
                    !named.iter().any(|it| text.contains(it)),
                    "{language}: {text}"
                );
            }
        }
    }
}

/// A recording of an older version, which does not say what the flasks are, is the same as its replay; another attempt is not.
#[test]
fn an_older_recording_is_the_same_without_its_glass() {
    let found: Vec<Event> = serde_json::from_str(include_str!("../events.json")).unwrap();
    let mut recorded = found.clone();
    for event in &mut recorded {
        if let Event::Begun { glass, .. } = event {
            glass.clear();
        }
    }
    assert!(Event::are_same(&found, &found) && Event::are_same(&recorded, &found));
    // But not the other way round, nor where an event lacks.
    assert!(!Event::are_same(&found, &recorded));
    assert!(!Event::are_same(&recorded, &found[1..]));
    // And it is told of in words that name no file.
    let [attempt, _]: [Attempt; 2] = Attempt::all(recorded).try_into().unwrap();
    assert!(
        said(&attempt)
            .iter()
            .any(|it| it.text.starts_with("The vessel boiled over"))
    );
}

/// Acid and water first meet where the first pour that mixes them arrives.
#[test]
fn the_first_contact_is_the_first_pour_that_mixes() {
    let [wrong, mut right] = attempts();
    assert_eq!(wrong.first_contact(), Some((1.9, "target")));
    assert_eq!(right.first_contact(), Some((10.2, "target")));
    // Water into water mixes nothing.
    right.pours[0].acid = 0.0;
    assert_eq!(right.first_contact(), None);
    assert_eq!(untouched().first_contact(), None);
}

#[test]
fn acid_and_water_that_lie_on_one_another_are_found() {
    let mut scene = Scene::builtin("water-into-acid").unwrap();
    assert_eq!(layered(&scene), None);
    scene.liquids[0].flask = scene.liquids[1].flask;
    assert_eq!(layered(&scene), Some("target"));
}

#[test]
fn what_went_well_is_told_too() {
    let [_, right] = attempts();
    let said = said(&right);
    let of = |tone| {
        said.iter()
            .filter(move |it| it.tone == tone)
            .map(|it| it.text.as_str())
    };
    assert_eq!(
        of(Tone::Good).collect::<Vec<_>>(),
        [
            "Acid was poured into water, the right order: 20 mL of 98 % acid in 6.2 s, at most 4.2 mL/s, from the beaker with 98 % acid into the beaker with water.",
            "Acid and water came together slowly: at most 4.2 mL/s.",
            "The mixture reached at most 55 °C.",
            "Nothing boiled over.",
            "No acid or hot liquid got on hands or face.",
            "No vessel was dropped or broken.",
        ]
    );
    assert_eq!(
        of(Tone::Plain).collect::<Vec<_>>(),
        [
            "The hottest drop was at 91 °C, in the beaker with water.",
            "At the end the beaker with water holds: 180 mL of 19 % acid, at 55 °C.",
        ]
    );
    assert_eq!(of(Tone::Bad).count(), 1);
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

/// From the table of the Consumer Product Safety Commission: 140 °F, six seconds.
#[test]
fn hot_liquid_on_skin_says_how_long_it_takes() {
    let [_, mut right] = attempts();
    right.incidents[0].what = What::OnSkin {
        skin: Skin::LeftHand,
        volume_m3: 2e-6,
        acid: 0.06,
        temperature_c: Some(60.0),
        protected: false,
    };
    let said = said(&right);
    // Behind the cap.
    let bad = said
        .iter()
        .filter(|it| it.tone == Tone::Bad)
        .nth(1)
        .unwrap();
    assert_eq!(
        bad.more.as_deref(),
        Some(
            "It happened while liquid was poured from the beaker with 98 % acid. Acid this concentrated irritates skin and eyes. \
             Liquid this hot burns through skin in 6.0 s. Rinse at once, with plenty of water."
        )
    );
}

#[test]
fn a_pour_beside_is_told_once() {
    let [_, mut right] = attempts();
    let mut beside = right.pours[0].clone();
    (beside.into, beside.met) = (None, None);
    right.pours.push(beside);
    let spilt = |attempt: &Attempt| {
        said(attempt)
            .iter()
            .filter(|it| it.text.contains("outside every vessel"))
            .count()
    };
    assert_eq!(spilt(&right), 0, "the bench's incident has it");
    right.incidents.clear();
    assert_eq!(spilt(&right), 1);
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
