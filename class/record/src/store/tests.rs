//! The class's file: added attempts are there, after a kill too, and deleted ones are in none of its bytes.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;

use uuid::Uuid;

use super::schema::VERSION;
use super::{Added, SentTo, Store, StoreError};
use crate::{Cap, Entry, Points, Score, example};

/// In the environment of a child process, the file that it writes until it is killed.
const CHILD: &str = "VITRIOL_RECORD_TEST_CHILD";

const LRS: &str = "https://lrs.example.org/xAPI";

fn entry(pseudonym: &str, index: u128) -> Entry {
    Entry {
        id: Uuid::from_u128(index),
        pseudonym: pseudonym.parse().unwrap(),
        begun: "2026-03-01T08:00:00.25Z".parse().unwrap(),
        lesson: Some("Dilution 1".into()),
        source: Some(format!("{pseudonym}.mcap")),
        score: None,
        attempt: example::attempt(),
    }
}

fn scored(mut entry: Entry) -> Entry {
    let mut score = Score::new(13.0, 20.0).unwrap();
    score.points = vec![Points {
        criterion: "order".into(),
        raw: 3.0,
        max: 10.0,
    }];
    let cap = |danger: &str, max| Cap {
        danger: danger.into(),
        max,
    };
    score.caps = vec![cap("acid-on-skin", 13.0), cap("no-goggles", 16.0)];
    entry.score = Some(score);
    entry
}

/// The folder's files that contain these bytes.
fn holding(folder: &Path, bytes: &str) -> Vec<String> {
    let files = fs::read_dir(folder).unwrap().map(|file| file.unwrap());
    let holds = |path: &Path| {
        let content = fs::read(path).unwrap();
        content
            .windows(bytes.len())
            .any(|part| part == bytes.as_bytes())
    };
    let files = files.filter(|file| holds(&file.path()));
    files
        .map(|file| file.file_name().into_string().unwrap())
        .collect()
}

/// The view for spreadsheets: of each student the attempts, those whose end is kept, the best score and the last beginning.
fn students(store: &Store) -> Vec<(String, i64, i64, Option<f64>, String)> {
    let query = "SELECT pseudonym, attempts, finished, best_score, last_begun FROM students";
    let mut query = store.connection.prepare(query).unwrap();
    let rows = query.query_map([], |row| {
        let (name, begun) = (row.get(0)?, row.get(4)?);
        Ok((name, row.get(1)?, row.get(2)?, row.get(3)?, begun))
    });
    rows.unwrap().map(Result::unwrap).collect()
}

#[test]
fn what_was_added_is_there_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/class.sqlite");
    let [first, mut second] = [scored(entry("p07", 1)), entry("p07", 2)];
    second.attempt.ending = None;
    second.attempt.incidents.truncate(1);
    let mut store = Store::open(&path).unwrap();
    assert_eq!(store.add(&first, None).unwrap(), Added::New);
    assert_eq!(store.add(&second, None).unwrap(), Added::New);
    assert_eq!(store.add(&entry("p08", 3), None).unwrap(), Added::New);
    // With another score it is the same attempt, and stays.
    assert_eq!(
        store.add(&entry("p07", 1), Some(LRS)).unwrap(),
        Added::Before
    );
    let other = store.add(&entry("p08", 1), None).unwrap_err();
    assert!(matches!(other, StoreError::Taken { .. }), "{other}");
    let class = store.class();
    drop(store);

    let store = Store::open_existing(&path).unwrap();
    assert_eq!(store.class(), class);
    for kept in [&first, &second] {
        assert_eq!(store.attempt(kept.id).unwrap(), *kept);
    }
    // Statements are sent as kept: with the attempt's score.
    assert_eq!(
        store.waiting(LRS).unwrap(),
        2 + first.attempt.incidents.len() as u64
    );
    let waiting = store.at(&store.numbers(LRS).unwrap()).unwrap();
    let last = &waiting.last().unwrap().statement;
    assert!(last.contains(r#""scaled":0.65"#), "{last}");
    // And with what capped it, under keys of our own.
    for part in [
        r#"#key/caps":["acid-on-skin","no-goggles"]"#,
        r#"#key/cap_points":13.0"#,
    ] {
        assert!(last.contains(part), "{part}: {last}");
    }

    let begun = "2026-03-01T08:00:00.250Z".to_owned();
    let expected = [
        ("p07".to_owned(), 2_i64, 1_i64, Some(0.65), begun.clone()),
        ("p08".to_owned(), 1, 1, None, begun),
    ];
    assert_eq!(students(&store), expected);
    let of_kind = |kind: &str| -> i64 {
        let query = "SELECT count(*) FROM incidents WHERE pseudonym = 'p07' AND kind = ?1";
        let count = store.connection.query_row(query, [kind], |row| row.get(0));
        count.unwrap()
    };
    assert_eq!([of_kind("water-into-acid"), of_kind("hot")], [2, 1]);
}

#[test]
fn an_amount_that_is_no_number_is_refused_whole() {
    let folder = tempfile::tempdir().unwrap();
    let mut store = Store::open(&folder.path().join("class")).unwrap();
    let mut wild = entry("p07", 1);
    wild.attempt.incidents[3].t_s = f64::NAN;
    let error = store.add(&wild, None).unwrap_err();
    assert!(matches!(error, StoreError::NoNumber { .. }), "{error}");
    assert!(students(&store).is_empty());
}

#[test]
fn other_files_are_refused_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let missing = Store::open_existing(&path("missing")).unwrap_err();
    assert!(matches!(missing, StoreError::Missing { .. }), "{missing}");
    assert!(!path("missing").exists());

    fs::write(path("text"), "x".repeat(5000)).unwrap();
    let other = rusqlite::Connection::open(path("other")).unwrap();
    other
        .execute_batch("CREATE TABLE attempts (a); INSERT INTO attempts VALUES (1)")
        .unwrap();
    drop(other);
    let newer = Store::open(&path("newer")).unwrap();
    newer
        .connection
        .pragma_update(None, "user_version", VERSION + 1)
        .unwrap();
    drop(newer);
    for name in ["text", "other", "newer"] {
        let before = fs::read(path(name)).unwrap();
        let error = Store::open(&path(name)).unwrap_err();
        let newer = matches!(error, StoreError::Newer { found, .. } if found == VERSION + 1);
        assert_eq!(newer, name == "newer", "{error}");
        assert!(
            newer || matches!(error, StoreError::NotOurs { .. }),
            "{error}"
        );
        assert_eq!(fs::read(path(name)).unwrap(), before, "{name}");
    }
}

