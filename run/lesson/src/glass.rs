//! What texts call the flasks of a scene: by what they are and what they held at the start. Their names in its file are for machines.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vitriol_sim::flask::glassware::Vessel;
use vitriol_sim::scene::Scene;

use crate::texts::{Forms, Template, Texts};
use crate::units::WATER;

/// The form of a kind of vessel that a sentence asks for.
type Form = fn(&Forms) -> &Template;

/// A flask as a text names it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
pub struct Glass {
    /// The kind of vessel.
    #[schemars(with = "String")]
    pub vessel: Vessel,
    /// What it held at the start; `None` where its kind alone names it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub held: Option<Holding>,
    /// Where it stood at the start; `None` where no other is named alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<Place>,
}

/// What a flask held at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Holding {
    /// Nothing, where others of its kind held something.
    Nothing,
    /// Water.
    Water,
    /// Acid of so many per cent by mass.
    Acid(u8),
    /// Liquids that differ, such as water on acid.
    Layers,
}

/// Where a flask stood among those that are named alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// The left one of two.
    Left,
    /// The right one of two.
    Right,
    /// Of more than two this one, counted from the left and from 1.
    Nth(usize),
}

/// What the flasks of a scene are, by their names in its file.
pub type Glassware = BTreeMap<String, Glass>;

impl Glass {
    /// What the flasks of `scene` are.
    pub fn all(scene: &Scene) -> Glassware {
        let flasks = &scene.flasks;
        let kinds = flasks.iter().enumerate().map(|(index, flask)| {
            let others = flasks.iter().filter(|it| it.vessel == flask.vessel);
            let held = holding(scene, index);
            let held = held.or((others.count() > 1).then_some(Holding::Nothing));
            // What cooks in a pot is none of these.
            (flask.vessel, held.filter(|_| flask.vessel != Vessel::Pot))
        });
        let kinds: Vec<_> = kinds.collect();
        let places: Vec<f32> = flasks
            .iter()
            .map(|flask| flask.stage_from_flask.position.x)
            .collect();
        let named = flasks.iter().zip(&kinds).enumerate();
        let named = named.map(|(index, (flask, kind))| {
            let others = || kinds.iter().zip(&places).enumerate();
            let alike = || others().filter(move |(_, (other, _))| *other == kind);
            let left = alike().filter(|(other, (_, x))| {
                let order = x.total_cmp(&flask.stage_from_flask.position.x);
                order.then(other.cmp(&index)).is_lt()
            });
            let place = match (alike().count(), left.count()) {
                (0 | 1, _) => None,
                (2, 0) => Some(Place::Left),
                (2, _) => Some(Place::Right),
                (_, left) => Some(Place::Nth(left + 1)),
            };
            let &(vessel, held) = kind;
            let glass = Self {
                vessel,
                held,
                place,
            };
            (flask.name.clone(), glass)
        });
        named.collect()
    }
}

/// What that flask of the scene holds at the start; `None` where it is empty.
fn holding(scene: &Scene, flask: usize) -> Option<Holding> {
    let liquids = scene.liquids.iter().filter(|it| it.flask == flask);
    let kinds = liquids.map(|liquid| {
        if liquid.acid_fraction < WATER {
            Holding::Water
        } else {
            Holding::Acid((100.0 * liquid.acid_fraction).round() as u8)
        }
    });
    kinds.reduce(|first, next| {
        if first == next {
            first
        } else {
            Holding::Layers
        }
    })
}

impl Texts {
    /// A flask's name by itself, as over a reading of it.
    pub fn glass(&self, glass: &Glass) -> String {
        self.named(glass, |forms| &forms.label)
    }

    /// The names by themselves of the flasks of `scene`, in its order. They are the same for as long as it is on the bench, so that
    /// no frame needs to make them.
    pub fn flasks(&self, scene: &Scene) -> Vec<String> {
        let glassware = Glass::all(scene);
        let flasks = scene.flasks.iter();
        let names = flasks.map(|flask| self.flask(&glassware, &flask.name));
        names.collect()
    }

    /// The name by itself of that flask of a scene.
    pub fn flask(&self, glassware: &Glassware, flask: &str) -> String {
        let glass = glassware.get(flask).copied();
        self.glass(&glass.unwrap_or_default())
    }

    fn named(&self, glass: &Glass, form: Form) -> String {
        let vessel = self.vessel.get(&glass.vessel);
        let vessel = vessel.map(|forms| form(forms).text()).unwrap_or_default();
        let texts = &self.glass;
        let held = glass.held.map(|held| match held {
            Holding::Nothing => texts.empty.text(),
            Holding::Water => texts.water.text(),
            Holding::Acid(percent) => texts.acid.fill(&[("number", &percent.to_string())]),
            Holding::Layers => texts.layers.text(),
        });
        let held = held.unwrap_or_default();
        let place = glass.place.map(|place| match place {
            Place::Left => texts.left.text(),
            Place::Right => texts.right.text(),
            Place::Nth(number) => texts.nth.fill(&[("number", &number.to_string())]),
        });
        let place = place.unwrap_or_default();
        let holes = [("vessel", &*vessel), ("held", &*held), ("place", &*place)];
        self.join.glass.fill(&holes)
    }

