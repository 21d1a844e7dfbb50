//! Parameters of the liquid and of the time step for both solvers.

use crate::chemistry::Chemistry;
use crate::chemistry::bubbles::Bubbles;
use crate::chemistry::exchange::Exchange;
use crate::kernel::Kernel;
use crate::scene::{RelaxationKind, Scene};
use crate::surface_tension::SurfaceTension;
use std::f64::consts::PI;

/// Time over which [`Parameters::viscosity`] is defined, seconds: the substep
/// of the paper's setting, 60 Hz with 3 substeps.
pub const REFERENCE_TIME: f64 = 1.0 / 180.0;

/// ν·Δt/h² that an XSPH coefficient of 1 amounts to: half of ∫ W·x² dV/h² of
/// the cubic spline, along one axis.
pub const XSPH_MOMENT: f64 = 0.0375;

/// Parameters of Algorithm 1, SI units.
///
/// The substep has a limit that no number of iterations lifts. A liquid of
/// depth H under gravity g carries multipliers that grow with gH, and their
/// geometric stiffness λ∇²C turns pressure waves unstable beyond about
/// Δt_s = 0.4 d/√(gH). At d = 2.5 mm and 90 Hz × 4, columns of 62 and 80 mm
/// explode, or, with a relaxation too weak for that (ω = 0.2), stay
/// compressed by 17 %; from 90 Hz × 8 on they are calm.
///
/// The remaining density error follows from substeps and iterations.
/// 13,888 particles in a cylinder of radius 33 mm at 90 Hz, mean and 99th
/// percentile of max(0, ρ/ρ₀ − 1):
///
/// | substeps × iterations | relaxation | carry | mean | p99 |
/// |---|---|---|---|---|
/// | 12 × 4 | Jacobi, ω = 0.35 | 0 | 1.44 % | 5.5 % |
/// | 8 × 4 | Chebyshev, b = 6, 5 × | 0 | 1.84 % | 6.7 % |
/// | 12 × 4 | Chebyshev, b = 6, 5 × | 0 | 0.85 % | 3.2 % |
/// | 12 × 4 | Chebyshev, b = 6, 5 × | 0.02 | 0.15 to 0.4 % | 0.5 to 1.4 % |
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Particle spacing d, metres.
    pub spacing: f64,
    /// Support radius h, metres.
    pub support_radius: f64,
    /// Rest density ρ₀, kg/m³.
    pub rest_density: f64,
    /// Frame time Δt_f, seconds.
    pub frame_time: f64,
    /// Substeps per frame (n_steps of line 13), at least one.
    pub substeps: u32,
    /// Iterations per substep (line 18).
    pub iterations: u32,
    /// Weights of the constraint's value in each iteration (line 20).
    pub relaxation: Relaxation,
    /// How fast the multiplier with which a substep starts follows the ones
    /// that were found, 1/s; 0 for a cold start.
    pub carry_rate: f64,
    /// Acceleration by external forces, m/s².
    pub gravity: [f64; 3],
    /// v_max of line 24, m/s.
    pub max_speed: f64,
    /// XSPH coefficient μ of Eq. 16 per [`REFERENCE_TIME`], 0 to 1.
    pub viscosity: f64,
    /// Vorticity confinement ε (Macklin & Müller 2013, Eq. 16), m/s: the
    /// acceleration is ε·(N × ω). 0 leaves it out.
    pub vorticity: f64,
    /// Surface tension and wetting; `None` leaves them out.
    pub surface: Option<SurfaceTension>,
    /// Heat, dilution and boiling; `None` where the scene models no heat.
    pub chemistry: Option<Chemistry>,
    /// Heat that plates give the flasks' bases, W, flask by flask; empty without a plate.
    pub heaters: Vec<f64>,
    /// Whether passes are left out while they would change nothing. The bits are the same without.
    pub dormant: bool,
    /// Whether passes leave liquid out that is at rest, even and at the room's temperature.
    pub sleep: bool,
    /// Margin of the neighbour list beyond h, fraction of h.
    pub list_margin: f64,
    /// How far a particle may be from where it was listed, fraction of h.
    pub list_reach: f64,
    /// Distance d_margin that the flask constraint keeps from the glass,
    /// metres; the paper's is 0.001 h.
    pub margin: f64,
}

