//! Lessons that ask for something that their scene does not have.

use super::spoiled::GOOD;
use super::*;
use crate::Language;

type Change<'a> = &'a dyn Fn(&mut SceneFacts);

/// Properties of a bench with all bodies, from which tests take some away.
pub(super) fn facts() -> SceneFacts {
    let flask = |name: &str| FlaskFacts {
        name: name.to_owned(),
        lifted: true,
    };
    SceneFacts {
        name: "bench".to_owned(),
        flasks: vec![flask("a"), flask("b")],
        liquid_m3: 180e-6,
        heat: true,
        goggles: true,
        gloves: true,
        sash: true,
        rod: true,
        thermometer: true,
        cloth: true,
        rinsing: true,
    }
}

/// Reads a lesson that is good except for its scene, which has these properties.
fn read_for(text: &str, facts: SceneFacts) -> Result<Lesson, LessonError> {
    Lesson::parse(text, "own.toml").unwrap();
    Lesson::parse_for(text, ("own.toml", Language::En), |_| Ok(Some(facts)))
}

#[test]
fn a_lesson_that_asks_for_what_its_scene_has_not_is_refused() {
    let changes: &[(Change<'_>, &[&str])] = &[
        (
            &|it| it.flasks[0].name = "c".into(),
            &[
                "step 1, condition.poured.from:",
                "no flask \"a\"",
                "\"c\", \"b\"",
            ],
        ),
        (
            &|it| it.flasks[1].name = "c".into(),
            &["step 1, condition.poured.into:", "no flask \"b\""],
        ),
        (
            &|it| it.flasks[0].lifted = false,
            &[
                "step 2, condition.all 2, any 1, lifted.flask:",
                "\"a\" is fixed",
                "\"b\"",
            ],
        ),
        (
            &|it| it.liquid_m3 = 12e-6,
            &["step 1, condition.poured.at_least_ml:", "12 mL in all"],
        ),
        (
            &|it| it.liquid_m3 = 160e-6,
            &["step 3, condition.holds.at_least_ml:", "160 mL in all"],
        ),
        (
            &|it| it.heat = false,
            &["step 1, keep 1:", "\"bench\" has no heat"],
        ),
        (
            &|it| it.gloves = false,
            &["step 1, keep 2:", "\"bench\" has no gloves"],
        ),
        (
            &|it| it.rod = false,
            &["step 2, condition.all 1, stirred:", "stirring rod"],
        ),
        (
            &|it| it.goggles = false,
            &["step 2, condition.all 2, any 2, goggles:", "goggles"],
        ),
    ];
    for (change, needed) in changes {
        let mut facts = facts();
        change(&mut facts);
        let error = read_for(GOOD, facts).unwrap_err().to_string();
        assert!(error.starts_with("own.toml: "), "{error}");
        for needed in *needed {
            assert!(error.contains(needed), "{needed} is not in {error}");
        }
    }
}

/// Each body, alone, is asked for by the conditions that need it.
#[test]
fn each_body_is_asked_for_by_what_needs_it() {
    let refused = |body: &str, change: &dyn Fn(&mut SceneFacts)| {
        let own = text(&[("one", body)], &[]);
        read_for(&own, facts()).unwrap();
        let mut facts = facts();
        change(&mut facts);
        read_for(&own, facts).is_err()
    };
    let of = |condition: &str| format!("condition = {{ {condition} }}");
    let keep =
        |keep: &str| format!("condition = {{ lifted = {{ flask = \"a\" }} }}\nkeep = [{keep}]");
    assert!(refused(&of("goggles = { on = true }"), &|it| it.goggles = false));
    assert!(refused(&of("gloves = { on = false }"), &|it| it.gloves = false));
    assert!(refused(&of("sash = { at_most_m = 0.3 }"), &|it| it.sash = false));
    assert!(refused(
        &of("measured = { flask = \"b\", for_s = 3 }"),
        &|it| it.thermometer = false
    ));
    assert!(refused(
        &of("wiped = { surface = \"bench\", at_most_ml = 1 }"),
        &|it| it.cloth = false
    ));
    assert!(refused(
        &of("rinsed = { hand = \"left-hand\", at_least_ml = 50 }"),
        &|it| it.rinsing = false
    ));
    assert!(refused(
        &of("temperature = { flask = \"b\", at_most_c = 30 }"),
        &|it| it.heat = false
    ));
    assert!(refused(&of("put-down = { flask = \"a\" }"), &|it| it
        .flasks[0]
        .lifted =
        false));
    assert!(refused(&keep("\"goggles\""), &|it| it.goggles = false));
    assert!(refused(&keep("{ sash = { at_most_m = 0.3 } }"), &|it| it
        .sash =
        false));
    assert!(refused(&keep("{ never = \"hot\" }"), &|it| it.heat = false));
    assert!(!refused(&keep("{ never = \"boiled-over\" }"), &|it| it
        .heat =
        false));
    let same = text(
        &[(
            "one",
            &of("poured = { from = \"a\", into = \"a\", at_least_ml = 1 }"),
        )],
        &[],
    );
    let error = read_for(&same, facts()).unwrap_err().to_string();
    assert!(
        error.contains("poured.into") && error.contains("name another"),
        "{error}"
    );
}
