//! What a report holds. Field names are the keys of `report.json`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vitriol_lesson::procedure::Verdict;
use vitriol_lesson::{Attempt, Boiling, Rubric, Score, Texts};
use vitriol_run::{Counters, Cut, DeviceStatement, MassByPlace, Sample, in_a_line};
use vitriol_sim::scene::Scene;

/// How a run stands to the recording that it replays.
#[derive(Debug, Clone, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct RecordingStatement {
    /// Version of the program that recorded.
    pub program_version: String,
    /// The device that it ran on; `None` in recordings of older versions.
    pub device: Option<String>,
    /// Its driver and version.
    pub driver: Option<String>,
    /// Hash of its final state, hexadecimal; `None` where its recorder stopped hard.
    pub state_hash: Option<String>,
    /// Whether the run ended in that state, to the bit.
    pub same_state: Option<bool>,
    /// Whether the run found what the session did, to the bit; `None` of a recording that says nothing of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub same_events: Option<bool>,
    /// Whether the lesson that is judged came to the same, to the bit; `None` of a recording that does not go through it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub same_progress: Option<bool>,
    /// In what the run is known to differ; its bits may differ then.
    pub differs: Vec<String>,
}

impl RecordingStatement {
    /// In a sentence or two.
    pub fn text(&self) -> String {
        let state = match self.same_state {
            Some(true) => "the final state is the recorded one, to the bit",
            Some(false) => "the final state is not the recorded one",
            None => "the final state was not recorded",
        };
        let device = self
            .device
            .as_deref()
            .unwrap_or("a device that is not known");
        let mut text = format!(
            "recorded by version {} on {}: {state}",
            in_a_line(&self.program_version),
            in_a_line(device)
        );
        text += match self.same_events {
            Some(true) => ", and so is all that happened",
            Some(false) => "; what happened is not what was recorded",
            None => "",
        };
        text += match self.same_progress {
            Some(true) => "; the lesson came to the same",
            Some(false) => "; the lesson did not come to what was recorded",
            None => "",
        };
        if !self.differs.is_empty() {
            text += &format!("\nbits may differ: {}", self.differs.join("; "));
        }
        text
    }
}

/// The report of one run. SI units throughout.
#[derive(Debug, Clone, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Report {
    /// Version of this layout: a reader of version 1 reads all that say 1.
    #[serde(default = "first_layout")]
    pub layout: u32,
    /// Program and version, such as `vitriol 0.1.0`.
    pub program: String,
    /// The command line that makes this run again.
    pub command: String,
    /// The track: a built-in name or a file's path.
    pub track: String,
    /// What was asked for beside it; `None` in reports of older versions.
    #[serde(default)]
    pub asked: Option<AskedStatement>,
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
    /// How violently it boiled, in figures that do not grow with its length; of the scene that `series` is of. Absent where nothing
    /// was to be said, and in reports of older versions.
    #[serde(default, skip_serializing_if = "Boiling::is_empty")]
    pub boiling: Boiling,
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
    /// How it stands to the recording, where the track is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recording: Option<RecordingStatement>,
    /// What was counted.
    pub counters: Counters,
    /// Scenes that the run brought up before the one that `series` is of.
    #[serde(default)]
    pub scenes_before: u32,
    /// What its student did, by attempt. Empty where nobody looked for it, and in reports of older versions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attempts: Vec<Attempt>,
    /// What an instructor did while it was recorded.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub instructor: Vec<InstructorStatement>,
    /// The score of each of `attempts`, in their order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub score: Vec<Score>,
    /// What the lesson came to each time that it was begun, where one is judged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lesson: Vec<Verdict>,
    /// The run over time. Empty in what `vitriol replay --json` prints, whole
    /// in `report.json`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub series: Vec<Sample>,
}

/// Something that an instructor did.
#[derive(Debug, Clone, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct InstructorStatement {
    /// When, simulated time of the run, s.
    pub t_s: f64,
    /// What, in a sentence.
    pub text: String,
}

