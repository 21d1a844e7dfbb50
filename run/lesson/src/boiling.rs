//! How violently a run boiled, in figures that do not grow with the run's length.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::texts::{Template, Texts};

/// How violently a run boiled. Metres are the scene's, as in all samples; a value is absent where the scene cannot have it, or where
/// the run was too short for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Boiling {
    /// Most volume of steam that left the liquid in half a second, m/s: at the boiling point of water and one atmosphere, over that
    /// time and over the surface of the liquid in the flask whose liquid was hottest at its end. Steam is not told by flask; where a
    /// flask boils, nearly all of it comes from there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most_steam_m_s: Option<f64>,
    /// Most volume of all bubbles at any sample, m³; where bubbles are modelled.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most_gas_m3: Option<f64>,
    /// Mass that left the flask in which acid and water first came together, within two seconds of that, each particle once, and
    /// drops of bubbles that came to rest elsewhere, kg. What is poured into it does not count: that left another flask.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thrown_first_kg: Option<f64>,
    /// Greatest height of liquid in no flask, particles and drops of bubbles, over the rim of the flask that it left, m, at any sample;
    /// where any was above it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub highest_drop_m: Option<f64>,
    /// Edge of the cube of liquid that has one nucleus which grows at a superheat of 1 K, m: the scene's, or what the seed drew.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nuclei_spacing_m: Option<f64>,
}

/// A figure of [`Boiling`] in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoilingFigure {
    /// Its key in `report.json`.
    pub key: &'static str,
    /// Its name.
    pub name: String,
    /// Its value with a unit.
    pub value: String,
    /// What it is of.
    pub note: String,
}

impl Boiling {
    /// Whether there is no figure.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl Texts {
    /// The figures that there are, in words.
    pub fn boiling(&self, boiling: &Boiling) -> Vec<BoilingFigure> {
        let words = &self.boiling;
        let figure = |key, [name, note]: [&Template; 2], value: Option<String>| {
            value.map(|value| BoilingFigure {
                key,
                name: name.text(),
                value,
                note: note.text(),
            })
        };
        let steam = boiling.most_steam_m_s.map(|it| self.slow_speed(it));
        let gas = boiling.most_gas_m3.map(|it| self.volume(it));
        let thrown = boiling.thrown_first_kg.map(|it| self.mass(it));
        let drop = boiling.highest_drop_m.map(|it| self.length(it));
        let nuclei = boiling.nuclei_spacing_m.map(|it| self.length(it));
        let figures = [
            figure("most_steam_m_s", [&words.steam, &words.steam_note], steam),
            figure("most_gas_m3", [&words.gas, &words.gas_note], gas),
            figure(
                "thrown_first_kg",
                [&words.thrown, &words.thrown_note],
                thrown,
            ),
            figure("highest_drop_m", [&words.drop, &words.drop_note], drop),
            figure(
                "nuclei_spacing_m",
                [&words.nuclei, &words.nuclei_note],
                nuclei,
            ),
        ];
        figures.into_iter().flatten().collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::Language;

    #[test]
    fn figures_are_said_in_each_language() {
        let boiling = Boiling {
            most_steam_m_s: Some(0.114),
            most_gas_m3: Some(3.12e-6),
            thrown_first_kg: Some(21.4e-6),
            highest_drop_m: Some(0.0123),
            nuclei_spacing_m: Some(0.04),
        };
        for language in Language::ALL {
            let texts = Texts::of(language).unwrap();
            let said = texts.boiling(&boiling);
            let values = said
                .iter()
                .map(|it| it.value.replace('\u{a0}', " ").replace(',', "."));
            let values: Vec<_> = values.collect();
            assert_eq!(
                values,
                ["11 cm/s", "3.1 mL", "21 mg", "1.2 cm", "4.0 cm"],
                "{language}"
            );
        }
    }

    #[test]
    fn what_a_scene_cannot_have_is_not_said() {
        let texts = Texts::english().unwrap();
        assert!(Boiling::default().is_empty());
        assert!(texts.boiling(&Boiling::default()).is_empty());
        let boiling = Boiling {
            highest_drop_m: Some(0.5),
            ..Boiling::default()
        };
        let said = texts.boiling(&boiling);
        assert_eq!(said.len(), 1);
        assert_eq!(
            (said[0].key, said[0].name.as_str()),
            ("highest_drop_m", "Highest drop")
        );
        assert!(!boiling.is_empty());
        let json = serde_json::to_string(&boiling).unwrap();
        assert_eq!(json, r#"{"highest_drop_m":0.5}"#);
    }
}
