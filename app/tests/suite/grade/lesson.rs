//! A class that is graded by a lesson: what a recording says of it, what is listed and not graded, and what a simulation says to it.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use vitriol::command::grade::{Status, Verdict};
use vitriol::command::replay;
use vitriol_lesson::procedure::{Kind, Progress, Why};
use vitriol_lesson::{Lesson, Mode, Texts};
use vitriol_run::{Failure, Format, Setup};
use vitriol_xr::track::Track;

use super::{DEVICE, Made, VITRIOL, events, finding, graded, line, nobody, put, read, recording};
use crate::replay::toy::asked;

/// Taken, poured too fast and then not, and put down a little late; half a millilitre too much was spilt.
fn progress(put_down_s: Option<f64>) -> Vec<Progress> {
    let id = |id: &str| id.to_owned();
    let missed = |step: &str| Progress::StepFailed {
        t_s: 0.5,
        id: id(step),
        evidence_s: 0.5,
        why: Why::NotDone,
        missed: true,
    };
    let put_down = put_down_s.map(|t_s| Progress::StepDone {
        t_s,
        id: id("put-down"),
        evidence_s: t_s,
    });
    vec![
        Progress::Begun {
            t_s: 0.0,
            lesson: id("dilute"),
            mode: Mode::Free,
        },
        Progress::StepDone {
            t_s: 0.05,
            id: id("dress"),
            evidence_s: 0.05,
        },
        Progress::StepBegun {
            t_s: 0.0,
            id: id("lift"),
        },
        Progress::StepDone {
            t_s: 0.1,
            id: id("lift"),
            evidence_s: 0.1,
        },
        Progress::StepFailed {
            t_s: 0.2,
            id: id("pour"),
            evidence_s: 0.15,
            why: Why::Incident {
                kind: Kind::PouredTooFast,
            },
            missed: false,
        },
        Progress::StepDone {
            t_s: 0.3,
            id: id("pour"),
            evidence_s: 0.25,
        },
        Progress::StepDone {
            t_s: 0.35,
            id: id("rest"),
            evidence_s: 0.3,
        },
        put_down.unwrap_or_else(|| missed("put-down")),
        Progress::RuleBroken {
            t_s: 0.4,
            id: id("clean"),
            evidence_s: 0.35,
            why: Why::Spilt {
                volume_m3: 1.5e-6,
                limit_m3: 1e-6,
            },
        },
        missed("stir"),
        missed("measure"),
        missed("concentration"),
        missed("wipe"),
        Progress::Over { t_s: 0.5 },
    ]
}

/// A recording that goes through that lesson and says this of it.
fn taught(said: &[Progress]) -> Track {
    let mut track = recording(&events(1.5));
    let lesson = Lesson::builtin("dilute").unwrap();
    let made = [
        ("lesson", "dilute"),
        ("lesson_hash", lesson.hash()),
        ("mode", "free"),
        ("language", "de"),
    ];
    let made = made.map(|(key, value)| (key.to_owned(), value.to_owned()));
    track.metadata.parameters.extend(made);
    let json = |it| (400_000_000, serde_json::to_string(it).unwrap());
    track.progress = said.iter().map(json).collect();
    track
}

const BY: [&str; 4] = ["--lesson", "dilute", "--mode", "free"];

