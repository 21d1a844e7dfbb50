//! Other programs that read what is exported: PyVista, Rerun, Arrow and JSON schema's validator, for Python, and
//! Khronos's validator of glTF, for Node. `./lab setup` installs them.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::installed;

/// Where they are.
#[derive(Debug)]
pub struct Readers {
    root: PathBuf,
}

impl Readers {
    /// Those of this machine; `None` without, with a loud word on standard error. With `CI=true` that is a failure
    /// instead.
    ///
    /// # Panics
    /// Where there are none and `CI=true`.
    #[must_use]
    pub fn find(test: &str) -> Option<Self> {
        let root = installed::find("readers-1", "PyVista, Rerun and glTF's validator are", test)?;
        Some(Self { root })
    }

    /// What a script for Python prints.
    ///
    /// # Panics
    /// Where it fails.
    #[must_use]
    pub fn python(&self, script: &Path, arguments: &[&str]) -> String {
        let mut command = Command::new(self.root.join("bin/python"));
        command.arg(script).args(arguments);
        // What it asks the network for is nothing that these tests need.
        command.env("RERUN_ANALYTICS", "off");
        output(command)
    }

    /// What a script for Node prints; its first argument is the folder of the modules.
    ///
    /// # Panics
    /// Where it fails.
    #[must_use]
    pub fn node(&self, script: &Path, arguments: &[&str]) -> String {
        let mut command = Command::new(self.root.join("node"));
        command.arg(script).arg(&self.root).args(arguments);
        output(command)
    }
}

fn output(mut command: Command) -> String {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}