/// How the iterations of a substep approach the solution of Eq. 2.
///
/// Both are λ ← min(0, λ − c_r·C/a + c_m·Δλ), where Δλ is the change by the
/// iteration before and a is [`Parameters::gradient_sum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relaxation {
    /// The paper's: under-relaxed Jacobi, c_r = ω and c_m = 0.
    Jacobi {
        /// ω, above 0 and at most 1.
        omega: f64,
    },
    /// Chebyshev's semi-iteration (Golub & Varga 1961), the optimal
    /// polynomial for the part of the spectrum of ∂C/∂λ/a between a lower
    /// bound and `spectral_bound`.
    Chebyshev {
        /// Upper bound b of the spectrum. The cubic lattice at h/d = 2 has
        /// 2.82; disorder and compression raise it, 6 is stable.
        spectral_bound: f64,
        /// By what factor the iterations of one substep together reduce
        /// every error component of the interval, above 1. Few iterations
        /// and a high factor make the interval short.
        reduction: f64,
    },
}

impl Relaxation {
    /// (momentum c_m, residual c_r) of each of `iterations` iterations.
    pub fn coefficients(&self, iterations: u32) -> Vec<(f64, f64)> {
        match *self {
            Self::Jacobi { omega } => vec![(0.0, omega); iterations as usize],
            Self::Chebyshev {
                spectral_bound,
                reduction,
            } => chebyshev(spectral_bound, reduction, iterations),
        }
    }
}

/// Saad, Iterative Methods for Sparse Linear Systems (2003), algorithm 12.1,
/// with centre θ and half width δ of the interval. The lower end follows
/// from T_n(θ/δ) = `reduction`, the factor by which n iterations reduce the
/// error.
fn chebyshev(spectral_bound: f64, reduction: f64, iterations: u32) -> Vec<(f64, f64)> {
    let sigma = (reduction.acosh() / f64::from(iterations)).cosh();
    let delta = spectral_bound / (1.0 + sigma);
    let theta = sigma * delta;
    let mut before = 1.0 / sigma;
    (0..iterations)
        .map(|iteration| {
            if iteration == 0 {
                return (0.0, 1.0 / theta);
            }
            let rho = 1.0 / (2.0 * sigma - before);
            let momentum = rho * before;
            before = rho;
            (momentum, 2.0 * rho / delta)
        })
        .collect()
}

/// Margin of the neighbour list, fraction of h. Two particles may come nearer by twice the reach before a list is rebuilt, but
/// neighbours move alike: the pairs missing from lists are 1e-7 of the density, and 1.3e-4 of a particle's at most
/// (`sim/tests/solver/neighbours.rs`).
/// With 0.15, where no pair is missing, a pass over neighbours fetches a third more.
const LIST_MARGIN: f64 = 0.05;

/// How far a particle may be from where it was listed, fraction of h. With 0.1 a shaken flask is 10.6 % too dense in place of 7 %.
const LIST_REACH: f64 = 0.075;

/// By what factor a substep's Chebyshev iterations reduce the fast modes. At
/// 2 the modes at the ends of the spectrum are still a half, and a column at
/// rest keeps a rms speed of 0.05 m/s; from 5 on it is calm.
const CHEBYSHEV_REDUCTION: f64 = 5.0;

/// Neighbours that a list has room for, over those of an undisturbed lattice:
/// the liquid may be a third too dense before a neighbour is left out.
const LIST_HEADROOM: f64 = 1.35;

/// Least volume of a particle over V₀ for which lists have room where density
/// follows composition: equal volumes of water and acid contract by 8 %, and
/// what boils loses water.
const LEAST_VOLUME: f64 = 0.75;

/// d_margin over h (section 5).
const FLASK_MARGIN: f64 = 0.001;

impl Parameters {
    /// Water in particles of that spacing, m, at 90 Hz × 12 × 4, cold at each start, without surface tension and heat.
    pub fn of_water(spacing: f64) -> Self {
        let support_radius = 2.0 * spacing;
        Self {
            spacing,
            support_radius,
            rest_density: 1000.0,
            frame_time: 1.0 / 90.0,
            substeps: 12,
            iterations: 4,
            relaxation: Relaxation::Chebyshev {
                spectral_bound: 6.0,
                reduction: CHEBYSHEV_REDUCTION,
            },
            carry_rate: 0.0,
            gravity: [0.0, -9.81, 0.0],
            max_speed: 8.0,
            viscosity: 0.02,
            vorticity: 0.0,
            surface: None,
            chemistry: None,
            heaters: Vec::new(),
            dormant: true,
            sleep: false,
            list_margin: LIST_MARGIN,
            list_reach: LIST_REACH,
            margin: FLASK_MARGIN * support_radius,
        }
    }

