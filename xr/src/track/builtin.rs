//! The built-in tracks, in keyframes.
//!
//! All stand at a desk whose top is at y = 0.75 m, with vessels at z = -0.40 m: an arm's
//! length before the seated user's head, above the origin.

use std::path::PathBuf;

/// Makes [`NAMES`] and [`text`] of the names of the files in `xr/tracks`.
macro_rules! builtin {
    ($($name:literal)*) => {
        /// Names of the built-in tracks.
        pub const NAMES: [&str; [$($name),*].len()] = [$($name),*];

        /// The keyframe file of the built-in track `name`.
        pub fn text(name: &str) -> Option<&'static str> {
            match name {
                $($name => Some(include_str!(concat!("../../tracks/", $name, ".toml"))),)*
                _ => None,
            }
        }
    };
}

builtin! {
    "two-flasks"
    "dilute"
    "shake"
    "three-flasks"
    "slow-pour"
    "dropped"
    "hands-off"
    "emergency"
    "examination"
    "layer-and-swirl"
    "rinse-the-bottle"
    "wrong-order"
    "wrong-order-hot"
    "wrong-order-layered"
}

/// File name of a built-in track, for messages.
pub(super) fn file(name: &str) -> PathBuf {
    PathBuf::from(format!("tracks/{name}.toml"))
}
