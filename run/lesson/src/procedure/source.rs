//! The text of a lesson's file, read field by field, so that a fault of one field hides none of another.

use std::collections::BTreeSet;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};
use vitriol_sim::scene::missing_quote;

use super::error::{Fault, LessonError, Problems};
use crate::texts::{FaultTexts, Template};

/// Most faults that are told: a file with more is no lesson.
const MOST_FAULTS: usize = 100;

/// Most places that are no TOML in a file that is a lesson even if it has few lines. Our choice.
const FEW: usize = 3;

/// Keys of a lesson, of a scene and of a track that files of the other kinds do not have.
const OF_LESSON: [&str; 5] = ["version", "modes", "step", "rule", "texts"];
const OF_SCENE: [&str; 6] = ["base", "scale", "solver", "model", "flask", "liquid"];
const OF_TRACK: [&str; 4] = ["duration", "head", "left", "right"];

/// A lesson's file, and the faults that were found in it so far.
pub(super) struct Source<'t> {
    file: &'t str,
    /// The sentences that say what is wrong.
    pub texts: FaultTexts,
    root: Spanned<DeValue<'t>>,
    /// Offset at which each line begins.
    lines: Vec<usize>,
    faults: Vec<Fault>,
    /// Fields that could not be read. Other problems of them follow from that, and are not told.
    unread: BTreeSet<String>,
}

impl<'t> Source<'t> {
    /// Parses the TOML; `file` is the name in messages.
    ///
    /// # Errors
    /// [`LessonError::Faulty`] with each place that is no TOML, or one fault where most lines are not. Nothing else is looked for then, because what stands behind such a place
    /// may not be what was meant.
    pub fn new(text: &'t str, file: &'t str, texts: FaultTexts) -> Result<Self, LessonError> {
        let (root, errors) = DeTable::parse_recoverable(text);
        let breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let mut source = Self {
            file,
            texts,
            root: Spanned::new(root.span(), DeValue::Table(root.into_inner())),
            lines: std::iter::once(0)
                .chain(breaks.map(|(at, _)| at + 1))
                .collect(),
            faults: Vec::new(),
            unread: BTreeSet::new(),
        };
        // One mistake may be told several times by the parser. The rest often follows from a quote that is missing.
        let mut found: Vec<(usize, bool, String)> = errors
            .iter()
            .map(|error| {
                let at = error.span().map_or(0, |span| span.start);
                let (why, texts) = (error.message(), &source.texts);
                match missing_quote(why) {
                    Some(_) => (at, false, texts.quote.text()),
                    None if why == "duplicate key" => (at, true, texts.duplicate.text()),
                    None => (at, true, texts.no_toml.fill(&[("why", why)])),
                }
            })
            .collect();
        found.sort_by_key(|&(at, follows, _)| (source.line(at), follows));
        found.dedup_by_key(|&mut (at, ..)| source.line(at));
        let filled = text.lines().map(str::trim_start);
        let filled = filled.filter(|line| !line.is_empty() && !line.starts_with('#'));
        if found.len() > FEW && 2 * found.len() > filled.count() {
            return Err(source.refused_as_a_whole(|texts| &texts.no_lesson));
        }
        for (at, _, problem) in found {
            source.fault(at, "", &problem);
        }
        if errors.is_empty() {
            Ok(source)
        } else {
            Err(source.into_error())
        }
    }

    /// Refuses a file that is a scene or a track.
    ///
    /// # Errors
    /// [`LessonError::Faulty`] with one fault, which names the kind of the file.
    pub fn check_kind(&self) -> Result<(), LessonError> {
        let has = |keys: &[&str]| keys.iter().any(|key| self.has(key));
        if has(&OF_LESSON) {
            return Ok(());
        }
        if has(&OF_SCENE) {
            return Err(self.refused_as_a_whole(|texts| &texts.a_scene));
        }
        if has(&OF_TRACK) {
            return Err(self.refused_as_a_whole(|texts| &texts.a_track));
        }
        Ok(())
    }

