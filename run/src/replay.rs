//! The one loop for replay and picture: poses in, simulation steps, pictures
//! and samples out, on the simulation's own fixed clock.

use vitriol_xr::{PoseFrame, PoseSource};

use crate::clock::{SimulatedTime, Span};
use crate::experiment::{Experiment, Taken};
use crate::failure::{Blame, Failure};
use crate::interrupt;
use crate::moment::{Moment, Watch};

/// Runs an experiment with the poses of a source. Where the source ends before
/// the span does, its last poses are held. The span's steps are those of the scene
/// at the start; where a switch brings up one with others, the time counts.
///
/// # Errors
/// An error of source, experiment or film.
pub fn replay<E: Experiment + ?Sized>(
    source: &mut dyn PoseSource,
    experiment: &mut E,
    span: Span,
    watch: &mut impl Watch<E>,
) -> Result<(), Failure> {
    let mut stepping = Stepping::default();
    watch.observe(&stepping.moment(), experiment)?;
    while !span.is_over(&stepping.time) {
        if stepping.step(source, experiment)?.anew {
            watch.start_over()?;
        }
        watch.observe(&stepping.moment(), experiment)?;
    }
    Ok(())
}

/// Where a run is that is stepped one step at a time, as two are that keep up with each other.
#[derive(Debug, Default)]
pub struct Stepping {
    time: SimulatedTime,
    held: Option<PoseFrame>,
}

impl Stepping {
    /// Steps and simulated time so far.
    pub fn time(&self) -> SimulatedTime {
        self.time
    }

    /// Takes one step with the source's next poses, or with its last ones where it has ended.
    ///
    /// # Errors
    /// An error of source or experiment.
    pub fn step<E: Experiment + ?Sized>(
        &mut self,
        source: &mut dyn PoseSource,
        experiment: &mut E,
    ) -> Result<Taken, Failure> {
        interrupt::check()?;
        let step = self.time.steps();
        match source.next(step, self.time.seconds()).other()? {
            Some(frame) => self.held = Some(frame),
            None => {
                if let Some(frame) = &mut self.held {
                    frame.step = step;
                    // A switch acts once, not again in each held frame.
                    frame.scenario.clear();
                }
            }
        }
        let Some(frame) = &self.held else {
            return Err("the track has no pose at its start; record it again").input();
        };
        let taken = experiment.step(frame)?;
        self.time.advance(taken.frame_time);
        Ok(taken)
    }

    fn moment(&self) -> Moment<'_> {
        Moment {
            time: self.time,
            frame: self.held.as_ref(),
        }
    }
}
