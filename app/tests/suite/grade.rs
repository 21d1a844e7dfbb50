//! A class, offline: what is read in recordings, what is refused, how a call goes on where another ended, and what a simulation
//! says to it, with an experiment whose answers are known.

mod lesson;
mod teacher;
mod toy;

use std::fs;
use std::path::Path;
use std::process::{Command as Process, Stdio};

use crate::VITRIOL;
use vitriol::command::grade::{Status, Verdict};
use vitriol_lesson::{Attempt, Event, Language};
use vitriol_record::{Keeping, Scored, Session, Timestamp, keep};
use vitriol_run::{Failure, Setup};
use vitriol_tests::wait;
use vitriol_xr::Switch;

use crate::replay::toy::DEVICE;
use toy::{Made, SCENE, class, events, finding, graded, line, nobody, put, read, recording};

/// Twelve are read without a device; a spoiled file is a line among them and one warning, and the exit code says it where it is asked to.
#[test]
fn a_bad_file_is_a_line_and_stops_no_other() {
    let folder = tempfile::tempdir().unwrap();
    class(folder.path(), 12);
    let spoiled = folder.path().join("student-05.mcap");
    let mut bytes = fs::read(&spoiled).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0xff;
    fs::write(&spoiled, bytes).unwrap();
    fs::write(folder.path().join("notes.txt"), "no track").unwrap();
    for jobs in ["1", "5"] {
        let (class, failure) = graded(folder.path(), &["--jobs", jobs], nobody).unwrap();
        let failure = failure.unwrap();
        assert_eq!(failure.exit_code(), 2);
        assert!(failure.to_string().contains("student-05.mcap"), "{failure}");
        assert_eq!((class.graded, class.otherwise, class.failed), (11, 0, 1));
        let names: Vec<&str> = class.lines.iter().map(|it| it.student.as_str()).collect();
        let expected: Vec<String> = (0..12).map(|n| format!("student-{n:02}")).collect();
        assert_eq!(names, expected);
        let bad = line(&class, "student-05");
        assert_eq!((bad.status, bad.points), (Status::Failed, None));
        assert!(bad.note.contains("student-05.mcap"), "{}", bad.note);
        // 4 mL of the 5 that leave no points, and nobody knows how hot it became: 8 of 10 points less, of 85.
        assert!(line(&class, "student-00").incidents.is_empty());
        let spilt = line(&class, "student-08");
        assert_eq!(spilt.incidents, [("spilt", 1)].into());
        assert_eq!((spilt.points, spilt.of), (Some(77), Some(85)));
        assert_eq!(line(&class, "student-00").points, Some(85));
    }
    // As a program of its own.
    let line = format!("grade . --scene {SCENE} --json");
    let strict = VITRIOL.run(folder.path(), &format!("{line} --strict"));
    assert_eq!(strict.status.code(), Some(2));
    let output = VITRIOL.run(folder.path(), &line);
    let warned = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{warned}");
    assert_eq!(warned.matches("student-05.mcap").count(), 1, "{warned}");
    assert_eq!(warned.matches("notes.txt").count(), 1, "{warned}");
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(told["graded"], 11);
    assert_eq!(told["lines"][5]["status"], "failed");
}

#[test]
fn what_is_no_class_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |what: &Path, more: &[&str]| {
        let error = graded(what, more, nobody).unwrap_err();
        assert_eq!(error.exit_code(), 2, "{error}");
        error.to_string()
    };
    let out = folder.path().join("out");
    let to = ["--out", out.to_str().unwrap()];
    assert!(refused(folder.path(), &to).contains(".mcap"));
    // What it writes has the track's name.
    let (a, b) = (folder.path().join("a"), folder.path().join("b"));
    for it in [&a, &b] {
        fs::create_dir(it).unwrap();
        put(it, "ada.mcap", &recording(&events(0.0)));
    }
    let more = [b.to_str().unwrap(), to[0], to[1]];
    assert!(refused(&a, &more).contains("ada"));
    assert!(!out.exists());
    let none = ["--class", "nowhere.sqlite"];
    assert!(refused(&a, &none).contains("nowhere.sqlite"));
    // A folder that is not there, which other programs would take for an empty class.
    let absent = refused(&folder.path().join("nowhere"), &to);
    assert!(
        absent.contains("nowhere: no such folder") && absent.contains(".mcap"),
        "{absent}"
    );
    assert!(!out.exists());
    let (class, failure) = graded(&folder.path().join("nobody.mcap"), &[], nobody).unwrap();
    assert_eq!((class.failed, failure.unwrap().exit_code()), (1, 2));
}

