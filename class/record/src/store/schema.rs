//! The tables. Names and units are readable as they are in a spreadsheet.

/// "Vitr", by which SQLite's header distinguishes the file from other programs' (application_id).
pub(super) const APPLICATION: i32 = 0x5669_7472;

/// Version of these tables, in the file's `user_version`. A change of them raises it. A file of an older version gets [`WITHOUT_PASSED`],
/// then [`LATER`], when it is opened: version 1 had no caps.
pub(super) const VERSION: i32 = 3;

/// `class` has one row. `attempts` and `students` are for spreadsheets; `attempt` holds all of an attempt as JSON. Rows that belong to an
/// attempt are deleted with it.
pub(super) const TABLES: &str = "
CREATE TABLE class (
    id TEXT NOT NULL
) STRICT;

CREATE TABLE attempts (
    attempt_id TEXT NOT NULL PRIMARY KEY,
    pseudonym TEXT NOT NULL,
    begun TEXT NOT NULL,
    scene TEXT NOT NULL,
    lesson TEXT,
    source TEXT,
    finished INTEGER NOT NULL,
    duration_s REAL NOT NULL,
    incidents INTEGER NOT NULL,
    points REAL,
    points_max REAL,
    hottest_c REAL,
    bench_m3 REAL,
    floor_m3 REAL,
    attempt TEXT NOT NULL
) STRICT;
CREATE INDEX attempts_of ON attempts (pseudonym, begun);

CREATE TABLE incidents (
    attempt_id TEXT NOT NULL REFERENCES attempts ON DELETE CASCADE,
    position INTEGER NOT NULL,
    pseudonym TEXT NOT NULL,
    time_s REAL,
    until_s REAL,
    kind TEXT NOT NULL,
    cause TEXT NOT NULL,
    cause_flask TEXT,
    flask TEXT,
    surface TEXT,
    skin TEXT,
    volume_m3 REAL,
    acid REAL,
    met_acid REAL,
    temperature_c REAL,
    rate_m3_s REAL,
    limit_m3_s REAL,
    speed_m_s REAL,
    broke INTEGER,
    protected INTEGER,
    PRIMARY KEY (attempt_id, position)
) STRICT;

CREATE TABLE points (
    attempt_id TEXT NOT NULL REFERENCES attempts ON DELETE CASCADE,
    position INTEGER NOT NULL,
    pseudonym TEXT NOT NULL,
    criterion TEXT NOT NULL,
    points REAL NOT NULL,
    points_max REAL NOT NULL,
    PRIMARY KEY (attempt_id, position)
) STRICT;

CREATE TABLE files (
    path TEXT NOT NULL PRIMARY KEY,
    pseudonym TEXT NOT NULL
) STRICT;

CREATE TABLE outbox (
    number INTEGER PRIMARY KEY,
    lrs TEXT NOT NULL,
    statement_id TEXT NOT NULL,
    attempt_id TEXT NOT NULL REFERENCES attempts ON DELETE CASCADE,
    statement TEXT NOT NULL,
    refused TEXT,
    UNIQUE (lrs, statement_id)
) STRICT;

CREATE TABLE sent (
    lrs TEXT NOT NULL,
    statement_id TEXT NOT NULL,
    attempt_id TEXT NOT NULL REFERENCES attempts ON DELETE CASCADE,
    PRIMARY KEY (lrs, statement_id)
) STRICT;
";

/// What later versions changed: the table of caps (the danger in a word and the most points that it leaves, the lowest first), and the view.
pub(super) const LATER: &str = "
CREATE TABLE IF NOT EXISTS caps (
    attempt_id TEXT NOT NULL REFERENCES attempts ON DELETE CASCADE,
    position INTEGER NOT NULL,
    pseudonym TEXT NOT NULL,
    danger TEXT NOT NULL,
    points_max REAL NOT NULL,
    PRIMARY KEY (attempt_id, position)
) STRICT;

CREATE VIEW students AS
SELECT
    pseudonym,
    count(*) AS attempts,
    sum(finished) AS finished,
    sum(incidents) AS incidents,
    max(points / points_max) AS best_score,
    min(begun) AS first_begun,
    max(begun) AS last_begun
FROM attempts GROUP BY pseudonym ORDER BY pseudonym;
";

/// Takes out what nothing ever set: a column, and the sum of it in the view.
pub(super) const WITHOUT_PASSED: &str = "
DROP VIEW IF EXISTS students;
ALTER TABLE attempts DROP COLUMN passed;
";
