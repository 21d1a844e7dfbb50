//! What happens in an attempt. Field names are the keys of a recording's `/events` and of `report.json`: SI units, temperatures in °C, real size
//! whatever the scene's scale.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something that a look at the particles found, said once it is over.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
pub enum Event {
    /// A scene was brought up: an attempt begins.
    Begun {
        /// Simulated time of the run, s.
        t_s: f64,
        /// The scene.
        scene: String,
        /// What each flask holds then.
        contents: Contents,
    },
    /// Liquid was poured.
    Poured(Pour),
    /// Something went wrong.
    Incident(Incident),
    /// The attempt is over.
    Ended(Ending),
}

impl Event {
    /// JSON schema of what a recording keeps.
    pub fn schema() -> String {
        schemars::schema_for!(Self).to_value().to_string()
    }
}

/// Liquid of one flask that came to another place in one go, as its user tilted it.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Pour {
    /// When the first of it arrived, simulated time of the run, s: the film's time.
    pub t_s: f64,
    /// When the last did, s.
    pub until_s: f64,
    /// The flask that it came from.
    pub from: String,
    /// The flask that it came to; `None` beside all of them.
    pub into: Option<String>,
    /// How much, m³.
    pub volume_m3: f64,
    /// The most that arrived in any half second, m³/s.
    pub fastest_m3_s: f64,
    /// Its mean acid mass fraction.
    pub acid: f64,
    /// What was in the flask before: `None` where nothing was, or where it came to none.
    pub met: Option<Content>,
}

impl Pour {
    /// How long it took, s.
    pub fn lasted_s(&self) -> f64 {
        self.until_s - self.t_s
    }

    /// Volume over time, m³/s.
    pub fn mean_m3_s(&self) -> f64 {
        // A single drop arrives in no time: as in half a second.
        self.volume_m3 / (self.until_s - self.t_s).max(0.5)
    }
}

/// Liquid in a flask.
#[derive(Clone, Copy, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Content {
    /// m³.
    pub volume_m3: f64,
    /// Acid mass fraction.
    pub acid: f64,
    /// Mean temperature, °C; `None` where no heat is modelled.
    pub temperature_c: Option<f64>,
}

/// By flask, of those that hold something.
pub type Contents = BTreeMap<String, Content>;

/// Something that went wrong.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Incident {
    /// When it began, simulated time of the run, s: the film's time, to which a report jumps.
    pub t_s: f64,
    /// When it ended, s: where the last liquid of it arrived.
    pub until_s: f64,
    /// What.
    pub what: What,
    /// Why.
    pub cause: Cause,
    /// Where, in the frame of the scene's file: the mean of the places of its particles, m, real size.
    pub place_m: [f64; 3],
}

impl Incident {
    /// How long it took, s.
    pub fn lasted_s(&self) -> f64 {
        self.until_s - self.t_s
    }
}

/// What went wrong.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum What {
    /// Liquid that is mostly water was poured into concentrated acid: the incorrect order.
    WaterIntoAcid {
        /// The acid's flask.
        flask: String,
        /// Acid mass fraction that the first of it met.
        met_acid: f64,
        /// How much came while it was so, m³.
        volume_m3: f64,
    },
    /// Acid and water came together faster than is safe.
    PouredTooFast {
        /// The flask that it came to.
        flask: String,
        /// The most in any half second, m³/s.
        rate_m3_s: f64,
        /// What is safe, m³/s.
        limit_m3_s: f64,
    },
    /// Liquid left an upright flask over its rim while it boiled, as drops or as a whole.
    BoiledOver {
        /// The flask.
        flask: String,
        /// How much, m³.
        volume_m3: f64,
        /// Its mean acid mass fraction.
        acid: f64,
    },
    /// Liquid became so hot that it burns skin.
    Hot {
        /// Its flask.
        flask: String,
        /// The hottest until it cooled below again, °C.
        temperature_c: f64,
    },
    /// Liquid came to lie beside the flasks.
    Spilt {
        /// On what.
        surface: Surface,
        /// How much, m³.
        volume_m3: f64,
        /// Its mean acid mass fraction.
        acid: f64,
    },
    /// Acid, or hot liquid, came to the user.
    OnSkin {
        /// To what part.
        skin: Skin,
        /// How much, m³.
        volume_m3: f64,
        /// Its mean acid mass fraction.
        acid: f64,
        /// Its mean temperature, °C; `None` where no heat is modelled.
        temperature_c: Option<f64>,
        /// Whether what is worn there, gloves or goggles, kept it from the skin.
        protected: bool,
    },
    /// A flask that nobody held struck bench or floor hard.
    Dropped {
        /// The flask.
        flask: String,
        /// How fast it struck, m/s.
        speed_m_s: f64,
        /// Whether it broke.
        broke: bool,
    },
}

/// On what liquid lies.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, JsonSchema, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Surface {
    /// The bench's top.
    Bench,
    /// The floor.
    Floor,
}

/// A part of the user.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, JsonSchema, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Skin {
    /// The left hand.
    LeftHand,
    /// The right hand.
    RightHand,
    /// The face.
    Face,
}

/// Why something went wrong: what was under way where its liquid came from.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "cause", rename_all = "kebab-case")]
pub enum Cause {
    /// The user poured from that flask.
    Pouring {
        /// The flask.
        from: String,
    },
    /// What that flask held boiled.
    Boiling {
        /// The flask.
        flask: String,
    },
    /// That flask broke.
    Breaking {
        /// The flask.
        flask: String,
    },
    /// That flask was let go of.
    LettingGo {
        /// The flask.
        flask: String,
    },
    /// What that flask held was thrown out as it moved, or splashed out as something fell into it.
    Splashing {
        /// The flask.
        flask: String,
    },
    /// Acid and water came together there and gave off their heat.
    Mixing {
        /// The flask.
        flask: String,
    },
    /// A burner or hot plate heats that flask.
    Heating {
        /// The flask.
        flask: String,
    },
    /// Not known, such as of liquid that had never been in a flask.
    Unknown,
}

/// How an attempt ended.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Ending {
    /// Simulated time of the run, s.
    pub t_s: f64,
    /// What each flask holds.
    pub contents: Contents,
    /// The hottest liquid of the attempt, where heat is modelled.
    pub hottest: Option<Hottest>,
    /// What lies on the bench, m³.
    pub bench_m3: f64,
    /// What lies on the floor, m³.
    pub floor_m3: f64,
}

/// The hottest liquid of an attempt.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Hottest {
    /// When, s.
    pub t_s: f64,
    /// In which flask; `None` outside.
    pub flask: Option<String>,
    /// °C, of a single particle.
    pub temperature_c: f64,
}
