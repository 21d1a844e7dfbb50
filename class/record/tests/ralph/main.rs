//! Tests against a Learning Record Store and a reader by other authors: Ralph, and Python's SQLite.
#![allow(clippy::unwrap_used)]

#[path = "../common/example.rs"]
mod example;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};
use vitriol_record::lrs::{Lrs, Patience, Token, send};
use vitriol_record::store::Store;
use vitriol_record::{Cap, Keeping, Kept, Pseudonym, Score, Scored, Session, Timestamp, keep};
use vitriol_tests::ralph::{CREDENTIALS, Ralph, Server, free_port};

const EACH: u64 = 9;

fn begun() -> Timestamp {
    "2026-03-01T08:00:00Z".parse().unwrap()
}

fn scored() -> Scored {
    let mut score = Score::new(13.0, 20.0).unwrap();
    score.caps = vec![Cap {
        danger: "no-goggles".into(),
        max: 13.0,
    }];
    Scored {
        attempt: example::attempt(),
        score: Some(score),
    }
}

#[test]
fn statements_are_xapis_and_tables_are_read_by_others() {
    let Some(ralph) = Ralph::find("statements_are_xapis_and_tables_are_read_by_others") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let class = folder.path().join("class");
    let session = Session::of_recording(b"a recording", begun());
    let pseudonym: Pseudonym = "p07".parse().unwrap();
    let attempts = [scored()];
    let keeping = Keeping {
        class: &class,
        pseudonym: &pseudonym,
        session,
        lesson: Some("Verdünnen, 1. Stunde"),
        source: None,
        attempts: &attempts,
        out: Some(folder.path()),
        lrs: None,
    };
    let kept = keep(&keeping).unwrap();
    assert_eq!((kept.new, kept.before, kept.sent), (1, 0, None));
    let lines = kept.statements.unwrap();
    // The file is not overwritten; elsewhere it has the same contents once more.
    assert!(keep(&keeping).is_err());
    let other = folder.path().join("other");
    let again = keep(&Keeping {
        out: Some(&other),
        ..keeping
    });
    let Kept {
        new,
        before,
        statements,
        ..
    } = again.unwrap();
    assert_eq!((new, before), (0, 1));
    assert_eq!(
        fs::read(statements.unwrap()).unwrap(),
        fs::read(&lines).unwrap()
    );

    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/ralph/check.py");
    let [lines, class] = [&lines, &class].map(|path| path.to_str().unwrap());
    let attempt = session.attempt_id(0).to_string();
    let told = ralph.python(&script, &[lines, class, &attempt]);
    let told: Value = serde_json::from_str(&told).unwrap();
    // Began at 2 s of the run, at 8 h and as much; the incidents follow at 3 s, 4 s and so on, each 1.5 s longer, the first
    // 0.125 s long, which is 0.13 s to two places or 0.12 s.
    let statements = told["statements"].as_array().unwrap();
    let said: Vec<[&str; 3]> = statements
        .iter()
        .map(|it| ["verb", "object", "time"].map(|name| it[name].as_str().unwrap()))
        .collect();
    assert_eq!(
        said,
        [
            [
                "initialized",
                "scene/water-into-acid",
                "2026-03-01T08:00:02.000"
            ],
            [
                "interacted",
                "incident/water-into-acid",
                "2026-03-01T08:00:03.000"
            ],
            [
                "interacted",
                "incident/poured-too-fast",
                "2026-03-01T08:00:04.000"
            ],
            [
                "experienced",
                "incident/boiled-over",
                "2026-03-01T08:00:05.000"
            ],
            ["experienced", "incident/hot", "2026-03-01T08:00:06.000"],
            ["interacted", "incident/spilt", "2026-03-01T08:00:07.000"],
            ["experienced", "incident/on-skin", "2026-03-01T08:00:08.000"],
            ["interacted", "incident/dropped", "2026-03-01T08:00:09.000"],
            [
                "completed",
                "scene/water-into-acid",
                "2026-03-01T08:00:14.500"
            ],
        ]
    );
    let durations: Vec<Option<f64>> = statements
        .iter()
        .map(|it| it["duration_s"].as_f64())
        .collect();
    assert_eq!(durations[0], None);
    for (i, duration) in durations[1..8].iter().enumerate() {
        let expected = 0.125 + 0.5 * i as f64;
        assert!(
            (duration.unwrap() - expected).abs() <= 0.005 + 1e-9,
            "{durations:?}"
        );
    }
    let last = &statements[8];
    assert_eq!(last["duration_s"], 12.5);
    assert_eq!(last["score"], json!([0.65, 13.0, 0.0, 20.0]));
    assert_eq!(
        (&last["success"], &last["completion"]),
        (&json!(null), &json!(true))
    );
    assert!(statements.iter().all(|it| it["name"] == "p07"));
    assert_eq!(told["students"], json!([["p07", 1, 7, 0.65]]));
    assert_eq!(told["spilt"], json!([["bench", 1e-6]]));
}

