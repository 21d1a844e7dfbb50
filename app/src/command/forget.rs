//! `vitriol forget`: deletes all that is kept of a student, and says what it cannot delete.

use std::path::{Path, PathBuf};

use serde::Serialize;
use vitriol_record::store::{Forgotten, Left, SentTo, Store, StoreError, default_path};
use vitriol_run::units::count;
use vitriol_run::{Blame, Failure, Format, emit};
use vitriol_xr::files;

use crate::cli::ForgetArgs;

/// What `vitriol forget` prints.
#[derive(Debug, Serialize)]
struct Told {
    pseudonym: String,
    class: String,
    #[serde(flatten)]
    forgotten: Forgotten,
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
    let told = Told {
        pseudonym: args.pseudonym.to_string(),
        class: class.display().to_string(),
        forgotten,
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
    let (name, forgotten) = (&told.pseudonym, &told.forgotten);
    if forgotten.attempts == 0 && forgotten.files.is_empty() && forgotten.left.is_empty() {
        return format!("Nothing is kept of {name} in {}\n", told.class);
    }
    let mut text = format!(
        "Deleted of {name}, from {}:\n- {}, with {}\n",
        told.class,
        count(forgotten.attempts, "attempt"),
        count(forgotten.incidents, "incident")
    );
    if forgotten.waiting > 0 {
        let waiting = count(forgotten.waiting, "statement");
        text += &format!("- {waiting} that waited to be sent, and will not be\n");
    }
    for file in &forgotten.files {
        text += &format!("- {file}\n");
    }
    let (left, sent) = (&forgotten.left, &forgotten.sent);
    if !(left.is_empty() && forgotten.recordings.is_empty() && sent.is_empty()) {
        text.push_str("Not deleted:\n");
    }
    for Left { path, reason } in left {
        text += &format!("- {path}: {reason}\n");
    }
    for recording in &forgotten.recordings {
        text += &format!("- {recording}, from which attempts were read: delete it yourself\n");
    }
    for SentTo { lrs, statements } in sent {
        text += &format!(
            "- {} that {lrs} was sent: they are not under Vitriol's control; ask who runs it to delete them\n",
            count(*statements, "statement")
        );
    }
    text
}
