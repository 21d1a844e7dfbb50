//! A closed, insulated vessel that is shaken until its contents are even, by the particle solver on the device.
//!
//! Nothing here mixes by a formula: the particles' masses, acid and enthalpies are set at the start, the solver moves and exchanges them,
//! and the result is measured of them at the end. Everything scales with the vessel, so that a millilitre and a barrel take the same
//! number of substeps.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use glam::{Quat, Vec3};
use vitriol_gpu::Gpu;
use vitriol_run::{Blame, Failure};
use vitriol_sim::flask::Profile;
use vitriol_sim::flask::glassware;
use vitriol_sim::measure::{HeatMeasurement, measure_heat};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::{
    Boundary, Feature, Flask, Floor, Liquid, PhysicalChemistry, RelaxationKind, Scale, Scene,
    SolverSettings,
};
use vitriol_sim::solver::{Counters, SolverSpec};
use vitriol_sim::surface_tension::GLASS;
use vitriol_sim::world;

use crate::liquid;

/// Depth of the liquid and inner height of the vessel over its radius.
const DEPTH: f64 = 1.0;
const HEIGHT: f64 = 6.0;
/// Radius of the shaker's circle over the vessel's.
const REACH: f64 = 0.4;
/// Square of the shaker's speed of turning over g/R. The lowest wave in a
/// cylinder has 1.84 tanh(1.84 H/R): next to it the liquid climbs the wall and
/// falls back, and layers of unlike density mix.
const FROUDE: f64 = 2.2;
/// Depth in the highest wave over that at rest.
const WAVE: f64 = 2.0;
/// Δt_s over its limit 0.4 d/√(gH) (see [`Parameters`]).
const SUBSTEP: f64 = 0.7;
/// Width of the filter for eddies over the particles' spacing: that of real size, 6 and 2.5 mm.
const EDDIES: f64 = 2.4;
/// Substeps between two observations of the liquid.
const SUBSTEPS: u32 = 4;
/// Longest time to wait, turns of the shaker.
const MOST_TURNS: f64 = 60.0;
/// Even: standard deviation of the temperature, K, and of the acid fraction.
pub const EVEN: [f64; 2] = [0.3, 0.002];
/// Accepted relative error of the ratio of particle numbers against that of the volumes.
const RATIO_ERROR: f64 = 5e-4;
/// Earth's gravity, m/s².
const GRAVITY: f64 = 9.81;

/// A liquid that is filled in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feed {
    /// Volume, m³.
    pub volume: f64,
    /// Temperature, °C.
    pub temperature: f64,
    /// Acid mass fraction.
    pub acid: f64,
}

/// Resolution of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Least number of particles; up to twice as many are taken for the ratio of the volumes.
    pub particles: usize,
    /// Iterations a substep.
    pub iterations: u32,
}

/// Result of a mixing.
#[derive(Clone, Debug)]
pub struct Mixed {
    /// Particles.
    pub particles: u32,
    /// Particle spacing, m.
    pub spacing: f64,
    /// Relative error of the ratio of the liquids' particle numbers against that of their volumes.
    pub ratio_error: f64,
    /// Measurement before the first step.
    pub start: HeatMeasurement,
    /// Measurement at the end.
    pub end: HeatMeasurement,
    /// Simulated time, s.
    pub seconds: f64,
    /// Whether it was even at the end.
    pub even: bool,
    /// Largest superheat at any observation, K.
    pub peak_superheat: f64,
    /// Largest differences from the start at any observation: of mass and of acid over the initial amounts, of enthalpy as
    /// [`vitriol_sim::measure::Ledger::closure`].
    pub drifts: [f64; 3],
    /// Particles that left the vessel or were taken out.
    pub lost: u64,
    /// Limiters that acted.
    pub counters: Counters,
}

