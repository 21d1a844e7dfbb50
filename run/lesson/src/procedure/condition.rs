//! Conditions that complete a step, and requirements that must hold meanwhile, as a lesson's file states them. Each unit is in its field's
//! name; volumes are of real size. What fits a scene is checked in [`fits`](super::fits).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::Problems;
use crate::event::{Surface, What};
use crate::skin::{CORROSIVE, IRRITANT};

/// Deepest nesting of conditions: a step that needs more is two steps.
const DEEPEST: usize = 3;
/// Most parts of an `all` or `any`.
const MOST_PARTS: usize = 10;
/// Most answers of a question: as many buttons as the panel has room for, beside the question and a hint.
pub const MOST_ANSWERS: u8 = 3;
/// Least volume that a condition may ask for, mL: less is no pour.
const LEAST_ML: f64 = 0.5;
/// Greatest volume, mL.
const MOST_ML: f64 = 100_000.0;
/// Range of temperatures that a condition may ask for, °C.
const TEMPERATURES: [f64; 2] = [-50.0, 350.0];
/// Shortest time that a condition may ask for, s.
const SHORTEST_S: f64 = 0.1;
/// Longest time that a condition may ask for, s.
const LONGEST_S: f64 = 600.0;

/// What completes a step.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Condition {
    /// All of these hold at one time.
    All(Vec<Condition>),
    /// One of these holds.
    Any(Vec<Condition>),
    /// A hand holds the flask.
    Lifted(OfFlask),
    /// The flask was lifted since the scene's start, and has stood on the bench for half a second, held by nobody.
    PutDown(OfFlask),
    /// Liquid was poured from one flask into another.
    Poured(Poured),
    /// A flask holds an amount of liquid of a stated concentration.
    Holds(Holds),
    /// The mean temperature of a flask's liquid is in a range.
    Temperature(TemperatureIs),
    /// Goggles are worn, or not.
    Goggles(Worn),
    /// Gloves are worn, or not.
    Gloves(GlovesAre),
    /// The opening of the hood's sash is in a range.
    Sash(SashIs),
    /// A rod was moved in a flask's liquid.
    Stirred(Stirred),
    /// The thermometer was in a flask's liquid for a time without a break.
    Measured(Measured),
    /// No more than a stated volume lies on bench or floor.
    Wiped(Wiped),
    /// A stated volume of water came to a hand.
    Rinsed(Rinsed),
    /// The step's question was answered. It is a step's whole condition, and no part of `all` or `any`.
    Answered(Answered),
}

/// The flask of a condition.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OfFlask {
    /// The flask.
    pub flask: String,
}

/// The liquid that a pour counts for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Liquid {
    /// Any liquid.
    #[default]
    Any,
    /// Acid that burns skin: 15 % and more (CLP).
    Acid,
    /// Liquid that does not irritate skin: below 5 % acid (CLP).
    Water,
}

impl Liquid {
    /// Whether liquid of that acid mass fraction counts.
    pub(super) fn is(self, acid: f64) -> bool {
        match self {
            Self::Any => true,
            Self::Acid => acid >= CORROSIVE,
            Self::Water => acid < IRRITANT,
        }
    }
}

/// Parameters of [`Condition::Poured`]. Several pours add up. A pour is known a second after its last drop, and counts for the step in
/// which that drop arrived.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Poured {
    /// The flask that is poured from.
    pub from: String,
    /// The flask that is poured into.
    pub into: String,
    /// The liquid that counts; pours of other liquid are ignored.
    #[serde(default)]
    pub liquid: Liquid,
    /// Least volume in all, mL.
    pub at_least_ml: f64,
    /// Volume above which the step fails, mL.
    pub at_most_ml: Option<f64>,
    /// Flow rate over any half second above which the step fails, mL/s.
    pub at_most_ml_s: Option<f64>,
}

/// Parameters of [`Condition::Holds`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Holds {
    /// The flask.
    pub flask: String,
    /// Least volume, mL.
    pub at_least_ml: f64,
    /// Least acid mass fraction, %.
    pub acid_from_percent: f64,
    /// Greatest acid mass fraction, %.
    pub acid_to_percent: f64,
    /// Time without a break, s: else a pour that goes on would meet the condition in passing.
    #[serde(default = "two")]
    pub for_s: f64,
}

fn two() -> f64 {
    2.0
}

/// Parameters of [`Condition::Temperature`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TemperatureIs {
    /// The flask.
    pub flask: String,
    /// Least mean temperature, °C.
    pub at_least_c: Option<f64>,
    /// Greatest mean temperature, °C.
    pub at_most_c: Option<f64>,
}

/// Parameters of [`Condition::Goggles`].
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Worn {
    /// Whether they are worn; else they are taken off.
    pub on: bool,
}

/// Parameters of [`Condition::Gloves`].
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GlovesAre {
    /// Whether they are worn; else they are taken off.
    pub on: bool,
    /// The hand; both hands without it.
    pub hand: Option<HandName>,
}