/// The scene is the command line's. A student's own one of that name, another one that a menu brought up, or none is listed.
#[test]
fn another_scene_is_listed_and_never_graded() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let clean = recording(&events(0.0));
    let mut diluted = clean.clone();
    let text = diluted.metadata.scenes.get_mut(SCENE).unwrap();
    let weaker = text.replacen("0.98", "0.05", 1);
    assert_ne!(*text, weaker);
    *text = weaker;
    put(here, "diluted.mcap", &diluted);

    let mut other = clean.clone();
    other.metadata.scene = "beaker".into();
    put(here, "other.mcap", &other);

    let mut switched = clean.clone();
    let switch = |key: &str, value: &str| Switch {
        key: key.into(),
        value: value.into(),
    };
    switched.frames[9].scenario = vec![switch("scene", "two-flasks")];
    put(here, "switched.mcap", &switched);

    let mut calm = clean.clone();
    calm.frames[9].scenario = vec![switch("k_v", "0")];
    put(here, "calm.mcap", &calm);

    let mut bare = clean.clone();
    bare.metadata.scenes.clear();
    put(here, "bare.mcap", &bare);

    let mut elsewhere = clean.clone();
    elsewhere.events[0].1 = elsewhere.events[0].1.replace(SCENE, "beaker");
    put(here, "elsewhere.mcap", &elsewhere);

    let mut again = clean.clone();
    again.frames[9].scenario = vec![switch("start", SCENE)];
    put(here, "again.mcap", &again);

    let (class, failure) = graded(here, &["--verify"], |_| {
        Ok(Box::new(finding(events(0.0), DEVICE[1])))
    })
    .unwrap();
    assert!(failure.is_none());
    assert_eq!((class.graded, class.otherwise), (1, 6));
    for (student, part) in [
        ("diluted", "of another text"),
        ("other", "beaker"),
        ("switched", "two-flasks"),
        ("calm", "k_v: 0"),
        ("bare", "does not carry"),
        ("elsewhere", "beaker"),
    ] {
        let line = line(&class, student);
        assert_eq!((line.status, line.points), (Status::Otherwise, None));
        assert!(line.note.contains(part), "{student}: {}", line.note);
        assert_eq!(line.verified, None);
    }
    assert_eq!(line(&class, "again").points, Some(85));
    // Likewise of a preset, where one is asked for.
    assert_eq!(read(here, &["--preset", "fast"]).graded, 1);
    let balanced = read(here, &["--preset", "balanced"]);
    assert!(line(&balanced, "again").note.contains("preset: fast"));

    // A scene of the teacher's own.
    let own = here.join("own.toml");
    fs::write(&own, &diluted.metadata.scenes[SCENE]).unwrap();
    let output = VITRIOL.run(here, "grade . --scene own.toml --json");
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(
        (&told["graded"], &told["otherwise"]),
        (&0.into(), &7.into())
    );
    // Nothing is graded then, which a script knows by the exit code.
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("nothing is graded"), "{said}");
    for flag in ["--scene", "--lesson", "--preset"] {
        assert!(said.contains(flag), "{said}");
    }
}

