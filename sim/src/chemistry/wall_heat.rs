//! The heat of a flask's glass: rings of its wall, each of one temperature.
//!
//! A 400 mL beaker holds 112 J/K against 630 J/K of 200 mL of acid and water,
//! and warms within seconds: the liquid's heat loss to the air goes through it.

use super::constants::WATER_MOLAR_MASS;
use super::transport::Losses;
use crate::flask::Profile;
use crate::flask::glassware::BOROSILICATE;
use std::f64::consts::PI;

/// Rings of equal height from the inner floor up to the rim; the lowest has the base.
pub const RINGS: usize = 32;

/// Specific heat capacity of borosilicate glass 3.3, J/(kg K) (Schott: 830
/// from 20 to 100 °C).
pub const CAPACITY: f64 = 830.0;

/// Its thermal conductivity at 90 °C, W/(m K) (ISO 3585).
pub const CONDUCTIVITY: f64 = 1.2;

/// Heat transfer between liquid and glass, W/(m² K): natural convection of
/// water at 80 °C with 10 K between the two, Nu = 0.1 Ra^⅓ (Incropera, Eq.
/// 9.24). Stirred it is three times that; then half a wall resists as much.
pub const FILM: f64 = 700.0;

/// Greatest difference of temperature between liquid and glass for which the
/// device's integer sums have room, K.
const WIDEST: f64 = 2000.0;

/// Slices of a ring by which it is measured.
const SLICES: u32 = 16;

/// One ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Heat capacity, J/K.
    pub capacity: f64,
    /// Heat that the air takes, W/K.
    pub to_air: f64,
    /// Heat that is conducted to the next ring above, W/K; 0 at the rim.
    pub upwards: f64,
    /// Heat that the liquid takes per area of contact, W/(m² K).
    pub to_liquid: f64,
    /// Least heat that the device counts, J.
    pub quantum: f64,
    /// Heat that a plate gives it, W.
    pub heated: f64,
}

/// Index of the ring that the glass at the height `y` (flask's frame, m) belongs to.
pub fn ring_at(profile: &Profile, y: f64) -> usize {
    let (floor, rim) = (profile.floor_height(), profile.rim_height());
    let place = (y - floor) / (rim - floor) * RINGS as f64;
    place.clamp(0.0, (RINGS - 1) as f64) as usize
}

/// Heat transfer from a wall to water that boils at one atmosphere, W/(m² K), by the flux (W/m²) that passes it
/// (Cooper 1984: 55 p^0.12 (−log₁₀ p)^−0.55 M^−½ q^0.67, at 0.0046 of the critical pressure, with a roughness of 1 µm).
fn nucleate_boiling(flux: f64) -> f64 {
    let pressure: f64 = 101_325.0 / 22.064e6;
    let molar = (1e3 * WATER_MOLAR_MASS).powf(-0.5);
    55.0 * pressure.powf(0.12) * (-pressure.log10()).powf(-0.55) * molar * flux.powf(0.67)
}

/// The rings of a flask in air, for steps of `time` seconds, whose base a plate gives `heater` watts.
///
/// Half the wall and the liquid's film lie between the two temperatures; over a plate the film is that of water which
/// boils. A wall that is thinner than a step can follow takes up at most what brings
/// it to the liquid's temperature.
pub fn rings(profile: &Profile, losses: &Losses, heater: f64, time: f64) -> Vec<Ring> {
    let (floor, rim) = (profile.floor_height(), profile.rim_height());
    let height = (rim - floor) / RINGS as f64;
    let areal = BOROSILICATE * CAPACITY * profile.wall();
    let share = |film: f64| {
        let transfer = 1.0 / (1.0 / film + 0.5 * profile.wall() / CONDUCTIVITY);
        -(-transfer * time / areal).exp_m1()
    };
    let base = PI * profile.inner_radius(floor).powi(2);
    let boiling = nucleate_boiling(heater / base).max(FILM);
    let ring = |k: usize| {
        let low = floor + k as f64 * height;
        let (mut volume, mut outside) = measured(profile, low, low + height);
        if k == 0 {
            let (base, edge) = measured(profile, 0.0, floor);
            volume += base;
            outside += edge + PI * profile.outer_radius_at(0.0).powi(2);
        }
        let conducted = CONDUCTIVITY * section(profile, low + height) / height;
        let capacity = BOROSILICATE * CAPACITY * volume;
        let most = 0.2 * capacity / time;
        let share = share(if k == 0 { boiling } else { FILM });
        Ring {
            capacity,
            to_air: (losses.glass * outside).min(most),
            upwards: if k + 1 < RINGS {
                conducted.min(most)
            } else {
                0.0
            },
            to_liquid: share * areal / time,
            heated: if k == 0 { heater } else { 0.0 },
            quantum: capacity * 4.0 * share * WIDEST / f64::from(i32::MAX),
        }
    };
    (0..RINGS).map(ring).collect()
}

/// Area of the glass in a level plane, m².
fn section(profile: &Profile, y: f64) -> f64 {
    let [inner, outer] = [profile.inner_radius(y), profile.outer_radius_at(y)];
    PI * (outer * outer - inner * inner).max(0.0)
}

/// Volume of the glass (m³) and area of its outside (m²) between two heights.
fn measured(profile: &Profile, low: f64, high: f64) -> (f64, f64) {
    let step = (high - low) / f64::from(SLICES);
    let middles = (0..SLICES).map(|i| low + (f64::from(i) + 0.5) * step);
    middles.fold((0.0, 0.0), |(volume, outside), y| {
        let edge = 2.0 * PI * profile.outer_radius_at(y) * step;
        (volume + section(profile, y) * step, outside + edge)
    })
}

/// Temperatures of `rings` (°C) after `time` seconds in which the liquid gave each `taken` joules.
pub fn advance(rings: &[Ring], temperatures: &mut [f64], taken: &[f64], ambient: f64, time: f64) {
    let old = temperatures.to_vec();
    let between = |k: usize| rings[k].upwards * (old[k + 1] - old[k]);
    for (k, ring) in rings.iter().enumerate() {
        let above = if k + 1 < rings.len() { between(k) } else { 0.0 };
        let below = if k > 0 { between(k - 1) } else { 0.0 };
        let power = above - below + ring.to_air * (ambient - old[k]) + ring.heated;
        temperatures[k] += (taken[k] + time * power) / ring.capacity;
    }
}
