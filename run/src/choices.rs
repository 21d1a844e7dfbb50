//! The scenes that a session offers.

/// A scene that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Its key.
    pub key: char,
    /// Name of the scene.
    pub scene: &'static str,
    /// What it is, for people.
    pub title: &'static str,
}

/// The scenes.
pub const CHOICES: [Choice; 6] = [
    choice('1', "acid-into-water", "Correct: acid into water"),
    choice('2', "water-into-acid", "Incorrect: water into acid"),
    choice('3', "triple-dilution", "The paper's three flasks"),
    choice('4', "vr-dilution", "The paper's VR dilution"),
    choice('5', "two-flasks", "Water, two flasks"),
    choice('6', "three-flasks", "Water, three flasks"),
];

const fn choice(key: char, scene: &'static str, title: &'static str) -> Choice {
    Choice { key, scene, title }
}
