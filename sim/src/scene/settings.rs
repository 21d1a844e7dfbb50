//! The parts of a scene that are plain numbers, as they stand in its file.

use super::error::Problem;
use super::feature::Feature;
use super::fields::{Field, Must, check_fields, exactly, require, within};
use serde::{Deserialize, Serialize};

/// Heaviest that liquid or glass may be, kg/m³: osmium, the heaviest metal, has 22,600.
pub(super) const HEAVIEST: f64 = 25_000.0;
/// Fastest that liquid may be allowed to be, m/s: single precision holds the square of it by far. Our choice.
const FASTEST: f64 = 1e9;
/// Widest table, m. Our choice: ten times the widest that `vitriol extremes` has.
const WIDEST: f64 = 1000.0;

/// Our choice: faster than liquid in any flask.
const CONFINEMENT: Must = (
    |value| (0.0..=100.0).contains(&value),
    "zero or more, up to 100 (m/s)",
);
/// Molten metals have the highest surface tensions, up to 2.7 N/m (Keene, International Materials Reviews 38, 1993).
const TENSION: Must = (
    |value| (0.0..=3.0).contains(&value),
    "zero or more, up to 3 (N/m): water has 0.0728, molten metals up to 2.7",
);

/// Lengths, time and gravity of a scene, on which it depends whether the liquid stands up: PBF's
/// stiffness at a given number of iterations is set by g·Δt_s²/d.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Scale {
    /// Particle spacing d, metres of the scene.
    pub spacing: f64,
    /// h/d.
    pub support_ratio: f64,
    /// Frame time Δt_f, seconds.
    pub frame_time: f64,
    /// Gravity, m/s², downwards.
    pub gravity: f64,
    /// Rest density ρ₀, kg/m³.
    pub rest_density: f64,
    /// Real metres per metre of the scene: 1 at real size; less where the
    /// world is larger than what it shows and is drawn smaller.
    pub length_scale: f64,
    /// Spacing of boundary particles over d, where the boundary is of
    /// particles.
    pub boundary_spacing_ratio: f64,
}

impl Scale {
    /// Support radius h, metres.
    pub fn support(&self) -> f64 {
        self.spacing * self.support_ratio
    }

    /// Particle mass ρ₀d³, kg.
    pub fn particle_mass(&self) -> f64 {
        self.rest_density * self.spacing.powi(3)
    }

    /// Spacing of boundary particles, metres.
    pub fn boundary_spacing(&self) -> f64 {
        self.spacing * self.boundary_spacing_ratio
    }
}

/// Representation of walls in the density sum.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    /// The axisymmetric volume map.
    Map,
    /// The paper's boundary particles.
    Particles,
}

/// How the iterations of a substep approach the constraint.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RelaxationKind {
    /// The paper's under-relaxed Jacobi iteration, by `omega`.
    Jacobi,
    /// Chebyshev's semi-iteration, over a spectrum up to 2/`omega`.
    Chebyshev,
}

/// Parameters of Algorithm 1.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SolverSettings {
    /// n_steps: substeps a frame.
    pub substeps: u32,
    /// solverIterations: density iterations a substep.
    pub iterations: u32,
    /// How they approach the constraint.
    pub relaxation: RelaxationKind,
    /// ω: under-relaxation of line 20. Jacobi's iteration converges below
    /// 2/λ_max, Chebyshev's takes 2/ω for the end of the spectrum; a cubic
    /// lattice at h/d = 2 has λ_max = 2.82.
    pub omega: f64,
    /// Rate (1/s) at which the carried multipliers follow those that are
    /// found: each substep starts from a pressure that was found before
    /// instead of from none. 0 leaves it out. A share per substep above the
    /// slowest mode's decay in a substep (0.03 in a filled beaker) makes the
    /// column ring.
    pub carry_rate: f64,
    /// v_max of line 24, m/s.
    pub v_max: f64,
    /// Representation of walls in the density sum.
    pub boundary: Boundary,
    /// μ₀ of Eqs 16 and 17: share of the relative velocity that XSPH takes
    /// away in one of the paper's substeps (1/180 s), 0 to 1.
    pub viscosity: f64,
    /// Strength ε of vorticity confinement, m/s (Macklin & Müller 2013,
    /// Eq. 16); with the feature `vorticity`.
    pub vorticity: Option<f64>,
    /// Surface tension σ of water at 20 °C, N/m; with the feature `tension`.
    pub surface_tension: Option<f64>,
    /// Difference between the advancing and the receding contact angle of all that is solid, degrees; 20 where it is left out.
    /// With the feature `tension`.
    pub hysteresis: Option<f64>,
    /// Most of d that a flask's wall moves in a substep: with a faster hand a step takes more substeps, up to three times as many.
    /// Without this value the number of substeps is constant.
    pub wall_step: Option<f64>,
    /// Whether liquid that is at rest, even and at the room's temperature is left out of the passes until something comes near.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub sleep: bool,
}

