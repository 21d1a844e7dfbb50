//! Convergence of errors with h and Δt, where the truth is a formula.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use vitriol_gpu::Gpu;
use vitriol_run::{Blame, Failure};
use vitriol_sim::chemistry::{Chemistry, Paper, PaperDilution};
use vitriol_sim::parameters::{Parameters, Relaxation};
use vitriol_sim::solver::{Particle, SolverState};

use super::front::observed_order;
use crate::liquid;
use crate::merge::{Name, number};

/// An error at several resolutions.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Convergence {
    /// The quantity whose error it is, and the truth that it is compared with.
    pub name: Name,
    /// The parameter that is refined.
    pub by: Name,
    /// (h or Δt, error).
    pub errors: Vec<[f64; 2]>,
    /// Slope of the error over the parameter, both logarithms: 1 is first order.
    #[serde(deserialize_with = "number")]
    pub order: f64,
}

impl Convergence {
    fn of(name: &'static str, by: &'static str, errors: Vec<[f64; 2]>) -> Self {
        Self {
            name: name.into(),
            by: by.into(),
            order: observed_order(&errors),
            errors,
        }
    }
}

/// Free fall over Δt, and a step in composition that diffuses over h.
///
/// # Errors
/// The device's error.
pub fn convergence(gpu: &Gpu, quick: bool) -> Result<Vec<Convergence>, Failure> {
    let fall = [2, 4, 8, 16].map(|substeps| free_fall(gpu, substeps));
    let resolutions: &[u32] = if quick { &[10, 20] } else { &[10, 20, 40] };
    let (mut lattice, mut printed) = (Vec::new(), Vec::new());
    for &per_metre in resolutions {
        let (h, [own, whole]) = diffused(gpu, per_metre)?;
        lattice.push([h, own]);
        printed.push([h, whole]);
    }
    Ok(vec![
        Convergence::of(
            "free fall for 0.2 s against ½gt², relative",
            "Δt_s, s",
            fall.into_iter().collect::<Result<_, _>>()?,
        ),
        Convergence::of(
            "a step in c against erf by D, root mean square",
            "h, m",
            printed,
        ),
        Convergence::of(
            "the same by the 0.9915 D that a lattice has at h/d = 2",
            "h, m",
            lattice,
        ),
    ])
}

/// Parameters without walls, weight or viscosity.
fn bare() -> Parameters {
    Parameters {
        frame_time: 1.0 / 100.0,
        substeps: 1,
        iterations: 2,
        relaxation: Relaxation::Jacobi { omega: 0.35 },
        gravity: [0.0; 3],
        max_speed: 100.0,
        viscosity: 0.0,
        ..Parameters::of_water(0.0025)
    }
}

/// State of `particles` after `frames`, in the order of their slots.
fn run(
    gpu: &Gpu,
    parameters: Parameters,
    particles: &[Particle],
    frames: u32,
) -> Result<SolverState, Failure> {
    let solver = liquid::solver(gpu, &liquid::alone(parameters, particles))?;
    for _ in 0..frames {
        liquid::frame(gpu, &solver, &[], &[])?;
    }
    solver.snapshot().other()
}

fn free_fall(gpu: &Gpu, substeps: u32) -> Result<[f64; 2], Failure> {
    let gravity = 9.81;
    let parameters = Parameters {
        substeps,
        gravity: [0.0, -gravity, 0.0],
        ..bare()
    };
    let (step, time) = (parameters.substep_time(), 0.2);
    let state = run(gpu, parameters, &[liquid::water(DVec3::ZERO)], 20)?;
    let fallen = state
        .positions
        .first()
        .map_or(f64::NAN, |p| -f64::from(p[1]));
    let exact = 0.5 * gravity * time * time;
    Ok([step, (fallen / exact - 1.0).abs()])
}

/// D, m²/s, and duration of the diffusion, s: a front √(4Dt) = 0.2 m wide.
const DIFFUSIVITY: f64 = 0.01;
const TIME: f64 = 1.0;
/// Share of D that Eq. 5 has on the cubic lattice at h/d = 2 (`chemistry/exchange.rs`).
const LATTICE: f64 = 0.9915;
/// Length and width of the rod, m: in this time, the missing neighbours at its faces do not affect its middle.
const LENGTH: f64 = 1.6;
const WIDTH: f64 = 0.68;

/// h, and the error against the lattice's own D and against D.
fn diffused(gpu: &Gpu, per_metre: u32) -> Result<(f64, [f64; 2]), Failure> {
    let d = 1.0 / f64::from(per_metre);
    let support = 2.0 * d;
    // Nearest neighbours exchange 0.009 of their difference then, against a limit of 1/72.
    let frames = (TIME * DIFFUSIVITY / (0.005 * support * support)).ceil() as u32;
    let parameters = Parameters {
        spacing: d,
        support_radius: support,
        frame_time: TIME / f64::from(frames),
        margin: 0.001 * support,
        chemistry: Some(Chemistry::Paper(Paper {
            dilution: Some(PaperDilution {
                ambient: 20.0,
                heat_diffusivity: DIFFUSIVITY,
                acid_diffusivity: DIFFUSIVITY,
                heat_generation: 0.0,
            }),
            boiling: None,
        })),
        ..bare()
    };
    let along = (LENGTH / d).round() as u32;
    // Odd, so that there is a line in the middle.
    let across = (WIDTH / d) as u32 | 1;
    let place = |n: u32, count: u32| (f64::from(n) + 0.5 - 0.5 * f64::from(count)) * d;
    let mut particles = Vec::new();
    for i in 0..along {
        for j in 0..across {
            for k in 0..across {
                let x = DVec3::new(place(i, along), place(j, across), place(k, across));
                particles.push(Particle {
                    acid: if x.x < 0.0 { 1.0 } else { 0.0 },
                    ..liquid::water(x)
                });
            }
        }
    }
    let state = run(gpu, parameters, &particles, frames)?;
    // The line in the middle: at the rod's faces neighbours are missing.
    let middle = across / 2;
    let (mut squares, mut count) = ([0.0; 2], 0.0);
    for (slot, tag) in state.tags.iter().enumerate() {
        let (j, k) = (tag[1] / across % across, tag[1] % across);
        let x = f64::from(state.positions[slot][0]);
        if j != middle || k != middle || x.abs() > 0.5 {
            continue;
        }
        for (sum, share) in squares.iter_mut().zip([LATTICE, 1.0]) {
            let truth = 0.5 * libm::erfc(x / (4.0 * share * DIFFUSIVITY * TIME).sqrt());
            *sum += (f64::from(state.heat[slot][1]) - truth).powi(2);
        }
        count += 1.0;
    }
    let root = |sum: f64| (sum / f64::max(count, 1.0)).sqrt();
    Ok((support, squares.map(root)))
}
