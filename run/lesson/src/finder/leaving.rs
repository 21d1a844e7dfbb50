//! How liquid leaves each flask: this is the cause of what the liquid does elsewhere.

use glam::Vec3;
use vitriol_sim::bodies;
use vitriol_sim::solver::Place;

use super::{Bench, PAUSE, Seen};
use crate::event::Cause;

/// Tilt from which on a user pours, as the cosine of the axis with the vertical: 20°, at which a beaker that is seven eighths full begins
/// to pour. Our choice.
const POURS: f32 = 0.94;

/// Least temperature of the hottest particle in a flask that boils, °C: nothing here boils below 100 °C, and a degree is noise.
const BOILS: f32 = 99.0;

/// How long after a flask boiled last liquid still leaves it by boiling, s. Our choice.
const AFTER: f64 = PAUSE;

/// Why liquid leaves a flask.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum LeavingCause {
    /// Its user tilts it.
    Pouring,
    /// It is upright, and boils.
    Boiling,
    /// It broke.
    Breaking,
    /// Nobody holds it, and it is tilted.
    LettingGo,
    /// None of these: something fell in and splashed, or the flask was moved.
    #[default]
    Splashing,
}

#[derive(Clone, Copy, Debug, Default)]
struct Leaving {
    /// When liquid last left, s, and how.
    last: Option<(f64, LeavingCause)>,
    /// When the flask boiled last, s.
    boiled: Option<f64>,
    broken: bool,
}

/// How liquid leaves, one entry a flask.
#[derive(Clone, Debug, Default)]
pub(crate) struct Leavings(Vec<Leaving>);

impl Leavings {
    pub fn looked(&mut self, bench: &Bench, seen: &Seen<'_>) {
        self.0.resize(bench.names.len(), Leaving::default());
        for broken in seen.breaks {
            if let Some(leaving) = self.0.get_mut(broken.flask) {
                leaving.broken = true;
                // Its liquid may come to lie within one step, and is then never observed in the air.
                leaving.last = Some((seen.t, LeavingCause::Breaking));
            }
        }
        for (flask, leaving) in self.0.iter_mut().enumerate() {
            let Some(held) = seen.census.flasks.get(flask) else {
                continue;
            };
            // Bubbles of air that a stream carries down are not steam.
            let hot = held.hottest.is_some_and(|hottest| hottest >= BOILS);
            if hot && (held.bubbles.here.count > 0 || !bench.bubbles) {
                leaving.boiled = Some(seen.t);
            }
            let is_held = seen.held.get(flask) == Some(&true);
            if seen.census.moved(Place::Air, flask).particles == 0 {
                continue;
            }
            let pose = seen
                .poses
                .get(flask)
                .filter(|pose| !bodies::is_nowhere(pose));
            let tilted = pose.is_some_and(|pose| (pose.orientation * Vec3::Y).y < POURS);
            let recently = |at: Option<f64>| at.is_some_and(|at| seen.t - at <= AFTER);
            let mode = match (leaving.broken || pose.is_none(), tilted, is_held) {
                (true, ..) => LeavingCause::Breaking,
                (_, true, true) => LeavingCause::Pouring,
                // A vessel on a stand, such as a funnel, is tilted by its scene.
                (_, true, false) if !bench.lifted[flask] => LeavingCause::Pouring,
                (_, true, false) => LeavingCause::LettingGo,
                _ if recently(leaving.boiled) => LeavingCause::Boiling,
                _ => LeavingCause::Splashing,
            };
            leaving.last = Some((seen.t, mode));
        }
    }

    /// How liquid last left that flask, as of `now`. If no particle has left for a while and it boils, drops of its bubbles do, which are
    /// not particles.
    pub fn mode(&self, flask: usize, now: f64) -> LeavingCause {
        let leaving = self.0.get(flask).copied().unwrap_or_default();
        let recently = |at: f64| now - at <= AFTER;
        match leaving.last {
            Some((at, mode)) if recently(at) => mode,
            _ if leaving.boiled.is_some_and(recently) => LeavingCause::Boiling,
            last => last.map_or(LeavingCause::default(), |(_, mode)| mode),
        }
    }

    /// Whether a flask boils at `now`, or did within the last `AFTER` seconds.
    pub fn boils(&self, flask: usize, now: f64) -> bool {
        let boiled = self.0.get(flask).and_then(|leaving| leaving.boiled);
        boiled.is_some_and(|at| now - at <= AFTER)
    }

    /// [`Leavings::mode`] as the cause of an incident.
    pub fn cause(&self, bench: &Bench, flask: usize, now: f64) -> Cause {
        let flask_name = bench.name(flask);
        match self.mode(flask, now) {
            LeavingCause::Pouring => Cause::Pouring { from: flask_name },
            LeavingCause::Boiling => Cause::Boiling { flask: flask_name },
            LeavingCause::Breaking => Cause::Breaking { flask: flask_name },
            LeavingCause::LettingGo => Cause::LettingGo { flask: flask_name },
            LeavingCause::Splashing => Cause::Splashing { flask: flask_name },
        }
    }
}
