//! A lesson, and the text of the file that it is in.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use xxhash_rust::xxh3::xxh3_128;

use super::condition::{Condition, Keep};
use super::error::{LessonError, Problem, listed, within};
use super::mode::Mode;
use super::sight::SceneFacts;
use super::words::LessonTexts;
use crate::caps::{Caps, Danger, WHOLE};
use crate::language::Language;
use crate::rubric::Rubric;
use crate::texts::Texts;

/// Version of the file format that is read here.
const VERSION: u32 = 1;
/// Most steps of a lesson, and most rules.
const MOST: usize = 50;
/// Most points of a step or rule.
const MOST_POINTS: u32 = 1000;
/// Longest id or name, characters.
const LONGEST_ID: usize = 40;
/// Longest time that a step may state, s.
const LONGEST_TIME: f64 = 3600.0;

/// The lessons that come with the program: name and text.
const BUILTIN: [(&str, &str); 6] = [
    ("dilute", include_str!("../../lessons/dilute.toml")),
    (
        "wrong-order",
        include_str!("../../lessons/wrong-order.toml"),
    ),
    (
        "wrong-order-layered",
        include_str!("../../lessons/wrong-order-layered.toml"),
    ),
    (
        "wrong-order-hot",
        include_str!("../../lessons/wrong-order-hot.toml"),
    ),
    (
        "examination",
        include_str!("../../lessons/examination.toml"),
    ),
    ("emergency", include_str!("../../lessons/emergency.toml")),
];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LessonFile {
    version: u32,
    name: String,
    scene: String,
    modes: Vec<Mode>,
    #[serde(default)]
    caps: Caps,
    #[serde(default)]
    step: Vec<Step>,
    #[serde(default)]
    rule: Vec<Rule>,
    #[serde(default)]
    texts: BTreeMap<Language, LessonTexts>,
}

/// A step of a lesson.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Its id, which is the key of its texts.
    pub id: String,
    /// The condition that completes it.
    pub condition: Condition,
    /// Requirements that must hold from its beginning until it is done.
    #[serde(default)]
    pub keep: Vec<Keep>,
    /// Ids of earlier steps that must be done or missed before it begins, where several steps are open at a time.
    #[serde(default)]
    pub after: Vec<String>,
    /// Dangers that the student is asked for here: the lesson does not cap the score for them.
    #[serde(default)]
    pub asks: Vec<Danger>,
    /// Points for it.
    pub points: u32,
    /// Simulated time from its beginning or its last failure until its hint is shown, s; `None`: only on request.
    pub hint_after_s: Option<f64>,
    /// Simulated time from its beginning until it is missed, s; `None`: no limit.
    pub time_limit_s: Option<f64>,
}

/// A requirement that must hold from the beginning of a lesson to its end.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rule {
    /// Its id, which is the key of its text.
    pub id: String,
    /// The requirement.
    pub keep: Keep,
    /// Points for it.
    pub points: u32,
}

/// A lesson, validated except against its scene, for which there is [`Lesson::check`].
#[derive(Clone, Debug, PartialEq)]
pub struct Lesson {
    /// Its name.
    pub name: String,
    /// Its scene: a built-in one's name, or a file.
    pub scene: String,
    /// Modes that it allows; the first is the default.
    pub modes: Vec<Mode>,
    /// Its steps in their order.
    pub steps: Vec<Step>,
    /// Its rules, which hold throughout.
    pub rules: Vec<Rule>,
    caps: Caps,
    file: String,
    hash: String,
    english: LessonTexts,
    others: BTreeMap<Language, LessonTexts>,
}