    /// Whether walls hold the line at which a surface ends on them.
    pub fn sticks(&self) -> bool {
        let surface = self.surface.as_ref();
        surface.is_some_and(|surface| surface.hysteresis > 0.0)
    }

    /// Bubbles of steam, where the scene has them.
    pub fn bubbles(&self) -> Option<&Bubbles> {
        match &self.chemistry {
            Some(Chemistry::Physical(physical)) => physical.bubbles.as_ref(),
            _ => None,
        }
    }

    /// The parameters of `scene`; a preset is applied to the scene beforehand
    /// ([`Scene::with_preset`]).
    pub fn from_scene(scene: &Scene) -> Self {
        let (scale, solver) = (&scene.scale, &scene.solver);
        Self {
            spacing: scale.spacing,
            support_radius: scale.support(),
            rest_density: scale.rest_density,
            frame_time: scale.frame_time,
            substeps: solver.substeps,
            iterations: solver.iterations,
            relaxation: match solver.relaxation {
                RelaxationKind::Jacobi => Relaxation::Jacobi {
                    omega: solver.omega,
                },
                RelaxationKind::Chebyshev => Relaxation::Chebyshev {
                    spectral_bound: 2.0 / solver.omega,
                    reduction: CHEBYSHEV_REDUCTION,
                },
            },
            carry_rate: solver.carry_rate,
            gravity: [0.0, -scale.gravity, 0.0],
            max_speed: solver.v_max,
            viscosity: solver.viscosity,
            vorticity: solver.vorticity.unwrap_or(0.0),
            surface: scene.surface_tension(),
            chemistry: Chemistry::from_scene(scene),
            heaters: scene.flasks.iter().map(|flask| flask.heater).collect(),
            dormant: true,
            sleep: solver.sleep,
            list_margin: LIST_MARGIN,
            list_reach: LIST_REACH,
            margin: FLASK_MARGIN * scale.support(),
        }
    }

    /// Volume V₀ = d³ of a particle, m³.
    pub fn particle_volume(&self) -> f64 {
        self.spacing.powi(3)
    }

    /// Mass m = ρ₀d³ of a particle, kg.
    pub fn particle_mass(&self) -> f64 {
        self.rest_density * self.particle_volume()
    }

    /// Substep Δt_s of line 13, seconds.
    pub fn substep_time(&self) -> f64 {
        self.frame_time / f64::from(self.substeps)
    }

    /// α = 1 − exp(−rate·Δt_s): the share of a substep's multipliers that the
    /// carried ones take on.
    pub fn carried_share(&self) -> f64 {
        -(-self.carry_rate * self.substep_time()).exp_m1()
    }

    /// Neighbours that a list has room for.
    pub fn list_capacity(&self) -> u32 {
        let reach = self.support_radius * (1.0 + self.list_margin);
        let sphere = 4.0 / 3.0 * PI * (reach / self.spacing).powi(3);
        let contracts = match &self.chemistry {
            Some(Chemistry::Physical(physical)) => physical.density,
            _ => false,
        };
        let closer = if contracts { 1.0 / LEAST_VOLUME } else { 1.0 };
        (sphere * LIST_HEADROOM * closer / 8.0).ceil() as u32 * 8
    }

    /// Diffusion in a substep with lists of at most `capacity` ≥ 1 neighbours.
    pub fn exchange(&self, capacity: u32) -> Exchange {
        let kernel = Kernel::new(self.support_radius);
        Exchange::new(
            kernel,
            self.particle_volume(),
            self.substep_time(),
            capacity,
        )
    }

