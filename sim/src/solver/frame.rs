//! The simulation loop, Algorithm 1, as passes in its order. `docs/paper-map.md` has each line's shader and function.

use super::buffers::LOAD_GROUP;
use super::pipelines::SolverPass;
use super::sleep;
use super::vessels::flask_pose;
use super::{Solver, SolverError};
use crate::chemistry::Chemistry;
use crate::chemistry::paper::Boiling;
use crate::pose::Pose;
use std::sync::atomic::Ordering;
use vitriol_gpu::{Pass, Readback, Recorder};
use vitriol_shaders::layout::{FlaskPose, FlaskSleep, LiquidLoad, Step};

/// Results of a frame that can be read once the device has finished it.
pub struct FrameRecord {
    loads: Option<Readback>,
    flasks: usize,
    /// Counted by the solver.
    pub(super) frame: u64,
    sleep: Option<[Readback; 2]>,
}

impl FrameRecord {
    /// The liquid's load on each flask, summed up over the device's workgroups
    /// in their order, so that the bits repeat. Empty in a solver without loads.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] before the frame is done.
    pub fn loads(&self) -> Result<Vec<LiquidLoad>, SolverError> {
        let Some(readback) = &self.loads else {
            return Ok(Vec::new());
        };
        let mut sums = vec![LiquidLoad::default(); self.flasks];
        for group in readback.get::<LiquidLoad>()?.chunks_exact(self.flasks) {
            for (sum, part) in sums.iter_mut().zip(group) {
                for axis in 0..4 {
                    sum.impulse[axis] += part.impulse[axis];
                    sum.angular[axis] += part.angular[axis];
                    sum.offsets[axis] += part.offsets[axis];
                }
            }
        }
        Ok(sums)
    }

    /// Where flasks stand, if all liquid slept in the frame and goes on to do so while nothing moves.
    pub(super) fn sleeping_at(&self) -> Result<Option<Vec<Pose>>, SolverError> {
        let Some([sleep, flasks]) = &self.sleep else {
            return Ok(None);
        };
        let words = sleep.get::<u32>()?;
        let words = words.get(..sleep::HEAD + self.flasks);
        if !words.is_some_and(sleep::is_settled) {
            return Ok(None);
        }
        let flasks = flasks.get::<FlaskSleep>()?;
        Ok(Some(
            flasks.iter().take(self.flasks).map(sleep::pose).collect(),
        ))
    }
}

impl Solver {
    /// Records one frame of Δt_f, in which the flasks go from the poses
    /// `before` to those `after` (stage_from_flask, in the scene's order).
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn record(
        &self,
        rec: &mut Recorder,
        before: &[Pose],
        after: &[Pose],
    ) -> Result<FrameRecord, SolverError> {
        if self.count == 0 {
            return Ok(FrameRecord {
                loads: None,
                flasks: self.flasks,
                frame: 0,
                sleep: None,
            });
        }
        self.listed.store(true, Ordering::Relaxed);
        let near = |a: &[Pose], b: &[Pose]| self.near(a, b);
        let (frame, is_still) = self.still.count([before, after], near);
        self.move_flasks(rec, before, after)?; // lines 1 to 5, and 13
        if is_still {
            self.record_still(rec)?;
        } else {
            self.solve(rec)?; // the others
        }
        let loads = self.has_loads().then(|| rec.read_back(&self.buffers.loads));
        let told = [&self.buffers.sleep, &self.buffers.flask_sleeps];
        let sleep = match self.pipelines.sleep {
            Some(_) => Some([rec.read_back(told[0])?, rec.read_back(told[1])?]),
            None => None,
        };
        Ok(FrameRecord {
            loads: loads.transpose()?,
            flasks: self.flasks,
            frame,
            sleep,
        })
    }

    /// Records lines 6 to 28 of all substeps, and the load. Nothing here may depend on the frame: a bundle of these passes
    /// is executed again.
    pub(super) fn record_passes(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        let (p, substeps) = (&self.pipelines, self.parameters.substeps);
        self.record_sleep(rec)?;
        // Lines 6 to 8, and 16 of the first substep; the forces of each end with that of the next.
        self.pass(rec, &p.predict)
            .constants(&self.step(0))
            .invocations(self.count)?;
        let impulses = self.impulses();
        for n in 0..substeps {
            let step = self.step(n);
            self.find_neighbours(rec, &step)?; // lines 9 to 12
            self.displace(rec, &step)?; // 18, of cavities
            self.solve_density(rec, &step)?; // lines 18 to 21, and 22 to 25
            if let Some(&(_, substeps)) = impulses.iter().find(|&&(first, _)| first == n) {
                self.hold_together(rec, &step, substeps)?; // 28, surface tension
            }
            // 26 of either chemistry, but for the heat of solution and what boiling costs.
            if let Some(turnover) = &p.turnover {
                self.pass(rec, turnover)
                    .constants(&step)
                    .indirect(&self.buffers.turnover_plan, 0)?;
            }
            if let Some(mixing) = &p.mixing {
                self.over_particles(rec, mixing, &step)?;
            }
            // 28, what its confinement needs of the neighbours.
            if let Some(vorticity) = &p.vorticity {
                self.over_awake(self.pass(rec, vorticity))?;
            }
            // End of 26, 27 and 28, and 16 of the next: one pass over the neighbours.
            let last = n + 1 == substeps;
            let forces = if last { &p.last_forces } else { &p.forces };
            self.over_particles(rec, forces, &step)?;
            self.bubble(rec, &step, n)?; // end of 26, of bubbles
        }
        for pass in &p.eddies {
            self.over_awake(self.pass(rec, pass))?;
        }
        if let Some([_, calm]) = &p.sleep {
            self.pass(rec, calm)
                .constants(&self.step(substeps - 1))
                .invocations(self.count)?;
        }
        self.record_surroundings(rec)?;
        self.load(rec)
    }

