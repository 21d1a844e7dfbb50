//! A lesson that is named on the command line, to be gone through or judged.

use std::path::Path;

use vitriol_experiment::{Blame, Failure, Judging, Scenes};
use vitriol_lesson::{Lesson, Mode, SceneFacts};

use crate::cli::JudgeArgs;

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
/// [`Failure::Input`] with file, field and what would be right.
pub fn open(name: &str) -> Result<Lesson, Failure> {
    let is_builtin = Lesson::builtin_names().contains(&name);
    let lesson = match is_builtin {
        true => Lesson::builtin(name),
        false => Lesson::open(Path::new(name)),
    };
    let lesson = lesson.input()?;
    let mut scenes = Scenes::default();
    let scene = scenes.open(&lesson.scene)?;
    let facts = SceneFacts::of(&lesson.scene, &scenes.get(&scene)?);
    lesson.check(&facts).input()?;
    Ok(lesson)
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
    if own != scene || scenes.text(&own) != text {
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
