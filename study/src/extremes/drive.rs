//! Runs a case and collects the figures by which it is judged.

use glam::{DVec3, Vec3};
use vitriol_gpu::Gpu;
use vitriol_run::{Blame, Failure};
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::measure::Ledger;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::{Counters, SolverState};
use vitriol_sim::world::{StepInput, World};

use super::case::Case;
use super::motion::{BEFORE, LASTS, Motion};
use super::recipe::{Base, Crowd};
use super::surface::Surface;

/// Time in which moving liquid has to come to rest, s.
pub(super) const REST: f64 = 1.0;
/// Most steps of a case: one of a tenth of the time step ends earlier.
const MOST_STEPS: u64 = 400;
/// Energy that may appear, over the turnover: lattices settle, lists are cut.
pub(super) const ENERGY: f64 = 0.05;
/// Time at the end over which a speed is a mean, s.
const LAST: f64 = 0.25;
/// Steps between two observations of all particles.
const BETWEEN: u64 = 3;
/// P₀ of Eq. 17's stated power, W/kg, and factor by which the injected power may exceed it (docs/chemistry.md: 11 % at one substep).
const POWER: (f64, f64) = (200.0, 1.15);

/// Figures of a run.
#[derive(Default)]
pub(super) struct Run {
    /// Particles.
    pub particles: usize,
    /// Steps done.
    pub steps: u64,
    /// Whether a whole [`REST`] passed after the extreme.
    pub rested: bool,
    /// NaN and infinite numbers of particles that are there, at any observation.
    pub not_finite: u64,
    /// Most particles on the wrong side of a wall at any observation.
    pub lost: u64,
    /// Largest speed at any observation, m/s.
    pub speed: f64,
    /// Largest energy beyond the initial and the declared one, J, and the turnover that it is compared with.
    pub excess: f64,
    pub turnover: f64,
    /// Energy that the filling set free in the first [`BEFORE`], J.
    pub settling: f64,
    /// Root mean square of the members' speeds over the last [`LAST`], m/s.
    pub end_speed: f64,
    /// Particles in the flask at the end.
    pub members: usize,
    /// Particles above their boiling point in the second half of the rest; at least one where vapour pushed the liquid then.
    pub boiling: u64,
    /// Relative changes of Σ c or Σ m c, of the mass including what left, and of the enthalpy.
    pub drifts: [f64; 3],
    /// Lowest and highest temperature and acid fraction at any observation.
    pub temperatures: [f64; 2],
    pub acids: [f64; 2],
    /// Limiters that acted.
    pub counters: Counters,
    /// Hash of the final state.
    pub hash: u64,
}

/// Runs `case` in `scene`, which was made from its text.
pub(super) fn drive(
    gpu: &Gpu,
    library: &Library,
    scene: &Scene,
    case: &Case,
) -> Result<Run, Failure> {
    let mut world = World::new(gpu, library, scene, case.seed).other()?;
    crowd(&mut world, case)?;
    let moves = case.recipe.motion != Motion::Still;
    let dt = scene.scale.frame_time;
    let active = if moves { BEFORE + LASTS } else { LASTS };
    let active_steps = (active / dt).ceil() as u64;
    let all = active_steps + (REST / dt).ceil() as u64;
    let steps = all.min(MOST_STEPS);
    let mut watch = Watch::new(&world, case)?;
    for step in 1..=steps {
        let before = world.poses().to_vec();
        let hand = hand(case, scene, step as f64 * dt);
        let input = StepInput::of_hands([hand, Hand::ABSENT]);
        world.step(&input).other()?;
        watch.work(&world, &before)?;
        watch.late = 2 * step > active_steps + all;
        watch.last_part = dt * (steps - step) as f64 <= LAST;
        if step % BETWEEN == 0 || step == steps || step == active_steps {
            watch.look(&world, step)?;
        }
    }
    watch.finish(&world, steps, steps == all)
}

fn hand(case: &Case, scene: &Scene, time: f64) -> Hand {
    let flask = &scene.flasks[0];
    let middle = Vec3::Y * (0.5 * flask.profile.rim_height()) as f32;
    let grip = flask.stage_from_flask.transform_point(middle).as_dvec3();
    case.recipe
        .motion
        .hand(time, grip, scene.scale.length_scale)
}