/// What files of versions 1 and 2 have besides: a column that nothing set, and its sum.
const PASSED: &str = "
DROP VIEW students;
ALTER TABLE attempts ADD COLUMN passed INTEGER;
CREATE VIEW students AS SELECT pseudonym, sum(passed) AS passed FROM attempts GROUP BY pseudonym;
";

/// The columns of a table or view.
fn columns(store: &Store, table: &str) -> Vec<String> {
    let query = "SELECT name FROM pragma_table_info(?1)";
    let mut query = store.connection.prepare(query).unwrap();
    let rows = query.query_map([table], |row| row.get::<_, String>(0));
    rows.unwrap().map(Result::unwrap).collect()
}

/// An older file gets the columns of a new one, and keeps what it has.
#[test]
fn an_older_file_becomes_as_a_new_one() {
    let folder = tempfile::tempdir().unwrap();
    let new = Store::open(&folder.path().join("new")).unwrap();
    for version in [1_i32, 2] {
        let path = folder.path().join(version.to_string());
        let mut store = Store::open(&path).unwrap();
        store.add(&entry("p07", 1), None).unwrap();
        store.connection.execute_batch(PASSED).unwrap();
        if version == 1 {
            store.connection.execute_batch("DROP TABLE caps").unwrap();
        }
        store
            .connection
            .pragma_update(None, "user_version", version)
            .unwrap();
        drop(store);

        let mut store = Store::open_existing(&path).unwrap();
        for table in ["attempts", "caps", "students"] {
            let [old, new] = [&store, &new].map(|it| columns(it, table));
            assert_eq!(old, new, "version {version}: {table}");
            assert!(!old.is_empty(), "{table}");
        }
        let second = scored(entry("p07", 2));
        store.add(&second, None).unwrap();
        for kept in [entry("p07", 1), second] {
            assert_eq!(store.attempt(kept.id).unwrap(), kept);
        }
        assert_eq!(students(&store)[0].1, 2);
        drop(store);
        // Only once.
        assert_eq!(students(&Store::open_existing(&path).unwrap())[0].1, 2);
    }
}

#[test]
fn several_write_a_new_file_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("class");
    let writers: Vec<_> = (0..4)
        .map(|writer| {
            let path = path.clone();
            thread::spawn(move || {
                let mut store = Store::open(&path).unwrap();
                for i in 0..5 {
                    // The last of each is the same.
                    let id = if i == 4 { 99 } else { 10 * writer + i };
                    store.add(&entry("p07", id), None).unwrap();
                }
                store.class()
            })
        })
        .collect();
    let classes: Vec<Uuid> = writers.into_iter().map(|it| it.join().unwrap()).collect();
    assert!(
        classes.iter().all(|class| *class == classes[0]),
        "{classes:?}"
    );
    let students = students(&Store::open(&path).unwrap());
    assert_eq!(students[0].1, 4 * 4 + 1);
}

