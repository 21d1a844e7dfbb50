//! Presets of accuracy.

use serde::{Deserialize, Serialize};

/// A preset of accuracy: substeps, iterations and particle number.
#[derive(Clone, Copy, Debug, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// Cheapest.
    Fast,
    /// For interactive use in the headset.
    Balanced,
    /// Most accurate.
    Reference,
}

impl Preset {
    /// All of them, the cheapest first.
    pub const ALL: [Self; 3] = [Self::Fast, Self::Balanced, Self::Reference];

    /// The name as it is given and reported.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Balanced => "balanced",
            Self::Reference => "reference",
        }
    }
}
