//! Numbers that look random and are the same each time.

use glam::DVec3;

/// SplitMix64 (Steele, Lea, Flood 2014) from a seed, as numbers in [0, 1).
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next number in [0, 1).
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A point of the cube of edge `size` around the origin.
    pub fn point(&mut self, size: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| size * (self.number() - 0.5)))
    }

    /// `count` such points, as of [`Random::point`].
    pub fn points(&mut self, count: usize, size: f64) -> Vec<DVec3> {
        (0..count).map(|_| self.point(size)).collect()
    }
}
