//! How violently a run boiled, found in its samples.

use vitriol_lesson::Boiling;

use crate::sample::{LedgerSample, Sample};

/// Volume of a kilogram of steam at the boiling point of water and one atmosphere, m³/kg: R T/p of an ideal gas, with water's
/// R = 461.5 J/(kg K).
const STEAM: f64 = 461.5 * 373.15 / 101_325.0;
/// Time over which steam is averaged, s: bubbles burst one by one, and a tenth of a second would hold few. Our choice.
const WINDOW: f64 = 0.5;
/// Time from the first contact of acid and water, or of layers from the first bubble, in which what leaves counts as thrown, s. Our choice.
const FIRST: f64 = 2.0;
/// Tolerance of times, which are sums of steps, s.
const ROUNDING: f64 = 1e-6;

/// How violently the run of these samples boiled. `bubbles`: whether its scene models them. `contact`: when acid and water first came
/// together, s, and in which flask.
pub fn boiling(samples: &[Sample], bubbles: bool, contact: Option<(f64, &str)>) -> Boiling {
    let gas = samples.iter().filter_map(ledger).map(|it| it.bubbles_m3);
    let heights = samples.iter().filter_map(|it| it.highest_drop_m);
    Boiling {
        most_steam_m_s: most_steam(samples),
        most_gas_m3: gas.reduce(f64::max).filter(|_| bubbles),
        thrown_first_kg: contact.and_then(|contact| thrown(samples, contact)),
        highest_drop_m: heights.reduce(f64::max),
        nuclei_spacing_m: None,
    }
}

fn ledger(sample: &Sample) -> Option<&LedgerSample> {
    sample.heat.as_ref()?.ledger.as_ref()
}

fn most_steam(samples: &[Sample]) -> Option<f64> {
    let speeds = samples.iter().enumerate().filter_map(|(index, end)| {
        let is_before = |begin: &&Sample| end.t_s - begin.t_s >= WINDOW - ROUNDING;
        let begin = samples[..index].iter().rev().find(is_before)?;
        let left = ledger(end)?.steam_kg - ledger(begin)?.steam_kg;
        let (flask, surface) = hottest_surface(end)?;
        // Of what has just boiled away or out little is left, over which earlier steam came.
        let before = begin.surface_m2.get(flask).copied().unwrap_or_default();
        Some(STEAM * left / ((end.t_s - begin.t_s) * surface.max(before)))
    });
    speeds.reduce(f64::max)
}

/// The flask with the hottest particle, and the surface of its liquid, m².
fn hottest_surface(sample: &Sample) -> Option<(&str, f64)> {
    let heat = sample.heat.as_ref()?;
    let hottest = heat
        .temperatures_in_flasks_c
        .iter()
        .max_by(|(_, [_, a]), (_, [_, b])| a.total_cmp(b));
    let (flask, _) = hottest?;
    Some((flask, *sample.surface_m2.get(flask)?))
}

