//! The attempts of a class over weeks: one file of SQLite, which several programs may read and write at a time.
//!
//! Its journal is SQLite's rollback journal and not the write-ahead log: that one keeps the last writes in two more files, with deleted
//! data still in them, and does not work on a shared folder. A transaction is on the disk when it returns; an unfinished one of a killed
//! process is rolled back by the program that opens the file next.

mod add;
mod error;
mod forget;
mod outbox;
mod read;
mod schema;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, OpenFlags, Transaction, TransactionBehavior};
use uuid::Uuid;

pub use add::Added;
pub use error::StoreError;
pub(crate) use forget::without_home;
pub use forget::{Forgotten, Left, SentTo};
pub use outbox::Waiting;

use error::In;
use read::parsed;

/// How long to wait for another program that writes. Our choice: a transaction takes milliseconds.
const PATIENCE: Duration = Duration::from_secs(10);

/// The default path of the class's file: in the user's folder for data. `None` where the system has no such folder.
pub fn default_path() -> Option<PathBuf> {
    dirs::data_dir().map(|folder| folder.join("vitriol").join("class.sqlite"))
}

/// An open file of a class.
#[derive(Debug)]
pub struct Store {
    connection: Connection,
    path: PathBuf,
    class: Uuid,
}

/// Makes the file where there is none, readable by its owner alone: SQLite's journal has the same rights then.
fn own(path: &Path) -> std::io::Result<()> {
    let mut options = std::fs::OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    match options.open(path) {
        Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => Ok(()),
        made => made.map(drop),
    }
}

impl Store {
    /// Opens the file, and makes it and its folder where there is none.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
        folder
            .and_then(|()| own(path))
            .map_err(|source| StoreError::Folder {
                path: path.to_owned(),
                source,
            })?;
        Self::with(path, OpenFlags::SQLITE_OPEN_CREATE)
    }

    /// Opens a file that exists.
    ///
    /// # Errors
    /// [`StoreError`], also where there is none.
    pub fn open_existing(path: &Path) -> Result<Self, StoreError> {
        // What may not be looked at may be there: opening it gives the cause.
        if matches!(path.try_exists(), Ok(false)) {
            return Err(StoreError::Missing {
                path: path.to_owned(),
            });
        }
        Self::with(path, OpenFlags::empty())
    }

    fn with(path: &Path, flags: OpenFlags) -> Result<Self, StoreError> {
        let flags = flags | OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let connection = Connection::open_with_flags(path, flags).of(path)?;
        connection.busy_timeout(PATIENCE).of(path)?;
        let set = |name, value: &str| connection.pragma_update(None, name, value).of(path);
        set("foreign_keys", "ON")?;
        // Deleted data are overwritten with zeros.
        set("secure_delete", "ON")?;
        // The folder is synchronised too, so that no journal comes back after a loss of power.
        set("synchronous", "EXTRA")?;
        let mut store = Self {
            connection,
            path: path.to_owned(),
            class: Uuid::nil(),
        };
        store.class = store.prepare()?;
        Ok(store)
    }

    /// Makes the tables where there are none, brings older ones to this version, and reads the class's identifier.
    fn prepare(&mut self) -> Result<Uuid, StoreError> {
        let path = self.path.clone();
        let number = |connection: &Connection, name| {
            connection.pragma_query_value(None, name, |row| row.get::<_, i32>(0))
        };
        if number(&self.connection, "user_version").of(&path)? == 0 {
            let change = self.change()?;
            // Another program may have been first.
            let tables: i64 = change
                .query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))
                .of(&path)?;
            if tables == 0 {
                change
                    .pragma_update(None, "application_id", schema::APPLICATION)
                    .of(&path)?;
                change
                    .pragma_update(None, "user_version", schema::VERSION)
                    .of(&path)?;
                change.execute_batch(schema::TABLES).of(&path)?;
                change.execute_batch(schema::LATER).of(&path)?;
                let class = Uuid::new_v4().to_string();
                change
                    .execute("INSERT INTO class VALUES (?1)", [class])
                    .of(&path)?;
            }
            change.commit().of(&path)?;
        }
        if number(&self.connection, "application_id").of(&path)? != schema::APPLICATION {
            return Err(StoreError::NotOurs { path });
        }
        let older = 1..schema::VERSION;
        if older.contains(&number(&self.connection, "user_version").of(&path)?) {
            let change = self.change()?;
            // Here too another program may have been first.
            if older.contains(&number(&change, "user_version").of(&path)?) {
                change.execute_batch(schema::WITHOUT_PASSED).of(&path)?;
                change.execute_batch(schema::LATER).of(&path)?;
                change
                    .pragma_update(None, "user_version", schema::VERSION)
                    .of(&path)?;
            }
            change.commit().of(&path)?;
        }
        let found = number(&self.connection, "user_version").of(&path)?;
        if found != schema::VERSION {
            return Err(StoreError::Newer {
                path,
                found,
                known: schema::VERSION,
            });
        }
        let class = self
            .connection
            .query_row("SELECT id FROM class", [], |row| row.get(0));
        let class: String = class.of(&path)?;
        parsed(&path, &class, "the class's identifier")
    }

    /// The class's identifier, made with the file.
    pub fn class(&self) -> Uuid {
        self.class
    }

    /// A transaction that writes: it waits for its turn here, and not half-way.
    fn change(&mut self) -> Result<Transaction<'_>, StoreError> {
        self.connection
            .transaction_with_behavior(TransactionBehavior::Immediate)
            .of(&self.path)
    }
}
