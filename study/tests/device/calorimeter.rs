//! The calorimeter against the table of adiabatic mixing.

use vitriol_study::calorimeter::{Feed, Mixed, Resolution, mix};
use vitriol_tests::gpu;

/// Half the resolution of the preset `fast`.
const COARSE: Resolution = Resolution {
    particles: 500,
    iterations: 2,
};

fn feed(millilitres: f64, acid: f64) -> Feed {
    Feed {
        volume: 1e-6 * millilitres,
        temperature: 20.0,
        acid,
    }
}

/// Mixes 20 °C water and acid of 98 %, the lower one first, and checks the result.
fn check(feeds: [Feed; 2], mass_fraction: f64, temperature: f64) -> Mixed {
    let mixed = mix(&gpu::device(), feeds, COARSE, 1).unwrap();
    assert!(mixed.even, "{mixed:?}");
    // 2 K are allowed, at the worst; it is 0.3 K here.
    let off = mixed.end.temperature_mean - temperature;
    assert!(off.abs() < 1.0, "{off} K");
    let held = mixed.end.ledger.unwrap();
    let acid = held.acid / (held.mass - held.vapour);
    assert!((acid - mass_fraction).abs() < 0.005, "{acid}");
    // Rounding of f32: pairs exchange the same number with opposite signs.
    for drift in mixed.drifts {
        assert!(drift < 1e-6, "{:?}", mixed.drifts);
    }
    assert_eq!(mixed.lost, 0);
    mixed
}

/// The table's rows: enthalpies by Wagman et al. (1982), boiling by the boiling
/// points of the composition.
#[test]
fn mixes_end_as_the_table_says_whoever_is_poured_first() {
    let (water, acid) = (feed(100.0, 0.0), feed(100.0, 0.98));
    for feeds in [[water, acid], [acid, water]] {
        let mixed = check(feeds, 0.635, 149.1);
        let held = mixed.end.ledger.unwrap();
        // 1.3 g of 283.
        let vapour = held.vapour / held.mass;
        assert!((vapour - 1.3 / 283.4).abs() < 0.002, "{vapour}");
        assert!(mixed.peak_superheat > 1.0, "it boils on its way");
    }
    check([feed(10.0, 0.0), acid], 0.929, 75.5);
    check([acid, feed(400.0, 0.0)], 0.309, 82.9);
}
