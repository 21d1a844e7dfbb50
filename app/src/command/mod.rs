//! The subcommands, one file each.

mod course;
pub mod doctor;
pub mod export;
pub mod forget;
pub mod grade;
pub mod hub;
mod keeping;
mod lesson;
pub mod pages;
pub mod picture;
mod plan;
mod recorded;
pub mod replay;
pub mod scenes;
pub mod track;
pub mod vr;

use std::path::Path;

use vitriol_experiment::{Failure, Format, interrupt, prepare};

use crate::cli::{Cli, Command};

/// Runs the subcommand that was asked for.
///
/// # Errors
/// What the subcommand fails with; nothing is on standard output then, but for several tracks what of them went well.
pub fn run(cli: &Cli) -> Result<(), Failure> {
    if matches!(
        cli.command,
        Command::Replay(_) | Command::Grade(_) | Command::Export(_) | Command::Picture(_)
    ) {
        stop_when_asked();
    }
    let format = if cli.json { Format::Json } else { Format::Text };
    match &cli.command {
        Command::Replay(args) => replay::run(args, format, prepare),
        Command::Grade(args) => grade::run(args, format, prepare),
        Command::Export(args) => export::run(args, format),
        Command::Picture(args) => picture::run(args, format, prepare),
        Command::Track(args) => track::run(args, format),
        Command::Scenes(args) => scenes::run(args, format),
        Command::Vr(args) => vr::run(args, format),
        Command::Hub(args) => hub::run(args, format),
        Command::Study(command) => vitriol_study::command::run(command, format),
        Command::Lesson(args) => lesson::run(args, format, prepare),
        Command::Forget(args) => forget::run(args, format),
        Command::Doctor => doctor::run(format),
        Command::Pages(args) => pages::run(args, format),
    }
}

/// A track's or run's name without folder and ending, for the output folder's name.
fn stem(track: &str) -> String {
    let stem = Path::new(track).file_stem();
    stem.map_or_else(|| "run".into(), |stem| stem.to_string_lossy().into_owned())
}

/// Ctrl-C, or being terminated, ends a run after its step, so that it can take away what it began; a second time it ends the
/// program.
fn stop_when_asked() {
    let set = ctrlc::set_handler(|| {
        if interrupt::ask() {
            std::process::exit(130);
        }
    });
    if let Err(error) = set {
        tracing::debug!("Ctrl-C ends the program at once: {error}");
    }
}
