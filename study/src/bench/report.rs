//! Results of `vitriol bench`: the time of each pass and in total, with the density error of the run beside it: a time without its error
//! counts for nothing.

use serde::Serialize;
use vitriol_run::DeviceStatement;
use vitriol_run::passes::{PassRow, Timing};
use vitriol_run::units::{count, grouped, percent};

/// Results of `vitriol bench`.
#[derive(Debug, Clone, Serialize)]
pub struct Benchmark {
    /// The device.
    pub device: DeviceStatement,
    /// Frames measured in each row.
    pub frames: u32,
    /// One row for each scene.
    pub rows: Vec<Row>,
    /// Time over the number of particles, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scaling: Option<Scaling>,
    /// Cost of each feature of the scene, where it was asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub features: Vec<FeatureRow>,
    /// Times of the picture, where they were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pictures: Vec<RenderRow>,
}

/// The times of a picture of one scene at one size.
#[derive(Debug, Clone, Serialize)]
pub struct RenderRow {
    /// The scene.
    pub scene: String,
    /// Fluid particles.
    pub fluid_particles: u64,
    /// Views: one, or one for each eye.
    pub views: u32,
    /// Width of a view, pixels.
    pub width: u32,
    /// Height of a view, pixels.
    pub height: u32,
    /// Whether it is sharp only where a headset's lenses are.
    pub foveated: bool,
    /// Each pass, summed over a picture.
    pub passes: Vec<PassRow>,
    /// All passes of a picture by the device's clock, with timestamps around
    /// them.
    pub device_total: Timing,
    /// A frame's share of several that are queued one behind the other, each
    /// solved and drawn, without timestamps.
    pub frame: Timing,
    /// A frame's share, where a frame is solved on a second queue while the one before it is drawn, without timestamps.
    pub overlapped: Timing,
    /// A frame's share of several that are queued one behind the other, solved and not drawn, without timestamps.
    pub solver: Timing,
}

/// Cost of a feature: the scene with it less the scene without it.
#[derive(Debug, Clone, Serialize)]
pub struct FeatureRow {
    /// The feature.
    pub feature: String,
    /// Features that were off with it, since they are built upon it.
    pub also_off: Vec<String>,
    /// Median over several rounds of the difference of two frames' times, ms.
    pub cost_ms: f64,
    /// Least and greatest difference of the rounds, ms.
    pub range_ms: [f64; 2],
    /// Dispatches of a frame that the feature adds.
    pub dispatches: i64,
    /// Bytes of device memory for each particle that the feature adds.
    pub bytes_per_particle: i64,
}

/// One scene's times.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// The scene.
    pub scene: String,
    /// Fluid particles.
    pub fluid_particles: u64,
    /// Boundary particles; 0 where the boundary is not of particles.
    pub solid_particles: u64,
    /// Substeps in a frame.
    pub substeps: u32,
    /// Iterations in a substep.
    pub iterations: u32,
    /// Mean over particles of max(0, ρ/ρ₀ − 1) at the end of the run.
    pub density_error_mean: f64,
    /// 99th percentile over particles of max(0, ρ/ρ₀ − 1) at the end of the run.
    pub density_error_p99: f64,
    /// A frame's share of several that are queued one behind the other,
    /// measured without timestamps around their passes.
    pub total: Timing,
    /// Where the scene lets liquid sleep, steps in which it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asleep: Option<Asleep>,
    /// All passes of a frame by the device's clock, with timestamps around them.
    pub device_total: Timing,
    /// Recording and submitting a frame.
    pub cpu: Timing,
    /// Each pass, summed over a frame.
    pub passes: Vec<PassRow>,
    /// The paper's row, where Table 2 has one.
    pub paper: Option<PaperRow>,
    /// Other programs that ran in turn with it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub peers: Vec<PeerRow>,
}

/// Steps of a world whose liquid has come to rest and sleeps.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Asleep {
    /// A step's share of several that are queued one behind the other.
    pub step: Timing,
    /// Particles that do not sleep even so.
    pub awake: u32,
}

/// A column of the paper's Table 2 (its card, 3 substeps × 2 iterations),
/// without rendering.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PaperRow {
    /// Fluid particles.
    pub fluid_particles: u64,
    /// Solid particles.
    pub solid_particles: u64,
    /// "Solve fluid", ms.
    pub fluid_ms: f64,
    /// "Solve boiling", ms.
    pub boiling_ms: f64,
    /// "Solve flasks", ms.
    pub flasks_ms: f64,
}

/// Table 2 of the paper, by the names of the scenes here.
pub const TABLE_2: [(&str, PaperRow); 4] = [
    ("moving-flask", paper(10_925, 51_158, 3.014, 0.0, 0.027)),
    (
        "single-dilution",
        paper(13_894, 48_044, 2.667, 0.380, 0.024),
    ),
    (
        "triple-dilution",
        paper(39_888, 60_632, 6.973, 1.003, 0.058),
    ),
    ("tomato-soup", paper(14_880, 2_341, 2.58, 0.379, 0.025)),
];

const fn paper(fluid: u64, solid: u64, fluid_ms: f64, boiling_ms: f64, flasks_ms: f64) -> PaperRow {
    PaperRow {
        fluid_particles: fluid,
        solid_particles: solid,
        fluid_ms,
        boiling_ms,
        flasks_ms,
    }
}

