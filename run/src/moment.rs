//! What looks on while a run goes on.

use vitriol_xr::PoseFrame;

use crate::clock::SimulatedTime;
use crate::experiment::Experiment;
use crate::failure::Failure;

/// Where a run is.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// Steps and simulated time so far.
    pub time: SimulatedTime,
    /// What the user did in the last step; `None` before the first.
    pub frame: Option<&'a PoseFrame>,
}

/// Takes what it wants of an experiment, after each step and before the first.
pub trait Watch<E: Experiment + ?Sized> {
    /// Takes what is due.
    ///
    /// # Errors
    /// What the experiment or the place of the results say.
    fn observe(&mut self, moment: &Moment<'_>, experiment: &mut E) -> Result<(), Failure>;

    /// What follows is another scene, or the same from its start.
    ///
    /// # Errors
    /// What the place of the results says.
    fn start_over(&mut self) -> Result<(), Failure>;
}
