//! The subcommands, one file each.

mod course;
#[cfg(feature = "session")]
pub mod desk;
pub mod doctor;
#[cfg(feature = "export")]
pub mod export;
#[cfg(feature = "class")]
pub mod forget;
#[cfg(feature = "class")]
pub mod grade;
#[cfg(feature = "class")]
pub mod hub;
#[cfg(feature = "class")]
mod keeping;
mod lesson;
pub mod pages;
pub mod picture;
mod plan;
mod recorded;
pub mod replay;
pub mod scenes;
#[cfg(feature = "session")]
mod session;
pub mod track;
#[cfg(feature = "session")]
pub mod vr;

use std::path::Path;

use vitriol_run::{Failure, Format, interrupt, prepare};

use crate::cli::{Cli, Command};

/// Runs the subcommand that was asked for.
///
/// # Errors
/// What the subcommand fails with; nothing is on standard output then, but for several tracks what of them went well.
pub fn run(cli: &Cli) -> Result<(), Failure> {
    // Both ask the loader, and say themselves what is wrong. There is no other thread yet.
    #[cfg(feature = "vr")]
    if matches!(cli.command, Command::Vr(_) | Command::Doctor) {
        vitriol_xr::quiet_loader();
    }
    if simulates(&cli.command) {
        stop_when_asked();
    }
    let format = if cli.json { Format::Json } else { Format::Text };
    match &cli.command {
        Command::Replay(args) => replay::run(args, format, prepare),
        #[cfg(feature = "class")]
        Command::Grade(args) => grade::run(args, format, prepare),
        #[cfg(feature = "export")]
        Command::Export(args) => export::run(args, format),
        Command::Picture(args) => picture::run(args, format, prepare),
        Command::Track(args) => track::run(args, format),
        Command::Scenes(args) => scenes::run(args, format),
        #[cfg(feature = "session")]
        Command::Desk(args) => desk::run(args, format),
        #[cfg(feature = "session")]
        Command::Vr(args) => vr::run(args, format),
        #[cfg(feature = "class")]
        Command::Hub(args) => hub::run(args, format),
        #[cfg(feature = "study")]
        Command::Study(command) => vitriol_study::command::run(command, format),
        Command::Lesson(args) => lesson::run(args, format, prepare),
        #[cfg(feature = "class")]
        Command::Forget(args) => forget::run(args, format),
        Command::Doctor => doctor::run(format),
        Command::Pages(args) => pages::run(args, format),
    }
}

/// Whether it simulates a track, and takes away what it began when it is stopped.
fn simulates(command: &Command) -> bool {
    match command {
        Command::Replay(_) | Command::Picture(_) => true,
        #[cfg(feature = "class")]
        Command::Grade(_) => true,
        #[cfg(feature = "export")]
        Command::Export(_) => true,
        _ => false,
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
