//! The programs that an instructor's browser meets: a session whose hub is elsewhere, and a replay that it watches.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{ChildStderr, Command, Stdio};

use crate::vr::common::scene;
use serde_json::Value;
use vitriol_tests::devtools::Tab;
use vitriol_tests::program::{Kept, words};
use vitriol_tests::wait::until;

/// The program at work.
struct Running {
    child: Kept,
    stderr: BufReader<ChildStderr>,
}

impl Running {
    fn start(folder: &Path, line: &str) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_vitriol"))
            .args(words(line))
            .current_dir(folder)
            .env("XDG_DATA_HOME", folder.join("data"))
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let stderr = BufReader::new(child.stderr.take().unwrap());
        let child = Kept(child);
        Self { child, stderr }
    }

    /// Where a browser comes in, as its standard error says.
    fn console(&mut self) -> String {
        let mut said = String::new();
        loop {
            let mut line = String::new();
            let length = self.stderr.read_line(&mut line).unwrap();
            assert!(length > 0, "no console: {said}");
            said += &line;
            let told: Value = serde_json::from_str(&line).unwrap_or_default();
            if let Some(address) = told["console"].as_str() {
                return address.to_owned();
            }
        }
    }

    /// The JSON object that it prints first, which may not be its last word.
    fn object(&mut self) -> Value {
        let stdout = self.child.stdout.as_mut().unwrap();
        let mut objects = serde_json::Deserializer::from_reader(stdout).into_iter();
        objects.next().unwrap().unwrap()
    }

    /// Waits for its end: the exit code, and what it said last.
    fn end(mut self) -> (Option<i32>, String) {
        let ended = until("the program ends", || self.child.try_wait().unwrap());
        let mut said = String::new();
        self.stderr.read_to_string(&mut said).unwrap();
        (ended.code(), said)
    }
}

fn at(id: &str) -> String {
    format!("document.getElementById('{id}')")
}

/// `vitriol hub` and a student's `vitriol vr --hub`: the page shows the student by name and view, in the hub's language, and ends the session.
#[test]
fn a_class_has_one_console() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let Some(mut tab) = Tab::new() else { return };
    let mut hub = Running::start(folder, "hub --json --listen 127.0.0.1:0 --language de");
    let told = hub.object();
    std::fs::write(folder.join("hub.txt"), told["students"].as_str().unwrap()).unwrap();
    tab.go(told["console"].as_str().unwrap());
    tab.until(&format!("!{}.hidden", at("class")));

    scene(folder);
    let small = "vr --json --stand-in two-flasks --size 96x64 --rate 10 --no-mirror --fixed --preset fast --scene small.toml";
    let session = Running::start(folder, &format!("{small} --hub hub.txt --name Ada"));
    tab.until("[...document.querySelectorAll('#students button')].find((it) => it.textContent.includes('Ada'))?.click() ?? !document.getElementById('student').hidden");
    tab.until(&format!("Number({}.dataset.drawn) > 2", at("picture")));
    assert_eq!(tab.eval(&format!("{}.textContent", at("name"))), "Ada");
    tab.eval(&format!("{}.click()", at("end-now")));
    let (code, said) = session.end();
    assert_eq!(code, Some(0), "{said}");
    // What was done stays on the page, whose hub goes on.
    tab.until(&format!("!{}.hidden", at("summary")));
    let kept = tab.eval(&format!("{}.textContent", at("summary-recording")));
    assert_eq!(kept, "Sie wurde nicht aufgenommen.");
    assert!(tab.complaints().is_empty());
}

/// A replay is shown while it runs, in the language that is asked for, is held and let go, and offers nothing that would change it.
#[test]
fn a_replay_is_watched_and_held() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let Some(mut tab) = Tab::new() else { return };
    scene(folder);
    let mut replay = Running::start(
        folder,
        "replay --json two-flasks --live --language es --seconds 1 --scene small.toml --out out",
    );
    tab.go(&replay.console());
    tab.until(&format!("Number({}.dataset.drawn) > 0", at("picture")));
    assert_eq!(tab.eval("document.documentElement.lang"), "es");
    assert_eq!(tab.eval(&format!("{}.textContent", at("pause"))), "Pausa");
    assert_eq!(tab.eval(&format!("{}.hidden", at("send"))), true);
    tab.eval(&format!("{}.click()", at("pause")));
    tab.until(&format!("{}.textContent === 'Reanudar'", at("pause")));
    let time = format!("{}.textContent", at("time"));
    let held = tab.eval(&time);
    std::thread::sleep(std::time::Duration::from_millis(500));
    assert_eq!(tab.eval(&time), held);
    assert_ne!(held, "1,0 s");
    // The glass from close by is drawn while time is held, too.
    tab.eval(&format!("{}.click()", at("close-up")));
    tab.until(&format!(
        "{}.textContent === 'JPEG, 960 × 540'",
        at("stream")
    ));
    // So is the film's last picture, for a page that comes back to it.
    tab.eval(&format!("{}.click()", at("close-up")));
    let drawn = format!("Number({}.dataset.drawn)", at("picture"));
    let before = tab.eval(&drawn).as_f64().unwrap();
    tab.until(&format!("{drawn} > {before}"));
    tab.eval(&format!("{}.click()", at("pause")));
    tab.until(&format!("{time} === '1,0 s'"));
    let report = replay.object();
    let (code, said) = replay.end();
    assert_eq!(code, Some(0), "{said}");
    assert_eq!(report["frames"], 90);
    assert!(folder.join("out/report.html").exists());
}

/// What goes together is said.
#[test]
fn a_console_that_cannot_be_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (line, word) in [
        ("replay two-flasks --listen 127.0.0.1:0", "--live"),
        ("hub --listen 203.0.113.1:1", "cannot listen"),
        (
            "vr --stand-in two-flasks --hub nonsense",
            "no hub's address",
        ),
        (
            "vr --stand-in two-flasks --hub hub.txt",
            "there is no such file",
        ),
        ("vr --no-console --listen 8470", "--no-console"),
    ] {
        let (code, said) = Running::start(folder.path(), line).end();
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(word), "{said}");
    }
}
