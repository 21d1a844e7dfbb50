//! Pours from flask to flask or beside: how fast, and whether acid and water meet in the wrong order or too fast.

use std::collections::{BTreeMap, VecDeque};

use vitriol_sim::solver::{Moved, Place};

use super::amount::{Amount, Bit};
use super::leaving::{LeavingCause, Leavings};
use super::{Bench, PAUSE, Seen};
use crate::event::{Cause, Content, Event, Incident, Pour, What};

/// Duration over which a flow rate is averaged, s: a stream of particles is uneven, and a tenth of a second would hold some dozen.
const WINDOW: f64 = 0.5;
/// Liquids whose acid mass fractions differ by less give off no heat to speak of when mixed. Our choice.
const ALIKE: f64 = 0.1;
/// Time after a pour, or after layers were in a hand, during which heat is still caused by it, s. Our choice.
const WARMS: f64 = 10.0;

/// A flow under way from one flask to one place.
#[derive(Clone, Debug)]
struct Flow {
    amount: Amount,
    met: Option<Content>,
    bare_face: bool,
    window: VecDeque<(f64, f64)>,
    fastest: f64,
    /// Portions below `concentrated` that met acid above it, and the acid fraction that the first of them met.
    wrong: Option<(Amount, f64)>,
    /// Begin and end of the time in which acid and water came together too fast, s, and the highest rate then, m³/s.
    too_fast: Option<[f64; 3]>,
}

/// A pour under way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stream {
    /// What has arrived so far, m³ at real size.
    pub volume_m3: f64,
    /// Mean flow rate over the last half second, m³/s, which [`Pour::fastest_m3_s`] is the highest of.
    pub rate_m3_s: f64,
}

/// Source and target flask of a flow; the target is `None` for bench and floor.
type Way = (usize, Option<usize>);

/// Flows under way and what they met. Finished flows become [`Pour`]s and incidents.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flows {
    open: BTreeMap<Way, Flow>,
    /// When liquid that mixes with its target last arrived, by source and target, s.
    last: BTreeMap<Way, f64>,
    /// When a hand last held the flask whose layers the scene begins with, s.
    carried: Option<f64>,
    /// Contents of each flask at the previous observation.
    before: Vec<Option<Content>>,
}

impl Flows {
    pub fn looked(
        &mut self,
        bench: &Bench,
        seen: &Seen<'_>,
        leavings: &Leavings,
        said: &mut Vec<Event>,
    ) {
        let flasks = bench.names.len();
        for from in 0..flasks {
            let beside = [Place::Table, Place::Floor].map(|it| seen.census.moved(it, from));
            let into = (0..flasks).filter(|into| *into != from).map(|into| {
                let moved = seen.census.moved(Place::Flask(into), from);
                (Some(into), vec![moved])
            });
            for (into, moved) in into.chain([(None, beside.to_vec())]) {
                self.come(
                    bench,
                    seen,
                    (from, into),
                    &moved,
                    leavings.mode(from, seen.t),
                );
            }
        }
        self.close(bench, seen.t, said);
        let in_hand = |flask: usize| seen.held.get(flask) == Some(&true);
        if bench.layered.is_some_and(in_hand) {
            self.carried = Some(seen.t);
        }
        let held = seen.census.flasks.iter();
        self.before = held
            .map(|held| (held.particles > 0).then(|| bench.content(held)))
            .collect();
    }

    fn come(
        &mut self,
        bench: &Bench,
        seen: &Seen<'_>,
        way: Way,
        moved: &[Moved],
        mode: LeavingCause,
    ) {
        let came = moved.iter().any(|it| it.particles > 0);
        if !came || (mode != LeavingCause::Pouring && !self.open.contains_key(&way)) {
            return;
        }
        let t = seen.t;
        let into = way.1.and_then(|into| seen.census.flasks.get(into));
        let place = into.map_or(seen.census.table.came.position, |it| it.came.position);
        let before = way
            .1
            .and_then(|into| self.before.get(into).copied().flatten());
        let flow = self.open.entry(way).or_insert_with(|| Flow {
            // The liquid arrived during the step before this observation, so the flow began with that step.
            amount: Amount::at(seen.before),
            met: before,
            bare_face: false,
            window: VecDeque::new(),
            fastest: 0.0,
            wrong: None,
            too_fast: None,
        });
        flow.bare_face |= seen.worn.goggles == Some(false);
        for moved in moved.iter().filter(|it| it.particles > 0) {
            let bit = Bit {
                volume: bench.volume(moved.volume),
                acid: moved.acid,
                place,
                temperature: None,
            };
            flow.amount.add(t, &bit);
            flow.window.push_back((t, bit.volume));
            let concentrated = bench.limits.concentrated;
            if let Some(met) = before
                && met.acid >= concentrated
                && bit.acid < concentrated
            {
                let (wrong, _) = flow
                    .wrong
                    .get_or_insert_with(|| (Amount::at(seen.before), met.acid));
                wrong.add(t, &bit);
            }
        }
        // Half a step of tolerance, since times are sums of steps and rounded.
        let oldest = t - WINDOW + 0.5 * seen.elapsed;
        while flow.window.front().is_some_and(|(at, _)| *at < oldest) {
            flow.window.pop_front();
        }
        let rate = flow.window.iter().map(|(_, volume)| volume).sum::<f64>() / WINDOW;
        flow.fastest = flow.fastest.max(rate);
        let mixes = before.is_some_and(|met| (met.acid - flow.amount.acid()).abs() > ALIKE);
        if mixes {
            self.last.insert(way, t);
            if rate > bench.limits.rate_m3_s {
                let [_, until, most] = flow.too_fast.get_or_insert([t, t, rate]);
                (*until, *most) = (t, most.max(rate));
            }
        }
    }

