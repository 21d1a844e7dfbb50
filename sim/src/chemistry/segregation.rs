//! Liquid that is not mixed below a particle's size.
//!
//! Eddies bring acid and water to each other in lamellae; molecules mix them.
//! Heat is a hundred times faster than acid, so a particle has one
//! temperature, and in it everything from water to acid: what is still water
//! boils at 100 °C, though the mean would not. Each particle carries the
//! variance s² of its acid fraction. Its content follows from c and s² as
//! that of a pair of layers, water and the feed, of which diffusion has left that
//! variance: from the profile follow the heat of mixing that has been
//! released already, and the acid fraction in the middle of the water.

use super::constants::{ABSOLUTE_ZERO, ACID_DIFFUSIVITY};
use super::table::{Row, SolutionTable};
use std::f64::consts::PI;
use std::sync::{Arc, Mutex, PoisonError};

/// Usual acid fraction of the acid's layers: that of concentrated acid.
pub const USUAL_FEED: f64 = 0.98;

/// Most tables that are kept: a run has one.
const KEPT: usize = 8;

/// Intervals of the table, over c/f and over √Θ, Θ = s²/(c·(f − c)), f being the feed's acid fraction.
/// With them temperatures are within 0.7 K of the profile's own (16 by 16; 8 by 8: 4 K).
pub const INTERVALS: usize = 16;

/// Variance below which a liquid counts as mixed: 1e-4 of its acid fraction.
pub const MIXED: f64 = 1e-8;

/// Rate of engulfment over (ε/ν)^½ (Baldyga & Bourne 1989).
pub const ENGULFMENT: f64 = 0.058;

/// Viscosity of water at 25 °C, Pa·s, where acid has [`ACID_DIFFUSIVITY`].
const WATER_VISCOSITY: f64 = 0.89e-3;

/// Cells of half a pair of layers, and the temperature (°C) of its properties.
const CELLS: usize = 48;
const PROFILE_TEMPERATURE: f64 = 110.0;

/// Depth of the water below the mean from which a surface shows it.
const LEAST_DEPTH: f64 = 1e-3;

/// Properties of a particle's lamellae less those of a liquid of its mean composition.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Excess {
    /// Mean of the enthalpies at 25 °C over that of the mean, J/kg.
    pub enthalpy: f64,
    /// Mean of the heat capacities at 20 °C over that of the mean, J/(kg K).
    pub capacity: f64,
    /// Mean of their slopes in T over that of the mean, J/(kg K²).
    pub rise: f64,
    /// c less that of the middle of the water.
    pub depth: f64,
}

/// [`Excess`] over c and √Θ.
#[derive(Clone, Debug)]
pub struct Lamellae {
    /// Acid fraction of the acid's layers.
    feed: f64,
    nodes: Vec<Excess>,
}

impl Lamellae {
    /// The table of a feed of that acid fraction, above 0 and up to 1; made once for each.
    pub fn of(feed: f64) -> Arc<Self> {
        static TABLES: Mutex<Vec<Arc<Lamellae>>> = Mutex::new(Vec::new());
        let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
        let known = |made: &&Arc<Self>| made.feed.to_bits() == feed.to_bits();
        if let Some(made) = tables.iter().find(known) {
            return Arc::clone(made);
        }
        let made = Arc::new(Self::new(&SolutionTable::new(), feed));
        tables.truncate(KEPT - 1);
        tables.push(Arc::clone(&made));
        made
    }

    fn new(table: &SolutionTable, feed: f64) -> Self {
        let of_mean = |i: usize| match i {
            0 | INTERVALS => vec![Excess::default(); INTERVALS + 1],
            _ => on_the_way(table, feed, feed * i as f64 / INTERVALS as f64),
        };
        Self {
            feed,
            nodes: (0..=INTERVALS).flat_map(of_mean).collect(),
        }
    }

    /// For the GPU: (enthalpy, capacity, rise, depth) of c = f·i/16 and √Θ = j/16 at 17i + j, f being the feed's acid fraction.
    pub fn rows(&self) -> Vec<[f32; 4]> {
        let row = |e: &Excess| [e.enthalpy, e.capacity, e.rise, e.depth].map(|value| value as f32);
        self.nodes.iter().map(row).collect()
    }

    /// Excess of a liquid of mean acid fraction `acid` with the variance `variance`.
    pub fn excess(&self, acid: f64, variance: f64) -> Excess {
        let most = acid * (self.feed - acid);
        if variance <= 0.0 || most <= 0.0 {
            return Excess::default();
        }
        let last = (INTERVALS - 1) as f64;
        let place = |share: f64| {
            let at = share * INTERVALS as f64;
            let low = at.floor().clamp(0.0, last);
            (low as usize, at - low)
        };
        let (i, s) = place(acid / self.feed);
        let (j, t) = place((variance / most).min(1.0).sqrt());
        let node = |i: usize, j: usize| self.nodes[i * (INTERVALS + 1) + j];
        let between = |of: fn(Excess) -> f64| {
            let mix = |i: usize| of(node(i, j)) * (1.0 - t) + of(node(i, j + 1)) * t;
            mix(i) * (1.0 - s) + mix(i + 1) * s
        };
        Excess {
            enthalpy: between(|e| e.enthalpy),
            capacity: between(|e| e.capacity),
            rise: between(|e| e.rise),
            depth: between(|e| e.depth).clamp(0.0, acid),
        }
    }
}