    /// a = Σ_j |V₀∇W_ij|² over a full neighbourhood of the cubic lattice,
    /// 1/m².
    ///
    /// A constant in place of each particle's own sum: that one vanishes for
    /// a lone particle, and would take a pass to find.
    pub fn gradient_sum(&self) -> f64 {
        let kernel = Kernel::new(self.support_radius);
        let reach = (self.support_radius / self.spacing).ceil() as i64;
        let axis = || (-reach..=reach).map(|i| i as f64 * self.spacing);
        axis()
            .flat_map(|x| axis().flat_map(move |y| axis().map(move |z| x.hypot(y).hypot(z))))
            .map(|distance| (self.particle_volume() * kernel.dw(distance)).powi(2))
            .sum()
    }

    /// μ_s = 1 − (1 − μ)^(Δt_s/Δt_ref), the XSPH coefficient of one substep,
    /// so that the change of a velocity in a second does not depend on the
    /// number of substeps.
    pub fn substep_viscosity(&self) -> f64 {
        1.0 - (1.0 - self.viscosity).powf(self.substep_time() / REFERENCE_TIME)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic)]
    use super::*;

    /// The error of x ← x + … on A = diag(μ) after all iterations, per μ.
    fn residual(relaxation: Relaxation, iterations: u32, mu: f64) -> f64 {
        let (mut error, mut change) = (1.0, 0.0);
        for (momentum, step) in relaxation.coefficients(iterations) {
            change = momentum * change - step * mu * error;
            error += change;
        }
        error
    }

    #[test]
    fn chebyshev_is_the_chebyshev_polynomial() {
        let (bound, reduction) = (6.0, 5.0);
        let relaxation = Relaxation::Chebyshev {
            spectral_bound: bound,
            reduction,
        };
        for n in [1, 2, 4, 7] {
            let sigma = (reduction.acosh() / f64::from(n)).cosh();
            let delta = bound / (1.0 + sigma);
            for i in 0..=100 {
                let mu = bound * f64::from(i) / 100.0;
                let x = sigma - mu / delta;
                let t = if x.abs() <= 1.0 {
                    (f64::from(n) * x.acos()).cos()
                } else {
                    x.signum().powi(n as i32) * (f64::from(n) * x.abs().acosh()).cosh()
                };
                let own = residual(relaxation, n, mu);
                assert!((own - t / reduction).abs() < 1e-12, "{n} {mu} {own} {t}");
            }
        }
    }

    #[test]
    fn a_scenes_numbers_arrive() {
        let mut scene = Scene::builtin("water-into-acid").unwrap();
        let solver = &mut scene.solver;
        (solver.vorticity, solver.viscosity) = (Some(0.1), 0.4);
        solver.surface_tension = Some(0.06);
        (solver.carry_rate, solver.omega, solver.v_max) = (0.5, 0.25, 7.0);
        (solver.substeps, solver.iterations) = (8, 9);
        let p = Parameters::from_scene(&scene);
        assert_eq!((p.vorticity, p.surface.unwrap().tension), (0.1, 0.06));
        assert_eq!((p.viscosity, p.carry_rate, p.max_speed), (0.4, 0.5, 7.0));
        assert_eq!((p.substeps, p.iterations), (8, 9));
        assert_eq!((p.spacing, p.support_radius), (0.0025, 0.005));
        assert_eq!(p.gravity, [0.0, -9.81, 0.0]);
        // Section 5's margin.
        assert!((p.margin - 5e-6).abs() < 1e-18);
        let Relaxation::Chebyshev { spectral_bound, .. } = p.relaxation else {
            panic!("the scene asks for Chebyshev")
        };
        assert_eq!(spectral_bound, 8.0);
    }

    /// Eq. 16 in a linear shear flow's curvature: ν·Δt = ½ ∫ W·x² dV along one
    /// axis, a third of ∫ W·r² dV.
    #[test]
    fn xsph_moment_is_the_kernels() {
        let kernel = Kernel::new(1.0);
        let n = 10_000;
        let radii = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n));
        let shells = radii.map(|r| 4.0 * PI * r.powi(4) * kernel.w(r));
        let moment = shells.sum::<f64>() / f64::from(n) / 6.0;
        assert!((moment / XSPH_MOMENT - 1.0).abs() < 1e-6, "{moment}");
    }

    #[test]
    fn jacobi_is_a_power() {
        let relaxation = Relaxation::Jacobi { omega: 0.35 };
        let own = residual(relaxation, 4, 2.0);
        assert!((own - 0.3f64.powi(4)).abs() < 1e-15);
    }
}
