//! Reads the class's file.

use std::collections::BTreeMap;
use std::path::Path;

use jiff::Timestamp;
use rusqlite::{Connection, OptionalExtension, Row};
use uuid::Uuid;
use vitriol_lesson::Attempt;

use super::error::In;
use super::{Store, StoreError};
use crate::{Cap, Entry, Points, Pseudonym, Score};

/// Summary of one student's attempts.
#[derive(Clone, Debug, PartialEq)]
pub struct Student {
    /// The student.
    pub pseudonym: Pseudonym,
    /// Number of attempts.
    pub attempts: u64,
    /// Number of attempts whose end is kept.
    pub finished: u64,
    /// The best score, points over most points; `None` where nothing was scored.
    pub best: Option<f64>,
    /// When the last began.
    pub last_begun: Timestamp,
    /// Number of incidents by kind, as in a recording's `/events`.
    pub incidents: BTreeMap<String, u64>,
}

/// A row of `attempts`, as text.
struct Columns {
    id: String,
    pseudonym: String,
    begun: String,
    lesson: Option<String>,
    source: Option<String>,
    points: Option<(f64, f64)>,
    passed: Option<bool>,
    attempt: String,
}

const COLUMNS: &str =
    "attempt_id, pseudonym, begun, lesson, source, points, points_max, passed, attempt";

impl Store {
    /// The attempts of a student, in the order of their beginning.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn attempts_of(&self, pseudonym: &Pseudonym) -> Result<Vec<Entry>, StoreError> {
        let condition = "pseudonym = ?1 ORDER BY begun, attempt_id";
        entries(&self.connection, &self.path, condition, pseudonym.as_str())
    }

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
        name.map(|name| self.parsed(&name, "a pseudonym"))
            .transpose()
    }

    /// A summary of each student, by pseudonym.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn students(&mut self) -> Result<Vec<Student>, StoreError> {
        let path = self.path.clone();
        // Both queries see the same moment.
        let look = self.connection.transaction().of(&path)?;
        let mut kinds = BTreeMap::<String, BTreeMap<String, u64>>::new();
        rows(
            &look,
            "SELECT pseudonym, kind, count(*) FROM incidents GROUP BY pseudonym, kind",
            |row| {
                let count: i64 = row.get(2)?;
                let of = kinds.entry(row.get(0)?).or_default();
                of.insert(row.get(1)?, count.unsigned_abs());
                Ok(())
            },
        )
        .of(&path)?;
        let students = rows(
            &look,
            "SELECT pseudonym, attempts, finished, best_score, last_begun FROM students",
            |row| {
                let number = |i| row.get(i).map(i64::unsigned_abs);
                let (name, last): (String, String) = (row.get(0)?, row.get(4)?);
                Ok((name, number(1)?, number(2)?, row.get(3)?, last))
            },
        )
        .of(&path)?;
        drop(look);
        let student = |(name, attempts, finished, best, last): (String, _, _, _, String)| {
            Ok(Student {
                pseudonym: self.parsed(&name, "a pseudonym")?,
                attempts,
                finished,
                best,
                last_begun: self.parsed(&last, "a time")?,
                incidents: kinds.remove(&name).unwrap_or_default(),
            })
        };
        students.into_iter().map(student).collect()
    }
}

/// The attempt of that identifier.
pub(super) fn entry(connection: &Connection, path: &Path, id: Uuid) -> Result<Entry, StoreError> {
    let mut found = entries(connection, path, "attempt_id = ?1", &id.to_string())?;
    found.pop().ok_or_else(|| damaged(path, "an attempt"))
}

fn entries(
    connection: &Connection,
    path: &Path,
    condition: &str,
    value: &str,
) -> Result<Vec<Entry>, StoreError> {
    let query = format!("SELECT {COLUMNS} FROM attempts WHERE {condition}");
    let mut query = connection.prepare(&query).of(path)?;
    let found = query.query_map([value], columns).of(path)?;
    let found = found.collect::<rusqlite::Result<Vec<_>>>().of(path)?;
    found
        .into_iter()
        .map(|row| whole(connection, path, row))
        .collect()
}

fn columns(row: &Row<'_>) -> rusqlite::Result<Columns> {
    let points: Option<f64> = row.get(5)?;
    let max: Option<f64> = row.get(6)?;
    Ok(Columns {
        id: row.get(0)?,
        pseudonym: row.get(1)?,
        begun: row.get(2)?,
        lesson: row.get(3)?,
        source: row.get(4)?,
        points: points.zip(max),
        passed: row.get(7)?,
        attempt: row.get(8)?,
    })
}

fn whole(connection: &Connection, path: &Path, row: Columns) -> Result<Entry, StoreError> {
    let attempt: Attempt =
        serde_json::from_str(&row.attempt).map_err(|_| damaged(path, "an attempt"))?;
    let score = match row.points {
        None => None,
        Some((raw, max)) => {
            let mut score = Score::new(raw, max).map_err(|_| damaged(path, "a score"))?;
            score.passed = row.passed;
            let query = "SELECT criterion, points, points_max FROM points WHERE attempt_id = ?1 ORDER BY position";
            let mut query = connection.prepare(query).of(path)?;
            let points = query.query_map([&row.id], |row| {
                Ok(Points {
                    criterion: row.get(0)?,
                    raw: row.get(1)?,
                    max: row.get(2)?,
                })
            });
            score.points = points.of(path)?.collect::<rusqlite::Result<_>>().of(path)?;
            let query =
                "SELECT danger, points_max FROM caps WHERE attempt_id = ?1 ORDER BY position";
            let mut query = connection.prepare(query).of(path)?;
            let caps = query.query_map([&row.id], |row| {
                Ok(Cap {
                    danger: row.get(0)?,
                    max: row.get(1)?,
                })
            });
            score.caps = caps.of(path)?.collect::<rusqlite::Result<_>>().of(path)?;
            Some(score)
        }
    };
    let parsed = |what| move |_| damaged(path, what);
    Ok(Entry {
        id: row.id.parse().map_err(|_| damaged(path, "an identifier"))?,
        pseudonym: row
            .pseudonym
            .parse()
            .map_err(|_| damaged(path, "a pseudonym"))?,
        begun: row.begun.parse().map_err(parsed("a time"))?,
        lesson: row.lesson,
        source: row.source,
        score,
        attempt,
    })
}

fn rows<T>(
    connection: &Connection,
    query: &str,
    of: impl FnMut(&Row<'_>) -> rusqlite::Result<T>,
) -> rusqlite::Result<Vec<T>> {
    connection.prepare(query)?.query_map([], of)?.collect()
}

fn damaged(path: &Path, what: &str) -> StoreError {
    StoreError::Damaged {
        path: path.to_owned(),
        what: what.into(),
    }
}
