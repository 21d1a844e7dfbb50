//! A lesson of one's own: its new file, its faults, and the examples of the pages that say how lessons and tracks are written.

use std::fs;
use std::path::Path;

use vitriol_sim::scene::{Liquid, Scene};

use super::{VITRIOL, text};

/// The indented block of a page that begins with that line.
fn example(page: &str, first: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../docs")
        .join(page);
    let page = fs::read_to_string(path).unwrap();
    let lines = page.lines().skip_while(|line| line.trim() != first);
    let block = lines.take_while(|line| line.is_empty() || line.starts_with("    "));
    let block = block.map(|line| line.strip_prefix("    ").unwrap_or(line));
    block.map(|line| format!("{line}\n")).collect()
}

#[test]
fn a_new_lesson_checks_and_overwrites_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let lessons = VITRIOL.object(here, "lesson")["lessons"].clone();
    let lessons = lessons.as_array().unwrap();
    for (nth, lesson) in lessons.iter().enumerate() {
        let from = lesson["name"].as_str().unwrap();
        for language in ["en", "de", "es", "zh"] {
            let name = format!("own-{nth}-{language}");
            let file = format!("{name}.toml");
            let new = format!("lesson new {name} --from {from} --language {language}");
            assert_eq!(VITRIOL.object(here, &new)["file"], *file);
            let shown = VITRIOL.object(here, &format!("lesson {file}"));
            let told = (&shown["name"], &shown["points"]);
            assert_eq!(told, (&name.into(), &100.into()));
            assert_eq!(shown["languages"], serde_json::json!([language]));
            // What people type.
            let checked = VITRIOL.object(here, &format!("lesson check {file}"));
            assert_eq!(checked, shown);
            let builtin = format!("lesson {from} --language {language}");
            assert_eq!(shown["title"], VITRIOL.object(here, &builtin)["title"]);
        }
    }
    // For people it says what comes next, and begins with `dilute` in English.
    let told = VITRIOL.run(here, "lesson new own");
    assert!(text(&told.stdout).contains("vitriol lesson own.toml"));
    let file = here.join("own.toml");
    let before = fs::read(&file).unwrap();
    VITRIOL.refuses(here, "lesson new own --from emergency", &["own.toml"]);
    assert_eq!(fs::read(&file).unwrap(), before);
    // Of a lesson's own file the ending may be left out, or be there already.
    let mine = VITRIOL.object(here, "lesson new mine.toml");
    assert_eq!(mine["file"], "mine.toml");
    assert_eq!(VITRIOL.object(here, "lesson mine.toml")["name"], "mine");
    VITRIOL.refuses_each(
        here,
        "
lesson new other --from dilutte => --from; did you mean dilute?
lesson own => did you mean own.toml?
lesson new ../other => ../other; a to z
lesson new Other => Other; a to z
lesson new dilute => dilute; a to z
lesson new con => con; Windows; take another name
lesson new lpt1.toml => lpt1; take another name
lesson chek own.toml => no subcommand `chek`; `vitriol lesson check LESSON`
",
    );
    assert_eq!(fs::read_dir(here).unwrap().count(), lessons.len() * 4 + 2);
}

/// The lesson of the page is good, and with two faults the program says what the page says that it says.
#[test]
fn the_lesson_of_the_page_is_good() {
    const PAGE: &str = "write-a-lesson.md";
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let lesson = example(PAGE, "version = 1");
    fs::write(here.join("my-lesson.toml"), &lesson).unwrap();
    let shown = VITRIOL.object(here, "lesson my-lesson.toml");
    assert_eq!(shown["points"], 100);
    assert_eq!(shown["languages"], serde_json::json!(["en"]));
    // Points that are no percentage are no fault, and are told.
    let told = VITRIOL.run(here, "lesson my-lesson.toml");
    assert_eq!(text(&told.stderr), "");
    let more = lesson.replacen("points = 60", "points = 70", 1);
    fs::write(here.join("my-lesson.toml"), more).unwrap();
    let told = VITRIOL.run(here, "lesson my-lesson.toml");
    assert!(told.status.success());
    let warned = text(&told.stderr);
    assert!(
        warned.contains("my-lesson.toml: its points add up to 110"),
        "{warned}"
    );
    let faulty = lesson.replacen("points = 20", "points = 2000", 1).replacen(
        "into = \"target\"",
        "into = \"beaker\"",
        1,
    );
    fs::write(here.join("my-lesson.toml"), faulty).unwrap();
    let told = VITRIOL.run(here, "lesson my-lesson.toml");
    let said = text(&told.stderr).trim_end();
    let said = said.strip_prefix("vitriol: ").unwrap();
    let first = said.lines().next().unwrap();
    assert_eq!(said, example(PAGE, first).trim_end());
}

