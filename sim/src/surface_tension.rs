//! Surface tension and wetting (line 28), as the energy of `shaders/wgsl/common/liquid/surface_energy.wgsl`: constants and functions
//! that both solvers share.

use std::f64::consts::{PI, TAU};

/// Surface tension of water at 20 °C, N/m (IAPWS R1-76, 2014).
pub const WATER: f64 = 0.072_75;

/// |∇c| below which a gradient has no direction, over one per node: a lone particle has 0.02.
pub(crate) const FAINTEST: f64 = 0.002;

/// Least share of a node that is not solid, as far as it is divided by.
pub(crate) const LEAST_SPACE: f64 = 0.05;

/// Where a cell's core is looked for up the gradient: nodes between one place and the next, and how many.
pub(crate) const CORE_STRIDE: f64 = 1.05;
pub(crate) const CORE_STEPS: u32 = 4;

/// Colour up to which a core is one of a sheet, and from which it is taken to be full.
const CORE_THIN: f64 = 0.75;
const CORE_THICK: f64 = 0.85;

/// Core's colour from which F is that of a thick liquid.
const THICK_PULL: f64 = 0.9;

/// Least colour of a core: a lone particle's is 0.15.
const LEAST_CORE: f64 = 0.25;

/// Core by which colours are divided, for the fullest colour that was found up the gradient.
pub(crate) fn core_for(fullest: f64) -> f64 {
    let t = ((fullest - CORE_THIN) / (CORE_THICK - CORE_THIN)).clamp(0.0, 1.0);
    let thick = t * t * (3.0 - 2.0 * t);
    (fullest + thick * (1.0 - fullest)).max(LEAST_CORE)
}

