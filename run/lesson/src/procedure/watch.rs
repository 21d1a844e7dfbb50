//! Whether the condition of a step is met.

use std::collections::BTreeSet;

use super::condition::{Condition, Poured, SashIs, TemperatureIs};
use super::progress::Why;
use super::sight::{Dip, Sight};
use crate::event::{Pour, Surface};

/// m³ of a volume in mL. Divided, so that 5 mL have the bits of 5e-6.
pub(super) fn m3(ml: f64) -> f64 {
    ml / 1e6
}

/// How long a flask that was put down must stand, s: else one that slips from a hand onto the bench and falls would count. Our choice.
const SETTLED: f64 = 0.5;
/// Least speed of a rod that stirs, m/s: a slower rod is held by a hand that trembles. Our choice.
const STIRS: f64 = 0.02;
/// Tolerance of times, s, and of sums, as a share: times are rounded to nanoseconds, so that each span is off by up to one.
const ROUNDING: f64 = 1e-8;

/// State of one condition that is neither `all` nor `any`.
#[derive(Clone, Debug, Default)]
struct Leaf {
    /// When it was met, s; of a condition on the present state, when that was observed.
    met: Option<f64>,
    /// Time since when it holds, s.
    since: Option<f64>,
    /// Sum so far: m³ or s.
    sum: f64,
    /// Volume at the first observation, which does not count, m³.
    base: Option<f64>,
}

impl Leaf {
    /// Takes in whether the condition holds at `t`; it is met once it has held for `long`, s.
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

    /// Meets the condition at `t` if the sum has reached `needed`.
    fn gathers(&mut self, t: f64, needed: f64) {
        if self.sum >= needed - ROUNDING * needed {
            self.met.get_or_insert(t);
        }
    }
}

/// State of a condition's leaves, in the order of the file.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    leaves: Vec<Leaf>,
    /// Time of the last observation, s.
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

    /// Takes in a pour that counts for the step. Returns the first failure by it, in any part of the condition.
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

    /// Takes in an observation. `lifted`: flasks that a hand has held.
    pub fn see(&mut self, condition: &Condition, sight: &Sight, lifted: &BTreeSet<String>) {
        let t = sight.t_s;
        let before = self.seen.replace(t);
        let elapsed = before.map_or(0.0, |before| (t - before).max(0.0));
        for (leaf, condition) in self.pairs(condition) {
            sees(leaf, condition, (sight, elapsed), lifted);
        }
    }

    /// Takes in that the question, which is the whole condition, was answered at `t`, s.
    pub fn answer(&mut self, t: f64) {
        self.leaves = vec![Leaf {
            met: Some(t),
            ..Leaf::default()
        }];
    }

    /// When the condition was met, s, if it still holds.
    pub fn met(&self, condition: &Condition) -> Option<f64> {
        met(condition, &mut self.leaves.iter())
    }

    /// The parts that are neither `all` nor `any`, in the order of the file, without those that are met or are of an `any` that is.
    pub fn left<'a>(&self, condition: &'a Condition) -> Vec<&'a Condition> {
        let mut found = Vec::new();
        left(condition, &mut self.leaves.iter(), &mut found);
        found
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

/// Appends the parts that are left to `found`; whether there are any.
fn left<'a>(
    condition: &'a Condition,
    known: &mut dyn Iterator<Item = &Leaf>,
    found: &mut Vec<&'a Condition>,
) -> bool {
    let before = found.len();
    match condition {
        Condition::All(parts) => {
            for part in parts {
                left(part, known, found);
            }
        }
        Condition::Any(parts) => {
            // Each part takes its own leaves.
            let open: Vec<bool> = parts.iter().map(|part| left(part, known, found)).collect();
            if open.contains(&false) {
                found.truncate(before);
            }
        }
        part => {
            if known.next().is_none_or(|leaf| leaf.met.is_none()) {
                found.push(part);
            }
        }
    }
    found.len() > before
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
        // `all` and `any` are judged by their parts, pours by their events, and questions by their answers.
        Condition::All(_) | Condition::Any(_) | Condition::Poured(_) | Condition::Answered(_) => {}
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
