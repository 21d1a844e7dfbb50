//! Contents of flasks before Algorithm 1 begins: they go with a flask that leaps, and belong to no flask once theirs has broken.

use super::{Solver, SolverError};
use crate::bodies::Leap;
use crate::pose::Pose;
use vitriol_gpu::Recorder;
use vitriol_shaders::layout::Carry;

/// Membership of particles in no flask, as in `common/liquid/particle.wgsl`.
const NOBODYS: u32 = 0;

impl Solver {
    /// Records the rigid motion of `leap` for the contents of its flask: particles, bubbles and drops.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn carry(&self, rec: &mut Recorder, leap: &Leap) -> Result<(), SolverError> {
        let membership = leap.flask as u32 + 1;
        self.move_contents(rec, leap, membership)
    }

    /// Records that the contents of a flask belong to no flask from now on: they stay where they are, without glass around them.
    ///
    /// # Errors
    /// As for [`Solver::carry`].
    pub fn release(&self, rec: &mut Recorder, flask: usize) -> Result<(), SolverError> {
        let stays = Leap {
            flask,
            after_from_before: Pose::IDENTITY,
        };
        self.move_contents(rec, &stays, NOBODYS)
    }

    fn move_contents(
        &self,
        rec: &mut Recorder,
        leap: &Leap,
        becomes: u32,
    ) -> Result<(), SolverError> {
        let Some(pass) = &self.pipelines.carry else {
            return Ok(());
        };
        if self.count == 0 {
            return Ok(());
        }
        self.still.disturb();
        let bubbles = self.parameters.bubbles();
        // Two records of drops for each place of a bubble.
        let places = bubbles.map_or(0, |bubbles| 2 * bubbles.slots());
        let motion = leap.after_from_before;
        let carry = Carry {
            position: motion.position.extend(0.0).to_array(),
            orientation: motion.orientation.to_array(),
            membership: leap.flask as u32 + 1,
            becomes,
            ..Carry::default()
        };
        self.pass(rec, pass)
            .constants(&carry)
            .invocations(self.count.max(places))?;
        Ok(())
    }
}