/// Points and steps are those of the recording; another lesson, text or mode, or none, is listed and has no points.
#[test]
fn a_class_is_graded_by_its_lesson() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let good = taught(&progress(None));
    put(here, "ada.mcap", &good);
    put(here, "bob.mcap", &taught(&progress(Some(0.45))));
    put(here, "none.mcap", &recording(&events(1.5)));
    for (name, key, value) in [
        ("other", "lesson", "examination"),
        ("text", "lesson_hash", "0123"),
        ("mode", "mode", "guided"),
    ] {
        let mut track = good.clone();
        let parameters = &mut track.metadata.parameters;
        parameters.insert(key.to_owned(), value.to_owned());
        put(here, &format!("{name}.mcap"), &track);
    }
    let mut forged = good.clone();
    forged.progress[0].1 = forged.progress[0].1.replace("dilute", "examination");
    put(here, "forged.mcap", &forged);

    let out = here.join("out");
    let to = [&BY[..], &["--out", out.to_str().unwrap()]].concat();
    let class = read(here, &to);
    assert_eq!((class.graded, class.otherwise, class.failed), (2, 5, 0));
    for (student, part) in [
        ("none", "without a lesson"),
        ("other", "another lesson: examination"),
        ("text", "dilute of another text"),
        ("mode", "another mode: guided"),
        ("forged", "of another lesson"),
    ] {
        let line = line(&class, student);
        assert_eq!((line.status, line.points), (Status::Otherwise, None));
        assert!(
            line.note.contains(part) && line.lesson.is_none(),
            "{}",
            line.note
        );
        // The page that the row links says it too.
        let page = fs::read_to_string(out.join(format!("{student}.report.html"))).unwrap();
        assert!(page.contains(part), "{student}: {page}");
    }
    // 25 of 25, and half of 15 at the second try: 32 of 70, and as much of 10, 10 and 5 for three rules that were kept.
    let english = Texts::english().unwrap();
    let ada = line(&class, "ada").lesson.as_ref().unwrap();
    assert_eq!((ada.points, ada.of), (10 + 5 + 7 + 10 + 4 + 4 + 2, 100));
    assert!(
        ada.unmet(&english.report)
            .contains("put-down missed, stir missed, measure missed, concentration missed, wipe missed, clean broken")
    );
    // 37 of 70, which the rules' points are in proportion to.
    let bob = line(&class, "bob").lesson.as_ref().unwrap();
    assert_eq!((bob.points, bob.of), (10 + 5 + 7 + 10 + 5 + 5 + 5 + 2, 100));
    // The class's other score is as without a lesson.
    assert_eq!(
        line(&class, "ada").points,
        line(&read(here, &[]), "ada").points
    );

    // The lesson's points come first, for people and in the browser.
    let output = VITRIOL.run(here, "grade . --lesson dilute --mode free");
    let told = String::from_utf8(output.stdout).unwrap();
    let heads: Vec<_> = told.lines().next().unwrap().split("  ").collect();
    let heads: Vec<_> = heads.into_iter().map(str::trim).collect();
    assert!(heads.starts_with(&["Student", "Lesson"]), "{told}");
    let row = told.lines().find(|it| it.starts_with("ada ")).unwrap();
    let first = row.strip_prefix("ada").unwrap().trim_start();
    assert!(first.starts_with("42 of 100 "), "{row}");
    let row = told.lines().find(|it| it.starts_with("none ")).unwrap();
    assert!(row.contains("not graded"), "{row}");
    assert!(!told.contains("otherwise"), "{told}");
    let page = fs::read_to_string(out.join("grades.html")).unwrap();
    let at = |text: &str| page.find(text).unwrap();
    assert!(at("42 / 100") < at(" / 85"), "{page}");
    // So they do on the page on her recording, with their table.
    let page = fs::read_to_string(out.join("ada.report.html")).unwrap();
    let at = |text: &str| page.find(text).unwrap();
    let (lesson, score) = (at("href=\"#lesson-1\""), at("href=\"#score-1\""));
    assert!(lesson < score, "{page}");
    assert!(
        page[lesson..score].contains("<strong>42</strong>"),
        "{page}"
    );
    assert!(at("id=\"lesson-1\"") < at("id=\"score-1\""), "{page}");
    // Why what was done or kept has less than full points.
    let share = "kept. A rule that was kept earns the same share as the steps, rounded down: they earned 32 of 70.";
    assert_eq!(page.matches(share).count(), 3, "{page}");
    assert_eq!(
        page.matches("done only after a failure").count(),
        1,
        "{page}"
    );

    let table = fs::read_to_string(out.join("grades.csv")).unwrap();
    let table = table.trim_start_matches('\u{feff}');
    let row = |start: &str| table.lines().find(|it| it.starts_with(start)).unwrap();
    let columns = "lesson [points],lesson of,step dress,step lift,step pour,step rest,step put-down,step stir,\
        step measure,step concentration,step wipe,rule order,rule cool,rule inside,rule clean,verified,note";
    assert!(row("student,").ends_with(columns), "{table}");
    let cells =
        ",42,100,done,done,done,done,missed,missed,missed,missed,missed,kept,kept,kept,broken,,";
    assert!(row("ada,").ends_with(cells), "{table}");
    assert!(
        row("none,").contains(",,,,,,,,,,,,,,,,Not graded: made without"),
        "{table}"
    );
    let widths: Vec<usize> = table.lines().map(|it| it.matches(',').count()).collect();
    assert!(widths.iter().all(|it| *it == widths[0]), "{widths:?}");

    // Results are of that lesson and mode.
    assert_eq!(read(here, &to).taken, 7);
    let without = ["--out", out.to_str().unwrap()];
    assert_eq!(read(here, &without).taken, 0);
}

/// Where no incident came before it, a broken rule or a missed step is what went wrong first; what was asked stands before it.
#[test]
fn what_a_lesson_asked_may_be_what_went_wrong_first() {
    let folder = tempfile::tempdir().unwrap();
    let mut track = taught(&progress(None));
    track.events = recording(&events(0.0)).events;
    put(folder.path(), "ada.mcap", &track);
    let class = read(folder.path(), &BY);
    let first = line(&class, "ada").first_wrong.as_ref().unwrap();
    assert_eq!(first.t_s, Some(0.35));
    let text = first.text.replace('\u{a0}', " ");
    assert!(
        text.starts_with("Spill no more than 1 mL. Spilt: 1.5"),
        "{text}"
    );
}

#[test]
fn a_lesson_of_another_scene_or_without_the_mode_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), "ada.mcap", &taught(&progress(None)));
    let refused = |more: &[&str]| {
        let error = graded(folder.path(), more, nobody).unwrap_err();
        assert_eq!(error.exit_code(), 2, "{error}");
        error.to_string()
    };
    assert!(refused(&["--lesson", "wrong-order"]).contains("--scene water-into-acid"));
    let mode = ["--lesson", "dilute", "--mode", "examination"];
    assert!(refused(&mode).contains("guided, free"));
    assert!(refused(&["--lesson", "nothing.toml"]).contains("nothing.toml"));
    let output = VITRIOL.run(folder.path(), "grade . --scene beaker --mode free");
    assert_eq!(output.status.code(), Some(2));
}

