//! Errors of the class's file.

use std::io;
use std::path::{Path, PathBuf};

use uuid::Uuid;

/// Errors of the class's file.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The file does not exist.
    #[error(
        "{path}: there is no such file; name the class's file, which the first attempt that is kept makes"
    )]
    Missing {
        /// The file.
        path: PathBuf,
    },
    /// It or its folder cannot be made.
    #[error("{path}: could not be made; is there room and permission?")]
    Folder {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// It is another program's file.
    #[error("{path}: is not a class's file of Vitriol; name another, which may be new")]
    NotOurs {
        /// The file.
        path: PathBuf,
    },
    /// The file is of a later version.
    #[error(
        "{path}: its tables are of version {found}, and this program knows version {known}; update Vitriol"
    )]
    Newer {
        /// The file.
        path: PathBuf,
        /// The version of the file.
        found: i32,
        /// The version of this program.
        known: i32,
    },
    /// Another program has been writing for longer than this one waits.
    #[error(
        "{path}: another program has been writing to it for {seconds} s; close that one, then try again"
    )]
    Busy {
        /// The file.
        path: PathBuf,
        /// Time that it waited, s.
        seconds: u64,
    },
    /// The identifier belongs to another attempt.
    #[error(
        "{path}: attempt {id} of this recording is kept already, for another student or scene; give that student's pseudonym, or name another class's file"
    )]
    Taken {
        /// The file.
        path: PathBuf,
        /// The attempt's identifier.
        id: Uuid,
    },
    /// The attempt has a number that is not finite, as of a simulation that went astray.
    #[error(
        "attempt {id} has an amount in it that is no number, and is not kept; replay its recording and look for a warning"
    )]
    NoNumber {
        /// The attempt's identifier.
        id: Uuid,
    },
    /// A row has been changed by something else.
    #[error(
        "{path}: {what} in it cannot be read: something else has changed the file; take its last copy"
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The part that cannot be read.
        what: String,
    },
    /// SQLite refused.
    #[error("{path}: SQLite could not read or write it; is there room and permission?")]
    Sqlite {
        /// The file.
        path: PathBuf,
        /// Its error.
        source: rusqlite::Error,
    },
}

/// Adds the file to an error of SQLite's.
pub(super) trait In<T> {
    fn of(self, path: &Path) -> Result<T, StoreError>;
}

impl<T> In<T> for rusqlite::Result<T> {
    fn of(self, path: &Path) -> Result<T, StoreError> {
        use rusqlite::ErrorCode::{DatabaseBusy, DatabaseCorrupt, DatabaseLocked, NotADatabase};
        self.map_err(|source| {
            let path = path.to_owned();
            match source.sqlite_error_code() {
                Some(DatabaseBusy | DatabaseLocked) => StoreError::Busy {
                    path,
                    seconds: super::PATIENCE.as_secs(),
                },
                Some(NotADatabase) => StoreError::NotOurs { path },
                Some(DatabaseCorrupt) => StoreError::Damaged {
                    path,
                    what: "a page".into(),
                },
                _ => StoreError::Sqlite { path, source },
            }
        })
    }
}
