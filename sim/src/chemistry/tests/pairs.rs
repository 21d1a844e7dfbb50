//! Exchange between pairs: sums that must hold whatever the arrangement.

use super::super::exchange::Exchange;
use super::super::paper::{AntiViscosity, Dilution};
use super::super::physical::Content;
use super::super::table::SolutionTable;
use super::super::thomsen;
use super::super::transport::{
    Diffusivities, Potential, contact_area, flux, heat_from, kept, surface_area, turnover,
};
use crate::kernel::Kernel;
use crate::parameters::Parameters;
use crate::scene::Scene;
use glam::DVec3;
use proptest::prelude::*;
use std::f64::consts::PI;
use vitriol_tests::random::Random;

/// The paper's world.
fn world() -> Parameters {
    Parameters::from_scene(&Scene::builtin("single-dilution").unwrap())
}

/// The exchange of a substep with the lists that `world` has.
fn exchange_in(world: &Parameters) -> Exchange {
    world.exchange(world.list_capacity())
}

/// Points that may lie anywhere, close together too, with their acid
/// fractions; at most as many as a list holds.
fn cluster() -> impl Strategy<Value = Vec<([f64; 3], f64)>> {
    let acid = prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0];
    prop::collection::vec((prop::array::uniform3(0.0..0.15), acid), 2..64)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// Σ_j of `share` for each of `particles`.
fn turnovers_of(particles: &[Potential], share: impl Fn(usize, usize) -> f64) -> Vec<f64> {
    let all = 0..particles.len();
    let of = |i: usize| all.clone().map(|j| share(i, j)).sum();
    all.clone().map(of).collect()
}

/// One step on acid fractions: the new ones and every Δc_ij.
fn diffuse(
    exchange: &Exchange,
    diffusivity: f64,
    points: &[([f64; 3], f64)],
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let changes: Vec<Vec<f64>> = points
        .iter()
        .map(|&(at, acid)| {
            let change = |&(other, beside): &([f64; 3], f64)| {
                exchange.share(diffusivity, distance(at, other)) * (beside - acid)
            };
            points.iter().map(change).collect()
        })
        .collect();
    let after = points
        .iter()
        .zip(&changes)
        .map(|((_, acid), changes)| acid + changes.iter().sum::<f64>())
        .collect();
    (after, changes)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// No new extrema and no drift, for any D, Δt and disorder.
    #[test]
    fn diffusion_keeps_its_sum_and_its_range(
        points in cluster(),
        diffusivity in prop_oneof![Just(0.007), Just(1e9), 0.0..10.0],
    ) {
        let exchange = exchange_in(&world());
        let (after, _) = diffuse(&exchange, diffusivity, &points);
        let before: f64 = points.iter().map(|(_, acid)| acid).sum();
        // Rounding of 64 sums of 64 terms.
        prop_assert!((after.iter().sum::<f64>() - before).abs() < 1e-12);
        let (low, high) = points.iter().fold((1.0f64, 0.0f64), |(low, high), (_, acid)| {
            (low.min(*acid), high.max(*acid))
        });
        for acid in after {
            prop_assert!((low - 1e-15..=high + 1e-15).contains(&acid), "{acid}");
        }
    }

    /// Eqs 6 to 13: the heat of all pairs is the change of enthalpy, and all
    /// of it arrives.
    #[test]
    fn pair_heats_sum_to_the_change_of_enthalpy(
        points in cluster(),
        diffusivity in prop_oneof![Just(0.007), Just(1e9)],
    ) {
        let exchange = exchange_in(&world());
        let dilution = Dilution::new(0.017, world().particle_mass());
        let (after, changes) = diffuse(&exchange, diffusivity, &points);
        let secants: Vec<f64> = points
            .iter()
            .zip(&after)
            .map(|((_, before), after)| thomsen::secant(*before, *after))
            .collect();
        let (mut heat, mut warming) = (0.0, 0.0);
        for i in 0..points.len() {
            for j in 0..points.len() {
                let pair = dilution.pair_heat((secants[i], secants[j]), changes[i][j]);
                heat += 0.5 * pair;
                warming += dilution.warming(pair, points[i].1, points[j].1);
            }
        }
        let enthalpy: f64 = points
            .iter()
            .zip(&after)
            .map(|((_, before), after)| dilution.heat(*after) - dilution.heat(*before))
            .sum();
        let scale = enthalpy.abs() + 1e-6 * dilution.heat(0.5);
        prop_assert!((heat - enthalpy).abs() < 1e-6 * scale, "{heat} {enthalpy}");
        let arrived = warming * dilution.heat_capacity();
        prop_assert!((arrived - enthalpy).abs() < 1e-6 * scale, "{arrived} {enthalpy}");
    }

    /// The physical exchange keeps acid and enthalpy, and compositions in
    /// range, for liquids of any temperature with bubbles in them.
    #[test]
    fn physical_exchange_keeps_acid_and_enthalpy(
        points in cluster(),
        temperatures in prop::collection::vec(-10.0..400.0, 64),
        speed in prop_oneof![Just(0.0), Just(1e9), 0.0..5.0],
    ) {
        let table = SolutionTable::new();
        let exchange = exchange_in(&world());
        let mut contents: Vec<Content> = points
            .iter()
            .zip(&temperatures)
            .map(|((_, acid), &at)| Content::liquid(&table, 0.1 + acid, *acid, at).unwrap())
            .collect();
        contents.iter_mut().for_each(|content| {
            content.boil(&table, 1.0, 1.0);
        });
        let potentials: Vec<_> = contents.iter().map(|c| Potential::of(&table, c)).collect();
        let d = Diffusivities::with(0.0041 * speed);
        let turnovers = turnovers_of(&potentials, |i, j| {
            let apart = distance(points[i].0, points[j].0);
            turnover(&exchange, &d, apart, &potentials[i], &potentials[j])
        });
        let (mut acid, mut enthalpy, mut size) = (0.0, 0.0, 0.0);
        for i in 0..points.len() {
            let mut gained = contents[i].mass * contents[i].acid;
            for j in 0..points.len() {
                let apart = distance(points[i].0, points[j].0);
                let (own, other) = (&potentials[i], &potentials[j]);
                let got = flux(&exchange, &d, apart, own, other, kept(turnovers[i], turnovers[j]));
                let back = flux(&exchange, &d, apart, other, own, kept(turnovers[j], turnovers[i]));
                prop_assert_eq!((got.acid, got.enthalpy), (-back.acid, -back.enthalpy));
                gained += got.acid;
                acid += got.acid;
                enthalpy += got.enthalpy;
                size += got.enthalpy.abs();
            }
            let fraction = gained / contents[i].liquid_mass();
            prop_assert!((-1e-14..=1.0 + 1e-14).contains(&fraction), "{fraction}");
        }
        prop_assert!(acid.abs() < 1e-12 && enthalpy.abs() < 1e-12 * size + 1e-9);
    }
}

