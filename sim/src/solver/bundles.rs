//! A frame's commands, recorded once and executed in each frame that has the same.

use super::{Solver, SolverError};
use std::sync::{Mutex, PoisonError};
use vitriol_gpu::{Bundle, Recorder};

/// Most bundles at a time: walls that move fast need more substeps ([`crate::scene::SolverSettings::wall_step`]), and a
/// governor for fewer. The one that was not used for longest makes room.
const KEPT: usize = 12;

/// Of the parameters, those that change while a solver lives: substeps, iterations, and k_v of Eq. 17.
type Effort = (u32, u32, Option<f64>);

/// Bundles of frames, the latest used last.
#[derive(Default)]
pub(super) struct Bundles(Mutex<Vec<(Effort, Bundle)>>);

impl Bundles {
    /// Drops all bundles, since they hold a buffer that another has replaced.
    pub(super) fn clear(&mut self) {
        self.lock().clear();
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<(Effort, Bundle)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn take(&self, effort: Effort, rec: &Recorder) -> Option<Bundle> {
        let mut kept = self.lock();
        let place = kept
            .iter()
            .position(|(of, bundle)| *of == effort && rec.takes(bundle))?;
        Some(kept.remove(place).1)
    }

    fn keep(&self, effort: Effort, bundle: Bundle) {
        let mut kept = self.lock();
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((effort, bundle));
    }
}

impl Solver {
    /// Lines 6 to 28, from a bundle. Recorded directly where each pass is to be timed or marked, which a bundle's are not.
    pub(super) fn solve(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        if self.gpu.options().tells_passes() {
            return self.record_passes(rec);
        }
        let parameters = &self.parameters;
        let effort = (parameters.substeps, parameters.iterations, self.intensity());
        let bundle = match self.bundles.take(effort, rec) {
            Some(bundle) => bundle,
            None => rec.bundle("sim/frame", |rec| self.record_passes(rec))?,
        };
        rec.execute(&bundle)?;
        self.bundles.keep(effort, bundle);
        Ok(())
    }
}
