//! The program `vitriol`: reads the command line, runs the subcommand, turns a
//! failure into one message and an exit code.

use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use clap::Parser;
use tracing::level_filters::LevelFilter;
use vitriol::cli::{Cli, left_out};
use vitriol_run::{error_line, escaped};

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return refused(&error),
    };
    let log = tracing_subscriber::fmt()
        // What a reader that has gone leaves unwritten is nothing to say.
        .log_internal_errors(false)
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
            let said = if cli.json {
                error_line(&failure.to_string(), failure.exit_code())
            } else {
                format!("vitriol: {}", escaped(&failure.to_string()))
            };
            // A reader that has gone is no second failure.
            let _ = writeln!(std::io::stderr(), "{said}");
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

/// What the command line asks for is not there, or is help.
fn refused(error: &clap::Error) -> ExitCode {
    let code = u8::try_from(error.exit_code()).unwrap_or(2);
    let given: Vec<String> = std::env::args_os()
        .map(|word| word.to_string_lossy().into_owned())
        .collect();
    let json = given.iter().any(|word| word == "--json");
    if let Some(text) = left_out::answer(error, &given) {
        let said = match json {
            true => error_line(&text, 2),
            false => format!("vitriol: {}", escaped(&text)),
        };
        let _ = writeln!(std::io::stderr(), "{said}");
        return ExitCode::from(2);
    }
    if json && error.use_stderr() {
        let text = error.to_string();
        let _ = writeln!(std::io::stderr(), "{}", error_line(text.trim_end(), code));
    } else {
        let _ = error.print();
    }
    ExitCode::from(code)
}