/// Four faults of four kinds are four lines, each with the file, the line and what would be right.
#[test]
fn four_faults_are_four_lines() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    VITRIOL.object(here, "lesson new own --language de");
    let file = here.join("own.toml");
    let mut lesson = fs::read_to_string(&file).unwrap();
    let faults = [
        ("\nhint_after_s = 15", "hint_after = 15", "`hint_after_s`"),
        ("\npoints = 15", "points = \"many\"", "a whole number"),
        (
            "\ninto = \"target\"",
            "into = \"vase\"",
            "\"source\", \"target\"",
        ),
        (
            "\nrule.cool = \"",
            "rule.cool = \"{flask} ",
            "write what is meant",
        ),
    ];
    for (from, to, _) in faults {
        assert!(lesson.contains(from), "{from}");
        lesson = lesson.replacen(from, &format!("\n{to}"), 1);
    }
    fs::write(&file, &lesson).unwrap();
    VITRIOL.refuses(here, "lesson own.toml", &[]);
    let told = VITRIOL.run(here, "lesson own.toml");
    let said = text(&told.stderr).trim_start_matches("vitriol: ");
    let said: Vec<&str> = said.lines().collect();
    assert_eq!(said.len(), faults.len(), "{said:#?}");
    for (told, (_, to, right)) in said.iter().zip(faults) {
        let (before, _) = lesson.split_once(to).unwrap();
        let line = before.matches('\n').count() + 1;
        assert!(
            told.starts_with(&format!("own.toml: line {line}: ")),
            "{told}"
        );
        assert!(told.contains(right), "{told}");
    }
    let told = VITRIOL.run(here, "lesson own.toml --language de");
    let german = text(&told.stderr).trim_start_matches("vitriol: ");
    assert_eq!(german.lines().count(), faults.len(), "{german}");
    assert!(
        german.lines().all(|it| it.starts_with("own.toml: Zeile ")),
        "{german}"
    );
}

/// A lesson that is no file, or no text, is refused in the language of the call.
#[test]
fn what_is_no_text_is_refused_in_the_language_of_the_call() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::create_dir(here.join("folder.toml")).unwrap();
    // Latin-1, which is no UTF-8.
    fs::write(here.join("latin.toml"), b"name = \"\xfcber\"").unwrap();
    fs::write(here.join("long.toml"), "#".repeat((1 << 20) + 1)).unwrap();
    for (file, says) in [
        ("folder.toml", "es una carpeta"),
        ("latin.toml", "no es texto en UTF-8"),
        ("long.toml", "tiene más de 1048576 bytes"),
    ] {
        let told = VITRIOL.run(here, &format!("lesson {file} --language es"));
        assert_eq!(told.status.code(), Some(2), "{file}");
        let said = text(&told.stderr);
        assert!(
            said.starts_with(&format!("vitriol: {file}: {says}")),
            "{said}"
        );
    }
}

/// Its volumes, at real size, and strengths are those that the page says.
#[test]
fn the_scene_of_the_page_is_good() {
    let text = example("write-a-lesson.md", "base = \"acid-into-water\"");
    let scene = Scene::parse(&text, "more-acid.toml").unwrap();
    let base = Scene::builtin("acid-into-water").unwrap();
    assert_eq!(scene.name, "more-acid");
    assert_eq!(scene.flasks.len(), base.flasks.len());
    let ml = |it: &Liquid| (it.volume * 1e6).round();
    let volumes: Vec<f64> = scene.liquids.iter().map(ml).collect();
    assert_eq!(volumes, [40.0, 160.0]);
    // Without the second list entry the beaker is empty, and not as in the base.
    let (one, _) = text.rsplit_once("[[liquid]]").unwrap();
    let one = Scene::parse(one, "one.toml").unwrap();
    assert_eq!((one.liquids.len(), base.liquids.len()), (1, 2));
}

#[test]
fn the_track_of_the_page_is_good() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let track = example("write-a-track.md", "name = \"my-track\"");
    fs::write(here.join("my-track.toml"), track).unwrap();
    let told = VITRIOL.object(here, "track my-track.toml");
    assert_eq!(told["scene"], "two-flasks");
    assert!(
        (told["duration_s"].as_f64().unwrap() - 5.0).abs() < 0.02,
        "{told}"
    );
    VITRIOL.object(here, "track my-track.toml -o my-track.mcap");
    let again = VITRIOL.object(here, "track my-track.mcap");
    assert_eq!(again["frames"], told["frames"]);
}