/// What is there of the same track stays; a track that has changed, and what is no whole result, is made anew.
#[test]
fn a_second_call_reads_what_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    class(folder.path(), 12);
    let out = folder.path().join("out");
    let to = ["--out", out.to_str().unwrap()];
    let first = read(folder.path(), &to);
    assert_eq!((first.graded, first.taken), (12, 0));
    let table = fs::read_to_string(out.join("grades.csv")).unwrap();
    assert_eq!(table.lines().count(), 13);
    let result = |n| out.join(format!("student-{n:02}.grade.json"));
    let whole = fs::read(result(3)).unwrap();

    fs::remove_file(result(1)).unwrap();
    fs::write(result(2), &whole[..whole.len() / 2]).unwrap();
    fs::write(out.join(".vitriol-x.part"), &whole).unwrap();
    // Another track's result under this one's name, as of who exchanges files.
    fs::write(result(4), &whole).unwrap();
    put(folder.path(), "student-05.mcap", &recording(&events(9.0)));
    let second = read(folder.path(), &to);
    assert_eq!((second.graded, second.taken), (12, 12 - 4));
    assert_eq!(line(&second, "student-05").points, Some(75));
    assert_eq!(line(&second, "student-04"), line(&first, "student-04"));
    assert_eq!(read(folder.path(), &to).taken, 12);
    // What was graded by something else is none.
    let preset = [&to[..], &["--preset", "fast"]].concat();
    assert_eq!(read(folder.path(), &preset).taken, 0);
    // A call for one track leaves what a call for a class does.
    let one = folder.path().join("one");
    read(
        &folder.path().join("student-03.mcap"),
        &["--out", one.to_str().unwrap()],
    );
    for name in [
        "grades.csv",
        "grades.html",
        "student-03.grade.json",
        "student-03.report.html",
    ] {
        assert!(one.join(name).exists(), "{name}");
    }
}

/// A process that is killed in the middle leaves whole results and no table; the next takes them.
#[test]
fn a_killed_process_leaves_whole_results() {
    let folder = tempfile::tempdir().unwrap();
    let students = 300;
    class(folder.path(), 1);
    for n in 1..students {
        let copy = folder.path().join(format!("student-{n:02}.mcap"));
        fs::copy(folder.path().join("student-00.mcap"), copy).unwrap();
    }
    let arguments = [
        "grade", ".", "--scene", SCENE, "--jobs", "1", "--out", "out",
    ];
    let mut process = Process::new(VITRIOL.0);
    process.args(arguments).current_dir(folder.path());
    let mut child = process.stdout(Stdio::null()).spawn().unwrap();
    let out = folder.path().join("out");
    let results = || {
        let files = fs::read_dir(&out).into_iter().flatten();
        let names = files.map(|it| it.unwrap().file_name().into_string().unwrap());
        names.filter(|it| it.ends_with(".grade.json")).count()
    };
    wait::until("some are graded", || (results() >= 3).then_some(()));
    child.kill().unwrap();
    child.wait().unwrap();
    let left = results();
    assert!((3..students).contains(&left), "{left}");
    assert!(!out.join("grades.csv").exists());
    let more = ["--out", out.to_str().unwrap()];
    let class = read(folder.path(), &more);
    assert_eq!((class.graded, class.taken), (students, left));
}