    /// Records what glass and air do in a frame.
    pub(super) fn record_surroundings(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        let step = self.step(self.parameters.substeps - 1);
        if let Some(glass) = &self.pipelines.glass {
            self.pass(rec, glass)
                .constants(&step)
                .workgroups([self.flasks as u32, 1, 1])?;
        }
        if let Some(steam) = &self.steam {
            steam.record(rec, &self.buffers.all(&self.vessels), &step)?;
        }
        Ok(())
    }

    /// Records a pass that writes each particle's density over the rest
    /// density, and its copy to the host (one f32 a particle).
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn record_density(&self, rec: &mut Recorder) -> Result<Readback, SolverError> {
        let step = self.step(self.parameters.substeps - 1);
        self.pass(rec, &self.pipelines.density)
            .constants(&step)
            .invocations(self.count * self.lanes)?;
        Ok(rec.read_back(&self.buffers.density)?)
    }

    /// Poses at the frame's start and at each substep's end. Interpolated:
    /// moved a whole frame at once, the glass would leave the liquid behind.
    fn move_flasks(
        &self,
        rec: &mut Recorder,
        before: &[Pose],
        after: &[Pose],
    ) -> Result<(), SolverError> {
        if self.flasks == 0 {
            return Ok(());
        }
        let substeps = self.parameters.substeps;
        let poses: Vec<FlaskPose> = (0..=substeps)
            .flat_map(|n| {
                let fraction = n as f32 / substeps as f32;
                let pair = before.iter().zip(after);
                pair.map(move |(&from, &to)| flask_pose(from.interpolate(to, fraction)))
            })
            .collect();
        Ok(rec.upload(&self.buffers.poses, &poses)?)
    }

    /// Lines 18 to 21; the last displacement goes on to lines 22 to 25.
    fn solve_density(&self, rec: &mut Recorder, step: &Step) -> Result<(), SolverError> {
        let p = &self.pipelines;
        if self.parameters.carry_rate > 0.0 {
            self.over_particles(rec, &p.carried_displacement, step)?;
        }
        let gradient_sum = self.parameters.gradient_sum();
        let last = self.coefficients.len() - 1;
        for (iteration, &(momentum, residual)) in self.coefficients.iter().enumerate() {
            let step = Step {
                momentum: momentum as f32,
                residual: (residual / gradient_sum) as f32,
                ..*step
            };
            let multiplier = if iteration == 0 {
                &p.first_multiplier
            } else {
                &p.multiplier
            };
            self.over_particles(rec, multiplier, &step)?; // 19
            let displacement = if iteration == last {
                &p.last_displacement
            } else {
                &p.displacement
            };
            self.over_particles(rec, displacement, &step)?; // 20
        }
        Ok(())
    }

    /// A pass with the buffers bound that its shader declares.
    pub(super) fn pass<'r>(&self, rec: &'r mut Recorder, pass: &'r SolverPass) -> Pass<'r> {
        pass.begin(rec, &self.buffers.all(&self.vessels))
    }

    /// A pass in which all lanes of each particle that does not sleep take part.
    fn over_particles(
        &self,
        rec: &mut Recorder,
        pass: &SolverPass,
        step: &Step,
    ) -> Result<(), SolverError> {
        self.over_awake(self.pass(rec, pass).constants(step))
    }

    fn has_loads(&self) -> bool {
        self.loads && self.flasks > 0
    }

    pub(super) fn load(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        if !self.has_loads() {
            return Ok(());
        }
        self.pass(rec, &self.pipelines.load)
            .constants(&self.step(self.parameters.substeps - 1))
            .workgroups([self.count.div_ceil(LOAD_GROUP), 1, 1])?;
        Ok(())
    }

    /// Constants of substep `n`.
    pub(super) fn step(&self, n: u32) -> Step {
        let flasks = self.flasks as u32;
        let step = Step {
            time: self.parameters.substep_time() as f32,
            viscosity: self.viscosity_unit() as f32,
            carry: self.parameters.carried_share() as f32,
            before: n * flasks,
            after: (n + 1) * flasks,
            next: (n + 2) * flasks,
            intensity: self.intensity().unwrap_or(0.0) as f32,
            ..Step::default()
        };
        self.with_bubbles(step, n)
    }

    /// XSPH coefficient of a substep, in whose units those of boiling particles
    /// are: 1 where there is none. Eq. 17 as printed takes μ₀ per substep,
    /// however long that is.
    fn viscosity_unit(&self) -> f64 {
        let literal = match &self.parameters.chemistry {
            Some(Chemistry::Paper(paper)) => paper
                .boiling
                .is_some_and(|boiling| boiling.law == Boiling::Literal),
            _ => false,
        };
        let viscosity = if literal {
            self.parameters.viscosity
        } else {
            self.parameters.substep_viscosity()
        };
        if viscosity > 0.0 { viscosity } else { 1.0 }
    }
}
