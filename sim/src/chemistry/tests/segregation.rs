//! The closure below a particle against lamellae that are solved: acid diffuses across a pair of layers by a
//! diffusivity that follows viscosity, all of it has one temperature, and nothing of it is presumed.

use super::super::physical::Content;
use super::super::segregation::{USUAL_FEED as FEED, decay_rate, diffusivity, without_water};
use super::super::table::{Row, SolutionTable};
use vitriol_tests::random::Random;

const MEANS: [f64; 8] = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.86, 0.9];
const CELLS: usize = 48;

/// Half of a pair of layers, in cells of one mass, from the middle of the water on.
struct Layers {
    acid: Vec<f64>,
    enthalpy: f64,
}

impl Layers {
    /// Water and acid of these temperatures (°C), of which the mean is `mean`.
    fn new(table: &SolutionTable, mean: f64, [water, acid]: [f64; 2]) -> Self {
        let share = mean / FEED;
        let enthalpy =
            (1.0 - share) * table.enthalpy(0.0, water) + share * table.enthalpy(FEED, acid);
        let edge = (1.0 - share) * CELLS as f64;
        let cell = |k: usize| FEED * ((k + 1) as f64 - edge).clamp(0.0, 1.0);
        Self {
            acid: (0..CELLS).map(cell).collect(),
            enthalpy,
        }
    }

    fn mean(&self, of: impl Fn(f64) -> f64) -> f64 {
        self.acid.iter().map(|&c| of(c)).sum::<f64>() / CELLS as f64
    }

    fn variance(&self) -> f64 {
        let mean = self.mean(|c| c);
        self.mean(|c| (c - mean).powi(2))
    }

    /// T of all of it, °C: its heat capacity is linear in T as each cell's is.
    fn temperature(&self, table: &SolutionTable) -> f64 {
        let row = Row {
            enthalpy: self.mean(|c| table.at(c).enthalpy),
            capacity: self.mean(|c| table.at(c).capacity),
            capacity_rise: self.mean(|c| table.at(c).capacity_rise),
            ..Row::default()
        };
        row.temperature(self.enthalpy)
    }

    /// A step of diffusion as long as an explicit one may be: through mass, flux ρ²D·∂c/∂m.
    fn diffuse(&mut self, table: &SolutionTable) {
        let temperature = self.temperature(table);
        let rate = |c: f64| {
            let row = table.at(c);
            row.density_at(temperature).powi(2) * diffusivity(&row, temperature)
        };
        let rates: Vec<_> = self.acid.iter().map(|&c| rate(c)).collect();
        let most = rates.iter().fold(0.0, |a: f64, &b| a.max(b));
        let flux: Vec<_> = (0..CELLS - 1)
            .map(|k| 0.5 * (rates[k] + rates[k + 1]) * (self.acid[k + 1] - self.acid[k]))
            .collect();
        for k in 0..CELLS {
            let above = flux.get(k).copied().unwrap_or(0.0);
            let below = if k > 0 { flux[k - 1] } else { 0.0 };
            self.acid[k] += 0.45 / most * (above - below);
        }
    }

