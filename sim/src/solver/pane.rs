//! The pane of a fume hood's sash, which stops liquid that flies.

use super::{Solver, SolverError};
use glam::Vec3;
use vitriol_gpu::Recorder;
use vitriol_shaders::layout;

/// A pane in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pane {
    /// One lower corner, in the middle of its thickness, m of the scene.
    pub corner: Vec3,
    /// From there along its lower edge, and up its side.
    pub sides: [Vec3; 2],
    /// Its thickness, m.
    pub thickness: f32,
}

impl Solver {
    /// Records that particles in no flask, and drops, do not cross `pane` in a step of `time` seconds.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn stop_at(&self, rec: &mut Recorder, pane: &Pane, time: f64) -> Result<(), SolverError> {
        let constants = layout::Pane {
            corner: pane.corner.to_array(),
            half: 0.5 * pane.thickness,
            along: pane.sides[0].to_array(),
            time: time as f32,
            up: pane.sides[1].to_array(),
            ..layout::Pane::default()
        };
        let drops = self.parameters.bubbles();
        let drops = drops.map_or(0, |bubbles| bubbles.places_of_drops());
        let passes = [
            (&self.pipelines.pane, self.count),
            (&self.pipelines.pane_spray, drops),
        ];
        for (pass, count) in passes {
            if let Some(pass) = pass
                && count > 0
            {
                self.pass(rec, pass)
                    .constants(&constants)
                    .invocations(count)?;
            }
        }
        Ok(())
    }
}