    /// Emits the flows that are over at `now`.
    pub fn close(&mut self, bench: &Bench, now: f64, said: &mut Vec<Event>) {
        let (over, open) = std::mem::take(&mut self.open)
            .into_iter()
            .partition(|(_, flow)| flow.amount.is_over(now, PAUSE));
        self.open = open;
        let over: BTreeMap<Way, Flow> = over;
        for (way, flow) in over {
            flow.say(bench, way, said);
        }
    }

    /// The largest pour under way at `now` (s): drops that fall beside it are another flow.
    pub fn under_way(&self, bench: &Bench, now: f64) -> Option<Stream> {
        let into_glass = self.open.iter().filter(|((_, to), _)| to.is_some());
        let largest = into_glass
            .map(|(_, flow)| flow)
            .max_by(|a, b| a.amount.volume.total_cmp(&b.amount.volume));
        let flow = largest.filter(|it| it.amount.volume >= bench.limits.least_pour_m3)?;
        // With a microsecond of tolerance, since times are sums of steps and rounded.
        let oldest = now - WINDOW + 1e-6;
        let lately = flow.window.iter().filter(|(at, _)| *at > oldest);
        Some(Stream {
            volume_m3: flow.amount.volume,
            rate_m3_s: lately.map(|(_, volume)| volume).sum::<f64>() / WINDOW,
        })
    }

    /// The flask from which liquid that mixes was last poured into `into`, if that was within `WARMS` before `now`.
    pub fn mixed(&self, into: usize, now: f64) -> Option<usize> {
        let recent = self
            .last
            .iter()
            .filter(|((_, to), at)| *to == Some(into) && now - **at <= WARMS);
        recent
            .max_by(|a, b| a.1.total_cmp(b.1))
            .map(|((from, _), _)| *from)
    }

    /// Cause of the heat of that flask's liquid. Layers that nobody moved and nothing heats mix by themselves, or by what is dipped.
    pub fn why_hot(&self, bench: &Bench, flask: usize, now: f64) -> Cause {
        let name = bench.name(flask);
        let layers = bench.layered == Some(flask);
        let carried = self.carried.is_some_and(|at| now - at <= WARMS);
        match self.mixed(flask, now) {
            Some(_) => Cause::Mixing { flask: name },
            None if layers && carried => Cause::Swirling { flask: name },
            None if bench.heated.get(flask) == Some(&true) => Cause::Heating { flask: name },
            None if layers => Cause::Mixing { flask: name },
            None => Cause::Unknown,
        }
    }
}

impl Flow {
    fn say(self, bench: &Bench, (from, into): Way, said: &mut Vec<Event>) {
        let amount = &self.amount;
        if amount.volume < bench.limits.least_pour_m3 {
            return;
        }
        let cause = || Cause::Pouring {
            from: bench.name(from),
        };
        said.push(Event::Poured(Pour {
            t_s: amount.begun,
            until_s: amount.last,
            from: bench.name(from),
            into: into.map(|into| bench.name(into)),
            volume_m3: amount.volume,
            fastest_m3_s: self.fastest,
            acid: amount.acid(),
            met: self.met,
            bare_face: self.bare_face,
        }));
        let Some(into) = into else {
            return;
        };
        if let Some((wrong, met_acid)) = self.wrong
            && wrong.volume >= bench.limits.least_pour_m3
        {
            let what = What::WaterIntoAcid {
                flask: bench.name(into),
                met_acid,
                volume_m3: wrong.volume,
            };
            said.push(wrong.incident(bench, what, cause()));
        }
        if let Some([t_s, until_s, rate_m3_s]) = self.too_fast {
            said.push(Event::Incident(Incident {
                t_s,
                until_s,
                what: What::PouredTooFast {
                    flask: bench.name(into),
                    rate_m3_s,
                    limit_m3_s: bench.limits.rate_m3_s,
                },
                cause: cause(),
                place_m: bench.place(amount.place()),
            }));
        }
    }
}
