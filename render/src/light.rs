//! Brightness of the room.

/// The room's light relative to a day's, and its exposure.
///
/// A day's light gives the bench an irradiance of π · 1.29 in the shaders' unit, which is taken to be 800 lx: a room by day near a window.
/// EN 12464-1 asks for 500 lx where one works in a laboratory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoomLight {
    /// The window's light relative to a day's.
    pub window: f32,
    /// The light of ceiling, lamps and floor relative to a day's.
    pub sky: f32,
    /// Factor of light before tone mapping: the adaptation of an eye or a camera, which is only partial.
    pub exposure: f32,
}

impl RoomLight {
    /// By day: 800 lx on the bench.
    pub const DAY: Self = Self {
        window: 1.0,
        sky: 1.0,
        exposure: 1.0,
    };

    /// A sunny noon with all lamps on, 1,700 lx on the bench: shown 1.36 times as bright as a day's.
    pub const BRIGHT: Self = Self {
        window: 2.5,
        sky: 1.6,
        exposure: 0.65,
    };

    /// By evening, with the ceiling's lamps dimmed and the hood's own lamp on: 70 lx on the bench, shown a quarter as bright as a day's.
    pub const DARK: Self = Self {
        window: 0.04,
        sky: 0.15,
        exposure: 2.5,
    };
}

impl Default for RoomLight {
    fn default() -> Self {
        Self::DAY
    }
}
