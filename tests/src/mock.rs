//! The mock OpenXR runtime (`tests/runtime`) in the rig (`tests/src/rig.rs`): a test sets the headset's behaviour, and reads the calls.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

pub use vitriol_mock_runtime::calls::{Call, Depth, Ended, Layer, Part, ProjectionView};
pub use vitriol_mock_runtime::script::{
    Change, Cue, Fov, Goal, HandState, Inset, Joint, Known, Lost, Pose, SpaceKind, TOUCH,
};
use vitriol_mock_runtime::{CALLS, FOLDER, SCRIPT};

use crate::rig;

/// The runtime's library, which Cargo builds with this crate.
const LIBRARY: &str = "libvitriol_mock_runtime.so";

/// A handle to the runtime of this process, and of the processes that it starts.
pub struct Mock {
    folder: PathBuf,
}

/// Runs the test `name` (module path and function, as the test's own runner knows it) in the rig with the mock runtime, which begins with
/// `changes`: returns a handle to it in the process that runs there, and `None` in the one outside, where the test is over then.
///
/// Where there can be no rig, a message goes to standard error and the test is over too.
///
/// # Panics
/// Where the test fails in the rig; where there can be no rig and `CI=true`.
#[must_use]
pub fn enter(name: &str, changes: &[Change]) -> Option<Mock> {
    let folder = rig::enter(name, |folder| prepare(folder, changes), last_calls)?;
    Some(Mock { folder })
}

/// Fills the rig's folder; returns the environment that leads to it.
fn prepare(folder: &Path, changes: &[Change]) -> Vec<(&'static str, PathBuf)> {
    let manifest = folder.join("runtime.json");
    let text = serde_json::json!({
        "file_format_version": "1.0.0",
        "runtime": { "name": "Mock", "library_path": library() },
    });
    std::fs::write(&manifest, text.to_string()).expect("a file in the rig's folder");
    for change in changes {
        say(folder, None, change.clone());
    }
    vec![
        ("XR_RUNTIME_JSON", manifest),
        (FOLDER, folder.to_path_buf()),
    ]
}

/// The end of the log of calls.
fn last_calls(folder: &Path) -> String {
    let text = std::fs::read_to_string(folder.join(CALLS)).unwrap_or_default();
    let lines: Vec<&str> = text.lines().collect();
    let last = &lines[lines.len().saturating_sub(20)..];
    format!("the last calls:\n{}", last.join("\n"))
}

/// Path of the library: beside the test's program, which is in `target/*/deps`, or in the folder above.
fn library() -> PathBuf {
    let program = std::env::current_exe().expect("this test's program");
    program
        .ancestors()
        .skip(1)
        .take(2)
        .map(|folder| folder.join(LIBRARY))
        .find(|library| library.exists())
        .expect("the mock runtime's library beside the test's program")
}

fn say(folder: &Path, at: Option<u64>, change: Change) {
    let mut line = serde_json::to_string(&Cue { at, change }).expect("a cue is JSON");
    line.push('\n');
    let script = File::options()
        .create(true)
        .append(true)
        .open(folder.join(SCRIPT));
    let written = script.and_then(|mut script| script.write_all(line.as_bytes()));
    written.expect("the script can be written");
}

fn calls(folder: &Path) -> Vec<Call> {
    let text = std::fs::read_to_string(folder.join(CALLS)).unwrap_or_default();
    // The last line may not be whole yet.
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    whole
        .lines()
        .map(|line| serde_json::from_str(line).expect("a call is JSON"))
        .collect()
}

impl Mock {
    /// Changes the runtime as soon as it reads its script: at the client's next turn.
    ///
    /// # Panics
    /// Where the script cannot be written.
    pub fn say(&self, change: Change) {
        say(&self.folder, None, change);
    }

    /// Changes the runtime at the beginning of the xrWaitFrame of that number (see [`Cue::at`]).
    ///
    /// # Panics
    /// Where the script cannot be written.
    pub fn say_at(&self, frame: u64, change: Change) {
        say(&self.folder, Some(frame), change);
    }

    /// The calls so far that are logged.
    ///
    /// # Panics
    /// Where the runtime wrote no calls.
    #[must_use]
    pub fn calls(&self) -> Vec<Call> {
        calls(&self.folder)
    }

    /// The calls of that name.
    ///
    /// # Panics
    /// As for [`Mock::calls`].
    #[must_use]
    pub fn calls_of(&self, name: &str) -> Vec<Call> {
        let mut calls = self.calls();
        calls.retain(|call| call.call == name);
        calls
    }

    /// Number of the last xrWaitFrame: for [`Mock::say_at`] the next one is one more.
    ///
    /// # Panics
    /// Before the first; as for [`Mock::calls`].
    #[must_use]
    pub fn frame(&self) -> u64 {
        let calls = self.calls();
        let last = calls.iter().rev().find(|call| call.call == "xrWaitFrame");
        last.and_then(|call| call.frame)
            .expect("a frame was waited for")
    }

    /// The frames that were ended, with the numbers of their xrWaitFrame. Refused ones are left out.
    ///
    /// # Panics
    /// As for [`Mock::calls`].
    #[must_use]
    pub fn frames(&self) -> Vec<(u64, Ended)> {
        let calls = self.calls_of("xrEndFrame").into_iter();
        calls
            .filter(|call| call.answer >= 0)
            .filter_map(|call| Some((call.frame?, call.ended()?)))
            .collect()
    }

    /// A folder for the test's own files.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

impl Drop for Mock {
    fn drop(&mut self) {
        rig::assert_silent(&self.folder);
    }
}
