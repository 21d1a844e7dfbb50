//! The specification from which a solver is made.

use crate::flask::Profile;
use crate::flask::particles::BoundaryParticle;
use crate::parameters::Parameters;
use crate::scene::TableTop;
use glam::{DVec2, DVec3};

/// A fluid particle at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Particle {
    /// Position in the stage, metres.
    pub position: DVec3,
    /// Velocity, m/s.
    pub velocity: DVec3,
    /// Index of the flask it is in.
    pub flask: Option<usize>,
    /// Temperature, °C; unused where no heat is modelled.
    pub temperature: f64,
    /// Acid mass fraction; unused where no heat is modelled.
    pub acid: f64,
    /// Carried multiplier −p/ρ at the start, m²/s², at most 0; unused where
    /// nothing is carried.
    pub carried: f64,
}

/// Specification of a solver: parameters, flasks, ground and particles.
#[derive(Clone, Debug)]
pub struct SolverSpec<'a> {
    /// Parameters of Algorithm 1.
    pub parameters: Parameters,
    /// Shapes of the flasks, in the order of their poses.
    pub flasks: &'a [Profile],
    /// The paper's boundary particles of each flask, in its frame; `None` for
    /// volume maps.
    pub solids: Option<&'a [Vec<BoundaryParticle>]>,
    /// Table and floor.
    pub ground: Ground,
    /// The fluid.
    pub particles: &'a [Particle],
    /// Whether it stands in its flasks: where it may sleep, it settles first (`sim/sleep.wgsl`).
    pub at_rest: bool,
    /// Whether the liquid's push on the flasks is summed up each frame.
    pub loads: bool,
    /// Whether tools touch the liquid, and hands are rinsed.
    pub tools: bool,
    /// Whether the flask constraint of section 5 acts. Without it walls are
    /// what they are to plain PBF: a density, and no more (Fig. 5).
    pub constraint: bool,
    /// Invocations that share a particle: 1, 2, 4 or 8; `None` lets the
    /// device and the number of particles decide.
    pub lanes: Option<u32>,
}

/// Table and floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Height of the floor, metres.
    pub floor: f64,
    /// The table: height of its top, centre and full extent in (x, z), metres.
    pub table: Option<(f64, DVec2, DVec2)>,
    /// Lengths of the scene over those at real size.
    pub scale: f64,
}

impl Ground {
    /// Height of the table's underside, metres.
    pub fn table_under(&self, top: f64) -> f64 {
        top - TableTop::THICKNESS * self.scale
    }
}