/// How much of F is that of a thick liquid, for a core's colour.
pub(crate) fn thickness_for(core: f64) -> f64 {
    let t = ((core - CORE_THIN) / (THICK_PULL - CORE_THIN)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Neighbours below which a particle has no surface to speak of.
pub(crate) const FEWEST: usize = 1;

/// How far from a mouth, in nodes, liquid is in the grids on both of its sides.
pub(crate) const MOUTH_REACH: f64 = 4.0;

/// Longest time between two impulses of surface tension, over √(ρd³/(2πσ)). An impulse is stable up to 2/ω. What the
/// filter leaves of short waves has at most 0.3 of the frequency √(2πσ/(ρd³)).
const INTERVAL: f64 = 1.0;

/// Acid mass fractions, and surface tensions at 25 °C, mN/m: CRC Handbook (97th ed., section 6), and from 45 % on what is
/// read of its maximum and of 98 %.
const TENSIONS: [(f64, f64); 8] = [
    (0.0, 72.0),
    (0.041, 72.2),
    (0.122, 72.8),
    (0.219, 73.9),
    (0.291, 74.8),
    (0.336, 75.3),
    (0.45, 75.9),
    (0.98, 55.0),
];

/// Loss of water's surface tension a kelvin, over its value at 20 °C: mean from there to 100 °C (IAPWS R1-76).
const SLOPE: f64 = 0.002_378;

/// Least that is left, far beyond any table.
const LEAST: f64 = 0.1;

/// Surface tension of acid and water over that of water at 20 °C, for an acid mass fraction and a temperature (°C).
/// Acid's loss by temperature is taken to be water's.
pub fn relative(acid: f64, temperature: f64) -> f64 {
    let k = (0..TENSIONS.len() - 2)
        .take_while(|&k| acid > TENSIONS[k + 1].0)
        .count();
    let ((a, low), (b, high)) = (TENSIONS[k], TENSIONS[k + 1]);
    let t = ((acid - a) / (b - a)).clamp(0.0, 1.0);
    let by_acid = (low + t * (high - low)) / TENSIONS[0].1;
    by_acid * (1.0 - SLOPE * (temperature - 20.0)).clamp(LEAST, 1.1)
}

/// Contact angle of water on laboratory glass in use (20° to 40°), radians.
pub const GLASS: f64 = 30.0 * PI / 180.0;

/// Contact angle of water on a bench's phenolic resin (50° to 80°), radians.
pub const BENCH: f64 = 65.0 * PI / 180.0;

/// Difference between the advancing and the receding contact angle of glass and resin that are in use, radians: assumed,
/// as no source for glass in use was found.
pub const HYSTERESIS: f64 = 20.0 * PI / 180.0;

/// Share of the cells' holding force that acts on particles, found in the test `lines_are_held_by_what_hysteresis_says`: next to a
/// wall the filter puts colour where there is no particle.
pub(crate) const REACHED: f64 = 0.745;

/// Surface tension of a liquid, and its contact angles with solids.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceTension {
    /// σ, N/m.
    pub tension: f64,
    /// Angle between the liquid's surface and each flask's glass, measured in the liquid, radians; those that are not
    /// there have [`GLASS`].
    pub glass: Vec<f64>,
    /// Angle between the liquid's surface and table and floor, measured in the liquid, radians.
    pub ground: f64,
    /// Difference between the advancing and the receding angle, radians: a line at which the surface ends on a wall moves
    /// beyond these only.
    pub hysteresis: f64,
}

impl SurfaceTension {
    /// Surface tension `tension` (N/m), on laboratory glass and a bench without hysteresis.
    pub fn new(tension: f64) -> Self {
        Self {
            tension,
            glass: Vec::new(),
            ground: BENCH,
            hysteresis: 0.0,
        }
    }

    /// Factor of σ in the force that holds a line: the sine of half the hysteresis, over the share [`REACHED`] of it that acts on
    /// particles.
    pub(crate) fn stickiness(&self) -> f64 {
        (0.5 * self.hysteresis).sin() / REACHED
    }

    /// Contact angle of flask `index`'s glass, radians.
    pub fn of_glass(&self, index: usize) -> f64 {
        self.glass.get(index).copied().unwrap_or(GLASS)
    }

    /// Longest time (s) between two impulses with particles of mass `mass` (kg).
    pub fn longest_interval(&self, mass: f64) -> f64 {
        INTERVAL * (mass / (TAU * self.tension)).sqrt()
    }

    /// Substeps of a frame after which the force is found, and for how many it acts, for `substeps` of `time` seconds
    /// with particles of mass `mass` (kg).
    pub fn impulses(&self, mass: f64, substeps: u32, time: f64) -> Vec<(u32, u32)> {
        let wanted = (f64::from(substeps) * time / self.longest_interval(mass)).ceil() as u32;
        let count = wanted.clamp(1, substeps);
        let first = |n: u32| (u64::from(n) * u64::from(substeps) / u64::from(count)) as u32;
        (0..count)
            .map(|n| (first(n), first(n + 1) - first(n)))
            .collect()
    }
}

/// Area that the energy of `surface_energy.wgsl` counts per area of a flat surface, on nodes that a particle's volume reaches
/// by a cubic B-spline and a binomial filter: 1 but for what is fainter than 0.002 of one per node. Mean over places between nodes.
pub fn flat() -> f64 {
    const PLACES: i32 = 64;
    let place = |k: i32| (f64::from(k) + 0.5) / f64::from(PLACES);
    (0..PLACES).map(|k| flat_at(place(k))).sum::<f64>() / f64::from(PLACES)
}

/// Area that the energy of `surface_energy.wgsl` counts per area of a flat surface, as in [`flat`], with the surface at `place` beyond a
/// node, in units of the distance between nodes.
fn flat_at(place: f64) -> f64 {
    let raw = |n: i32| filled(f64::from(n) - place);
    let filtered = |n: i32| 0.25 * raw(n - 1) + 0.5 * raw(n) + 0.25 * raw(n + 1);
    (-6..6)
        .map(|n| {
            let (a, b) = (filtered(n), filtered(n + 1));
            let outermost = 1.5 * (1.0 - (0.5 * (a + b)).clamp(0.0, 1.0).powi(2));
            outermost * ((b - a).hypot(FAINTEST) - FAINTEST)
        })
        .sum()
}

/// Integral of the cubic B-spline up to `x` nodes.
fn filled(x: f64) -> f64 {
    let power = |shift: f64| (x + shift).max(0.0).powi(4) / 24.0;
    (power(2.0) - 4.0 * power(1.0) + 6.0 * power(0.0) - 4.0 * power(-1.0) + power(-2.0)).min(1.0)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic)]
    use super::*;

    /// ∫ F dc = 1, but for faint ends and the sum over cells, wherever the surface lies between nodes.
    #[test]
    fn a_flat_surface_counts_once() {
        assert!((0.99..1.01).contains(&flat()), "{}", flat());
        for place in [0.0, 0.25, 0.5, 0.9] {
            assert!((flat_at(place) / flat() - 1.0).abs() < 2e-3, "{place}");
        }
    }

    /// IAPWS R1-76: 235.8 mN/m (1 − T/T_c)^1.256 (1 − 0.625 (1 − T/T_c)); CRC's acids at 25 °C.
    #[test]
    fn tension_is_the_tables() {
        for celsius in [20.0, 40.0, 60.0, 80.0, 100.0] {
            let tau = 1.0 - (celsius + 273.15) / 647.096;
            let water = 0.2358 * f64::powf(tau, 1.256) * (1.0 - 0.625 * tau);
            let found = WATER * relative(0.0, celsius);
            assert!(
                (found / water - 1.0).abs() < 0.01,
                "{celsius} °C: {found} {water}"
            );
        }
        for (acid, tension) in [(0.122, 72.8), (0.336, 75.3), (0.98, 55.0)] {
            let found = 1e3 * WATER * relative(acid, 25.0);
            assert!(
                (found / tension - 1.0).abs() < 0.005,
                "{acid}: {found} {tension}"
            );
        }
    }

    #[test]
    fn impulses_share_a_frame() {
        let surface = SurfaceTension::new(WATER);
        for (d, substeps, count) in [
            (2.5e-3_f64, 10, 2),
            (1e-3, 16, 8),
            (5e-3, 8, 1),
            (1e-4, 4, 4),
        ] {
            let all = surface.impulses(
                1000.0 * d.powi(3),
                substeps,
                1.0 / 90.0 / f64::from(substeps),
            );
            assert_eq!(all.len(), count, "{d}");
            assert_eq!(all.iter().map(|&(_, time)| time).sum::<u32>(), substeps);
            assert!(
                all.windows(2)
                    .all(|pair| pair[0].0 + pair[0].1 == pair[1].0)
            );
        }
    }
}