/// A simulation finds what a recording says, or not: to the bit on its own device, nearly on another.
#[test]
fn a_simulation_confirms_or_refutes() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // What it says, of what happens in truth, on which driver.
    let cases = [
        ("honest", 2.0, 2.0, DEVICE[1], Verdict::ToTheBit),
        ("other-bits", 2.0, 2.001, DEVICE[1], Verdict::Differs),
        (
            "other-device",
            2.0,
            2.08,
            "another",
            Verdict::WithinTolerance,
        ),
        ("forged", 0.0, 9.0, "another", Verdict::Differs),
    ];
    for (name, said, ..) in cases {
        put(here, &format!("{name}.mcap"), &recording(&events(said)));
    }
    let out = here.join("out");
    for (name, said, truth, driver, verdict) in cases {
        let file = here.join(format!("{name}.mcap"));
        let more = ["--verify", "--out", out.to_str().unwrap()];
        let toy = |setup: &Setup<'_>| -> Made {
            assert_eq!((setup.scene_name, setup.preset.name()), (SCENE, "fast"));
            Ok(Box::new(finding(events(truth), driver)))
        };
        let (class, failure) = graded(&file, &more, toy).unwrap();
        assert!(failure.is_none());
        let found = line(&class, name);
        assert_eq!(found.verified, Some(verdict), "{name}: {}", found.note);
        assert_eq!(found.note.is_empty(), verdict == Verdict::ToTheBit);
        if name == "other-device" {
            assert!(found.note.contains("0.00 s and 0.08 mL"), "{}", found.note);
        }
        // Points are the recording's: who reads the table sees that they are not confirmed.
        assert_eq!(found.incidents.is_empty(), said == 0.0);
    }
    // The table of what is there, without simulating; verified once is enough.
    let more = ["--out", out.to_str().unwrap()];
    let class = read(here, &more);
    assert_eq!(class.taken, 4);
    for (name, _, _, _, verdict) in cases {
        assert_eq!(line(&class, name).verified, Some(verdict));
    }
    // In what they differ is told anew in the language of the call.
    let german = read(here, &[&more[..], &["--language", "de"]].concat());
    assert_eq!(german.taken, 4);
    for (name, part) in [
        ("other-device", "0,00 s und 0,08 mL"),
        ("forged", "verschüttet (Tisch): in der Aufnahme 0,00 mL"),
        (
            "other-bits",
            "auf demselben Gerät nicht bis aufs Bit gleich",
        ),
    ] {
        let note = &line(&german, name).note;
        assert!(note.contains(part), "{name}: {note}");
    }
    let again = [&more[..], &["--verify"]].concat();
    assert_eq!(graded(here, &again, nobody).unwrap().0.taken, 4);
    // The page says so too, in words; nowhere does it where nobody asked.
    let texts = vitriol_run::texts::Texts::of(Language::En).unwrap();
    let texts = texts.grades.verified;
    let page = fs::read_to_string(out.join("grades.html")).unwrap();
    for (text, rows) in [
        (&texts.to_the_bit, 1),
        (&texts.within_tolerance, 1),
        (&texts.differs, 2),
    ] {
        let cell = format!("<td data-head=\"{}\">{text}</td>", texts.head);
        assert_eq!(page.matches(&cell).count(), rows, "{cell}: {page}");
    }
    assert!(page.contains(&texts.head));
    // For another device it is simulated anew, as by another tolerance.
    let elsewhere = [&again[..], &["--device", "1"]].concat();
    let toy = |_: &Setup<'_>| -> Made { Ok(Box::new(finding(events(2.0), DEVICE[1]))) };
    assert_eq!(graded(here, &elsewhere, toy).unwrap().0.taken, 0);
    let strict = [&again[..], &["--tolerance", "0.2,0,0.01"]].concat();
    let toy = |_: &Setup<'_>| -> Made { Ok(Box::new(finding(events(2.08), "another"))) };
    let (class, _) = graded(here, &strict, toy).unwrap();
    assert_eq!(class.taken, 0);
    let found = line(&class, "other-device");
    assert_eq!(found.verified, Some(Verdict::Differs), "{}", found.note);
    // What was only read is not.
    fs::remove_dir_all(&out).unwrap();
    read(here, &more);
    let page = fs::read_to_string(out.join("grades.html")).unwrap();
    assert!(!page.contains(&texts.head), "{page}");
    let toy = |_: &Setup<'_>| -> Made { Ok(Box::new(finding(events(2.0), DEVICE[1]))) };
    assert_eq!(graded(here, &again, toy).unwrap().0.taken, 0);
}

/// A device that is not there is a failure of that track, and leaves no result.
#[test]
fn what_cannot_be_simulated_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    class(folder.path(), 2);
    let out = folder.path().join("out");
    let more = ["--verify", "--out", out.to_str().unwrap()];
    let none = |_: &Setup<'_>| -> Made { Err(Failure::NoDevice("no device".into())) };
    let (class, failure) = graded(folder.path(), &more, none).unwrap();
    assert_eq!((class.failed, failure.unwrap().exit_code()), (2, 3));
    assert!(!out.join("student-00.grade.json").exists());
}