    /// A sentence with the names of `flasks`, each in its hole and in the form that the sentence asks for, and other `holes`.
    pub(crate) fn with_flasks(
        &self,
        template: &Template,
        glassware: &Glassware,
        flasks: &[(&str, &str)],
        holes: &[(&str, &str)],
    ) -> String {
        let forms: [(&str, Form); 3] = [
            ("", |forms| &forms.subject),
            (":into", |forms| &forms.into),
            (":of", |forms| &forms.of),
        ];
        let names = flasks.iter().flat_map(|(hole, flask)| {
            let glass = glassware.get(*flask).copied().unwrap_or_default();
            forms.map(|(form, of)| (format!("{hole}{form}"), self.named(&glass, of)))
        });
        let names: Vec<(String, String)> = names.collect();
        let names = names.iter().map(|(hole, name)| (&**hole, &**name));
        let all: Vec<(&str, &str)> = names.chain(holes.iter().copied()).collect();
        template.fill(&all)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::Language;
    use std::collections::BTreeSet;

    fn labels(scene: &str, language: Language) -> Vec<String> {
        let texts = Texts::of(language).unwrap();
        let labels = texts.flasks(&Scene::builtin(scene).unwrap()).into_iter();
        labels.map(|it| it.replace('\u{a0}', " ")).collect()
    }

    /// What stands on the bench, as the files of these scenes have it.
    #[test]
    fn a_flask_is_named_by_what_it_is_and_holds() {
        let english = |scene| labels(scene, Language::En);
        assert_eq!(
            english("acid-into-water"),
            ["Beaker with 98 % acid", "Beaker with water"]
        );
        assert_eq!(
            english("three-flasks"),
            [
                "Beaker with water on the left",
                "Beaker (empty at first)",
                "Beaker with water on the right"
            ]
        );
        assert_eq!(
            english("rinse-the-bottle"),
            ["Beaker with water", "Bottle with 98 % acid"]
        );
        assert_eq!(
            english("acid-on-glove"),
            ["Tray", "Bottle with water", "Beaker with 98 % acid"]
        );
        assert_eq!(
            labels("acid-into-water", Language::De),
            [
                "Becherglas mit 98-prozentiger Säure",
                "Becherglas mit Wasser"
            ]
        );
        assert_eq!(
            labels("acid-into-water", Language::Es),
            ["Vaso con ácido al 98 %", "Vaso con agua"]
        );
        assert_eq!(
            labels("acid-into-water", Language::Zh),
            ["装98%硫酸的烧杯", "装水的烧杯"]
        );
    }

    /// In each built-in scene and language no two flasks have one name, and none has that of its file.
    #[test]
    fn names_differ_and_are_not_those_of_files() {
        for name in Scene::builtin_names() {
            let scene = Scene::builtin(name).unwrap();
            for language in Language::ALL {
                let labels = labels(name, language);
                let different: BTreeSet<&String> = labels.iter().collect();
                assert_eq!(different.len(), scene.flasks.len(), "{name}: {labels:?}");
                for (flask, label) in scene.flasks.iter().zip(&labels) {
                    assert!(!label.is_empty() && *label != flask.name, "{name}");
                    assert!(!label.contains(['{', '}']), "{label}");
                }
            }
        }
    }

    /// Each kind of vessel has its words, in each language; else it would have none.
    #[test]
    fn each_vessel_has_its_words() {
        for language in Language::ALL {
            let texts = Texts::of(language).unwrap();
            for vessel in Vessel::ALL {
                assert!(texts.vessel.contains_key(&vessel), "{language}: {vessel:?}");
            }
        }
    }

    /// Case and article are those that the place in a sentence asks for.
    #[test]
    fn a_sentence_has_the_form_that_it_asks_for() {
        let glassware = Glass::all(&Scene::builtin("acid-into-water").unwrap());
        let said = |language, sentence: &str| {
            let template: Template = serde_json::from_value(sentence.into()).unwrap();
            let texts = Texts::of(language).unwrap();
            let flasks = [("from", "source"), ("flask", "target")];
            let said = texts.with_flasks(&template, &glassware, &flasks, &[]);
            said.replace('\u{a0}', " ")
        };
        assert_eq!(
            said(
                Language::De,
                "{Flask} kochte, aus {from:of} in {flask:into}."
            ),
            "Das Becherglas mit Wasser kochte, aus dem Becherglas mit 98-prozentiger Säure in das Becherglas mit Wasser."
        );
        assert_eq!(
            said(Language::Es, "{from:of} en {flask:into}"),
            "del vaso de precipitados con ácido al 98 % en el vaso de precipitados con agua"
        );
        // A flask that nothing is known of, as in recordings of older versions.
        let texts = Texts::english().unwrap();
        assert_eq!(texts.flask(&glassware, "other"), "Vessel");
    }
}
