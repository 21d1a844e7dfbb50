//! Reports of the judge, during a lesson and at its end. Names of fields are the keys of recordings and reports: SI units, temperatures in
//! °C.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::condition::Kind;
use super::mode::Mode;
use super::words::LessonTexts;
use crate::texts::Texts;

/// A change in a lesson. `t_s` is when it was reported, `evidence_s` when it came about: a pour is known a second after its last drop.
/// Both are simulated time of the run, s.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "progress", rename_all = "kebab-case")]
pub enum Progress {
    /// The lesson begins, or begins again with its scene.
    Begun {
        /// When.
        t_s: f64,
        /// Name of the lesson.
        lesson: String,
        /// Its mode.
        mode: Mode,
    },
    /// A step was opened.
    StepBegun {
        /// When.
        t_s: f64,
        /// The step.
        id: String,
    },
    /// A step was done.
    StepDone {
        /// When it was reported.
        t_s: f64,
        /// The step.
        id: String,
        /// When it came about.
        evidence_s: f64,
    },
    /// A step failed. A step that was done can fail too, by an incident that is known only later.
    StepFailed {
        /// When it was reported.
        t_s: f64,
        /// The step.
        id: String,
        /// When it came about.
        evidence_s: f64,
        /// Why.
        why: Why,
        /// Whether it is missed; else it is tried again.
        missed: bool,
    },
    /// A rule was broken. It is reported once at most.
    RuleBroken {
        /// When it was reported.
        t_s: f64,
        /// The rule.
        id: String,
        /// When it came about.
        evidence_s: f64,
        /// Why.
        why: Why,
    },
    /// A step's hint is to be shown.
    HintDue {
        /// When.
        t_s: f64,
        /// The step.
        id: String,
        /// Whether the user asked for it.
        asked: bool,
    },
    /// No step is left to do.
    Over {
        /// When.
        t_s: f64,
    },
}

impl Progress {
    /// JSON schema of a change as a recording stores it.
    pub fn schema() -> String {
        schemars::schema_for!(Self).to_value().to_string()
    }
}

/// Something that is worn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Gear {
    /// Goggles.
    Goggles,
    /// Gloves.
    Gloves,
}

/// Why a step failed, or a rule was broken.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "why", rename_all = "kebab-case")]
pub enum Why {
    /// Liquid was poured too fast.
    TooFast {
        /// Highest flow rate over any half second, m³/s.
        rate_m3_s: f64,
        /// Highest allowed rate, m³/s.
        limit_m3_s: f64,
    },
    /// Too much liquid was poured.
    TooMuch {
        /// Volume in all, m³.
        volume_m3: f64,
        /// Greatest allowed volume, m³.
        limit_m3: f64,
    },
    /// An incident that must not happen.
    Incident {
        /// Its kind.
        kind: Kind,
    },
    /// Too much was spilt.
    Spilt {
        /// Volume in all, m³.
        volume_m3: f64,
        /// Greatest allowed volume, m³.
        limit_m3: f64,
    },
    /// A flask's liquid became too hot.
    TooHot {
        /// The flask.
        flask: String,
        /// Its mean temperature, °C.
        temperature_c: f64,
        /// Limit that it had to stay below, °C.
        limit_c: f64,
    },
    /// Goggles or gloves were not worn.
    NotWorn {
        /// Which.
        gear: Gear,
    },
    /// The hood was open too far.
    SashOpen {
        /// Its opening, m.
        height_m: f64,
        /// Greatest allowed opening, m.
        limit_m: f64,
    },
    /// The step took too long.
    TimeUp {
        /// Allowed time, s.
        limit_s: f64,
    },
    /// Another answer is right.
    WrongAnswer {
        /// The answer that was given, counted from 1.
        answer: u8,
        /// The right one.
        right: u8,
    },
    /// The step was left out.
    Skipped,
    /// The lesson ended before the step was done.
    NotDone,
}

/// Status of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Earlier steps come first.
    #[default]
    Waiting,
    /// It is to be done.
    Open,
    /// It is done.
    Done,
    /// It was not done, and is not tried again.
    Missed,
}

/// Status of a lesson, for panel and console alike. In an examination the user does not see it: [`Mode::tells`].
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct State {
    /// Name of the lesson.
    pub lesson: String,
    /// Its mode.
    pub mode: Mode,
    /// Number of the first open step, counted from 1; `None` where none is open.
    pub number: Option<usize>,
    /// Whether no step is left to do.
    pub over: bool,
    /// The steps in their order.
    pub steps: Vec<StepState>,
}

