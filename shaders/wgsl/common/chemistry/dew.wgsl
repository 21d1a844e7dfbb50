// Water on the inner wall of a vessel: places of it, and what they hold (`chemistry/dew.rs`).

/// Places around a wall, and from the inner floor up to the rim.
const DEW_AROUND: u32 = 32u;
const DEW_UP: u32 = 16u;

/// Least water that is counted, kg: what leaves the steam is on the glass, as sums of integers do not depend on order.
const DEW_QUANTUM: f32 = 1e-14;

/// What one place holds.
struct Dew {
    /// Its water, in quanta.
    water: u32,
    /// Temperature of its glass over that of the vessel's glass at that height, K, and what that lacks by rounding.
    excess: f32,
    lacking: f32,
    /// Its water, kg/m².
    film: f32,
}

/// The places of one height, of a vessel.
struct DewRow {
    /// Height and radius of their middles, m.
    height: f32,
    radius: f32,
    /// Area of each, m².
    area: f32,
    /// Heat capacity of the wall, J/(m² K).
    capacity: f32,
}
