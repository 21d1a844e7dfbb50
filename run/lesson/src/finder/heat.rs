//! Liquid that becomes hot.

use vitriol_sim::bodies;

use super::flows::Flows;
use super::{Bench, Seen};
use crate::event::{Cause, Event, Hottest, Incident, What};

/// How far below the limit a liquid must cool to end its incident, K: a temperature that wavers about the limit is one incident. Our
/// choice.
const COOLER: f64 = 2.0;

#[derive(Clone, Debug)]
struct Hot {
    begun: f64,
    last: f64,
    hottest: f64,
    cause: Cause,
    place: [f64; 3],
}

/// Flasks whose mean temperature is above the limit, and the hottest particle of the attempt.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeatFinder {
    /// The hottest particle of the attempt.
    pub hottest: Option<Hottest>,
    /// By flask, the incident under way.
    open: Vec<Option<Hot>>,
    /// By flask, whether its liquid has been below the limit: a scene that begins hot is nobody's fault.
    colder: Vec<bool>,
}

impl HeatFinder {
    pub fn looked(&mut self, bench: &Bench, seen: &Seen<'_>, flows: &Flows, said: &mut Vec<Event>) {
        self.hottest_of(bench, seen);
        self.open.resize_with(bench.names.len(), || None);
        self.colder.resize(bench.names.len(), false);
        for (flask, open) in self.open.iter_mut().enumerate() {
            let held = seen.census.flasks.get(flask);
            let Some(mean) = held.and_then(|it| it.temperature).map(f64::from) else {
                // The flask was emptied, or it broke.
                say(bench, flask, open, said);
                continue;
            };
            match open {
                Some(hot) if mean > bench.limits.hot_c - COOLER => {
                    hot.last = seen.t;
                    hot.hottest = hot.hottest.max(mean);
                }
                Some(_) => say(bench, flask, open, said),
                None if mean < bench.limits.hot_c => self.colder[flask] = true,
                None if self.colder[flask] => {
                    let pose = seen.poses.get(flask).filter(|it| !bodies::is_nowhere(it));
                    *open = Some(Hot {
                        begun: seen.t,
                        last: seen.t,
                        hottest: mean,
                        cause: flows.why_hot(bench, flask, seen.t),
                        place: bench
                            .place(pose.map_or(glam::DVec3::ZERO, |it| it.position.as_dvec3())),
                    });
                }
                None => {}
            }
        }
    }

    fn hottest_of(&mut self, bench: &Bench, seen: &Seen<'_>) {
        let census = seen.census;
        let flasks = census.flasks.iter().enumerate();
        let flasks = flasks.map(|(flask, held)| (Some(flask), held));
        let beside = [&census.air, &census.table, &census.floor].map(|held| (None, held));
        for (flask, held) in flasks.chain(beside) {
            let Some(temperature_c) = held.hottest.map(f64::from) else {
                continue;
            };
            let most = self
                .hottest
                .as_ref()
                .map_or(f64::MIN, |it| it.temperature_c);
            if temperature_c > most {
                self.hottest = Some(Hottest {
                    t_s: seen.t,
                    flask: flask.map(|flask| bench.name(flask)),
                    temperature_c,
                });
            }
        }
    }

    /// Emits the incidents under way.
    pub fn close(&mut self, bench: &Bench, said: &mut Vec<Event>) {
        for (flask, open) in self.open.iter_mut().enumerate() {
            say(bench, flask, open, said);
        }
    }
}

fn say(bench: &Bench, flask: usize, open: &mut Option<Hot>, said: &mut Vec<Event>) {
    let Some(hot) = open.take() else {
        return;
    };
    said.push(Event::Incident(Incident {
        t_s: hot.begun,
        until_s: hot.last,
        what: What::Hot {
            flask: bench.name(flask),
            temperature_c: hot.hottest,
        },
        cause: hot.cause,
        place_m: hot.place,
    }));
}
