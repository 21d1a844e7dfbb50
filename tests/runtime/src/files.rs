//! The folder that a test and the runtime share: `script`, which the runtime reads, and `calls`, which it writes.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::PathBuf;

use serde_json::Value;

use crate::calls::Call;
use crate::script::Cue;

/// Environment variable with the folder's path.
pub const FOLDER: &str = "VITRIOL_MOCK_RUNTIME";
/// File name of the script.
pub const SCRIPT: &str = "script";
/// File name of the calls.
pub const CALLS: &str = "calls";

/// Both files; without a folder there are none.
pub(crate) struct Files {
    folder: Option<PathBuf>,
    /// Bytes of the script that have been read.
    heard: u64,
    calls: Option<File>,
}

impl Files {
    pub(crate) fn of_the_environment() -> Self {
        Self {
            folder: std::env::var_os(FOLDER).map(PathBuf::from),
            heard: 0,
            calls: None,
        }
    }

    /// Reads the new whole lines of the script.
    pub(crate) fn hear(&mut self) -> Vec<Cue> {
        let Some(folder) = &self.folder else {
            return Vec::new();
        };
        // There may be no script yet.
        let Ok(mut script) = File::open(folder.join(SCRIPT)) else {
            return Vec::new();
        };
        let mut text = String::new();
        script.seek(SeekFrom::Start(self.heard)).unwrap();
        script.read_to_string(&mut text).unwrap();
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        self.heard += whole as u64;
        let cue = |line| {
            serde_json::from_str(line).unwrap_or_else(|error| panic!("script: {error}: {line}"))
        };
        text[..whole].lines().map(cue).collect()
    }

    /// Writes a call, as one piece: other processes write too.
    pub(crate) fn tell(&mut self, frame: Option<u64>, name: &str, with: Value, answer: i32) {
        let Some(folder) = &self.folder else {
            return;
        };
        let calls = self.calls.get_or_insert_with(|| {
            let mut options = File::options();
            options.create(true).append(true);
            options.open(folder.join(CALLS)).unwrap()
        });
        let call = Call {
            frame,
            call: name.to_owned(),
            with,
            answer,
        };
        let mut line = serde_json::to_string(&call).unwrap();
        line.push('\n');
        calls.write_all(line.as_bytes()).unwrap();
    }
}
