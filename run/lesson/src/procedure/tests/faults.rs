//! Lessons with several mistakes, which are told in one go, and lessons without English.

use std::collections::BTreeSet;

use super::fits::facts;
use super::spoiled::GOOD;
use super::*;
use crate::Language;
use vitriol_sim::scene::Scene;

/// The faults of a text, whose scene has these facts.
fn faults(text: &str) -> Vec<Fault> {
    let refused = Lesson::parse_for(text, ("bad.toml", Language::En), |_| Ok(Some(facts())));
    match refused.map(|_| text).unwrap_err() {
        LessonError::Faulty { faults, .. } => faults,
        other => panic!("{other}"),
    }
}

/// Line of the first place with `piece`, counted from 1.
fn line_of(text: &str, piece: &str) -> usize {
    let (before, _) = text.split_once(piece).unwrap();
    before.matches('\n').count() + 1
}

/// What is replaced => by what => its field, a piece of the line at which it is told, and what is right. The last one is told at the texts
/// of its language.
const FAULTS: &str = r#"
hint_after_s = 20 => hint_after_s = "soon" => step[0].hint_after_s | "soon" | a number
time_limit_s = 120 => time_limit = 120 => step[0].time_limit | time_limit = | `time_limit_s`
points = 5⏎condition => points = 2000⏎condition => step[1].points | 2000 | 0 to 1000
flask = "b"⏎at_least_ml => flask = "c"⏎at_least_ml => step[2].condition.holds.flask | "c" | "a", "b"
step.look = { text = "看。", hint = "那里。" }⏎ =>  => texts.zh.step.look | step.pour = { text = "倒 | give its texts
"#;

/// Of each kind one: a value of a wrong kind, a key that is not known, a number out of its range, a flask that the scene does not have,
/// a text that is missing.
#[test]
fn all_faults_are_told_in_one_go_with_their_lines() {
    let cases: Vec<[String; 3]> = FAULTS.trim().lines().map(case).collect();
    let mut text = GOOD.to_owned();
    for [from, to, _] in &cases {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let found = faults(&text);
    assert_eq!(found.len(), cases.len(), "{found:?}");
    for (fault, [.., told]) in found.iter().zip(&cases) {
        let [field, place, right] = told.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{told}");
        };
        assert_eq!(fault.field, field, "{found:?}");
        assert_eq!(fault.line, line_of(&text, place), "{fault}");
        assert!(fault.text.contains(right), "{fault}");
    }
    let refused = Lesson::parse_for(&text, ("bad.toml", Language::En), |_| Ok(Some(facts())));
    let message = refused.map(|_| ()).unwrap_err().to_string();
    for (told, fault) in message.lines().zip(&found) {
        assert_eq!(told, format!("bad.toml: {fault}"));
    }
    assert_eq!(message.lines().count(), cases.len());
}

/// What only follows from a fault is not told as another one.
#[test]
fn one_fault_is_told_once() {
    for (from, to, field) in [
        // A key that is misspelt and therefore missing.
        ("scene =", "scenes =", "scenes"),
        ("id = \"pour\"", "ID = \"pour\"", "step[0].ID"),
        // Without the id it is not known which texts belong to the step, and which step `after` names.
        ("id = \"pour\"\n", "", "step[0].id"),
        ("name = \"own-1\"", "name = 1", "name"),
        ("condition.poured", "condition.pored", "step[0].condition"),
        ("title = \"Own\"", "title = 1", "texts.en.title"),
        (
            "step.pour = { text",
            "step.pour = { texts",
            "texts.en.step.pour",
        ),
        (
            "acid_from_percent = 15",
            "acid_from_percent = 150",
            "step[2].condition.holds.acid_from_percent",
        ),
        (
            "from = \"a\"",
            "from = \"c\"",
            "step[0].condition.poured.from",
        ),
    ] {
        let found = faults(&GOOD.replacen(from, to, 1));
        let fields: Vec<&str> = found.iter().map(|it| it.field.as_str()).collect();
        assert_eq!(fields, [field], "{to}: {found:?}");
    }
    let questions = GOOD.replacen(
        "[step.condition.poured]",
        "[step.condition]\nanswered = 3\n[step.x]",
        1,
    );
    let fields: Vec<String> = faults(&questions).into_iter().map(|it| it.field).collect();
    assert_eq!(fields, ["step[0].condition", "step[0].x"]);
}

/// Each place that is no TOML, and nothing else.
#[test]
fn what_is_no_toml_is_told_by_its_lines() {
    let text = GOOD
        .replacen("id = \"stir\"", "id = stir", 1)
        .replacen("for_s = 3", "for_s = 3 s", 1)
        .replacen("points = 10", "points = 1001", 1);
    let found = faults(&text);
    let lines: BTreeSet<usize> = found.iter().map(|it| it.line).collect();
    let places = ["id = stir", "for_s = 3 s"];
    assert_eq!(
        lines,
        BTreeSet::from(places.map(|it| line_of(&text, it))),
        "{found:?}"
    );
    assert!(found.iter().all(|it| it.text.contains("no TOML")));
}

/// A quote that is missing is told in a sentence of ours, whatever else the parser stumbles over in that line.
#[test]
fn a_missing_quote_is_told_with_its_line() {
    for (good, bad) in [
        ("id = \"stir\"", "id = \"stir"),
        ("name = \"own-1\"", "name = 'own-1"),
        ("hint = \"Wait.\" }", "hint = \"Wait. }"),
    ] {
        let text = GOOD.replacen(good, bad, 1);
        let found = faults(&text);
        let first = found.first().unwrap().to_string();
        let line = line_of(&text, bad);
        let right = format!("line {line}: a quote is missing: ");
        assert!(first.starts_with(&right), "{bad}: {found:?}");
    }
}

/// A scene that cannot be read is a fault beside the others.
#[test]
fn a_scene_that_is_not_there_is_told_with_the_rest() {
    let text = GOOD.replacen("points = 10", "points = 1001", 1);
    let refused = Lesson::parse_for(&text, ("bad.toml", Language::En), |scene| {
        Err(format!("no {scene}"))
    });
    let message = refused.map(|_| ()).unwrap_err().to_string();
    let lines: Vec<&str> = message.lines().collect();
    assert_eq!(lines.len(), 2, "{message}");
    assert!(
        lines[0].contains("line 4: scene: cannot be read: no bench"),
        "{message}"
    );
    assert!(
        lines[1].contains("line 9: step 1, points: 1001"),
        "{message}"
    );
}

/// English is a language as the others: a lesson may have one of them alone, which stands in for those that it does not have.
#[test]
fn a_lesson_in_one_language_needs_no_english() {
    let (steps, _) = GOOD.split_once("[texts.zh]").unwrap();
    let lesson = Lesson::parse(&steps.replace("[texts.en]", "[texts.de]"), "own.toml").unwrap();
    assert_eq!(lesson.languages(), [Language::De]);
    for language in Language::ALL {
        assert_eq!(lesson.texts(language).title, "Own");
    }
    let both = Lesson::parse(&GOOD.replace("[texts.en]", "[texts.de]"), "own.toml").unwrap();
    assert_eq!(both.languages(), [Language::De, Language::Zh]);
    assert_eq!(both.texts(Language::En).title, "Own");
    assert_eq!(both.texts(Language::Zh).title, "自己的");
    let (none, _) = GOOD.split_once("[texts.en]").unwrap();
    let message = Lesson::parse(none, "own.toml").unwrap_err().to_string();
    assert!(
        message.contains("texts: missing") && message.contains("[texts.de]"),
        "{message}"
    );
}

/// What a sentence has of the file and of the program's limits: its numbers, and what stands in the signs of code.
fn marks(text: &str) -> Vec<&str> {
    let numbers = text.split(|c: char| !c.is_ascii_digit());
    let names = text.split('`').skip(1).step_by(2);
    let mut marks: Vec<&str> = numbers.filter(|it| !it.is_empty()).chain(names).collect();
    marks.sort_unstable();
    marks
}

/// Each language has the same faults in the same lines, with the same numbers and names, and no sentence of the English table.
#[test]
fn faults_are_told_in_each_language() {
    let mut text = GOOD.to_owned();
    for (from, to) in [
        ("version = 1", "version = 2"),
        ("[\"guided\", \"free\"]", "[\"guided\", \"guided\"]"),
        ("hint_after_s = 20", "hint_after_s = \"soon\""),
        ("time_limit_s = 120", "time_limit = 120"),
        ("\"gloves\"]", "\"glove\"]"),
        ("at_most_ml = 20", "at_most_ml = 10"),
        ("after = [\"pour\"]", "after = [\"check\"]"),
        (
            "any = [{ lifted = { flask = \"a\" } }, { goggles = { on = true } }]",
            "any = []",
        ),
        ("flask = \"b\"\nat_least_ml", "flask = \"c\"\nat_least_ml"),
        ("acid_from_percent = 15", "acid_from_percent = 150"),
        (", at_least_c = 20, at_most_c = 90", ""),
        ("id = \"clean\"", "id = \"pour\""),
        ("title = \"Own\"", "title = \" \""),
        ("What it is about.", "What {it} is."),
        ("step.look = { text = \"看。\", hint = \"那里。\" }\n", ""),
    ] {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    let told = |language| {
        let facts = SceneFacts {
            heat: false,
            ..facts()
        };
        let refused = Lesson::parse_for(&text, ("bad.toml", language), |_| Ok(Some(facts)));
        match refused.map(|_| language).unwrap_err() {
            LessonError::Faulty { faults, .. } => faults,
            other => panic!("{other}"),
        }
    };
    let table: toml::Table = toml::from_str(include_str!("../../../texts/fault/en.toml")).unwrap();
    let sentences = table["fault"].as_table().unwrap().values();
    // What stands between the holes, without pieces that are too short to be of one language.
    let pieces = sentences.flat_map(|it| it.as_str().unwrap().split(['{', '}']).step_by(2));
    let letters = |it: &str| it.chars().filter(char::is_ascii_alphabetic).count();
    let pieces: Vec<&str> = pieces.filter(|it| letters(it) >= 8).collect();
    let is_english = |fault: &Fault| pieces.iter().any(|it| fault.text.contains(it));
    let english = told(Language::En);
    assert!(
        english.len() > 15 && english.iter().all(is_english),
        "{english:#?}"
    );
    for language in [Language::De, Language::Es, Language::Zh] {
        let other = told(language);
        assert_eq!(other.len(), english.len(), "{language}: {other:#?}");
        for (fault, english) in other.iter().zip(&english) {
            assert_eq!((fault.line, &fault.field), (english.line, &english.field));
            assert_eq!(marks(&fault.text), marks(&english.text), "{fault}");
            assert!(!is_english(fault), "{fault}");
        }
    }
}

/// A file of another kind is refused in one sentence, in each language, and not by dozens of lines. The files are the program's own, and a
/// page of its documentation.
#[test]
fn another_kind_of_file_is_one_fault() {
    let page = include_str!("../../../../../docs/lesson.md");
    let scene = Scene::builtin_text("two-flasks").unwrap();
    let variant = "base = \"beaker\"\nname = \"own\"\n";
    let track = include_str!("../../../../../xr/tracks/two-flasks.toml");
    for (text, says) in [
        (page, "another kind of file"),
        (
            "{\n\"a\": 1,\n\"b\": 2,\n\"c\": 3\n}\n",
            "another kind of file",
        ),
        (scene, "is a scene and no lesson"),
        (variant, "is a scene and no lesson"),
        (track, "is a track and no lesson"),
    ] {
        let told = |language| {
            let refused = Lesson::parse_for(text, ("bad.toml", language), |_| Ok(None));
            refused.map(|_| ()).unwrap_err().to_string()
        };
        let english = told(Language::En);
        assert!(english.starts_with("bad.toml: "), "{english}");
        assert!(english.contains(says), "{english}");
        for language in Language::ALL {
            let said = told(language);
            assert_eq!(said.lines().count(), 1, "{said}");
            assert_eq!(marks(&said), marks(&english), "{said}");
            assert_eq!(said.contains(says), language == Language::En, "{said}");
        }
    }
    // Few mistakes in a short file are those of a lesson, each with its line.
    let found = faults("name = own\nversion = 1 x\n");
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found.iter().all(|it| it.text.contains("no TOML: ")));
}

/// The parser's own message stays as it is, behind a sentence that says what it is about.
#[test]
fn no_toml_is_told_in_the_language_of_the_command() {
    let told = |from: &str, to: &str| {
        let text = GOOD.replacen(from, to, 1);
        let refused = Lesson::parse_for(&text, ("bad.toml", Language::De), |_| Ok(None));
        let message = refused.map(|_| ()).unwrap_err().to_string();
        (message, line_of(&text, to))
    };
    for (to, right) in [
        ("id = stir", "ist kein TOML: "),
        ("id = \"stir", "ein Anführungszeichen fehlt: "),
    ] {
        let (message, line) = told("id = \"stir\"", to);
        let right = format!("bad.toml: Zeile {line}: {right}");
        assert!(message.starts_with(&right), "{message}");
    }
    // What a line is, behind the parser's message.
    let (message, _) = told("id = \"stir\"", "id = stir");
    assert!(
        message.contains("; eine Zeile ist ein Schlüssel"),
        "{message}"
    );
    // A key that stands there twice is told where it is for the second time.
    let (message, line) = told("id = \"stir\"", "id = \"stir\"\nid = \"again\"");
    let right = format!("bad.toml: Zeile {}: derselbe Schlüssel", line + 1);
    assert!(message.starts_with(&right), "{message}");
    let refused = Lesson::template("Own", "dilute", Language::De).unwrap_err();
    assert!(
        refused.to_string().starts_with("Lektion \"Own\": "),
        "{refused}"
    );
}
