//! Liquids with a chemistry for both solvers.

use crate::common::*;
use crate::leaning_glass;
use glam::DVec3;
use vitriol_gpu::Gpu;
use vitriol_sim::chemistry::bubbles::Bubbles;
use vitriol_sim::chemistry::paper::{AntiViscosity, Boiling, Diffusion, Dilution};
use vitriol_sim::chemistry::transport::Losses;
use vitriol_sim::chemistry::{Chemistry, Paper, PaperBoiling, PaperDilution, Physical};
use vitriol_sim::measure::{Ledger, measure_heat};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::Reference;
use vitriol_sim::reference::chemistry as reference;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::{Particle, Solver, SolverState};

/// Table 1 at real size: a pair's share of a substep and the heat of a
/// particle as in the paper's world.
pub fn dilution() -> PaperDilution {
    PaperDilution {
        ambient: 20.0,
        heat_diffusivity: 1.5e-4,
        acid_diffusivity: 1.05e-4,
        heat_generation: 136.0,
    }
}

pub fn anti_viscosity(law: Boiling) -> PaperBoiling {
    PaperBoiling {
        boiling_point: 100.0,
        intensity: 1.0,
        law,
    }
}

pub fn paper(dilution: Option<PaperDilution>, boiling: Option<PaperBoiling>) -> Chemistry {
    Chemistry::Paper(Paper { dilution, boiling })
}

/// Bubbles of steam that are born nowhere.
pub fn bubbly() -> Physical {
    Physical {
        bubbles: Some(Bubbles {
            nuclei_spacing: 1e3,
            foam_time: None,
            most: 4096,
            spray: false,
            air: false,
        }),
        superheat_time: None,
        losses: None,
        lamella: None,
        ..built_in()
    }
}

/// `law` with a change of its bubbles.
pub fn bubbling(mut law: Physical, change: impl FnOnce(&mut Bubbles)) -> Physical {
    change(law.bubbles.as_mut().unwrap());
    law
}

/// The physical chemistry of the built-in scene `water-into-acid`, but its particles hold their vapour.
pub fn built_in() -> Physical {
    Physical {
        bubbles: None,
        superheat_time: Some(0.03),
        ..with_bubbles()
    }
}

/// The physical chemistry of the built-in scene `water-into-acid`.
pub fn with_bubbles() -> Physical {
    let scene = Scene::builtin("water-into-acid").unwrap();
    match Chemistry::from_scene(&scene) {
        Some(Chemistry::Physical(physical)) => physical,
        other => panic!("has the physical chemistry, not {other:?}"),
    }
}

/// Nothing but mixing, at once and whole: an insulated vessel whose liquid does not boil.
pub fn mixing_alone() -> Physical {
    Physical {
        density: false,
        viscosity: false,
        superheat_time: None,
        losses: None,
        lamella: None,
        ..built_in()
    }
}

/// All of it, as the built-in scene has it, but insulated.
pub fn boiling() -> Physical {
    Physical {
        losses: None,
        ..built_in()
    }
}

/// All of it, with losses some hundred times the scene's, so that they are seen, and
/// not alike, so that they can be distinguished.
pub fn everything() -> Physical {
    let losses = |to_air: Losses| Losses {
        glass: 150.0 * to_air.glass,
        surface: 70.0 * to_air.surface,
        ..to_air
    };
    Physical {
        losses: built_in().losses.map(losses),
        ..boiling()
    }
}

pub fn with(chemistry: impl Into<Option<Chemistry>>, parameters: Parameters) -> Parameters {
    Parameters {
        chemistry: chemistry.into(),
        ..parameters
    }
}

/// Gives each particle the (temperature, acid fraction) of its place, as f32.
pub fn fill(particles: &mut [Particle], of: impl Fn(DVec3) -> (f64, f64)) {
    for particle in particles {
        let (temperature, acid) = of(particle.position);
        particle.temperature = f64::from(temperature as f32);
        particle.acid = f64::from(acid as f32);
    }
}

