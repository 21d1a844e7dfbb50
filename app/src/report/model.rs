//! What a report holds. Field names are the keys of `report.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// The report of one run. SI units throughout.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Program and version, such as `vitriol 0.1.0`.
    pub program: String,
    /// The command line that makes this run again.
    pub command: String,
    /// The track: a built-in name or a file's path.
    pub track: String,
    /// Preset: `fast`, `balanced` or `reference`.
    pub preset: String,
    /// Seed of the initial jitter.
    pub seed: u64,
    /// Fluid particles at the start.
    pub fluid_particles: u64,
    /// Particles on the wrong side of a wall: the most in any of the run's
    /// samples (ten a second) or at its end.
    pub lost_particles: u64,
    /// Particles that turned non-finite and were taken out.
    pub nan_particles: u64,
    /// Density error max(0, ρ/ρ₀ − 1), the compression that Eq. 2 forbids:
    /// mean over particles, averaged over the run's samples after the start;
    /// 0.01 is one per cent.
    pub density_error_mean: f64,
    /// 99th percentile of the same, the largest of the run's samples.
    pub density_error_p99: f64,
    /// Simulated frames (steps of Δt_f).
    pub frames: u64,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Time the run took by the wall clock, s, without set-up.
    pub wall_s: f64,
    /// Hash of the final state, hexadecimal: same track, scene, preset, seed
    /// and device give the same.
    pub state_hash: String,
    /// What is where at the end, kg.
    pub mass_kg: MassByPlace,
    /// Particle-seconds above the boiling point by flask: what was above it at
    /// the run's samples, times the time between them. Empty where nothing boils.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub boiling_particle_seconds: BTreeMap<String, f64>,
    /// The film, where one was made: of the liquid, unless asked otherwise.
    pub film: Option<FilmStatement>,
    /// The film coloured by temperature, where heat is modelled.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub film_temperature: Option<FilmStatement>,
    /// The device that ran it.
    pub device: DeviceStatement,
    /// The scene's scale and content.
    pub scene: SceneStatement,
    /// The solver's settings.
    pub solver: SolverStatement,
    /// What was counted.
    pub counters: Counters,
    /// The run over time. Empty in what `vitriol replay --json` prints, whole
    /// in `report.json`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub series: Vec<Sample>,
}

/// Fluid mass by place, kg.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct MassByPlace {
    /// Inside each flask, by the flask's name.
    pub flasks: BTreeMap<String, f64>,
    /// On the table, outside all flasks.
    pub table: f64,
    /// On the floor.
    pub floor: f64,
    /// Neither: in the stream, or flying.
    pub air: f64,
}

impl MassByPlace {
    /// All of it, kg.
    pub fn total(&self) -> f64 {
        self.flasks.values().sum::<f64>() + self.table + self.floor + self.air
    }

    /// Each place with its mass, flasks first.
    pub fn places(&self) -> impl Iterator<Item = (&str, f64)> {
        let flasks = self.flasks.iter().map(|(name, kg)| (name.as_str(), *kg));
        flasks.chain([
            ("table", self.table),
            ("floor", self.floor),
            ("air", self.air),
        ])
    }
}

/// The film of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FilmStatement {
    /// Path, relative to the report's folder.
    pub path: String,
    /// Frame width, pixels.
    pub width: u32,
    /// Frame height, pixels.
    pub height: u32,
    /// Frame rate, Hz.
    pub fps: u32,
    /// Frames in the film.
    pub frames: u64,
    /// What it shows: `liquid`, or particles coloured by `speed`, `temperature` or
    /// `acid`.
    pub colour: String,
}

/// The device and driver of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DeviceStatement {
    /// The device's name.
    pub name: String,
    /// The driver and its version.
    pub driver: String,
    /// Vulkan API version.
    pub api: String,
}

/// What every scene states of its scale, and what it models.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneStatement {
    /// Built-in name or file's path.
    pub name: String,
    /// Particle diameter d, m.
    pub d_m: f64,
    /// Support radius over particle diameter, h/d.
    pub h_over_d: f64,
    /// Frame time Δt_f, s.
    pub frame_time_s: f64,
    /// Gravity g, m/s².
    pub gravity_m_s2: f64,
    /// Metres of the laboratory for a metre of the scene: 1 is real size.
    pub length_scale: f64,
    /// What is modelled beyond incompressible flow, such as `cohesion`.
    pub models: Vec<String>,
}

