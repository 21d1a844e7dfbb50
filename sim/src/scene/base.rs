//! A scene that says how it differs from one that comes with the program: `base = "NAME"`.

use std::borrow::Cow;

use toml::{Table, Value};

use super::Scene;
use super::error::{Problem, SceneError};
use super::file::SceneFile;

/// Keys that a scene has of its own.
const OWN: [&str; 2] = ["name", "description"];

/// Reads a scene's `text` with what it takes from its base; `file` is its name in messages.
pub(super) fn read(text: &str, file: &str) -> Result<SceneFile, SceneError> {
    let read = match with_base(text, file)? {
        Some(whole) => whole.try_into(),
        // Its messages have lines.
        None => toml::from_str(text),
    };
    read.map_err(|error| SceneError::Syntax {
        file: file.to_owned(),
        message: another_kind(text).map_or_else(|| message(&error, text), str::to_owned),
    })
}

/// Says of a text that is a lesson or a track which it is, by keys that files of the other kinds do not have.
fn another_kind(text: &str) -> Option<&'static str> {
    let table: Table = text.parse().ok()?;
    let has = |keys: &[&str]| keys.iter().any(|key| table.contains_key(*key));
    if has(&["base", "scale", "solver", "flask", "liquid"]) {
        None
    } else if has(&["modes", "step", "rule", "texts"]) {
        Some("is a lesson and no scene; `vitriol lesson FILE` shows it, and --lesson names it")
    } else if has(&["duration", "head", "left", "right"]) {
        Some(
            "is a track and no scene; `vitriol track FILE` shows it, and `vitriol replay FILE` replays it",
        )
    } else {
        None
    }
}

/// The parser's message, or ours for a quote that is missing, with its line.
fn message(error: &toml::de::Error, text: &str) -> String {
    let (quote, span) = (missing_quote(error.message()), error.span());
    let (Some(problem), Some(span)) = (quote, span) else {
        return error.to_string().trim_end().to_owned();
    };
    let before = text.bytes().take(span.start);
    let line = before.filter(|byte| *byte == b'\n').count() + 1;
    format!("line {line}: {problem}")
}

/// Sentence for a parser's message of a text that has no closing quote; `None` for another message. The parser's own is for people who
/// know its grammar.
pub fn missing_quote(message: &str) -> Option<&'static str> {
    let (what, expected) = message.split_once(", expected ")?;
    let of_text = what.starts_with("invalid ") && what.ends_with(" string");
    (of_text && ["`\"`", "`'`"].contains(&expected))
        .then_some("a quote is missing: a text stands between two of them, such as \"text\"")
}

impl Scene {
    /// The scene's text with what it takes from its base, which stands alone; as it is where it names none, or is no scene.
    pub fn complete(text: &str) -> Cow<'_, str> {
        let whole = with_base(text, "").ok().flatten();
        let whole = whole.and_then(|whole| toml::to_string_pretty(&whole).ok());
        whole.map_or(Cow::Borrowed(text), Cow::Owned)
    }
}

/// The scene with its base's keys; `None` where it names no base, or is not TOML.
fn with_base(text: &str, file: &str) -> Result<Option<Table>, SceneError> {
    let Ok(mut own) = text.parse::<Table>() else {
        return Ok(None);
    };
    let Some(base) = own.remove("base") else {
        return Ok(None);
    };
    let known = base.as_str().and_then(Scene::builtin_text);
    let whole = known.and_then(|base| Scene::complete(base).parse::<Table>().ok());
    let Some(mut whole) = whole else {
        let names = Scene::builtin_names().join(", ");
        let problem = format!("{base} is not built in; take one of {names}");
        return Err(Problem::new("base", problem).in_file(file));
    };
    if let Some(key) = OWN.iter().find(|key| !own.contains_key(**key)) {
        let problem = "is missing; a scene with a base has a name and a description of its own";
        return Err(Problem::new(*key, problem).in_file(file));
    }
    whole.retain(|key, _| !OWN.contains(&key));
    merge(&mut whole, own);
    Ok(Some(whole))
}

/// Tables are merged by key; values and lists of `own` replace those of `whole`.
fn merge(whole: &mut Table, own: Table) {
    for (key, value) in own {
        match (whole.get_mut(&key), value) {
            (Some(Value::Table(whole)), Value::Table(own)) => merge(whole, own),
            (_, value) => {
                whole.insert(key, value);
            }
        }
    }
}
