//! Lessons that ask for something that their scene does not have.

use super::spoiled::GOOD;
use super::*;
use crate::Language;
use vitriol_sim::scene::ToolKind;

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
        tools: ToolKind::ALL.to_vec(),
    }
}

/// Reads a lesson that is good except for its scene, which has these properties.
fn read_for(text: &str, facts: SceneFacts) -> Result<Lesson, LessonError> {
    Lesson::parse(text, "own.toml").unwrap();
    Lesson::parse_for(text, ("own.toml", Language::En), |_| Ok(Some(facts)))
}

/// The bench without what this names: a body, a flask of that name, or all but some of its liquid.
fn without(what: &str) -> SceneFacts {
    let mut facts = facts();
    match what {
        "a" => facts.flasks[0].name = "c".into(),
        "b" => facts.flasks[1].name = "c".into(),
        "lift of a" => facts.flasks[0].lifted = false,
        "all but 12 mL" => facts.liquid_m3 = 12e-6,
        "all but 160 mL" => facts.liquid_m3 = 160e-6,
        "heat" => facts.heat = false,
        tool => {
            let tool: ToolKind = serde_json::from_value(tool.into()).unwrap();
            facts.tools.retain(|it| *it != tool);
        }
    }
    facts
}

/// What is taken from the bench, and the parts of what is said then of a lesson that asks for all of it.
const LACKS: &str = r#"
a | step 1, condition.poured.from: | no flask "a" | "c", "b"
b | step 1, condition.poured.into: | no flask "b"
lift of a | step 2, condition.all 2, any 1, lifted.flask: | "a" is fixed | "b"
all but 12 mL | step 1, condition.poured.at_least_ml: | 12 mL in all
all but 160 mL | step 3, condition.holds.at_least_ml: | 160 mL in all
heat | step 1, keep 1: | "bench" has no heat
gloves | step 1, keep 2: | "bench" has no gloves
rod | step 2, condition.all 1, stirred: | stirring rod
goggles | step 2, condition.all 2, any 2, goggles: | goggles
"#;

#[test]
fn a_lesson_that_asks_for_what_its_scene_has_not_is_refused() {
    for line in LACKS.trim().lines() {
        let (what, needed) = line.split_once(" | ").unwrap();
        let error = read_for(GOOD, without(what)).unwrap_err().to_string();
        assert!(error.starts_with("own.toml: "), "{error}");
        for needed in needed.split(" | ") {
            assert!(error.contains(needed), "{needed} is not in {error}");
        }
    }
}

/// What a condition needs.
const CONDITIONS: &str = r#"
goggles: goggles = { on = true }
gloves: gloves = { on = false }
sash: sash = { at_most_m = 0.3 }
thermometer: measured = { flask = "b", for_s = 3 }
cloth: wiped = { surface = "bench", at_most_ml = 1 }
gloves: rinsed = { hand = "left-hand", at_least_ml = 50 }
heat: temperature = { flask = "b", at_most_c = 30 }
lift of a: put-down = { flask = "a" }
"#;

/// Each body, alone, is asked for by the conditions and requirements that need it.
#[test]
fn each_body_is_asked_for_by_what_needs_it() {
    let refused = |body: &str, what: &str| {
        let own = text(&[("one", body)], &[]);
        read_for(&own, facts()).unwrap();
        read_for(&own, without(what)).is_err()
    };
    let of = |condition: &str| format!("condition = {{ {condition} }}");
    for line in CONDITIONS.trim().lines() {
        let (what, condition) = line.split_once(": ").unwrap();
        assert!(refused(&of(condition), what), "{condition}");
    }
    for (keep, what, is_refused) in [
        (r#""goggles""#, "goggles", true),
        ("{ sash = { at_most_m = 0.3 } }", "sash", true),
        (r#"{ never = "hot" }"#, "heat", true),
        (r#"{ never = "boiled-over" }"#, "heat", false),
    ] {
        let body = format!("{}\nkeep = [{keep}]", of(r#"lifted = { flask = "a" }"#));
        assert_eq!(refused(&body, what), is_refused, "{keep}");
    }
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
