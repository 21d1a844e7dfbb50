//! A lesson that is named on the command line, to be gone through or judged.

use vitriol_experiment::{Blame, Failure, Judging, Scenes};
use vitriol_lesson::{Lesson, Mode};

use crate::cli::JudgeArgs;
use crate::command::lesson;

/// The lesson of that name or file, which its scene has all for, and its mode: one that it has, its usual one where none is named.
///
/// # Errors
/// [`Failure::Input`] where there is no such lesson, it is spoiled, or has no such mode.
pub fn named(name: &str, mode: Option<Mode>) -> Result<(Lesson, Mode), Failure> {
    let lesson = lesson::open(name)?;
    let mode = mode.unwrap_or(lesson.default_mode());
    if !lesson.modes.contains(&mode) {
        let modes: Vec<_> = lesson.modes.iter().map(|mode| mode.name()).collect();
        let modes = modes.join(", ");
        return Err(format!("--mode {mode}: {name} has {modes}")).input();
    }
    Ok((lesson, mode))
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
