//! The subcommands, one file each.

pub mod bench;
pub mod calorimeter;
pub mod dam_break;
pub mod doctor;
pub mod extremes;
pub mod fidelity;
pub mod fig5;
pub mod picture;
mod recorded;
pub mod replay;
pub mod scenes;
pub mod track;
pub mod trade;
pub mod vr;

use crate::cli::{Cli, Command};
use crate::experiment;
use crate::failure::Failure;
use crate::measure;

/// Runs the subcommand that was asked for.
///
/// # Errors
/// What the subcommand fails with; nothing is on standard output then.
pub fn run(cli: &Cli) -> Result<(), Failure> {
    let format = cli.format();
    match &cli.command {
        Command::Replay(args) => replay::run(args, format, experiment::prepare),
        Command::Picture(args) => picture::run(args, format, experiment::prepare),
        Command::Bench(args) => bench::run(args, format, measure::measure),
        Command::Track(args) => track::run(args, format),
        Command::Scenes(args) => scenes::run(args, format),
        Command::Vr(args) => vr::run(args, format),
        Command::Fidelity(args) => fidelity::run(args, format),
        Command::Fig5(args) => fig5::run(args, format),
        Command::DamBreak(args) => dam_break::run(args, format),
        Command::Calorimeter(args) => calorimeter::run(args, format),
        Command::Extremes(args) => extremes::run(args, format),
        Command::Trade(args) => trade::run(args, format),
        Command::Doctor => doctor::run(format),
    }
}