/// Mixes `feeds`, the lower one first; one of the two may be empty.
///
/// # Errors
/// [`Failure::Input`] where so few particles cannot have that ratio;
/// [`Failure::Other`] where device or shaders fail.
pub fn mix(
    gpu: &Gpu,
    feeds: [Feed; 2],
    resolution: Resolution,
    seed: u64,
) -> Result<Mixed, Failure> {
    let counts = portions(feeds.map(|feed| feed.volume), resolution.particles);
    let error = ratio_error(feeds.map(|feed| feed.volume), counts);
    if error > MOST_RATIO_ERROR {
        return Err(format!(
            "{:.3e} to {:.3e} mL: the nearest ratio of up to {} particles is {:.0} % off; take a \
             preset with more of them, or amounts that are nearer to each other",
            1e6 * feeds[0].volume,
            1e6 * feeds[1].volume,
            2 * resolution.particles,
            100.0 * error
        ))
        .input();
    }
    let total = counts[0] + counts[1];
    let volume = feeds[0].volume + feeds[1].volume;
    let vessel = Vessel::new(volume, total)?;
    let scene = vessel.scene(feeds, counts, resolution.iterations);
    let profiles = [vessel.profile.clone()];
    let particles = world::particles(&scene, seed).other()?;
    // Without rigid bodies: no hand holds the vessel.
    let spec = SolverSpec {
        flasks: &profiles,
        ground: world::ground(&scene),
        ..liquid::alone(Parameters::from_scene(&scene), &particles)
    };
    let solver = liquid::solver(gpu, &spec)?;
    let look = || -> Result<(HeatMeasurement, u64), Failure> {
        let state = solver.snapshot().other()?;
        let held = measure_heat(solver.parameters(), &state)
            .ok_or("the calorimeter's scene models no heat")
            .other()?;
        let inside = (0..state.tags.len()).filter(|&slot| state.flask_of(slot) == Some(0));
        Ok((held, (total - inside.count()) as u64))
    };
    let (start, lost) = look()?;
    let mut mixed = Mixed {
        particles: solver.count(),
        spacing: vessel.spacing,
        ratio_error: error,
        end: start.clone(),
        start,
        seconds: 0.0,
        even: false,
        peak_superheat: 0.0,
        drifts: [0.0; 3],
        lost,
        counters: Counters::default(),
    };
    let frames = (MOST_TURNS * vessel.turn() / scene.scale.frame_time).ceil() as u64;
    for frame in 0..=frames {
        if frame > 0 {
            let time = |frame: u64| frame as f64 * scene.scale.frame_time;
            let (before, after) = (vessel.pose(time(frame - 1)), vessel.pose(time(frame)));
            liquid::frame(gpu, &solver, &[before], &[after])?;
            mixed.seconds = time(frame);
            (mixed.end, mixed.lost) = look()?;
        }
        mixed.note();
        if mixed.even {
            break;
        }
    }
    mixed.counters = solver.counters().other()?;
    Ok(mixed)
}

impl Mixed {
    /// Updates the extremes with the measurement `end`.
    fn note(&mut self) {
        let end = &self.end;
        self.even = end.temperature_spread <= EVEN[0] && end.acid_spread <= EVEN[1];
        if let Some(superheat) = &end.superheat {
            self.peak_superheat = self.peak_superheat.max(superheat.max);
        }
        if let (Some(start), Some(now)) = (&self.start.ledger, &end.ledger) {
            let over = |difference: f64, whole: f64| {
                if whole > 0.0 {
                    difference / whole
                } else {
                    difference
                }
            };
            let now = [
                over(now.mass - start.mass, start.mass),
                over(now.acid - start.acid, start.acid),
                now.closure(start),
            ];
            for (largest, now) in self.drifts.iter_mut().zip(now) {
                *largest = largest.max(now.abs());
            }
        }
    }
}

/// Numbers of particles whose ratio is that of the volumes: the fewest from `least` to twice that whose error is small, else those with
/// the smallest error.
fn portions(volumes: [f64; 2], least: usize) -> [usize; 2] {
    if let Some(only) = volumes.iter().position(|&volume| volume == 0.0) {
        let mut counts = [least; 2];
        counts[only] = 0;
        return counts;
    }
    let share = volumes[0] / (volumes[0] + volumes[1]);
    let split = |total: usize| {
        let first = ((share * total as f64).round() as usize).clamp(1, total - 1);
        [first, total - first]
    };
    let mut best = split(least);
    for total in least..=2 * least {
        let counts = split(total);
        let error = ratio_error(volumes, counts);
        if error <= RATIO_ERROR {
            return counts;
        }
        if error < ratio_error(volumes, best) {
            best = counts;
        }
    }
    best
}