    /// Water that leaves at once, over the mass, if all that is above its boiling point boils until it is at
    /// it, and all stays of one temperature.
    fn steam(&self, table: &SolutionTable) -> f64 {
        let lost = |temperature: f64| {
            // Boiling liquid ends at the fraction that boils at T.
            let (mut low, mut high) = (0.0, FEED);
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                if table.at(middle).boiling_point < temperature {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let end = low.max(1e-9);
            let steam = self.mean(|c| (1.0 - c / end).max(0.0));
            let steam_enthalpy = 2.442e6 + 1.9e3 * (temperature - 25.0);
            let held = self.mean(|c| {
                let left = (c / end).min(1.0);
                left * table.enthalpy(c.max(end), temperature)
            });
            (steam, held + steam * steam_enthalpy - self.enthalpy)
        };
        let (mut low, mut high) = (99.0, 200.0f64.min(self.temperature(table)));
        if high <= low {
            return 0.0;
        }
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            // The hotter, the more has boiled.
            if lost(middle).1 > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        lost(low).0
    }
}

/// Largest superheat (K) and steam at once (share of the mass) on the way from layers to a mixture.
fn of_layers(table: &SolutionTable, mean: f64, feeds: [f64; 2]) -> [f64; 2] {
    let mut layers = Layers::new(table, mean, feeds);
    let mut most = [f64::NEG_INFINITY, 0.0f64];
    let start = layers.variance();
    for step in 0.. {
        let superheat = layers.temperature(table) - table.at(layers.acid[0]).boiling_point;
        most[0] = most[0].max(superheat);
        if step % 40 == 0 && superheat > 0.0 {
            most[1] = most[1].max(layers.steam(table));
        }
        layers.diffuse(table);
        if layers.variance() < 1e-4 * start {
            break;
        }
    }
    most
}

/// Largest superheat (K) and steam at once (share of the mass) as in [`of_layers`], by the closure from c and s² while s² falls from
/// that of unmixed layers to 0.
fn of_closure(table: &SolutionTable, mean: f64, feeds: [f64; 2]) -> [f64; 2] {
    let mut most = [f64::NEG_INFINITY, 0.0f64];
    for k in 1..400 {
        let content = Content {
            mass: 1.0,
            acid: mean,
            enthalpy: Layers::new(table, mean, feeds).enthalpy,
            vapour: 0.0,
            variance: mean * (FEED - mean) * (1.0 - f64::from(k) / 400.0),
        };
        most[0] = most[0].max(content.superheat(table));
        most[1] = most[1].max(content.equilibrium(table, 60));
    }
    most
}

#[test]
fn lamellae_are_as_hot_as_when_they_are_solved() {
    let table = SolutionTable::new();
    for feeds in [[20.0, 20.0], [60.0, 20.0], [20.0, 60.0]] {
        let rows = MEANS.map(|mean| {
            [
                of_layers(&table, mean, feeds),
                of_closure(&table, mean, feeds),
            ]
        });
        let steam = rows.iter().fold(0.0, |a: f64, row| a.max(row[0][1]));
        for (mean, [solved, own]) in MEANS.iter().zip(rows) {
            let case = format!("{feeds:?} {mean}: {own:?} {solved:?}");
            if solved[0] > 0.0 || own[0] > 0.0 {
                assert!((own[0] - solved[0]).abs() < 4.0, "{case}");
            }
            assert!((own[1] - solved[1]).abs() < 0.25 * steam, "{case}");
        }
    }
}

/// Of a constant diffusivity through mass, as computed by others for feeds of 20 °C.
#[test]
fn superheat_is_that_of_published_lamellae() {
    let table = SolutionTable::new();
    let known = [-24.0, -4.0, 14.0, 24.0, 16.0, -15.0, -41.0];
    for (mean, known) in MEANS.into_iter().zip(known) {
        let [own, _] = of_closure(&table, mean, [20.0, 20.0]);
        if own > 0.0 || known > 0.0 {
            assert!((own - known).abs() < 4.0, "{mean}: {own} {known}");
        }
    }
}

#[test]
fn a_mixture_is_a_mixture() {
    let table = SolutionTable::new();
    for acid in [0.0, 0.3, 0.6, 0.9, 0.98, 1.0] {
        assert_eq!(table.of_lamellae(acid, 0.0), table.at(acid));
        // And nearly mixed is nearly that.
        let row = table.of_lamellae(acid, 1e-10);
        let mixed = table.at(acid);
        assert!(
            (row.enthalpy - mixed.enthalpy).abs() < 60.0,
            "{acid}: {row:?}"
        );
        assert!(
            (row.boiling_point - mixed.boiling_point).abs() < 0.1,
            "{acid}: {row:?}"
        );
        let content = Content::liquid(&table, 1.0, acid, 160.0).unwrap();
        let segregated = Content {
            variance: 1e-10,
            ..content
        };
        let [ordinary, own] = [content, segregated].map(|c| c.equilibrium(&table, 60));
        assert!((ordinary - own).abs() < 2e-4, "{acid}: {ordinary} {own}");
    }
    // Unmixed layers have the heat of both.
    let layers = table.lamellae().excess(0.5, 0.5 * 0.48);
    let known = -table.at(0.5).enthalpy + 0.5 / FEED * table.at(FEED).enthalpy;
    assert!(
        (layers.enthalpy / known - 1.0).abs() < 0.02,
        "{layers:?} {known}"
    );
    assert!((layers.depth - 0.5).abs() < 0.01, "{layers:?}");
}

/// Unmixed layers of water and a weaker acid are as unmixed as those of 98 %: their heat is that of both, and there is pure water.
#[test]
fn layers_of_a_weaker_acid_are_unmixed_too() {
    for feed in [0.6, 0.8, 0.92] {
        let mean = feed - 0.1;
        let table = SolutionTable::fed_by(feed);
        let layers = table.lamellae().excess(mean, mean * (feed - mean));
        assert!((layers.depth - mean).abs() < 0.01, "{feed}: {layers:?}");
        let known = mean / feed * table.at(feed).enthalpy - table.at(mean).enthalpy;
        assert!(
            (layers.enthalpy / known - 1.0).abs() < 0.03,
            "{feed}: {layers:?} {known}"
        );
        let water = table.of_lamellae(mean, mean * (feed - mean));
        assert!(
            (water.boiling_point - 100.0).abs() < 0.2,
            "{feed}: {water:?}"
        );
        // A feed has one table, whoever asks for it.
        assert!(std::ptr::eq(
            table.lamellae(),
            SolutionTable::fed_by(feed).lamellae()
        ));
    }
}

/// Parts of any composition, of which the poorest loses some of its water: by counting.
#[test]
fn water_that_leaves_leaves_its_acid() {
    let mut random = Random(4);
    for _ in 0..100 {
        let parts: Vec<_> = (0..6)
            .map(|_| {
                let part = random.point(1.0);
                (0.1 + part.x.abs(), 0.05 + 0.9 * part.y.abs())
            })
            .collect();
        let moments = |parts: &[(f64, f64)]| {
            let mass: f64 = parts.iter().map(|part| part.0).sum();
            let mean = parts.iter().map(|part| part.0 * part.1).sum::<f64>() / mass;
            let squares = parts.iter().map(|part| part.0 * (part.1 - mean).powi(2));
            (mass, mean, squares.sum::<f64>() / mass)
        };
        let (mass, mean, variance) = moments(&parts);
        let mut after = parts.clone();
        let poorest = (0..6)
            .min_by(|&a, &b| parts[a].1.total_cmp(&parts[b].1))
            .unwrap();
        // So little that the part's own fraction hardly changes.
        let gone = 1e-5 * mass;
        after[poorest].0 -= gone;
        after[poorest].1 *= parts[poorest].0 / after[poorest].0;
        let (_, _, known) = moments(&after);
        let own = without_water(variance, mean, parts[poorest].1, 1e-5);
        assert!((own - known).abs() < 1e-8, "{own} {known} from {variance}");
    }
}

#[test]
fn molecules_and_eddies_mix_lamellae_in_their_time() {
    let table = SolutionTable::new();
    let water = table.at(0.0);
    // 1.7e-9 m²/s in water of 25 °C; the first mode of 0.3 mm has D·(π/δ)² = 0.19/s, its square twice that.
    let still = decay_rate(&water, 25.0, 0.0, 3e-4);
    assert!((still / 0.373 - 1.0).abs() < 0.03, "{still}");
    // 0.058·(ε/ν)^½ with 1 mW/kg and ν = 0.89e-6 m²/s.
    let stirred = decay_rate(&water, 25.0, 1e-3, 1.0);
    assert!((stirred / 1.944 - 1.0).abs() < 0.03, "{stirred}");
    // Acid of 98 % and 20 °C is 25 times as viscous as water.
    let slow = diffusivity(&table.at(FEED), 20.0) / diffusivity(&water, 20.0);
    assert!((slow * 25.0 - 1.0).abs() < 0.03, "{slow}");
}

/// The device has three secant steps, from the vapour that is there. What they leave is left to the next
/// substep: 2e-3 of the mass at 25 K.
#[test]
fn three_steps_find_the_vapour_of_lamellae() {
    let table = SolutionTable::new();
    for mean in [0.2, 0.4, 0.6, 0.8] {
        for share in [0.9, 0.5, 0.1, 0.01, 1e-4] {
            for superheat in [-20.0, -2.0, 1.0, 5.0, 25.0] {
                let variance = share * mean * (FEED - mean);
                let row = table.of_lamellae(mean, variance);
                let content = Content {
                    mass: 1.0,
                    acid: mean,
                    enthalpy: row.enthalpy_at(row.boiling_point + superheat),
                    vapour: 0.0,
                    variance,
                };
                let [few, many] = [3, 100].map(|steps| content.equilibrium(&table, steps));
                let case = format!("{mean} {share} {superheat} K: {few} {many}");
                assert!((few - many).abs() < 2e-3, "{case}");
                assert!(superheat < 0.0 || many > 0.0, "{case}");
                // And there the most watery part has its boiling point.
                let boiled = Content {
                    vapour: many,
                    variance: without_water(
                        variance,
                        mean,
                        mean - table.lamellae().excess(mean, variance).depth,
                        many,
                    ),
                    ..content
                };
                assert!(
                    superheat < 0.0 || boiled.superheat(&table).abs() < 0.05,
                    "{case}"
                );
            }
        }
    }
}
