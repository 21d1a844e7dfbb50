//! A column of liquid that collapses on the floor, with nothing around it.
//!
//! There are no rectangular vessels, so Martin and Moyce's wall is the plane of symmetry of a block of twice their column's base, and
//! their flume's side walls are far ends of the block: the collapse of the ends comes in as a wave of speed √(gH), and has not reached the
//! middle, where the front is read, before T = [`Column::LAST_TIME`].

use glam::DVec3;
use vitriol_gpu::Gpu;
use vitriol_run::{Blame, Failure};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::{Ground, Particle, SolverSpec, SolverState};

use crate::liquid::{alone, frame, solver, water};

/// A rectangular column before a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Base a from the wall to the free face, metres.
    pub base: f64,
    /// Height H over base, n².
    pub n_squared: u32,
    /// Particle spacings in a base, a/d.
    pub resolution: u32,
}

/// Distance of the front at a time, both dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Front {
    /// T = t √(n² g / a).
    pub time: f64,
    /// Z = z/a, from the wall.
    pub distance: f64,
}

impl Column {
    /// Half of the block's width across the flow, in bases.
    const HALF_WIDTH: u32 = 4;

    /// Half of the width in which the front is read, in bases.
    const HALF_READ: f64 = 0.5;

    /// T at which the block's ends reach the part that is read: with waves of
    /// speed √(gH), T counts bases.
    pub const LAST_TIME: f64 = Self::HALF_WIDTH as f64 - Self::HALF_READ;

    /// Lets it go, and follows its front up to T = `last`; solver and liquid
    /// are those of `scene` (its preset applied), but for the spacing.
    ///
    /// # Errors
    /// The error of the device or of a shader.
    pub fn collapse(&self, gpu: &Gpu, scene: &Scene, last: f64) -> Result<Vec<Front>, Failure> {
        let spacing = self.base / f64::from(self.resolution);
        let parameters = halved(Parameters {
            spacing,
            support_radius: scene.scale.support_ratio * spacing,
            ..Parameters::from_scene(&scene.without_sleep())
        });
        let gravity = scene.scale.gravity;
        let particles = self.block(spacing, gravity);
        let spec = SolverSpec {
            ground: Ground {
                floor: 0.0,
                table: None,
                scale: 1.0,
            },
            ..alone(parameters.clone(), &particles)
        };
        let solver = solver(gpu, &spec)?;
        let unit = (self.base / (f64::from(self.n_squared) * gravity)).sqrt();
        let frames = (last * unit / parameters.frame_time).ceil() as u32;
        let mut fronts = vec![self.front(&solver.snapshot().other()?, spacing)];
        for _ in 0..frames {
            frame(gpu, &solver, &[], &[])?;
            fronts.push(self.front(&solver.snapshot().other()?, spacing));
        }
        let fronts = (0..).zip(fronts).map(|(frame, distance)| Front {
            time: f64::from(frame) * parameters.frame_time / unit,
            distance,
        });
        Ok(fronts.collect())
    }

    /// Particles of the block, d/2 inside its faces, under the pressure of their
    /// depth: behind the gate, the column was at rest.
    fn block(&self, d: f64, gravity: f64) -> Vec<Particle> {
        let (x, y, z) = (
            2 * self.resolution,
            self.n_squared * self.resolution,
            2 * Self::HALF_WIDTH * self.resolution,
        );
        let site = |index: u32, count: u32| (f64::from(index) + 0.5 - 0.5 * f64::from(count)) * d;
        let mut particles = Vec::with_capacity((x * y * z) as usize);
        for j in 0..y {
            let height = (f64::from(j) + 0.5) * d;
            for k in 0..z {
                particles.extend((0..x).map(|i| Particle {
                    carried: gravity * (height - f64::from(y) * d),
                    ..water(DVec3::new(site(i, x), height, site(k, z)))
                }));
            }
        }
        particles
    }

    /// Z of the front: in the middle of the block, the furthest that liquid
    /// reaches without a gap of a support radius (2 d), d/2 beyond the
    /// particle's centre; the mean of both sides.
    fn front(&self, state: &SolverState, d: f64) -> f64 {
        let read = Self::HALF_READ * self.base;
        let middle = || {
            state
                .positions
                .iter()
                .filter(|p| f64::from(p[2].abs()) < read)
        };
        let side = |sign: f32| {
            let mut reach: Vec<_> = middle().map(|p| f64::from(sign * p[0])).collect();
            reach.retain(|&x| x > 0.0);
            reach.sort_by(f64::total_cmp);
            let connected = reach.iter().scan(0.0, |last, &x| {
                let joined = x - *last < 2.0 * d;
                *last = x;
                joined.then_some(x)
            });
            connected.last().unwrap_or(0.0) + 0.5 * d
        };
        0.5 * (side(1.0) + side(-1.0)) / self.base
    }
}

/// Parameters with the same substeps in frames of half the length, so that the front is observed more often; unchanged for an odd number
/// of substeps.
fn halved(parameters: Parameters) -> Parameters {
    if !parameters.substeps.is_multiple_of(2) {
        return parameters;
    }
    Parameters {
        frame_time: 0.5 * parameters.frame_time,
        substeps: parameters.substeps / 2,
        ..parameters
    }
}