/// Moves particles to places where no filling puts them.
fn crowd(world: &mut World, case: &Case) -> Result<(), Failure> {
    let recipe = &case.recipe;
    if recipe.crowd == Crowd::Filled {
        return Ok(());
    }
    let mut state = world.snapshot().other()?;
    let count = state.solver.positions.len();
    let Some(flask) = world.scene().flasks.first() else {
        return Ok(());
    };
    let (share, radius) = match recipe.crowd {
        Crowd::Filled => (0.0, 0.0),
        Crowd::OnePlace(share) => (share, 0.0),
        Crowd::Ball(radius) => (1.0, radius * recipe.support()),
    };
    // Within the glass: a particle that starts beyond it is no fault of the solver.
    let room = (recipe.radius - 1.0) * recipe.spacing;
    let radius = radius.min(room);
    let middle = (0.5 * recipe.depth()).max(radius + recipe.spacing);
    let centre = Vec3::Y * (flask.profile.floor_height() + middle) as f32;
    let centre = flask.stage_from_flask.transform_point(centre);
    let chosen = ((share * count as f64).ceil() as usize).max(2).min(count);
    for (index, position) in state.solver.positions.iter_mut().take(chosen).enumerate() {
        // Even over the ball, by the golden angle and the cube root.
        let part = (index as f64 + 0.5) / chosen as f64;
        let (turn, up) = (2.399_963 * index as f64, (7.0 * part).fract() * 2.0 - 1.0);
        let aside = (1.0 - up * up).sqrt();
        let out = DVec3::new(aside * turn.cos(), up, aside * turn.sin());
        let place = centre + (out * radius * part.cbrt()).as_vec3();
        (position[0], position[1], position[2]) = (place.x, place.y, place.z);
    }
    world.restore(&state).other()
}

/// A particle's energy of motion and height, and whether it is the flask's; indexed by identity.
#[derive(Clone, Copy, Default)]
struct Held {
    member: bool,
    energy: f64,
}

#[derive(Default)]
struct Watch {
    moves: bool,
    late: bool,
    last_part: bool,
    /// Σ v² and number of the members over observations in the last part.
    squares: [f64; 2],
    gravity: f64,
    particle_mass: f64,
    /// Height at which potential energy is 0, m.
    base: f64,
    frame_time: f64,
    surface: Option<Surface>,
    boiling: Option<(f64, f64)>,
    literal_limit: f64,
    last: Vec<Held>,
    last_step: u64,
    start_energy: f64,
    /// Energy of the surface, J, when it was last computed: that takes longer than the simulation.
    surface_energy: f64,
    start: Amounts,
    /// Work by glass, and all other energy that may become motion, J.
    declared: f64,
    /// Vapour that exists or has existed, kg.
    steam: f64,
    run: Run,
}

/// Work of steam that expands into the room at 100 °C, J/kg.
const STEAM_WORK: f64 = 461.5 * 373.15;

/// Conserved amounts.
#[derive(Clone, Copy, Default)]
struct Amounts {
    acid: f64,
    mass: f64,
    ledger: Option<Ledger>,
}

impl Watch {
    fn new(world: &World, case: &Case) -> Result<Self, Failure> {
        let parameters = world.solver().parameters();
        let recipe = &case.recipe;
        let mut watch = Self {
            moves: recipe.motion != Motion::Still || recipe.upside_down,
            gravity: recipe.gravity,
            particle_mass: parameters.particle_mass(),
            base: world.scene().floor.height,
            frame_time: recipe.frame_time,
            surface: Surface::of(world.scene(), parameters),
            boiling: (recipe.base == Base::Paper).then_some((recipe.boiling_point, recipe.k_v)),
            literal_limit: 0.5 * recipe.v_max * recipe.v_max,
            run: Run {
                particles: world.solver().count() as usize,
                temperatures: [f64::INFINITY, f64::NEG_INFINITY],
                acids: [f64::INFINITY, f64::NEG_INFINITY],
                ..Run::default()
            },
            ..Self::default()
        };
        let state = world.solver().snapshot().other()?;
        watch.last = watch.energies(&state);
        let start = watch.last.clone();
        watch.start_energy = watch.all_of(&start, &state, world, true);
        watch.start = watch.amounts(world, &state);
        // Least turnover: a lattice that settles by a spacing.
        watch.run.turnover = watch.least();
        Ok(watch)
    }

