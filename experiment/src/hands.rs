//! The user's hands as beads: without them nobody sees where to grip.

use glam::Vec3;
use vitriol_gpu::{Buffer, Gpu, Recorder};
use vitriol_render::{ColourBy, ParticleSource};
use vitriol_xr::{Hand, Pose, PoseFrame, Side};

use crate::failure::{Blame, Failure};

/// How beads are coloured, by their attribute.
pub const BEADS_BY: ColourBy = ColourBy::Speed(1.0);

/// Radius of a bead, m: a finger is some 16 mm thick.
const BEAD_RADIUS: f32 = 0.008;
/// Most beads of two hands.
const MOST_BEADS: u32 = 2 * (PALM as u32 * PALM as u32 + 4 * 4 + 3);

/// Beads along a side of the palm.
const PALM: usize = 3;
/// Distance between beads of the palm and between fingers, m: a palm is some 84 mm broad.
const APART: f32 = 0.021;
/// Length of a finger's joint, m.
const JOINT: f32 = 0.021;
/// How far a joint of a closed hand is bent, rad.
const BENT: f32 = 1.2;

/// A bead: its middle (scene's stage, real m), and 0 to 1 for how closed its hand is.
pub type Bead = (Vec3, f32);

/// Beads on the device.
pub struct Beads {
    /// Middles and attributes.
    buffers: [Buffer; 2],
}

impl Beads {
    /// Room for two hands.
    ///
    /// # Errors
    /// What the device says.
    pub fn new(gpu: &Gpu) -> Result<Self, Failure> {
        let buffer = || Buffer::storage(gpu, "hands", 16 * u64::from(MOST_BEADS)).other();
        let buffers = [buffer()?, buffer()?];
        Ok(Self { buffers })
    }

    /// Records that these are shown, in a scene whose unit is `length_scale` metres.
    ///
    /// # Errors
    /// What the device says.
    pub fn upload(
        &self,
        rec: &mut Recorder,
        beads: &[Bead],
        length_scale: f32,
    ) -> Result<(), Failure> {
        let [middles, attributes] = &self.buffers;
        let shown = beads.iter().take(MOST_BEADS as usize);
        let placed = shown
            .clone()
            .map(|(middle, _)| (*middle / length_scale).extend(0.0).to_array());
        rec.upload(middles, &placed.collect::<Vec<_>>()).other()?;
        // Particles are coloured by speed: a closed hand has the colour of a higher one.
        let coloured = shown.map(|&(_, closed)| [0.35 + 0.4 * closed, 0.0, 0.0, 0.0]);
        rec.upload(attributes, &coloured.collect::<Vec<_>>())
            .other()
    }

    /// So many of them as the renderer takes them; `None` of none.
    pub fn source(&self, count: usize, length_scale: f32) -> Option<ParticleSource<'_>> {
        let [positions, attributes] = &self.buffers;
        (count > 0).then(|| ParticleSource {
            positions,
            attributes,
            count: count.min(MOST_BEADS as usize) as u32,
            radius: BEAD_RADIUS / length_scale,
        })
    }
}

/// The beads of the hands that are there.
pub fn beads(frame: &PoseFrame) -> Vec<Bead> {
    Side::BOTH
        .into_iter()
        .filter(|&side| frame.hand(side).active && frame.hand(side).valid)
        .flat_map(|side| of_hand(frame.hand(side), side))
        .collect()
}

/// OpenXR's grip: −Z runs from the little finger to the thumb, +X out of the left palm and into the
/// right one; so the fingers of an open hand point along −Y.
fn of_hand(hand: &Hand, side: Side) -> Vec<Bead> {
    let closed = hand.squeeze.max(hand.trigger).clamp(0.0, 1.0);
    // From the palm outwards.
    let out = match side {
        Side::Left => Vec3::X,
        Side::Right => Vec3::NEG_X,
    };
    let mut places = Vec::new();
    let palm = |n: usize| APART * (n as f32 - 0.5 * (PALM - 1) as f32);
    let back = -0.012 * out;
    for row in 0..PALM {
        for column in 0..PALM {
            places.push(back + Vec3::new(0.0, palm(row), palm(column)));
        }
    }
    let mut finger = |base: Vec3, mut along: Vec3, joints: usize, bent: f32| {
        let mut at = base;
        for _ in 0..joints {
            at += JOINT * along;
            places.push(at);
            along = (bent.cos() * along + bent.sin() * out).normalize();
        }
    };
    for n in 0..4 {
        let z = APART * (n as f32 - 1.5);
        let base = back + Vec3::new(0.0, -1.4 * APART, z);
        finger(base, Vec3::NEG_Y, 4, BENT * closed);
    }
    let thumb = Vec3::new(0.0, -0.6, -0.8) + 0.3 * out;
    let base = back + Vec3::new(0.0, 0.5 * APART, -1.2 * APART);
    finger(base, thumb.normalize(), 3, 0.4 * BENT * closed);
    let grip: &Pose = &hand.stage_from_grip;
    places
        .into_iter()
        .map(|place| (grip.transform_point(place), closed))
        .collect()
}