#[test]
fn nearest_neighbours_of_the_papers_world_are_not_limited() {
    let world = world();
    let exchange = exchange_in(&world);
    // Table 1 on the lattice at 60 Hz × 3.
    let nearest = |diffusivity| exchange.unlimited(diffusivity, world.spacing);
    assert!((nearest(0.01) - 0.0102).abs() < 1e-4, "{}", nearest(0.01));
    assert_eq!(exchange.limited(nearest(0.01)), nearest(0.01));
    // Ten times that, and whatever there is, are cut to one over the list.
    assert_eq!(exchange.limited(nearest(0.1)), exchange.limit());
    assert_eq!(exchange.limited(nearest(1e308)), exchange.limit());
    assert_eq!(exchange.limited(nearest(0.0)), 0.0);
}

/// Eq. 5 over a half space whose matter is spread evenly and keeps its
/// temperature, by quadrature over spherical caps, against V_b by the same.
#[test]
fn a_wall_takes_what_the_integral_over_a_half_space_does() {
    let world = world();
    let exchange = exchange_in(&world);
    let kernel = Kernel::new(world.support_radius);
    let h = world.support_radius;
    let over_caps = |from: f64, of: &dyn Fn(f64) -> f64| -> f64 {
        let n = 4000;
        let dr = (h - from) / f64::from(n);
        let radii = (0..n).map(|i| from + (f64::from(i) + 0.5) * dr);
        let cap = |r: f64| 2.0 * PI * r * r * (1.0 - from / r) * dr;
        radii.map(|r| of(r) * cap(r)).sum()
    };
    let diffusivity = 1e-9;
    for tenths in 0..=4 {
        let distance = 0.1 * h * f64::from(tenths);
        // 2V_j|x·∇W|/(x² + 0.01h²) with Σ V_j → ∫ dV.
        let pair = |r: f64| 2.0 * r * -kernel.dw(r) / (r * r + 0.01 * h * h);
        let rate = over_caps(distance, &pair);
        let volume = over_caps(distance, &|r| kernel.w(r));
        let share = exchange.wall_share(diffusivity, volume);
        let by_integral = world.substep_time() * diffusivity * rate;
        // One factor, 24, serves 22.2 at the wall to 27 at 0.4 h.
        assert!(
            (share / by_integral - 1.0).abs() < 0.12,
            "{tenths}: {share} {by_integral}"
        );
    }
}