    /// One fault in place of all others, which follow from it; it is of no line.
    fn refused_as_a_whole(&self, template: fn(&FaultTexts) -> &Template) -> LessonError {
        LessonError::Faulty {
            file: self.file.to_owned(),
            faults: vec![Fault {
                line: 1,
                field: String::new(),
                text: template(&self.texts).text(),
            }],
        }
    }

    /// The value at that path, and its offset; of a value that is not there the offset of the last part of the path that is.
    fn find(&self, field: &str) -> (usize, Option<&Spanned<DeValue<'t>>>) {
        let (mut at, mut value) = (0, &self.root);
        for part in field.split(['.', '[']).filter(|part| !part.is_empty()) {
            let next = match (value.get_ref(), part.strip_suffix(']')) {
                (DeValue::Table(table), None) => {
                    let found = table.get_key_value(part);
                    found.map(|(key, value)| (key.span().start, value))
                }
                (DeValue::Array(array), Some(index)) => {
                    let found = index.parse().ok().and_then(|index: usize| array.get(index));
                    found.map(|value| (value.span().start, value))
                }
                _ => None,
            };
            match next {
                Some(next) => (at, value) = next,
                None => return (at, None),
            }
        }
        (at, Some(value))
    }

    /// Number of the line at an offset, from 1.
    fn line(&self, at: usize) -> usize {
        self.lines.partition_point(|begin| *begin <= at)
    }

    fn fault(&mut self, at: usize, field: &str, problem: &str) {
        if self.faults.len() < MOST_FAULTS {
            let fault = Fault::new(&self.texts, self.line(at), field, problem);
            self.faults.push(fault);
        }
    }

    /// Says nothing more of that field.
    pub fn skip(&mut self, field: impl Into<String>) {
        self.unread.insert(field.into());
    }

    /// Whether that field, or one that it is in, could not be read.
    pub fn is_unread(&self, field: &str) -> bool {
        let ends = field.match_indices(['.', '[']).map(|(end, _)| end);
        let mut ends = ends.chain([field.len()]);
        ends.any(|end| self.unread.contains(&field[..end]))
    }

    /// Refuses that field, of which nothing more is said.
    pub fn refuse(&mut self, field: &str, problem: &str) {
        if self.is_unread(field) {
            return;
        }
        let at = self.find(field).0;
        self.fault(at, field, problem);
        self.skip(field);
    }

    /// Whether there is anything at that path.
    pub fn has(&self, field: &str) -> bool {
        self.find(field).1.is_some()
    }

    /// The value of a field that may be missing; `None` also where it cannot be read.
    pub fn optional<T: DeserializeOwned>(&mut self, field: &str) -> Option<T> {
        let (at, value) = self.find(field);
        let value = value?.clone();
        let read = T::deserialize(ValueDeserializer::from(value));
        read.map_err(|error| {
            let at = error.span().map_or(at, |span| span.start);
            self.fault(at, field, &plain(&self.texts, error.message()));
            self.skip(field);
        })
        .ok()
    }

    /// The value of a field, or one in its place where it is missing or cannot be read.
    pub fn read<T: DeserializeOwned>(&mut self, field: &str, in_place: T) -> T {
        self.optional(field).unwrap_or(in_place)
    }

    /// Length of the list at that path; 0 where there is nothing.
    pub fn length(&mut self, field: &str) -> usize {
        match self.find(field).1.map(|it| it.get_ref()) {
            None => 0,
            Some(DeValue::Array(array)) => array.len(),
            Some(_) => {
                let heading = format!("[[{field}]]");
                let problem = match field.contains('.') {
                    true => self.texts.no_list.text(),
                    false => (self.texts.no_list_of_tables).fill(&[("heading", &heading)]),
                };
                self.refuse(field, &problem);
                0
            }
        }
    }

    /// Keys of the table at that path; none where there is nothing.
    pub fn names(&mut self, field: &str) -> Vec<String> {
        match self.find(field).1.map(|it| it.get_ref()) {
            None => Vec::new(),
            Some(DeValue::Table(table)) => {
                table.keys().map(|key| key.get_ref().to_string()).collect()
            }
            Some(_) => {
                self.refuse(field, &self.texts.no_table.text());
                Vec::new()
            }
        }
    }