/// Status of one step of a lesson.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct StepState {
    /// Its id, which is the key of its texts.
    pub id: String,
    /// Its status.
    pub status: Status,
    /// Whether its hint is to be shown.
    pub hint: bool,
    /// How often its hint was given.
    pub hints: u32,
    /// How often it failed.
    pub failures: u32,
}

/// Result of a lesson.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Verdict {
    /// Name of the lesson.
    pub lesson: String,
    /// Its mode.
    pub mode: Mode,
    /// Points earned in all.
    pub points: u32,
    /// Points that can be earned in all.
    pub of: u32,
    /// A line for each step, then for each rule, in the order of the lesson's file.
    pub lines: Vec<VerdictLine>,
}

/// Result of a step or a rule.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct VerdictLine {
    /// Its id.
    pub id: String,
    /// Whether it is a rule.
    pub rule: bool,
    /// Whether it was done, or kept.
    pub met: bool,
    /// When it was done, missed or broken, simulated time of the run, s; `None` of a rule that was kept, and of a step that was not
    /// decided.
    pub evidence_s: Option<f64>,
    /// Why it failed or was broken last.
    pub why: Option<Why>,
    /// How often it failed.
    pub failures: u32,
    /// How often its hint was given.
    pub hints: u32,
    /// Points earned.
    pub points: u32,
    /// Points that can be earned.
    pub of: u32,
}

impl Texts {
    /// A sentence that gives the reason of a failure.
    pub fn why(&self, why: &Why) -> String {
        let texts = &self.why;
        match why {
            Why::TooFast {
                rate_m3_s,
                limit_m3_s,
            } => texts.too_fast.fill(&[
                ("rate", &self.rate(*rate_m3_s)),
                ("limit", &self.rate(*limit_m3_s)),
            ]),
            Why::TooMuch {
                volume_m3,
                limit_m3,
            } => texts.too_much.fill(&[
                ("volume", &self.volume(*volume_m3)),
                ("limit", &self.volume(*limit_m3)),
            ]),
            Why::Incident { kind } => match kind {
                Kind::WaterIntoAcid => texts.water_into_acid.text(),
                Kind::PouredTooFast => texts.poured_too_fast.text(),
                Kind::BoiledOver => texts.boiled_over.text(),
                Kind::Hot => texts.hot.text(),
                Kind::OnSkin => texts.on_skin.text(),
                Kind::Dropped => texts.dropped.text(),
            },
            Why::Spilt {
                volume_m3,
                limit_m3,
            } => texts.spilt.fill(&[
                ("volume", &self.volume(*volume_m3)),
                ("limit", &self.volume(*limit_m3)),
            ]),
            Why::TooHot {
                temperature_c,
                limit_c,
                ..
            } => texts.too_hot.fill(&[
                ("temperature", &self.temperature(*temperature_c)),
                ("limit", &self.temperature(*limit_c)),
            ]),
            Why::NotWorn { gear } => match gear {
                Gear::Goggles => texts.no_goggles.text(),
                Gear::Gloves => texts.no_gloves.text(),
            },
            Why::SashOpen { height_m, limit_m } => texts.sash_open.fill(&[
                ("height", &self.height(*height_m)),
                ("limit", &self.height(*limit_m)),
            ]),
            Why::TimeUp { limit_s } => {
                let limit = self.duration(*limit_s);
                texts.time_up.fill(&[("limit", &limit)])
            }
            Why::WrongAnswer { answer, right } => texts.wrong_answer.fill(&[
                ("answer", &answer.to_string()),
                ("right", &right.to_string()),
            ]),
            Why::Skipped => texts.skipped.text(),
            Why::NotDone => texts.not_done.text(),
        }
    }

    /// As [`Texts::why`] for the lesson's step or rule of that id: of a wrong answer with the text of the right one.
    pub fn why_of(&self, lesson: &LessonTexts, id: &str, why: &Why) -> String {
        let said = self.why(why);
        let Why::WrongAnswer { right, .. } = why else {
            return said;
        };
        let answers = lesson.step.get(id).map(|step| &step.answers);
        let right = usize::from(*right).checked_sub(1);
        match answers.and_then(|it| it.get(right?)) {
            Some(right) => self.join.two.fill(&[("first", &said), ("second", right)]),
            None => said,
        }
    }

    /// Name of a mode in this language.
    pub fn mode(&self, mode: Mode) -> String {
        let name = match mode {
            Mode::Guided => &self.mode.guided,
            Mode::Free => &self.mode.free,
            Mode::Examination => &self.mode.examination,
        };
        name.text()
    }
}