#[test]
fn what_is_forgotten_is_in_no_byte() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("class");
    let mut store = Store::open(&path).unwrap();
    for i in 0..20 {
        let name = if i % 2 == 0 { "Zebra-Quagga" } else { "Otter" };
        store.add(&scored(entry(name, i)), Some(LRS)).unwrap();
    }
    let numbers = store.numbers(LRS).unwrap();
    let batch = store.at(&numbers[..9]).unwrap();
    store.delivered(&batch).unwrap();
    assert_eq!(holding(folder.path(), "Zebra-Quagga"), ["class"]);

    let [ours, changed, gone] = ["ours", "changed", "gone"].map(|name| folder.path().join(name));
    let name = |name| format!("{{\"actor\":{{\"account\":{{\"name\":\"{name}\"}}}}}}\n");
    fs::write(&ours, name("Zebra-Quagga")).unwrap();
    fs::write(&changed, name("Zebra-Quagga") + &name("Otter")).unwrap();
    let zebra = "Zebra-Quagga".parse().unwrap();
    for file in [&ours, &changed, &gone] {
        store.add_file(&zebra, file).unwrap();
    }

    let forgotten = store.forget(&zebra).unwrap();
    let incidents = example::incidents().len() as u64;
    assert_eq!(
        (forgotten.attempts, forgotten.incidents),
        (10, 10 * incidents)
    );
    // The first attempt's were sent.
    let lrs = LRS.to_owned();
    assert_eq!(forgotten.sent, [SentTo { lrs, statements: 9 }]);
    assert_eq!(forgotten.waiting, 9 * (incidents + 2));
    assert_eq!(forgotten.recordings, ["Zebra-Quagga.mcap"]);
    assert_eq!(forgotten.files, [ours.display().to_string()]);
    assert_eq!(forgotten.left.len(), 1);
    assert_eq!(forgotten.left[0].path, changed.display().to_string());
    fs::remove_file(&changed).unwrap();
    // Also while it is open, and in no journal beside it.
    assert_eq!(holding(folder.path(), "Zebra-Quagga"), [""; 0]);
    assert_eq!(store.waiting(LRS).unwrap(), 10 * (incidents + 2));
    let left = students(&store);
    assert_eq!((left[0].0.as_str(), left[0].1), ("Otter", 10));
    assert_eq!(store.forget(&zebra).unwrap(), super::Forgotten::default());
}

/// Not a test of its own: the work of a child process until it is killed.
#[test]
fn child_that_is_killed() {
    let Ok(path) = std::env::var(CHILD) else {
        return;
    };
    let mut store = Store::open(Path::new(&path)).unwrap();
    for i in 0..3 {
        store.add(&entry("p07", i), Some(LRS)).unwrap();
        println!("\nkept");
    }
    // Too many rows for the memory that it has for them: pages are in the file before the transaction ends.
    store
        .connection
        .pragma_update(None, "cache_size", 2)
        .unwrap();
    let change = store.change().unwrap();
    let insert = "INSERT INTO points VALUES (?1, ?2, 'p07', ?3, 1, 2)";
    let (id, text) = (Uuid::from_u128(0).to_string(), "x".repeat(2000));
    for i in 0..200 {
        change
            .execute(insert, rusqlite::params![id, i, text])
            .unwrap();
    }
    change.execute("DELETE FROM attempts", []).unwrap();
    println!("\nhalf-way");
    thread::park();
}

/// The child of that test, once it has printed `half-way`.
fn child(path: &Path) -> (Child, usize) {
    let name = concat!(module_path!(), "::child_that_is_killed");
    let name = name.split_once("::").unwrap().1;
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", name, "--nocapture"])
        .env(CHILD, path)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let lines = lines
        .map(Result::unwrap)
        .take_while(|line| line != "half-way");
    let kept = lines.filter(|line| line == "kept").count();
    (child, kept)
}

#[test]
fn a_killed_process_loses_no_finished_attempt() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("class");
    let (mut killed, kept) = child(&path);
    let journal = folder.path().join("class-journal");
    assert!(journal.exists(), "it was not killed half-way");
    killed.kill().unwrap();
    killed.wait().unwrap();

    let mut store = Store::open(&path).unwrap();
    assert_eq!((kept, students(&store)[0].1), (3, 3));
    for i in 0..3 {
        let attempt = store.attempt(Uuid::from_u128(i)).unwrap();
        assert_eq!(attempt, entry("p07", i));
    }
    assert_eq!(store.waiting(LRS).unwrap(), 3 * 9);
    let check = |row: &rusqlite::Row<'_>| row.get::<_, String>(0);
    let check = store
        .connection
        .query_row("PRAGMA integrity_check", [], check);
    assert_eq!(check.unwrap(), "ok");
    // Half-written data are deleted with the rest.
    store.forget(&"p07".parse().unwrap()).unwrap();
    drop(store);
    assert_eq!(holding(folder.path(), "p07"), [""; 0]);
    let files = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(files, 1, "it is one file after a clean end");
}

/// A new file is readable by its owner alone; one that somebody has shared stays so.
#[cfg(unix)]
#[test]
fn a_new_file_is_its_users_alone() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("class.sqlite");
    let mode = || path.metadata().unwrap().permissions().mode() & 0o777;
    drop(Store::open(&path).unwrap());
    assert_eq!(mode(), 0o600);
    fs::set_permissions(&path, fs::Permissions::from_mode(0o660)).unwrap();
    drop(Store::open(&path).unwrap());
    assert_eq!(mode(), 0o660);
}
