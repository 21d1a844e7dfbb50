//! A program run from outside, in a folder.

use std::ops::{Deref, DerefMut};
use std::path::Path;
use std::process::{Child, Command, Output};

use serde_json::Value;

/// The program at a path, which a test knows as `env!("CARGO_BIN_EXE_name")`.
#[derive(Debug, Clone, Copy)]
pub struct Program(pub &'static str);

impl Program {
    /// Runs it with the words of a line as arguments, as [`words`] takes them; returns its exit status and output.
    ///
    /// # Panics
    /// Where it cannot be started.
    #[must_use]
    pub fn run(self, folder: &Path, line: &str) -> Output {
        self.command(folder, line).output().unwrap()
    }

    /// The JSON object that is all of its standard output, with `--json` as its last argument.
    ///
    /// # Panics
    /// Where it fails, or prints anything else.
    pub fn object(self, folder: &Path, line: &str) -> Value {
        let printed = output(self.command(folder, &format!("{line} --json")));
        let value: Value = serde_json::from_str(&printed).unwrap();
        assert!(value.is_object(), "{value}");
        value
    }

    /// It refuses the line as wrong input, in words and in JSON: code 2, a message that has all `parts`, and nothing on standard output.
    ///
    /// # Panics
    /// Where it does not.
    pub fn refuses(self, folder: &Path, line: &str, parts: &[&str]) {
        for line in [line.to_owned(), format!("{line} --json")] {
            let output = self.run(folder, &line);
            let message = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(2), "{line}: {message}");
            assert_eq!(String::from_utf8(output.stdout).unwrap(), "", "{line}");
            for part in parts {
                assert!(message.contains(part), "{line}: {message}");
            }
            for noise in ["panicked", "Error {", "Some(", "source:"] {
                assert!(!message.contains(noise), "{line}: {message}");
            }
        }
    }

    /// The same of each row of a table: a line, `=>`, and what the message says, in parts with `;` between them.
    ///
    /// # Panics
    /// Where one is not refused so.
    pub fn refuses_each(self, folder: &Path, table: &str) {
        for row in table.trim().lines() {
            let (line, parts) = row.split_once("=>").unwrap();
            let parts: Vec<&str> = parts.split(';').map(str::trim).collect();
            self.refuses(folder, line, &parts);
        }
    }

    fn command(self, folder: &Path, line: &str) -> Command {
        let mut command = Command::new(self.0);
        command.args(words(line)).current_dir(folder);
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

/// The name of the test that calls it, as its own runner knows it: the runner names the thread of each test so.
///
/// # Panics
/// On another thread without a name.
#[must_use]
pub fn own_name() -> String {
    let thread = std::thread::current();
    thread.name().unwrap().to_owned()
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
