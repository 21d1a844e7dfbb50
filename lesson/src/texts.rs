//! The string table: what is said of an attempt, in one language.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;

const ENGLISH: &str = include_str!("../texts/en.toml");

/// Why a string table is refused.
#[derive(Debug, thiserror::Error)]
pub enum TextsError {
    /// It is no TOML, or a key is missing or unknown.
    #[error("the string table does not have the keys of lesson/texts/en.toml: {0}")]
    Keys(#[from] toml::de::Error),
    /// A sentence has other holes than the English one.
    #[error("{key}: has the holes {found:?}, and needs {needed:?}, as in lesson/texts/en.toml")]
    Holes {
        /// The sentence's key.
        key: String,
        /// Those that it has.
        found: Vec<String>,
        /// Those that it needs.
        needed: Vec<String>,
    },
}

/// A sentence with named holes, such as `{flask}`.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(transparent)]
pub(crate) struct Template(String);

impl Template {
    /// With its holes filled. A hole that is filled with braces stays as it is: names come from scene files.
    pub(crate) fn fill(&self, holes: &[(&str, &str)]) -> String {
        let mut text = String::new();
        for part in parts(&self.0) {
            match part {
                Part::Text(it) => text += it,
                Part::Hole(name) => {
                    let filled = holes.iter().find(|hole| hole.0 == name);
                    text += filled.map_or("", |hole| hole.1);
                }
            }
        }
        text
    }

    /// As it stands, of one that has no holes.
    pub(crate) fn text(&self) -> String {
        self.fill(&[])
    }
}

enum Part<'a> {
    Text(&'a str),
    Hole(&'a str),
}

fn parts(template: &str) -> impl Iterator<Item = Part<'_>> {
    template.split('{').enumerate().flat_map(|(index, piece)| {
        let (hole, text) = match piece.split_once('}') {
            Some((hole, text)) if index > 0 => (Some(hole), text),
            _ => (None, piece),
        };
        let hole = hole.map(Part::Hole);
        hole.into_iter().chain([Part::Text(text)])
    })
}

/// Declares a section of the table: each of its keys is a sentence, and no other is read.
macro_rules! section {
    ($name:ident: $($key:ident)+) => {
        #[derive(Clone, Debug, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name { $(pub(crate) $key: Template,)+ }
    };
}

section!(Number: decimal);
section!(Unit: millilitres litres millilitres_a_second seconds minutes hours celsius percent metres_a_second);
section!(Amount: water acid);
section!(Join: two);
section!(Pour: acid_into_water plain beside nothing);
section!(Wrong: water_into_acid water_into_acid_at poured_too_fast boiled_over hot spilt_bench spilt_floor left_hand right_hand face
    left_glove right_glove goggles dropped broke);
section!(Cause: pouring boiling breaking letting_go splashing mixing heating unknown);
section!(Effect: water_into_acid too_fast heat_at_once heat_within corrosive irritant rinse protected wipe);
section!(End: holds holds_at hottest hottest_outside broken_off);
section!(Well: slowly cool kept clean skin glass);
section!(CriterionNames: right_order poured_slowly stayed_cool nothing_thrown_out nothing_spilt nothing_on_skin glass_whole);
section!(Rule: right_order up_to nothing skin glass);
section!(Evidence: too_little too_little_acid mean);
section!(LeftOut: nothing_poured no_acid no_heat);

/// The texts of one language: a file of `lesson/texts`, of which each key is used and none is missing.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Texts {
    pub(crate) number: Number,
    pub(crate) unit: Unit,
    pub(crate) amount: Amount,
    pub(crate) join: Join,
    pub(crate) pour: Pour,
    pub(crate) wrong: Wrong,
    pub(crate) cause: Cause,
    pub(crate) effect: Effect,
    pub(crate) end: End,
    pub(crate) well: Well,
    pub(crate) criterion: CriterionNames,
    pub(crate) rule: Rule,
    pub(crate) evidence: Evidence,
    pub(crate) left_out: LeftOut,
}

impl Texts {
    /// Those of English, which the program carries.
    ///
    /// # Errors
    /// As for [`Texts::parse`], which a test rules out.
    pub fn english() -> Result<Self, TextsError> {
        Self::parse(ENGLISH)
    }

    /// Those of a file's text.
    ///
    /// # Errors
    /// A key is missing or unknown, or a sentence's holes are not those of the English one: it would lose a number then, or say a
    /// hole's name.
    pub fn parse(text: &str) -> Result<Self, TextsError> {
        let (found, needed) = (holes(text)?, holes(ENGLISH)?);
        let texts = toml::from_str(text)?;
        for (key, needed) in needed {
            let found = found.get(&key).cloned().unwrap_or_default();
            if found != needed {
                let [found, needed] = [found, needed].map(|holes| holes.into_iter().collect());
                return Err(TextsError::Holes { key, found, needed });
            }
        }
        Ok(texts)
    }
}

/// The holes of each sentence, by section and key.
fn holes(text: &str) -> Result<BTreeMap<String, BTreeSet<String>>, toml::de::Error> {
    let sections: BTreeMap<String, BTreeMap<String, String>> = toml::from_str(text)?;
    let of = |sentence: &str| {
        let holes = parts(sentence).filter_map(|part| match part {
            Part::Hole(name) => Some(name.to_owned()),
            Part::Text(_) => None,
        });
        holes.collect::<BTreeSet<_>>()
    };
    let sentences = sections.iter().flat_map(|(section, sentences)| {
        let named =
            move |(key, sentence): (&String, &String)| (format!("{section}.{key}"), of(sentence));
        sentences.iter().map(named)
    });
    Ok(sentences.collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_table_lacks_nothing_and_has_nothing_else() {
        Texts::english().unwrap();
        let refused = |text: &str| Texts::parse(text).unwrap_err().to_string();
        assert!(refused(&ENGLISH.replace("\nslowly =", "\n# slowly =")).contains("slowly"));
        assert!(refused(&format!("{ENGLISH}\nbang = \"a bang\"\n")).contains("bang"));
    }

    /// A translator may order holes as the language needs, and lose none.
    #[test]
    fn a_translation_has_the_same_holes() {
        let english = "Spilt on the bench: {amount}.";
        assert!(ENGLISH.contains(english));
        let with = |german: &str| Texts::parse(&ENGLISH.replace(english, german));
        assert!(with("{amount} auf dem Tisch verschüttet.").is_ok());
        for wrong in ["Verschüttet.", "Verschüttet: {menge}.", "{amount}, {flask}"] {
            let error = with(wrong).unwrap_err().to_string();
            assert!(error.contains("wrong.spilt_bench") && error.contains("amount"));
        }
    }

    /// A scene's author may name a flask as a hole.
    #[test]
    fn what_fills_a_hole_is_not_filled_again() {
        let template = Template("“{from}” into “{into}”: {rate}".into());
        let filled = template.fill(&[("from", "{into}"), ("into", "a{b}c}"), ("rate", "5")]);
        assert_eq!(filled, "“{into}” into “a{b}c}”: 5");
    }
}
