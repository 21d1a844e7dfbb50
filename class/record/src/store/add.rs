//! Adds attempts to the class's file.

use rusqlite::{OptionalExtension, Transaction, params};
use serde_json::Value;
use uuid::Uuid;
use vitriol_lesson::Attempt;

use super::error::In;
use super::{Store, StoreError};
use crate::Entry;
use crate::xapi::{self, Statement};

/// Result of adding an attempt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Added {
    /// The attempt is kept from now on.
    New,
    /// The attempt was kept before, and stays as it was.
    Before,
}

impl Store {
    /// Keeps an attempt, whole or not at all. Its statements wait for [`crate::lrs::send`] to the Learning Record Store of this address;
    /// statements that it has already are not sent again.
    ///
    /// An attempt of the same identifier that is kept already stays as it is, with its score.
    ///
    /// # Errors
    /// [`StoreError`], also where the identifier is another attempt's.
    pub fn add(&mut self, entry: &Entry, lrs: Option<&str>) -> Result<Added, StoreError> {
        let (class, path) = (self.class, self.path.clone());
        // JSON has no infinity, so that it could not be read again.
        let told = serde_json::to_string(&entry.attempt);
        if !told.is_ok_and(|told| serde_json::from_str::<Attempt>(&told).is_ok()) {
            return Err(StoreError::NoNumber { id: entry.id });
        }
        let change = self.change()?;
        let id = entry.id.to_string();
        let begun = format!("{:.3}", entry.begun);
        let before = change
            .query_row(
                // The time of its beginning is not compared: for a recording that is read again only the time of its file is known.
                "SELECT pseudonym = ?2 AND scene = ?3 FROM attempts WHERE attempt_id = ?1",
                params![id, entry.pseudonym.as_str(), entry.attempt.scene],
                |row| row.get::<_, bool>(0),
            )
            .optional()
            .of(&path)?;
        let added = match before {
            None => {
                insert(&change, entry, &id, &begun).of(&path)?;
                Added::New
            }
            Some(true) => Added::Before,
            Some(false) => return Err(StoreError::Taken { path, id: entry.id }),
        };
        if let Some(lrs) = lrs {
            // Statements are made of the kept attempt, so that they are the same as the first time.
            let kept = match added {
                Added::New => entry.clone(),
                Added::Before => super::read::entry(&change, &path, entry.id)?,
            };
            for statement in xapi::statements(class, &kept) {
                wait(&change, lrs, entry.id, &statement).of(&path)?;
            }
        }
        change.commit().of(&path)?;
        Ok(added)
    }
}

fn insert(change: &Transaction<'_>, entry: &Entry, id: &str, begun: &str) -> rusqlite::Result<()> {
    let attempt = &entry.attempt;
    let ending = attempt.ending.as_ref();
    let score = entry.score.as_ref();
    change.execute(
        "INSERT INTO attempts VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15)",
        params![
            id,
            entry.pseudonym.as_str(),
            begun,
            attempt.scene,
            entry.lesson,
            entry.source,
            ending.is_some(),
            entry.duration_s(),
            attempt.incidents.len() as i64,
            score.map(|score| score.raw()),
            score.map(|score| score.max()),
            ending.and_then(|it| it.hottest.as_ref()).map(|it| it.temperature_c),
            ending.map(|it| it.bench_m3),
            ending.map(|it| it.floor_m3),
            json(attempt)?.to_string(),
        ],
    )?;
    for (position, incident) in attempt.incidents.iter().enumerate() {
        let what = json(&incident.what)?;
        let text = |name: &str| what.get(name).and_then(Value::as_str);
        let number = |name: &str| what.get(name).and_then(Value::as_f64);
        let yes = |name: &str| what.get(name).and_then(Value::as_bool);
        change.execute(
            "INSERT INTO incidents VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, \
             ?19, ?20)",
            params![
                id,
                position as i64,
                entry.pseudonym.as_str(),
                incident.t_s,
                incident.until_s,
                text("kind"),
                incident.cause.name(),
                incident.cause.flask(),
                text("flask"),
                text("surface"),
                text("skin"),
                number("volume_m3"),
                number("acid"),
                number("met_acid"),
                number("temperature_c"),
                number("rate_m3_s"),
                number("limit_m3_s"),
                number("speed_m_s"),
                yes("broke"),
                yes("protected"),
            ],
        )?;
    }
    for (position, points) in score.iter().flat_map(|score| &score.points).enumerate() {
        change.execute(
            "INSERT INTO points VALUES (?1, ?2, ?3, ?4, ?5, ?6)",
            params![
                id,
                position as i64,
                entry.pseudonym.as_str(),
                points.criterion,
                points.raw,
                points.max
            ],
        )?;
    }
    for (position, cap) in score.iter().flat_map(|score| &score.caps).enumerate() {
        change.execute(
            "INSERT INTO caps VALUES (?1, ?2, ?3, ?4, ?5)",
            params![
                id,
                position as i64,
                entry.pseudonym.as_str(),
                cap.danger,
                cap.max
            ],
        )?;
    }
    Ok(())
}

/// Queues a statement, unless it waits or was sent already.
fn wait(
    change: &Transaction<'_>,
    lrs: &str,
    attempt: Uuid,
    statement: &Statement,
) -> rusqlite::Result<usize> {
    change.execute(
        "INSERT OR IGNORE INTO outbox (lrs, statement_id, attempt_id, statement) SELECT ?1, ?2, ?3, ?4 \
         WHERE NOT EXISTS (SELECT 1 FROM sent WHERE lrs = ?1 AND statement_id = ?2)",
        params![
            lrs,
            statement.id.to_string(),
            attempt.to_string(),
            json(statement)?.to_string()
        ],
    )
}

fn json(of: &impl serde::Serialize) -> rusqlite::Result<Value> {
    serde_json::to_value(of).map_err(|error| rusqlite::Error::ToSqlConversionFailure(error.into()))
}
