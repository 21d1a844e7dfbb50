//! Checks that a lesson asks for nothing that its scene does not have.

use super::condition::{Condition, Keep};
use super::error::{Problem, listed};
use super::sight::SceneFacts;

/// mL per m³.
const ML: f64 = 1e6;

impl SceneFacts {
    fn flask(&self, field: &str, name: &str) -> Result<(), Problem> {
        if self.flasks.iter().any(|flask| flask.name == name) {
            return Ok(());
        }
        let known = listed(self.flasks.iter().map(|flask| flask.name.as_str()));
        let scene = &self.name;
        let problem = format!("the scene {scene:?} has no flask {name:?}; take one of {known}");
        Err(Problem::new(field, problem))
    }

    fn lifted(&self, field: &str, name: &str) -> Result<(), Problem> {
        self.flask(field, name)?;
        let lifted = || self.flasks.iter().filter(|flask| flask.lifted);
        if lifted().any(|flask| flask.name == name) {
            return Ok(());
        }
        let known = listed(lifted().map(|flask| flask.name.as_str()));
        let problem =
            format!("{name:?} is fixed, and cannot be lifted; those that can are {known}");
        Err(Problem::new(field, problem))
    }

    fn has(&self, field: &str, there: bool, what: &str) -> Result<(), Problem> {
        if there {
            return Ok(());
        }
        let scene = &self.name;
        let problem =
            format!("the scene {scene:?} has no {what}; take it out, or take a scene that has");
        Err(Problem::new(field, problem))
    }

    fn as_much(&self, field: &str, ml: f64) -> Result<(), Problem> {
        let most = self.liquid_m3 * ML;
        if ml <= most {
            return Ok(());
        }
        let scene = &self.name;
        let problem = format!("the scene {scene:?} has {most:.0} mL in all; take less than {ml}");
        Err(Problem::new(field, problem))
    }
}

/// What a scene needs for temperatures, as messages name it.
const HEAT: &str = "heat in its `model`";

impl Condition {
    /// Checks that the scene has what this condition needs.
    pub(super) fn fits(&self, field: &str, facts: &SceneFacts) -> Result<(), Problem> {
        let named = |name: &str| format!("{field}.{name}");
        let flask = |flask: &str| facts.flask(&named("flask"), flask);
        match self {
            Self::All(parts) | Self::Any(parts) => {
                for (index, part) in parts.iter().enumerate() {
                    part.fits(&part.field(&format!("{field}[{index}]")), facts)?;
                }
                Ok(())
            }
            Self::Lifted(it) | Self::PutDown(it) => facts.lifted(&named("flask"), &it.flask),
            Self::Poured(it) => {
                facts.flask(&named("from"), &it.from)?;
                facts.flask(&named("into"), &it.into)?;
                if it.from == it.into {
                    let problem = "the flask that it is poured from; name another";
                    return Err(Problem::new(named("into"), problem));
                }
                facts.as_much(&named("at_least_ml"), it.at_least_ml)
            }
            Self::Holds(it) => {
                flask(&it.flask)?;
                facts.as_much(&named("at_least_ml"), it.at_least_ml)
            }
            Self::Temperature(it) => {
                flask(&it.flask)?;
                facts.has(field, facts.heat, HEAT)
            }
            Self::Goggles(_) => facts.has(field, facts.goggles, "goggles to put on or take off"),
            Self::Gloves(_) => facts.has(field, facts.gloves, "gloves to put on or take off"),
            Self::Sash(_) => facts.has(field, facts.sash, "hood with a sash"),
            Self::Stirred(it) => {
                flask(&it.flask)?;
                facts.has(field, facts.rod, "stirring rod")
            }
            Self::Measured(it) => {
                flask(&it.flask)?;
                facts.has(field, facts.thermometer, "thermometer")
            }
            Self::Wiped(_) => facts.has(field, facts.cloth, "cloth to wipe with"),
            Self::Rinsed(_) => facts.has(field, facts.rinsing, "water to rinse hands with"),
            Self::Answered(_) => Ok(()),
        }
    }
}

impl Keep {
    /// Checks that the scene has what this requirement needs.
    pub(super) fn fits(&self, field: &str, facts: &SceneFacts) -> Result<(), Problem> {
        match self {
            Self::Never(super::Kind::Hot) => facts.has(field, facts.heat, HEAT),
            Self::Never(_) | Self::Spilt(_) => Ok(()),
            Self::Cool(it) => {
                facts.flask(&format!("{field}.cool.flask"), &it.flask)?;
                facts.has(field, facts.heat, HEAT)
            }
            Self::Goggles => facts.has(field, facts.goggles, "goggles to put on or take off"),
            Self::Gloves => facts.has(field, facts.gloves, "gloves to put on or take off"),
            Self::Sash(_) => facts.has(field, facts.sash, "hood with a sash"),
        }
    }
}
