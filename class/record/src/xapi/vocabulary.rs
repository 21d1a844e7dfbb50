//! Identifiers in statements: published verbs and types of activities, and our own.

use uuid::Uuid;

/// Prefix of our own identifiers.
///
/// xAPI requires IRIs that belong to their author, and Vitriol has no domain. A `tag:` needs one too, and other URNs a registry. Anyone
/// may make a UUID (RFC 4122), and a URN may name a part of its thing after `#` (RFC 8141, section 2.3.3).
pub const OURS: Uuid = Uuid::from_u128(0x1f8b_1f5c_f0bb_46f8_b89b_bc29_c464_b683);

/// One of our own identifiers. Characters of `name` that no IRI may have are written as in RFC 3986.
pub(super) fn ours(kind: &str, name: &str) -> String {
    format!("urn:uuid:{OURS}#{kind}/{}", escaped(name))
}

/// The account's place: the class's file, since two classes may have a p07 each. It must be a URL (1.0.3, Data, 2.4.2.4), and `.invalid`
/// belongs to nobody for ever (RFC 2606, section 2).
pub(super) fn home_page(class: Uuid) -> String {
    format!("https://vitriol.invalid/class/{class}")
}

fn escaped(name: &str) -> String {
    let mut text = String::new();
    for byte in name.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            text.push(char::from(byte));
        } else {
            text.push_str(&format!("%{byte:02X}"));
        }
    }
    text
}

/// A verb: its identifier, and its word.
pub(super) struct Verb(pub &'static str, pub &'static str);

// Verbs of ADL's vocabulary, <https://w3id.org/xapi/adl>.

/// A scene was started.
pub(super) const INITIALIZED: Verb =
    Verb("http://adlnet.gov/expapi/verbs/initialized", "initialized");
/// A mishap in something that the student did. Not `failed`, which means that an activity was not passed: stores count those.
pub(super) const INTERACTED: Verb = Verb("http://adlnet.gov/expapi/verbs/interacted", "interacted");
/// A mishap that happened to the student: it asserts nothing of success.
pub(super) const EXPERIENCED: Verb =
    Verb("http://adlnet.gov/expapi/verbs/experienced", "experienced");
/// The attempt is over. It has the score, since `scored` would only repeat that.
pub(super) const COMPLETED: Verb = Verb("http://adlnet.gov/expapi/verbs/completed", "completed");
/// The recording breaks off: cmi5's for an activity that ended out of order.
pub(super) const ABANDONED: Verb = Verb("https://w3id.org/xapi/adl/verbs/abandoned", "abandoned");

/// ADL's type of a task in an artificial context that mimics reality.
pub(super) const SIMULATION: &str = "http://adlnet.gov/expapi/activities/simulation";
/// ADL's type of a lesson.
pub(super) const LESSON: &str = "http://adlnet.gov/expapi/activities/lesson";
/// Activity Streams' type of something that occurs at a place and time. ADL has none for it.
pub(super) const EVENT: &str = "http://activitystrea.ms/schema/1.0/event";

/// A key of an extension, with unit and meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Its name, as in a recording's `/events` and in `report.json`.
    pub name: &'static str,
    /// Its unit; empty for a word.
    pub unit: &'static str,
    /// Its meaning, in a sentence.
    pub meaning: &'static str,
}

impl Key {
    /// The extension's IRI.
    pub fn iri(&self) -> String {
        ours("key", self.name)
    }

    /// The key with this name; `None` if there is none.
    pub fn named(name: &str) -> Option<&'static Self> {
        KEYS.iter().find(|key| key.name == name)
    }
}

const fn key(name: &'static str, unit: &'static str, meaning: &'static str) -> Key {
    Key {
        name,
        unit,
        meaning,
    }
}

/// Every key of an extension.
#[rustfmt::skip]
pub const KEYS: [Key; 21] = [
    key("acid", "1", "mean acid mass fraction"),
    key("bench_m3", "m³", "liquid on the bench at the end"),
    key("broke", "", "whether it broke"),
    key("cap_points", "", "the most points that the lowest cap leaves"),
    key("caps", "", "dangers that cap the points, the lowest cap first"),
    key("cause", "", "why: what was under way where the liquid came from"),
    key("cause_flask", "", "the flask of the cause"),
    key("film_s", "s", "when it began, simulated time of the run"),
    key("flask", "", "the flask"),
    key("floor_m3", "m³", "liquid on the floor at the end"),
    key("hottest_c", "°C", "the hottest liquid of the attempt"),
    key("limit_m3_s", "m³/s", "what is safe"),
    key("met_acid", "1", "acid mass fraction that the first of the water met"),
    key("place_m", "m", "where, in the frame of the scene's file"),
    key("protected", "", "whether gloves or goggles kept it from the skin"),
    key("rate_m3_s", "m³/s", "the most in any half second"),
    key("skin", "", "part of the user"),
    key("speed_m_s", "m/s", "how fast it struck"),
    key("surface", "", "on what it lies"),
    key("temperature_c", "°C", "temperature: the hottest, or of what came to skin the mean"),
    key("volume_m3", "m³", "how much liquid"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_name_becomes_a_part_of_an_iri() {
        assert_eq!(
            ours("scene", "Säure 1#2/%"),
            "urn:uuid:1f8b1f5c-f0bb-46f8-b89b-bc29c464b683#scene/S%C3%A4ure%201%232%2F%25"
        );
    }
}