/// Changes of a preset; values that it does not name stay as the scene has them.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PresetOverrides {
    /// Substeps a frame.
    pub substeps: Option<u32>,
    /// Iterations a substep.
    pub iterations: Option<u32>,
    /// ω.
    pub omega: Option<f64>,
    /// Rate at which multipliers are carried on, 1/s.
    pub carry_rate: Option<f64>,
    /// Particle spacing d, metres; volumes of liquid stay, so the number of
    /// particles follows.
    pub spacing: Option<f64>,
    /// Whether liquid at rest is left out.
    pub sleep: Option<bool>,
}

/// The table in the file.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TableTop {
    /// Height of the upper surface, metres.
    pub top: f64,
    /// Centre (x, z), metres.
    #[serde(deserialize_with = "exactly")]
    pub centre: [f64; 2],
    /// Extent along x and z, metres.
    #[serde(deserialize_with = "exactly")]
    pub size: [f64; 2],
}

impl TableTop {
    /// Thickness of the top at real size, metres.
    pub const THICKNESS: f64 = 0.04;

    pub(super) fn check(&self) -> Result<(), Problem> {
        finite("table.top", &[self.top])?;
        finite("table.centre", &self.centre)?;
        for side in self.size {
            let must = "above zero and up to 1000 (metres)";
            require("table.size", side, side > 0.0 && side <= WIDEST, must)?;
        }
        Ok(())
    }
}

/// The floor, a plane without end.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Floor {
    /// Its height, metres.
    pub height: f64,
}

/// Refuses lengths that are no numbers.
fn finite(field: &str, values: &[f64]) -> Result<(), Problem> {
    values
        .iter()
        .try_for_each(|&value| require(field, value, true, "a finite number (metres)"))
}

impl Scale {
    pub(super) fn check(&self) -> Result<(), Problem> {
        let positive = |field: &str, value: f64, unit: &str| {
            let must = format!("a finite number above zero ({unit})");
            require(&format!("scale.{field}"), value, value > 0.0, &must)
        };
        positive("spacing", self.spacing, "metres")?;
        positive("frame_time", self.frame_time, "seconds")?;
        let frame = self.frame_time;
        let must = "0.00001 or more (seconds): a run of hours would never end";
        require("scale.frame_time", frame, frame >= 1e-5, must)?;
        let range = "at most 0.1 (seconds): flasks would pass through each other and the table";
        require("scale.frame_time", frame, frame <= 0.1, range)?;
        let range = "from 1 to 25000 (kg/m³): the heaviest metal has 22600";
        within(
            "scale.rest_density",
            self.rest_density,
            1.0..=HEAVIEST,
            range,
        )?;
        let range = "from 0.001 to 1000 (real metres per metre)";
        within("scale.length_scale", self.length_scale, 1e-3..=1e3, range)?;
        let range = "between 1.5 and 3 (h/d): with fewer neighbours a liquid does not rest";
        within("scale.support_ratio", self.support_ratio, 1.5..=3.0, range)?;
        let downwards = "from 0 to 300 (m/s², downwards): the Sun's surface has 274";
        within("scale.gravity", self.gravity, 0.0..=300.0, downwards)?;
        let ratio = self.boundary_spacing_ratio;
        let range = "between 0.25 and 2 (over d)";
        within("scale.boundary_spacing_ratio", ratio, 0.25..=2.0, range)
    }
}