/// What left the flask in the first seconds after contact, kg; `None` where the run ends before. Layers are in contact from the start and
/// lie still, so theirs begin with the first bubble.
fn thrown(samples: &[Sample], (contact, flask): (f64, &str)) -> Option<f64> {
    let boils = |it: &&Sample| ledger(it).is_some_and(|it| it.bubbles_m3 > 0.0);
    let lay_together = contact < ROUNDING;
    let first_bubble = samples.iter().find(boils).filter(|_| lay_together);
    let contact = first_bubble.map_or(contact, |it| it.t_s);
    let until = contact + FIRST;
    if samples.last()?.t_s < until - ROUNDING {
        return None;
    }
    let left = |t: f64| {
        let before = samples.iter().rev().find(|it| it.t_s <= t + ROUNDING);
        // At the first sample nothing has left yet.
        let left = before.and_then(|it| it.left_kg.get(flask));
        left.copied().unwrap_or_default()
    };
    Some(left(until) - left(contact))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::sample::HeatSample;

    /// Seconds of the run.
    const LASTS: usize = 4;

    /// Ten samples a second. From 1.0 s to 1.5 s 2 g of steam leave a hot flask with a surface of 0.005 m², and before and after it a
    /// tenth as much in a second. Its gas is 3 mL at most; 40 mg leave it in each second; a drop is 12 cm over its rim at 2.3 s.
    fn series() -> Vec<Sample> {
        let of = |index: usize| {
            let t = 0.1 * index as f64;
            let burst = (t - 1.0).clamp(0.0, 0.5) / 0.5;
            let ledger = LedgerSample {
                steam_kg: 2e-4 * t + 2e-3 * burst,
                bubbles_m3: 3e-6 * (1.0 - (t - 2.0).abs() / 2.0),
                ..LedgerSample::default()
            };
            Sample {
                t_s: t,
                left_kg: BTreeMap::from([("hot".into(), 4e-5 * t), ("cold".into(), 0.02 * t)]),
                surface_m2: BTreeMap::from([("hot".into(), 5e-3), ("cold".into(), 1e-3)]),
                highest_drop_m: match index {
                    22 => Some(0.07),
                    23 => Some(0.12),
                    _ => None,
                },
                heat: Some(HeatSample {
                    temperatures_in_flasks_c: BTreeMap::from([
                        ("hot".into(), [20.0, 140.0]),
                        ("cold".into(), [20.0, 21.0]),
                    ]),
                    ledger: Some(ledger),
                    ..HeatSample::default()
                }),
                ..Sample::default()
            }
        };
        (0..=10 * LASTS).map(of).collect()
    }

    fn is_near(found: Option<f64>, expected: f64) {
        let found = found.unwrap();
        assert!(
            (found / expected - 1.0).abs() < 1e-9,
            "{found}, not {expected}"
        );
    }

    #[test]
    fn figures_are_those_of_the_worst_moment() {
        let found = boiling(&series(), true, Some((0.5, "hot")));
        // 1.69957 m³/kg · (2 g + 0.1 g) / (0.5 s · 0.005 m²).
        is_near(found.most_steam_m_s, STEAM * 2.1e-3 / (0.5 * 5e-3));
        assert!((STEAM - 1.699_57).abs() < 1e-5);
        is_near(found.most_gas_m3, 3e-6);
        is_near(found.thrown_first_kg, 8e-5);
        assert_eq!(found.highest_drop_m, Some(0.12));
    }

    /// In a flask that is nearly empty at the end of the window the steam came over what was there at its beginning.
    #[test]
    fn steam_of_a_flask_that_empties_came_over_what_was_there() {
        let mut emptied = series();
        emptied.truncate(16);
        emptied[15].surface_m2.insert("hot".into(), 1e-5);
        let found = boiling(&emptied, true, None);
        is_near(found.most_steam_m_s, STEAM * 2.1e-3 / (0.5 * 5e-3));
    }

    /// The same run goes on for twice as long, with nothing but a little steam and drops that are poured off.
    #[test]
    fn no_figure_grows_with_the_length_of_the_run() {
        let (mut long, contact) = (series(), Some((0.5, "hot")));
        let short = boiling(&long, true, contact);
        for index in 0..10 * LASTS {
            let mut next = long.last().unwrap().clone();
            next.t_s = LASTS as f64 + 0.1 * (index + 1) as f64;
            *next.left_kg.get_mut("hot").unwrap() += 1e-3;
            let heat = next.heat.as_mut().unwrap();
            heat.ledger.as_mut().unwrap().steam_kg += 2e-5;
            long.push(next);
        }
        assert_eq!(boiling(&long, true, contact), short);
    }

    /// Layers lie still for 1.5 s, and boil when they are swirled; a second later drops leave.
    #[test]
    fn what_layers_throw_counts_from_the_first_bubble() {
        let mut layers = series();
        for sample in &mut layers {
            let left = if sample.t_s < 2.45 { 0.0 } else { 5e-5 };
            sample.left_kg.insert("hot".into(), left);
            if sample.t_s < 1.45 {
                let heat = sample.heat.as_mut().unwrap();
                heat.ledger.as_mut().unwrap().bubbles_m3 = 0.0;
            }
        }
        let at_the_start = Some((0.0, "hot"));
        let thrown = |of: &[Sample]| boiling(of, true, at_the_start).thrown_first_kg;
        is_near(thrown(&layers), 5e-5);
        for sample in &mut layers {
            let heat = sample.heat.as_mut().unwrap();
            heat.ledger.as_mut().unwrap().bubbles_m3 = 0.0;
        }
        assert_eq!(thrown(&layers), Some(0.0));
    }

    #[test]
    fn what_there_cannot_be_is_absent() {
        let samples = series();
        let found = boiling(&samples, false, None);
        assert!(found.most_gas_m3.is_none() && found.thrown_first_kg.is_none());
        // Too short: half a second of steam, two of what is thrown.
        let short = boiling(&samples[..5], true, Some((0.1, "hot")));
        assert!(short.most_steam_m_s.is_none() && short.thrown_first_kg.is_none());
        assert!(short.most_gas_m3.is_some() && short.highest_drop_m.is_none());
        let cold = samples.iter().map(|sample| Sample {
            heat: None,
            highest_drop_m: None,
            ..sample.clone()
        });
        let cold: Vec<_> = cold.collect();
        assert!(boiling(&cold, true, None).is_empty());
        assert!(boiling(&[], true, Some((0.0, "hot"))).is_empty());
    }
}
