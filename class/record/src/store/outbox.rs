//! Statements that wait to be sent.

use rusqlite::params;
use uuid::Uuid;

use super::error::In;
use super::read::parsed;
use super::{Store, StoreError};

/// A statement that waits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Waiting {
    /// Its place in the outbox.
    number: i64,
    /// The statement's identifier.
    pub id: Uuid,
    /// The statement, JSON.
    pub statement: String,
}

impl Store {
    /// How many statements wait for the Learning Record Store of this address.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn waiting(&self, lrs: &str) -> Result<u64, StoreError> {
        let query = "SELECT count(*) FROM outbox WHERE lrs = ?1";
        let count = self
            .connection
            .query_row(query, [lrs], |row| row.get::<_, i64>(0));
        Ok(count.of(&self.path)?.unsigned_abs())
    }

    /// The outbox numbers of waiting statements: first those that were never refused, in the order in which they came.
    pub(crate) fn numbers(&self, lrs: &str) -> Result<Vec<i64>, StoreError> {
        let query = "SELECT number FROM outbox WHERE lrs = ?1 ORDER BY refused IS NOT NULL, number";
        let mut query = self.connection.prepare(query).of(&self.path)?;
        let numbers = query.query_map([lrs], |row| row.get(0)).of(&self.path)?;
        numbers.collect::<rusqlite::Result<_>>().of(&self.path)
    }

    /// The statements with these numbers that still wait: another program may have sent or deleted some.
    pub(crate) fn at(&self, numbers: &[i64]) -> Result<Vec<Waiting>, StoreError> {
        let query = "SELECT statement_id, statement FROM outbox WHERE number = ?1";
        let mut query = self.connection.prepare(query).of(&self.path)?;
        let mut found = Vec::with_capacity(numbers.len());
        for &number in numbers {
            let row = query.query_row([number], |row| {
                Ok((row.get::<_, String>(0)?, row.get::<_, String>(1)?))
            });
            let (id, statement) = match row {
                Err(rusqlite::Error::QueryReturnedNoRows) => continue,
                row => row.of(&self.path)?,
            };
            let id = parsed(&self.path, &id, "an identifier")?;
            found.push(Waiting {
                number,
                id,
                statement,
            });
        }
        Ok(found)
    }

    /// Marks statements as delivered: they wait no more.
    pub(crate) fn delivered(&mut self, statements: &[Waiting]) -> Result<(), StoreError> {
        let path = self.path.clone();
        let change = self.change()?;
        for waiting in statements {
            // Inserts nothing where the attempt was deleted meanwhile.
            let keep = "INSERT OR IGNORE INTO sent SELECT lrs, statement_id, attempt_id FROM outbox \
                        WHERE number = ?1 AND statement_id = ?2";
            let which = params![waiting.number, waiting.id.to_string()];
            change.execute(keep, which).of(&path)?;
            let delete = "DELETE FROM outbox WHERE number = ?1 AND statement_id = ?2";
            change.execute(delete, which).of(&path)?;
        }
        change.commit().of(&path)
    }

    /// Marks a statement as refused by the Learning Record Store, for the reason `why`. It is kept.
    pub(crate) fn refused(&mut self, waiting: &Waiting, why: &str) -> Result<(), StoreError> {
        let path = self.path.clone();
        let change = self.change()?;
        let update = "UPDATE outbox SET refused = ?3 WHERE number = ?1 AND statement_id = ?2";
        change
            .execute(update, params![waiting.number, waiting.id.to_string(), why])
            .of(&path)?;
        change.commit().of(&path)
    }
}