    /// Refuses each key of the table at that path that is not known, and tells which are missing.
    pub fn keys(&mut self, field: &str, needed: &[&str], others: &[&str]) {
        let names = self.names(field);
        if self.is_unread(field) {
            return;
        }
        let path = |key: &str| match field {
            "" => key.to_owned(),
            field => format!("{field}.{key}"),
        };
        let known: Vec<&str> = needed.iter().chain(others).copied().collect();
        let is_there = |key: &&str| names.iter().any(|name| name == key);
        let missing: Vec<&str> = needed.iter().copied().filter(|it| !is_there(it)).collect();
        let unknown = names.iter().filter(|name| !known.contains(&name.as_str()));
        let (known, lacking) = (quoted(&known), quoted(&missing));
        let mut misspelt = false;
        for name in unknown {
            let template = match missing.is_empty() {
                true => &self.texts.unknown,
                false => &self.texts.unknown_and_missing,
            };
            let problem = template.fill(&[
                ("name", name.as_str()),
                ("known", &known),
                ("missing", &lacking),
            ]);
            self.refuse(&path(name), &problem);
            misspelt = true;
        }
        for key in missing {
            // What is misspelt may be what is missing: that is one fault.
            if misspelt {
                self.skip(path(key));
            } else {
                let problem = self.texts.missing.fill(&[("name", key)]);
                self.refuse(&path(key), &problem);
            }
        }
    }

    /// Adds problems of fields that could be read.
    pub fn add(&mut self, problems: Problems) {
        for it in problems.found {
            if !self.is_unread(&it.field) {
                let at = self.find(&it.field).0;
                self.fault(at, &it.field, &it.problem);
            }
        }
    }

    /// Whether no fault was found.
    pub fn is_good(&self) -> bool {
        self.faults.is_empty()
    }

    /// The faults, by their lines.
    pub fn into_error(mut self) -> LessonError {
        self.faults.sort_by_key(|fault| fault.line);
        LessonError::Faulty {
            file: self.file.to_owned(),
            faults: self.faults,
        }
    }
}

/// These keys in the signs of code, as the parser's messages have them.
fn quoted(keys: &[&str]) -> String {
    let keys: Vec<_> = keys.iter().map(|key| format!("`{key}`")).collect();
    keys.join(", ")
}

/// A parser's message in a teacher's words, with what would be right. One that is not known stands behind a sentence, as it is.
fn plain(texts: &FaultTexts, message: &str) -> String {
    // Each name in a message is between two of these signs; the first is the one that is wrong.
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let unread = || texts.unread.fill(&[("why", message)]);
    if message.starts_with("wanted exactly 1 element") {
        return texts.one_of_all.text();
    }
    if let Some((name, known)) = names.split_first() {
        let template = match message {
            it if it.starts_with("missing field") => Some(&texts.missing),
            it if it.starts_with("unknown field") => Some(&texts.unknown),
            it if it.starts_with("unknown variant") => Some(&texts.variant),
            _ => None,
        };
        if let Some(template) = template {
            let known = match known {
                [] => texts.none.text(),
                known => quoted(known),
            };
            return template.fill(&[("name", name), ("known", &known)]);
        }
    }
    let invalid = ["invalid type: ", "invalid value: "];
    let invalid = invalid.iter().find_map(|it| message.strip_prefix(it));
    let Some((wrong, expected)) = invalid.and_then(|it| it.rsplit_once(", expected ")) else {
        return unread();
    };
    let right = match expected {
        "u8" | "u32" => &texts.whole,
        "f64" => &texts.number,
        "a boolean" => &texts.boolean,
        "a string" => &texts.text,
        "a sequence" => &texts.list,
        "newtype variant" => &texts.keys,
        it if it.starts_with("struct ") => &texts.table,
        _ => return unread(),
    };
    let right = right.fill(&[("braces", "{ }")]);
    let kinds = ["string ", "integer ", "floating point ", "boolean "];
    match kinds.iter().find_map(|it| wrong.strip_prefix(it)) {
        Some(found) => texts.unfit.fill(&[("found", found), ("right", &right)]),
        None => texts.unfit_kind.fill(&[("right", &right)]),
    }
}
