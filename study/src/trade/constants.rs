//! The constants of the physical chemistry that come from no table, in scenes and in shaders, and the effect of halving and doubling
//! each.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use vitriol_shaders::{Library, ShaderError};
use vitriol_sim::scene::{Feature, PhysicalChemistry, Scene};

use super::boil::Seeds;
use super::shader_constants::GROUPS;

/// What stands for the file of a constant that each scene has itself.
const SCENE: &str = "scene";

/// A constant of a scene's `[physical]` or of a shader, and its source.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Constant {
    /// Its key in scenes, or its name in the file.
    pub key: &'static str,
    /// Its file under `shaders/wgsl`, or `scene`.
    pub file: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its source, or the data that it was fitted to.
    pub source: &'static str,
    #[serde(skip)]
    place: Place,
}

/// Where a constant's value is.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// In `[physical]`.
    Scene(fn(&mut PhysicalChemistry) -> &mut Option<f64>),
    /// In the text of its file, for scenes of the feature.
    Shader(Feature),
}

/// All constants of scenes but the room's temperature, the bound on bubbles and `foam_time`, for which there is a law. A scene has those of
/// its features.
pub const CONSTANTS: [Constant; 6] = [
    Constant {
        key: "mixing",
        file: SCENE,
        unit: "1",
        source: "Lilly 1967 over a turbulent Schmidt number of 0.7",
        place: Place::Scene(|p| &mut p.mixing),
    },
    Constant {
        key: "eddy_width",
        file: SCENE,
        unit: "m",
        source: "chosen: what the coarsest particles of real size resolve",
        place: Place::Scene(|p| &mut p.eddy_width),
    },
    Constant {
        key: "lamella",
        file: SCENE,
        unit: "m",
        source: "chosen: a fraction of a millimetre",
        place: Place::Scene(|p| &mut p.lamella),
    },
    Constant {
        key: "nuclei_spacing",
        file: SCENE,
        unit: "m",
        source: "chosen between dirty and clean liquid (Brennen 1995)",
        place: Place::Scene(|p| &mut p.nuclei_spacing),
    },
    Constant {
        key: "glass_loss",
        file: SCENE,
        unit: "W/(m² K)",
        source: "Incropera: still air 2 to 25",
        place: Place::Scene(|p| &mut p.glass_loss),
    },
    Constant {
        key: "surface_loss",
        file: SCENE,
        unit: "W/(m² K)",
        source: "Incropera: still air 2 to 25",
        place: Place::Scene(|p| &mut p.surface_loss),
    },
];

/// The constants of scenes, then those of shaders.
pub fn all() -> impl Iterator<Item = Constant> {
    let of_shaders = GROUPS.iter().flat_map(|group| {
        group.rows.iter().map(move |&(key, unit, source)| Constant {
            key,
            file: group.file,
            unit,
            source,
            place: Place::Shader(group.feature),
        })
    });
    CONSTANTS.into_iter().chain(of_shaders)
}

impl Constant {
    /// Its value in `scene`; `None` where the scene does not use it.
    ///
    /// # Errors
    /// [`ShaderError::NoNumber`] where its file no longer has it.
    pub fn of(&self, scene: &Scene) -> Result<Option<f64>, ShaderError> {
        match self.place {
            Place::Scene(value) => Ok(scene
                .physical
                .and_then(|mut physical| *value(&mut physical))),
            Place::Shader(feature) if scene.models(feature) => {
                Library::embedded().number(self.file, self.key).map(Some)
            }
            Place::Shader(_) => Ok(None),
        }
    }

    /// A copy of `scene` and shaders of which one has `times` its value.
    ///
    /// # Errors
    /// [`ShaderError::NoNumber`] where its file no longer has it.
    pub fn times(&self, scene: &Scene, times: f64) -> Result<(Scene, Library), ShaderError> {
        let mut scene = scene.clone();
        let library = Library::embedded();
        match self.place {
            Place::Scene(value) => {
                if let Some(value) = scene.physical.as_mut().map(value)
                    && let Some(value) = value
                {
                    *value *= times;
                }
                Ok((scene, library))
            }
            Place::Shader(_) => {
                let library = library.with_number_times(self.file, self.key, times)?;
                Ok((scene, library))
            }
        }
    }
}

impl<'de> Deserialize<'de> for Constant {
    /// Reads a constant by its key and file.
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Key {
            key: String,
            file: String,
        }
        let Key { key, file } = Key::deserialize(from)?;
        let known = all().find(|it| it.key == key && it.file == file);
        known.ok_or_else(|| D::Error::custom(format!("{file} has no constant {key:?}")))
    }
}

