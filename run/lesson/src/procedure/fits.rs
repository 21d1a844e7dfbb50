//! Checks that a lesson asks for nothing that its scene does not have.

use vitriol_sim::scene::ToolKind;

use super::condition::{Condition, Keep};
use super::error::{Problems, listed};
use super::sight::SceneFacts;
use crate::texts::{FaultTexts, Template};

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
        let texts = &self.problems.texts;
        let flasks = self.facts.flasks.iter();
        let known = listed(texts, flasks.map(|flask| flask.name.as_str()));
        let problem = texts.no_flask.fill(&[
            ("scene", &self.scene()),
            ("flask", &format!("{name:?}")),
            ("known", &known),
        ]);
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
        let texts = &self.problems.texts;
        let known = listed(texts, lifted().map(|flask| flask.name.as_str()));
        let flask = format!("{name:?}");
        let problem = (texts.fixed).fill(&[("flask", &flask), ("known", &known)]);
        self.problems.add(field, problem);
    }

    fn has(&mut self, field: &str, there: bool, what: fn(&FaultTexts) -> &Template) {
        if !there {
            let texts = &self.problems.texts;
            let what = what(texts).text();
            let problem = (texts.lacks).fill(&[("scene", &self.scene()), ("what", &what)]);
            self.problems.add(field, problem);
        }
    }

    fn as_much(&mut self, field: &str, ml: f64) {
        let most = self.facts.liquid_m3 * ML;
        if ml > most {
            let problem = self.problems.texts.too_much.fill(&[
                ("scene", &self.scene()),
                ("most", &format!("{most:.0}")),
                ("volume", &ml.to_string()),
            ]);
            self.problems.add(field, problem);
        }
    }

    /// The scene's name, in quotes.
    fn scene(&self) -> String {
        format!("{:?}", self.facts.name)
    }
}

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
                    let problem = fit.problems.texts.same_flask.text();
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
                fit.has(field, facts.heat, |it| &it.heat);
            }
            Self::Goggles(_) => fit.has(field, facts.has(ToolKind::Goggles), |it| &it.goggles),
            Self::Gloves(_) => fit.has(field, facts.has(ToolKind::Gloves), |it| &it.gloves),
            Self::Sash(_) => fit.has(field, facts.has(ToolKind::Sash), |it| &it.sash),
            Self::Stirred(it) => {
                fit.flask(&named("flask"), &it.flask);
                fit.has(field, facts.has(ToolKind::Rod), |it| &it.rod);
            }
            Self::Measured(it) => {
                fit.flask(&named("flask"), &it.flask);
                let there = facts.has(ToolKind::Thermometer);
                fit.has(field, there, |it| &it.thermometer);
            }
            Self::Wiped(_) => fit.has(field, facts.has(ToolKind::Cloth), |it| &it.cloth),
            // Bare hands are rinsed as gloves are; where there are no gloves to take off, it is not measured.
            Self::Rinsed(_) => fit.has(field, facts.has(ToolKind::Gloves), |it| &it.rinsing),
            Self::Answered(_) => {}
        }
    }
}

impl Keep {
    /// Checks that the scene has what this requirement needs.
    pub(super) fn fits(&self, field: &str, fit: &mut Fit<'_>) {
        let facts = fit.facts;
        match self {
            Self::Never(super::Kind::Hot) => fit.has(field, facts.heat, |it| &it.heat),
            Self::Never(_) | Self::Spilt(_) => {}
            Self::Cool(it) => {
                fit.flask(&format!("{field}.cool.flask"), &it.flask);
                fit.has(field, facts.heat, |it| &it.heat);
            }
            Self::Goggles => fit.has(field, facts.has(ToolKind::Goggles), |it| &it.goggles),
            Self::Gloves => fit.has(field, facts.has(ToolKind::Gloves), |it| &it.gloves),
            Self::Sash(_) => fit.has(field, facts.has(ToolKind::Sash), |it| &it.sash),
        }
    }
}
