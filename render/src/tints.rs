//! The liquids' tints. Water and sulfuric acid are both clear; so that they can be told apart, each absorbs light that it would not absorb
//! in reality. Without tints, they differ by how they bend light alone.

/// The absorption that the liquids are drawn with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tint {
    /// The artificial tints [`WATER`] and [`ACID`], so that they can be told apart.
    #[default]
    Artificial,
    /// Their real absorption: next to nothing.
    None,
}

impl Tint {
    /// Absorption of water, and of pure acid, per metre.
    pub(crate) fn absorptions(self) -> [[f32; 3]; 2] {
        match self {
            Self::Artificial => [WATER, ACID].map(absorption),
            Self::None => [TRUE_WATER, [0.0; 3]],
        }
    }
}

/// Absorption of water, per metre, at the dominant wavelengths of Rec. 709's primaries, 611, 549 and 464 nm: Pope and Fry 1997, table 3.
/// No figure was found for acid; a bottle of it looks as clear.
const TRUE_WATER: [f32; 3] = [0.265, 0.055, 0.010];

/// Share of red, green and blue light that 60 mm of water let through.
pub const WATER: [f32; 3] = [0.40, 0.74, 0.92];

/// Share of red, green and blue light that 60 mm of pure acid let through.
pub const ACID: [f32; 3] = [0.96, 0.70, 0.22];

/// The path for which the tints are stated, metres: about a beaker's width.
pub const PATH: f32 = 0.06;

/// Absorption per metre, by Beer and Lambert.
fn absorption(tint: [f32; 3]) -> [f32; 3] {
    tint.map(|share| -share.ln() / PATH)
}

/// sRGB-encoded colour of white paper seen through [`PATH`] of a liquid with that tint.
pub fn seen_through(tint: [f32; 3]) -> [f32; 3] {
    tint.map(|linear| 1.055 * linear.powf(1.0 / 2.4) - 0.055)
}