/// The solver's settings in this run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SolverStatement {
    /// Substeps in a frame.
    pub substeps: u32,
    /// Solver iterations in a substep.
    pub iterations: u32,
    /// Relaxation: `jacobi` or `chebyshev`.
    pub relaxation: String,
    /// Relaxation factor ω.
    pub omega: f64,
    /// Low-pass weight of the carried multipliers; 0 where none are carried.
    pub carry: f64,
    /// Speed at which particles are cut, the scene's unit per second.
    pub v_max: f64,
    /// Boundary handling: `map` or `particles`.
    pub boundary: String,
}

/// What was counted over a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Counters {
    /// Substeps done.
    pub substeps: u64,
    /// Times that substeps and iterations changed, as in a session that had to keep pace.
    #[serde(default)]
    pub solver_changes: u64,
    /// Times that the neighbour list was rebuilt.
    pub neighbour_rebuilds: u64,
    /// How often each limiter acted, by its name.
    pub limiters: BTreeMap<String, u64>,
}

/// The state at one moment of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Simulated time, s.
    pub t_s: f64,
    /// Mean over particles of max(0, ρ/ρ₀ − 1).
    pub density_error_mean: f64,
    /// 99th percentile of the same.
    pub density_error_p99: f64,
    /// Kinetic energy, J.
    pub kinetic_energy_j: f64,
    /// What is where, kg.
    pub mass_kg: MassByPlace,
    /// Rebuilds of the neighbour list since the start.
    pub neighbour_rebuilds: u64,
    /// By flask: mass that has left it so far, each particle once, kg.
    #[serde(default)]
    pub left_kg: BTreeMap<String, f64>,
    /// By flask: mass above its rim's plane, in no flask, that left it last, kg.
    #[serde(default)]
    pub above_rim_kg: BTreeMap<String, f64>,
    /// Temperature and composition, where heat is modelled.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat: Option<HeatSample>,
}

/// Temperature and composition at one moment. Means are by mass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeatSample {
    /// Mean temperature, °C.
    pub temperature_mean_c: f64,
    /// 99th percentile of the temperature over particles, °C.
    pub temperature_p99_c: f64,
    /// Highest temperature, °C.
    pub temperature_max_c: f64,
    /// Least and highest temperature in each flask that holds liquid, °C.
    pub temperatures_in_flasks_c: BTreeMap<String, [f64; 2]>,
    /// Mean acid mass fraction.
    pub acid_mean: f64,
    /// Least acid fraction.
    pub acid_min: f64,
    /// Largest acid fraction.
    pub acid_max: f64,
    /// Largest temperature above the boiling point, K (negative below it);
    /// where there is a boiling point.
    pub superheat_max_k: Option<f64>,
    /// Particles above it.
    pub boiling_particles: Option<u64>,
    /// Of these, the members of each flask.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub boiling_in_flasks: BTreeMap<String, u64>,
    /// Mass and energy; of the physical chemistry.
    pub ledger: Option<LedgerSample>,
}

/// Where the enthalpy is that there was at the start: initial + exchanged =
/// held + steam + kinetic. Relative to the pure liquids at 25 °C.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LedgerSample {
    /// Enthalpy at the start, J.
    pub initial_j: f64,
    /// Heat gained from around, J; negative where it was lost.
    pub exchanged_j: f64,
    /// Enthalpy of what is still there, J.
    pub held_j: f64,
    /// Enthalpy that steam took along, J.
    pub steam_j: f64,
    /// Enthalpy that was paid for motion, J.
    pub kinetic_j: f64,
    /// By how much the two sides differ, over the sum of |h| at the start.
    pub closure: f64,
    /// Water that left as steam, kg.
    pub steam_kg: f64,
    /// Mist that it is in the air over the liquid, kg.
    pub mist_kg: f64,
    /// Vapour that is still in the liquid, kg.
    pub vapour_kg: f64,
}

impl Report {
    /// The report without its time series, as `vitriol replay --json` prints
    /// it.
    #[must_use]
    pub fn without_series(&self) -> Self {
        Self {
            series: Vec::new(),
            ..self.clone()
        }
    }
}
