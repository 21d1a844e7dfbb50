//! The solver's own buffers that a frame is drawn from.

use vitriol_gpu::Buffer;

use vitriol_shaders::layout;

use crate::RenderError;
use crate::desc::LiquidDesc;
use crate::scene::BoxDesc;

/// Particles in the solver's own buffers.
#[derive(Clone, Copy)]
pub struct ParticleSource<'a> {
    /// `array<vec4<f32>>`: xyz in the stage, in the scene's unit; w < 0 marks
    /// a particle that was taken out.
    pub positions: &'a Buffer,
    /// `array<vec4<f32>>` in the same order, of the attribute that [`FrameDesc::colour_by`](crate::FrameDesc) shows: velocities (xyz, the
    /// scene's unit per second), or temperature (°C) and acid fraction in x and y.
    pub attributes: &'a Buffer,
    /// How many of them are drawn.
    pub count: u32,
    /// Radius of a sphere, in the scene's unit. 0.6 of the particle spacing
    /// closes the gaps between them.
    pub radius: f32,
}

/// Puffs of steam.
#[derive(Clone, Copy)]
pub struct SteamSource<'a> {
    /// `array<Puff>` ([`Puff`](vitriol_shaders::layout::Puff)): centre, radius (m) and optical depth.
    /// A radius of 0 draws nothing.
    pub puffs: &'a Buffer,
    /// How many of them are drawn.
    pub count: u32,
    /// Water on the vessels' inner walls, by vessel, `array<Dew>` ([`Dew`](vitriol_shaders::layout::Dew)) as `common/chemistry/dew.wgsl`
    /// has it; `None` for none.
    pub dew: Option<&'a Buffer>,
}

/// The solver's neighbour list.
#[derive(Clone, Copy)]
pub struct Neighbours<'a> {
    /// `array<u32>`: neighbours of each particle.
    pub counts: &'a Buffer,
    /// `array<vec4<u32>>`: fours of neighbours, as `common/liquid/list_block.wgsl` has them.
    pub list: &'a Buffer,
    /// Fours that the list has room for, of each particle.
    pub fours: u32,
    /// Support radius h, within which the list is complete, in the scene's unit.
    pub support: f32,
}

/// The solver's tables of the vessels' shapes, in the order of the frame's poses.
#[derive(Clone, Copy)]
pub struct VesselTables<'a> {
    /// `array<Flask>` of `common/glass/vessel.wgsl`.
    pub flasks: &'a Buffer,
    /// `array<f32>`: signed distances to the glass over (r, y).
    pub distances: &'a Buffer,
}

/// Bubbles in the liquid.
#[derive(Clone, Copy)]
pub struct BubbleSource<'a> {
    /// `array<Bubble>` ([`Bubble`](vitriol_shaders::layout::Bubble)): centre and radius in the scene's unit. An entry with neither steam
    /// nor air is no bubble.
    pub bubbles: &'a Buffer,
    /// Number of entries.
    pub count: u32,
    /// Drops that they threw up; `None` where spray is not simulated.
    pub spray: Option<SpraySource<'a>>,
}

/// Drops that bubbles threw up.
#[derive(Clone, Copy)]
pub struct SpraySource<'a> {
    /// `array<Drops>` ([`Drops`](vitriol_shaders::layout::Drops)), two for each place of a bubble.
    pub drops: &'a Buffer,
    /// Mass of a particle at rest density, kg: the unit of the drops' masses.
    pub mass: f32,
}

/// Liquid in the solver's own buffers, in the scene's unit.
#[derive(Clone, Copy)]
pub struct LiquidSource<'a> {
    /// `array<vec4<f32>>`: xyz in the stage; w < 0 marks a particle that was
    /// taken out.
    pub positions: &'a Buffer,
    /// `array<vec4<f32>>` in the same order: temperature (°C) and acid mass
    /// fraction in x and y; `None` for water.
    pub heat: Option<&'a Buffer>,
    /// `array<vec4<f32>>` in the same order: volume over d³ in x; `None` where
    /// each has d³.
    pub volumes: Option<&'a Buffer>,
    /// How many of them are drawn.
    pub count: u32,
    /// Particle spacing d: a particle at rest density is d³ of liquid.
    pub spacing: f32,
    /// The neighbours; without them particles are drawn as spheres.
    pub neighbours: Option<Neighbours<'a>>,
    /// Glass that cuts the liquid; `None` for none.
    pub vessels: Option<VesselTables<'a>>,
    /// Bubbles in it; `None` for none.
    pub bubbles: Option<BubbleSource<'a>>,
    /// The table that liquid may lie on.
    pub table: Option<BoxDesc>,
    /// Height of the floor.
    pub floor: f32,
}

impl LiquidSource<'_> {
    /// Checks that its buffers are as large as it states, and that a renderer made for `desc` can draw it.
    pub(crate) fn check(&self, desc: &LiquidDesc) -> Result<(), RenderError> {
        let counts = self.neighbours.map(|neighbours| (neighbours.counts, 4));
        let buffers = [
            Some((self.positions, 16)),
            self.heat.map(|heat| (heat, 16)),
            self.volumes.map(|volumes| (volumes, 16)),
            counts,
        ];
        for (buffer, bytes) in buffers.into_iter().flatten() {
            check_count(self.count, buffer.label(), buffer.bytes() / bytes)?;
        }
        check_count(self.count, "ellipsoids", desc.particles.into())?;
        let Some(source) = self.bubbles else {
            return Ok(());
        };
        let drops = source.spray.map(|spray| spray.drops);
        let drops = drops.map(|drops| (drops, 2 * size_of::<layout::Drops>()));
        let bubbles = std::iter::once((source.bubbles, size_of::<layout::Bubble>()));
        for (buffer, bytes) in bubbles.chain(drops) {
            let held = (buffer.bytes() / bytes as u64).min(desc.bubbles.into());
            check_count(source.count, buffer.label(), held)?;
        }
        Ok(())
    }
}

/// Refuses more particles than the buffer of that label holds.
pub(crate) fn check_count(count: u32, label: &str, held: u64) -> Result<(), RenderError> {
    if u64::from(count) <= held {
        return Ok(());
    }
    Err(RenderError::TooManyParticles {
        count,
        buffer: label.to_owned(),
        held,
    })
}
