//! `vitriol forget`: deletes all that is kept of a student, and says what it cannot delete.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use vitriol_record::store::{Forgotten, Store, StoreError, default_path};
use vitriol_run::units::count;
use vitriol_run::{Blame, Failure, Format, emit};
use vitriol_xr::files;

use crate::cli::ForgetArgs;

/// What `vitriol forget` prints.
#[derive(Debug, Serialize)]
struct Told {
    pseudonym: String,
    class: String,
    /// What was deleted.
    attempts: u64,
    incidents: u64,
    /// Statements that waited to be sent.
    waiting: u64,
    /// Files of statements.
    files: Vec<String>,
    /// Files of statements that could not be.
    left: Vec<Left>,
    /// What the attempts were read from; it is still there.
    recordings: Vec<String>,
    /// Statements that were sent before; they are still there.
    sent: Vec<Sent>,
}

#[derive(Debug, Serialize)]
struct Left {
    path: String,
    reason: String,
}

#[derive(Debug, Serialize)]
struct Sent {
    lrs: String,
    statements: u64,
}

/// Runs `vitriol forget`. That nothing is kept of a student is no failure.
///
/// # Errors
/// [`Failure::Input`] where the file is none of a class, or one that is named is not there; [`Failure::Other`] where it cannot be
/// written.
pub fn run(args: &ForgetArgs, format: Format) -> Result<(), Failure> {
    let (class, forgotten) = match &args.class {
        Some(class) => (class.clone(), forget(args, class)?),
        None => {
            let class = default_path()
                .ok_or("this system tells no folder for data: name the class's file with --class");
            let class: PathBuf = class.input()?;
            // Nobody has been kept yet.
            let forgotten = match files::is_absent(&class) {
                true => Forgotten::default(),
                false => forget(args, &class)?,
            };
            (class, forgotten)
        }
    };
    let shown = |path: PathBuf| path.display().to_string();
    let left = forgotten.left.into_iter().map(|left| Left {
        path: shown(left.path),
        reason: left.reason,
    });
    let sent = forgotten.sent.into_iter();
    let told = Told {
        pseudonym: args.pseudonym.to_string(),
        class: shown(class),
        attempts: forgotten.attempts,
        incidents: forgotten.incidents,
        waiting: forgotten.waiting,
        files: forgotten.files.into_iter().map(shown).collect(),
        left: left.collect(),
        recordings: forgotten.sources,
        sent: sent
            .map(|(lrs, statements)| Sent { lrs, statements })
            .collect(),
    };
    emit(format, &told, describe)
}

fn forget(args: &ForgetArgs, class: &Path) -> Result<Forgotten, Failure> {
    let forgotten = Store::open_existing(class).and_then(|mut store| store.forget(&args.pseudonym));
    match forgotten {
        Err(
            error @ (StoreError::Missing { .. }
            | StoreError::NotOurs { .. }
            | StoreError::Newer { .. }),
        ) => Err(error).input(),
        forgotten => forgotten.other(),
    }
}

fn describe(told: &Told) -> String {
    let name = &told.pseudonym;
    if told.attempts == 0 && told.files.is_empty() && told.left.is_empty() {
        return format!("Nothing is kept of {name} in {}\n", told.class);
    }
    let mut text = format!(
        "Deleted of {name}, from {}:\n- {}, with {}\n",
        told.class,
        count(told.attempts, "attempt"),
        count(told.incidents, "incident")
    );
    // Writing to a string cannot fail.
    if told.waiting > 0 {
        let waiting = count(told.waiting, "statement");
        let _ = writeln!(text, "- {waiting} that waited to be sent, and will not be");
    }
    for file in &told.files {
        let _ = writeln!(text, "- {file}");
    }
    let still = [told.left.len(), told.recordings.len(), told.sent.len()];
    if still.iter().any(|&count| count > 0) {
        text.push_str("Not deleted:\n");
    }
    for Left { path, reason } in &told.left {
        let _ = writeln!(text, "- {path}: {reason}");
    }
    for recording in &told.recordings {
        let _ = writeln!(
            text,
            "- {recording}, from which attempts were read: delete it yourself"
        );
    }
    for Sent { lrs, statements } in &told.sent {
        let _ = writeln!(
            text,
            "- {} that {lrs} was sent: they are not under Vitriol's control; ask who runs it to delete them",
            count(*statements, "statement")
        );
    }
    text
}
