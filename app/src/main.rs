//! The program `vitriol`: reads the command line, runs the subcommand, turns a
//! failure into one message and an exit code.

use std::io::{IsTerminal, Write};
use std::process::ExitCode;

use clap::Parser;
use clap::error::{ContextKind, ContextValue};
use tracing::level_filters::LevelFilter;
use vitriol::cli::{Cli, left_out, no_subcommand};
use vitriol_run::{error_line, escaped, printed};

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return refused(&plain(error)),
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
        Err(failure) => failed(&failure.to_string(), failure.exit_code(), cli.json),
    }
}

/// Prints why the command failed. Not through the log: whoever silences that still has to learn it.
fn failed(message: &str, code: u8, json: bool) -> ExitCode {
    let said = match json {
        true => error_line(message, code),
        false => format!("vitriol: {}", escaped(message)),
    };
    // A reader that has gone is no second failure.
    let _ = writeln!(std::io::stderr(), "{said}");
    ExitCode::from(code)
}

/// Whether standard error is a terminal that shows colours. A console of Windows does after it is asked to.
fn takes_colours() -> bool {
    #[cfg(windows)]
    let asked = anstyle_query::windows::enable_ansi_colors().unwrap_or(true);
    #[cfg(not(windows))]
    let asked = true;
    asked && std::io::stderr().is_terminal()
}

/// The error without clap's tip to give an unknown option or subcommand as a track or a file: it is a mistyped one. clap gives tips no
/// kind; this one ends with `-- `, the word and a quote.
fn plain(mut error: clap::Error) -> clap::Error {
    let word = error.get(ContextKind::InvalidArg);
    let advised = match word.or_else(|| error.get(ContextKind::InvalidSubcommand)) {
        Some(ContextValue::String(word)) => format!("-- {word}'"),
        _ => return error,
    };
    if let Some(ContextValue::StyledStrs(mut tips)) = error.remove(ContextKind::Suggested) {
        tips.retain(|tip| !tip.to_string().ends_with(&advised));
        if !tips.is_empty() {
            error.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
        }
    }
    error
}

/// What the command line asks for is not there, or is help.
fn refused(error: &clap::Error) -> ExitCode {
    let code = u8::try_from(error.exit_code()).unwrap_or(2);
    let given: Vec<String> = std::env::args_os()
        .map(|word| word.to_string_lossy().into_owned())
        .collect();
    let json = given.iter().any(|word| word == "--json");
    let text = left_out::answer(error, &given).or_else(|| no_subcommand(error, &given));
    if let Some(text) = text {
        return failed(&text, 2, json);
    }
    if json && error.use_stderr() {
        return failed(error.to_string().trim_end(), code, json);
    }
    let shown = error.print().and_then(|()| std::io::stdout().flush());
    match printed(shown) {
        // Help and version; else the command line is the failure.
        Err(failure) if !error.use_stderr() => {
            failed(&failure.to_string(), failure.exit_code(), json)
        }
        _ => ExitCode::from(code),
    }
}
