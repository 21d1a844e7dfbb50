//! Two liquids in contact, by the solutions of the diffusion equation: what
//! the exchange of a pair must add up to.

use super::parameters;
use crate::chemistry::ACID_DIFFUSIVITY;
use crate::chemistry::exchange::Exchange;
use crate::chemistry::physical::Content;
use crate::chemistry::table::SolutionTable;
use crate::chemistry::transport::{Diffusivities, Potential, flux};
use crate::parameters::Parameters;
use crate::reference::dilution::Pairs;
use crate::reference::neighbours::{Neighbours, find};
use glam::DVec3;

/// Σ k_ij·x²/2 of the lattice at h/d = 2 over that of a continuum: so much of
/// a diffusivity is at work.
pub const LATTICE_SHARE: f64 = 0.9915;

/// erf to 1e-12 by its series (|x| < 3).
pub fn erf(x: f64) -> f64 {
    let mut term = x;
    let mut sum = x;
    for n in 1..200 {
        let n = f64::from(n);
        term *= -x * x / n;
        sum += term / (2.0 * n + 1.0);
    }
    sum * 2.0 / std::f64::consts::PI.sqrt()
}

/// A bar from −1 to 1 m, `layers` a metre, five particles wide; what the
/// middle of each layer gets, its whole layer gets, so that it stands for a
/// slab without end.
pub struct Bar {
    pub positions: Vec<DVec3>,
    pub neighbours: Neighbours,
    pub exchange: Exchange,
    /// Substeps until D·t = 0.01 m² for D = 1 m²/s.
    pub steps: usize,
}

impl Bar {
    pub fn new(layers: usize) -> Self {
        let d = 1.0 / layers as f64;
        let total = 0.01;
        // Σ K = 0.3 on the lattice: Δt·D = 0.07 d².
        let steps = (total / (0.07 * d * d)).ceil();
        let parameters = Parameters {
            spacing: d,
            support_radius: 2.0 * d,
            substeps: 1,
            frame_time: total / steps,
            ..parameters()
        };
        let mut positions = Vec::new();
        for x in 0..2 * layers {
            for y in -2..=2 {
                for z in -2..=2 {
                    let at = DVec3::new(x as f64 + 0.5 - layers as f64, y.into(), z.into());
                    positions.push(at * d);
                }
            }
        }
        Self {
            exchange: parameters.exchange(20),
            neighbours: find(&positions, 2.0 * d, |_, _| true),
            positions,
            steps: steps as usize,
        }
    }

    pub fn pairs(&self) -> Pairs<'_> {
        Pairs {
            exchange: &self.exchange,
            positions: &self.positions,
            neighbours: &self.neighbours,
        }
    }

    /// The middle of each layer: (x, index of its particle).
    pub fn middles(&self) -> impl Iterator<Item = (f64, usize)> + '_ {
        let middles = (12..self.positions.len()).step_by(25);
        middles.map(move |i| (self.positions[i].x, i))
    }
}

/// Largest error of T and c after D·t = 0.01 m², of two liquids of which the
/// one at x < 0 has twice the mass and 2.6 times the heat capacity of the
/// other (both a particle), at 1 against 0.
///
/// With one D each, the contact stays at the mean by what the two hold
/// (Carslaw & Jaeger 1959, section 2.15), and each side is an error function.
fn contact_error(layers: usize) -> [f64; 2] {
    let bar = Bar::new(layers);
    let pairs = bar.pairs();
    let (mass, capacity) = (2.0, 2.6);
    let start: Vec<_> = bar
        .positions
        .iter()
        .map(|at| match at.x < 0.0 {
            true => (mass, capacity, 1.0),
            false => (1.0, 1.0, 0.0),
        })
        .map(|(mass, capacity, value)| Potential {
            mass,
            acid: value,
            temperature: value,
            enthalpy: 0.0,
            capacity: capacity / mass,
            variance: 0.0,
        })
        .collect();
    let still = Diffusivities {
        eddies: 0.0,
        acid: 0.0,
        heat: 0.0,
    };
    // One at a time: acid would bring heat along.
    let spread = |diffusivities: Diffusivities| {
        let mut state = start.clone();
        for _ in 0..bar.steps {
            let fluxes = pairs.sums(|i, j| {
                let distance = pairs.distance(i, j);
                flux(
                    pairs.exchange,
                    &diffusivities,
                    distance,
                    &state[i],
                    &state[j],
                    1.0,
                )
            });
            for (layer, fluxes) in state.chunks_mut(25).zip(fluxes.chunks(25)) {
                for particle in layer {
                    particle.acid += fluxes[12].acid / particle.mass;
                    particle.temperature += fluxes[12].enthalpy / particle.heat_capacity();
                }
            }
        }
        state
    };
    let heated = spread(Diffusivities { heat: 1.0, ..still });
    let mixed = spread(Diffusivities { acid: 1.0, ..still });
    let width = (4.0 * LATTICE_SHARE * 0.01).sqrt();
    let exact = |x: f64, weight: f64| {
        let contact = weight / (weight + 1.0);
        let far = if x < 0.0 { 1.0 } else { 0.0 };
        contact + (far - contact) * erf(x.abs() / width)
    };
    let mut worst = [0.0f64; 2];
    for (x, i) in bar.middles().filter(|(x, _)| x.abs() < 0.6) {
        worst[0] = worst[0].max((heated[i].temperature - exact(x, capacity)).abs());
        worst[1] = worst[1].max((mixed[i].acid - exact(x, mass)).abs());
    }
    worst
}

