//! Keeps the attempts of a sitting, in one call.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use vitriol_lesson::Attempt;

use crate::lrs::{Lrs, Sent, send};
use crate::store::{Added, Store, StoreError, without_home};
use crate::xapi::{Statement, statements};
use crate::{Entry, Pseudonym, Score, Session};

/// The name of the file of statements in a folder of results.
const FILE: &str = "statements.jsonl";

/// The attempts of a sitting that are to be kept, and where.
#[derive(Clone, Copy, Debug)]
pub struct Keeping<'a> {
    /// The class's file, which may be new.
    pub class: &'a Path,
    /// The student.
    pub pseudonym: &'a Pseudonym,
    /// The sitting.
    pub session: Session,
    /// The lesson's name.
    pub lesson: Option<&'a str>,
    /// The recording.
    pub source: Option<&'a Path>,
    /// The attempts, in their order.
    pub attempts: &'a [Scored],
    /// The folder for the file of statements, which may be new; `None` writes none.
    pub out: Option<&'a Path>,
    /// The Learning Record Store to send to; `None` sends nothing.
    pub lrs: Option<&'a Lrs>,
}

/// An attempt, and its score where that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Scored {
    /// The attempt.
    pub attempt: Attempt,
    /// Its score.
    pub score: Option<Score>,
}

/// Result of [`keep`].
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// Attempts that were not kept before.
    pub new: usize,
    /// Attempts that were kept before, and stay as they were.
    pub before: usize,
    /// The file of statements.
    pub statements: Option<PathBuf>,
    /// Result of sending. Undelivered statements wait in the class's file.
    pub sent: Option<Sent>,
}

/// Errors of [`keep`].
#[derive(Debug, thiserror::Error)]
pub enum KeepError {
    /// The class's file failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The file of statements exists already.
    #[error("{path}: exists and is not overwritten; name another folder or take that one away")]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The file of statements cannot be written.
    #[error("{path}: could not be written; is there room and permission?")]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
}

/// Keeps the attempts of a sitting in the class's file, writes their statements, and sends waiting statements where a Learning Record
/// Store is given. Attempts that are kept already are not kept twice.
///
/// # Errors
/// [`KeepError`]; attempts that were kept before it stay. An unreachable Learning Record Store is no error: see [`Kept::sent`].
pub fn keep(keeping: &Keeping<'_>) -> Result<Kept, KeepError> {
    let file = keeping.out.map(|out| out.join(FILE));
    if let Some(path) = file
        .as_deref()
        .filter(|path| path.symlink_metadata().is_ok())
    {
        return Err(KeepError::Exists {
            path: path.to_owned(),
        });
    }
    let mut store = Store::open(keeping.class)?;
    let address = keeping.lrs.map(|lrs| lrs.endpoint.as_str());
    let source = keeping.source.map(|source| {
        let absolute = std::path::absolute(source);
        without_home(absolute.as_deref().unwrap_or(source))
    });
    let (mut kept, mut all) = ([0, 0], Vec::new());
    for (index, Scored { attempt, score }) in keeping.attempts.iter().enumerate() {
        let entry = Entry {
            id: keeping.session.attempt_id(index),
            pseudonym: keeping.pseudonym.clone(),
            begun: keeping.session.time_of(attempt.begun_s),
            lesson: keeping.lesson.map(str::to_owned),
            source: source.clone(),
            score: score.clone(),
            attempt: attempt.clone(),
        };
        kept[usize::from(store.add(&entry, address)? == Added::Before)] += 1;
        // As it is kept, so that the file has the statements that are sent.
        let entry = store.attempt(entry.id)?;
        all.extend(statements(store.class(), &entry));
    }
    if let Some(path) = &file {
        store.add_file(keeping.pseudonym, path)?;
        write(path, &all).map_err(|source| KeepError::Write {
            path: path.clone(),
            source,
        })?;
    }
    let sent = keeping.lrs.map(|lrs| send(&mut store, lrs)).transpose()?;
    Ok(Kept {
        new: kept[0],
        before: kept[1],
        statements: file,
        sent,
    })
}

/// Writes a new file of statements, each as JSON on a line of its own: whole or not at all.
fn write(path: &Path, statements: &[Statement]) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut to = BufWriter::new(File::create_new(path)?);
    let mut fill = || -> io::Result<()> {
        for statement in statements {
            serde_json::to_writer(&mut to, statement)?;
            to.write_all(b"\n")?;
        }
        to.flush()?;
        to.get_ref().sync_all()
    };
    let filled = fill();
    if filled.is_err() {
        // A file that cannot be removed is at least in the class's file.
        let _ = fs::remove_file(path);
    }
    filled
}
