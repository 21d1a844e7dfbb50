//! Whether what a step is done by has come about.

use std::collections::BTreeSet;

use super::condition::{Condition, Poured, SashIs, TemperatureIs};
use super::progress::Why;
use super::sight::{Dip, Sight};
use crate::event::{Pour, Surface};

/// m³ of a volume in mL. Divided, so that 5 mL have the bits of 5e-6.
pub(super) fn m3(ml: f64) -> f64 {
    ml / 1e6
}

/// How long a flask that was put down stands, s: else one that slips from a hand onto the bench and falls would count. Our choice.
const SETTLED: f64 = 0.5;
/// Least speed of a rod that stirs, m/s. Our choice: slower it is held, by a hand that trembles.
const STIRS: f64 = 0.02;
/// Times are sums of steps and rounded, s.
const ROUNDING: f64 = 1e-9;

/// What is known of one condition that is neither `all` nor `any`.
#[derive(Clone, Debug, Default)]
struct Leaf {
    /// When it came about; of one that is so only now, when it was seen.
    met: Option<f64>,
    /// Since when it is so, s.
    since: Option<f64>,
    /// What has come together: m³ or s.
    sum: f64,
    /// What was there when it was seen first, m³.
    base: Option<f64>,
}

impl Leaf {
    /// It is so now, or not, and must be for so long, s.
    fn lasts(&mut self, so: bool, t: f64, long: f64) {
        if !so {
            (self.since, self.met) = (None, None);
            return;
        }
        let since = *self.since.get_or_insert(t);
        if t - since >= long - ROUNDING {
            self.met.get_or_insert(t);
        }
    }

    /// So much has come together, where so much is needed.
    fn gathers(&mut self, t: f64, needed: f64) {
        if self.sum >= needed - ROUNDING * needed {
            self.met.get_or_insert(t);
        }
    }
}

/// See the module: what is known of a condition's leaves, in the order of the file.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    leaves: Vec<Leaf>,
    /// When it saw last, s.
    seen: Option<f64>,
}

fn leaves<'a>(condition: &'a Condition, found: &mut Vec<&'a Condition>) {
    match condition {
        Condition::All(parts) | Condition::Any(parts) => {
            parts.iter().for_each(|part| leaves(part, found));
        }
        leaf => found.push(leaf),
    }
}

impl Watch {
    fn pairs<'a>(
        &'a mut self,
        condition: &'a Condition,
    ) -> impl Iterator<Item = (&'a mut Leaf, &'a Condition)> {
        let mut found = Vec::new();
        leaves(condition, &mut found);
        self.leaves.resize(found.len(), Leaf::default());
        self.leaves.iter_mut().zip(found)
    }

    /// A pour that counts. The first failure of it, in any part of the condition.
    pub fn pour(&mut self, condition: &Condition, pour: &Pour) -> Option<Why> {
        let mut failed = None;
        for (leaf, condition) in self.pairs(condition) {
            if let Condition::Poured(poured) = condition
                && let Some(why) = pours(leaf, poured, pour)
            {
                failed.get_or_insert(why);
            }
        }
        failed
    }

    /// What is so at an instant. `lifted`: flasks that a hand has held.
    pub fn see(&mut self, condition: &Condition, sight: &Sight, lifted: &BTreeSet<String>) {
        let t = sight.t_s;
        let before = self.seen.replace(t);
        let elapsed = before.map_or(0.0, |before| (t - before).max(0.0));
        for (leaf, condition) in self.pairs(condition) {
            sees(leaf, condition, (sight, elapsed), lifted);
        }
    }

    /// When it came about, if it is so now.
    pub fn met(&self, condition: &Condition) -> Option<f64> {
        met(condition, &mut self.leaves.iter())
    }
}

fn met(condition: &Condition, known: &mut dyn Iterator<Item = &Leaf>) -> Option<f64> {
    // Each part takes its own leaves, met or not.
    let mut each = |parts: &[Condition]| -> Vec<Option<f64>> {
        parts.iter().map(|part| met(part, known)).collect()
    };
    match condition {
        Condition::All(parts) => {
            let found: Option<Vec<f64>> = each(parts).into_iter().collect();
            found?.into_iter().reduce(f64::max)
        }
        Condition::Any(parts) => each(parts).into_iter().flatten().reduce(f64::min),
        _ => known.next()?.met,
    }
}

