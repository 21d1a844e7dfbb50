//! Water that leaves below its boiling point, by tables of others.

use super::super::evaporation::{StillAir, evaporated, vapour_pressure};
use super::super::table::SolutionTable;
use super::super::transport::Potential;

#[test]
fn pressure_of_water_is_that_of_steam_tables() {
    // IAPWS-95, Pa. A constant heat capacity costs up to 1.5 %, room temperature 3.
    let water = SolutionTable::new().at(0.0);
    for (temperature, known, within) in [
        (20.0, 2339.3, 0.04),
        (60.0, 19_946.0, 0.015),
        (80.0, 47_414.0, 0.01),
        (90.0, 70_182.0, 0.01),
        (100.0, 101_418.0, 0.002),
    ] {
        let found = vapour_pressure(&water, temperature);
        assert!(
            (found / known - 1.0).abs() < within,
            "{temperature} °C: {found} Pa"
        );
    }
}

#[test]
fn pressure_over_acid_is_that_of_perrys_table() {
    // log10(p/mmHg) = A − B/T (Perry), of which only T_b is in our tables, and that from another of its
    // tables; the two disagree by 4 % of p at 1 atm.
    let table = SolutionTable::new();
    for (acid, a, b) in [
        (0.3, 8.864, 2271.0),
        (0.5, 8.832, 2357.0),
        (0.7, 9.032, 2688.0),
    ] {
        for temperature in [60.0, 80.0, 100.0] {
            let known = 133.322 * 10f64.powf(a - b / (temperature + 273.15));
            let found = vapour_pressure(&table.at(acid), temperature);
            assert!(
                (found / known - 1.0).abs() < 0.12,
                "{acid} {temperature} °C: {found} {known}"
            );
        }
    }
}

/// Evaporation from open water in still air, of a handbook of tank heating ('Heat Loss from Open Water
/// Tanks', Engineering Toolbox: 660, 1740, 2160 and 2680 Btu/(ft² h) at 140, 180, 190 and 200 °F, air of
/// 60 °F). Its tanks are full to the rim.
#[test]
fn water_evaporates_as_tanks_of_hot_water_do() {
    let table = SolutionTable::new();
    let water = table.at(0.0);
    let air = StillAir::at(&table, 15.6);
    for (temperature, known) in [
        (60.0, 2082.0),
        (82.2, 5489.0),
        (87.8, 6814.0),
        (93.3, 8454.0),
    ] {
        let power = air.flux(&water, temperature) * water.latent_heat(temperature);
        assert!(
            (power / known - 1.0).abs() < 0.25,
            "{temperature} °C: {power} W/m²"
        );
        // Stefan's factor alone, without the cold skin of the water, would be twice as much.
        let uniform = air.flux_from_surface(&water, temperature) * water.latent_heat(temperature);
        assert!(
            temperature < 85.0 || uniform / known > 1.6,
            "{temperature} °C: {uniform} W/m²"
        );
    }
}

#[test]
fn the_skin_gets_as_much_heat_as_the_vapour_takes() {
    // By bisection.
    let table = SolutionTable::new();
    let air = StillAir::at(&table, 20.0);
    for acid in [0.0, 0.3, 0.5, 0.7, 0.9] {
        let row = table.at(acid);
        for share in [0.3, 0.6, 0.9, 1.0, 1.05] {
            let temperature = 20.0 + share * (row.boiling_point - 20.0);
            let brought = |surface: f64| 480.0 * (temperature - surface).powf(4.0 / 3.0);
            let latent = row.latent_heat(temperature);
            let (mut low, mut high) = (20.0, temperature);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if air.flux_from_surface(&row, middle) * latent > brought(middle) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            let expected = brought(low) / latent;
            let found = air.flux(&row, temperature);
            assert!(
                (found - expected).abs() < 0.02 * expected + 1e-9,
                "{acid} {temperature}: {found} {expected}"
            );
        }
    }
}

#[test]
fn nothing_evaporates_at_the_airs_temperature() {
    let table = SolutionTable::new();
    let air = StillAir::at(&table, 20.0);
    for temperature in [-5.0, 10.0, 20.0] {
        assert_eq!(air.flux(&table.at(0.0), temperature), 0.0);
    }
}

#[test]
fn liquid_of_any_temperature_evaporates_by_a_number() {
    let table = SolutionTable::new();
    let air = StillAir::at(&table, 20.0);
    for temperature in [200.0, 500.0, 1_000.0, 1_100.0, 1e4, 1e6] {
        for acid in [0.0, 0.5, 1.0] {
            let flux = air.flux(&table.at(acid), temperature);
            assert!(
                flux.is_finite() && flux >= 0.0,
                "{acid} {temperature}: {flux}"
            );
        }
    }
}

/// Unmixed layers show water and acid, of which acid gives off none at 90 °C: what leaves is water's flux from water's part of the
/// surface, which is that of the volume. A mixture's is that of its composition.
#[test]
fn unmixed_layers_evaporate_as_their_water_does() {
    let table = SolutionTable::new();
    let air = StillAir::at(&table, 20.0);
    let (acid, temperature) = (0.5, 90.0);
    let (area, time) = (1e-6, 1e-3);
    let flux = |variance: f64| {
        let particle = Potential {
            mass: 1e-5,
            acid,
            temperature,
            enthalpy: table.enthalpy(acid, temperature),
            capacity: table.at(acid).capacity_at(temperature),
            variance,
        };
        evaporated(&table, &air, &particle, area, time).mass / (area * time)
    };
    let share = acid / 0.98;
    let volume = |acid: f64, mass: f64| mass / table.at(acid).density_at(temperature);
    let water = volume(0.0, 1.0 - share) / (volume(0.0, 1.0 - share) + volume(0.98, share));
    let expected = water * air.flux(&table.at(0.0), temperature);
    let unmixed = flux(0.999 * acid * (0.98 - acid));
    assert!(
        (unmixed / expected - 1.0).abs() < 0.05,
        "{unmixed} {expected}"
    );
    let mixed = air.flux(&table.at(acid), temperature);
    assert!((flux(0.0) / mixed - 1.0).abs() < 1e-12);
    // As they mix, it goes from the one to the other.
    let [nearly, half] = [1e-7, 0.25].map(|part| flux(part * acid * (0.98 - acid)));
    assert!((nearly / mixed - 1.0).abs() < 0.01, "{nearly} {mixed}");
    assert!(half > mixed && half < unmixed, "{half}");
}
