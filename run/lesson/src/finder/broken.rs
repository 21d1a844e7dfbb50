//! Glass that is let go of and strikes bench or floor, and glass that breaks.

use super::{Bench, PAUSE, Seen};
use crate::event::{Cause, Event, Incident, What};

/// The last blow that a flask took.
#[derive(Clone, Copy, Debug)]
struct Blow {
    /// Speed at real size, m/s.
    speed: f64,
    /// Whether nobody held the flask, and what it struck was no other flask.
    falling: bool,
}

#[derive(Clone, Debug, Default)]
struct Fall {
    /// Whether a hand has held it since its last fall.
    let_go: bool,
    blow: Option<Blow>,
    /// Its incident, kept until the bounces are over: they belong to the same fall, and a break is reported as the next step begins.
    waits: Option<Incident>,
}

/// Falls of glass, one entry a flask.
#[derive(Clone, Debug, Default)]
pub(crate) struct GlassFalls(Vec<Fall>);

impl GlassFalls {
    pub fn looked(&mut self, bench: &Bench, seen: &Seen<'_>, said: &mut Vec<Event>) {
        self.0.resize(bench.names.len(), Fall::default());
        for (flask, fall) in self.0.iter_mut().enumerate() {
            if let Some(broken) = seen.breaks.iter().find(|it| it.flask == flask) {
                let at = broken.stage_from_flask.position;
                let speed = fall.blow.map_or(0.0, |blow| blow.speed);
                // A flask that broke in a hand or against another flask was not let go of.
                let let_go = fall.let_go && fall.blow.is_some_and(|blow| blow.falling);
                let made = || dropped(bench, seen.t, flask, let_go, speed, at);
                let incident = fall.waits.get_or_insert_with(made);
                if let What::Dropped { broke, .. } = &mut incident.what {
                    *broke = true;
                }
            }
            fall.let_go |= seen.held.get(flask) == Some(&true);
            let over = |incident: &mut Incident| seen.t - incident.t_s > PAUSE;
            said.extend(fall.waits.take_if(over).map(Event::Incident));
        }
        for strike in seen.strikes {
            let held = seen.held.get(strike.flask) == Some(&true);
            let speed = bench.speed(f64::from(strike.speed));
            let Some(fall) = self.0.get_mut(strike.flask) else {
                continue;
            };
            let falling = !held && strike.other.is_none();
            fall.blow = Some(Blow { speed, falling });
            if !falling || speed < bench.limits.least_blow_m_s {
                continue;
            }
            let let_go = std::mem::take(&mut fall.let_go);
            let (t, flask, at) = (seen.t, strike.flask, strike.position);
            let made = || dropped(bench, t, flask, let_go, speed, at);
            let incident = fall.waits.get_or_insert_with(made);
            // A flask that falls from the bench onto the floor strikes harder there.
            if let What::Dropped { speed_m_s, .. } = &mut incident.what {
                *speed_m_s = speed_m_s.max(speed);
            }
            incident.until_s = t;
        }
    }

    /// Emits the incidents that are kept back.
    pub fn close(&mut self, said: &mut Vec<Event>) {
        let waits = self.0.iter_mut().filter_map(|fall| fall.waits.take());
        said.extend(waits.map(Event::Incident));
    }
}

fn dropped(
    bench: &Bench,
    t: f64,
    flask: usize,
    let_go: bool,
    speed_m_s: f64,
    at: glam::Vec3,
) -> Incident {
    let flask = bench.name(flask);
    Incident {
        t_s: t,
        until_s: t,
        what: What::Dropped {
            flask: flask.clone(),
            speed_m_s,
            broke: false,
        },
        cause: match let_go {
            true => Cause::LettingGo { flask },
            false => Cause::Unknown,
        },
        place_m: bench.place(at.as_dvec3()),
    }
}
