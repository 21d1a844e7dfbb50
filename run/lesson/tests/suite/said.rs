//! Two attempts from their events to words.

use std::sync::LazyLock;

use vitriol_lesson::{
    Attempt, Cause, Event, Language, Rubric, Score, Sentence, Skin, Texts, Tone, What, layered,
    sentences,
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

pub(super) fn said(attempt: &Attempt) -> Vec<Sentence> {
    let said = sentences(attempt, &score(attempt), &TEXTS);
    // Between number and unit stands a space that no line breaks at.
    let plain = |sentence: Sentence| Sentence {
        text: sentence.text.replace('\u{a0}', " "),
        more: sentence.more.map(|it| it.replace('\u{a0}', " ")),
        ..sentence
    };
    said.into_iter().map(plain).collect()
}

/// An attempt with a flask of acid and one of water, in which nobody did anything.
pub(super) fn untouched() -> Attempt {
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
