//! The one loop for replay and picture: poses in, simulation steps, pictures
//! and samples out, on the simulation's own fixed clock.

use vitriol_xr::{PoseFrame, PoseSource};

use crate::clock::{SimulatedTime, Span};
use crate::experiment::Experiment;
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
    let mut time = SimulatedTime::default();
    watch.observe(&Moment { time, frame: None }, experiment)?;
    let mut held: Option<PoseFrame> = None;
    while !span.is_over(&time) {
        interrupt::check()?;
        let step = time.steps();
        match source.next(step, time.seconds()).other()? {
            Some(frame) => held = Some(frame),
            None => {
                if let Some(frame) = &mut held {
                    frame.step = step;
                    // A switch acts once, not again in each held frame.
                    frame.scenario.clear();
                }
            }
        }
        let Some(frame) = &held else {
            return Err("the track has no pose at its start; record it again").input();
        };
        let taken = experiment.step(frame)?;
        if taken.anew {
            watch.start_over()?;
        }
        time.advance(taken.frame_time);
        let frame = Some(frame);
        watch.observe(&Moment { time, frame }, experiment)?;
    }
    Ok(())
}
