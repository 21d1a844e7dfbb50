//! The liquids' tints. Water and sulfuric acid are both clear; so that they can
//! be told apart, each absorbs a part of the light that it would not.

/// What 60 mm of water let through of red, green and blue light.
pub const WATER: [f32; 3] = [0.40, 0.74, 0.92];

/// What 60 mm of pure acid let through.
pub const ACID: [f32; 3] = [0.96, 0.70, 0.22];

/// The path for which the tints are stated, metres: about a beaker's width.
pub const PATH: f32 = 0.06;

/// Absorption per metre, by Beer and Lambert.
pub(crate) fn absorption(tint: [f32; 3]) -> [f32; 3] {
    tint.map(|share| -share.ln() / PATH)
}

/// sRGB-encoded colour of white paper seen through that path.
pub fn seen_through(tint: [f32; 3]) -> [f32; 3] {
    tint.map(|linear| 1.055 * linear.powf(1.0 / 2.4) - 0.055)
}
