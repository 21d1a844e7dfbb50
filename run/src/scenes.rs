//! The scenes that a run may bring up: what the user named, what the track carries, and what comes with the program.
//!
//! A track may come from anyone, so what it names is looked up here and never in the file system.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use vitriol_sim::scene::Scene;
use vitriol_xr::files::{self, FileError};
use vitriol_xr::track::{TrackMetadata, limits};

use crate::failure::{Blame, Failure};

/// Scenes by name, beside the built-in ones, before which they come.
#[derive(Clone, Debug, Default)]
pub struct Scenes {
    own: BTreeMap<String, Arc<Text>>,
}

#[derive(Debug)]
struct Text {
    toml: String,
    /// Where it is from, for messages.
    place: String,
}

impl Scenes {
    /// Takes in what the user named, a built-in scene or a file, and gives back its name: a file's own, without its
    /// folder. It comes before what a track carries under that name.
    ///
    /// # Errors
    /// [`Failure::Input`] where there is neither.
    pub fn open(&mut self, name_or_file: &str) -> Result<String, Failure> {
        let (name, text) = match Scene::builtin_text(name_or_file) {
            Some(toml) => (
                name_or_file.to_owned(),
                Text {
                    toml: toml.to_owned(),
                    place: format!("{name_or_file}.toml"),
                },
            ),
            None => (name_of(name_or_file), read(name_or_file)?),
        };
        self.own.insert(name.clone(), Arc::new(text));
        Ok(name)
    }

    /// Takes in what `track` carries.
    pub fn carry(&mut self, track: &TrackMetadata) {
        for (name, toml) in &track.scenes {
            self.own.entry(name.clone()).or_insert_with(|| {
                Arc::new(Text {
                    toml: toml.clone(),
                    place: format!("the track's scene {name:?}"),
                })
            });
        }
    }

    /// The scene of that name.
    ///
    /// # Errors
    /// [`Failure::Input`] where there is none, or something is wrong with its text.
    pub fn get(&self, name: &str) -> Result<Scene, Failure> {
        match (self.own.get(name), Scene::builtin_text(name)) {
            (Some(text), _) => Scene::parse(&text.toml, &text.place).input(),
            (None, Some(_)) => Scene::builtin(name).input(),
            (None, None) => Err(format!(
                "the track names the scene {name:?}, which it does not carry and the program does not have; name one \
                 with --scene, a file or one of {}",
                Scene::builtin_names().join(", ")
            ))
            .input(),
        }
    }

    /// Names of those that are not looked up among the built-in ones.
    pub fn own(&self) -> impl Iterator<Item = &str> {
        self.own.keys().map(String::as_str)
    }

    /// Text of the scene of that name, which stands alone.
    pub fn text(&self, name: &str) -> Option<Cow<'_, str>> {
        let own = self.own.get(name).map(|text| &*text.toml);
        own.or_else(|| Scene::builtin_text(name))
            .map(Scene::complete)
    }
}

/// The scene that the user named, built in or a file.
///
/// # Errors
/// [`Failure::Input`] where there is neither, or something is wrong with it.
pub fn load(name_or_file: &str) -> Result<Scene, Failure> {
    let mut scenes = Scenes::default();
    let name = scenes.open(name_or_file)?;
    scenes.get(&name)
}

fn name_of(file: &str) -> String {
    let name = Path::new(file).file_name();
    name.map_or_else(
        || file.to_owned(),
        |name| name.to_string_lossy().into_owned(),
    )
}

fn read(file: &str) -> Result<Text, Failure> {
    if files::is_absent(Path::new(file)) {
        return Err(format!(
            "scene {file:?}: no such file; {}; or give a path",
            files::suggested(file, &Scene::builtin_names())
        ))
        .input();
    }
    let read = files::read_text(Path::new(file), "scene", limits::SCENE as u64);
    let toml = read.map_err(|error| match error {
        // Such as a file that this user may not read.
        FileError::Io { .. } => Failure::Other(error.into()),
        _ => Failure::Input(error.into()),
    })?;
    Ok(Text {
        toml,
        place: file.to_owned(),
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn what_a_track_names_is_never_looked_up_among_files() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("secret.toml");
        std::fs::write(&file, Scene::builtin_text("beaker").unwrap()).unwrap();
        let path = file.to_str().unwrap();
        let scenes = Scenes::default();
        for name in [path, "/etc/passwd", "/dev/zero", "secret.toml", "../x"] {
            let message = scenes.get(name).unwrap_err().to_string();
            assert!(message.contains("--scene"), "{message}");
            assert!(scenes.text(name).is_none());
        }
        // The user may.
        let mut scenes = Scenes::default();
        assert_eq!(scenes.open(path).unwrap(), "secret.toml");
        assert_eq!(scenes.get("secret.toml").unwrap().name, "beaker");
    }

    #[test]
    fn the_user_comes_before_the_track_and_the_track_before_the_program() {
        let named = |name: &str| {
            let text = Scene::builtin_text("beaker").unwrap();
            text.replacen("name = \"beaker\"", &format!("name = {name:?}"), 1)
        };
        let track = TrackMetadata {
            scenes: [("beaker".to_owned(), named("carried"))].into(),
            ..TrackMetadata::default()
        };
        let mut scenes = Scenes::default();
        scenes.carry(&track);
        assert_eq!(scenes.get("beaker").unwrap().name, "carried");
        assert_eq!(scenes.get("two-flasks").unwrap().name, "two-flasks");
        scenes.open("beaker").unwrap();
        assert_eq!(scenes.get("beaker").unwrap().name, "beaker");
        scenes.carry(&track);
        assert_eq!(scenes.get("beaker").unwrap().name, "beaker");
    }

    #[test]
    fn what_is_wrong_with_a_carried_scene_is_said() {
        let track = TrackMetadata {
            scenes: [("x".to_owned(), "name = 3".to_owned())].into(),
            ..TrackMetadata::default()
        };
        let mut scenes = Scenes::default();
        scenes.carry(&track);
        let message = scenes.get("x").unwrap_err().to_string();
        assert!(message.contains("the track's scene \"x\""), "{message}");
    }

    #[test]
    fn folders_and_long_files_are_no_scenes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().to_str().unwrap();
        assert!(load(path).unwrap_err().to_string().contains("a folder"));
        let long = folder.path().join("long.toml");
        std::fs::write(&long, "#".repeat(limits::SCENE + 1)).unwrap();
        let message = load(long.to_str().unwrap()).unwrap_err().to_string();
        assert!(message.contains("longer than"), "{message}");
        assert!(load("nowhere").unwrap_err().to_string().contains("beaker"));
        let misspelt = load("watter-into-acid").unwrap_err().to_string();
        assert!(
            misspelt.contains("did you mean water-into-acid?"),
            "{misspelt}"
        );
    }
}
