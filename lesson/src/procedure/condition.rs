//! What a step is done by, and what is kept meanwhile, as a lesson's file says it. Each unit is in its field's name; volumes are of
//! real size. What fits a scene is checked in [`fits`](super::fits).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{Problem, within};
use crate::event::{Surface, What};
use crate::skin::{CORROSIVE, IRRITANT};

/// Conditions within conditions, at most: a step that needs more is two steps.
const DEEPEST: usize = 3;
/// Parts of an `all` or `any`, at most.
const MOST_PARTS: usize = 10;
/// Least volume that a condition may ask for, mL: less is no pour.
const LEAST_ML: f64 = 0.5;
/// Most volume, mL.
const MOST_ML: f64 = 100_000.0;
/// What liquid's temperatures are looked at, °C.
const TEMPERATURES: [f64; 2] = [-50.0, 350.0];

/// What a step is done by.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Condition {
    /// All of these are so at one time.
    All(Vec<Condition>),
    /// One of these is so.
    Any(Vec<Condition>),
    /// A hand holds the flask.
    Lifted(OfFlask),
    /// The flask was lifted since the scene's start, and stands on the bench since half a second, held by nobody.
    PutDown(OfFlask),
    /// Liquid was poured from one flask into another.
    Poured(Poured),
    /// A flask holds so much, of a stated concentration.
    Holds(Holds),
    /// The mean of a flask's liquid is in a range.
    Temperature(TemperatureIs),
    /// Goggles are worn, or not.
    Goggles(Worn),
    /// Gloves are worn, or not.
    Gloves(GlovesAre),
    /// The hood's sash is open so far.
    Sash(SashIs),
    /// A rod was moved in a flask's liquid.
    Stirred(Stirred),
    /// The thermometer was in a flask's liquid without a break.
    Measured(Measured),
    /// No more than this lies there.
    Wiped(Wiped),
    /// Water came to a hand.
    Rinsed(Rinsed),
}

/// A flask alone.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OfFlask {
    /// The flask.
    pub flask: String,
}

/// Which liquid counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Liquid {
    /// Each.
    #[default]
    Any,
    /// Acid that burns skin: 15 % and more (CLP).
    Acid,
    /// What does not irritate skin: below 5 % acid (CLP).
    Water,
}

impl Liquid {
    /// Whether liquid of that acid mass fraction is it.
    pub(super) fn is(self, acid: f64) -> bool {
        match self {
            Self::Any => true,
            Self::Acid => acid >= CORROSIVE,
            Self::Water => acid < IRRITANT,
        }
    }
}

/// See [`Condition::Poured`]. Several pours add up. A pour is known a second after its last drop, and counts for the step in which that drop
/// arrived.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Poured {
    /// From that flask.
    pub from: String,
    /// Into that.
    pub into: String,
    /// Of which liquid; others do not count.
    #[serde(default)]
    pub liquid: Liquid,
    /// So much in all, mL.
    pub at_least_ml: f64,
    /// More is a failure, mL.
    pub at_most_ml: Option<f64>,
    /// Faster over any half second is a failure, mL/s.
    pub at_most_ml_s: Option<f64>,
}

/// See [`Condition::Holds`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Holds {
    /// The flask.
    pub flask: String,
    /// So much, mL.
    pub at_least_ml: f64,
    /// Acid mass fraction from here, %.
    pub acid_from_percent: f64,
    /// To here, %.
    pub acid_to_percent: f64,
    /// For so long without a break, s: else a pour that goes on would meet it as it passes.
    #[serde(default = "two")]
    pub for_s: f64,
}

fn two() -> f64 {
    2.0
}

/// See [`Condition::Temperature`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TemperatureIs {
    /// The flask.
    pub flask: String,
    /// This or more, °C.
    pub at_least_c: Option<f64>,
    /// This or less, °C.
    pub at_most_c: Option<f64>,
}

/// Whether something is worn.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Worn {
    /// It is; else it is taken off.
    pub on: bool,
}

/// See [`Condition::Gloves`].
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GlovesAre {
    /// They are on; else they are taken off.
    pub on: bool,
    /// On that hand; on both without it.
    pub hand: Option<HandName>,
}

/// See [`Condition::Sash`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SashIs {
    /// This or more, m over the bench.
    pub at_least_m: Option<f64>,
    /// This or less, m over the bench.
    pub at_most_m: Option<f64>,
}

/// See [`Condition::Stirred`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stirred {
    /// The flask.
    pub flask: String,
    /// So long in all, s, in which the rod's tip moves with 2 cm/s or more.
    pub at_least_s: f64,
}

/// See [`Condition::Measured`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// The flask.
    pub flask: String,
    /// So long, s.
    pub for_s: f64,
}

/// See [`Condition::Wiped`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wiped {
    /// Where.
    pub surface: Surface,
    /// This or less, mL.
    pub at_most_ml: f64,
}

/// See [`Condition::Rinsed`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rinsed {
    /// Which hand.
    pub hand: HandName,
    /// So much water since the step began, mL.
    pub at_least_ml: f64,
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

