//! Reads the fields of a lesson's file. In place of a field that cannot be read there is another value, so that the rest is checked too.

use std::collections::BTreeMap;

use super::condition::{Condition, Keep};
use super::file::{MOST, Rule, Step, VERSION};
use super::mode::Mode;
use super::source::Source;
use super::words::{LessonTexts, StepTexts};
use crate::caps::Caps;
use crate::language::Language;

/// What a lesson's file has.
pub(super) struct LessonFile {
    pub version: u32,
    pub name: String,
    pub scene: String,
    pub modes: Vec<Mode>,
    pub caps: Caps,
    pub steps: Vec<Step>,
    pub rules: Vec<Rule>,
    pub texts: BTreeMap<Language, LessonTexts>,
}

/// Reads a file, and says in `source` what of it cannot be read.
pub(super) fn read(source: &mut Source<'_>) -> LessonFile {
    let needed = ["version", "name", "scene", "modes"];
    source.keys("", &needed, &["caps", "step", "rule", "texts"]);
    let raw = LessonFile {
        version: source.read("version", VERSION),
        name: source.read("name", String::new()),
        scene: source.read("scene", String::new()),
        modes: source.read("modes", vec![Mode::Guided]),
        caps: source.read("caps", Caps::default()),
        steps: each(source, ("step", 1), step),
        rules: each(source, ("rule", 0), rule),
        texts: texts(source),
    };
    skip_what_follows(source, &raw);
    raw
}

/// The tables of a list, of which there are `least` or more.
fn each<T>(
    source: &mut Source<'_>,
    (field, least): (&str, usize),
    one: fn(&mut Source<'_>, &str) -> T,
) -> Vec<T> {
    let count = source.length(field);
    if !source.is_unread(field) && !(least..=MOST).contains(&count) {
        let problem = source.texts.count.fill(&[
            ("count", &count.to_string()),
            ("least", &least.to_string()),
            ("most", &MOST.to_string()),
        ]);
        source.refuse(field, &problem);
    }
    if source.is_unread(field) {
        return Vec::new();
    }
    let fields = (0..count).map(|index| format!("{field}[{index}]"));
    fields.map(|field| one(source, &field)).collect()
}

fn step(source: &mut Source<'_>, field: &str) -> Step {
    let others = ["keep", "after", "asks", "hint_after_s", "time_limit_s"];
    source.keys(field, &["id", "condition", "points"], &others);
    let named = |name: &str| format!("{field}.{name}");
    let keeps = named("keep");
    let keep = (0..source.length(&keeps))
        .map(|nth| source.read(&format!("{keeps}[{nth}]"), Keep::Goggles))
        .collect();
    Step {
        id: source.read(&named("id"), String::new()),
        condition: source.read(&named("condition"), Condition::All(Vec::new())),
        keep,
        after: source.read(&named("after"), Vec::new()),
        asks: source.read(&named("asks"), Vec::new()),
        points: source.read(&named("points"), 1),
        hint_after_s: source.optional(&named("hint_after_s")),
        time_limit_s: source.optional(&named("time_limit_s")),
    }
}

fn rule(source: &mut Source<'_>, field: &str) -> Rule {
    source.keys(field, &["id", "keep", "points"], &[]);
    let named = |name: &str| format!("{field}.{name}");
    Rule {
        id: source.read(&named("id"), String::new()),
        keep: source.read(&named("keep"), Keep::Goggles),
        points: source.read(&named("points"), 1),
    }
}

fn texts(source: &mut Source<'_>) -> BTreeMap<Language, LessonTexts> {
    if source.has("texts") {
        source.keys("texts", &[], &Language::ALL.map(Language::code));
    }
    let mut texts = BTreeMap::new();
    for language in Language::ALL {
        let field = format!("texts.{language}");
        if source.has(&field) {
            texts.insert(language, texts_of(source, &field));
        }
    }
    texts
}

fn texts_of(source: &mut Source<'_>, field: &str) -> LessonTexts {
    source.keys(field, &["title", "summary"], &["step", "rule"]);
    let named = |name: &str| format!("{field}.{name}");
    let none = StepTexts {
        text: String::new(),
        hint: String::new(),
        hint_desk: None,
        answers: Vec::new(),
    };
    let steps = source.names(&named("step")).into_iter();
    let step = steps.map(|id| {
        let texts = source.read(&format!("{field}.step.{id}"), none.clone());
        (id, texts)
    });
    let step = step.collect();
    let rules = source.names(&named("rule")).into_iter();
    let rule = rules.map(|id| {
        let text = source.read(&format!("{field}.rule.{id}"), String::new());
        (id, text)
    });
    let rule = rule.collect();
    LessonTexts {
        title: source.read(&named("title"), String::new()),
        summary: source.read(&named("summary"), String::new()),
        step,
        rule,
    }
}

/// Says nothing of what only follows from a field that could not be read: without the id of one step it is not known which texts are
/// missing, or which steps may be named.
fn skip_what_follows(source: &mut Source<'_>, raw: &LessonFile) {
    let ids = unread(source, ("step", raw.steps.len()), "id");
    let conditions = unread(source, ("step", raw.steps.len()), "condition");
    let rules = unread(source, ("rule", raw.rules.len()), "id");
    let no_steps = source.is_unread("step") || ids.contains(&true);
    let no_rules = source.is_unread("rule") || rules.contains(&true);
    for language in Language::ALL {
        if no_steps {
            source.skip(format!("texts.{language}.step"));
        }
        if no_rules {
            source.skip(format!("texts.{language}.rule"));
        }
        for (step, _) in raw.steps.iter().zip(&conditions).filter(|(_, it)| **it) {
            source.skip(format!("texts.{language}.step.{}.answers", step.id));
        }
    }
    if no_steps {
        for index in 0..raw.steps.len() {
            source.skip(format!("step[{index}].after"));
        }
    }
}

/// Of each table of a list, whether that key of it could not be read.
fn unread(source: &Source<'_>, (list, count): (&str, usize), key: &str) -> Vec<bool> {
    let fields = (0..count).map(|index| format!("{list}[{index}].{key}"));
    fields.map(|field| source.is_unread(&field)).collect()
}