    /// m g d over all particles, J, or the kinetic energy of 1 cm/s where there is no weight.
    fn least(&self) -> f64 {
        let d = (self.particle_mass / 1e3).cbrt();
        self.particle_mass * self.run.particles as f64 * (self.gravity * d).max(5e-5)
    }

    fn energies(&self, state: &SolverState) -> Vec<Held> {
        let mut held = vec![Held::default(); state.tags.len()];
        for slot in (0..state.tags.len()).filter(|&slot| state.is_present(slot)) {
            let [_, y, _, _] = state.positions[slot];
            let [u, v, w, _] = state.velocities[slot];
            let squared = f64::from(u).powi(2) + f64::from(v).powi(2) + f64::from(w).powi(2);
            let mass = self.particle_mass * state.mass_of(slot);
            held[state.tags[slot][1] as usize] = Held {
                member: state.flask_of(slot).is_some(),
                energy: mass * (0.5 * squared + self.gravity * (f64::from(y) - self.base)),
            };
        }
        held
    }

    /// Energy of motion, height and surface, J; the surface's as it was computed last, unless that is too much or `anew`.
    fn all_of(&mut self, held: &[Held], state: &SolverState, world: &World, anew: bool) -> f64 {
        let bare: f64 = held.iter().map(|held| held.energy).sum();
        let excess = bare + self.surface_energy - self.start_energy - self.declared;
        if let Some(surface) = &self.surface
            && (anew || excess > 0.5 * ENERGY * self.run.turnover)
        {
            self.surface_energy = surface.energy(state, world.poses());
        }
        bare + self.surface_energy
    }

    fn amounts(&self, world: &World, state: &SolverState) -> Amounts {
        let heat = vitriol_sim::measure::measure_heat(world.solver().parameters(), state);
        let ledger = heat.as_ref().and_then(|heat| heat.ledger);
        if let Some(Ledger {
            acid, mass, steam, ..
        }) = ledger
        {
            let mass = mass + steam;
            return Amounts { acid, mass, ledger };
        }
        let present = (0..state.tags.len()).filter(|&slot| state.is_present(slot));
        let heats = present.clone().filter_map(|slot| state.heat.get(slot));
        Amounts {
            acid: heats
                .map(|heat| self.particle_mass * f64::from(heat[1]))
                .sum(),
            mass: self.particle_mass * present.count() as f64,
            ledger,
        }
    }

    /// Work of the glass on its contents in the last step.
    fn work(&mut self, world: &World, before: &[vitriol_sim::pose::Pose]) -> Result<(), Failure> {
        let loads = world.loads().other()?;
        for ((load, from), to) in loads.iter().zip(before).zip(world.poses()) {
            let moved = (to.position - from.position).as_dvec3();
            let turn = (to.orientation * from.orientation.conjugate()).normalize();
            let turn = if turn.w < 0.0 { -turn } else { turn };
            let turned = turn.to_scaled_axis().as_dvec3();
            // Force and path turn with the glass, so both are longer than the sums of their vectors.
            let half = 0.5 * turned.length();
            let bent = if half > 1e-3 {
                (half / half.sin()).powi(2)
            } else {
                1.0
            };
            let work = bent * load.impulse.as_dvec3().dot(moved)
                + load.angular_impulse.as_dvec3().dot(turned);
            // The load is that of the liquid on the glass.
            self.declared -= work / self.frame_time;
            self.run.turnover += (work / self.frame_time).abs();
        }
        Ok(())
    }

