//! Standard output: human text, or exactly one JSON object.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;

use crate::failure::{Blame, Failure};
use crate::output::unwritten;

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
        Format::Text => escaped(&text(object)),
        Format::Json => json_escaped(&serde_json::to_string_pretty(object).other()?),
    };
    if !out.ends_with('\n') {
        out.push('\n');
    }
    let mut stdout = io::stdout().lock();
    let written = stdout.write_all(out.as_bytes());
    printed(written.and_then(|()| stdout.flush()))
}

/// What came of writing to standard output.
///
/// # Errors
/// As for [`emit`].
pub fn printed(written: io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(unwritten(Path::new("standard output"))(error))
        }
        _ => Ok(()),
    }
}

/// A program's final error, message and exit code, as a line of JSON.
pub fn error_line(message: &str, exit_code: u8) -> String {
    let line = serde_json::json!({ "error": message, "exit_code": exit_code });
    json_escaped(&line.to_string())
}

/// Text that a terminal only shows: what may come from a file's metadata could else move the cursor, rename the
/// window or turn the direction of writing. Line breaks and tabs stay.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if steers(c) {
            out.extend(c.escape_unicode());
        } else {
            out.push(c);
        }
    }
    out
}

/// Such a text in a line of its own: with line breaks it could pass for lines of this program.
pub fn in_a_line(text: &str) -> String {
    escaped(text).replace('\n', "\\n")
}

/// JSON with what steers a terminal written as numbers; it stands in strings only.
pub(crate) fn json_escaped(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    for c in json.chars() {
        if steers(c) {
            // All of these have 16 bits.
            out += &format!("\\u{:04x}", u32::from(c));
        } else {
            out.push(c);
        }
    }
    out
}

/// Controls, other line ends, and marks and overrides of direction.
fn steers(c: char) -> bool {
    let turns = matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    (c.is_control() && !matches!(c, '\n' | '\t')) || turns
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_shown() {
        assert_eq!(escaped("a\tµ\n"), "a\tµ\n");
        assert_eq!(
            escaped("\u{1b}[2J\r\u{9b}\u{7f}"),
            r"\u{1b}[2J\u{d}\u{9b}\u{7f}"
        );
        assert_eq!(escaped("x\u{202e}y"), r"x\u{202e}y");
        assert_eq!(in_a_line("x\ny\u{2028}"), r"x\ny\u{2028}");
        let text = "\u{1b}\u{9b}\u{202e}\n\"\u{7f}é";
        let json = json_escaped(&serde_json::to_string(text).unwrap());
        assert!(json.is_ascii() || json.contains('é'), "{json}");
        assert!(!json.chars().any(steers), "{json}");
        assert_eq!(serde_json::from_str::<String>(&json).unwrap(), text);
    }
}
