//! The program under test, run as a user runs it.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// A pour with 1,760 particles, in the places of `two-flasks`.
pub fn scene(folder: &Path) -> PathBuf {
    let text = include_str!("../../../sim/scenes/two-flasks.toml");
    let small = text
        .replace("spacing = 0.0025 ", "spacing = 0.0044 ")
        .replace("substeps = 10", "substeps = 4")
        .replace("iterations = 3", "iterations = 2");
    assert_eq!(small.matches("0.0044").count(), 1);
    let file = folder.join("small.toml");
    std::fs::write(&file, small).unwrap();
    file
}

/// `vitriol vr` at work.
pub struct Program {
    child: Child,
    /// Its log's lines.
    log: Receiver<String>,
}

impl Program {
    /// In that scene, keeping a recording.
    pub fn start(scene: &Path, recording: &Path) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_vitriol"))
            .args(["-v", "vr", "--json", "--scene"])
            .arg(scene)
            .arg("--record")
            .arg(recording)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let stderr = child.stderr.take().unwrap();
        let (sender, log) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(stderr).lines().map_while(Result::ok) {
                eprintln!("vitriol: {line}");
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Self { child, log }
    }

    /// Waits for a line of the log that has `part`.
    pub fn says(&self, part: &str) {
        let deadline = Instant::now() + Duration::from_secs(60);
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            let line = self.log.recv_timeout(left);
            if line
                .unwrap_or_else(|error| panic!("no word of {part}: {error}"))
                .contains(part)
            {
                return;
            }
        }
    }

    /// Asks it to end, as the system does, and gives what it printed.
    pub fn end(mut self) -> serde_json::Value {
        // The shell's own kill: the rig has no other.
        let asked = Command::new("sh")
            .args(["-c", &format!("kill {}", self.child.id())])
            .status();
        assert!(asked.unwrap().success());
        let stdout = self.child.stdout.take().unwrap();
        let text = std::io::read_to_string(stdout).unwrap();
        let status = self.child.wait().unwrap();
        assert!(status.success(), "{status}");
        // OpenXR's validation layer greets on standard output.
        let json = &text[text.find("\n{").map_or(0, |at| at + 1)..];
        serde_json::from_str(json).unwrap_or_else(|error| panic!("{error} in: {text}"))
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