/// Result of a scene with a constant changed, in the scene or in a shader.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Change {
    /// The constant; `None` where none is changed.
    pub constant: Option<Constant>,
    /// Its value where none is changed.
    pub value: f64,
    /// Factor of that value.
    pub times: f64,
    /// Results of several seeds.
    pub seeds: Seeds,
}

/// The table of medians, each scene in a block.
pub fn describe(changes: &[Change]) -> String {
    let mut t = format!(
        "\n{:<18} {:>7} {:>9}  {:>9} {:>9} {:>9} {:>9}  scene; unit, source (file)\n",
        "constant", "times", "value", "thrown g", "steam g", "hot K", "end °C"
    );
    for change in changes {
        let key = change.constant.map_or("all as they are", |c| c.key);
        let source = change.constant.map_or_else(String::new, |c| {
            format!("; {}, {} ({})", c.unit, c.source, c.file)
        });
        let median = |of: &super::boil::Quartiles| of.0[1];
        let seeds = &change.seeds;
        t += &format!(
            "{key:<18} {:>7.2} {:>9.3e}  {:>9.3} {:>9.3} {:>9.1} {:>9.1}  {}{source}\n",
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
    use vitriol_shaders::ALL;

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
            let Some(value) = constant.of(&scene).unwrap() else {
                assert!(fields[constant.key].is_null(), "{}", constant.key);
                continue;
            };
            let (doubled, _) = constant.times(&scene, 2.0).unwrap();
            assert_eq!(constant.of(&doubled), Ok(Some(2.0 * value)));
            // And nothing else.
            let (halved, _) = constant.times(&doubled, 0.5).unwrap();
            assert_eq!(halved.physical, scene.physical);
        }
    }

    /// The file has the constant once, a pass of the solver includes it, and halved or doubled it changes that line alone and is valid.
    #[test]
    fn a_constant_of_a_shader_is_changed_at_its_place_only() {
        let scene = Scene::builtin("water-into-acid").unwrap();
        let embedded = Library::embedded();
        let solver = ALL.iter().filter(|id| id.path().starts_with("sim/"));
        let sources: Vec<_> = solver
            .map(|id| (id, embedded.source(id).unwrap()))
            .collect();
        for constant in all().skip(CONSTANTS.len()) {
            let (key, file) = (constant.key, constant.file);
            let value = embedded.number(file, key).unwrap();
            assert_eq!(constant.of(&scene), Ok(Some(value)), "{key}");
            let head = format!("const {key}: f32 = ");
            let (id, before) = sources
                .iter()
                .find(|(_, text)| text.contains(&head))
                .unwrap();
            for times in [0.5, 2.0] {
                let (_, library) = constant.times(&scene, times).unwrap();
                assert_eq!(library.number(file, key), Ok(times * value), "{key}");
                let after = library.source(id).unwrap();
                assert_eq!(after.lines().count(), before.lines().count(), "{key}");
                let lines = before.lines().zip(after.lines());
                let changed: Vec<_> = lines.filter(|(old, new)| old != new).collect();
                assert_eq!(changed.len(), 1, "{key}: {changed:?}");
                assert!(changed[0].1.starts_with(&head), "{changed:?}");
            }
        }
    }

    #[test]
    fn a_scene_has_the_constants_of_its_features() {
        let scene = Scene::builtin("water-into-acid").unwrap();
        let (without, _) = scene.without(Feature::Spray);
        let used = |scene: &Scene, key: &str| {
            let constant = all().find(|constant| constant.key == key).unwrap();
            constant.of(scene).unwrap().is_some()
        };
        for (key, after) in [("LEANS", false), ("CONTACT", true), ("lamella", true)] {
            assert_eq!([used(&scene, key), used(&without, key)], [true, after]);
        }
    }

    #[test]
    fn a_row_of_a_shader_is_written_and_read_with_its_file() {
        let constant = all().find(|constant| constant.key == "LEANS").unwrap();
        let written = serde_json::to_string(&constant).unwrap();
        let read: Constant = serde_json::from_str(&written).unwrap();
        assert_eq!(serde_json::to_string(&read).unwrap(), written);
        let other = written.replace("throwing", "venting");
        assert!(serde_json::from_str::<Constant>(&other).is_err());
        let change = Change {
            constant: Some(constant),
            value: 0.2,
            times: 2.0,
            seeds: Seeds::of("acid-into-water".into(), Vec::new()),
        };
        let table = describe(&[change]);
        for part in [
            "LEANS",
            "common/chemistry/throwing.wgsl",
            "chosen",
            "4.000e-1",
        ] {
            assert!(table.contains(part), "{table}");
        }
    }
}
