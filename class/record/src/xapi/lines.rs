//! Statements as a file: JSON, one a line.

use std::io::{self, Write};

use super::Statement;

/// The file's name in a folder of results.
pub const FILE: &str = "statements.jsonl";

/// Writes each statement on a line of its own.
///
/// # Errors
/// An I/O error of `to`.
pub fn write_lines(to: &mut impl Write, statements: &[Statement]) -> io::Result<()> {
    for statement in statements {
        serde_json::to_writer(&mut *to, statement)?;
        to.write_all(b"\n")?;
    }
    to.flush()
}
