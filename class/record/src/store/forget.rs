//! Deletes the data of a student.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};

use rusqlite::{Connection, params};
use serde::Serialize;
use serde_json::Value;

use super::error::In;
use super::{Store, StoreError};
use crate::Pseudonym;

/// Stands for the user's own folder in a path that is kept: its name is often a person's.
const HOME: &str = "~";

/// The data of a student that were deleted, and those that could not be.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Forgotten {
    /// Attempts, with all that belonged to them.
    pub attempts: u64,
    /// Incidents of these attempts.
    pub incidents: u64,
    /// Waiting statements, which will never be sent.
    pub waiting: u64,
    /// Files of statements that were deleted; as text, since the data are gone before these names are written as JSON.
    pub files: Vec<String>,
    /// Files of statements that are still there.
    pub left: Vec<Left>,
    /// Recordings that the attempts were read from: these are not touched.
    pub recordings: Vec<String>,
    /// Statements that had been sent, in the order of the addresses: they are under the control of who runs the store.
    pub sent: Vec<SentTo>,
}

/// Statements that a Learning Record Store was sent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SentTo {
    /// Its address.
    pub lrs: String,
    /// How many they are.
    pub statements: u64,
}

/// A file that could not be deleted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Left {
    /// The file.
    pub path: String,
    /// Why it could not be deleted.
    pub reason: String,
}

impl Store {
    /// Registers a file of a student's statements that is about to be written, so that it is deleted with the rest.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn add_file(&mut self, pseudonym: &Pseudonym, file: &Path) -> Result<(), StoreError> {
        let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
        let path = self.path.clone();
        let insert = "INSERT OR REPLACE INTO files VALUES (?1, ?2)";
        let change = self.change()?;
        change
            .execute(insert, params![without_home(&file), pseudonym.as_str()])
            .of(&path)?;
        change.commit().of(&path)
    }

    /// Deletes all data of a student, so that the pseudonym is in none of the file's bytes.
    ///
    /// It cannot delete remains of a deleted file in the file system, or copies of this file.
    ///
    /// # Errors
    /// [`StoreError`]. Data that were deleted before it stay deleted; another call goes on.
    pub fn forget(&mut self, pseudonym: &Pseudonym) -> Result<Forgotten, StoreError> {
        let path = self.path.clone();
        let change = self.change()?;
        let mut forgotten = look(&change, pseudonym.as_str()).of(&path)?;
        // Files first: the rows are the only record of them.
        for file in files(&change, pseudonym.as_str()).of(&path)? {
            let shown = file.display().to_string();
            match delete(&file, pseudonym) {
                Ok(true) => forgotten.files.push(shown),
                Ok(false) => {}
                Err(error) => forgotten.left.push(Left {
                    path: shown,
                    reason: error.to_string(),
                }),
            }
        }
        for table in ["attempts", "files"] {
            let delete = format!("DELETE FROM {table} WHERE pseudonym = ?1");
            change.execute(&delete, [pseudonym.as_str()]).of(&path)?;
        }
        change.commit().of(&path)?;
        // Deleted rows are zeros by now; this also returns their space.
        self.connection.execute_batch("VACUUM").of(&path)?;
        Ok(forgotten)
    }
}

fn look(connection: &Connection, pseudonym: &str) -> rusqlite::Result<Forgotten> {
    let count = |query: &str| {
        connection.query_row(query, [pseudonym], |row| row.get(0).map(i64::unsigned_abs))
    };
    let of = "JOIN attempts USING (attempt_id) WHERE attempts.pseudonym = ?1";
    let sent = format!("SELECT lrs, count(*) FROM sent {of} GROUP BY lrs ORDER BY lrs");
    let mut sent = connection.prepare(&sent)?;
    let sent = sent.query_map([pseudonym], |row| {
        Ok(SentTo {
            lrs: row.get(0)?,
            statements: row.get(1).map(i64::unsigned_abs)?,
        })
    })?;
    let recordings = "SELECT DISTINCT source FROM attempts WHERE pseudonym = ?1 AND source IS NOT NULL ORDER BY source";
    let mut recordings = connection.prepare(recordings)?;
    let recordings = recordings.query_map([pseudonym], |row| row.get(0))?;
    Ok(Forgotten {
        attempts: count("SELECT count(*) FROM attempts WHERE pseudonym = ?1")?,
        incidents: count("SELECT count(*) FROM incidents WHERE pseudonym = ?1")?,
        waiting: count(&format!("SELECT count(*) FROM outbox {of}"))?,
        sent: sent.collect::<rusqlite::Result<_>>()?,
        recordings: recordings.collect::<rusqlite::Result<_>>()?,
        ..Forgotten::default()
    })
}

fn files(connection: &Connection, pseudonym: &str) -> rusqlite::Result<Vec<PathBuf>> {
    let mut query =
        connection.prepare("SELECT path FROM files WHERE pseudonym = ?1 ORDER BY path")?;
    let files = query.query_map([pseudonym], |row| row.get::<_, String>(0))?;
    files.map(|file| Ok(with_home(&file?))).collect()
}

/// Deletes a file that is that student's statements and nothing else; `false` where there is none.
fn delete(file: &Path, pseudonym: &Pseudonym) -> io::Result<bool> {
    let opened = match File::open(file) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
        opened => opened?,
    };
    for line in BufReader::new(opened).lines() {
        let statement: Option<Value> = serde_json::from_str(&line?).ok();
        let name = statement
            .as_ref()
            .and_then(|it| it.pointer("/actor/account/name"));
        if name.and_then(Value::as_str) != Some(pseudonym.as_str()) {
            let other = "something else has been written to it since: look through it yourself";
            return Err(io::Error::other(other));
        }
    }
    fs::remove_file(file)?;
    Ok(true)
}

/// A path as it is kept, with `HOME` in place of the user's folder.
pub(crate) fn without_home(path: &Path) -> String {
    let below = dirs::home_dir().and_then(|home| Some(path.strip_prefix(home).ok()?.to_owned()));
    let path = below.map_or_else(|| path.to_owned(), |below| Path::new(HOME).join(below));
    path.to_string_lossy().into_owned()
}

fn with_home(path: &str) -> PathBuf {
    match (Path::new(path).strip_prefix(HOME), dirs::home_dir()) {
        (Ok(below), Some(home)) => home.join(below),
        _ => path.into(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn a_home_folder_is_not_named() {
        let home = dirs::home_dir().unwrap();
        let kept = without_home(&home.join("out").join("statements.jsonl"));
        assert!(!kept.contains(home.to_str().unwrap()), "{kept}");
        assert_eq!(with_home(&kept), home.join("out").join("statements.jsonl"));
        let elsewhere = std::path::absolute("/elsewhere/statements.jsonl").unwrap();
        assert_eq!(with_home(&without_home(&elsewhere)), elsewhere);
    }
}
