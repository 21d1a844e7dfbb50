//! A lesson that is named on the command line, to be gone through or judged.

use std::path::Path;

use serde::{Deserialize, Serialize};
use vitriol_lesson::procedure::Progress;
use vitriol_lesson::{FaultTexts, Language, Lesson, Mode, SceneFacts};
use vitriol_run::texts::Otherwise;
use vitriol_run::track::{LESSON, LESSON_HASH, MODE};
use vitriol_run::{Blame, Failure, Judging, Scenes};
use vitriol_xr::files::{self, FileError};
use vitriol_xr::track::Track;

use crate::cli::JudgeArgs;
use crate::command::recorded::recorded_progress;

/// Longest lesson's file that is read, bytes: a hundred times the length of a lesson.
const LONGEST: u64 = 1 << 20;

/// The lesson of that name or file, which its scene has all for, and its mode: one that it has, its usual one where none is named. What
/// is wrong with them is said in that language.
///
/// # Errors
/// [`Failure::Input`] where there is no such lesson, it is spoiled, or has no such mode.
pub fn named(
    name: &str,
    mode: Option<Mode>,
    language: Language,
) -> Result<(Lesson, Mode), Failure> {
    let lesson = open(name, language)?;
    let mode = mode.unwrap_or(lesson.default_mode());
    if !lesson.modes.contains(&mode) {
        let modes: Vec<_> = lesson.modes.iter().map(|mode| mode.name()).collect();
        let problem = FaultTexts::of(language).other()?.mode.fill(&[
            ("mode", mode.name()),
            ("name", name),
            ("known", &modes.join(", ")),
        ]);
        return Err(problem).input();
    }
    Ok((lesson, mode))
}

/// The lesson of that name or file, which its scene has all for.
///
/// # Errors
/// [`Failure::Input`] with each fault, in that language: file, line, field and what would be right.
pub fn open(name: &str, language: Language) -> Result<Lesson, Failure> {
    if !Lesson::builtin_names().contains(&name) && files::is_absent(Path::new(name)) {
        let texts = FaultTexts::of(language).other()?;
        let file = format!("{name}.toml");
        let quoted = format!("{name:?}");
        let problem = match files::is_absent(Path::new(&file)) {
            true => {
                let meant = suggested(name, &texts);
                (texts.no_file).fill(&[("name", &quoted), ("meant", &meant)])
            }
            false => (texts.other_file).fill(&[("name", &quoted), ("file", &file)]),
        };
        return Err(problem).input();
    }
    let read;
    let text = match Lesson::builtin_text(name) {
        Some(text) => text,
        None => {
            let opened = files::read_text(Path::new(name), "lesson", LONGEST);
            read = match opened {
                Ok(text) => text,
                Err(error) => {
                    let texts = FaultTexts::of(language).other()?;
                    return Err(unopened(name, &error, &texts)).input();
                }
            };
            read.as_str()
        }
    };
    // A scene that cannot be read is one of the lesson's faults, beside the others.
    Lesson::parse_for(text, (name, language), |scene| {
        let facts = facts(scene).map_err(|failure| failure.to_string())?;
        Ok(Some(facts))
    })
    .input()
}

/// Why a lesson's file cannot be read, in these texts.
fn unopened(name: &str, error: &FileError, texts: &FaultTexts) -> String {
    match error {
        FileError::NotAFile { .. } => texts.folder.fill(&[("name", name)]),
        FileError::TooLong { limit, .. } => {
            (texts.too_long).fill(&[("name", name), ("most", &limit.to_string())])
        }
        FileError::NotText { .. } => texts.encoding.fill(&[("name", name)]),
        FileError::Io { source, .. } => {
            (texts.unopened).fill(&[("name", name), ("why", &source.to_string())])
        }
        other => (texts.unopened).fill(&[("name", name), ("why", &other.to_string())]),
    }
}

/// As [`files::suggested`], for a lesson and in these texts.
pub fn suggested(name: &str, texts: &FaultTexts) -> String {
    let builtin = Lesson::builtin_names();
    let all = texts.builtin.fill(&[("known", &builtin.join(", "))]);
    match files::alike(name, &builtin) {
        Some(it) => texts.alike.fill(&[("name", it), ("all", &all)]),
        None => all,
    }
}

/// What the scene of that name or file has.
fn facts(scene: &str) -> Result<SceneFacts, Failure> {
    let mut scenes = Scenes::default();
    let opened = scenes.open(scene)?;
    Ok(SceneFacts::of(scene, &scenes.get(&opened)?))
}

impl JudgeArgs {
    /// The lesson that is asked for, if one is. What is wrong with it is said in that language.
    ///
    /// # Errors
    /// [`Failure::Input`] where there is no such lesson, it is spoiled, or has no such mode.
    pub fn chosen(&self, language: Language) -> Result<Option<(Lesson, Mode)>, Failure> {
        let lesson = self.lesson.as_deref();
        lesson
            .map(|name| named(name, self.mode, language))
            .transpose()
    }
}

/// A judge of that lesson over a run that begins with the scene of that name and text. An error is in that language.
///
/// # Errors
/// [`Failure::Input`] where the lesson is of another scene.
pub fn judging(
    (lesson, mode): (&Lesson, Mode),
    (scene, text): (&str, Option<&str>),
    language: Language,
) -> Result<Judging, Failure> {
    let mut scenes = Scenes::default();
    let own = scenes.open(&lesson.scene)?;
    if own != scene || scenes.text(&own).as_deref() != text {
        let problem = FaultTexts::of(language).other()?.other_scene.fill(&[
            ("name", &lesson.name),
            ("own", &lesson.scene),
            ("scene", scene),
        ]);
        return Err(problem).input();
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

    /// In what the track was made otherwise; `None` where it went through this lesson in this mode.
    pub fn otherwise(&self, track: &Track) -> Option<Otherwise> {
        let made = |key: &str| track.metadata.parameters.get(key).map(String::as_str);
        let Some(name) = made(LESSON) else {
            return Some(Otherwise::NoLesson);
        };
        if name != self.name {
            return Some(Otherwise::Lesson(name.to_owned()));
        }
        if made(LESSON_HASH) != Some(&self.hash) {
            return Some(Otherwise::LessonText(name.to_owned()));
        }
        let mode = made(MODE).unwrap_or_default();
        if mode != self.mode.name() {
            return Some(Otherwise::Mode(mode.to_owned()));
        }
        // What it says is to be of that as well.
        let other = |it: &Progress| match it {
            Progress::Begun { lesson, mode, .. } => (lesson, *mode) != (&self.name, self.mode),
            _ => false,
        };
        let other = recorded_progress(track).iter().any(other);
        other.then_some(Otherwise::Progress)
    }
}
