//! A real browser for pages: headless Chromium opens a page, runs it, and returns the page's result and the console's messages, or a
//! picture of it.
//!
//! A page returns its result by `console.log("TOLD " + JSON.stringify(value))`; files beside it can be loaded, framed and read as if they
//! came from one server.

use std::path::{Path, PathBuf};

use crate::devtools::Tab;
use crate::installed::not_tested;

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
/// Where no browser is installed and `CI=true`, the browser fails, or the page returns nothing within
/// [`PATIENCE`](crate::wait::PATIENCE).
#[must_use]
pub fn visit(page: &Path) -> Option<Visit> {
    let mut tab = Tab::new()?;
    tab.open(page);
    Some(Visit {
        told: tab.told(),
        console: tab.complaints(),
    })
}

/// Writes a PNG of all of `page`, as a window of that width shows it, to `picture`.
///
/// `None` and panics as for [`visit`].
#[must_use]
pub fn photograph(page: &Path, width: u32, look: Look, picture: &Path) -> Option<()> {
    let mut tab = Tab::new()?;
    tab.look([width, 844], look);
    tab.open(page);
    tab.until("document.readyState === 'complete'");
    std::fs::write(picture, tab.picture()).unwrap();
    Some(())
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