/// A simulation that judges the lesson again confirms what is said of it, or not.
#[test]
fn a_simulation_confirms_or_refutes_the_lesson() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let (missed, done, late) = (progress(None), progress(Some(0.4)), progress(Some(0.45)));
    // What is said, what is found, on which driver.
    let cases = [
        ("honest", &done, &done, DEVICE[1], Verdict::ToTheBit, ""),
        (
            "other-bits",
            &done,
            &late,
            DEVICE[1],
            Verdict::Differs,
            "not to the bit",
        ),
        (
            "other-device",
            &done,
            &late,
            "another",
            Verdict::WithinTolerance,
            "0.05 s",
        ),
        (
            "forged",
            &done,
            &missed,
            "another",
            Verdict::Differs,
            "attempt 1, step put-down: done in the recording, missed found",
        ),
    ];
    for (name, said, found, driver, verdict, part) in cases {
        let file = put(here, &format!("{name}.mcap"), &taught(said));
        let toy = |_: &Setup<'_>| -> Made {
            let mut toy = finding(events(1.5), driver);
            toy.progress.clone_from(found);
            Ok(Box::new(toy))
        };
        let more = [&BY[..], &["--verify"]].concat();
        let (class, failure) = graded(&file, &more, toy).unwrap();
        assert!(failure.is_none());
        let line = line(&class, name);
        assert_eq!(line.verified, Some(verdict), "{name}: {}", line.note);
        assert!(line.note.contains(part), "{name}: {}", line.note);
        // Points are the recording's.
        assert_eq!(line.lesson.as_ref().unwrap().items[2].became, "done");
        // Without a lesson nothing of it counts.
        let (class, _) = graded(&file, &["--verify"], toy).unwrap();
        assert_eq!(class.lines[0].verified, Some(Verdict::ToTheBit));
        assert!(class.lines[0].lesson.is_none());
    }
}

/// `vitriol replay TRACK --lesson dilute …` into a folder; its report.
fn replayed(track: &Path, found: &[Progress], more: &[&str]) -> Result<serde_json::Value, Failure> {
    let out = tempfile::tempdir().unwrap();
    let file = track.to_str().unwrap();
    let to = out.path().to_str().unwrap();
    let start = ["vitriol", "replay", file, "--no-video", "--out", to];
    let args = asked(start.iter().chain(more));
    replay::run(&args, Format::Json, |_: &Setup<'_>| -> Made {
        let mut toy = finding(events(1.5), DEVICE[1]);
        toy.progress = found.to_vec();
        Ok(Box::new(toy))
    })?;
    let page = fs::read_to_string(out.path().join("report.html")).unwrap();
    assert_eq!(
        page.contains("Lesson: Diluting sulfuric acid, free"),
        !more.is_empty()
    );
    let report = fs::read(out.path().join("report.json")).unwrap();
    Ok(serde_json::from_slice(&report).unwrap())
}

#[test]
fn a_replay_judges_a_lesson() {
    let folder = tempfile::tempdir().unwrap();
    let said = progress(Some(0.4));
    let track = put(folder.path(), "ada.mcap", &taught(&said));
    let report = replayed(&track, &said, &BY).unwrap();
    let lesson = &report["lesson"][0];
    assert_eq!(
        (&lesson["points"], &lesson["of"]),
        (&49.into(), &100.into())
    );
    assert_eq!(report["recording"]["same_progress"], true);
    let command = report["command"].as_str().unwrap();
    assert!(command.contains("--lesson dilute --mode free"), "{command}");
    let other = replayed(&track, &progress(None), &BY).unwrap();
    assert_eq!(other["recording"]["same_progress"], false);
    // Of a recording that goes through no lesson, or where none is asked for, nothing is compared.
    let bare = put(folder.path(), "bare.mcap", &recording(&events(1.5)));
    let report = replayed(&bare, &said, &BY).unwrap();
    assert!(report["recording"].get("same_progress").is_none());
    assert_eq!(report["lesson"][0]["points"], 49);
    assert!(
        replayed(&track, &said, &[])
            .unwrap()
            .get("lesson")
            .is_none()
    );
    let error = replayed(&track, &said, &["--lesson", "wrong-order"]).unwrap_err();
    assert!(error.to_string().contains("water-into-acid"), "{error}");
}

/// What a track says of itself survives its conversion.
#[test]
fn a_track_says_which_lesson_it_went_through() {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), "ada.mcap", &taught(&progress(None)));
    let told = VITRIOL.object(folder.path(), "track ada.mcap");
    let made: BTreeMap<String, String> =
        serde_json::from_value(told["parameters"].clone()).unwrap();
    assert_eq!(
        (made["lesson"].as_str(), made["language"].as_str()),
        ("dilute", "de")
    );
}