fn pours(leaf: &mut Leaf, poured: &Poured, pour: &Pour) -> Option<Why> {
    let its = pour.from == poured.from && pour.into.as_ref() == Some(&poured.into);
    if !its || !poured.liquid.is(pour.acid) {
        return None;
    }
    leaf.sum += pour.volume_m3;
    if let Some(limit) = poured.at_most_ml_s
        && pour.fastest_m3_s > m3(limit)
    {
        return Some(Why::TooFast {
            rate_m3_s: pour.fastest_m3_s,
            limit_m3_s: m3(limit),
        });
    }
    if let Some(limit) = poured.at_most_ml
        && leaf.sum > m3(limit)
    {
        return Some(Why::TooMuch {
            volume_m3: leaf.sum,
            limit_m3: m3(limit),
        });
    }
    leaf.gathers(pour.until_s, m3(poured.at_least_ml));
    None
}

fn sees(
    leaf: &mut Leaf,
    condition: &Condition,
    (sight, elapsed): (&Sight, f64),
    lifted: &BTreeSet<String>,
) {
    let t = sight.t_s;
    let dips = |dip: &Option<Dip>, flask: &str| {
        dip.as_ref()
            .is_some_and(|it| it.flask.as_deref() == Some(flask))
    };
    match condition {
        // Those are looked into part by part, and pours are heard of.
        Condition::All(_) | Condition::Any(_) | Condition::Poured(_) => {}
        Condition::Lifted(it) => {
            let held = sight.flask(&it.flask).is_some_and(|flask| flask.held);
            leaf.lasts(held, t, 0.0);
        }
        Condition::PutDown(it) => {
            let flask = sight.flask(&it.flask);
            let stands = flask.is_some_and(|flask| flask.standing && !flask.held);
            leaf.lasts(stands && lifted.contains(&it.flask), t, SETTLED);
        }
        Condition::Holds(it) => {
            let holds = sight.flask(&it.flask).is_some_and(|flask| {
                let percent = 100.0 * flask.acid;
                let range = it.acid_from_percent..=it.acid_to_percent;
                flask.volume_m3 >= m3(it.at_least_ml) && range.contains(&percent)
            });
            leaf.lasts(holds, t, it.for_s);
        }
        Condition::Temperature(it) => {
            let mean = sight.flask(&it.flask).and_then(|flask| flask.temperature_c);
            let TemperatureIs {
                at_least_c,
                at_most_c,
                ..
            } = it;
            let fits = mean.is_some_and(|mean| is_within(mean, *at_least_c, *at_most_c));
            leaf.lasts(fits, t, 0.0);
        }
        Condition::Goggles(it) => leaf.lasts(sight.goggles == Some(it.on), t, 0.0),
        Condition::Gloves(it) => {
            let so = sight.gloves.is_some_and(|gloves| match it.hand {
                Some(hand) => gloves[hand.index()] == it.on,
                None => gloves == [it.on; 2],
            });
            leaf.lasts(so, t, 0.0);
        }
        Condition::Sash(SashIs {
            at_least_m,
            at_most_m,
        }) => {
            let height = sight.sash_m;
            let fits = height.is_some_and(|height| is_within(height, *at_least_m, *at_most_m));
            leaf.lasts(fits, t, 0.0);
        }
        Condition::Stirred(it) => {
            let moves = sight.rod.as_ref().is_some_and(|rod| rod.speed_m_s >= STIRS);
            if moves && dips(&sight.rod, &it.flask) {
                leaf.sum += elapsed;
            }
            leaf.gathers(t, it.at_least_s);
        }
        Condition::Measured(it) => {
            leaf.lasts(dips(&sight.thermometer, &it.flask), t, it.for_s);
        }
        Condition::Wiped(it) => {
            let lies = match it.surface {
                Surface::Bench => sight.bench_m3,
                Surface::Floor => sight.floor_m3,
            };
            leaf.lasts(lies <= m3(it.at_most_ml), t, 0.0);
        }
        Condition::Rinsed(it) => {
            if let Some(hands) = sight.rinsed_m3 {
                let came = hands[it.hand.index()];
                leaf.sum = came - *leaf.base.get_or_insert(came);
                leaf.gathers(t, m3(it.at_least_ml));
            }
        }
    }
}

fn is_within(value: f64, least: Option<f64>, most: Option<f64>) -> bool {
    least.is_none_or(|least| value >= least) && most.is_none_or(|most| value <= most)
}
