//! A lesson, and the text of the file that it is in.

use std::collections::{BTreeMap, BTreeSet};

use xxhash_rust::xxh3::xxh3_128;

use super::condition::{Condition, Keep};
use super::error::{LessonError, Problems, listed};
use super::fits::Fit;
use super::mode::Mode;
use super::read::{LessonFile, read};
use super::sight::SceneFacts;
use super::source::Source;
use super::words::LessonTexts;
use crate::caps::{Caps, Danger, WHOLE};
use crate::language::Language;
use crate::rubric::Rubric;
use crate::texts::{FaultTexts, Texts};

/// Version of the file format that is read here.
pub(super) const VERSION: u32 = 1;
/// Most steps of a lesson, and most rules.
pub(super) const MOST: usize = 50;
/// Most points of a step or rule.
const MOST_POINTS: u32 = 1000;
/// Longest id or name, characters.
pub(super) const LONGEST_ID: usize = 40;
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

/// A step of a lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Its id, which is the key of its texts.
    pub id: String,
    /// The condition that completes it.
    pub condition: Condition,
    /// Requirements that must hold from its beginning until it is done.
    pub keep: Vec<Keep>,
    /// Ids of earlier steps that must be done or missed before it begins, where several steps are open at a time.
    pub after: Vec<String>,
    /// Dangers that the student is asked for here: the lesson does not cap the score for them.
    pub asks: Vec<Danger>,
    /// Points for it.
    pub points: u32,
    /// Simulated time from its beginning or its last failure until its hint is shown, s; `None`: only on request.
    pub hint_after_s: Option<f64>,
    /// Simulated time from its beginning until it is missed, s; `None`: no limit.
    pub time_limit_s: Option<f64>,
}

/// A requirement that must hold from the beginning of a lesson to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// Its id, which is the key of its text.
    pub id: String,
    /// The requirement.
    pub keep: Keep,
    /// Points for it.
    pub points: u32,
}

/// A lesson, validated. It is checked against its scene only where [`Lesson::parse_for`] read it with the scene's properties.
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
    hash: String,
    /// The texts that stand in for a language that is not there: English, or else the first.
    first: (Language, LessonTexts),
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
        Self::parse(find(name)?, &format!("{name}.toml"))
    }

    /// Parses a lesson from its TOML `text`; `file` is its name in messages, which are in English. A lesson without texts that has the name
    /// of a built-in one gets that one's texts.
    ///
    /// # Errors
    /// [`LessonError::Faulty`] with each fault: where the text is not TOML, a key is missing or unknown, a value is out of its range, or a
    /// language is not complete.
    pub fn parse(text: &str, file: &str) -> Result<Self, LessonError> {
        Self::parse_for(text, (file, Language::En), |_| Ok(None))
    }

    /// As [`Lesson::parse`], with messages in that language, and checks that the lesson's scene has everything that the lesson asks for.
    /// `facts` gives the properties of the scene of a name, or why there are none; `None`: the scene is not checked.
    ///
    /// # Errors
    /// [`LessonError::Faulty`] with each fault of the file and of what the scene lacks.
    pub fn parse_for(
        text: &str,
        (file, language): (&str, Language),
        facts: impl FnOnce(&str) -> Result<Option<SceneFacts>, String>,
    ) -> Result<Self, LessonError> {
        let mut source = Source::new(text, file, FaultTexts::of(language)?)?;
        source.check_kind()?;
        let mut raw = read(&mut source);
        let own = source.has("texts");
        if !own && Self::builtin_text(&raw.name).is_some() {
            for language in Language::ALL {
                if let Some(texts) = Texts::of(language)?.lesson.remove(&raw.name) {
                    raw.texts.insert(language, texts);
                }
            }
        }
        let mut problems = Problems::new(source.texts.clone());
        check(&mut problems, &raw);
        if !source.is_unread("scene") && !raw.scene.trim().is_empty() {
            match facts(&raw.scene) {
                Ok(Some(facts)) => fits(&mut problems, (&raw.steps, &raw.rules), &facts),
                Ok(None) => {}
                Err(why) => {
                    let problem = problems.texts.unread_scene.fill(&[("why", &why)]);
                    problems.add("scene", problem);
                }
            }
        }
        // Without a name it is not known whether built-in texts were meant; a language that is not known is told already.
        let told = if own {
            !source.names("texts").is_empty()
        } else {
            source.is_unread("name")
        };
        if raw.texts.is_empty() && !told {
            problems.add("texts", problems.texts.no_texts.text());
        }
        source.add(problems);
        match raw.texts.pop_first() {
            Some(first) if source.is_good() => Ok(Self {
                name: raw.name,
                scene: raw.scene,
                modes: raw.modes,
                steps: raw.steps,
                rules: raw.rules,
                caps: raw.caps,
                hash: format!("{:032x}", xxh3_128(text.as_bytes())),
                first,
                others: raw.texts,
            }),
            _ => Err(source.into_error()),
        }
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

    /// Its texts in that language; if it has none, in English; if it has no English ones, in its first language.
    pub fn texts(&self, language: Language) -> &LessonTexts {
        self.others.get(&language).unwrap_or(&self.first.1)
    }

    /// This lesson for a user whose hands are moved by mouse and keyboard: its hints say what to do with these.
    pub fn at_desk(mut self) -> Self {
        self.first.1.hint_at_desk();
        self.others.values_mut().for_each(LessonTexts::hint_at_desk);
        self
    }

    /// The languages of its texts; the first stands in for those that it does not have.
    pub fn languages(&self) -> Vec<Language> {
        let others = self.others.keys().copied();
        std::iter::once(self.first.0).chain(others).collect()
    }

    /// The mode that is used where none is named.
    pub fn default_mode(&self) -> Mode {
        self.modes.first().copied().unwrap_or(Mode::Guided)
    }
}

