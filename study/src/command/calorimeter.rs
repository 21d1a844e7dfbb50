//! `vitriol calorimeter`: two liquids mixed in a closed, insulated vessel.

use std::time::Instant;

use serde::Serialize;
use vitriol_run::units::{count, three_digits};
use vitriol_run::{Blame, DeviceStatement, Failure, Format, device, emit};
use vitriol_sim::chemistry::table::SolutionTable;
use vitriol_sim::scene::Preset;

use crate::calorimeter::{self, EVEN, Feed, Resolution};
use crate::cli::{CalorimeterArgs, OrderName};

/// Range of the volume of both liquids together, mL: from a vessel of a millimetre, in which single precision still tells positions apart,
/// to one of ten metres.
const VOLUMES_ML: [f64; 2] = [1e-3, 1e9];

/// Results of `vitriol calorimeter`.
#[derive(Debug, Serialize)]
pub struct Calorimeter {
    /// Mean temperature at the end, °C.
    pub final_c: f64,
    /// Acid in the liquid at the end, per cent by mass.
    pub mass_percent: f64,
    /// Water that is vapour at the end, g.
    pub evaporated_g: f64,
    /// Simulated time until temperature and composition were even, s; none
    /// where they were not.
    pub time_to_even_s: Option<f64>,
    /// Largest temperature of a particle above its boiling point at any time, K.
    pub peak_superheat_k: f64,
    /// Largest change of the mass, relative.
    pub mass_drift: f64,
    /// Largest change of the acid's mass, relative.
    pub acid_drift: f64,
    /// Largest change of the enthalpy, over the initial sum of |h|.
    pub enthalpy_drift: f64,
    /// Standard deviation of the temperature at the end, K.
    pub spread_k: f64,
    /// Standard deviation of the acid mass fraction at the end, per cent.
    pub spread_percent: f64,
    /// Mass of liquid and vapour, g.
    pub mass_g: f64,
    /// Relative error of the ratio of the two liquids, since particles are whole.
    pub ratio_error: f64,
    /// Particles.
    pub particles: u32,
    /// Particle spacing, m.
    pub spacing_m: f64,
    /// Particles that left the vessel or were taken out.
    pub lost_particles: u64,
    /// Number of times that a particle's diffusion was limited in a substep.
    pub diffusion_limited: u32,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Wall time, s, without opening the device.
    pub wall_s: f64,
    /// Preset.
    pub preset: &'static str,
    /// Order of filling: which liquid was below.
    pub order: OrderName,
    /// Seed.
    pub seed: u64,
    /// The device.
    pub device: DeviceStatement,
}

/// Runs `vitriol calorimeter`.
///
/// # Errors
/// [`Failure::Input`] for impossible amounts, [`Failure::NoDevice`], [`Failure::Other`].
pub fn run(args: &CalorimeterArgs, format: Format) -> Result<(), Failure> {
    let feeds = feeds(args)?;
    let gpu = device::open(args.device.as_deref())?;
    let begin = Instant::now();
    let mixed = calorimeter::mix(&gpu, feeds, resolution(args.preset), args.seed)?;
    let wall_s = begin.elapsed().as_secs_f64();
    let end = mixed.end.ledger.unwrap_or_default();
    let table = SolutionTable::new();
    let mass_of = |feed: &Feed| feed.volume * table.at(feed.acid).density_at(feed.temperature);
    // The particles' shares are of the poured mass, which they have but for rounding to whole particles.
    let mass_g = 1e3 * feeds.iter().map(mass_of).sum::<f64>();
    let [mass_drift, acid_drift, enthalpy_drift] = mixed.drifts;
    let result = Calorimeter {
        final_c: mixed.end.temperature_mean,
        mass_percent: 100.0 * end.acid / (end.mass - end.vapour),
        evaporated_g: mass_g * end.vapour / end.mass,
        time_to_even_s: mixed.even.then_some(mixed.seconds),
        peak_superheat_k: mixed.peak_superheat,
        mass_drift,
        acid_drift,
        enthalpy_drift,
        spread_k: mixed.end.temperature_spread,
        spread_percent: 100.0 * mixed.end.acid_spread,
        mass_g,
        ratio_error: mixed.ratio_error,
        particles: mixed.particles,
        spacing_m: mixed.spacing,
        lost_particles: mixed.lost,
        diffusion_limited: mixed.counters.diffusion_limited,
        simulated_s: mixed.seconds,
        wall_s,
        preset: args.preset.name(),
        order: args.order,
        seed: args.seed,
        device: device::statement(&gpu),
    };
    emit(format, &result, describe)
}

