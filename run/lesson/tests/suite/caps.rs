//! What endangers caps the whole score, except where a lesson asks for it.

use vitriol_lesson::{
    Attempt, Cause, Danger, Evidence, Incident, Language, Lesson, Rubric, Score, Skin, Texts, What,
};

use crate::said::{TEXTS, attempts, score};

/// Liquid of that mass fraction and temperature (°C) on the right hand: a fifth of a drop, as boiling throws it.
fn on_hand(acid: f64, temperature_c: f64, protected: bool) -> Incident {
    Incident {
        t_s: 4.7,
        until_s: 4.8,
        what: What::OnSkin {
            skin: Skin::RightHand,
            volume_m3: 0.01e-6,
            acid,
            temperature_c: Some(temperature_c),
            protected,
        },
        cause: Cause::Unknown,
        place_m: [0.0; 3],
    }
}

/// Acid into water as it should be, with that on the hand.
fn right_with(incident: Incident) -> Attempt {
    let [_, mut attempt] = attempts();
    attempt.incidents.push(incident);
    attempt
}

/// 20 mL of water at 39 mL/s into acid, of which some comes to a bare hand at 148 °C; nothing else goes wrong.
fn wrong_order() -> Attempt {
    let [mut attempt, _] = attempts();
    let is_wrong_order = |it: &Incident| matches!(it.what, What::WaterIntoAcid { .. });
    attempt.incidents.retain(is_wrong_order);
    for incident in &mut attempt.incidents {
        if let What::WaterIntoAcid { volume_m3, .. } = &mut incident.what {
            *volume_m3 = 20e-6;
        }
    }
    attempt.pours[0].volume_m3 = 20e-6;
    attempt.pours[0].fastest_m3_s = 39e-6;
    attempt.incidents.push(on_hand(0.87, 148.0, false));
    attempt
}

fn dangers(score: &Score) -> Vec<Danger> {
    score.caps.iter().map(|cap| cap.danger).collect()
}

#[test]
fn the_wrong_order_with_hot_acid_on_the_skin_is_no_pass() {
    let score = score(&wrong_order());
    assert_eq!(dangers(&score), [Danger::WrongOrder, Danger::AcidOnSkin]);
    // 63.2 °C at the end of 60 to 100: 15 · 36.8/40 = 13.8; nothing boiled over or was spilt, no glass broke: 15 + 10 + 5.
    assert_eq!((score.uncapped(), score.points, score.of), (43, 40, 100));
    let [order, skin] = &score.caps[..] else {
        panic!("{:?}", score.caps);
    };
    assert_eq!(
        (order.most, order.text.as_str(), order.t_s()),
        (
            40,
            "At most 40 of 100 points: water was poured into acid.",
            Some(1.9)
        )
    );
    assert!(order.evidence[0].text.contains("the wrong order"));
    assert_eq!(skin.t_s(), Some(4.7));
    // It is said before everything else.
    let said = vitriol_lesson::sentences(&wrong_order(), &score, &TEXTS);
    assert_eq!(said[0].text, order.text);
    assert_eq!(said[0].t_s, Some(1.9));
}

/// The moment stands between both in their language, with its decimal point. Chinese sentences follow one another without a space.
#[test]
fn a_cap_and_its_evidence_are_in_one_language() {
    for (language, moment) in [
        (Language::En, " At 1.9\u{a0}s: "),
        (Language::De, " Bei 1,9\u{a0}s: "),
        (Language::Es, " A los 1,9\u{a0}s: "),
        (Language::Zh, "在 1.9\u{a0}s："),
    ] {
        let texts = Texts::of(language).unwrap();
        let score = Score::of(&wrong_order(), &Rubric::default(), &texts);
        let cap = &score.caps[0];
        let capped = texts.capped(cap);
        let evidence = &cap.evidence[0].text;
        assert_eq!(capped, format!("{}{moment}{evidence}", cap.text));
        assert_eq!(capped.contains(" At "), language == Language::En);
    }
}

/// Evidence of the whole attempt has no moment. The name of a hole in it stays as it is.
#[test]
fn evidence_is_told_as_it_is() {
    let told = |t_s| {
        let text = "{time}, {text}".into();
        TEXTS.told(&Evidence { t_s, text })
    };
    assert_eq!(told(None), "{time}, {text}");
    assert_eq!(told(Some(0.25001)), "At 0.3\u{a0}s: {time}, {text}");
}

#[test]
fn less_than_is_judged_is_no_wrong_order() {
    let mut attempt = wrong_order();
    attempt.incidents.pop();
    if let What::WaterIntoAcid { volume_m3, .. } = &mut attempt.incidents[0].what {
        *volume_m3 = 4.9e-6;
    }
    assert!(score(&attempt).caps.is_empty());
}

/// Concentrated: 51 % (UN 1830). Hot: 55 °C, with the 5 % from which it irritates (CLP).
#[test]
fn concentrated_or_hot_acid_on_bare_skin_caps() {
    for (acid, temperature_c, protected, caps) in [
        (0.98, 20.0, false, true),
        (0.51, 20.0, false, true),
        (0.50, 54.9, false, false),
        (0.05, 55.0, false, true),
        (0.049, 90.0, false, false),
        (0.98, 148.0, true, false),
    ] {
        let score = score(&right_with(on_hand(acid, temperature_c, protected)));
        let needed: &[Danger] = if caps { &[Danger::AcidOnSkin] } else { &[] };
        assert_eq!(dangers(&score), needed, "{acid} at {temperature_c} °C");
        assert_eq!(score.points == 40, caps, "{score:?}");
    }
}