/// Text of the built-in lesson of that name.
///
/// # Errors
/// [`LessonError::NotFound`] for an unknown name.
pub(super) fn find(name: &str) -> Result<&'static str, LessonError> {
    Lesson::builtin_text(name).ok_or_else(|| LessonError::NotFound {
        name: name.to_owned(),
        known: Lesson::builtin_names().join(", "),
    })
}

/// Checks that a scene has what these steps and rules ask for.
fn fits(problems: &mut Problems, (steps, rules): (&[Step], &[Rule]), facts: &SceneFacts) {
    let mut fit = Fit { facts, problems };
    for (index, step) in steps.iter().enumerate() {
        let field = step.condition.field(&format!("step[{index}].condition"));
        step.condition.fits(&field, &mut fit);
        for (nth, keep) in step.keep.iter().enumerate() {
            keep.fits(&format!("step[{index}].keep[{nth}]"), &mut fit);
        }
    }
    for (index, rule) in rules.iter().enumerate() {
        rule.keep.fits(&format!("rule[{index}].keep"), &mut fit);
    }
}

/// Checks the values of the file.
fn check(problems: &mut Problems, raw: &LessonFile) {
    if raw.version != VERSION {
        let (version, known) = (raw.version.to_string(), VERSION.to_string());
        let holes = [("version", &*version), ("known", &*known)];
        problems.add("version", problems.texts.version.fill(&holes));
    }
    check_id(problems, "name", &raw.name);
    if raw.scene.trim().is_empty() {
        problems.add("scene", problems.texts.no_scene.text());
    }
    let modes: BTreeSet<Mode> = raw.modes.iter().copied().collect();
    if modes.is_empty() || modes.len() < raw.modes.len() {
        problems.add("modes", problems.texts.modes.text());
    }
    let asks = raw.steps.iter().any(|it| it.condition.question().is_some());
    if asks && modes.contains(&Mode::Examination) {
        problems.add("modes", problems.texts.examination.text());
    }
    for (name, most) in raw.caps.named() {
        let field = format!("caps.{name}");
        problems.within(&field, f64::from(most), 0.0, f64::from(WHOLE));
    }
    let mut ids = Vec::new();
    for (index, step) in raw.steps.iter().enumerate() {
        check_step(problems, &format!("step[{index}]"), step, &ids);
        ids.push(step.id.as_str());
    }
    if raw.steps.iter().all(|step| step.points == 0) {
        problems.add("step[0].points", problems.texts.no_points.text());
    }
    for (index, rule) in raw.rules.iter().enumerate() {
        let field = |name: &str| format!("rule[{index}].{name}");
        check_new_id(problems, &field("id"), &rule.id, &ids);
        ids.push(rule.id.as_str());
        check_points(problems, &field("points"), rule.points);
        rule.keep.check(problems, &field("keep"));
    }
    let steps = raw.steps.iter().map(|step| {
        let question = step.condition.question();
        let answers = question.map_or(0, |it| usize::from(it.answers));
        (step.id.as_str(), answers)
    });
    let steps: Vec<(&str, usize)> = steps.collect();
    let rules: Vec<&str> = raw.rules.iter().map(|rule| rule.id.as_str()).collect();
    for (language, texts) in &raw.texts {
        texts.check(problems, *language, (&steps, &rules));
    }
}

fn check_step(problems: &mut Problems, field: &str, step: &Step, before: &[&str]) {
    let named = |name: &str| format!("{field}.{name}");
    check_new_id(problems, &named("id"), &step.id, before);
    check_points(problems, &named("points"), step.points);
    let times = [
        ("hint_after_s", step.hint_after_s),
        ("time_limit_s", step.time_limit_s),
    ];
    for (name, time) in times {
        if let Some(time) = time {
            problems.within(&named(name), time, 1.0, LONGEST_TIME);
        }
    }
    let unknown = step
        .after
        .iter()
        .filter(|id| !before.contains(&id.as_str()));
    for id in unknown.take(MOST) {
        let known = listed(&problems.texts, before.iter().copied());
        let name = format!("{id:?}");
        let holes = [("name", &*name), ("known", &*known)];
        problems.add(named("after"), problems.texts.before.fill(&holes));
    }
    let condition = step.condition.field(&named("condition"));
    step.condition.check(problems, &condition);
    for (nth, keep) in step.keep.iter().enumerate() {
        keep.check(problems, &format!("{}[{nth}]", named("keep")));
    }
}

fn check_points(problems: &mut Problems, field: &str, points: u32) {
    problems.within(field, f64::from(points), 0.0, f64::from(MOST_POINTS));
}

fn check_new_id(problems: &mut Problems, field: &str, id: &str, before: &[&str]) {
    check_id(problems, field, id);
    if before.contains(&id) {
        let problem = (problems.texts.twice).fill(&[("name", &format!("{id:?}"))]);
        problems.add(field, problem);
    }
}

fn check_id(problems: &mut Problems, field: &str, id: &str) {
    if !is_id(id) {
        let (name, most) = (format!("{id:?}"), LONGEST_ID.to_string());
        let holes = [("name", &*name), ("most", &*most)];
        problems.add(field, problems.texts.no_id.fill(&holes));
    }
}

/// Whether a lesson, step or rule may have that name.
pub(super) fn is_id(id: &str) -> bool {
    let letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    !id.is_empty() && id.len() <= LONGEST_ID && id.chars().all(letter)
}
