//! Temperature and composition by flask, read while the simulation goes on.

use super::{Solver, SolverError};
use vitriol_gpu::{Readback, Recorder};

/// What a thermometer in a flask says, and a hydrometer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlaskReading {
    /// Particles in it.
    pub particles: u32,
    /// Mean temperature over them, °C.
    pub temperature: f32,
    /// Mean acid mass fraction over them.
    pub acid: f32,
}

/// A reading under way.
pub struct ReadingRecord {
    heat: Readback,
    tags: Readback,
    count: usize,
    flasks: usize,
}

impl Solver {
    /// Records the copies of which a reading is made, behind a frame; `None` where no heat is
    /// modelled.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn record_reading(&self, rec: &mut Recorder) -> Result<Option<ReadingRecord>, SolverError> {
        let Some(heat) = self.heat() else {
            return Ok(None);
        };
        Ok(Some(ReadingRecord {
            heat: rec.read_back(heat)?,
            tags: rec.read_back(&self.buffers.tags)?,
            count: self.count as usize,
            flasks: self.flasks,
        }))
    }
}

impl ReadingRecord {
    /// By flask.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] before the submission is done.
    pub fn get(&self) -> Result<Vec<FlaskReading>, SolverError> {
        let (heat, tags) = (self.heat.get::<[f32; 4]>()?, self.tags.get::<[u32; 2]>()?);
        let mut sums = vec![(0_u32, 0.0_f64, 0.0_f64); self.flasks];
        let particles = heat.iter().zip(&tags).take(self.count);
        for (&[temperature, acid, ..], &[membership, _]) in particles {
            // Nobody's is 0; one that was taken out belongs to no flask that there is.
            let flask = (membership as usize).checked_sub(1);
            if let Some(sum) = flask.and_then(|flask| sums.get_mut(flask)) {
                sum.0 += 1;
                sum.1 += f64::from(temperature);
                sum.2 += f64::from(acid);
            }
        }
        let mean = |(particles, temperature, acid): (u32, f64, f64)| {
            let count = f64::from(particles.max(1));
            FlaskReading {
                particles,
                temperature: (temperature / count) as f32,
                acid: (acid / count) as f32,
            }
        };
        Ok(sums.into_iter().map(mean).collect())
    }
}
