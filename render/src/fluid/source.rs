//! What the liquid is drawn from, and how.

use vitriol_gpu::Buffer;

use crate::RenderError;
use crate::scene::BoxDesc;

/// How the depth of the splatted ellipsoids becomes a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SurfaceFilter {
    /// Truong and Yuksel's narrow-range filter of 2018.
    #[default]
    NarrowRange,
    /// Van der Laan's screen-space curvature flow of 2009, which the paper takes.
    CurvatureFlow,
    /// None: the ellipsoids as they are, to compare with.
    None,
}

/// The liquid surface that a renderer is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LiquidDesc {
    /// Particles at most.
    pub particles: u32,
    /// Filter of the depth.
    pub filter: SurfaceFilter,
    /// Whether particles are ellipsoids by their neighbours' places; else spheres.
    pub anisotropic: bool,
}

impl LiquidDesc {
    /// For `particles` of them, as the program draws by itself.
    pub const fn new(particles: u32) -> Self {
        Self {
            particles,
            filter: SurfaceFilter::NarrowRange,
            anisotropic: true,
        }
    }
}

/// The solver's neighbour list.
#[derive(Clone, Copy)]
pub struct Neighbours<'a> {
    /// `array<u32>`: neighbours of each particle.
    pub counts: &'a Buffer,
    /// `array<u32>`: the k-th neighbour of particle i of n is at k·n + i.
    pub list: &'a Buffer,
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
    /// Who is next to whom; `None` draws spheres.
    pub neighbours: Option<Neighbours<'a>>,
    /// What glass the liquid meets; `None` for none.
    pub vessels: Option<VesselTables<'a>>,
    /// The table that it may lie on.
    pub table: Option<BoxDesc>,
    /// Height of the floor.
    pub floor: f32,
}

impl LiquidSource<'_> {
    /// Whether its buffers hold what it says, and `capacity` is enough for it.
    pub(crate) fn check(&self, capacity: u32) -> Result<(), RenderError> {
        let counts = self.neighbours.map(|neighbours| (neighbours.counts, 4));
        let buffers = [
            Some((self.positions, 16)),
            self.heat.map(|heat| (heat, 16)),
            self.volumes.map(|volumes| (volumes, 16)),
            counts,
        ];
        for (buffer, bytes) in buffers.into_iter().flatten() {
            let held = buffer.bytes() / bytes;
            if u64::from(self.count) > held {
                return Err(RenderError::TooManyParticles {
                    count: self.count,
                    buffer: buffer.label().to_owned(),
                    held,
                });
            }
        }
        if self.count > capacity {
            return Err(RenderError::TooManyParticles {
                count: self.count,
                buffer: "ellipsoids".to_owned(),
                held: capacity.into(),
            });
        }
        Ok(())
    }
}