/// A table for people.
pub fn describe(bench: &Benchmark) -> String {
    let mut text = format!(
        "{}, {}, {}\n",
        bench.device.name,
        bench.device.driver,
        count(bench.frames.into(), "frame")
    );
    for row in &bench.rows {
        text += &format!(
            "\n{}: {} fluid and {} boundary particles, {} × {}\n\
             density error: mean {}, 99th percentile {}\n\
             pass                          median ms    95 % ms dispatches         MB\n",
            row.scene,
            grouped(row.fluid_particles),
            grouped(row.solid_particles),
            row.substeps,
            row.iterations,
            percent(row.density_error_mean),
            percent(row.density_error_p99)
        );
        for pass in &row.passes {
            let Timing { median_ms, p95_ms } = pass.time;
            let (name, number, megabytes) = (&pass.name, pass.dispatches, pass.bytes as f64 * 1e-6);
            text += &format!(
                "{name:<28} {median_ms:>10.3} {p95_ms:>10.3} {number:>10} {megabytes:>10.2}\n"
            );
        }
        let whole = [
            ("all passes, timed", row.device_total),
            ("frame, queued, untimed", row.total),
            ("of it recording, submitting", row.cpu),
        ];
        for (name, Timing { median_ms, p95_ms }) in whole {
            text += &format!("{name:<28} {median_ms:>10.3} {p95_ms:>10.3}\n");
        }
        if let Some(Asleep { step, awake }) = row.asleep {
            let Timing { median_ms, p95_ms } = step;
            let awake = grouped(awake.into());
            text += &format!(
                "{:<28} {median_ms:>10.3} {p95_ms:>10.3}   ({awake} particles awake)\n",
                "step, queued, asleep"
            );
        }
        if let Some(paper) = &row.paper {
            text += &format!(
                "{:<28} {:>10.3}   (fluid {}, boiling {}, flasks {}; {} fluid and {} solid \
                 particles)\n",
                "the paper",
                paper.fluid_ms + paper.boiling_ms + paper.flasks_ms,
                paper.fluid_ms,
                paper.boiling_ms,
                paper.flasks_ms,
                grouped(paper.fluid_particles),
                grouped(paper.solid_particles)
            );
        }
        for peer in &row.peers {
            text.push_str(&peer.describe());
        }
    }
    if let Some(scaling) = &bench.scaling {
        text.push_str(&scaling.describe());
    }
    for row in &bench.pictures {
        describe_picture(row, &mut text);
    }
    if !bench.features.is_empty() {
        text.push_str(
            "\nfeature           cost ms              from to dispatches B a particle  off with it\n",
        );
    }
    for row in &bench.features {
        let range = format!("{:.3} {:.3}", row.range_ms[0], row.range_ms[1]);
        text += &format!(
            "{:<14} {:>10.3} {:>20} {:>10} {:>12}  {}\n",
            row.feature,
            row.cost_ms,
            range,
            row.dispatches,
            row.bytes_per_particle,
            row.also_off.join(", ")
        );
    }
    text
}

fn describe_picture(row: &RenderRow, text: &mut String) {
    *text += &format!(
        "\n{}: {} fluid particles, {} × {} × {}{}\n\
         pass                          median ms    95 % ms     number\n",
        row.scene,
        grouped(row.fluid_particles),
        row.views,
        row.width,
        row.height,
        if row.foveated { ", foveated" } else { "" }
    );
    let named = [
        ("picture, all passes, timed", row.device_total),
        ("frame: solved and drawn", row.frame),
        ("the same on two queues", row.overlapped),
        ("the same, not drawn", row.solver),
    ];
    for pass in &row.passes {
        let Timing { median_ms, p95_ms } = pass.time;
        let (name, number) = (&pass.name, pass.dispatches);
        *text += &format!("{name:<28} {median_ms:>10.4} {p95_ms:>10.4} {number:>10}\n");
    }
    for (name, Timing { median_ms, p95_ms }) in named {
        *text += &format!("{name:<28} {median_ms:>10.4} {p95_ms:>10.4}\n");
    }
}

/// A peer beside one of our rows: as many particles, substeps and iterations, and the same spacing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PeerRow {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// The device that it reports.
    pub device: String,
    /// A frame's share of several that are queued.
    pub total: Timing,
    /// The least and the greatest frame's share, ms.
    pub range_ms: [f64; 2],
    /// Mean over particles of max(0, ρ/ρ₀ − 1) at its last run's end.
    pub density_error_mean: f64,
    /// 99th percentile over particles of max(0, ρ/ρ₀ − 1) at its last run's end.
    pub density_error_p99: f64,
    /// Its median time over ours: above 1 where ours is faster.
    pub ratio: f64,
    /// Its median time over ours, for each round.
    pub ratios: Vec<f64>,
}

/// A frame's time over the number of particles.
#[derive(Debug, Clone, Serialize)]
pub struct Scaling {
    /// Substeps in a frame.
    pub substeps: u32,
    /// Iterations in a substep.
    pub iterations: u32,
    /// By ascending number of particles.
    pub rows: Vec<ScalingRow>,
    /// Rows that could not be measured.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub skipped: Vec<Skipped>,
    /// Path of the figure.
    pub figure: String,
}

/// A block at rest.
#[derive(Debug, Clone, Serialize)]
pub struct ScalingRow {
    /// Fluid particles.
    pub fluid_particles: u64,
    /// A frame's share of several that are queued.
    pub total: Timing,
    /// Median for a particle and an iteration, ns.
    pub particle_iteration_ns: f64,
    /// Mean over particles of max(0, ρ/ρ₀ − 1) at the end.
    pub density_error_mean: f64,
    /// 99th percentile over particles of max(0, ρ/ρ₀ − 1) at the end.
    pub density_error_p99: f64,
    /// Other programs that ran in turn with it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub peers: Vec<PeerRow>,
}

/// A row that does not fit the device's memory.
#[derive(Debug, Clone, Serialize)]
pub struct Skipped {
    /// Fluid particles.
    pub fluid_particles: u64,
    /// The device's error.
    pub reason: String,
}
