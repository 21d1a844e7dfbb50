//! The built-in tracks, in keyframes.
//!
//! All stand at a desk whose top is at y = 0.75 m, with vessels at z = -0.40 m: an arm's
//! length before the seated user's head, above the origin.

use std::path::PathBuf;

/// Names of the built-in tracks.
pub const NAMES: [&str; 14] = [
    "two-flasks",
    "dilute",
    "shake",
    "three-flasks",
    "slow-pour",
    "dropped",
    "hands-off",
    "emergency",
    "examination",
    "layer-and-swirl",
    "rinse-the-bottle",
    "wrong-order",
    "wrong-order-hot",
    "wrong-order-layered",
];

/// The keyframe file of the built-in track `name`.
pub fn text(name: &str) -> Option<&'static str> {
    match name {
        "two-flasks" => Some(include_str!("../../tracks/two-flasks.toml")),
        "dilute" => Some(include_str!("../../tracks/dilute.toml")),
        "shake" => Some(include_str!("../../tracks/shake.toml")),
        "three-flasks" => Some(include_str!("../../tracks/three-flasks.toml")),
        "slow-pour" => Some(include_str!("../../tracks/slow-pour.toml")),
        "dropped" => Some(include_str!("../../tracks/dropped.toml")),
        "hands-off" => Some(include_str!("../../tracks/hands-off.toml")),
        "emergency" => Some(include_str!("../../tracks/emergency.toml")),
        "examination" => Some(include_str!("../../tracks/examination.toml")),
        "layer-and-swirl" => Some(include_str!("../../tracks/layer-and-swirl.toml")),
        "rinse-the-bottle" => Some(include_str!("../../tracks/rinse-the-bottle.toml")),
        "wrong-order" => Some(include_str!("../../tracks/wrong-order.toml")),
        "wrong-order-hot" => Some(include_str!("../../tracks/wrong-order-hot.toml")),
        "wrong-order-layered" => Some(include_str!("../../tracks/wrong-order-layered.toml")),
        _ => None,
    }
}

/// File name of a built-in track, for messages.
pub(super) fn file(name: &str) -> PathBuf {
    PathBuf::from(format!("tracks/{name}.toml"))
}
