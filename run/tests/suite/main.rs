//! Film, sound and subtitles of a run, and the run on a device.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod device;
mod film;
mod mp4;
mod recording;
mod sound;
mod subtitles;

use std::path::Path;

use vitriol_tests::browser;

/// What a page in that folder tells; `None` without a browser.
fn told(folder: &Path, page: &str) -> Option<serde_json::Value> {
    let file = folder.join("page.html");
    std::fs::write(&file, page).unwrap();
    let visit = browser::visit(&file)?;
    eprintln!("{visit:?}");
    Some(serde_json::from_str(&visit.told).unwrap())
}
