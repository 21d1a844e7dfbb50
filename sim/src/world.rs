//! The simulation's one entrance: a world that advances by a fixed step with
//! that step's inputs.

mod bodies;
mod lifeline;
mod loads;
mod look;
mod start;
mod tools;

pub use lifeline::{Kept, Lifeline, StateRecord};
pub use look::Look;
pub use start::{ground, particles};

use crate::bodies::{Bodies, BodiesError, Hand};
use crate::fill::FillError;
use crate::parameters::Parameters;
use crate::pose::Pose;
use crate::scene::{Boundary, Scene};
use crate::solver::{Counters, Solver, SolverError, SolverSpec, SolverState};
use lifeline::Act;
use loads::{LOAD_DELAY, PendingLoad};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::sync::Arc;
use thiserror::Error;
use vitriol_gpu::{Gpu, GpuError, QueueKind, Ticket};
use vitriol_shaders::Library;

/// Most substeps of a step over the scene's, however fast a flask is.
const MOST_TIMES: u32 = 3;

/// Input of a step: the user's hands and head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepInput {
    /// Left and right hand at the step's end, in the scene's frame
    /// ([`Scene::origin`]).
    pub hands: [Hand; 2],
    /// Pose of the middle between the user's eyes at the step's end, in the scene's frame; the user looks along −z. `None` where it is not
    /// tracked. Only goggles use it.
    pub head: Option<Pose>,
}

impl StepInput {
    /// Input with hands and no tracked head.
    pub const fn of_hands(hands: [Hand; 2]) -> Self {
        Self { hands, head: None }
    }
}