/// What of a run was asked for, and not taken from the track.
#[derive(Debug, Clone, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct AskedStatement {
    /// A scene, by name or file.
    pub scene: Option<String>,
    /// Substeps and iterations.
    pub solver: Option<[u32; 2]>,
    /// Simulated time, s.
    pub seconds: Option<f64>,
    /// Glass that breaks.
    #[serde(default)]
    pub breakable: bool,
    /// What is whole of a track.
    pub accept_truncated: bool,
}

/// The version of [`Report`]'s layout that is written. It goes up where a field goes, or means something else; a field that
/// comes changes nothing for who reads the others.
pub const LAYOUT: u32 = 1;

/// That of reports that name none.
fn first_layout() -> u32 {
    1
}

/// The film of a run.
#[derive(Debug, Clone, PartialEq, JsonSchema, Serialize, Deserialize)]
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
    /// Where it goes on at another simulated time, since idle moments are left out; the first one is its begin. Empty in reports of
    /// older versions, whose films leave nothing out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub cuts: Vec<Cut>,
    /// A picture of its most violent moment, relative to the report's folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poster: Option<String>,
}

/// What every scene states of its scale, and what it models.
#[derive(Debug, Clone, PartialEq, JsonSchema, Serialize, Deserialize)]
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
    /// What is modelled beyond incompressible flow, such as `tension`.
    pub models: Vec<String>,
}

impl SceneStatement {
    /// That of a scene and what it models; `name` is how it was asked for.
    pub fn of(name: &str, scene: &Scene) -> Self {
        Self {
            name: name.to_owned(),
            d_m: scene.scale.spacing,
            h_over_d: scene.scale.support_ratio,
            frame_time_s: scene.scale.frame_time,
            gravity_m_s2: scene.scale.gravity,
            length_scale: scene.scale.length_scale,
            models: scene.model.iter().map(|feature| feature.name()).collect(),
        }
    }
}

/// The solver's settings in this run.
#[derive(Debug, Clone, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct SolverStatement {
    /// Substeps in a frame.
    pub substeps: u32,
    /// Solver iterations in a substep.
    pub iterations: u32,
    /// Relaxation: `jacobi` or `chebyshev`.
    pub relaxation: String,
    /// Relaxation factor ω.
    pub omega: f64,
    /// Rate at which the carried multipliers follow, 1/s; 0 where none are carried.
    pub carry_rate: f64,
    /// Speed at which particles are cut, the scene's unit per second.
    pub v_max: f64,
    /// Boundary handling: `map` or `particles`.
    pub boundary: String,
}

impl SolverStatement {
    /// The solver's settings in a scene, as its preset left them.
    pub fn of(scene: &Scene) -> Self {
        Self {
            substeps: scene.solver.substeps,
            iterations: scene.solver.iterations,
            relaxation: format!("{:?}", scene.solver.relaxation).to_lowercase(),
            omega: scene.solver.omega,
            carry_rate: scene.solver.carry_rate,
            v_max: scene.solver.v_max,
            boundary: format!("{:?}", scene.solver.boundary).to_lowercase(),
        }
    }
}

impl Report {
    /// JSON schema of the layout that is written.
    pub fn schema() -> serde_json::Value {
        let mut schema = schemars::schema_for!(Self).to_value();
        schema["$id"] = format!("vitriol-report-{LAYOUT}").into();
        schema["properties"]["layout"]["const"] = LAYOUT.into();
        if let Some(required) = schema["required"].as_array_mut() {
            required.push("layout".into());
        }
        schema
    }

    /// Scores its attempts.
    pub fn judge(&mut self, rubric: &Rubric, texts: &Texts) {
        let attempts = self.attempts.iter();
        self.score = attempts.map(|it| Score::of(it, rubric, texts)).collect();
    }

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