/// A recording that breaks off is graded where somebody says so, and taken only by who says so too.
#[test]
fn what_breaks_off_is_graded_when_accepted() {
    let folder = tempfile::tempdir().unwrap();
    let mut track = recording(&events(1.0));
    track.frames.remove(40);
    track.stage_from_flasks.remove(40);
    put(folder.path(), "ada.mcap", &track);
    let out = folder.path().join("out");
    let to = ["--out", out.to_str().unwrap(), "--accept-truncated"];
    let class = read(folder.path(), &to);
    assert_eq!(class.graded, 1, "{class:?}");
    assert_eq!(read(folder.path(), &to).taken, 1);
    let (class, failure) = graded(folder.path(), &to[..2], nobody).unwrap();
    assert_eq!(class.failed, 1);
    assert!(failure.unwrap().to_string().contains("--accept-truncated"));
}

/// What endangers caps the points. The table says so, with the reason and its moment.
#[test]
fn a_danger_caps_the_points_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let bare = |spilt_ml| {
        let mut events = events(spilt_ml);
        for event in &mut events {
            if let Event::Poured(pour) = event {
                pour.bare_face = true;
            }
        }
        recording(&events)
    };
    put(here, "ada.mcap", &bare(0.0));
    put(here, "cyd.mcap", &bare(2.0));
    put(here, "bob.mcap", &recording(&events(0.0)));
    // What macOS lays beside a file is no student's.
    fs::write(here.join("._ada.mcap"), b"Mac OS X").unwrap();
    let out = here.join("out");
    let class = read(here, &["--out", out.to_str().unwrap()]);
    assert_eq!(class.lines.len(), 3);
    // 60 of 100 are 51 of the 85 that can be had without heat.
    let ada = line(&class, "ada");
    assert_eq!((ada.points, ada.of), (Some(51), Some(85)));
    let why =
        "At most 51 of 85 points: acid was handled without goggles. At 0.1\u{a0}s: Acid was poured";
    assert!(ada.caps[0].starts_with(why), "{:?}", ada.caps);
    let bob = line(&class, "bob");
    assert_eq!((bob.points, bob.caps.len()), (Some(85), 0));
    let table = fs::read_to_string(out.join("grades.csv")).unwrap();
    // By the mark Excel knows its encoding.
    assert!(table.starts_with('\u{feff}'), "{table}");
    assert!(
        table.contains(",points,of,caps,what went wrong first,at [s],report,finished,"),
        "{table}"
    );
    assert!(table.contains(why), "{table}");
    let told = VITRIOL.run(here, &format!("grade . --scene {SCENE}"));
    let told = String::from_utf8(told.stdout).unwrap();
    assert!(told.contains("51 of 85  At most 51 of 85"), "{told}");
    // Sentences end with a stop, and words after them begin without a comma.
    let cyd = told.lines().find(|it| it.starts_with("cyd")).unwrap();
    assert!(cyd.ends_with(". spilt"), "{cyd}");
}

/// The class's file tells whose a recording is; a file's name that is a formula is text in a spreadsheet.
#[test]
fn students_have_names_that_are_safe() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let kept = put(here, "kept.mcap", &recording(&events(1.0)));
    put(here, "=1+1.mcap", &recording(&events(2.0)));
    let store = here.join("class.sqlite");
    let attempts = Attempt::all(events(1.0));
    let attempts = attempts.into_iter().map(|attempt| Scored {
        attempt,
        score: None,
    });
    keep(&Keeping {
        class: &store,
        pseudonym: &"p07".parse().unwrap(),
        session: Session::of_recording(&fs::read(&kept).unwrap(), Timestamp::now()),
        lesson: None,
        source: Some(&kept),
        attempts: &attempts.collect::<Vec<_>>(),
        out: None,
        lrs: None,
    })
    .unwrap();
    let out = here.join("out");
    let of_class = [
        "--class",
        store.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
    ];
    let class = read(here, &of_class);
    assert_eq!(line(&class, "p07").track, kept.display().to_string());
    line(&class, "=1+1");
    let table = fs::read_to_string(out.join("grades.csv")).unwrap();
    assert!(table.contains("\r\n'=1+1,"), "{table}");
    // A result names nobody, so that it may be kept when the class's file forgets.
    let result = fs::read_to_string(out.join("kept.grade.json")).unwrap();
    assert!(!result.contains("p07"));
}
