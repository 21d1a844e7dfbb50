//! Action of tools on the liquid, before Algorithm 1 begins: a rod drags it along, a cloth takes it up.

use super::{Solver, SolverError};
use glam::Vec3;
use vitriol_gpu::Recorder;
use vitriol_shaders::layout::Handle;

/// Drag coefficient of a long cylinder across a stream, over its diameter, at Reynolds numbers of 10³ to 10⁵: a rod of 7 mm that moves with
/// 0.2 m/s in water has 1400 (F. M. White, Fluid Mechanics, drag of two-dimensional bodies: 1.2).
pub const ROD_DRAG: f32 = 1.2;

/// Speed from which a rod stirs liquid that sleeps, m/s. Chosen: one that lies in a vessel trembles less.
const STIRS: f32 = 1e-3;

/// A tool's cylinder in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Ends of its axis at the step's end, m of the scene.
    pub ends: [Vec3; 2],
    /// Velocities of the ends, m/s.
    pub velocities: [Vec3; 2],
    /// Its radius, m.
    pub radius: f32,
    /// Whether it takes liquid up; else it drags it along.
    pub wipes: bool,
}

impl Solver {
    /// Records the action of `touch` in a step of `time` seconds. Bubbles and drops that fly are not affected.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn handle(&self, rec: &mut Recorder, touch: &Touch, time: f64) -> Result<(), SolverError> {
        let Some(pass) = &self.pipelines.handle else {
            return Ok(());
        };
        if self.count == 0 {
            return Ok(());
        }
        // A cloth takes up what is nobody's, which never sleeps.
        let stirs = !touch.wipes && touch.velocities.iter().any(|v| v.length() > STIRS);
        if stirs {
            self.still.disturb();
        }
        let [a, b] = touch.ends.map(|it| it.to_array());
        let [velocity_a, velocity_b] = touch.velocities.map(|it| it.to_array());
        let handle = Handle {
            a,
            radius: touch.radius,
            b,
            wipes: touch.wipes.into(),
            velocity_a,
            time: time as f32,
            velocity_b,
            drag: ROD_DRAG,
            stirs: stirs.into(),
            ..Handle::default()
        };
        self.pass(rec, pass)
            .constants(&handle)
            .invocations(self.count)?;
        Ok(())
    }
}
