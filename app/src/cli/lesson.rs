//! Arguments of what lessons are asked for by: to show one, to make its film, to judge by it.

use std::path::PathBuf;

use clap::error::{ContextKind, ContextValue};
use clap::{Args, Subcommand};
use vitriol_lesson::{Language, Mode};
use vitriol_run::arguments::{file_of, preset};
use vitriol_sim::scene::Preset;

/// Arguments of `vitriol lesson`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, disable_help_subcommand = true)]
pub struct LessonArgs {
    /// What to do in place of showing lessons.
    #[command(subcommand)]
    pub command: Option<LessonCommand>,
    /// A built-in lesson's name or a TOML file, which is checked and shown; all its faults are said, each with its line. Without it all
    /// built-in ones are listed
    #[arg(value_name = "LESSON")]
    pub lesson: Option<String>,
    /// Language of its texts and of its faults: en, de, es or zh
    #[arg(long, value_name = "LANGUAGE", default_value_t)]
    pub language: Language,
    /// Print the file of a built-in lesson as it is; `vitriol lesson new` writes one to begin an own lesson with
    #[arg(long, requires = "lesson")]
    pub toml: bool,
    /// Make a film of the lesson as a track goes through it, with subtitles in each of its languages: this new MP4 file
    #[arg(
        long,
        value_name = "FILE",
        value_parser = file_of("mp4"),
        requires = "lesson",
        conflicts_with = "toml"
    )]
    pub film: Option<PathBuf>,
    /// The film's track, by name or file; one of another scene is told, and filmed in the lesson's. Without it the built-in one
    /// that is made for the lesson's scene
    #[arg(long, value_name = "TRACK", requires = "film")]
    pub track: Option<String>,
    /// The film's trade of speed for accuracy
    #[arg(long, value_parser = preset(), requires = "film")]
    pub preset: Option<Preset>,
    /// Number, or part of the name, of the Vulkan device that the film is made on
    #[arg(long, value_name = "DEVICE", requires = "film")]
    pub device: Option<String>,
}

/// What `vitriol lesson` does besides showing lessons.
#[derive(Debug, Subcommand)]
pub enum LessonCommand {
    /// Write the file of a new lesson, with texts in one language and each key explained; no file is overwritten
    New(NewLessonArgs),
    /// Check a lesson and show it, as without the word `check`
    Check(CheckLessonArgs),
}

/// Arguments of `vitriol lesson check`.
#[derive(Debug, Args)]
pub struct CheckLessonArgs {
    /// A TOML file or a built-in lesson's name
    #[arg(value_name = "LESSON")]
    pub lesson: String,
    /// Language of its texts and of its faults: en, de, es or zh
    #[arg(long, value_name = "LANGUAGE", default_value_t)]
    pub language: Language,
}

/// Arguments of `vitriol lesson new`.
#[derive(Debug, Args)]
pub struct NewLessonArgs {
    /// Its name, of a to z, 0 to 9 and -, also with .toml behind it; the file NAME.toml is written here
    #[arg(value_name = "NAME")]
    pub name: String,
    /// The built-in lesson that it begins as (see `vitriol lesson`)
    #[arg(long, value_name = "LESSON", default_value = "dilute")]
    pub from: String,
    /// Language of its texts, and of what is wrong with the name: en, de, es or zh; a lesson needs no other one
    #[arg(long, value_name = "LANGUAGE", default_value_t)]
    pub language: Language,
}

/// What to say in place of `error` where the command line `given` has a word before a lesson that is no subcommand. clap takes the word
/// for the lesson then, and the lesson for a subcommand.
pub fn no_subcommand(error: &clap::Error, given: &[String]) -> Option<String> {
    let said = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word),
        _ => None,
    };
    let refused = said(ContextKind::InvalidSubcommand).or_else(|| said(ContextKind::InvalidArg))?;
    let word = given.windows(3).find_map(|words| match words {
        [command, word, lesson] if command == "lesson" && lesson == refused => Some(word.as_str()),
        _ => None,
    })?;
    let is_option = |it: &str| it.starts_with('-');
    if ["check", "new"].contains(&word) || is_option(word) || is_option(refused) {
        return None;
    }
    Some(format!(
        "`vitriol lesson` has no subcommand `{word}`, and shows one lesson at a time: `vitriol lesson check LESSON` checks one, \
         `vitriol lesson new NAME` writes a new one"
    ))
}

/// A lesson that is judged.
#[derive(Args, Clone, Debug, Default)]
pub struct JudgeArgs {
    /// Judge this lesson, of that scene: a built-in one's name (see `vitriol lesson`) or a TOML file
    #[arg(long, value_name = "LESSON")]
    pub lesson: Option<String>,
    /// As it is gone through: guided, free or examination; without it as the lesson says
    #[arg(long, value_name = "MODE", requires = "lesson")]
    pub mode: Option<Mode>,
}
