//! How a movement between two keyframes runs in time.

use serde::Deserialize;

/// Course of the movement that arrives at a keyframe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ease {
    /// Starts and ends at rest, with the least jerk: how a hand moves from place to place
    /// (Flash and Hogan 1985, J. Neurosci. 5(7), 1688).
    #[default]
    Smooth,
    /// Constant speed.
    Linear,
    /// Stays at the earlier keyframe and jumps at the later one's time.
    Hold,
}

impl Ease {
    /// The part of the way covered after the part `t` of the time, both 0..=1.
    pub fn at(self, t: f64) -> f64 {
        match self {
            Self::Smooth => t * t * t * (10.0 + t * (6.0 * t - 15.0)),
            Self::Linear => t,
            Self::Hold => {
                if t < 1.0 {
                    0.0
                } else {
                    1.0
                }
            }
        }
    }
}
