//! Standard output: human text, or exactly one JSON object.

use std::io::{self, Write};

use serde::Serialize;

use crate::failure::{Blame, Failure};

/// How a command hands over its result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Text for people.
    Text,
    /// One JSON object and nothing else.
    Json,
}

/// Writes a command's result to standard output, in full, once: `text` for
/// people or `object` as JSON.
///
/// # Errors
/// [`Failure::Other`] where the output cannot be written. A reader that has
/// closed the pipe early (`| head`) is no error.
pub fn emit<T: Serialize>(
    format: Format,
    object: &T,
    text: impl FnOnce(&T) -> String,
) -> Result<(), Failure> {
    let mut out = match format {
        Format::Text => text(object),
        Format::Json => serde_json::to_string_pretty(object).other()?,
    };
    if !out.ends_with('\n') {
        out.push('\n');
    }
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(out.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error).other(),
        _ => Ok(()),
    }
}
