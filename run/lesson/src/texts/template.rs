//! Sentences with named holes.

use std::fmt;

use serde::Deserialize;

/// A sentence with named holes, such as `{flask}`.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(transparent)]
pub struct Template(String);

impl Template {
    /// The sentence with its holes filled. What fills a hole that is written with a capital, `{Flask}`, gets one.
    /// Braces in a filled-in value stay as they are.
    pub fn fill(&self, holes: &[(&str, &str)]) -> String {
        let mut text = String::new();
        for part in parts(&self.0) {
            match part {
                Part::Text(it) => text += it,
                Part::Hole(name) => {
                    let plain = name.to_lowercase();
                    let filled = holes.iter().find(|hole| hole.0 == plain);
                    let filled = filled.map_or("", |hole| hole.1);
                    let mut letters = filled.chars();
                    match letters.next() {
                        Some(first) if plain != name => {
                            text.extend(first.to_uppercase());
                            text += letters.as_str();
                        }
                        _ => text += filled,
                    }
                }
            }
        }
        text
    }

    /// The sentence as it stands, if it has no holes.
    pub(crate) fn text(&self) -> String {
        self.fill(&[])
    }
}

impl fmt::Display for Template {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A piece of a sentence.
pub(super) enum Part<'a> {
    Text(&'a str),
    Hole(&'a str),
}

/// The pieces of a sentence, in their order.
pub(super) fn parts(template: &str) -> impl Iterator<Item = Part<'_>> {
    template.split('{').enumerate().flat_map(|(index, piece)| {
        let (hole, text) = match piece.split_once('}') {
            Some((hole, text)) if index > 0 => (Some(hole), text),
            _ => (None, piece),
        };
        let hole = hole.map(Part::Hole);
        hole.into_iter().chain([Part::Text(text)])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scene's author may give a flask the name of a hole.
    #[test]
    fn what_fills_a_hole_is_not_filled_again() {
        let template = Template("“{from}” into “{into}”: {rate}".into());
        let filled = template.fill(&[("from", "{into}"), ("into", "a{b}c}"), ("rate", "5")]);
        assert_eq!(filled, "“{into}” into “a{b}c}”: 5");
    }
}