impl Lesson {
    /// Names of the lessons that come with the program.
    pub fn builtin_names() -> Vec<&'static str> {
        BUILTIN.iter().map(|(name, _)| *name).collect()
    }

    /// Text of the built-in lesson of that name, as a template for others.
    pub fn builtin_text(name: &str) -> Option<&'static str> {
        let found = BUILTIN.iter().find(|(known, _)| *known == name);
        found.map(|(_, text)| *text)
    }

    /// The built-in lesson of that name, with the texts of `run/lesson/texts`.
    ///
    /// # Errors
    /// [`LessonError::NotFound`] for an unknown name. A test rules out the other errors.
    pub fn builtin(name: &str) -> Result<Self, LessonError> {
        let Some(text) = Self::builtin_text(name) else {
            return Err(LessonError::NotFound {
                name: name.to_owned(),
                known: Self::builtin_names().join(", "),
            });
        };
        Self::parse(text, &format!("{name}.toml"))
    }

    /// Parses a lesson from its TOML `text`; `file` is its name in messages. A lesson without texts that has the name of a built-in one
    /// gets that one's texts.
    ///
    /// # Errors
    /// [`LessonError`] where the text is not TOML, a key is missing or unknown, a value is out of its range, or a language is not
    /// complete.
    pub fn parse(text: &str, file: &str) -> Result<Self, LessonError> {
        let raw: LessonFile = toml::from_str(text).map_err(|error| LessonError::Syntax {
            file: file.to_owned(),
            message: error.to_string().trim_end().to_owned(),
        })?;
        let in_file = |problem: Problem| problem.in_file(file);
        check(&raw).map_err(in_file)?;
        let mut others = raw.texts;
        if others.is_empty() && Self::builtin_text(&raw.name).is_some() {
            for language in Language::ALL {
                if let Some(texts) = Texts::of(language)?.lesson.remove(&raw.name) {
                    others.insert(language, texts);
                }
            }
        }
        let steps = raw.step.iter().map(|step| {
            let question = step.condition.question();
            let answers = question.map_or(0, |it| usize::from(it.answers));
            (step.id.as_str(), answers)
        });
        let steps: Vec<(&str, usize)> = steps.collect();
        let rules: Vec<&str> = raw.rule.iter().map(|rule| rule.id.as_str()).collect();
        for (language, texts) in &others {
            let checked = texts.check(*language, (&steps, &rules));
            checked.map_err(in_file)?;
        }
        let Some(english) = others.remove(&Language::En) else {
            let problem = "missing; a lesson has English texts, which stand in for other languages";
            return Err(in_file(Problem::new("texts.en", problem)));
        };
        Ok(Self {
            name: raw.name,
            scene: raw.scene,
            modes: raw.modes,
            steps: raw.step,
            rules: raw.rule,
            caps: raw.caps,
            file: file.to_owned(),
            hash: format!("{:032x}", xxh3_128(text.as_bytes())),
            english,
            others,
        })
    }

    /// Checks that the scene with these `facts` has everything that the lesson asks for.
    ///
    /// # Errors
    /// [`LessonError::Invalid`] for the first thing that the scene lacks.
    pub fn check(&self, facts: &SceneFacts) -> Result<(), LessonError> {
        let fits = || {
            for (index, step) in self.steps.iter().enumerate() {
                let field = step.condition.field(&format!("step[{index}].condition"));
                step.condition.fits(&field, facts)?;
                for (nth, keep) in step.keep.iter().enumerate() {
                    keep.fits(&format!("step[{index}].keep[{nth}]"), facts)?;
                }
            }
            for (index, rule) in self.rules.iter().enumerate() {
                rule.keep.fits(&format!("rule[{index}].keep"), facts)?;
            }
            Ok(())
        };
        fits().map_err(|problem: Problem| problem.in_file(&self.file))
    }

    /// Hash of its file's text, XXH3 of 128 bits in hexadecimal: lessons of one name and hash are the same.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// What an attempt at it is scored by: with the caps of its file, without those for what one of its steps asks for.
    pub fn rubric(&self) -> Rubric {
        let asked = self.steps.iter().flat_map(|step| &step.asks);
        Rubric {
            caps: asked.fold(self.caps, |caps, danger| caps.without(*danger)),
            ..Rubric::default()
        }
    }

    /// Its texts in that language, or in English if it has none.
    pub fn texts(&self, language: Language) -> &LessonTexts {
        self.others.get(&language).unwrap_or(&self.english)
    }

    /// The languages of its texts.
    pub fn languages(&self) -> Vec<Language> {
        let others = self.others.keys().copied();
        std::iter::once(Language::En).chain(others).collect()
    }

    /// The mode that is used where none is named.
    pub fn default_mode(&self) -> Mode {
        self.modes.first().copied().unwrap_or(Mode::Guided)
    }
}

