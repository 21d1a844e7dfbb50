//! Reads the class's file.

use std::path::Path;
use std::str::FromStr;

use rusqlite::{Connection, OptionalExtension, Row};
use uuid::Uuid;

use super::error::In;
use super::{Store, StoreError};
use crate::{Cap, Entry, Points, Pseudonym, Score};

impl Store {
    /// The attempt of that identifier.
    ///
    /// # Errors
    /// [`StoreError`], also where there is none.
    pub fn attempt(&self, id: Uuid) -> Result<Entry, StoreError> {
        entry(&self.connection, &self.path, id)
    }

    /// The student of that attempt; `None` where none of that identifier is kept.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn pseudonym_of(&self, id: Uuid) -> Result<Option<Pseudonym>, StoreError> {
        let query = "SELECT pseudonym FROM attempts WHERE attempt_id = ?1";
        let name = self
            .connection
            .query_row(query, [id.to_string()], |row| row.get::<_, String>(0))
            .optional()
            .of(&self.path)?;
        name.map(|name| parsed(&self.path, &name, "a pseudonym"))
            .transpose()
    }
}

/// The attempt of that identifier.
pub(super) fn entry(connection: &Connection, path: &Path, id: Uuid) -> Result<Entry, StoreError> {
    let query = "SELECT attempt_id, pseudonym, begun, lesson, source, points, points_max, attempt FROM attempts WHERE attempt_id = ?1";
    let mut query = connection.prepare(query).of(path)?;
    let mut rows = query.query([id.to_string()]).of(path)?;
    let row = rows.next().of(path)?;
    whole(
        connection,
        path,
        row.ok_or_else(|| damaged(path, "an attempt"))?,
    )
}

fn whole(connection: &Connection, path: &Path, row: &Row<'_>) -> Result<Entry, StoreError> {
    let text = |column: usize| row.get::<_, String>(column).of(path);
    let number = |column: usize| row.get::<_, Option<f64>>(column).of(path);
    let attempt = serde_json::from_str(&text(7)?);
    let id = text(0)?;
    let score = match (number(5)?, number(6)?) {
        (Some(raw), Some(max)) => {
            let mut score = Score::new(raw, max).map_err(|_| damaged(path, "a score"))?;
            let query = "SELECT criterion, points, points_max FROM points WHERE attempt_id = ?1 ORDER BY position";
            score.points = rows_of(connection, query, &id, |row| {
                Ok(Points {
                    criterion: row.get(0)?,
                    raw: row.get(1)?,
                    max: row.get(2)?,
                })
            })
            .of(path)?;
            let query =
                "SELECT danger, points_max FROM caps WHERE attempt_id = ?1 ORDER BY position";
            score.caps = rows_of(connection, query, &id, |row| {
                Ok(Cap {
                    danger: row.get(0)?,
                    max: row.get(1)?,
                })
            })
            .of(path)?;
            Some(score)
        }
        _ => None,
    };
    Ok(Entry {
        id: parsed(path, &id, "an identifier")?,
        pseudonym: parsed(path, &text(1)?, "a pseudonym")?,
        begun: parsed(path, &text(2)?, "a time")?,
        lesson: row.get(3).of(path)?,
        source: row.get(4).of(path)?,
        score,
        attempt: attempt.map_err(|_| damaged(path, "an attempt"))?,
    })
}

/// The rows of that attempt.
fn rows_of<T>(
    connection: &Connection,
    query: &str,
    id: &str,
    of: impl FnMut(&Row<'_>) -> rusqlite::Result<T>,
) -> rusqlite::Result<Vec<T>> {
    connection.prepare(query)?.query_map([id], of)?.collect()
}

/// Parses a column's text; `what` names it in the error.
pub(super) fn parsed<T: FromStr>(path: &Path, text: &str, what: &str) -> Result<T, StoreError> {
    text.parse().map_err(|_| damaged(path, what))
}

fn damaged(path: &Path, what: &str) -> StoreError {
    StoreError::Damaged {
        path: path.to_owned(),
        what: what.into(),
    }
}
