//! Other programs that read what is exported: PyVista, meshio, Rerun, Arrow and JSON schema's validator, for Python, and
//! Khronos's validator of glTF, for Node. `./lab setup` installs them.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::installed;
use crate::program::output;

/// Paths of the readers.
#[derive(Debug)]
pub struct Readers {
    root: PathBuf,
}

impl Readers {
    /// The readers on this machine; `None` if they are missing, with a message on standard error. With `CI=true` that is a failure
    /// instead.
    ///
    /// # Panics
    /// Where there are none and `CI=true`.
    #[must_use]
    pub fn find(test: &str) -> Option<Self> {
        let root = installed::find(
            "readers-2",
            "PyVista, meshio, Rerun and glTF's validator are",
            test,
        )?;
        Some(Self { root })
    }

    /// Standard output of a script for Python.
    ///
    /// # Panics
    /// Where it fails.
    #[must_use]
    pub fn python(&self, script: &Path, arguments: &[&str]) -> String {
        let mut command = Command::new(self.root.join("bin/python"));
        command.arg(script).args(arguments);
        // These tests need nothing that it requests of the network.
        command.env("RERUN_ANALYTICS", "off");
        output(command)
    }

    /// Standard output of a script for Node; its first argument is the folder of the modules.
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
