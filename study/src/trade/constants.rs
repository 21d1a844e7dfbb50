//! The constants of the physical chemistry that come from no table, and the effect of halving and doubling each.

use std::fmt::Write;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use vitriol_sim::scene::{PhysicalChemistry, Scene};

use super::boil::Seeds;

/// A constant of `[physical]`, and its source.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Constant {
    /// Its key in scenes.
    pub key: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its source, or the data that it was fitted to.
    pub source: &'static str,
    #[serde(skip)]
    value: fn(&mut PhysicalChemistry) -> &mut Option<f64>,
}

/// All constants but the room's temperature, the bound on bubbles and `foam_time`, for which there is a law. A scene has those of its features.
pub const CONSTANTS: [Constant; 6] = [
    Constant {
        key: "mixing",
        unit: "1",
        source: "Lilly 1967 over a turbulent Schmidt number of 0.7",
        value: |p| &mut p.mixing,
    },
    Constant {
        key: "eddy_width",
        unit: "m",
        source: "chosen: what the coarsest particles of real size resolve",
        value: |p| &mut p.eddy_width,
    },
    Constant {
        key: "lamella",
        unit: "m",
        source: "chosen: a fraction of a millimetre",
        value: |p| &mut p.lamella,
    },
    Constant {
        key: "nuclei_spacing",
        unit: "m",
        source: "chosen between dirty and clean liquid (Brennen 1995)",
        value: |p| &mut p.nuclei_spacing,
    },
    Constant {
        key: "glass_loss",
        unit: "W/(m² K)",
        source: "Incropera: still air 2 to 25",
        value: |p| &mut p.glass_loss,
    },
    Constant {
        key: "surface_loss",
        unit: "W/(m² K)",
        source: "Incropera: still air 2 to 25",
        value: |p| &mut p.surface_loss,
    },
];

impl Constant {
    /// Its value in `scene`; `None` where the scene has none.
    pub fn of(&self, scene: &Scene) -> Option<f64> {
        let mut physical = scene.physical?;
        *(self.value)(&mut physical)
    }

    /// A copy of `scene` with `times` its value.
    pub fn times(&self, scene: &Scene, times: f64) -> Scene {
        let mut scene = scene.clone();
        if let Some(value) = scene.physical.as_mut().map(self.value)
            && let Some(value) = value
        {
            *value *= times;
        }
        scene
    }
}

impl<'de> Deserialize<'de> for Constant {
    /// Reads a constant by its key.
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Key {
            key: String,
        }
        let Key { key } = Key::deserialize(from)?;
        let known = CONSTANTS.into_iter().find(|it| it.key == key);
        known.ok_or_else(|| D::Error::custom(format!("there is no constant {key:?}")))
    }
}

/// Result of a scene with a constant changed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Change {
    /// The constant; `None` where all are as in the scene.
    pub constant: Option<Constant>,
    /// Its value in the scene.
    pub value: f64,
    /// Factor of that value.
    pub times: f64,
    /// Results of several seeds.
    pub seeds: Seeds,
}

/// The table of medians, each scene in a block.
pub fn describe(changes: &[Change]) -> String {
    let mut t = format!(
        "\n{:<16} {:>7} {:>9}  {:>9} {:>9} {:>9} {:>9}  scene; source\n",
        "constant", "times", "value", "thrown g", "steam g", "hot K", "end °C"
    );
    for change in changes {
        let key = change.constant.map_or("all as they are", |c| c.key);
        let source = change.constant.map_or("", |c| c.source);
        let median = |of: &super::boil::Quartiles| of.0[1];
        let seeds = &change.seeds;
        // Writing to a string cannot fail.
        let _ = writeln!(
            t,
            "{key:<16} {:>7.2} {:>9.3e}  {:>9.3} {:>9.3} {:>9.1} {:>9.1}  {}; {source}",
            change.times,
            change.value * change.times,
            median(&seeds.thrown),
            median(&seeds.steam),
            median(&seeds.superheat),
            median(&seeds.temperature),
            seeds.name,
        );
    }
    t
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn every_number_of_a_scene_is_a_constant_but_the_rooms_temperature() {
        let scene = Scene::builtin("water-into-acid").unwrap();
        let fields = serde_json::to_value(scene.physical.unwrap()).unwrap();
        let keys: Vec<_> = fields
            .as_object()
            .unwrap()
            .keys()
            // The last is for scenes whose particles hold their vapour.
            .filter(|key| {
                let others = ["ambient", "most_bubbles", "foam_time", "superheat_time"];
                !others.contains(&key.as_str())
            })
            .collect();
        assert_eq!(keys.len(), CONSTANTS.len(), "{keys:?}");
        for constant in CONSTANTS {
            assert!(
                keys.iter().any(|key| *key == constant.key),
                "{}",
                constant.key
            );
            let Some(value) = constant.of(&scene) else {
                assert!(fields[constant.key].is_null(), "{}", constant.key);
                continue;
            };
            let doubled = constant.times(&scene, 2.0);
            assert_eq!(constant.of(&doubled), Some(2.0 * value));
            // And nothing else.
            assert_eq!(constant.times(&doubled, 0.5).physical, scene.physical);
        }
    }
}