/// What goes on being so.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Keep {
    /// That does not happen.
    Never(Kind),
    /// No more than this is spilt, bench and floor together.
    Spilt(SpiltAtMost),
    /// The mean of a flask's liquid is below a temperature.
    Cool(Cool),
    /// Goggles are worn.
    Goggles,
    /// Gloves are worn.
    Gloves,
    /// The hood's sash is open no further.
    Sash(SashAtMost),
}

/// See [`Keep::Spilt`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpiltAtMost {
    /// mL.
    pub at_most_ml: f64,
}

/// See [`Keep::Cool`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cool {
    /// The flask.
    pub flask: String,
    /// °C.
    pub below_c: f64,
}

/// See [`Keep::Sash`].
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SashAtMost {
    /// m over the bench.
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
    /// Whether an incident is of it.
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
    /// Its place in [`Sight::rinsed_m3`](super::Sight::rinsed_m3).
    pub(super) fn index(self) -> usize {
        match self {
            Self::LeftHand => 0,
            Self::RightHand => 1,
        }
    }
}

/// Ends of a range of which one may be missing.
fn range(
    field: &str,
    unit: &str,
    ends: [Option<f64>; 2],
    [least, most]: [f64; 2],
) -> Result<(), Problem> {
    for (name, end) in ["at_least", "at_most"].into_iter().zip(ends) {
        if let Some(end) = end {
            within(&format!("{field}.{name}_{unit}"), end, least, most)?;
        }
    }
    let problem = match ends {
        [None, None] => format!("has no end; give at_least_{unit}, at_most_{unit} or both"),
        [Some(least), Some(most)] if least > most => {
            format!(
                "at_least_{unit} {least} is above at_most_{unit} {most}; take them the other way"
            )
        }
        _ => return Ok(()),
    };
    Err(Problem::new(field, problem))
}

impl Condition {
    /// Whether its numbers make sense.
    pub(super) fn check(&self, field: &str) -> Result<(), Problem> {
        self.check_at(field, 0)
    }

    fn check_at(&self, field: &str, depth: usize) -> Result<(), Problem> {
        let named = |name: &str| format!("{field}.{name}");
        let volume = |name: &str, ml| within(&named(name), ml, LEAST_ML, MOST_ML);
        let time = |name: &str, s| within(&named(name), s, 0.1, 600.0);
        match self {
            Self::All(parts) | Self::Any(parts) => {
                if parts.is_empty() || parts.len() > MOST_PARTS {
                    let problem = format!("has {} parts; give 1 to {MOST_PARTS}", parts.len());
                    return Err(Problem::new(field, problem));
                }
                if depth + 1 >= DEEPEST {
                    let problem = format!("more than {DEEPEST} deep; make two steps of it");
                    return Err(Problem::new(field, problem));
                }
                for (index, part) in parts.iter().enumerate() {
                    let field = part.field(&format!("{field}[{index}]"));
                    part.check_at(&field, depth + 1)?;
                }
                Ok(())
            }
            Self::Lifted(_) | Self::PutDown(_) | Self::Goggles(_) | Self::Gloves(_) => Ok(()),
            Self::Poured(it) => {
                volume("at_least_ml", it.at_least_ml)?;
                let ends = [Some(it.at_least_ml), it.at_most_ml];
                range(field, "ml", ends, [LEAST_ML, MOST_ML])?;
                let rate = |it| within(&named("at_most_ml_s"), it, 0.1, 1000.0);
                it.at_most_ml_s.map_or(Ok(()), rate)
            }
            Self::Holds(it) => {
                volume("at_least_ml", it.at_least_ml)?;
                let (from, to) = (it.acid_from_percent, it.acid_to_percent);
                within(&named("acid_from_percent"), from, 0.0, 100.0)?;
                within(&named("acid_to_percent"), to, from, 100.0)?;
                time("for_s", it.for_s)
            }
            Self::Temperature(it) => range(field, "c", [it.at_least_c, it.at_most_c], TEMPERATURES),
            Self::Sash(it) => range(field, "m", [it.at_least_m, it.at_most_m], [0.0, 2.0]),
            Self::Stirred(it) => time("at_least_s", it.at_least_s),
            Self::Measured(it) => time("for_s", it.for_s),
            Self::Wiped(it) => within(&named("at_most_ml"), it.at_most_ml, 0.0, MOST_ML),
            Self::Rinsed(it) => volume("at_least_ml", it.at_least_ml),
        }
    }

    /// The path of its own table, in `field`.
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
        };
        format!("{field}.{name}")
    }
}

impl Keep {
    /// Whether its numbers make sense.
    pub(super) fn check(&self, field: &str) -> Result<(), Problem> {
        match self {
            Self::Never(_) | Self::Goggles | Self::Gloves => Ok(()),
            Self::Spilt(it) => {
                let field = format!("{field}.spilt.at_most_ml");
                within(&field, it.at_most_ml, 0.0, MOST_ML)
            }
            Self::Cool(it) => {
                let [least, most] = TEMPERATURES;
                within(&format!("{field}.cool.below_c"), it.below_c, least, most)
            }
            Self::Sash(it) => within(&format!("{field}.sash.at_most_m"), it.at_most_m, 0.0, 2.0),
        }
    }
}