/// Greatest accepted error of the ratio of whole particles against that of the volumes: 2 % of the lesser one is at most some tenths of a
/// kelvin.
const MOST_RATIO_ERROR: f64 = 0.02;

fn ratio_error(volumes: [f64; 2], counts: [usize; 2]) -> f64 {
    if volumes.contains(&0.0) {
        return 0.0;
    }
    let [a, b] = counts.map(|count| count as f64);
    ((a * volumes[1]) / (b * volumes[0]) - 1.0).abs()
}

/// A cylinder.
struct Vessel {
    spacing: f64,
    radius: f64,
    height: f64,
    profile: Profile,
}

impl Vessel {
    /// A vessel for `volume` m³ of liquid in `particles` particles.
    fn new(volume: f64, particles: usize) -> Result<Self, Failure> {
        let radius = (volume / (DEPTH * PI)).cbrt();
        let height = HEIGHT * radius;
        let points = [[0.0, radius], [height, radius]];
        Ok(Self {
            spacing: (volume / particles as f64).cbrt(),
            radius,
            height,
            profile: Profile::new(&points, 0.1 * radius).other()?,
        })
    }

    /// Time of a turn, s.
    fn turn(&self) -> f64 {
        TAU / (FROUDE * GRAVITY / self.radius).sqrt()
    }

    /// Its pose at a time: upright on a circle, as on an orbital shaker. The circle widens over the first turn.
    fn pose(&self, time: f64) -> Pose {
        let turns = time / self.turn();
        let reach = REACH * self.radius * turns.min(1.0);
        let (aside, across) = (TAU * turns.fract()).sin_cos();
        let position = Vec3::new((reach * aside) as f32, 0.0, (reach * across) as f32);
        Pose::new(position, Quat::IDENTITY)
    }

    fn scene(&self, feeds: [Feed; 2], counts: [usize; 2], iterations: u32) -> Scene {
        let d = self.spacing;
        let depth = WAVE * DEPTH * self.radius;
        let substep = SUBSTEP * 0.4 * d / (GRAVITY * depth).sqrt();
        Scene {
            name: "calorimeter".into(),
            description: "Two liquids in a closed, insulated vessel on an orbital shaker.".into(),
            origin: glam::DVec3::ZERO,
            scale: Scale {
                spacing: d,
                support_ratio: 2.0,
                frame_time: f64::from(SUBSTEPS) * substep,
                gravity: GRAVITY,
                rest_density: 1000.0,
                length_scale: 1.0,
                boundary_spacing_ratio: 0.5,
            },
            solver: SolverSettings {
                substeps: SUBSTEPS,
                iterations,
                relaxation: RelaxationKind::Chebyshev,
                omega: 0.33,
                carry_rate: 2.25,
                // Ten times the speed of a fall through the vessel.
                v_max: 10.0 * (2.0 * GRAVITY * self.height).sqrt(),
                boundary: Boundary::Map,
                viscosity: 0.05,
                vorticity: None,
                surface_tension: None,
                hysteresis: None,
                wall_step: None,
                sleep: false,
            },
            model: vec![
                Feature::Heat,
                Feature::Dilution,
                Feature::Density,
                Feature::Viscosity,
                Feature::Evaporation,
            ],
            paper: None,
            physical: Some(PhysicalChemistry {
                ambient: Some(20.0),
                mixing: Some(0.041),
                eddy_width: Some(EDDIES * self.spacing),
                superheat_time: Some(0.01),
                ..PhysicalChemistry::default()
            }),
            flasks: vec![Flask {
                name: "calorimeter".into(),
                vessel: glassware::Vessel::default(),
                mass: 0.0,
                profile: self.profile.clone(),
                stage_from_flask: self.pose(0.0),
                fixed: true,
                contact_angle: GLASS,
                heater: 0.0,
                plate: false,
            }],
            liquids: feeds
                .iter()
                .zip(counts)
                .map(|(feed, count)| Liquid {
                    flask: 0,
                    volume: count as f64 * d.powi(3),
                    temperature: feed.temperature,
                    acid_fraction: feed.acid,
                })
                .collect(),
            tools: Vec::new(),
            table: None,
            floor: Floor {
                height: -100.0 * self.height,
            },
            picture: vitriol_sim::scene::PictureSettings::default(),
            presets: BTreeMap::new(),
        }
    }
}