/// Why a world could not be made or could not go on.
#[derive(Debug, Error)]
pub enum WorldError {
    /// The particle solver.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The rigid bodies.
    #[error(transparent)]
    Bodies(#[from] BodiesError),
    /// A liquid does not fit its flask.
    #[error(transparent)]
    Fill(#[from] FillError),
    /// The liquid would not stand up under these substeps and iterations.
    #[error("{substeps} × {iterations}: {problem}")]
    Effort {
        /// Substeps of a step.
        substeps: u32,
        /// Iterations of a substep.
        iterations: u32,
        /// Why not, and what to take instead.
        problem: String,
    },
    /// The boiling cannot be set to that.
    #[error("{0}")]
    Intensity(&'static str),
}

/// The largest k_v that can be set: ten times the paper's. `vitriol extremes` goes to a hundred times.
pub const MOST_INTENSITY: f64 = 10.0;

/// Everything that the next step depends on.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct WorldState {
    /// Steps done.
    pub step: u64,
    /// The particles.
    pub solver: SolverState,
    bodies: Vec<u8>,
    loads: Vec<Vec<[[f32; 4]; 3]>>,
}

/// A scene in motion.
pub struct World {
    gpu: Gpu,
    scene: Scene,
    bodies: Bodies,
    solver: Solver,
    /// Loads of the last [`LOAD_DELAY`] steps, the oldest first.
    loads: VecDeque<Arc<PendingLoad>>,
    /// Kinetic energies by flask (J), which [`World::stirring`] gives.
    stirring: Vec<f32>,
    /// Substeps and iterations from [`World::set_effort`], until the next step takes them.
    effort: Option<[u32; 2]>,
    step: u64,
    /// Steps done at the last look.
    looked: u64,
    last: Option<Ticket>,
    /// Acts and state for [`World::revive`]; `None` until [`World::follow`].
    lifeline: Option<Lifeline>,
}

impl World {
    /// The scene at its start, under the preset that was applied to it, with
    /// the filling's jitter from `seed`.
    ///
    /// # Errors
    /// [`WorldError`].
    pub fn new(gpu: &Gpu, library: &Library, scene: &Scene, seed: u64) -> Result<Self, WorldError> {
        Self::build(gpu, library, scene, seed, true)
    }

    /// The scene at its start as from [`World::new`], without the flask constraints of section 5: walls are then no more
    /// than a term of the density sum, for comparison (Fig. 5).
    ///
    /// # Errors
    /// As for [`World::new`].
    pub fn without_flask_constraint(
        gpu: &Gpu,
        library: &Library,
        scene: &Scene,
        seed: u64,
    ) -> Result<Self, WorldError> {
        Self::build(gpu, library, scene, seed, false)
    }

    fn build(
        gpu: &Gpu,
        library: &Library,
        scene: &Scene,
        seed: u64,
        constraint: bool,
    ) -> Result<Self, WorldError> {
        let scene = &scene.with_nuclei(seed);
        let parameters = Parameters::from_scene(scene);
        let particles = particles(scene, seed)?;
        let profiles: Vec<_> = scene.flasks.iter().map(|f| f.profile.clone()).collect();
        let solids = match scene.solver.boundary {
            Boundary::Map => None,
            Boundary::Particles => Some(scene.boundary_particles()),
        };
        let spec = SolverSpec {
            parameters,
            flasks: &profiles,
            solids: solids.as_deref(),
            ground: ground(scene),
            particles: &particles,
            at_rest: true,
            loads: scene.flasks.iter().any(|flask| !flask.fixed),
            tools: !scene.tools.is_empty(),
            constraint,
            lanes: None,
        };
        Ok(Self {
            gpu: gpu.clone(),
            bodies: Bodies::new(&start::bodies(scene))?,
            solver: Solver::new(gpu, library, &spec)?,
            scene: scene.clone(),
            loads: VecDeque::new(),
            stirring: vec![0.0; scene.flasks.len()],
            effort: None,
            step: 0,
            looked: 0,
            last: None,
            lifeline: None,
        })
    }

    /// Advances by one step of the scene's Δt_f: the hands move the flasks,
    /// and these the liquid. Returns once the device has its work.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn step(&mut self, input: &StepInput) -> Result<(), WorldError> {
        self.step_on(QueueKind::Main, input)
    }

    /// Advances by one step as [`World::step`] does, with the submission on `queue`. All steps of a world go on one queue, since
    /// submissions to two queues have no order.
    ///
    /// # Errors
    /// As for [`World::step`].
    pub fn step_on(&mut self, queue: QueueKind, input: &StepInput) -> Result<(), WorldError> {
        if let Some([substeps, iterations]) = self.effort.take() {
            self.solver.set_effort(substeps, iterations)?;
            self.scene = self.scene.with_effort([substeps, iterations]);
        }
        let loads = self.due_loads()?;
        let mut before = self.bodies.poses().to_vec();
        self.bodies.set_head(input.head);
        self.bodies.step(&input.hands, &loads);
        let mut rec = self.gpu.recorder(queue)?;
        for leap in self.bodies.leaps() {
            self.solver.carry(&mut rec, leap)?;
            before[leap.flask] = leap.after_from_before.compose(before[leap.flask]);
        }
        for broken in self.bodies.breaks() {
            self.solver.release(&mut rec, broken.flask)?;
            before[broken.flask] = self.bodies.poses()[broken.flask];
        }
        self.handle(&mut rec)?;
        self.follow_walls(&before)?;
        let record = self.solver.record(&mut rec, &before, self.bodies.poses())?;
        let ticket = self.gpu.submit(rec)?;
        self.loads
            .push_back(Arc::new(PendingLoad::Device(record, ticket.clone())));
        self.last = Some(ticket);
        self.step += 1;
        self.note(Act::Step(queue, *input));
        Ok(())
    }

    /// Declares that the hands of the next step did not move to where they are: the user was recentred, or is tracked again. Held
    /// bodies go there with their contents in one rigid motion, which exerts no force on the liquid.
    pub fn hands_leap(&mut self) {
        self.note(Act::Leap);
        self.bodies.hands_leap();
    }

    /// Whether flasks that are struck too hard break, from the next step on ([`BREAKS_AT`](crate::bodies::BREAKS_AT)). They do not
    /// in a world at its start. The liquid of a broken flask belongs to no flask; its shards collide with glass, table and floor, but not
    /// with liquid.
    pub fn set_breakable(&mut self, on: bool) {
        self.note(Act::Breakable(on));
        self.bodies.set_breakable(on);
    }

    /// Sets as many substeps as the fastest wall needs ([`SolverSettings::wall_step`](crate::scene::SolverSettings)). A wall that
    /// goes further than the particles it meets are wide presses them into each other, and the list's reach
    /// keeps them there for several substeps.
    fn follow_walls(&mut self, before: &[Pose]) -> Result<(), WorldError> {
        let solver = &self.scene.solver;
        let Some(most) = solver.wall_step else {
            return Ok(());
        };
        let furthest = self
            .scene
            .flasks
            .iter()
            .zip(before)
            .zip(self.bodies.poses())
            .map(|((flask, from), to)| flask.profile.furthest(*from, *to))
            .fold(0.0, f64::max);
        let wanted = (furthest / (most * self.scene.scale.spacing)).ceil();
        let [least, iterations] = [solver.substeps, solver.iterations];
        let substeps = (wanted as u32).clamp(least, MOST_TIMES * least);
        if substeps != self.solver.parameters().substeps {
            self.solver.set_effort(substeps, iterations)?;
        }
        Ok(())
    }

    /// Solves from the next step on with as many substeps a step and iterations a substep. The
    /// liquid goes on as it is: the multiplier carried from substep to substep is −p/ρ, which
    /// the length of neither scales. [`World::scene`] has the numbers of the last step.
    ///
    /// # Errors
    /// [`WorldError::Effort`] where the scene's liquid would not stand up under these numbers;
    /// nothing has changed then.
    pub fn set_effort(&mut self, effort: [u32; 2]) -> Result<(), WorldError> {
        let [substeps, iterations] = effort;
        if let Some(problem) = self.scene.with_effort(effort).problem_of_solver() {
            return Err(WorldError::Effort {
                substeps,
                iterations,
                problem,
            });
        }
        self.note(Act::Effort(effort));
        self.effort = Some(effort);
        Ok(())
    }

    /// Boils from the next step on with this k_v (Eq. 17), dimensionless.
    ///
    /// # Errors
    /// [`WorldError::Intensity`] outside 0 to [`MOST_INTENSITY`], and in a scene without the paper's boiling.
    pub fn set_intensity(&mut self, intensity: f64) -> Result<(), WorldError> {
        if !(0.0..=MOST_INTENSITY).contains(&intensity) {
            return Err(WorldError::Intensity("give a k_v of 0 to 10"));
        }
        if self.intensity().is_none() {
            let problem = "this scene has no k_v: the paper's boiling is not modelled in it";
            return Err(WorldError::Intensity(problem));
        }
        self.note(Act::Intensity(intensity));
        self.take_intensity(Some(intensity));
        Ok(())
    }

    /// k_v of the next step; `None` where the paper's boiling is not modelled.
    pub fn intensity(&self) -> Option<f64> {
        self.solver.intensity()
    }

    /// Solves from the next step on as `other`, a world of the same scene, is solved.
    ///
    /// # Errors
    /// As for [`World::set_effort`].
    pub fn solve_like(&mut self, other: &Self) -> Result<(), WorldError> {
        self.set_effort(other.effort())?;
        self.take_intensity(other.intensity());
        Ok(())
    }

    /// Takes a k_v that a world of the same scene has: a scene's own may be larger than [`MOST_INTENSITY`].
    fn take_intensity(&mut self, intensity: Option<f64>) {
        if let Some(intensity) = intensity {
            self.solver.set_intensity(intensity);
        }
        if let Some(paper) = &mut self.scene.paper {
            paper.k_v = intensity.or(paper.k_v);
        }
    }

    /// Substeps a step and iterations a substep of the next step.
    pub fn effort(&self) -> [u32; 2] {
        let solver = &self.scene.solver;
        self.effort.unwrap_or([solver.substeps, solver.iterations])
    }

    /// Whether the loads that the next step needs are ready, so that it would
    /// not wait for the device.
    ///
    /// # Errors
    /// [`WorldError::Gpu`] where the device is lost.
    pub fn is_ready(&self) -> Result<bool, WorldError> {
        match self.loads.front() {
            Some(load) if self.loads.len() >= LOAD_DELAY => load.is_done(),
            _ => Ok(true),
        }
    }

    /// Steps done.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// The scene that it was made of.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The device that it runs on.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The submission of the last step, for a renderer that draws it on another queue.
    pub fn last_step(&self) -> Option<&Ticket> {
        self.last.as_ref()
    }

    /// The particles on the device.
    pub fn solver(&self) -> &Solver {
        &self.solver
    }

    /// Kinetic energy, relative to a flask, of the liquid that its wall pushes, J: how it
    /// boils and sloshes there. It is two steps old, so that reading it waits for nothing;
    /// 0 of a flask that is not there, and where no flask can be lifted.
    pub fn stirring(&self, flask: usize) -> f32 {
        self.stirring.get(flask).copied().unwrap_or(0.0)
    }

    /// Events counted so far; waits for the device.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn counters(&self) -> Result<Counters, WorldError> {
        self.wait()?;
        Ok(self.solver.counters()?)
    }

