//! A real browser for pages: headless Chromium opens a page, runs it, and returns the page's result and the console's messages, or a
//! picture of it.
//!
//! A page returns its result by `console.log("TOLD " + JSON.stringify(value))`; files beside it can be loaded, framed and read as if they
//! came from one server.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Instant;

use crate::installed::not_tested;
use crate::program::Kept;
use crate::wait::PATIENCE;

/// Names under which Chromium is installed, first found first taken.
const NAMES: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
];

/// Result of a visit.
#[derive(Debug)]
pub struct Visit {
    /// The JSON that the page returned.
    pub told: String,
    /// All other messages of the console: uncaught exceptions, failed loads, log calls. A sound page leaves it empty.
    pub console: Vec<String>,
}

/// Colour scheme that the browser prefers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// Dark on light.
    Light,
    /// Light on dark.
    Dark,
}

/// Opens `page` and waits for its result.
///
/// `None` where no browser is installed, with a message on standard error; with `CI=true` that is a failure instead.
///
/// # Panics
/// Where no browser is installed and `CI=true`, the browser fails, or the page returns nothing within [`PATIENCE`].
#[must_use]
pub fn visit(page: &Path) -> Option<Visit> {
    let browser = Browser::start(page, Look::Light, &[])?;
    let mut console = Vec::new();
    let deadline = Instant::now() + PATIENCE;
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        match browser.lines.recv_timeout(left) {
            Ok(line) => match console_message(&line) {
                Some(message) => match message.strip_prefix("TOLD ") {
                    Some(told) => {
                        return Some(Visit {
                            told: told.to_owned(),
                            console,
                        });
                    }
                    None => console.push(message.to_owned()),
                },
                None => continue,
            },
            Err(RecvTimeoutError::Timeout) => {
                panic!("{} told nothing; its console: {console:?}", page.display())
            }
            Err(RecvTimeoutError::Disconnected) => {
                panic!("the browser ended; the console: {console:?}")
            }
        }
    }
}

/// Writes a PNG of `page`, as a window of `size` pixels shows it, to `picture`.
///
/// `None` and panics as for [`visit`].
#[must_use]
pub fn photograph(page: &Path, size: (u32, u32), look: Look, picture: &Path) -> Option<()> {
    let options = [
        format!("--screenshot={}", picture.display()),
        format!("--window-size={},{}", size.0, size.1),
        "--hide-scrollbars".to_owned(),
    ];
    let browser = Browser::start(page, look, &options)?;
    let deadline = Instant::now() + PATIENCE;
    // With --screenshot the browser ends by itself, and with it the lines.
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        match browser.lines.recv_timeout(left) {
            Ok(_) => {}
            Err(RecvTimeoutError::Disconnected) => break,
            Err(RecvTimeoutError::Timeout) => panic!("no picture of {} came", page.display()),
        }
    }
    assert!(picture.exists(), "no picture of {} came", page.display());
    Some(())
}

/// A browser at work, with a profile of its own; both go when this is dropped.
struct Browser {
    _child: Kept,
    lines: Receiver<String>,
    // Declared last: the profile may only go after the browser has.
    _profile: tempfile::TempDir,
}

impl Browser {
    fn start(page: &Path, look: Look, options: &[String]) -> Option<Self> {
        let program = find_or_say()?;
        let page = page.canonicalize().expect("the page's file");
        let profile = tempfile::tempdir().expect("a folder for the browser's profile");
        let mut command = Command::new(program);
        command
            .args(["--headless", "--no-sandbox", "--disable-gpu"])
            .args(["--no-first-run", "--disable-extensions", "--mute-audio"])
            .args(["--enable-logging=stderr", "--allow-file-access-from-files"])
            .arg(format!("--user-data-dir={}", profile.path().display()));
        if look == Look::Dark {
            command.arg("--blink-settings=preferredColorScheme=0");
        }
        let mut child = command
            .args(options)
            .arg(format!("file://{}", page.display()))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the browser starts");
        let stderr = child.stderr.take().expect("the browser's standard error");
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(stderr).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        Some(Self {
            _child: Kept(child),
            lines,
            _profile: profile,
        })
    }
}

/// The browser's program.
///
/// `None` and panics as for [`visit`].
pub(crate) fn find_or_say() -> Option<PathBuf> {
    let found = find();
    if found.is_none() {
        not_tested(&format!(
            "no browser is installed (needed: one of {NAMES:?})"
        ));
    }
    found
}

fn find() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    NAMES
        .iter()
        .flat_map(|name| std::env::split_paths(&path).map(move |folder| folder.join(name)))
        .find(|candidate| candidate.is_file())
}

/// The message of a line such as
/// `[1:1:1121/112710.3:INFO:CONSOLE:1] "hello", source: file:///x.html (1)`.
fn console_message(line: &str) -> Option<&str> {
    let (_, rest) = line.split_once(":CONSOLE")?;
    let (_, rest) = rest.split_once("] \"")?;
    let (message, _) = rest.rsplit_once("\", source: ")?;
    Some(message)
}
