//! Water poured into acid: chaotic, so seeds are compared by medians and quartiles, never by trajectories.

use serde::{Deserialize, Serialize};
use vitriol_gpu::Gpu;
use vitriol_run::{Blame, Failure, stage};
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{StepInput, World};
use vitriol_xr::PoseSource;
use vitriol_xr::track::{Track, TrackSource};

use super::tank::Cost;
use crate::merge::{number, numbers};

/// Observations per second.
const LOOKS: f64 = 10.0;
/// Share of particles above their boiling point from which on it boils.
const BOILS: f64 = 1e-3;

/// Result of one seed.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Boiled {
    /// Highest superheat of any particle, K.
    #[serde(deserialize_with = "number")]
    pub superheat: f64,
    /// Time from which a thousandth of the liquid was above its boiling point, s; `None` where it never was.
    pub onset: Option<f64>,
    /// Mass outside of the flasks at the end, g: particles, and drops that came to rest outside of the flask that they came from.
    pub thrown: f64,
    /// Mass that left as steam, g.
    pub steam: f64,
    /// What of it had left by the first look after the end of each second, g: 0.1 s later at most.
    #[serde(default)]
    pub steam_by_second: Vec<f64>,
    /// Mean temperature at the end, °C.
    #[serde(deserialize_with = "number")]
    pub temperature: f64,
    /// Largest relative error of the enthalpy's ledger.
    pub closure: f64,
}

/// First quartile, median, third quartile.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Quartiles(#[serde(deserialize_with = "numbers")] pub [f64; 3]);

/// Results of several seeds.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Seeds {
    /// Name of the run.
    pub name: String,
    /// Each seed.
    pub seeds: Vec<Boiled>,
    /// Peak superheat, K.
    pub superheat: Quartiles,
    /// Onset, s.
    pub onset: Quartiles,
    /// Mass thrown, g.
    pub thrown: Quartiles,
    /// Mass that left as steam, g.
    pub steam: Quartiles,
    /// Mean temperature at the end, °C.
    pub temperature: Quartiles,
}

/// Quartiles by linear interpolation between ranks; NaN of none.
pub fn quartiles(values: &[f64]) -> Quartiles {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let place = share * sorted.len().saturating_sub(1) as f64;
        let low = place.floor() as usize;
        let value = |index: usize| sorted.get(index).copied();
        match (value(low), value(low + 1)) {
            (Some(a), Some(b)) => a + (place - low as f64) * (b - a),
            (Some(a), None) => a,
            _ => f64::NAN,
        }
    };
    Quartiles([at(0.25), at(0.5), at(0.75)])
}

impl Seeds {
    /// Sums up the seeds' figures.
    pub fn of(name: String, seeds: Vec<Boiled>) -> Self {
        let by =
            |value: fn(&Boiled) -> f64| quartiles(&seeds.iter().map(value).collect::<Vec<_>>());
        let onsets: Vec<f64> = seeds.iter().filter_map(|boiled| boiled.onset).collect();
        Self {
            superheat: by(|b| b.superheat),
            onset: quartiles(&onsets),
            thrown: by(|b| b.thrown),
            steam: by(|b| b.steam),
            temperature: by(|b| b.temperature),
            name,
            seeds,
        }
    }
}

/// Pours by `track` in `scene`, simulated by `shaders`, for `seconds`; also the times of its frames.
///
/// # Errors
/// The error of device or track.
pub fn boil(
    gpu: &Gpu,
    (scene, shaders): (&Scene, &Library),
    track: &Track,
    seconds: f64,
    seed: u64,
) -> Result<(Boiled, Cost), Failure> {
    let mut world = World::new(gpu, shaders, scene, seed).other()?;
    let mut source = TrackSource::new(track.clone());
    let dt = scene.scale.frame_time;
    let steps = (seconds / dt).ceil() as u64;
    let between = (1.0 / LOOKS / dt).round().max(1.0) as u64;
    let mut boiled = Boiled {
        superheat: f64::NEG_INFINITY,
        temperature: f64::NAN,
        ..Boiled::default()
    };
    let mut start = None;
    let mut held = None;
    let mut times = Vec::new();
    for step in 0..steps {
        if let Some(frame) = source.next(step, step as f64 * dt).other()? {
            held = Some(frame);
        }
        let Some(frame) = &held else {
            return Err("the track has no pose at its start; record it again").input();
        };
        let hands = stage::input(frame, scene).hands;
        let begin = std::time::Instant::now();
        world.step(&StepInput::of_hands(hands)).other()?;
        if let Some(ticket) = world.last_step() {
            ticket.wait().other()?;
        }
        times.push(begin.elapsed().as_secs_f64() * 1e3);
        if !step.is_multiple_of(between) && step + 1 < steps {
            continue;
        }
        let measured = world.measure().other()?;
        let liquid = measured.on_table + measured.on_floor + measured.in_air;
        boiled.thrown = 1e3 * (liquid + measured.spray_left);
        let Some(heat) = measured.heat else { continue };
        boiled.temperature = heat.temperature_mean;
        if let Some(superheat) = &heat.superheat {
            boiled.superheat = boiled.superheat.max(superheat.max);
            let share = superheat.particles as f64 / f64::from(world.solver().count());
            if share > BOILS && boiled.onset.is_none() {
                boiled.onset = Some(step as f64 * dt);
            }
        }
        if let Some(ledger) = &heat.ledger {
            let start = start.get_or_insert(*ledger);
            boiled.steam = 1e3 * ledger.steam;
            let whole = ((step + 1) as f64 * dt + 1e-9) as usize;
            boiled.steam_by_second.resize(whole, boiled.steam);
            boiled.closure = boiled.closure.max(ledger.closure(start).abs());
        }
    }
    let warm = times.len() / 10;
    Ok((boiled, Cost::of(&times[warm..])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_of_a_row_of_numbers() {
        let Quartiles(found) = quartiles(&[5.0, 1.0, 2.0, 4.0, 3.0]);
        assert_eq!(found, [2.0, 3.0, 4.0]);
        assert!(quartiles(&[]).0[1].is_nan());
    }
}
