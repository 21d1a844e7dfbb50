//! A program run from outside, in a folder.

use std::ops::{Deref, DerefMut};
use std::path::Path;
use std::process::{Child, Command, Output};

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
        self.command(folder, arguments).output().unwrap()
    }

    /// Its standard output with `--json` as its last argument.
    ///
    /// # Panics
    /// Where it fails, or the output is no text.
    #[must_use]
    pub fn json(self, folder: &Path, arguments: &[&str]) -> String {
        output(self.command(folder, &[arguments, &["--json"]].concat()))
    }

    fn command(self, folder: &Path, arguments: &[&str]) -> Command {
        let mut command = Command::new(self.0);
        command.args(arguments).current_dir(folder);
        command
    }
}

/// Standard output of a command that has to succeed.
pub(crate) fn output(mut command: Command) -> String {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// A program at work, which does not outlive the test.
#[derive(Debug)]
pub struct Kept(pub Child);

impl Deref for Kept {
    type Target = Child;

    fn deref(&self) -> &Child {
        &self.0
    }
}

impl DerefMut for Kept {
    fn deref_mut(&mut self) -> &mut Child {
        &mut self.0
    }
}

impl Drop for Kept {
    fn drop(&mut self) {
        // It fails if the program has ended by itself, which is fine.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// The words of a line, as a shell without quotes takes them.
#[must_use]
pub fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}
