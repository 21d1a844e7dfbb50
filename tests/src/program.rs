//! A program run from outside, in a folder.

use std::path::Path;
use std::process::{Command, Output};

/// The program at a path, which a test knows as `env!("CARGO_BIN_EXE_name")`.
#[derive(Debug, Clone, Copy)]
pub struct Program(pub &'static str);

impl Program {
    /// Runs it with these arguments; returns its exit status and output.
    ///
    /// # Panics
    /// Where it cannot be started.
    #[must_use]
    pub fn run(self, folder: &Path, arguments: &[&str]) -> Output {
        let mut command = Command::new(self.0);
        command.args(arguments).current_dir(folder);
        command.output().unwrap()
    }

    /// Its standard output with `--json` as its last argument.
    ///
    /// # Panics
    /// Where it fails, or the output is no text.
    #[must_use]
    pub fn json(self, folder: &Path, arguments: &[&str]) -> String {
        let output = self.run(folder, &[arguments, &["--json"]].concat());
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{arguments:?}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    }
}

/// The words of a line, as a shell without quotes takes them.
#[must_use]
pub fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}
