//! Checks that a lesson asks for nothing that its scene does not have.

use super::condition::{Condition, Keep};
use super::error::{Problems, listed};
use super::sight::SceneFacts;

/// mL per m³.
const ML: f64 = 1e6;

/// The problems of a lesson in a scene with these facts.
pub(super) struct Fit<'a> {
    pub facts: &'a SceneFacts,
    pub problems: &'a mut Problems,
}

impl Fit<'_> {
    /// Whether the scene has that flask; a problem is added if it does not.
    fn flask(&mut self, field: &str, name: &str) -> bool {
        let mut flasks = self.facts.flasks.iter();
        if flasks.any(|flask| flask.name == name) {
            return true;
        }
        let known = listed(self.facts.flasks.iter().map(|flask| flask.name.as_str()));
        let scene = &self.facts.name;
        let problem = format!("the scene {scene:?} has no flask {name:?}; take one of {known}");
        self.problems.add(field, problem);
        false
    }

    fn lifted(&mut self, field: &str, name: &str) {
        if !self.flask(field, name) {
            return;
        }
        let lifted = || self.facts.flasks.iter().filter(|flask| flask.lifted);
        if lifted().any(|flask| flask.name == name) {
            return;
        }
        let known = listed(lifted().map(|flask| flask.name.as_str()));
        let problem =
            format!("{name:?} is fixed, and cannot be lifted; those that can are {known}");
        self.problems.add(field, problem);
    }

    fn has(&mut self, field: &str, there: bool, what: &str) {
        if !there {
            let scene = &self.facts.name;
            let problem =
                format!("the scene {scene:?} has no {what}; take it out, or take a scene that has");
            self.problems.add(field, problem);
        }
    }

    fn as_much(&mut self, field: &str, ml: f64) {
        let most = self.facts.liquid_m3 * ML;
        if ml > most {
            let scene = &self.facts.name;
            let problem = format!(
                "the scene {scene:?} has {most:.0} mL in all, and this is {ml}; take {most:.0} at most"
            );
            self.problems.add(field, problem);
        }
    }
}

/// What a scene needs for temperatures, as messages name it.
const HEAT: &str = "heat in its `model`";

impl Condition {
    /// Checks that the scene has what this condition needs.
    pub(super) fn fits(&self, field: &str, fit: &mut Fit<'_>) {
        let named = |name: &str| format!("{field}.{name}");
        let facts = fit.facts;
        match self {
            Self::All(parts) | Self::Any(parts) => {
                for (index, part) in parts.iter().enumerate() {
                    part.fits(&part.field(&format!("{field}[{index}]")), fit);
                }
            }
            Self::Lifted(it) | Self::PutDown(it) => fit.lifted(&named("flask"), &it.flask),
            Self::Poured(it) => {
                fit.flask(&named("from"), &it.from);
                fit.flask(&named("into"), &it.into);
                if it.from == it.into {
                    let problem = "the flask that it is poured from; name another";
                    fit.problems.add(named("into"), problem);
                }
                fit.as_much(&named("at_least_ml"), it.at_least_ml);
            }
            Self::Holds(it) => {
                fit.flask(&named("flask"), &it.flask);
                fit.as_much(&named("at_least_ml"), it.at_least_ml);
            }
            Self::Temperature(it) => {
                fit.flask(&named("flask"), &it.flask);
                fit.has(field, facts.heat, HEAT);
            }
            Self::Goggles(_) => fit.has(field, facts.goggles, "goggles to put on or take off"),
            Self::Gloves(_) => fit.has(field, facts.gloves, "gloves to put on or take off"),
            Self::Sash(_) => fit.has(field, facts.sash, "hood with a sash"),
            Self::Stirred(it) => {
                fit.flask(&named("flask"), &it.flask);
                fit.has(field, facts.rod, "stirring rod");
            }
            Self::Measured(it) => {
                fit.flask(&named("flask"), &it.flask);
                fit.has(field, facts.thermometer, "thermometer");
            }
            Self::Wiped(_) => fit.has(field, facts.cloth, "cloth to wipe with"),
            Self::Rinsed(_) => fit.has(field, facts.rinsing, "water to rinse hands with"),
            Self::Answered(_) => {}
        }
    }
}

impl Keep {
    /// Checks that the scene has what this requirement needs.
    pub(super) fn fits(&self, field: &str, fit: &mut Fit<'_>) {
        let facts = fit.facts;
        match self {
            Self::Never(super::Kind::Hot) => fit.has(field, facts.heat, HEAT),
            Self::Never(_) | Self::Spilt(_) => {}
            Self::Cool(it) => {
                fit.flask(&format!("{field}.cool.flask"), &it.flask);
                fit.has(field, facts.heat, HEAT);
            }
            Self::Goggles => fit.has(field, facts.goggles, "goggles to put on or take off"),
            Self::Gloves => fit.has(field, facts.gloves, "gloves to put on or take off"),
            Self::Sash(_) => fit.has(field, facts.sash, "hood with a sash"),
        }
    }
}
