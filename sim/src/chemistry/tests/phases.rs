//! Boiling, condensing and the end states that a chemist would check.

use super::super::adiabatic::{Feed, Mixture, mix};
use super::super::physical::{Content, FLASH_STEPS, Steam};
use super::super::properties::AZEOTROPE;
use super::super::table::{SolutionTable, steam_enthalpy};
use super::super::{OutOfRange, check_content};

/// Water and 98 % acid at 20 °C, mL, as masses in kg.
fn of_volumes(water: f64, acid: f64) -> [Feed; 2] {
    [(water * 0.998e-3, 0.0), (acid * 1.836e-3, 0.98)].map(|(mass, acid)| Feed {
        mass,
        acid,
        temperature: 20.0,
    })
}

#[test]
fn adiabatic_mixing_meets_the_table() {
    // Water and acid (mL), mass percent, temperature without and with
    // boiling, evaporated (g): NBS heats with Perry's heat capacities,
    // computed elsewhere.
    let known = [
        (10.0, 100.0, 92.9, 75.5, 75.5, 0.0),
        (50.0, 100.0, 77.1, 154.5, 154.5, 0.0),
        (100.0, 100.0, 63.5, 154.1, 149.1, 1.3),
        (200.0, 100.0, 47.0, 121.9, 120.5, 0.6),
        (400.0, 100.0, 30.9, 82.9, 82.9, 0.0),
        (100.0, 10.0, 15.2, 48.5, 48.5, 0.0),
    ];
    let table = SolutionTable::new();
    let mut squares = 0.0;
    for (water, acid, percent, unboiled, end, evaporated) in known {
        let own = mix(&table, &of_volumes(water, acid)).unwrap();
        let feed = 183.6 * 0.98 * acid / (99.8 * water + 183.6 * acid);
        assert!((100.0 * feed - percent).abs() < 0.06, "{water} {acid}");
        assert!((own.temperature_unboiled - unboiled).abs() < 1.0, "{own:?}");
        // A gram of water takes 2.5 kJ, 5 K of 280 g.
        assert!(
            (1000.0 * own.evaporated - evaporated).abs() < 0.35,
            "{own:?}"
        );
        squares += (own.temperature - end).powi(2);
    }
    let rms = (squares / 6.0f64).sqrt();
    assert!(rms < 0.6, "{rms}");
}

#[test]
fn order_of_the_feeds_does_not_matter() {
    let table = SolutionTable::new();
    let feeds = of_volumes(100.0, 100.0);
    let there = mix(&table, &feeds).unwrap();
    let back = mix(&table, &[feeds[1], feeds[0]]).unwrap();
    // Sums of two numbers commute to the last bit.
    assert_eq!(there, back);
}

#[test]
fn worked_example_of_the_textbook() {
    // 1 lb of 100 % at 150 °F and 1 lb of 20 % at 200 °F end at 148.9 °C
    // and 63 % with 0.095 lb evaporated, read off an enthalpy-concentration
    // chart, which has 2 K in it.
    let pound = 0.453_592_37;
    let table = SolutionTable::new();
    let celsius = |fahrenheit: f64| (fahrenheit - 32.0) / 1.8;
    let own = mix(
        &table,
        &[
            Feed {
                mass: pound,
                acid: 1.0,
                temperature: celsius(150.0),
            },
            Feed {
                mass: pound,
                acid: 0.2,
                temperature: celsius(200.0),
            },
        ],
    )
    .unwrap();
    assert!((own.temperature - 148.9).abs() < 2.0, "{own:?}");
    assert!((own.evaporated / pound - 0.095).abs() < 0.005, "{own:?}");
    assert!((own.acid - 0.63).abs() < 0.003, "{own:?}");
}

#[test]
fn volume_contracts() {
    // 100 mL and 100 mL make 184.4 mL at 20 °C.
    let table = SolutionTable::new();
    let Mixture { mass, .. } = mix(&table, &of_volumes(100.0, 100.0)).unwrap();
    let [water, acid] = of_volumes(100.0, 100.0);
    let all = water.mass + acid.mass;
    assert!(mass < all);
    let density = table.at(0.98 * acid.mass / all).density_at(20.0);
    assert!((1e6 * all / density - 184.4).abs() < 0.2, "{density}");
}

/// Contents of all compositions, from cold to far beyond the boiling point.
fn contents(table: &SolutionTable, mut visit: impl FnMut(Content)) {
    for i in 0..=40 {
        let acid = f64::from(i) / 40.0;
        let boiling = table.at(acid).boiling_point;
        for excess in [-50.0, -1.0, 0.0, 1.0, 5.0, 10.0, 30.0, 80.0, 300.0, 1e6] {
            visit(Content::liquid(table, 1.6e-5, acid, boiling + excess).unwrap());
        }
    }
}

#[test]
fn equilibrium_is_at_the_boiling_point() {
    let table = SolutionTable::new();
    contents(&table, |content| {
        let superheat = content.superheat(&table);
        let end = Content {
            vapour: content.equilibrium(&table, 100),
            ..content
        };
        let most = (1.0 - content.acid / AZEOTROPE).clamp(0.0, 0.99);
        // Rounding of the state is 1e-13 K.
        if superheat <= 1e-9 {
            assert!(end.vapour < 1e-9, "{content:?} {end:?}");
        } else if end.vapour < most {
            let left = end.superheat(&table);
            assert!(end.vapour > 0.0 && left.abs() < 1e-3, "{content:?} {left}");
        } else {
            assert!(end.superheat(&table) > -1e-3, "{content:?}");
        }
    });
}