    /// The whole state on the host; waits for the device.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn snapshot(&self) -> Result<WorldState, WorldError> {
        self.wait()?;
        let mut rec = self.gpu.recorder(QueueKind::Main)?;
        let record = self.record_state(&mut rec)?;
        self.gpu.submit(rec)?.wait()?;
        record.get()
    }

    /// Takes up a state of the same scene and preset, on this device; the steps
    /// that follow have the bits that they would have had without the interruption
    /// on a device of the same kind.
    ///
    /// # Errors
    /// [`WorldError`] where the state is another scene's, or the device fails.
    pub fn restore(&mut self, state: &WorldState) -> Result<(), WorldError> {
        self.solver.restore(&state.solver)?;
        self.bodies.restore(&state.bodies)?;
        (self.step, self.looked) = (state.step, state.step);
        self.loads = state
            .loads
            .iter()
            .map(|sums| Arc::new(PendingLoad::Host(bytemuck::cast_slice(sums).to_vec())))
            .collect();
        self.begin_anew(state);
        Ok(())
    }

    /// Waits for the last step, which may be on another queue than the submission
    /// that reads its particles.
    fn wait(&self) -> Result<(), WorldError> {
        Ok(self.last.as_ref().map_or(Ok(()), Ticket::wait)?)
    }
}