#[test]
fn unequal_liquids_diffuse_as_error_functions() {
    let [coarse, fine] = [10, 40].map(contact_error);
    for k in 0..2 {
        assert!(
            fine[k] < 0.003 && fine[k] < 0.4 * coarse[k],
            "{coarse:?} {fine:?}"
        );
    }
}

/// What acid brings along, alone, is the difference of enthalpy that the tables have
/// between the two liquids at their mean temperature, however far they are apart: −26 kJ/kg
/// across a fresh contact of water and 98 % acid at 20 °C.
#[test]
fn acid_brings_the_chord_of_the_tables() {
    let table = SolutionTable::new();
    let exchange = parameters().exchange(72);
    let alone = Diffusivities {
        eddies: 0.0,
        acid: 1e-6,
        heat: 0.0,
    };
    let brought = |low: (f64, f64), high: (f64, f64)| {
        let of = |(acid, temperature)| {
            let content = Content::liquid(&table, 1.6e-5, acid, temperature).unwrap();
            Potential::of(&table, &content)
        };
        let got = flux(&exchange, &alone, 0.0025, &of(low), &of(high), 1.0);
        got.enthalpy / got.acid
    };
    let fresh = brought((0.0, 20.0), (0.98, 20.0));
    assert!((fresh + 26e3).abs() < 1e3, "{fresh}");
    for (low, high) in [
        (0.0, 0.98),
        (0.0, 0.1),
        (0.1, 0.3),
        (0.3, 0.7),
        (0.7, 0.95),
        (0.5, 0.51),
    ] {
        for (cold, hot) in [
            (20.0, 20.0),
            (60.0, 60.0),
            (120.0, 120.0),
            (20.0, 100.0),
            (100.0, 20.0),
        ] {
            let mean = 0.5 * (cold + hot);
            let rise = table.enthalpy(high, mean) - table.enthalpy(low, mean);
            let (own, chord) = (brought((low, cold), (high, hot)), rise / (high - low));
            // cp changes by 1 J/(kg K) per K: over half of 80 K that is ½·40² J/kg of each h at
            // most, and none where the temperatures are alike.
            let allowed = if cold == hot {
                1e-3
            } else {
                801.0 / (high - low)
            };
            assert!(
                (own - chord).abs() < allowed,
                "{low} {high} {cold} {hot}: {own} {chord}"
            );
        }
    }
}

/// Water at 20 °C: 0.598 W/(m K) over 998 kg/m³ of 4.18 kJ/(kg K) (CoolProp).
#[test]
fn molecules_conduct_heat_as_water_does() {
    let still = Diffusivities::with(0.0);
    let known = 0.598 / (998.0 * 4180.0);
    assert!((still.heat / known - 1.0).abs() < 0.03, "{still:?}");
    assert_eq!((still.eddies, still.acid), (0.0, ACID_DIFFUSIVITY));
}

/// Layers left alone: ρΔc·√(Dt/π) of acid crosses unit area (Crank 1975, Eq. 2.14), where a particle is a
/// quarter of √(Dt) wide.
#[test]
fn acid_crosses_a_contact_as_fast_as_it_diffuses() {
    let bar = Bar::new(40);
    let pairs = bar.pairs();
    let only_acid = Diffusivities {
        eddies: 0.0,
        acid: 1.0,
        heat: 0.0,
    };
    let mut state: Vec<_> = bar
        .positions
        .iter()
        .map(|at| Potential {
            mass: 1.0,
            acid: if at.x < 0.0 { 0.5 } else { 0.3 },
            temperature: 20.0,
            enthalpy: 0.0,
            capacity: 3000.0,
            variance: 0.0,
        })
        .collect();
    for _ in 0..bar.steps {
        let fluxes = pairs.sums(|i, j| {
            let distance = pairs.distance(i, j);
            flux(
                pairs.exchange,
                &only_acid,
                distance,
                &state[i],
                &state[j],
                1.0,
            )
        });
        for (_, middle) in bar.middles() {
            let acid = state[middle].acid + fluxes[middle].acid;
            let layer = middle / 25 * 25;
            state[layer..layer + 25]
                .iter_mut()
                .for_each(|p| p.acid = acid);
        }
    }
    let crossed: f64 = bar
        .middles()
        .filter(|(x, _)| *x > 0.0)
        .map(|(_, i)| (state[i].acid - 0.3) / 40.0)
        .sum();
    let known = 0.2 * (0.01 / std::f64::consts::PI).sqrt();
    assert!((crossed / known - 1.0).abs() < 0.05, "{crossed} {known}");
}
