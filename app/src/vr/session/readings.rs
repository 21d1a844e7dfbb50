//! Temperature and acid of each flask's liquid, as the panel shows them.

use glam::Vec3;
use vitriol_experiment::scenery::has_acid;
use vitriol_experiment::{Blame, Failure};
use vitriol_gpu::Ticket;
use vitriol_sim::scene::{Flask, Scene};
use vitriol_sim::solver::{FlaskReading, ReadingRecord};

use crate::vr::info::FlaskLine;

/// Frames between two readings: ten a second at 90 Hz.
const EVERY: u64 = 9;

/// The last reading, and the next one where it is under way.
#[derive(Default)]
pub(super) struct Readings {
    /// With the submission that it is in; on a device that is gone it never comes.
    pub under_way: Option<(ReadingRecord, Ticket)>,
    /// By flask; empty before the first.
    last: Vec<FlaskReading>,
}

impl Readings {
    /// Whether that frame is to begin a reading.
    pub fn is_due(&self, frame: u64) -> bool {
        self.under_way.is_none() && frame.is_multiple_of(EVERY)
    }

    /// Takes a reading that has come; does not wait.
    pub fn collect(&mut self) -> Result<(), Failure> {
        if let Some((reading, ticket)) = &self.under_way
            && ticket.is_done().other()?
        {
            self.last = reading.get().other()?;
            self.under_way = None;
        }
        Ok(())
    }

    /// Forgets readings of another bench.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// The panel's lines for a scene's flasks. One that hangs upside down, a funnel, has none: it holds nothing
    /// for long.
    pub fn lines(&self, scene: &Scene) -> Vec<FlaskLine> {
        let acid = has_acid(scene);
        let line = |(index, flask): (usize, &Flask)| {
            let reading = self.last.get(index).filter(|reading| reading.particles > 0);
            FlaskLine {
                name: flask.name.clone(),
                temperature: reading.map(|reading| reading.temperature.round() as i32),
                acid: reading
                    .filter(|_| acid)
                    .map(|reading| (100.0 * reading.acid).round() as i32),
            }
        };
        let upright = |flask: &Flask| (flask.stage_from_flask.orientation * Vec3::Y).y > 0.0;
        let flasks = scene.flasks.iter().enumerate();
        flasks
            .filter(|(_, flask)| upright(flask))
            .map(line)
            .collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use glam::Quat;

    fn reading(particles: u32, temperature: f32, acid: f32) -> FlaskReading {
        FlaskReading {
            particles,
            temperature,
            acid,
        }
    }

    #[test]
    fn each_flask_has_a_line_with_what_was_read_in_it() {
        let mut scene = Scene::builtin("water-into-acid").unwrap();
        let names: Vec<_> = scene.flasks.iter().map(|it| it.name.clone()).collect();
        let mut readings = Readings::default();
        let lines = readings.lines(&scene);
        assert_eq!(lines.len(), names.len());
        assert_eq!((lines[0].temperature, lines[0].acid), (None, None));
        // An empty flask has no temperature.
        readings.last = vec![reading(7, 99.6, 0.956), reading(0, 0.0, 0.0)];
        let lines = readings.lines(&scene);
        assert_eq!((lines[0].temperature, lines[0].acid), (Some(100), Some(96)));
        assert_eq!((lines[1].temperature, lines[1].acid), (None, None));
        // Without the first, the second's line is still the second's.
        scene.flasks[0].stage_from_flask.orientation = Quat::from_rotation_x(3.0);
        readings.last[1] = reading(7, 20.4, 0.0);
        let lines = readings.lines(&scene);
        assert_eq!(
            (&lines[0].name, lines[0].temperature),
            (&names[1], Some(20))
        );
        assert_eq!((lines.len(), lines[0].acid), (names.len() - 1, Some(0)));
        // Where there is no acid, none is said.
        for liquid in &mut scene.liquids {
            liquid.acid_fraction = 0.0;
        }
        assert_eq!(readings.lines(&scene)[0].acid, None);
    }
}