/// Eddies of any strength, particles of unlike mass, some of which many know: what each has is a weighted mean of
/// what there was. Its turnover is 1 and more where it would not be, and else nothing is cut.
#[test]
fn no_turnover_makes_new_extremes() {
    let exchange = exchange_in(&world());
    let table = SolutionTable::new();
    let mut random = Random(7);
    for (count, speed) in [(2, 1e9), (5, 1e9), (40, 1e9), (40, 0.03), (40, 0.001)] {
        // In one place, where pairs exchange most; each has the first ones as neighbours, and these have all.
        let known = |i: usize, j: usize| i != j && (i < 2 || j < 2);
        let particles: Vec<_> = (0..count)
            .map(|i| {
                let acid = if i % 2 == 0 { 0.2 } else { 0.6 };
                let content = Content::liquid(&table, 1.0 + random.point(1.0).x, acid, 50.0);
                Potential::of(&table, &content.unwrap())
            })
            .collect();
        let d = Diffusivities::with(speed);
        let turnovers = turnovers_of(&particles, |i, j| {
            let (own, other) = (&particles[i], &particles[j]);
            f64::from(u8::from(known(i, j))) * turnover(&exchange, &d, 0.02, own, other)
        });
        let gained = |i: usize, cut: bool| -> f64 {
            let near = (0..count).filter(|&j| known(i, j));
            near.map(|j| {
                let keeps = if cut {
                    kept(turnovers[i], turnovers[j])
                } else {
                    1.0
                };
                let (own, other) = (&particles[i], &particles[j]);
                flux(&exchange, &d, 0.02, own, other, keeps).acid
            })
            .sum()
        };
        let in_range = |acid: f64| (0.2 - 1e-12..=0.6 + 1e-12).contains(&acid);
        for (i, particle) in particles.iter().enumerate() {
            let after = |cut| particle.acid + gained(i, cut) / particle.mass;
            assert!(
                in_range(after(true)),
                "{count} {speed} {i}: {}",
                after(true)
            );
            if speed < 0.01 {
                assert_eq!(after(true), after(false));
            }
        }
        let uncut = (0..count).any(|i| {
            let particle = &particles[i];
            !in_range(particle.acid + gained(i, false) / particle.mass)
        });
        let most = turnovers
            .iter()
            .fold(0.0f64, |most, &turnover| most.max(turnover));
        assert_eq!(most > 1.0, speed > 0.01, "{count} {speed}: {most}");
        assert_eq!(
            uncut,
            speed > 0.01,
            "{count} {speed}: the cut is for nothing"
        );
    }
}

#[test]
fn uniform_liquid_exchanges_nothing() {
    let exchange = exchange_in(&world());
    let table = SolutionTable::new();
    let content = Content::liquid(&table, 0.125, 0.3, 80.0).unwrap();
    let potential = Potential::of(&table, &content);
    let d = Diffusivities::with(0.0041);
    let got = flux(&exchange, &d, 0.05, &potential, &potential, 1.0);
    // Exactly: else a scene at rest would not stay as it is.
    assert_eq!((got.acid, got.enthalpy), (0.0, 0.0));
    assert_eq!(thomsen::secant(0.3, 0.3) - thomsen::secant(0.3, 0.3), 0.0);
}