    fn look(&mut self, world: &World, step: u64) -> Result<(), Failure> {
        let state = world.solver().snapshot().other()?;
        let time = self.frame_time * (step - self.last_step) as f64;
        self.last_step = step;
        self.numbers(&state);
        let measured = world.measure_state(&state).other()?;
        self.run.lost = self.run.lost.max(measured.lost_particles);
        let now = self.energies(&state);
        if self.moves {
            // The load is that of members: for particles that left, or that are struck from outside, all gained energy counts as declared.
            for (now, before) in now.iter().zip(&self.last) {
                if !(now.member && before.member) {
                    self.declared += (now.energy - before.energy).max(0.0);
                }
            }
        }
        self.declared += self.boiled(&state, time);
        if let Some(ledger) = self.amounts(world, &state).ledger {
            // The work of expansion, R T/M.
            let steam = ledger.steam + ledger.vapour;
            // Liquid that boils within milliseconds is above its boiling point at no observation.
            if self.late && steam > self.steam {
                self.run.boiling = self.run.boiling.max(1);
            }
            self.declared += STEAM_WORK * (steam - self.steam).max(0.0);
            self.steam = steam;
        }
        let settles = self.frame_time * step as f64 <= BEFORE;
        let energy = self.all_of(&now, &state, world, settles);
        let kinetic = measured.kinetic_energy;
        self.run.turnover = self.run.turnover.max(self.least() + kinetic);
        let excess = energy - self.start_energy - self.declared;
        self.run.excess = larger(self.run.excess, excess);
        if settles {
            // A filling is no equilibrium: the lattice is too dense at the wall, and particles in one place are pushed apart. The energy
            // that this sets free counts as initial.
            self.run.settling += excess.max(0.0);
            self.start_energy += excess.max(0.0);
            self.run.excess = 0.0;
        }
        if self.late
            && let Some(superheat) = measured.heat.as_ref().and_then(|h| h.superheat.as_ref())
        {
            self.run.boiling = self.run.boiling.max(superheat.particles);
        }
        self.keep(world, &state);
        self.last = now;
        Ok(())
    }

    /// Energy injected over `time` by Eq. 17 as stated, J.
    fn boiled(&self, state: &SolverState, time: f64) -> f64 {
        let Some((point, intensity)) = self.boiling else {
            return 0.0;
        };
        let powers = state.heat.iter().map(|heat| {
            let excess = intensity * (f64::from(heat[0]) - point).max(0.0) / point;
            // No more than accelerates all particles to v_max.
            (POWER.1 * POWER.0 * excess * excess * time).min(self.literal_limit)
        });
        self.particle_mass * powers.sum::<f64>()
    }

    /// Updates the figures for finite numbers, speed and temperature.
    fn numbers(&mut self, state: &SolverState) {
        let run = &mut self.run;
        for slot in (0..state.tags.len()).filter(|&slot| state.is_present(slot)) {
            let mut values = [state.positions[slot], state.velocities[slot]].concat();
            if let Some(heat) = state.heat.get(slot) {
                values.extend([heat[0], heat[1]]);
                let (t, c) = (f64::from(heat[0]), f64::from(heat[1]));
                run.temperatures = [run.temperatures[0].min(t), run.temperatures[1].max(t)];
                run.acids = [run.acids[0].min(c), run.acids[1].max(c)];
            }
            if let Some(matter) = state.matter.get(slot) {
                values.extend_from_slice(matter);
            }
            run.not_finite += values.iter().filter(|value| !value.is_finite()).count() as u64;
            let [u, v, w, _] = state.velocities[slot];
            let speed = f64::from(Vec3::new(u, v, w).length());
            run.speed = larger(run.speed, speed);
            if self.last_part && state.flask_of(slot).is_some() {
                self.squares[0] += speed * speed;
                self.squares[1] += 1.0;
            }
        }
    }

    fn keep(&mut self, world: &World, state: &SolverState) {
        let now = self.amounts(world, state);
        let change = |now: f64, start: f64| {
            if start > 0.0 {
                ((now - start) / start).abs()
            } else {
                0.0
            }
        };
        let enthalpy = match (&now.ledger, &self.start.ledger) {
            (Some(now), Some(start)) => now.closure(start).abs(),
            _ => 0.0,
        };
        let drifts = [
            change(now.acid, self.start.acid),
            change(now.mass, self.start.mass),
            enthalpy,
        ];
        for (largest, now) in self.run.drifts.iter_mut().zip(drifts) {
            *largest = larger(*largest, now);
        }
    }

    fn finish(mut self, world: &World, steps: u64, rested: bool) -> Result<Run, Failure> {
        let state = world.solver().snapshot().other()?;
        let members = (0..state.tags.len()).filter(|&slot| state.flask_of(slot).is_some());
        self.run.members = members.count();
        let [sum, count] = self.squares;
        self.run.end_speed = (sum / count.max(1.0)).sqrt();
        (self.run.steps, self.run.rested) = (steps, rested);
        self.run.counters = world.counters().other()?;
        self.run.hash = state.hash();
        Ok(self.run)
    }
}

/// The larger one; NaN if one is NaN, which `f64::max` would ignore.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a >= b { a } else { b }
}
