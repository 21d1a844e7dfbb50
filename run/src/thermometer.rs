//! What a thermometer shows: it follows what it is in, with a lag.

use vitriol_lesson::Sight;
use vitriol_sim::scene::Scene;

/// In what time it comes to 1/e of a step in liquid, and in still air, s: a few seconds in stirred water and about a minute in air, as for
/// glass thermometers of 6 mm (J. V. Nicholas and D. R. White, Traceable Temperatures, on time constants). Rounded by us.
const LAG_IN_LIQUID: f64 = 3.0;
const LAG_IN_AIR: f64 = 60.0;
/// A room, °C, in a scene that does not name its own.
const ROOM: f64 = 20.0;

/// A thermometer's reading, which follows the temperature around it with a lag.
pub(crate) struct Thermometer {
    room: f64,
    celsius: f64,
}

impl Thermometer {
    /// A thermometer that lay in the room of that scene.
    pub fn of(scene: &Scene) -> Self {
        let room = scene.physical.and_then(|it| it.ambient);
        let room = room.or_else(|| scene.paper.and_then(|it| it.T_a));
        let room = room.unwrap_or(ROOM);
        Self {
            room,
            celsius: room,
        }
    }

    /// Takes in an observation, `elapsed` (s) after the one before. In liquid it follows the mean of the flask's.
    pub fn looked(&mut self, sight: &Sight, elapsed: f64) {
        let Some(dip) = &sight.thermometer else {
            return;
        };
        let flask = dip.flask.as_ref().and_then(|name| sight.flask(name));
        let (about, lag) = match flask.and_then(|it| it.temperature_c) {
            Some(liquid) => (liquid, LAG_IN_LIQUID),
            None => (self.room, LAG_IN_AIR),
        };
        self.celsius = about + (self.celsius - about) * (-elapsed / lag).exp();
    }

    /// The reading, °C.
    pub fn celsius(&self) -> f64 {
        self.celsius
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::procedure::{Dip, FlaskSight};

    fn sight(flask: Option<&str>) -> Sight {
        Sight {
            flasks: vec![FlaskSight {
                name: "target".to_owned(),
                temperature_c: Some(80.0),
                ..FlaskSight::default()
            }],
            thermometer: Some(Dip {
                flask: flask.map(str::to_owned),
                speed_m_s: 0.0,
            }),
            ..Sight::default()
        }
    }

    /// 63 % of a step in the time constant, however many looks that takes; and hardly any in air.
    #[test]
    fn it_follows_with_a_lag() {
        let scene = Scene::builtin("acid-into-water").unwrap();
        for looks in [1, 270] {
            let mut it = Thermometer::of(&scene);
            assert_eq!(it.celsius(), 20.0);
            for _ in 0..looks {
                it.looked(&sight(Some("target")), 3.0 / f64::from(looks));
            }
            assert!((it.celsius() - (80.0 - 60.0 / 1.0_f64.exp())).abs() < 1e-9);
            let before = it.celsius();
            it.looked(&sight(None), 3.0);
            assert!(it.celsius() < before && it.celsius() > before - 3.0);
        }
    }
}
