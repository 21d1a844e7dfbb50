//! Events of an attempt. Field names are the keys of a recording's `/events` and of `report.json`: SI units, temperatures in °C, real size
//! whatever the scene's scale.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::glass::Glassware;

/// An event of an attempt, found in the census of particles and emitted once it is over.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
pub enum Event {
    /// A scene was started: an attempt begins.
    Begun {
        /// Simulated time of the run, s.
        t_s: f64,
        /// Name of the scene.
        scene: String,
        /// Contents of each flask at the start.
        contents: Contents,
        /// What each flask is, as texts name it; empty in recordings of older versions.
        #[serde(default, skip_serializing_if = "Glassware::is_empty")]
        glass: Glassware,
    },
    /// Liquid was poured.
    Poured(Pour),
    /// Something went wrong.
    Incident(Incident),
    /// The attempt is over.
    Ended(Ending),
}

impl Event {
    /// JSON schema of an event as a recording stores it.
    pub fn schema() -> String {
        schemars::schema_for!(Self).to_value().to_string()
    }

    /// Whether a run found what a recording has. Recordings of older versions have no [`Glassware`].
    pub fn are_same(recorded: &[Self], found: &[Self]) -> bool {
        let same = |(recorded, found): (&Self, &Self)| match (recorded, found) {
            (Self::Begun { glass, .. }, Self::Begun { .. }) if glass.is_empty() => {
                let mut found = found.clone();
                if let Self::Begun { glass, .. } = &mut found {
                    glass.clear();
                }
                *recorded == found
            }
            _ => recorded == found,
        };
        recorded.len() == found.len() && recorded.iter().zip(found).all(same)
    }
}

/// A pour: liquid that left one tilted flask and arrived at one other place, without a pause of more than a second.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Pour {
    /// When its first liquid arrived, simulated time of the run, s: the film's time.
    pub t_s: f64,
    /// When its last liquid arrived, s.
    pub until_s: f64,
    /// The flask that it came from.
    pub from: String,
    /// The flask that it came to; `None` where it came to bench or floor.
    pub into: Option<String>,
    /// Volume, m³.
    pub volume_m3: f64,
    /// Highest flow rate over any half second, m³/s.
    pub fastest_m3_s: f64,
    /// Its mean acid mass fraction.
    pub acid: f64,
    /// Contents of the target flask before it; `None` where the flask was empty, or where the liquid came to no flask.
    pub met: Option<Content>,
    /// Whether the user wore no goggles while it arrived, in a scene that has some.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub bare_face: bool,
}

impl Pour {
    /// Duration, s.
    pub fn lasted_s(&self) -> f64 {
        self.until_s - self.t_s
    }
}

/// Liquid in a flask.
#[derive(Clone, Copy, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Content {
    /// Volume, m³.
    pub volume_m3: f64,
    /// Acid mass fraction.
    pub acid: f64,
    /// Mean temperature, °C; `None` where no heat is modelled.
    pub temperature_c: Option<f64>,
}

/// Contents by flask name, without empty flasks.
pub type Contents = BTreeMap<String, Content>;

/// An incident: something that went wrong.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Incident {
    /// When it began, simulated time of the run, s: the film's time, to which a report jumps.
    pub t_s: f64,
    /// When it was last observed, s; of liquid, when the last of it arrived.
    pub until_s: f64,
    /// What went wrong.
    pub what: What,
    /// Why it went wrong.
    pub cause: Cause,
    /// Where, m at real size in the frame of the scene's file: mean position of its liquid or glass.
    pub place_m: [f64; 3],
}

impl Incident {
    /// Duration, s.
    pub fn lasted_s(&self) -> f64 {
        self.until_s - self.t_s
    }
}

/// What went wrong, with the measured values.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum What {
    /// Liquid that is not concentrated acid was poured into concentrated acid: the incorrect order.
    WaterIntoAcid {
        /// The flask that holds the acid.
        flask: String,
        /// Acid mass fraction that the first of the liquid met.
        met_acid: f64,
        /// Volume that arrived while the acid was concentrated, m³.
        volume_m3: f64,
    },
    /// Acid and water came together faster than is safe.
    PouredTooFast {
        /// The flask that the liquid came to.
        flask: String,
        /// Highest flow rate over any half second, m³/s.
        rate_m3_s: f64,
        /// Highest safe flow rate, m³/s.
        limit_m3_s: f64,
    },
    /// Liquid left an upright flask over its rim while it boiled, as drops or as a whole.
    BoiledOver {
        /// The flask that it left.
        flask: String,
        /// Volume, m³.
        volume_m3: f64,
        /// Its mean acid mass fraction.
        acid: f64,
    },
    /// Liquid became so hot that it burns skin.
    Hot {
        /// The flask that holds it.
        flask: String,
        /// Highest mean temperature until it cooled below the limit again, °C.
        temperature_c: f64,
    },
    /// Liquid came to lie beside the flasks.
    Spilt {
        /// The surface that it lies on.
        surface: Surface,
        /// Volume, m³.
        volume_m3: f64,
        /// Its mean acid mass fraction.
        acid: f64,
    },
    /// Acid, or hot liquid, touched the user.
    OnSkin {
        /// The part of the body.
        skin: Skin,
        /// Volume, m³.
        volume_m3: f64,
        /// Its mean acid mass fraction.
        acid: f64,
        /// Its mean temperature, °C; `None` where no heat is modelled.
        temperature_c: Option<f64>,
        /// Whether gloves or goggles kept all of it off the skin.
        protected: bool,
    },
    /// A flask that nobody held struck bench or floor hard.
    Dropped {
        /// The flask.
        flask: String,
        /// Highest speed of impact, m/s at real size.
        speed_m_s: f64,
        /// Whether it broke.
        broke: bool,
    },
}

/// A surface that spilt liquid lies on.
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

/// A part of the user's body that liquid can touch.
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

/// Why something went wrong: the process at the flask that the liquid or heat came from.
#[derive(Clone, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(tag = "cause", rename_all = "kebab-case")]
pub enum Cause {
    /// The user poured from that flask.
    Pouring {
        /// The flask.
        from: String,
    },
    /// The liquid in that flask boiled.
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
    /// Liquid was thrown out of that flask by its motion, or splashed out as something fell in.
    Splashing {
        /// The flask.
        flask: String,
    },
    /// Acid and water mixed in that flask and gave off heat.
    Mixing {
        /// The flask.
        flask: String,
    },
    /// Acid and water lay on one another in that flask, and moving it mixed them at once.
    Swirling {
        /// The flask.
        flask: String,
    },
    /// A burner or hot plate heats that flask.
    Heating {
        /// The flask.
        flask: String,
    },
    /// Not known, as for liquid that was never in a flask.
    Unknown,
}

/// How an attempt ended.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Ending {
    /// Simulated time of the run, s.
    pub t_s: f64,
    /// Contents of each flask.
    pub contents: Contents,
    /// The hottest particle of the attempt; `None` where no heat is modelled.
    pub hottest: Option<Hottest>,
    /// Volume on the bench, m³.
    pub bench_m3: f64,
    /// Volume on the floor, m³.
    pub floor_m3: f64,
}

/// The hottest particle of an attempt.
#[derive(Clone, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Hottest {
    /// When, simulated time of the run, s.
    pub t_s: f64,
    /// The flask that held it; `None` outside all flasks.
    pub flask: Option<String>,
    /// Its temperature, °C.
    pub temperature_c: f64,
}
