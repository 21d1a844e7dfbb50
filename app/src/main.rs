//! The program `vitriol`: reads the command line, runs the subcommand, turns a
//! failure into one message and an exit code.

use std::io::IsTerminal;
use std::process::ExitCode;

use clap::Parser;
use tracing::level_filters::LevelFilter;
use vitriol::cli::Cli;
use vitriol_experiment::escaped;

fn main() -> ExitCode {
    let cli = Cli::parse();
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .with_target(false)
        .with_max_level(match cli.verbose {
            0 => LevelFilter::WARN,
            1 => LevelFilter::INFO,
            _ => LevelFilter::DEBUG,
        })
        .init();
    match vitriol::command::run(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // Not through the log: whoever silences that still has to learn why
            // it failed.
            eprintln!("vitriol: {}", escaped(&failure.to_string()));
            ExitCode::from(failure.exit_code())
        }
    }
}
