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
    /// An error of the experiment or of the place of the results.
    fn observe(&mut self, moment: &Moment<'_>, experiment: &mut E) -> Result<(), Failure>;

    /// What follows is another scene, or the same from its start.
    ///
    /// # Errors
    /// An error of the place of the results.
    fn start_over(&mut self) -> Result<(), Failure>;
}