/// Number of particles and iterations of a preset.
pub fn resolution(preset: Preset) -> Resolution {
    let (particles, iterations) = match preset {
        Preset::Fast => (1_000, 2),
        Preset::Balanced => (2_500, 3),
        Preset::Reference => (6_000, 4),
    };
    Resolution {
        particles,
        iterations,
    }
}

/// The two liquids, the lower one first.
///
/// # Errors
/// [`Failure::Input`] with the option that is wrong.
pub fn feeds(args: &CalorimeterArgs) -> Result<[Feed; 2], Failure> {
    let refuse = |message: String| Err(message).input();
    for (option, value) in [("--water-ml", args.water_ml), ("--acid-ml", args.acid_ml)] {
        if !(value.is_finite() && value >= 0.0) {
            return refuse(format!("{option} {value}: give millilitres, zero or more"));
        }
    }
    let [least, most] = VOLUMES_ML;
    let total = args.water_ml + args.acid_ml;
    if !(least..=most).contains(&total) {
        return refuse(format!(
            "--water-ml {} --acid-ml {}: {total} mL in all is not between {least} and {most}; \
             take another amount, the temperature hardly depends on it",
            args.water_ml, args.acid_ml
        ));
    }
    let percent = args.acid_percent;
    if !(0.0..=100.0).contains(&percent) {
        return refuse(format!(
            "--acid-percent {percent}: give per cent of acid by mass, 0 to 100"
        ));
    }
    let table = SolutionTable::new();
    let acid = percent / 100.0;
    for (option, value, acid) in [
        ("--water-c", args.water_c, 0.0),
        ("--acid-c", args.acid_c, acid),
    ] {
        let boils = table.at(acid).boiling_point;
        if !(0.0..=boils).contains(&value) {
            return refuse(format!(
                "{option} {value}: a liquid of {:.0} % acid is taken between 0 and its boiling \
                 point, {boils:.0} °C",
                100.0 * acid
            ));
        }
    }
    let water = Feed {
        volume: 1e-6 * args.water_ml,
        temperature: args.water_c,
        acid: 0.0,
    };
    let acid = Feed {
        volume: 1e-6 * args.acid_ml,
        temperature: args.acid_c,
        acid,
    };
    Ok(match args.order {
        OrderName::WaterFirst => [water, acid],
        OrderName::AcidFirst => [acid, water],
    })
}

fn describe(result: &Calorimeter) -> String {
    let even = match result.time_to_even_s {
        Some(seconds) => format!(
            "even after {} s: temperature within {} K, acid within {} % (standard deviations)",
            three_digits(seconds),
            EVEN[0],
            100.0 * EVEN[1]
        ),
        None => format!(
            "NOT EVEN after {} s: temperature within {} K, acid within {} % (standard \
             deviations); figures are means, take another preset or amounts less unlike",
            three_digits(result.simulated_s),
            three_digits(result.spread_k),
            three_digits(result.spread_percent)
        ),
    };
    let mut lines = vec![
        format!(
            "{:.1} °C, {:.1} % acid by mass, {:.2} g evaporated of {} g",
            result.final_c,
            result.mass_percent,
            result.evaporated_g,
            three_digits(result.mass_g)
        ),
        even,
        format!("peak superheat {:.1} K", result.peak_superheat_k),
        format!(
            "drift: mass {:.1e}, acid {:.1e}, enthalpy {:.1e}",
            result.mass_drift, result.acid_drift, result.enthalpy_drift
        ),
        format!(
            "{} of {} mm, {} s simulated in {} s on {}",
            count(result.particles.into(), "particle"),
            three_digits(1e3 * result.spacing_m),
            three_digits(result.simulated_s),
            three_digits(result.wall_s),
            result.device.name
        ),
    ];
    if result.ratio_error > 0.003 {
        lines.push(format!(
            "whole particles make the ratio of the two {:.1} % wrong: take a preset with more",
            100.0 * result.ratio_error
        ));
    }
    if result.lost_particles > 0 {
        lines.push(format!(
            "lost: {}",
            count(result.lost_particles, "particle")
        ));
    }
    lines.join("\n")
}