#[test]
fn few_steps_are_enough() {
    let table = SolutionTable::new();
    contents(&table, |content| {
        let superheat = content.superheat(&table);
        let error =
            (content.equilibrium(&table, FLASH_STEPS) - content.equilibrium(&table, 100)).abs();
        // A substep meets some kelvins; 80 K of superheat is 8 % of vapour.
        if superheat < 81.0 {
            assert!(error < 1e-4, "{content:?} {superheat}: {error}");
        }
    });
}

#[test]
fn boiling_and_what_leaves_keep_mass_acid_and_enthalpy() {
    let table = SolutionTable::new();
    contents(&table, |before| {
        let mut content = before;
        let (mut mass, mut enthalpy) = (0.0, 0.0);
        for step in 0..50 {
            content.boil(&table, 1e-3, 0.01);
            assert!((0.0..=1.0).contains(&content.vapour), "{content:?}");
            let water = content.liquid_mass() * (1.0 - content.liquid_acid());
            let leaves = 1e-6 * f64::from(step % 11) * water;
            let specific = steam_enthalpy(content.temperature(&table));
            let gone = Steam {
                mass: leaves,
                enthalpy: leaves * specific,
            };
            content.take_out_water(&table, &gone);
            mass += leaves;
            enthalpy += leaves * specific;
            assert!((0.0..=1.0).contains(&content.acid), "{content:?}");
        }
        let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-12 * scale;
        assert!(close(content.mass + mass, before.mass, before.mass));
        let acid = before.mass * before.acid;
        assert!(close(content.mass * content.acid, acid, before.mass));
        let total = before.mass * before.enthalpy;
        let scale = total.abs() + before.mass * 3e6;
        assert!(close(
            content.mass * content.enthalpy + enthalpy,
            total,
            scale
        ));
        // No colder than the boiling point, and no superheat left but where
        // no water is: 50 ms are five time constants.
        if before.superheat(&table) > 0.0 && content.acid < 0.98 {
            let left = content.superheat(&table);
            assert!(left > -0.5, "{before:?} {content:?} {left}");
        }
    });
}

#[test]
fn vapour_condenses_in_cold_liquid() {
    let table = SolutionTable::new();
    let mut content = Content::liquid(&table, 1.0, 0.5, 130.0).unwrap();
    while content.vapour < 0.9 * content.equilibrium(&table, 100) {
        content.boil(&table, 1e-3, 0.01);
    }
    let vapour = content.vapour;
    assert!(vapour > 1e-3);
    content.enthalpy -= 1e5;
    for _ in 0..200 {
        content.boil(&table, 1e-3, 0.01);
    }
    assert!(content.vapour < 1e-6 * vapour, "{content:?}");
}

/// The way to equilibrium shrinks by 1/e in the time constant, whatever the
/// steps.
#[test]
fn superheat_decays_with_its_time_constant() {
    let table = SolutionTable::new();
    let start = Content::liquid(&table, 1.0, 0.5, 128.0).unwrap();
    let end = start.equilibrium(&table, 100);
    assert!(end > 1e-3);
    for steps in [1, 40, 4000] {
        let mut content = start;
        for _ in 0..steps {
            content.boil(&table, 0.4 / f64::from(steps), 0.4);
        }
        let left = 1.0 - content.vapour / end;
        // Equilibrium itself is found to 1e-4 of 5e-3 at first.
        let off = left / (-1.0f64).exp() - 1.0;
        assert!(off.abs() < 0.02, "{steps}: {left}");
    }
}

#[test]
fn ten_kelvin_make_as_much_steam_as_a_balance_says() {
    // Of 63 % acid, cp·S/L = 0.9 % (0.97 % with pure water's L); what evaporates also raises the boiling
    // point, by c·dT_b/dc = 1.5 K a percent, which leaves 0.8 %.
    let table = SolutionTable::new();
    let row = table.at(0.63);
    let boiling = row.boiling_point;
    let content = Content::liquid(&table, 1.0, 0.63, boiling + 10.0).unwrap();
    let (capacity, latent) = (row.capacity_at(boiling), row.latent_heat(boiling));
    let evaporated = 10.0 * capacity / latent;
    assert!((evaporated - 0.0090).abs() < 0.0002, "{evaporated}");
    let rise = 0.63 * (table.at(0.64).boiling_point - table.at(0.62).boiling_point) / 0.02;
    let expected = 10.0 * capacity / (latent + capacity * rise);
    let equilibrium = content.equilibrium(&table, 100);
    assert!(
        (equilibrium / expected - 1.0).abs() < 0.03,
        "{equilibrium} {expected}"
    );
}

#[test]
fn input_out_of_range_is_refused() {
    let table = SolutionTable::new();
    for acid in [-1e-9, 1.0 + 1e-9, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            check_content(acid, 20.0),
            Err(OutOfRange::Acid(_))
        ));
        assert!(Content::liquid(&table, 1.0, acid, 20.0).is_err());
    }
    for temperature in [-273.15, f64::NAN, f64::INFINITY] {
        let refused = check_content(0.5, temperature);
        assert!(matches!(refused, Err(OutOfRange::Temperature(_))));
    }
    for mass in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Content::liquid(&table, mass, 0.5, 20.0);
        assert!(matches!(refused, Err(OutOfRange::Mass(_))));
    }
    assert!(mix(&table, &[]).is_err());
}
