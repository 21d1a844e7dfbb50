//! A lesson that is named on the command line, to be gone through or judged.

use std::path::Path;

use serde::{Deserialize, Serialize};
use vitriol_lesson::procedure::Progress;
use vitriol_lesson::{Lesson, Mode, SceneFacts};
use vitriol_run::track::{LESSON, LESSON_HASH, MODE};
use vitriol_run::{Blame, Failure, Judging, Scenes, in_a_line};
use vitriol_xr::files;
use vitriol_xr::track::Track;

use crate::cli::JudgeArgs;
use crate::command::recorded::recorded_progress;

/// Longest lesson's file that is read, bytes: a hundred times the length of a lesson.
const LONGEST: u64 = 1 << 20;

/// The lesson of that name or file, which its scene has all for, and its mode: one that it has, its usual one where none is named.
///
/// # Errors
/// [`Failure::Input`] where there is no such lesson, it is spoiled, or has no such mode.
pub fn named(name: &str, mode: Option<Mode>) -> Result<(Lesson, Mode), Failure> {
    let lesson = open(name)?;
    let mode = mode.unwrap_or(lesson.default_mode());
    if !lesson.modes.contains(&mode) {
        let modes: Vec<_> = lesson.modes.iter().map(|mode| mode.name()).collect();
        let modes = modes.join(", ");
        return Err(format!("--mode {mode}: {name} has {modes}")).input();
    }
    Ok((lesson, mode))
}

/// The lesson of that name or file, which its scene has all for.
///
/// # Errors
/// [`Failure::Input`] with each fault: file, line, field and what would be right.
pub fn open(name: &str) -> Result<Lesson, Failure> {
    let builtin = Lesson::builtin_names();
    if !builtin.contains(&name) && files::is_absent(Path::new(name)) {
        let file = format!("{name}.toml");
        let meant = match files::is_absent(Path::new(&file)) {
            true => format!("{}; or give a path", files::suggested(name, &builtin)),
            false => format!("did you mean {file}?"),
        };
        return Err(format!("lesson {name:?}: no such file; {meant}")).input();
    }
    let read;
    let text = match Lesson::builtin_text(name) {
        Some(text) => text,
        None => {
            read = files::read_text(Path::new(name), "lesson", LONGEST).input()?;
            read.as_str()
        }
    };
    // A scene that cannot be read is one of the lesson's faults, beside the others.
    Lesson::parse_for(text, name, |scene| {
        let facts = facts(scene).map_err(|failure| failure.to_string())?;
        Ok(Some(facts))
    })
    .input()
}

/// What the scene of that name or file has.
fn facts(scene: &str) -> Result<SceneFacts, Failure> {
    let mut scenes = Scenes::default();
    let opened = scenes.open(scene)?;
    Ok(SceneFacts::of(scene, &scenes.get(&opened)?))
}

impl JudgeArgs {
    /// The lesson that is asked for, if one is.
    ///
    /// # Errors
    /// [`Failure::Input`] where there is no such lesson, it is spoiled, or has no such mode.
    pub fn chosen(&self) -> Result<Option<(Lesson, Mode)>, Failure> {
        let lesson = self.lesson.as_deref();
        lesson.map(|name| named(name, self.mode)).transpose()
    }
}

/// A judge of that lesson over a run that begins with the scene of that name and text.
///
/// # Errors
/// [`Failure::Input`] where the lesson is of another scene.
pub fn judging(
    (lesson, mode): (&Lesson, Mode),
    (scene, text): (&str, Option<&str>),
) -> Result<Judging, Failure> {
    let mut scenes = Scenes::default();
    let own = scenes.open(&lesson.scene)?;
    if own != scene || scenes.text(&own).as_deref() != text {
        let of = &lesson.scene;
        return Err(format!(
            "--lesson {}: it is of the scene {of}, and what is judged begins with {scene}, or with another text of that: take \
             --scene {of}, or a lesson of that scene",
            lesson.name
        ))
        .input();
    }
    Ok(Judging::new(lesson.clone(), mode, scene))
}

/// The lesson that is asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AskedLesson {
    /// Its name.
    pub name: String,
    /// Hash of its text.
    pub hash: String,
    /// How it was to be gone through.
    pub mode: Mode,
}

impl AskedLesson {
    /// That of a lesson.
    pub fn of(lesson: &Lesson, mode: Mode) -> Self {
        Self {
            name: lesson.name.clone(),
            hash: lesson.hash().to_owned(),
            mode,
        }
    }

    /// In what the track was made otherwise, in a few words; `None` where it went through this lesson in this mode.
    pub fn otherwise(&self, track: &Track) -> Option<String> {
        let made = |key: &str| track.metadata.parameters.get(key).map(String::as_str);
        let Some(name) = made(LESSON) else {
            return Some("made without a lesson".into());
        };
        let another = || Some(format!("made with another lesson: {}", in_a_line(name)));
        if name != self.name {
            return another();
        }
        if made(LESSON_HASH) != Some(&self.hash) {
            return another().map(|text| text + " of another text");
        }
        let mode = made(MODE).unwrap_or_default();
        if mode != self.mode.name() {
            return Some(format!("made in another mode: {}", in_a_line(mode)));
        }
        // What it says is to be of that as well.
        let other = |it: &Progress| match it {
            Progress::Begun { lesson, mode, .. } => (lesson, *mode) != (&self.name, self.mode),
            _ => false,
        };
        let other = recorded_progress(track).iter().any(other);
        other.then(|| "what it says is of another lesson or mode".into())
    }
}
