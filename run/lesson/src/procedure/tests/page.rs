//! The tables of docs/write-a-lesson.md have each condition, requirement and cap that a file may have.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::super::error::Problems;
use super::*;
use crate::caps::Caps;
use crate::{FaultTexts, Language};

/// A line of a step.
#[derive(Deserialize)]
struct StepLine {
    condition: Condition,
}

/// A line of a step or a rule.
#[derive(Deserialize)]
struct KeepLine {
    keep: Vec<Keep>,
}

/// Rows of the page's table with that first cell in its head, by their first name. They are those that the code knows, as it says of
/// `unknown`.
fn table<T: DeserializeOwned>(head: &str, unknown: &str) -> BTreeMap<String, String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/write-a-lesson.md");
    let page = std::fs::read_to_string(path).unwrap();
    let begin = format!("| {head} |");
    let from = page.lines().skip_while(|line| !line.starts_with(&begin));
    let rows = from.skip(2).take_while(|line| line.starts_with('|'));
    let named = rows.map(|row| (row.split('`').nth(1).unwrap().to_owned(), row.to_owned()));
    let rows: BTreeMap<String, String> = named.collect();
    let names: BTreeSet<String> = rows.keys().cloned().collect();
    assert_eq!(names, known::<T>(unknown), "{rows:#?}");
    rows
}

/// The last code of a row.
fn example(row: &str) -> &str {
    row.rsplit('`').nth(1).unwrap()
}

/// The names that the code knows, as it says them of a text with one that it does not know.
fn known<T: DeserializeOwned>(text: &str) -> BTreeSet<String> {
    let error = toml::from_str::<T>(text).map(|_| ()).unwrap_err();
    let (_, names) = error
        .message()
        .split_once(", expected ")
        .unwrap_or_default();
    let names = names.split('`').skip(1).step_by(2);
    names.map(str::to_owned).collect()
}

fn has_word(row: &str, word: &str) -> bool {
    let part_of_key = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    row.split(|c| !part_of_key(c)).any(|it| it == word)
}

#[test]
fn the_page_has_each_condition_with_its_keys() {
    let rows = table::<StepLine>("condition", "condition = { unknown = 1 }");
    for (name, row) in &rows {
        let inside = format!("condition = {{ {name} = {{ unknown = 1 }} }}");
        for key in known::<StepLine>(&inside) {
            assert!(has_word(row, &key), "{key} of {row}");
        }
        let line: StepLine = toml::from_str(example(row)).unwrap();
        assert_eq!(line.condition.field(""), format!(".{name}"));
        let mut problems = Problems::new(FaultTexts::of(Language::En).unwrap());
        line.condition.check(&mut problems, "");
        assert!(problems.found.is_empty(), "{row}: {problems:?}");
    }
}

#[test]
fn the_page_has_each_requirement_with_its_keys() {
    let rows = table::<KeepLine>("requirement", "keep = [{ unknown = 1 }]");
    for (name, row) in &rows {
        let inside = format!("keep = [{{ {name} = {{ unknown = 1 }} }}]");
        for key in known::<KeepLine>(&inside) {
            assert!(has_word(row, &key), "{key} of {row}");
        }
        assert!(has_word(example(row), name), "{row}");
        let line: KeepLine = toml::from_str(example(row)).unwrap();
        let mut problems = Problems::new(FaultTexts::of(Language::En).unwrap());
        for keep in &line.keep {
            keep.check(&mut problems, "");
        }
        assert!(problems.found.is_empty(), "{row}: {problems:?}");
    }
}

#[test]
fn the_page_has_each_cap_with_its_usual_points() {
    let rows = table::<Caps>("cap", "unknown = 1");
    for (name, usual) in Caps::default().named() {
        let row = &rows[name];
        assert!(row.contains(&format!("| {usual} |")), "{row}");
        let other: Caps = toml::from_str(example(row)).unwrap();
        let named = other.named().into_iter();
        let changed = named.filter(|it| it.0 == name && it.1 != usual);
        assert_eq!(changed.count(), 1, "{row}");
    }
}
