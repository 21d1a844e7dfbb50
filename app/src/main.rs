//! The program `vitriol`: reads the command line, runs the subcommand, turns a
//! failure into one message and an exit code.

use std::io::IsTerminal;
use std::process::ExitCode;

use clap::Parser;
use tracing::level_filters::LevelFilter;
use vitriol::cli::Cli;
use vitriol_experiment::{error_line, escaped};

fn main() -> ExitCode {
    let cli = Cli::parse();
    let log = tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        .with_target(false)
        .with_max_level(match cli.verbose {
            0 => LevelFilter::WARN,
            1 => LevelFilter::INFO,
            _ => LevelFilter::DEBUG,
        });
    if cli.json {
        log.json().with_ansi(false).init();
    } else {
        log.with_ansi(takes_colours()).init();
    }
    match vitriol::command::run(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // Not through the log: whoever silences that still has to learn why
            // it failed.
            if cli.json {
                eprintln!("{}", error_line(&failure));
            } else {
                eprintln!("vitriol: {}", escaped(&failure.to_string()));
            }
            ExitCode::from(failure.exit_code())
        }
    }
}

/// Whether standard error is a terminal that shows colours. A console of Windows does after it is asked to.
fn takes_colours() -> bool {
    #[cfg(windows)]
    let asked = anstyle_query::windows::enable_ansi_colors().unwrap_or(true);
    #[cfg(not(windows))]
    let asked = true;
    asked && std::io::stderr().is_terminal()
}
