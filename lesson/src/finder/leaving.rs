//! How liquid leaves each flask: it is what was under way there that is the cause of where it ends.

use glam::Vec3;
use vitriol_sim::bodies;
use vitriol_sim::solver::Place;

use super::{Bench, PAUSE, Seen};
use crate::event::Cause;

/// Tilt from which on a user pours, as the cosine of the axis with the vertical: 20°, at which a beaker that is seven eighths full
/// begins to. Our choice.
const POURS: f32 = 0.94;

/// Temperature of the hottest that a flask which boils holds at least, °C: nothing here boils below 100 °C, and a degree is noise.
const BOILS: f32 = 99.0;

/// How long after it boiled last liquid still leaves for that reason, s. Our choice.
const AFTER: f64 = PAUSE;

/// Why liquid leaves a flask.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Its user tilts it.
    Pouring,
    /// It is upright, and boils.
    Boiling,
    /// It broke.
    Breaking,
    /// Nobody holds it, and it does not stand.
    LettingGo,
    /// None of these: what fell in splashed, or it was moved.
    #[default]
    Splashing,
}

#[derive(Clone, Copy, Debug, Default)]
struct Leaving {
    /// When the last left, s, and why.
    last: Option<(f64, Mode)>,
    /// When it boiled last, s.
    boiled: Option<f64>,
    broken: bool,
}

/// By flask.
#[derive(Clone, Debug, Default)]
pub(crate) struct Leavings(Vec<Leaving>);

impl Leavings {
    pub fn looked(&mut self, bench: &Bench, seen: &Seen<'_>) {
        self.0.resize(bench.names.len(), Leaving::default());
        for broken in seen.breaks {
            if let Some(leaving) = self.0.get_mut(broken.flask) {
                leaving.broken = true;
                // What is in it may lie at once.
                leaving.last = Some((seen.t, Mode::Breaking));
            }
        }
        for (flask, leaving) in self.0.iter_mut().enumerate() {
            let Some(held) = seen.census.flasks.get(flask) else {
                continue;
            };
            // Bubbles of air that a stream took down are none of steam.
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
                (true, ..) => Mode::Breaking,
                (_, true, true) => Mode::Pouring,
                // A vessel on a stand, such as a funnel, is tilted by its scene.
                (_, true, false) if !bench.lifted[flask] => Mode::Pouring,
                (_, true, false) => Mode::LettingGo,
                _ if recently(leaving.boiled) => Mode::Boiling,
                _ => Mode::Splashing,
            };
            leaving.last = Some((seen.t, mode));
        }
    }

    /// Why what left that flask last did, at `now`. Where nothing has for a while, it is drops of its bubbles, which are no particles.
    pub fn mode(&self, flask: usize, now: f64) -> Mode {
        let leaving = self.0.get(flask).copied().unwrap_or_default();
        let recently = |at: f64| now - at <= AFTER;
        match leaving.last {
            Some((at, mode)) if recently(at) => mode,
            _ if leaving.boiled.is_some_and(recently) => Mode::Boiling,
            last => last.map_or(Mode::default(), |(_, mode)| mode),
        }
    }

    /// Whether a flask boils at `now`, or did a moment ago.
    pub fn boils(&self, flask: usize, now: f64) -> bool {
        let boiled = self.0.get(flask).and_then(|leaving| leaving.boiled);
        boiled.is_some_and(|at| now - at <= AFTER)
    }

    /// [`Leavings::mode`], in words of an incident.
    pub fn cause(&self, bench: &Bench, flask: usize, now: f64) -> Cause {
        let flask_name = bench.name(flask);
        match self.mode(flask, now) {
            Mode::Pouring => Cause::Pouring { from: flask_name },
            Mode::Boiling => Cause::Boiling { flask: flask_name },
            Mode::Breaking => Cause::Breaking { flask: flask_name },
            Mode::LettingGo => Cause::LettingGo { flask: flask_name },
            Mode::Splashing => Cause::Splashing { flask: flask_name },
        }
    }
}
