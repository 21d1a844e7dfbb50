//! Bones, from which hands and tools are drawn, each of one finish.

use glam::Vec3;

/// Most bones of a hand, and of all tools together, as in `common/picture/bones.wgsl`.
pub const MOST_BONES: usize = 32;

/// Distance over which the bones of a hand join smoothly, metres: they add up to a quarter of it where they meet, 1 mm. With
/// more, fingers that touch grow together.
pub const JOINED: f32 = 0.004;

/// Reflectance where acid has charred a glove. Ours: about the sRGB colour (62, 42, 28).
pub(crate) const CHARRED: Vec3 = Vec3::new(0.048, 0.023, 0.011);

/// The material of a bone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finish {
    /// A glove.
    Glove,
    /// Its cuff, which is lighter.
    Cuff,
    /// A ray of light, that a hand points with.
    Ray,
    /// A handle to hold on to, that is not of the hand.
    Handle,
    /// A handle ([`Finish::Handle`]) while a hand is at it.
    HandleAtHand,
    /// A hand without a glove.
    Skin,
    /// A glass rod.
    Rod,
    /// A thermometer's bulb.
    Column,
    /// A thermometer's stem, of which only tools have one.
    Scale(Scale),
    /// Frame and strap of goggles.
    Frame,
    /// Woven cotton.
    Cloth,
    /// A box of card.
    Card,
    /// Brushed steel.
    Steel,
}

impl Finish {
    /// Reflectance of red, green and blue, and how much it shines by itself instead. Ours: glove and cuff are in the room's light
    /// about the sRGB colours (70, 110, 170) and (120, 150, 190). The others are the panel's amber, which neither glass nor
    /// liquids have.
    pub(crate) fn tint(self) -> ([f32; 3], f32) {
        match self {
            Self::Glove => ([0.075, 0.130, 0.245], 0.0),
            Self::Cuff => ([0.180, 0.240, 0.330], 0.0),
            Self::Ray => ([0.90, 0.52, 0.11], 1.0),
            Self::Handle => ([0.55, 0.28, 0.05], 0.0),
            Self::HandleAtHand => ([0.90, 0.52, 0.11], 0.6),
            Self::Skin => ([0.420, 0.220, 0.140], 0.0),
            Self::Rod | Self::Scale(_) => ([0.550, 0.610, 0.620], 0.0),
            Self::Column => ([0.450, 0.020, 0.020], 0.0),
            Self::Frame => ([0.060, 0.075, 0.085], 0.0),
            Self::Cloth => ([0.620, 0.560, 0.300], 0.0),
            Self::Card => ([0.480, 0.480, 0.460], 0.0),
            Self::Steel => ([0.380, 0.390, 0.400], 0.0),
        }
    }
}

/// A thermometer's scale on its stem, which begins at the bone's first end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The lowest and the highest mark, whole °C.
    pub celsius: [f32; 2],
    /// How far they are from the middle of the bone's first end, metres.
    pub heights: [f32; 2],
    /// The temperature that it shows, °C: the column's end is there.
    pub reading: f32,
}

/// One bone of a glove, or an object that is drawn like one: the convex hull of two spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bone {
    /// The spheres' middles in the stage, metres.
    pub ends: [Vec3; 2],
    /// Their radii, metres.
    pub radii: [f32; 2],
    /// Its material.
    pub finish: Finish,
    /// How black acid has made it, 0 to 1.
    pub stain: f32,
}

impl Bone {
    /// A bone that no acid has blackened.
    pub const fn new(finish: Finish, ends: [Vec3; 2], radii: [f32; 2]) -> Self {
        Self {
            ends,
            radii,
            finish,
            stain: 0.0,
        }
    }
}
