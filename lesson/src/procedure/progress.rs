//! What a judge says, as it goes and at the end. Names of fields are the keys of recordings and reports: SI units, temperatures in °C.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::condition::Kind;
use super::mode::Mode;
use crate::texts::Texts;

/// Something that changed in a lesson. `t_s` is when it was said, `evidence_s` when it was so: a pour is known a second after its last
/// drop. Both are simulated time of the run, s.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "progress", rename_all = "kebab-case")]
pub enum Progress {
    /// It begins, or begins again with its scene.
    Begun {
        /// When.
        t_s: f64,
        /// The lesson.
        lesson: String,
        /// How it is gone through.
        mode: Mode,
    },
    /// A step is to be done now.
    StepBegun {
        /// When.
        t_s: f64,
        /// The step.
        id: String,
    },
    /// A step was done.
    StepDone {
        /// When it was said.
        t_s: f64,
        /// The step.
        id: String,
        /// When it was so.
        evidence_s: f64,
    },
    /// A step failed. One that was done before can, by something that is known only later.
    StepFailed {
        /// When it was said.
        t_s: f64,
        /// The step.
        id: String,
        /// When it was so.
        evidence_s: f64,
        /// Why.
        why: Why,
        /// Whether it is missed; else it is tried again.
        missed: bool,
    },
    /// A rule was broken. Each is once at most.
    RuleBroken {
        /// When it was said.
        t_s: f64,
        /// The rule.
        id: String,
        /// When it was so.
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
    /// JSON schema of what a recording keeps.
    pub fn schema() -> String {
        schemars::schema_for!(Self).to_value().to_string()
    }
}

/// What is worn.
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
    /// It was poured too fast.
    TooFast {
        /// The most in any half second, m³/s.
        rate_m3_s: f64,
        /// What is allowed, m³/s.
        limit_m3_s: f64,
    },
    /// Too much was poured.
    TooMuch {
        /// How much in all, m³.
        volume_m3: f64,
        /// What is allowed, m³.
        limit_m3: f64,
    },
    /// Something happened that must not.
    Incident {
        /// What.
        kind: Kind,
    },
    /// Too much was spilt.
    Spilt {
        /// How much in all, m³.
        volume_m3: f64,
        /// What is allowed, m³.
        limit_m3: f64,
    },
    /// A flask's liquid became too hot.
    TooHot {
        /// The flask.
        flask: String,
        /// Its mean temperature, °C.
        temperature_c: f64,
        /// It was to be below, °C.
        limit_c: f64,
    },
    /// Something was not worn.
    NotWorn {
        /// What.
        gear: Gear,
    },
    /// The hood was open too far.
    SashOpen {
        /// How far, m.
        height_m: f64,
        /// What is allowed, m.
        limit_m: f64,
    },
    /// It took too long.
    TimeUp {
        /// What is allowed, s.
        limit_s: f64,
    },
    /// It was left out.
    Skipped,
    /// The lesson ended before it was done.
    NotDone,
}

/// How a step stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Others come first.
    #[default]
    Waiting,
    /// It is to be done.
    Open,
    /// It is done.
    Done,
    /// It was not done, and is not tried again.
    Missed,
}

/// How a lesson stands, for panel and console alike. In an examination the user is not told: [`Mode::tells`].
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct State {
    /// The lesson.
    pub lesson: String,
    /// How it is gone through.
    pub mode: Mode,
    /// The first step that is to be done, counted from 1; `None` where none is.
    pub number: Option<usize>,
    /// Whether no step is left to do.
    pub over: bool,
    /// The steps in their order.
    pub steps: Vec<StepState>,
}

/// How a step of it stands.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct StepState {
    /// Its id, under which the lesson has its texts.
    pub id: String,
    /// How it stands.
    pub status: Status,
    /// Whether its hint is to be shown.
    pub hint: bool,
    /// How often its hint was given.
    pub hints: u32,
    /// How often it failed.
    pub failures: u32,
}

/// What a lesson comes to.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Verdict {
    /// The lesson.
    pub lesson: String,
    /// How it was gone through.
    pub mode: Mode,
    /// Points in all.
    pub points: u32,
    /// Of so many.
    pub of: u32,
    /// By step, then by rule, in the order of the lesson's file.
    pub lines: Vec<VerdictLine>,
}

/// What is said of a step or a rule.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct VerdictLine {
    /// Its id.
    pub id: String,
    /// Whether it is a rule.
    pub rule: bool,
    /// Whether it was done, or kept.
    pub met: bool,
    /// When it was done, missed or broken, simulated time of the run, s; `None` of a rule that was kept, and of what did not come about.
    pub evidence_s: Option<f64>,
    /// Why it failed last.
    pub why: Option<Why>,
    /// How often it failed.
    pub failures: u32,
    /// How often its hint was given.
    pub hints: u32,
    /// Points.
    pub points: u32,
    /// Of so many.
    pub of: u32,
}

impl Texts {
    /// Why something failed, in a sentence.
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
                flask,
                temperature_c,
                limit_c,
            } => texts.too_hot.fill(&[
                ("flask", flask),
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
            Why::Skipped => texts.skipped.text(),
            Why::NotDone => texts.not_done.text(),
        }
    }

    /// What a mode is called.
    pub fn mode(&self, mode: Mode) -> String {
        let name = match mode {
            Mode::Guided => &self.mode.guided,
            Mode::Free => &self.mode.free,
            Mode::Examination => &self.mode.examination,
        };
        name.text()
    }
}