impl SolverSettings {
    pub(super) fn fields(&self) -> [Field; 2] {
        use Feature::{Tension, Vorticity};
        [
            ("vorticity", Vorticity, self.vorticity, CONFINEMENT),
            ("surface_tension", Tension, self.surface_tension, TENSION),
        ]
    }

    pub(super) fn check(&self) -> Result<(), Problem> {
        for (field, value) in [("substeps", self.substeps), ("iterations", self.iterations)] {
            let field = format!("solver.{field}");
            within(&field, value.into(), 1.0..=1000.0, "between 1 and 1000")?;
        }
        // A scene may come with a track from anyone, and a frame that never ends is no frame; the finest run of any
        // measurement has 192.
        let solves = f64::from(self.substeps) * f64::from(self.iterations);
        let must = "at most 4096 a frame, the product of substeps and iterations";
        within("solver.iterations", solves, 1.0..=4096.0, must)?;
        let omega = self.omega;
        let ok = omega > 0.0 && omega < 2.0;
        require("solver.omega", omega, ok, "above 0 and below 2")?;
        let rate = self.carry_rate;
        require("solver.carry_rate", rate, rate >= 0.0, "zero or more (1/s)")?;
        let v_max = self.v_max;
        let fits = v_max > 0.0 && v_max <= FASTEST;
        let must = "above zero and up to 1000000000 (m/s)";
        require("solver.v_max", v_max, fits, must)?;
        let share = "between 0 and 1 (a share of relative velocities)";
        within("solver.viscosity", self.viscosity, 0.0..=1.0, share)?;
        if let Some(step) = self.wall_step {
            let range = "between 0.1 and 10 (of the spacing)";
            within("solver.wall_step", step, 0.1..=10.0, range)?;
        }
        if let Some(hysteresis) = self.hysteresis {
            let range = "from 0 to 90 (degrees)";
            within("solver.hysteresis", hysteresis, 0.0..=90.0, range)?;
            if self.surface_tension.is_none() {
                let problem = "not used without `surface_tension`; leave it out";
                return Err(Problem::new("solver.hysteresis", problem.to_owned()));
            }
        }
        let tension = self.surface_tension.unwrap_or(0.0);
        if tension > 0.0 && self.boundary == Boundary::Particles {
            let problem = "needs walls of volume maps, whose share of space it reads; take `boundary = \"map\"` or leave it out";
            return Err(Problem::new("solver.surface_tension", problem));
        }
        check_fields("solver", &self.fields())
    }
}

/// How the liquid's splatted particles become a surface in the picture.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PictureFilter {
    /// Truong and Yuksel's narrow-range filter of 2018.
    #[default]
    NarrowRange,
    /// Van der Laan's curvature flow of 2009, the paper's.
    CurvatureFlow,
}

impl PictureFilter {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::NarrowRange, Self::CurvatureFlow];

    /// The name as it is given and reported.
    pub fn name(self) -> &'static str {
        match self {
            Self::NarrowRange => "narrow-range",
            Self::CurvatureFlow => "curvature-flow",
        }
    }
}

/// How acid and water are distinguished in the picture.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PictureTint {
    /// By tints that the real liquids do not have.
    #[default]
    Artificial,
    /// By refraction alone.
    None,
}

impl PictureTint {
    /// The name as it is given and reported.
    pub fn name(self) -> &'static str {
        match self {
            Self::Artificial => "artificial",
            Self::None => "none",
        }
    }
}

/// How bright the room is in the picture.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PictureRoom {
    /// By day: 800 lx on the bench.
    #[default]
    Day,
    /// A sunny noon, 1,700 lx.
    Bright,
    /// By evening, 70 lx.
    Dark,
    /// By day, with nothing but table and window, and nothing printed on glass: for comparisons with other programs.
    Bare,
}

impl PictureRoom {
    /// The name as it is given.
    pub fn name(self) -> &'static str {
        match self {
            Self::Day => "day",
            Self::Bright => "bright",
            Self::Dark => "dark",
            Self::Bare => "bare",
        }
    }
}

/// How the scene is drawn; the simulation does not depend on it.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct PictureSettings {
    /// Filter of the liquid's surface.
    pub filter: PictureFilter,
    /// How acid and water are distinguished.
    pub tint: PictureTint,
    /// How bright the room is.
    pub room: PictureRoom,
}
