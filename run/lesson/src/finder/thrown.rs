//! Liquid that leaves a flask as it boils: whole particles that come to lie or fall into another flask, and drops of bubbles, which are
//! not particles.

use vitriol_sim::bodies;
use vitriol_sim::solver::{Place, SCALDS};

use super::amount::{Amount, Bit};
use super::flows::Flows;
use super::leaving::{LeavingCause, Leavings};
use super::{Bench, PAUSE, Seen};
use crate::event::{Cause, Event, What};

/// Liquid that boiling throws out, one entry a flask.
#[derive(Clone, Debug, Default)]
pub(crate) struct Thrown {
    open: Vec<Option<(Amount, Cause)>>,
    /// By flask, volume that had sprayed out at the previous observation, m³ of the scene; `None` before the first.
    sprayed: Option<Vec<f64>>,
}

impl Thrown {
    pub fn looked(
        &mut self,
        bench: &Bench,
        seen: &Seen<'_>,
        (leavings, flows): (&Leavings, &Flows),
        said: &mut Vec<Event>,
    ) {
        let flasks = bench.names.len();
        self.open.resize(flasks, None);
        let sprayed = self.sprayed.replace(seen.census.sprayed.clone());
        for flask in 0..flasks {
            let rim = match seen.poses.get(flask) {
                Some(pose) if !bodies::is_nowhere(pose) => bench.rim(pose, flask),
                _ => continue,
            };
            let held = seen.census.flasks.get(flask);
            let temperature = held.and_then(|held| bench.content(held).temperature_c);
            let mut bits = Vec::new();
            if leavings.mode(flask, seen.t) == LeavingCause::Boiling {
                let others = (0..flasks).filter(|it| *it != flask).map(Place::Flask);
                // Liquid that touches the user comes to lie as well, so it is not counted here.
                let all = [Place::Table, Place::Floor].into_iter().chain(others);
                let moved = all.map(|place| seen.census.moved(place, flask));
                bits.extend(moved.filter(|it| it.particles > 0).map(|moved| Bit {
                    volume: bench.volume(moved.volume),
                    acid: moved.acid,
                    place: rim,
                    temperature,
                }));
            }
            let now = seen.census.sprayed.get(flask).copied().unwrap_or_default();
            let before = sprayed.as_ref().and_then(|it| it.get(flask).copied());
            let more = now - before.unwrap_or(now);
            // Bubbles of air throw drops too.
            if more > 0.0 && leavings.boils(flask, seen.t) {
                bits.push(Bit {
                    volume: bench.volume(more),
                    acid: held.map_or(0.0, |it| f64::from(it.acid)),
                    place: rim,
                    temperature,
                });
            }
            for bit in bits {
                let (amount, _) = self.open[flask].get_or_insert_with(|| {
                    let cause = flows.why_hot(bench, flask, seen.t);
                    (Amount::at(seen.t), cause)
                });
                amount.add(seen.t, &bit);
            }
        }
        self.close(bench, seen.t, said);
    }

    /// Emits what is over at `now` and can harm.
    pub fn close(&mut self, bench: &Bench, now: f64, said: &mut Vec<Event>) {
        for (flask, open) in self.open.iter_mut().enumerate() {
            let Some((amount, cause)) = open.take_if(|(amount, _)| amount.is_over(now, PAUSE))
            else {
                continue;
            };
            let scalds = amount.temperature().is_some_and(|it| it >= SCALDS);
            let acid = amount.volume * amount.acid();
            let limits = &bench.limits;
            let harms = match scalds {
                true => amount.volume >= limits.least_thrown_m3,
                false => acid >= limits.least_thrown_acid_m3,
            };
            if !harms {
                continue;
            }
            let what = What::BoiledOver {
                flask: bench.name(flask),
                volume_m3: amount.volume,
                acid: amount.acid(),
            };
            said.push(amount.incident(bench, what, cause));
        }
    }
}