/// Parameters of [`Condition::Sash`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SashIs {
    /// Least opening, m over the bench.
    pub at_least_m: Option<f64>,
    /// Greatest opening, m over the bench.
    pub at_most_m: Option<f64>,
}

/// Parameters of [`Condition::Stirred`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stirred {
    /// The flask.
    pub flask: String,
    /// Time in all during which the rod's tip moves with 2 cm/s or more, s.
    pub at_least_s: f64,
}

/// Parameters of [`Condition::Measured`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The flask.
    pub flask: String,
    /// Time without a break, s.
    pub for_s: f64,
}

/// Parameters of [`Condition::Wiped`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wiped {
    /// The surface.
    pub surface: Surface,
    /// Greatest volume that may lie there, mL.
    pub at_most_ml: f64,
}

/// Parameters of [`Condition::Rinsed`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rinsed {
    /// The hand.
    pub hand: HandName,
    /// Least volume of water since the step began, mL.
    pub at_least_ml: f64,
}

/// Parameters of [`Condition::Answered`]. The step's text is the question; its texts have the answers too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answered {
    /// How many answers there are.
    pub answers: u8,
    /// The right one, counted from 1: with another one the step is missed. Without it each answer completes the step.
    pub right: Option<u8>,
}

impl Answered {
    /// Whether there is an answer of that number, counted from 1.
    pub fn has(self, answer: u8) -> bool {
        (1..=self.answers).contains(&answer)
    }
}

/// A hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HandName {
    /// The left one.
    LeftHand,
    /// The right one.
    RightHand,
}

/// A requirement that must hold throughout a step or a lesson.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Keep {
    /// No incident of that kind happens.
    Never(Kind),
    /// No more than a stated volume is spilt, bench and floor together.
    Spilt(SpiltAtMost),
    /// The mean temperature of a flask's liquid stays below a limit.
    Cool(Cool),
    /// Goggles are worn.
    Goggles,
    /// Gloves are worn.
    Gloves,
    /// The hood's sash is open no further than a limit.
    Sash(SashAtMost),
}

/// Parameters of [`Keep::Spilt`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpiltAtMost {
    /// Greatest volume, mL.
    pub at_most_ml: f64,
}

/// Parameters of [`Keep::Cool`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cool {
    /// The flask.
    pub flask: String,
    /// Limit of the mean temperature, °C.
    pub below_c: f64,
}

/// Parameters of [`Keep::Sash`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SashAtMost {
    /// Greatest opening, m over the bench.
    pub at_most_m: f64,
}

/// A kind of incident.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// [`What::WaterIntoAcid`].
    WaterIntoAcid,
    /// [`What::PouredTooFast`].
    PouredTooFast,
    /// [`What::BoiledOver`].
    BoiledOver,
    /// [`What::Hot`].
    Hot,
    /// [`What::OnSkin`], on gloves and goggles too.
    OnSkin,
    /// [`What::Dropped`], whether it breaks or not.
    Dropped,
}

impl Kind {
    /// Whether the incident `what` is of this kind.
    pub(super) fn is(self, what: &What) -> bool {
        match what {
            What::WaterIntoAcid { .. } => self == Self::WaterIntoAcid,
            What::PouredTooFast { .. } => self == Self::PouredTooFast,
            What::BoiledOver { .. } => self == Self::BoiledOver,
            What::Hot { .. } => self == Self::Hot,
            What::OnSkin { .. } => self == Self::OnSkin,
            What::Dropped { .. } => self == Self::Dropped,
            What::Spilt { .. } => false,
        }
    }
}

impl HandName {
    /// The hand's index in [`Sight::rinsed_m3`](super::Sight::rinsed_m3).
    pub(super) fn index(self) -> usize {
        match self {
            Self::LeftHand => 0,
            Self::RightHand => 1,
        }
    }
}

/// Checks the ends of a range, of which one may be missing.
fn range(
    problems: &mut Problems,
    (field, unit): (&str, &str),
    ends: [Option<f64>; 2],
    [least, most]: [f64; 2],
) {
    for (name, end) in ["at_least", "at_most"].into_iter().zip(ends) {
        if let Some(end) = end {
            problems.within(&format!("{field}.{name}_{unit}"), end, least, most);
        }
    }
    match ends {
        [None, None] => {
            let [least, most] = ["at_least", "at_most"].map(|it| format!("{it}_{unit}"));
            let holes = [("least", &*least), ("most", &*most)];
            problems.add(field, problems.texts.no_end.fill(&holes));
        }
        [Some(least), Some(most)] if least > most => {
            let least = format!("at_least_{unit} {least}");
            let most = format!("at_most_{unit} {most}");
            let holes = [("least", &*least), ("most", &*most)];
            problems.add(field, problems.texts.ends.fill(&holes));
        }
        _ => {}
    }
}

impl Condition {
    /// Checks that its numbers make sense; `field` is its path in messages.
    pub(super) fn check(&self, problems: &mut Problems, field: &str) {
        self.check_at(problems, field, 0);
    }

