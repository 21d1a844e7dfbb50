//! Liquid that comes to lie beside the flasks.

use vitriol_sim::solver::{Held, Place};

use super::amount::{Amount, Bit};
use super::leaving::Leavings;
use super::{Bench, PAUSE, Seen};
use crate::event::{Cause, Event, Surface, What};

/// Spills under way, by surface and flask: each flask's liquid is a spill of its own, since it has a cause of its own.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spills {
    open: [Vec<Option<(Amount, Cause)>>; 2],
}

const SURFACES: [Surface; 2] = [Surface::Bench, Surface::Floor];

impl Spills {
    pub fn looked(
        &mut self,
        bench: &Bench,
        seen: &Seen<'_>,
        leavings: &Leavings,
        said: &mut Vec<Event>,
    ) {
        let places: [(Place, &Held); 2] = [
            (Place::Table, &seen.census.table),
            (Place::Floor, &seen.census.floor),
        ];
        for (open, (place, held)) in self.open.iter_mut().zip(places) {
            open.resize(bench.names.len(), None);
            for (flask, open) in open.iter_mut().enumerate() {
                let moved = seen.census.moved(place, flask);
                if moved.particles == 0 {
                    continue;
                }
                let (amount, _) = open.get_or_insert_with(|| {
                    (Amount::at(seen.t), leavings.cause(bench, flask, seen.t))
                });
                amount.add(
                    seen.t,
                    &Bit {
                        volume: bench.volume(moved.volume),
                        acid: moved.acid,
                        place: held.came.position,
                        temperature: None,
                    },
                );
            }
        }
        self.close(bench, seen.t, said);
    }

    /// Emits the spills that are over at `now`.
    pub fn close(&mut self, bench: &Bench, now: f64, said: &mut Vec<Event>) {
        for (surface, open) in SURFACES.into_iter().zip(&mut self.open) {
            for open in open {
                // A volume below the limit goes on being summed: a drip is a spill, however slow.
                let least = bench.limits.least_spill_m3;
                let over =
                    |(it, _): &mut (Amount, Cause)| it.is_over(now, PAUSE) && it.volume >= least;
                let Some((amount, cause)) = open.take_if(over) else {
                    continue;
                };
                let what = What::Spilt {
                    surface,
                    volume_m3: amount.volume,
                    acid: amount.acid(),
                };
                said.push(amount.incident(bench, what, cause));
            }
        }
    }
}