/// The identifiers of the statements that Ralph holds, in its order.
fn stored(folder: &Path) -> Vec<String> {
    let text = fs::read_to_string(Server::file(folder)).unwrap();
    let id = |line: &str| {
        let statement: Value = serde_json::from_str(line).unwrap();
        statement["id"].as_str().unwrap().to_owned()
    };
    text.lines().map(id).collect()
}

#[test]
fn nothing_is_lost_while_the_store_is_away_and_nothing_doubled() {
    let test = "nothing_is_lost_while_the_store_is_away_and_nothing_doubled";
    let Some(ralph) = Ralph::find(test) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let [class, copy, data] = ["class", "copy", "data"].map(at);
    fs::create_dir(&data).unwrap();
    let token = |name: &str, text: &str| {
        fs::write(at(name), text).unwrap();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            fs::set_permissions(at(name), fs::Permissions::from_mode(0o600)).unwrap();
        }
        Token::held(&at(name), text).unwrap()
    };
    let port = free_port();
    let mut lrs = Lrs {
        endpoint: format!("http://127.0.0.1:{port}/xAPI").parse().unwrap(),
        token: token("token", CREDENTIALS),
        patience: Patience {
            tries: 2,
            pause: Duration::from_millis(1),
            longest: Duration::from_millis(20),
            ..Patience::default()
        },
    };
    let pseudonym: Pseudonym = "p07".parse().unwrap();
    let attempts = vec![scored(); 7];
    let keeping = |content: &[u8], lrs: &Lrs| {
        let kept = keep(&Keeping {
            class: &class,
            pseudonym: &pseudonym,
            session: Session::of_recording(content, begun()),
            lesson: None,
            source: None,
            attempts: &attempts,
            out: None,
            lrs: Some(lrs),
        });
        kept.unwrap().sent.unwrap()
    };
    let all = EACH * attempts.len() as u64;

    // No server is there.
    let sent = keeping(b"first", &lrs);
    assert_eq!((sent.delivered, sent.waiting), (0, all));
    assert!(sent.stopped.is_some());

    // A server that does not accept our token.
    let server = ralph.serve(&data, Some(port));
    let stranger = Lrs {
        token: token("other", "vitriol:guessed"),
        ..lrs.clone()
    };
    let mut store = Store::open_existing(&class).unwrap();
    let sent = send(&mut store, &stranger).unwrap();
    assert_eq!((sent.delivered, sent.waiting), (0, all));
    assert!(sent.stopped.unwrap().contains("401"));
    assert!(!Server::file(&data).exists());

    // Two batches arrived, and their confirmations are lost.
    fs::copy(&class, &copy).unwrap();
    let sent = send(&mut store, &lrs).unwrap();
    assert_eq!((sent.delivered, sent.waiting, sent.stopped), (all, 0, None));
    assert_eq!(sent.refused, []);
    let first = stored(&data);
    assert_eq!(first.len() as u64, all);
    drop(store);
    fs::copy(&copy, &class).unwrap();

    // The server is killed, and there are more statements; it restarts while requests are repeated.
    drop(server);
    assert!(keeping(b"second", &lrs).stopped.is_some());
    lrs.patience.tries = u32::MAX;
    let class = class.clone();
    let sending = thread::spawn(move || {
        let mut store = Store::open_existing(&class).unwrap();
        send(&mut store, &lrs).unwrap()
    });
    let _server = ralph.serve(&data, Some(port));
    let sent = sending.join().unwrap();
    assert_eq!(
        (sent.delivered, sent.waiting, sent.stopped),
        (2 * all, 0, None)
    );
    let second = stored(&data);
    assert_eq!(second[..first.len()], first);
    assert_eq!(second.len() as u64, 2 * all);
    assert_eq!(second.iter().collect::<BTreeSet<_>>().len() as u64, 2 * all);
}
