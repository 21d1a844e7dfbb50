//! One setting of the solver's knobs.

use serde::{Deserialize, Serialize};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::scene::{Boundary, Preset, RelaxationKind, Scene};

/// The solver's knobs; everything else of the liquid is the scene's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    /// Particle spacing d, m.
    pub spacing: f64,
    /// h/d.
    pub support_ratio: f64,
    /// Frame time Δt_f, s.
    pub frame_time: f64,
    /// Substeps a frame.
    pub substeps: u32,
    /// Iterations a substep.
    pub iterations: u32,
    /// Whether it uses Chebyshev's iteration; else Jacobi's.
    pub chebyshev: bool,
    /// ω.
    pub omega: f64,
    /// Rate at which multipliers are carried on, 1/s.
    pub carry_rate: f64,
    /// Whether walls are boundary particles; else maps.
    pub boundary_particles: bool,
    /// Margin of the neighbour list over h.
    pub list_margin: f64,
}

/// The knob that a point of a sweep turns.
#[derive(Clone, Copy, Debug, Eq, Ord, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Knob {
    /// None: a preset as it is.
    Preset,
    /// Number of particles at constant volume.
    Particles,
    /// Substeps.
    Substeps,
    /// Iterations.
    Iterations,
    /// Acceleration: iteration and carried multipliers.
    Acceleration,
    /// Frame time.
    FrameTime,
    /// Maps or boundary particles.
    Boundary,
    /// h/d.
    Support,
    /// The neighbour list's margin.
    Margin,
    /// Substeps and iterations together.
    SubstepsIterations,
    /// Particles and frame time together.
    ParticlesFrameTime,
}

impl Knob {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Preset => "preset",
            Self::Particles => "particles",
            Self::Substeps => "substeps",
            Self::Iterations => "iterations",
            Self::Acceleration => "acceleration",
            Self::FrameTime => "frame time",
            Self::Boundary => "boundary",
            Self::Support => "h/d",
            Self::Margin => "list margin",
            Self::SubstepsIterations => "substeps × iterations",
            Self::ParticlesFrameTime => "particles × frame time",
        }
    }
}

impl Setting {
    /// The setting of `scene` under `preset`.
    pub fn of(scene: &Scene, preset: Preset) -> Self {
        let scene = scene.with_preset(preset);
        let (scale, solver) = (&scene.scale, &scene.solver);
        Self {
            spacing: scale.spacing,
            support_ratio: scale.support_ratio,
            frame_time: scale.frame_time,
            substeps: solver.substeps,
            iterations: solver.iterations,
            chebyshev: solver.relaxation == RelaxationKind::Chebyshev,
            omega: solver.omega,
            carry_rate: solver.carry_rate,
            boundary_particles: solver.boundary == Boundary::Particles,
            list_margin: Parameters::from_scene(&scene).list_margin,
        }
    }

    /// The solver's parameters under it; all others as in `scene`.
    pub fn parameters(&self, scene: &Scene) -> Parameters {
        let mut scene = scene.clone();
        scene.scale.spacing = self.spacing;
        scene.scale.support_ratio = self.support_ratio;
        scene.scale.frame_time = self.frame_time;
        let solver = &mut scene.solver;
        solver.substeps = self.substeps;
        solver.iterations = self.iterations;
        solver.relaxation = if self.chebyshev {
            RelaxationKind::Chebyshev
        } else {
            RelaxationKind::Jacobi
        };
        (solver.omega, solver.carry_rate) = (self.omega, self.carry_rate);
        // What is measured goes on.
        solver.sleep = false;
        Parameters {
            list_margin: self.list_margin,
            ..Parameters::from_scene(&scene)
        }
    }

    /// This setting with another number of particles for `volume` m³, by its spacing.
    pub fn with_particles(self, particles: f64, volume: f64) -> Self {
        Self {
            spacing: (volume / particles).cbrt(),
            ..self
        }
    }

    /// Δt_s over its limit 0.4 d/√(gH) in a column `depth` m deep.
    pub fn stiffness(&self, gravity: f64, depth: f64) -> f64 {
        let substep = self.frame_time / f64::from(self.substeps);
        substep * (gravity * depth).sqrt() / (0.4 * self.spacing)
    }

    /// The setting in words.
    pub fn label(&self) -> String {
        let iteration = match (self.chebyshev, self.carry_rate > 0.0) {
            (false, _) => format!("Jacobi ω {}", self.omega),
            (true, false) => "Chebyshev".into(),
            (true, true) => format!("Chebyshev, carried at {} 1/s", self.carry_rate),
        };
        format!(
            "{} × {}, {iteration}, d {:.2} mm, {:.0} Hz",
            self.substeps,
            self.iterations,
            1e3 * self.spacing,
            1.0 / self.frame_time
        )
    }
}