    fn check_at(&self, problems: &mut Problems, field: &str, depth: usize) {
        let named = |name: &str| format!("{field}.{name}");
        match self {
            Self::All(parts) | Self::Any(parts) => {
                if parts.is_empty() || parts.len() > MOST_PARTS {
                    let (count, most) = (parts.len().to_string(), MOST_PARTS.to_string());
                    let holes = [("count", &*count), ("most", &*most)];
                    let problem = problems.texts.parts.fill(&holes);
                    return problems.add(field, problem);
                }
                if depth + 1 >= DEEPEST {
                    let problem = (problems.texts.deep).fill(&[("most", &DEEPEST.to_string())]);
                    return problems.add(field, problem);
                }
                for (index, part) in parts.iter().enumerate() {
                    let field = part.field(&format!("{field}[{index}]"));
                    part.check_at(problems, &field, depth + 1);
                }
            }
            Self::Lifted(_) | Self::PutDown(_) | Self::Goggles(_) | Self::Gloves(_) => {}
            Self::Poured(it) => {
                let ends = [Some(it.at_least_ml), it.at_most_ml];
                range(problems, (field, "ml"), ends, [LEAST_ML, MOST_ML]);
                if let Some(rate) = it.at_most_ml_s {
                    problems.within(&named("at_most_ml_s"), rate, 0.1, 1000.0);
                }
            }
            Self::Holds(it) => {
                problems.within(&named("at_least_ml"), it.at_least_ml, LEAST_ML, MOST_ML);
                let (from, to) = (it.acid_from_percent, it.acid_to_percent);
                problems.within(&named("acid_from_percent"), from, 0.0, 100.0);
                let least = if (0.0..=100.0).contains(&from) {
                    from
                } else {
                    0.0
                };
                problems.within(&named("acid_to_percent"), to, least, 100.0);
                problems.within(&named("for_s"), it.for_s, SHORTEST_S, LONGEST_S);
            }
            Self::Temperature(it) => {
                let ends = [it.at_least_c, it.at_most_c];
                range(problems, (field, "c"), ends, TEMPERATURES);
            }
            Self::Sash(it) => {
                let ends = [it.at_least_m, it.at_most_m];
                range(problems, (field, "m"), ends, [0.0, 2.0]);
            }
            Self::Stirred(it) => {
                problems.within(&named("at_least_s"), it.at_least_s, SHORTEST_S, LONGEST_S);
            }
            Self::Measured(it) => {
                problems.within(&named("for_s"), it.for_s, SHORTEST_S, LONGEST_S);
            }
            Self::Wiped(it) => problems.within(&named("at_most_ml"), it.at_most_ml, 0.0, MOST_ML),
            Self::Rinsed(it) => {
                problems.within(&named("at_least_ml"), it.at_least_ml, LEAST_ML, MOST_ML);
            }
            Self::Answered(_) if depth > 0 => {
                problems.add(field, problems.texts.question.text());
            }
            Self::Answered(it) => {
                let (answers, most) = (f64::from(it.answers), f64::from(MOST_ANSWERS));
                problems.within(&named("answers"), answers, 1.0, most);
                if let Some(right) = it.right {
                    problems.within(&named("right"), f64::from(right), 1.0, answers.max(1.0));
                }
            }
        }
    }

    /// The question that it asks, if it asks one.
    pub(super) fn question(&self) -> Option<Answered> {
        match self {
            Self::Answered(it) => Some(*it),
            _ => None,
        }
    }

    /// Path of its own table inside `field`.
    pub(super) fn field(&self, field: &str) -> String {
        let name = match self {
            Self::All(_) => "all",
            Self::Any(_) => "any",
            Self::Lifted(_) => "lifted",
            Self::PutDown(_) => "put-down",
            Self::Poured(_) => "poured",
            Self::Holds(_) => "holds",
            Self::Temperature(_) => "temperature",
            Self::Goggles(_) => "goggles",
            Self::Gloves(_) => "gloves",
            Self::Sash(_) => "sash",
            Self::Stirred(_) => "stirred",
            Self::Measured(_) => "measured",
            Self::Wiped(_) => "wiped",
            Self::Rinsed(_) => "rinsed",
            Self::Answered(_) => "answered",
        };
        format!("{field}.{name}")
    }
}

impl Keep {
    /// Checks that its numbers make sense; `field` is its path in messages.
    pub(super) fn check(&self, problems: &mut Problems, field: &str) {
        match self {
            Self::Never(_) | Self::Goggles | Self::Gloves => {}
            Self::Spilt(it) => {
                let field = format!("{field}.spilt.at_most_ml");
                problems.within(&field, it.at_most_ml, 0.0, MOST_ML);
            }
            Self::Cool(it) => {
                let [least, most] = TEMPERATURES;
                problems.within(&format!("{field}.cool.below_c"), it.below_c, least, most);
            }
            Self::Sash(it) => {
                problems.within(&format!("{field}.sash.at_most_m"), it.at_most_m, 0.0, 2.0);
            }
        }
    }
}
