//! Objects of statements: scenes, lessons, and kinds of incidents.

use std::collections::BTreeMap;

use serde::Serialize;

use super::vocabulary::{LESSON, SIMULATION, ours};

/// Words by language.
pub(super) type Words = BTreeMap<&'static str, String>;

/// Words in English, the language of all of ours.
pub(super) fn english(text: impl Into<String>) -> Words {
    Words::from([("en", text.into())])
}

/// An activity.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Activity {
    object_type: &'static str,
    id: String,
    definition: Definition,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Definition {
    #[serde(rename = "type")]
    kind: &'static str,
    name: Words,
    #[serde(skip_serializing_if = "Option::is_none")]
    description: Option<Words>,
}

impl Activity {
    pub(super) fn new(id: String, kind: &'static str, name: &str, text: Option<String>) -> Self {
        Self {
            object_type: "Activity",
            id,
            definition: Definition {
                kind,
                name: english(name),
                description: text.map(english),
            },
        }
    }

    pub(super) fn scene(name: &str) -> Self {
        Self::new(ours("scene", name), SIMULATION, name, None)
    }

    pub(super) fn lesson(name: &str) -> Self {
        Self::new(ours("lesson", name), LESSON, name, None)
    }
}