/// Excess of layers of water and the acid fraction `feed` with the mean `mean`, by √Θ from 0 to 1, as acid diffuses through their mass.
///
/// The diffusivity is the geometric mean of a constant one and Stokes and
/// Einstein's. We found no measurements in hot concentrated acid; with
/// either alone the superheat is 2 K off from this, and 4 from the other.
fn on_the_way(table: &SolutionTable, feed: f64, mean: f64) -> Vec<Excess> {
    let rate = |k: usize| {
        let row = table.at(feed * (k as f64 + 0.5) / CELLS as f64);
        let by_viscosity =
            row.density_at(PROFILE_TEMPERATURE).powi(2) / row.viscosity_at(PROFILE_TEMPERATURE);
        by_viscosity.sqrt()
    };
    let rates: Vec<_> = (0..CELLS).map(rate).collect();
    let longest = 0.45 / rates.iter().fold(0.0, |a: f64, &b| a.max(b));
    let rate_of = |acid: f64| rates[((acid / feed * CELLS as f64) as usize).min(CELLS - 1)];
    let edge = (1.0 - mean / feed) * CELLS as f64;
    let mut acid: Vec<_> = (0..CELLS)
        .map(|k| feed * ((k + 1) as f64 - edge).clamp(0.0, 1.0))
        .collect();
    let mut found = vec![Excess::default(); INTERVALS + 1];
    found[INTERVALS] = of_profile(table, mean, &acid);
    for j in (1..INTERVALS).rev() {
        let intensity = (j as f64 / INTERVALS as f64).powi(2);
        while variance_of(&acid, mean) > intensity * mean * (feed - mean) {
            let old = acid.clone();
            for k in 0..CELLS - 1 {
                let rate = 0.5 * (rate_of(old[k]) + rate_of(old[k + 1]));
                let flux = longest * rate * (old[k + 1] - old[k]);
                acid[k] += flux;
                acid[k + 1] -= flux;
            }
        }
        found[j] = of_profile(table, mean, &acid);
    }
    found
}

fn variance_of(acid: &[f64], mean: f64) -> f64 {
    acid.iter().map(|c| (c - mean).powi(2)).sum::<f64>() / acid.len() as f64
}

fn of_profile(table: &SolutionTable, mean: f64, acid: &[f64]) -> Excess {
    let mixed = table.at(mean);
    let over = |of: fn(&Row) -> f64| {
        let sum: f64 = acid.iter().map(|&c| of(&table.at(c))).sum();
        sum / acid.len() as f64 - of(&mixed)
    };
    Excess {
        enthalpy: over(|row| row.enthalpy),
        capacity: over(|row| row.capacity),
        rise: over(|row| row.capacity_rise),
        depth: mean - acid[0].min(mean),
    }
}

impl SolutionTable {
    /// Properties of a liquid of mean `acid` whose lamellae have the variance
    /// `variance`: heat is that of all of it, the boiling point that of the
    /// middle of its water, the rest that of the mean.
    pub fn of_lamellae(&self, acid: f64, variance: f64) -> Row {
        let mut row = self.at(acid);
        if variance > 0.0 {
            let excess = self.lamellae().excess(row.acid, variance);
            row.enthalpy += excess.enthalpy;
            row.capacity += excess.capacity;
            row.capacity_rise += excess.rise;
            let water = self.at(row.acid - excess.depth);
            row.boiling_point = water.boiling_point;
            row.boiling_slope = water.boiling_slope;
        }
        row
    }

    /// Properties of the two liquids that such lamellae show at a surface at `temperature` (°C), that of their water first, each with
    /// its share of the volume. Their mean and variance are those of the lamellae, and the first is the middle of the water;
    /// a mixture is all of one liquid.
    pub fn shown_of_lamellae(&self, acid: f64, variance: f64, temperature: f64) -> [(Row, f64); 2] {
        let depth = if variance > 0.0 {
            self.lamellae().excess(acid, variance).depth
        } else {
            0.0
        };
        if depth < LEAST_DEPTH {
            let mixed = self.at(acid);
            return [(mixed, 1.0), (mixed, 0.0)];
        }
        let poorest = self.at(acid - depth);
        let richest = self.at(acid + variance / depth);
        let water = variance / poorest.density_at(temperature);
        let rest = depth * depth / richest.density_at(temperature);
        let share = water / (water + rest);
        [(poorest, share), (richest, 1.0 - share)]
    }
}

/// Variance of a liquid's acid fraction `acid` after the share `gone` of its
/// mass has left as water from where its fraction is `poorest`; a negative
/// share has come there.
///
/// An element keeps its acid, so that Σ m c² grows by c² of the element for
/// each mass of water.
pub fn without_water(variance: f64, acid: f64, poorest: f64, gone: f64) -> f64 {
    let left = 1.0 - gone;
    let squares = variance * left - acid * acid * gone + poorest * poorest * gone * left;
    (squares / (left * left)).max(0.0)
}

/// Diffusivity of acid in this liquid at `temperature` (°C), m²/s, by Stokes
/// and Einstein from that in water.
pub fn diffusivity(row: &Row, temperature: f64) -> f64 {
    let warmth = (temperature - ABSOLUTE_ZERO) / 298.15;
    ACID_DIFFUSIVITY * warmth * WATER_VISCOSITY / row.viscosity_at(temperature)
}

/// Rate at which lamellae lose their variance, 1/s: eddies that take
/// `dissipation` (W/kg) engulf them, and molecules even out what is
/// `lamella` (m) thick, whose first mode decays by D·(π/δ)².
pub fn decay_rate(row: &Row, temperature: f64, dissipation: f64, lamella: f64) -> f64 {
    let viscosity = row.viscosity_at(temperature) / row.density_at(temperature);
    let molecules = 2.0 * diffusivity(row, temperature) * (PI / lamella).powi(2);
    ENGULFMENT * (dissipation / viscosity).sqrt() + molecules
}
