//! The simulation loop, Algorithm 1, as passes. A pass's method, its pipeline and its shader in `sim/` bear one
//! name; in the shader each line of the algorithm is a function that names it.

use super::buffers::LOAD_GROUP;
use super::vessels::flask_pose;
use super::{Solver, SolverError};
use crate::chemistry::Chemistry;
use crate::chemistry::paper::Boiling;
use crate::pose::Pose;
use std::sync::atomic::Ordering;
use vitriol_gpu::{ComputePipeline, Pass, Readback, Recorder};
use vitriol_shaders::layout::{FlaskPose, LiquidLoad, Step};

/// What a frame leaves to be read once the device is done with it.
pub struct FrameRecord {
    loads: Option<Readback>,
    flasks: usize,
}

impl FrameRecord {
    /// The liquid's load on each flask, summed up over the device's workgroups
    /// in their order, so that the bits repeat. Empty where none was asked for.
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
        let substeps = self.parameters.substeps;
        if self.count == 0 {
            return Ok(self.nothing());
        }
        self.listed.store(true, Ordering::Relaxed);
        self.move_flasks(rec, before, after)?; // lines 1 to 5, and 13
        self.predict(rec)?; // lines 6 to 8, and 16 of the first substep
        for n in 0..substeps {
            let step = self.step(n);
            self.find_neighbours(rec, &step)?; // lines 9 to 12
            self.solve_density(rec, &step)?; // lines 18 to 21, and 22 to 25
            self.diffusion(rec, &step)?; // 26 of the paper's chemistry,
            self.exchange(rec, &step)?; // or of the physical one
            self.vorticity(rec)?; // 28, what of it takes a pass of its own
            self.forces(rec, &step, n + 1 == substeps)?; // end of 26, 27 and 28; 16 of the next
        }
        self.vent(rec)?;
        self.load(rec)
    }

    /// Records a pass that writes each particle's density over the rest
    /// density, and its copy to the host (one f32 a particle).
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device refuses.
    pub fn record_density(&self, rec: &mut Recorder) -> Result<Readback, SolverError> {
        let b = &self.buffers;
        self.boundary(rec.pass(&self.pipelines.density))
            .read("position", &b.position)
            .read("tags", &b.tags)
            .read("list_counts", &b.list_counts)
            .read("list", &b.list)
            .read("bulk", &b.bulk)
            .write("density", &b.density)
            .constants(&self.step(self.parameters.substeps - 1))
            .invocations(self.count * self.lanes)?;
        Ok(rec.read_back(&b.density)?)
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

    /// Line 16 at a frame's start; within a frame [`Self::forces`] ends with it.
    fn predict(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        let b = &self.buffers;
        self.prediction(rec.pass(&self.pipelines.predict))
            .read("position", &b.position)
            .read("velocity", &b.velocity)
            .read("tags", &b.tags)
            .read("bulk", &b.bulk)
            .constants(&self.step(0))
            .invocations(self.count)?;
        Ok(())
    }

    /// Lines 18 to 21; the last displacement goes on to lines 22 to 25.
    fn solve_density(&self, rec: &mut Recorder, step: &Step) -> Result<(), SolverError> {
        let p = &self.pipelines;
        if self.parameters.carry > 0.0 {
            self.multiplier(rec, &p.carried_multiplier, step)?;
            self.displacement(rec, &p.displacement, step)?;
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
            self.multiplier(rec, multiplier, &step)?;
            let displacement = if iteration == last {
                &p.last_displacement
            } else {
                &p.displacement
            };
            self.displacement(rec, displacement, &step)?;
        }
        Ok(())
    }

    /// Line 19.
    fn multiplier(
        &self,
        rec: &mut Recorder,
        pass: &ComputePipeline,
        step: &Step,
    ) -> Result<(), SolverError> {
        let b = &self.buffers;
        self.boundary(rec.pass(pass))
            .read("trial", &b.trial)
            .read("tags", &b.tags)
            .read("list_counts", &b.list_counts)
            .read("list", &b.list)
            .read("velocity", &b.velocity)
            .write("multiplier", &b.multiplier)
            .write("solved", &b.solved)
            .write("boundary", &b.boundary)
            .write("list_args", &b.list_args)
            .constants(step)
            .invocations(self.count * self.lanes)?;
        Ok(())
    }

    /// Line 20, and lines 22 to 25 in a substep's last iteration.
    fn displacement(
        &self,
        rec: &mut Recorder,
        pass: &ComputePipeline,
        step: &Step,
    ) -> Result<(), SolverError> {
        let b = &self.buffers;
        self.vessels(rec.pass(pass))
            .read("solved", &b.solved)
            .read("boundary", &b.boundary)
            .read("list_counts", &b.list_counts)
            .read("list", &b.list)
            .write("trial", &b.trial)
            .write("wall_push", &b.wall_push)
            .read("multiplier", &b.multiplier)
            .read("velocity", &b.velocity)
            .write("position", &b.position)
            .read("distances", &self.vessels.distances)
            .write("tags", &b.tags)
            .write("new_velocity", &b.new_velocity)
            .read("list_origin", &b.list_origin)
            .write("counters", &b.counters)
            .write("heat", &b.heat)
            .read("bulk", &b.bulk)
            .constants(step)
            .invocations(self.count * self.lanes)?;
        Ok(())
    }

    /// Line 26 of the paper's chemistry, but for the heat of solution, which
    /// [`Self::forces`] adds.
    fn diffusion(&self, rec: &mut Recorder, step: &Step) -> Result<(), SolverError> {
        let Some(pass) = &self.pipelines.diffusion else {
            return Ok(());
        };
        self.mixing(rec.pass(pass))
            .write("diffused", &self.buffers.diffused)
            .constants(step)
            .invocations(self.count * self.lanes)?;
        Ok(())
    }

    /// Line 26 of the physical chemistry, but for what boiling costs, which
    /// [`Self::forces`] takes.
    fn exchange(&self, rec: &mut Recorder, step: &Step) -> Result<(), SolverError> {
        let Some(pass) = &self.pipelines.exchange else {
            return Ok(());
        };
        let b = &self.buffers;
        self.mixing(rec.pass(pass))
            .read("new_velocity", &b.new_velocity)
            .read("tags", &b.tags)
            .read("agitation", &b.agitation)
            .read("bulk", &b.bulk)
            .read("solution", &b.solution)
            .write("matter", &b.matter)
            .write("ledger", &b.ledger)
            .constants(step)
            .invocations(self.count * self.lanes)?;
        Ok(())
    }

    fn mixing<'r>(&self, pass: Pass<'r>) -> Pass<'r> {
        let b = &self.buffers;
        pass.read("position", &b.position)
            .read("list_counts", &b.list_counts)
            .read("list", &b.list)
            .read("boundary", &b.boundary)
            .read("heat", &b.heat)
            .write("mixing", &b.mixing)
            .write("counters", &b.counters)
    }

    /// Line 28's vorticity, which its confinement needs of the neighbours.
    fn vorticity(&self, rec: &mut Recorder) -> Result<(), SolverError> {
        let Some(pass) = &self.pipelines.vorticity else {
            return Ok(());
        };
        let b = &self.buffers;
        rec.pass(pass)
            .read("position", &b.position)
            .read("new_velocity", &b.new_velocity)
            .read("list_counts", &b.list_counts)
            .read("list", &b.list)
            .write("vorticity", &b.vorticity)
            .invocations(self.count * self.lanes)?;
        Ok(())
    }

    /// Lines 26 (its end), 27 and 28, and line 16 of the next substep: one pass over the neighbours.
    fn forces(&self, rec: &mut Recorder, step: &Step, last: bool) -> Result<(), SolverError> {
        let (b, p) = (&self.buffers, &self.pipelines);
        let pass = if last { &p.last_forces } else { &p.forces };
        self.walls(self.prediction(rec.pass(pass)))
            .read("position", &b.position)
            .read("new_velocity", &b.new_velocity)
            .read("vorticity", &b.vorticity)
            .read("tags", &b.tags)
            .read("list_counts", &b.list_counts)
            .read("list", &b.list)
            .read("diffused", &b.diffused)
            .read("mixing", &b.mixing)
            .read("solution", &b.solution)
            .write("heat", &b.heat)
            .write("matter", &b.matter)
            .write("ledger", &b.ledger)
            .write("agitation", &b.agitation)
            .write("bulk", &b.bulk)
            .write("velocity", &b.velocity)
            .write("counters", &b.counters)
            .constants(step)
            .invocations(self.count * self.lanes)?;
        Ok(())
    }

    fn load(&self, rec: &mut Recorder) -> Result<FrameRecord, SolverError> {
        if !self.loads || self.flasks == 0 {
            return Ok(self.nothing());
        }
        let b = &self.buffers;
        self.vessels(rec.pass(&self.pipelines.load))
            .read("position", &b.position)
            .read("tags", &b.tags)
            .read("wall_push", &b.wall_push)
            .read("matter", &b.matter)
            .read("velocity", &b.velocity)
            .write("loads", &b.loads)
            .constants(&self.step(self.parameters.substeps - 1))
            .workgroups([self.count.div_ceil(LOAD_GROUP), 1, 1])?;
        Ok(FrameRecord {
            loads: Some(rec.read_back(&b.loads)?),
            flasks: self.flasks,
        })
    }

    fn nothing(&self) -> FrameRecord {
        FrameRecord {
            loads: None,
            flasks: self.flasks,
        }
    }

    /// Constants of substep `n`.
    fn step(&self, n: u32) -> Step {
        let flasks = self.flasks as u32;
        Step {
            time: self.parameters.substep_time() as f32,
            viscosity: self.viscosity_unit() as f32,
            carry: self.parameters.carry as f32,
            before: n * flasks,
            after: (n + 1) * flasks,
            next: (n + 2) * flasks,
            ..Step::default()
        }
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

    pub(super) fn vessels<'r>(&self, pass: Pass<'r>) -> Pass<'r> {
        let v = &self.vessels;
        pass.read("flasks", &v.flasks)
            .read("poses", &self.buffers.poses)
            .read("radii", &v.radii)
            .read("maps", &v.maps)
    }

    fn boundary<'r>(&self, pass: Pass<'r>) -> Pass<'r> {
        self.walls(self.vessels(pass))
    }

    fn walls<'r>(&self, pass: Pass<'r>) -> Pass<'r> {
        let v = &self.vessels;
        pass.read("plane", &v.plane)
            .read("pulls", &v.pulls)
            .read("solid_cells", &v.solids.cells)
            .read("solid_starts", &v.solids.starts)
            .read("solids", &v.solids.solids)
    }

    fn prediction<'r>(&self, pass: Pass<'r>) -> Pass<'r> {
        let b = &self.buffers;
        self.vessels(pass)
            .read("distances", &self.vessels.distances)
            .write("list_args", &b.list_args)
            .read("list_origin", &b.list_origin)
            .write("wall_push", &b.wall_push)
            .write("trial", &b.trial)
    }
}