/// The leaning glass with water over acid, mixed where they meet, and hot in
/// the middle.
pub fn leaning_scene(parameters: Parameters) -> Setup {
    let mut setup = leaning_glass::scene(parameters);
    fill(&mut setup.particles, |at| {
        let height = ((at.y - 0.006) / 0.012).clamp(0.0, 1.0);
        let middle = (-(at.y - 0.014).powi(2) / 2e-5).exp();
        (20.0 + 130.0 * middle, 0.98 * (1.0 - height))
    });
    setup
}

/// The reference of `setup` in the leaning glass, with its chemistry.
pub fn leaning_reference(setup: &Setup, poses: &[Pose]) -> Reference {
    let mut truth = leaning_glass::reference(setup, poses);
    let p = &setup.parameters;
    let particles: Vec<_> = setup
        .particles
        .iter()
        .map(|particle| (particle.temperature, particle.acid))
        .collect();
    truth.chemistry = match p.chemistry.as_ref().unwrap() {
        Chemistry::Paper(paper) => {
            let law = paper.dilution.map(|d| reference::DilutionLaw {
                heat: Dilution::new(d.heat_generation, p.particle_mass()),
                temperature_diffusivity: d.heat_diffusivity,
                acid_diffusivity: d.acid_diffusivity,
                ambient: d.ambient,
                scheme: Diffusion::Conservative,
            });
            let boiling = paper.boiling.map(|b| {
                let law = AntiViscosity::new(b.boiling_point, b.intensity).unwrap();
                (law, b.law)
            });
            let paper = reference::ReferencePaper::new(law, boiling, &particles).unwrap();
            Some(reference::ReferenceChemistry::Paper(paper))
        }
        Chemistry::Physical(law) => {
            let physical = reference::ReferencePhysical::new(*law, p.particle_volume(), &particles);
            Some(reference::ReferenceChemistry::Physical(Box::new(
                physical.unwrap(),
            )))
        }
    };
    truth
}

/// The heat's ledger.
pub fn ledger(solver: &Solver) -> Ledger {
    let state = solver.snapshot().unwrap();
    let heat = measure_heat(solver.parameters(), &state);
    heat.and_then(|heat| heat.ledger).unwrap()
}

/// `rows` by slot in the order of the particles' identities.
pub fn by_identity(state: &SolverState, rows: &[[f32; 4]]) -> Vec<[f64; 4]> {
    let mut sorted = vec![[f64::NAN; 4]; rows.len()];
    for (row, tag) in rows.iter().zip(&state.tags) {
        sorted[tag[1] as usize] = row.map(f64::from);
    }
    sorted
}

/// Σ of `of` over the rows.
pub fn sum(rows: &[[f32; 4]], of: impl Fn([f64; 4]) -> f64) -> f64 {
    rows.iter().map(|row| of(row.map(f64::from))).sum()
}

/// Particles of a glass that stands upright, filled by `of` of the height
/// over the filling's, 0 to 1.
pub fn glass_of(count: usize, of: impl Fn(f64) -> (f64, f64)) -> Vec<Particle> {
    let mut particles = water(&narrow_glass(), 0, Pose::IDENTITY, count);
    let top = particles.iter().fold(0.0, |a: f64, p| a.max(p.position.y));
    fill(&mut particles, |at| of(at.y / top));
    particles
}

/// A glass of half acid, half water, and the frame in which it is stirred by
/// giving every particle another velocity, up to `speed` m/s.
pub fn stir(gpu: &Gpu, solver: &Solver, random: &mut Random, speed: f64) {
    let mut state = solver.snapshot().unwrap();
    for velocity in &mut state.velocities {
        let [x, y, z] = random.point(speed).as_vec3().to_array();
        *velocity = [x, y, z, velocity[3]];
    }
    solver.restore(&state).unwrap();
    frames(gpu, solver, &[Pose::IDENTITY], 1);
}

/// A loose lattice of `side`³ particles in the open, 1.2 `spacing` apart: too
/// thin for the density solve, so that line 27 alone changes velocities.
pub fn loose(side: u32, spacing: f64, random: &mut Random, speed: f64) -> Vec<Particle> {
    (0..side.pow(3))
        .map(|i| {
            let site = DVec3::new(
                (i % side).into(),
                (i / side % side).into(),
                (i / side / side).into(),
            );
            let position = site * (1.2 * spacing);
            drop_at(position, random.point(speed).as_vec3().as_dvec3())
        })
        .collect()
}