/// Checks the values of the file, except its texts.
fn check(raw: &LessonFile) -> Result<(), Problem> {
    if raw.version != VERSION {
        let problem = format!(
            "{} is not known here; this program reads {VERSION}",
            raw.version
        );
        return Err(Problem::new("version", problem));
    }
    check_id("name", &raw.name)?;
    if raw.scene.trim().is_empty() {
        return Err(Problem::new("scene", "empty; name a scene"));
    }
    let modes: BTreeSet<Mode> = raw.modes.iter().copied().collect();
    if modes.is_empty() || modes.len() < raw.modes.len() {
        let problem = "has none, or one twice; take of \"guided\", \"free\", \"examination\" each that it allows, its usual one first";
        return Err(Problem::new("modes", problem));
    }
    let asks = raw.step.iter().any(|it| it.condition.question().is_some());
    if asks && modes.contains(&Mode::Examination) {
        let problem = "has \"examination\", in which no step is shown; take it out, or take the lesson's questions out";
        return Err(Problem::new("modes", problem));
    }
    for (name, most) in raw.caps.named() {
        let field = format!("caps.{name}");
        within(&field, f64::from(most), 0.0, f64::from(WHOLE))?;
    }
    for (field, count, least) in [("step", raw.step.len(), 1), ("rule", raw.rule.len(), 0)] {
        if !(least..=MOST).contains(&count) {
            let problem = format!("there are {count}; a lesson has {least} to {MOST}");
            return Err(Problem::new(field, problem));
        }
    }
    let mut ids = Vec::new();
    for (index, step) in raw.step.iter().enumerate() {
        let field = |name: &str| format!("step[{index}].{name}");
        check_step(&field, step, &ids)?;
        ids.push(step.id.as_str());
    }
    if raw.step.iter().all(|step| step.points == 0) {
        let problem = "no step has points; give one some";
        return Err(Problem::new("step[0].points", problem));
    }
    for (index, rule) in raw.rule.iter().enumerate() {
        let field = |name: &str| format!("rule[{index}].{name}");
        check_new_id(&field("id"), &rule.id, &ids)?;
        ids.push(rule.id.as_str());
        within(
            &field("points"),
            f64::from(rule.points),
            0.0,
            f64::from(MOST_POINTS),
        )?;
        rule.keep.check(&field("keep"))?;
    }
    Ok(())
}

fn check_step(field: &dyn Fn(&str) -> String, step: &Step, before: &[&str]) -> Result<(), Problem> {
    check_new_id(&field("id"), &step.id, before)?;
    within(
        &field("points"),
        f64::from(step.points),
        0.0,
        f64::from(MOST_POINTS),
    )?;
    let times = [
        ("hint_after_s", step.hint_after_s),
        ("time_limit_s", step.time_limit_s),
    ];
    for (name, time) in times {
        if let Some(time) = time {
            within(&field(name), time, 1.0, LONGEST_TIME)?;
        }
    }
    for id in &step.after {
        if !before.contains(&id.as_str()) {
            let known = listed(before.iter().copied());
            let problem = format!("no step before this one is {id:?}; those are {known}");
            return Err(Problem::new(field("after"), problem));
        }
    }
    step.condition
        .check(&step.condition.field(&field("condition")))?;
    for (nth, keep) in step.keep.iter().enumerate() {
        keep.check(&format!("{}[{nth}]", field("keep")))?;
    }
    Ok(())
}

fn check_new_id(field: &str, id: &str, before: &[&str]) -> Result<(), Problem> {
    check_id(field, id)?;
    if before.contains(&id) {
        let problem = format!("{id:?} is there before; ids of steps and rules differ");
        return Err(Problem::new(field, problem));
    }
    Ok(())
}

fn check_id(field: &str, id: &str) -> Result<(), Problem> {
    let letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !id.is_empty() && id.len() <= LONGEST_ID && id.chars().all(letter) {
        return Ok(());
    }
    let problem = format!("{id:?} is no name; take 1 to {LONGEST_ID} of a to z, 0 to 9 and -");
    Err(Problem::new(field, problem))
}
