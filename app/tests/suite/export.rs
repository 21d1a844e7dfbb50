//! What `vitriol export` writes, and what it refuses.

mod formats;
mod refused;
mod runs;
mod times;

use std::path::Path;
use std::process::Output;

use crate::VITRIOL;
use serde_json::Value;
use vitriol_tests::program::words;

/// The program's end with the words of a line as arguments.
fn run(folder: &Path, line: &str) -> Output {
    VITRIOL.run(folder, &words(line))
}

/// The object that it prints.
fn object(folder: &Path, line: &str) -> Value {
    serde_json::from_str(&VITRIOL.json(folder, &words(line))).unwrap()
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}
