//! The subcommands, one file each.

pub mod bench;
pub mod calorimeter;
pub mod dam_break;
pub mod extremes;
pub mod fidelity;
pub mod fig5;
pub mod trade;

use vitriol_run::{Failure, Format};

use crate::cli::Command;

/// Runs the subcommand that was asked for.
///
/// # Errors
/// The subcommand's error; nothing is on standard output then.
pub fn run(command: &Command, format: Format) -> Result<(), Failure> {
    match command {
        Command::Bench(args) => bench::run(args, format),
        Command::Fidelity(args) => fidelity::run(args, format),
        Command::Fig5(args) => fig5::run(args, format),
        Command::DamBreak(args) => dam_break::run(args, format),
        Command::Calorimeter(args) => calorimeter::run(args, format),
        Command::Extremes(args) => extremes::run(args, format),
        Command::Trade(args) => trade::run(args, format),
    }
}