#[test]
fn losses_stop_at_ambient() {
    let table = SolutionTable::new();
    for temperature in [-20.0, 20.0, 150.0, 1e6] {
        let content = Content::liquid(&table, 1.6e-5, 0.5, temperature).unwrap();
        let hot = Potential::of(&table, &content);
        let at_once = heat_from(&hot, 20.0, 30.0 * 6e-6, 1e9);
        let all = hot.heat_capacity() * (20.0 - temperature);
        assert!(
            (at_once - all).abs() <= 1e-9 * all.abs() + 1e-12,
            "{temperature}"
        );
        // 30 W/(m² K) over a short time, by hand.
        let soon = heat_from(&hot, 20.0, 30.0 * 2e-6, 1e-3);
        let by_hand = 30.0 * 2e-6 * (20.0 - temperature) * 1e-3;
        assert!(
            (soon - by_hand).abs() <= 1e-4 * by_hand.abs() + 1e-15,
            "{soon} {by_hand}"
        );
    }
}

#[test]
fn areas_of_a_plane_sum_to_its_own() {
    // Layers at d/2, 3d/2 before a plane wall with h = 2d: one particle of
    // each per d².
    let map = crate::flask::PlaneMap::new(0.005);
    let (d, volume) = (0.0025, 0.0025f64.powi(3));
    let area: f64 = [0.5 * d, 1.5 * d]
        .map(|distance| contact_area(volume, -map.slope(distance)))
        .iter()
        .sum();
    assert!((area / (d * d) - 1.0).abs() < 1e-9, "{area}");
}

/// A cubic lattice with a level surface, each particle moved by up to `shake` d along each axis: the
/// surface's area a site, and what is counted below the first two layers.
fn lattice_areas(shake: f64) -> [f64; 2] {
    let kernel = Kernel::new(2.0);
    let mut random = Random(4);
    let side = 12;
    let sites: Vec<[usize; 3]> = (0..side * side * side)
        .map(|i| [i % side, i / side % side, i / side / side])
        .collect();
    let places: Vec<DVec3> = sites
        .iter()
        .map(|site| DVec3::from_array(site.map(|k| k as f64)) + random.point(shake))
        .collect();
    let gradient = |at: DVec3| -> DVec3 {
        let apart = places.iter().map(|&place| at - place);
        let near = apart.filter(|apart| apart.length_squared() < 4.0);
        near.map(|apart| apart.normalize_or_zero() * kernel.dw(apart.length()))
            .sum()
    };
    // Far from the sides, whose surfaces are not asked for.
    let middle = |k: usize| (3..side - 3).contains(&k);
    let mut areas = [0.0; 2];
    for (site, &at) in sites.iter().zip(&places) {
        if middle(site[0]) && middle(site[1]) && site[2] >= 3 {
            let layer = usize::from(site[2] < side - 2);
            areas[layer] += surface_area(1.0, gradient(at).length());
        }
    }
    areas.map(|area| area / (side - 6).pow(2) as f64)
}

/// Disorder inside is no surface: of a lattice shaken by a tenth of d, |Σ V∇W| alone counts 0.2 d² a particle.
#[test]
fn disorder_is_no_surface() {
    for shake in [0.0, 0.05, 0.1] {
        let [surface, inside] = lattice_areas(shake);
        assert!((surface - 1.0).abs() < 0.1, "{shake}: {surface}");
        // Over seven layers.
        assert!(inside < 0.07, "{shake}: {inside}");
    }
}

#[test]
fn anti_viscosity_is_bounded_at_any_temperature_and_intensity() {
    for (temperature, intensity) in [(1e6, 1.0), (150.0, 100.0), (1e6, 100.0), (1e300, 1e9)] {
        let law = AntiViscosity::new(100.0, intensity).unwrap();
        for agitation in [0.0, 1e-30, 1.0, 1e6] {
            let growth = law.growth(temperature, agitation, 1.0 / 180.0);
            assert!((0.0..=0.3).contains(&growth), "{temperature} {growth}");
        }
    }
    let law = AntiViscosity::new(100.0, 1.0).unwrap();
    assert_eq!(law.growth(99.99, 0.0, 1.0), 0.0);
    assert_eq!(law.growth(100.0, 0.0, 1.0), 0.0);
    // Eq. 17: μ₀ below T_B, from zero at it, −μ₀·k_v·0.5 at 150 °C.
    assert_eq!(law.literal(99.0, 0.3), 0.3);
    assert_eq!(law.literal(100.0, 0.3), 0.0);
    assert!((law.literal(150.0, 0.3) + 0.15).abs() < 1e-15);
    for boiling_point in [0.0, -10.0, f64::NAN] {
        assert!(AntiViscosity::new(boiling_point, 1.0).is_err());
    }
}
