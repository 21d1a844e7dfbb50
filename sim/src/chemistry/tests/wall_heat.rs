//! The heat of glass, by geometry and by the theory of conduction.

use super::super::transport::Losses;
use super::super::wall_heat::{CAPACITY, CONDUCTIVITY, RINGS, advance, ring_at, rings};
use crate::flask::Profile;
use crate::flask::glassware::{BOROSILICATE, GLASSWARE, find};
use std::f64::consts::PI;

fn insulated() -> Losses {
    Losses {
        glass: 0.0,
        ..Losses::to_air(20.0)
    }
}

#[test]
fn rings_hold_what_the_glass_holds() {
    for glass in &GLASSWARE {
        let profile = glass.profile(1.0).unwrap();
        let rings = rings(&profile, &insulated(), 0.0, 1.0 / 90.0);
        let held: f64 = rings.iter().map(|ring| ring.capacity).sum();
        let known = profile.glass_volume() * BOROSILICATE * CAPACITY;
        assert!(
            (held / known - 1.0).abs() < 0.01,
            "{}: {held} {known}",
            glass.name
        );
        assert!(
            rings.iter().all(|ring| ring.quantum > 0.0),
            "{}",
            glass.name
        );
    }
    // A 400 mL beaker weighs 135 g (a supplier's table) with its wall of 1.7 mm and its spout; ours has 2 mm.
    let beaker = find("beaker-400").unwrap().profile(1.0).unwrap();
    let held: f64 = rings(&beaker, &insulated(), 0.0, 0.01)
        .iter()
        .map(|ring| ring.capacity)
        .sum();
    assert!((112.0..135.0).contains(&held), "{held} J/K");
}

#[test]
fn a_wave_of_heat_along_a_tube_decays_as_fourier_says() {
    // cos(πz/L) decays by α(π/L)²; a thin tube, whose base is a hundredth of it.
    let length = 0.32;
    let profile = Profile::new(&[[0.0, 0.004], [length, 0.004]], 0.001).unwrap();
    let time = 1.0;
    let rings = rings(&profile, &insulated(), 0.0, time);
    let wave = |k: usize| (PI * (k as f64 + 0.5) / RINGS as f64).cos();
    let mut temperatures: Vec<_> = (0..RINGS).map(|k| 50.0 + 10.0 * wave(k)).collect();
    let heat = |temperatures: &[f64]| -> f64 {
        rings
            .iter()
            .zip(temperatures)
            .map(|(ring, t)| ring.capacity * t)
            .sum()
    };
    let before = heat(&temperatures);
    for _ in 0..10_000 {
        advance(&rings, &mut temperatures, &[0.0; RINGS], 20.0, time);
    }
    let diffusivity = CONDUCTIVITY / (BOROSILICATE * CAPACITY);
    let expected = 10.0 * (-diffusivity * (PI / length).powi(2) * 1e4 * time).exp();
    let amplitude: f64 = (0..RINGS)
        .map(|k| (temperatures[k] - 50.0) * wave(k))
        .sum::<f64>()
        * 2.0
        / RINGS as f64;
    assert!(
        (amplitude / expected - 1.0).abs() < 0.02,
        "{amplitude} {expected}"
    );
    assert!((heat(&temperatures) / before - 1.0).abs() < 1e-12);
}

#[test]
fn hot_glass_cools_to_the_air() {
    // Newton: C dT/dt = h A (T_a − T) for the whole, as it is of one temperature where wall and base are.
    let profile = find("beaker-400").unwrap().profile(1.0).unwrap();
    let losses = Losses::to_air(20.0);
    let rings = rings(&profile, &losses, 0.0, 0.1);
    let mut temperatures = vec![100.0; RINGS];
    for _ in 0..6000 {
        advance(&rings, &mut temperatures, &[0.0; RINGS], 20.0, 0.1);
    }
    // 2 mm of glass: ρ c t/h = 309 s, longer at the base's corner.
    let middle = temperatures[RINGS / 2];
    let expected =
        20.0 + 80.0 * (-600.0 * 12.0 * 0.040 / (BOROSILICATE * CAPACITY * 0.002 * 0.039)).exp();
    assert!((middle - expected).abs() < 0.5, "{middle} {expected}");
}

#[test]
fn walls_of_any_thickness_stay_between_the_temperatures() {
    for wall in [1e-4, 0.002, 0.02] {
        let profile = Profile::new(&[[0.0, 0.03], [0.1, 0.03]], wall).unwrap();
        let rings = rings(&profile, &Losses::to_air(20.0), 0.0, 1.0 / 60.0);
        let mut temperatures = vec![20.0; RINGS];
        for _ in 0..200 {
            // Liquid of 100 °C all over its inside.
            let area = 2.0 * PI * 0.03 * 0.1 / RINGS as f64;
            let taken: Vec<_> = (0..RINGS)
                .map(|k| rings[k].to_liquid * area * (100.0 - temperatures[k]) / 60.0)
                .collect();
            for (ring, taken) in rings.iter().zip(&taken) {
                assert!(taken / ring.quantum < f64::from(i32::MAX), "{wall} m");
            }
            advance(&rings, &mut temperatures, &taken, 20.0, 1.0 / 60.0);
            let within = temperatures.iter().all(|t| (19.99..100.01).contains(t));
            assert!(within, "{wall} m: {temperatures:?}");
        }
    }
}

#[test]
fn heights_belong_to_their_ring() {
    let profile = Profile::new(&[[0.0, 0.03], [0.32, 0.03]], 0.002).unwrap();
    for (y, ring) in [
        (-1.0, 0),
        (0.001, 0),
        (0.0119, 0),
        (0.0121, 1),
        (0.3219, 31),
        (9.0, 31),
    ] {
        assert_eq!(ring_at(&profile, y), ring, "{y}");
    }
}

/// A plate of 200 W under a beaker with water at 100 °C: once the base is warm the plate's heat goes through half of the
/// wall and the film of water that boils, which by a textbook's boiling curve (Incropera, Fig. 10.4) has 5 to 15 K at
/// 20 to 300 kW/m².
#[test]
fn a_plates_heat_goes_through_glass_and_film() {
    let profile = find("beaker-250").unwrap().profile(1.0).unwrap();
    let time = 1.0 / 90.0;
    let rings = rings(&profile, &insulated(), 200.0, time);
    assert_eq!(rings.iter().map(|ring| ring.heated).sum::<f64>(), 200.0);
    let area = PI * profile.inner_radius(profile.floor_height()).powi(2);
    let flux = 200.0 / area;
    let through_wall = flux * 0.5 * profile.wall() / CONDUCTIVITY;
    // The base alone, without what the wall conducts.
    let mut base = 20.0;
    for _ in 0..20_000 {
        let taken = rings[0].to_liquid * area * (100.0 - base) * time;
        base += (taken + 200.0 * time) / rings[0].capacity;
    }
    // A step's exchange is cut by some percent of what it would be at once.
    let film = base - 100.0 - through_wall;
    assert!((3.0..17.0).contains(&film), "{flux} W/m²: {film} K");
}
