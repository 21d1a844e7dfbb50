//! `vitriol dam-break`: the collapse of a column of water against Martin and
//! Moyce's measurements of 1952.

use plotters::prelude::*;
use serde::{Deserialize, Serialize};
use vitriol_gpu::Gpu;
use vitriol_run::page::{AXIS, CURVE_COLOURS, GRID};
use vitriol_run::{Blame, DeviceStatement, Failure, Format, device, emit, output};
use vitriol_sim::scene::{Preset, Scene};

use crate::cli::DamBreakArgs;
use crate::column::{Column, Front};

/// The scene whose solver and liquid the column has: real size.
const SCENE: &str = "beaker";
/// Martin and Moyce's smaller base, 2.25 in, metres.
const BASE: f64 = 0.05715;
/// The figure's name in the folder.
const FIGURE: &str = "dam-break.svg";

/// Longest delay that is tried, hundredths of T.
const DELAYS: i32 = 50;

/// The measurements, with their source.
const MEASURED: &str = include_str!("martin_moyce_1952.json");

/// Contents of the data file.
#[derive(Debug, Deserialize)]
struct Measurements {
    columns: Vec<MeasuredColumn>,
}

/// One column of the measurements.
#[derive(Debug, Deserialize)]
struct MeasuredColumn {
    /// Height over base.
    n_squared: u32,
    /// (T, Z).
    points: Vec<(f64, f64)>,
}

/// Results of `vitriol dam-break`.
#[derive(Debug, Serialize)]
pub struct DamBreak {
    /// The device.
    device: DeviceStatement,
    /// The preset.
    preset: &'static str,
    /// Particle spacing, metres.
    spacing_m: f64,
    /// Substeps at 90 Hz, and iterations in each.
    substeps: u32,
    iterations: u32,
    /// Each column.
    columns: Vec<Comparison>,
    /// Path of the figure, if it was asked for.
    figure: Option<String>,
}

/// One column against its measurement.
#[derive(Debug, Serialize)]
pub struct Comparison {
    /// Height over base.
    pub n_squared: u32,
    /// Root mean square of Z − Z measured, at the measured times.
    pub rms_z: f64,
    /// Mean of Z − Z measured, at the measured times: positive where the simulated front leads.
    pub mean_z: f64,
    /// Delay of the column's release in T that gives the least `rms_z`: a gate takes time to leave.
    pub delay: f64,
    /// `rms_z` with that delay.
    pub delayed_rms_z: f64,
    /// (T, Z) simulated.
    pub simulated: Vec<(f64, f64)>,
    /// (T, Z) measured.
    pub measured: Vec<(f64, f64)>,
}

/// Runs `vitriol dam-break`.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] where the figure exists already;
/// [`Failure::Other`] where device or folder fails.
pub fn run(args: &DamBreakArgs, format: Format) -> Result<(), Failure> {
    let figure = output::new_files(args.out.as_deref(), [FIGURE])?;
    let gpu = device::open(args.device.as_deref())?;
    let scene = Scene::builtin(SCENE).input()?.with_preset(args.preset);
    let resolution = resolution(args.preset);
    let columns = compare(&gpu, &scene, resolution, Column::LAST_TIME)?;
    if let Some([path]) = &figure {
        let mut svg = String::new();
        draw(&mut svg, &columns).other()?;
        output::write_new(path, svg.as_bytes())?;
    }
    let result = DamBreak {
        device: device::statement(&gpu),
        preset: args.preset.name(),
        spacing_m: BASE / f64::from(resolution),
        substeps: scene.solver.substeps,
        iterations: scene.solver.iterations,
        columns,
        figure: figure.map(|[path]| path.display().to_string()),
    };
    emit(format, &result, describe)
}

/// Particle spacings in a base: 8,192, 27,648 and 65,536 particles in the
/// square column, twice as many in the high one.
fn resolution(preset: Preset) -> u32 {
    match preset {
        Preset::Fast => 8,
        Preset::Balanced => 12,
        Preset::Reference => 16,
    }
}

