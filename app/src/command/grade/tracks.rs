//! The recordings that a call names: files, and those in folders. Learning platforms unpack a folder for each student.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use vitriol_run::texts::FilesTexts;
use vitriol_run::{Blame, Failure, in_a_line};
use vitriol_xr::files;

use super::{PAGE, TABLE, file_name};
use crate::command::stem;

/// Most folders inside each other that are looked into: platforms make one or two, and a stack is finite.
const DEEPEST: usize = 8;

/// Most names in a warning.
const NAMED: usize = 5;

/// The recordings, and what else lay beside them.
#[derive(Clone, Debug, Default)]
pub struct Tracks {
    /// In the order in which they were named; those in a folder by name.
    pub all: Vec<Named>,
    /// Files and folders that hold no recording, and why where that is not plain.
    pub passed_over: Vec<String>,
}

/// A recording's file.
#[derive(Clone, Debug)]
pub struct Named {
    /// The file.
    pub file: PathBuf,
    /// What its results are named by.
    pub stem: String,
    /// The student's folder, if it lies in one.
    pub folder: Option<String>,
}

impl Tracks {
    /// The files that are named, and those in the folders that are. What an earlier call left in `out` is no part of a class. What is
    /// wrong with them is said in these texts.
    ///
    /// # Errors
    /// [`Failure::Input`] where a folder is not there or has no recordings, [`Failure::Other`] where it cannot be listed.
    pub fn of(named: &[PathBuf], out: Option<&Path>, texts: &FilesTexts) -> Result<Self, Failure> {
        let mut tracks = Self::default();
        let out = out.and_then(|it| it.canonicalize().ok());
        for path in named {
            // A recording that is not there is a line of the table, as another bad file is.
            if files::is_absent(path) && !is_track(path) {
                return Err(texts.no_folder.fill(&[("name", &shown(path))])).input();
            }
            if !path.is_dir() {
                tracks.all.push(Named {
                    file: path.clone(),
                    stem: stem(&path.display().to_string()),
                    folder: None,
                });
                continue;
            }
            let before = tracks.all.len();
            tracks.list(path, &[], out.as_deref(), texts).other()?;
            if tracks.all.len() == before {
                return Err(texts.no_recordings.fill(&[("name", &shown(path))])).input();
            }
        }
        Ok(tracks)
    }

    /// Adds what is in a folder that lies in these folders of the class.
    fn list(
        &mut self,
        folder: &Path,
        above: &[String],
        out: Option<&Path>,
        texts: &FilesTexts,
    ) -> Result<(), String> {
        let unlisted = |error: std::io::Error| {
            let (name, why) = (shown(folder), error.to_string());
            (texts.unlisted).fill(&[("name", &name), ("why", &why)])
        };
        let mut inside = Vec::new();
        for entry in fs::read_dir(folder).map_err(unlisted)? {
            inside.push(entry.map_err(unlisted)?.path());
        }
        inside.sort();
        // The class itself may be where results go.
        let of_results = out.is_some() && folder.canonicalize().ok().as_deref() == out;
        for file in inside {
            let name = file_name(&file);
            if is_companion(&name) {
                continue;
            }
            if file.is_dir() {
                self.enter(&file, (above, name), out, texts);
            } else if is_track(&file) {
                let mut parts = above.to_vec();
                parts.push(stem(&file.display().to_string()));
                self.all.push(Named {
                    stem: parts.join(" - "),
                    folder: above.first().cloned(),
                    file,
                });
            } else if !of_results && !is_result(&name) {
                self.passed_over.push(file.display().to_string());
            }
        }
        Ok(())
    }

    /// Adds what is in the folder of that name; one that cannot be looked into stops no other.
    fn enter(
        &mut self,
        folder: &Path,
        (above, name): (&[String], String),
        out: Option<&Path>,
        texts: &FilesTexts,
    ) {
        if out.is_some() && folder.canonicalize().ok().as_deref() == out {
            return;
        }
        // A link may lead back to where it lies.
        if folder.is_symlink() || above.len() >= DEEPEST {
            self.passed_over.push(folder.display().to_string());
            return;
        }
        let mut within = above.to_vec();
        within.push(name);
        if let Err(error) = self.list(folder, &within, out, texts) {
            self.passed_over.push(error);
        }
    }

    /// A name that results of two of them would have. Some file systems do not tell capitals from small letters.
    pub fn same_name(&self) -> Option<&str> {
        let mut names = BTreeSet::new();
        let mut all = self.all.iter();
        let again = all.find(|it| !names.insert(it.stem.to_lowercase()));
        again.map(|it| it.stem.as_str())
    }
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

/// The first few, in a line.
pub fn short(names: &[String], texts: &FilesTexts) -> String {
    let shown: Vec<String> = names.iter().take(NAMED).map(|it| in_a_line(it)).collect();
    let shown = shown.join(", ");
    match names.len().saturating_sub(NAMED) {
        0 => shown,
        more => (texts.more).fill(&[("names", &shown), ("number", &more.to_string())]),
    }
}

fn is_track(file: &Path) -> bool {
    let extension = file.extension();
    extension.is_some_and(|it| it.eq_ignore_ascii_case("mcap"))
}

/// Whether an earlier call wrote it, with this or another folder for its results.
fn is_result(name: &str) -> bool {
    let endings = [".grade.json", ".report.html"];
    [TABLE, PAGE].contains(&name) || endings.iter().any(|it| name.ends_with(it))
}

/// Whether a system or a program laid it beside a student's files: macOS, Windows, an office program.
fn is_companion(name: &str) -> bool {
    const NAMES: [&str; 4] = [".DS_Store", "Thumbs.db", "desktop.ini", "__MACOSX"];
    ["._", "~$"].iter().any(|it| name.starts_with(it))
        || NAMES.iter().any(|it| name.eq_ignore_ascii_case(it))
}