/// A begun drop counts whole: none of 15 points for one on bare skin, three quarters for one on a glove.
#[test]
fn skin_counts_drops() {
    let points = |protected| {
        let score = score(&right_with(on_hand(0.98, 20.0, protected)));
        score.uncapped()
    };
    // 99 points without it.
    assert_eq!((points(false), points(true)), (99 - 15, 99 - 4));
}

#[test]
fn acid_without_goggles_caps() {
    let [_, mut right] = attempts();
    right.pours[0].bare_face = true;
    let bare = score(&right);
    assert_eq!(dangers(&bare), [Danger::NoGoggles]);
    assert_eq!(
        (bare.points, bare.caps[0].t_s()),
        (60, Some(right.pours[0].t_s))
    );
    // What does not burn needs none.
    right.pours[0].acid = 0.149;
    assert!(score(&right).caps.is_empty());
}

/// Of 85 points that can be had, 40 of 100 are 34.
#[test]
fn a_cap_is_a_share_of_what_can_be_had() {
    let mut attempt = wrong_order();
    attempt.pours[0].met.as_mut().unwrap().temperature_c = None;
    attempt.ending = None;
    let score = score(&attempt);
    assert_eq!((score.of, score.caps[0].most), (85, 34));
    assert_eq!((score.uncapped(), score.points), (30, 30));
}

#[test]
fn what_a_lesson_asks_for_does_not_cap() {
    let by = |lesson: &Lesson| Score::of(&wrong_order(), &lesson.rubric(), &TEXTS);
    let demonstration = Lesson::builtin("wrong-order").unwrap();
    assert_eq!(dangers(&by(&demonstration)), [Danger::AcidOnSkin]);
    let dilution = Lesson::builtin("dilute").unwrap();
    assert_eq!(dilution.rubric(), Rubric::default());
    assert_eq!(
        dangers(&by(&dilution)),
        [Danger::WrongOrder, Danger::AcidOnSkin]
    );
}

/// The built-in lesson with `caps` in its file.
fn with_caps(caps: &str) -> Result<Lesson, String> {
    let text = Lesson::builtin_text("dilute").unwrap();
    let text = text.replacen("[[step]]", &format!("[caps]\n{caps}\n\n[[step]]"), 1);
    Lesson::parse(&text, "own.toml").map_err(|it| it.to_string())
}

#[test]
fn a_lesson_sets_its_caps() {
    let strict = with_caps("wrong_order = 0\nacid_on_skin = 100").unwrap();
    let score = Score::of(&wrong_order(), &strict.rubric(), &TEXTS);
    assert_eq!(dangers(&score), [Danger::WrongOrder]);
    assert_eq!(score.points, 0);
    assert_eq!(
        strict.rubric().caps.sentences(&TEXTS),
        [
            "At most 0 of 100 points: water was poured into acid.",
            "At most 60 of 100 points: acid was handled without goggles.",
        ]
    );
    let refused = |caps| with_caps(caps).unwrap_err();
    let too_high = refused("no_goggles = 101");
    assert!(
        too_high.contains(": caps.no_goggles: 101 is not from 0 to 100"),
        "{too_high}"
    );
    assert!(refused("wrong_oder = 1").contains("unknown field `wrong_oder`"));
    assert!(refused("wrong_order = -1").contains("`-1` does not fit"));
    let asks = Lesson::builtin_text("dilute").unwrap().replacen(
        "points = 10",
        "points = 10\nasks = [\"wrong-oder\"]",
        1,
    );
    let unknown = Lesson::parse(&asks, "own.toml").unwrap_err().to_string();
    assert!(unknown.contains("`wrong-order`"), "{unknown}");
}

/// Scores and events from before there were caps and bare faces are read, and written as they were.
#[test]
fn older_results_are_read() {
    let [_, right] = attempts();
    let score = score(&right);
    let json = serde_json::to_value(&score).unwrap();
    assert!(json.get("caps").is_none());
    assert_eq!(serde_json::from_value::<Score>(json).unwrap(), score);
    let pour = serde_json::to_value(&right.pours[0]).unwrap();
    assert!(pour.get("bare_face").is_none() && !right.pours[0].bare_face);
    let mut rubric = serde_json::to_value(Rubric::default()).unwrap();
    rubric.as_object_mut().unwrap().remove("caps");
    let rubric: Rubric = serde_json::from_value(rubric).unwrap();
    assert_eq!(rubric, Rubric::default());
}

#[test]
fn each_language_says_the_caps() {
    for language in Language::ALL {
        let texts = Texts::of(language).unwrap();
        let score = Score::of(&wrong_order(), &Rubric::default(), &texts);
        assert!(score.caps.iter().all(|cap| cap.text.contains("40")));
    }
}

#[test]
fn a_danger_has_one_name() {
    for danger in Danger::ALL {
        assert_eq!(serde_json::to_value(danger).unwrap(), danger.name());
    }
}