/// Lets each measured column collapse, at `resolution` spacings a base, up to
/// T = `last`, and compares the fronts.
///
/// # Errors
/// The error of the device or of a shader.
pub fn compare(
    gpu: &Gpu,
    scene: &Scene,
    resolution: u32,
    last: f64,
) -> Result<Vec<Comparison>, Failure> {
    let known: Measurements = serde_json::from_str(MEASURED).other()?;
    let compared = known.columns.into_iter().map(|measured| {
        let column = Column {
            base: BASE,
            n_squared: measured.n_squared,
            resolution,
        };
        let fronts = column.collapse(gpu, scene, last)?;
        Ok(Comparison::new(measured, &fronts))
    });
    compared.collect()
}

impl Comparison {
    fn new(mut measured: MeasuredColumn, fronts: &[Front]) -> Self {
        let last = fronts.last().map_or(0.0, |front| front.time);
        measured.points.retain(|(time, _)| *time <= last);
        let off = |delay: f64| {
            let points = measured.points.iter();
            points.map(move |&(time, distance)| at(fronts, time - delay) - distance)
        };
        let count = measured.points.len().max(1) as f64;
        let rms = |delay| (off(delay).map(|z| z * z).sum::<f64>() / count).sqrt();
        let delays = (-DELAYS..=DELAYS).map(|hundredths| 0.01 * f64::from(hundredths));
        let best = delays.min_by(|a, b| rms(*a).total_cmp(&rms(*b)));
        let delay = best.unwrap_or(0.0);
        Self {
            n_squared: measured.n_squared,
            rms_z: rms(0.0),
            mean_z: off(0.0).sum::<f64>() / count,
            delay,
            delayed_rms_z: rms(delay),
            simulated: fronts.iter().map(|f| (f.time, f.distance)).collect(),
            measured: measured.points,
        }
    }
}

/// Z at a time, between two frames.
fn at(fronts: &[Front], time: f64) -> f64 {
    let later = fronts.partition_point(|front| front.time < time);
    match (fronts.get(later.saturating_sub(1)), fronts.get(later)) {
        (Some(before), Some(after)) if after.time > before.time => {
            let way = (time - before.time) / (after.time - before.time);
            before.distance + way * (after.distance - before.distance)
        }
        (Some(front), _) | (None, Some(front)) => front.distance,
        (None, None) => f64::NAN,
    }
}

fn draw(
    svg: &mut String,
    columns: &[Comparison],
) -> Result<(), DrawingAreaErrorKind<std::io::Error>> {
    let all = || {
        columns
            .iter()
            .flat_map(|c| c.simulated.iter().chain(&c.measured))
    };
    let end = all().map(|point| point.0).fold(1.0, f64::max);
    let top = all().map(|point| point.1).fold(1.0, f64::max);
    let area = SVGBackend::with_string(svg, (720, 460)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .margin(12)
        .x_label_area_size(46)
        .y_label_area_size(52)
        .build_cartesian_2d(0.0..end, 1.0..top * 1.03)?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .label_style(("sans-serif", 16))
        .axis_desc_style(("sans-serif", 17))
        .x_desc("T = t √(n² g / a)")
        .y_desc("Z = z / a")
        .draw()?;
    for (index, column) in columns.iter().enumerate() {
        let colour = CURVE_COLOURS[index % CURVE_COLOURS.len()];
        let points = column.simulated.iter().copied();
        chart
            .draw_series(LineSeries::new(points, colour.stroke_width(2)))?
            .label(format!("n² = {}, simulated", column.n_squared))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(2)));
        let dots = column.measured.iter();
        chart
            .draw_series(dots.map(|&point| Circle::new(point, 4, colour.stroke_width(1))))?
            .label(format!("n² = {}, Martin & Moyce", column.n_squared))
            .legend(move |(x, y)| Circle::new((x + 11, y), 4, colour.stroke_width(1)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .label_font(("sans-serif", 16))
        .border_style(AXIS)
        .background_style(WHITE)
        .draw()?;
    drop(chart);
    area.present()
}

fn describe(result: &DamBreak) -> String {
    let mut lines: Vec<String> = result
        .columns
        .iter()
        .map(|column| {
            format!(
                "n² = {}: Z is off by {:.3} (rms), {:+.3} in the mean, over {} measured times; \
                 {:.3} with a delay of {:.2} in T",
                column.n_squared,
                column.rms_z,
                column.mean_z,
                column.measured.len(),
                column.delayed_rms_z,
                column.delay
            )
        })
        .collect();
    lines.extend(result.figure.iter().map(|path| format!("figure  {path}")));
    lines.join("\n")
}
