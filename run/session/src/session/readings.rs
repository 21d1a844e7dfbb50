//! Temperature and acid of each flask's liquid, as the panel shows them.

use glam::Vec3;
use vitriol_lesson::{Stream, Texts};
use vitriol_run::scenery::has_acid;
use vitriol_sim::scene::{Flask, Scene};
use vitriol_sim::solver::{Census, Held};

use crate::info::{FlaskLine, Pouring};

/// Observations between two readings of the panel: ten a second at 90 Hz. It is drawn anew for each.
const EVERY: u64 = 9;
/// The same of the pour under way, whose digits are read while they change: three a second at 90 Hz. Our choice.
const POURING_EVERY: u64 = 30;

/// The last reading of a bench's flasks.
#[derive(Default)]
pub(super) struct Readings {
    /// The flasks' names.
    names: Vec<String>,
    /// The liquid in each flask at the last reading; empty before the first one.
    last: Vec<Held>,
    /// The pour under way at the last reading.
    pouring: Option<Pouring>,
    /// Observations so far.
    looks: u64,
}

impl Readings {
    /// Takes in an observation, with the pour under way in it.
    pub fn take(&mut self, census: &Census, pouring: Option<Stream>) {
        if self.looks.is_multiple_of(EVERY) {
            self.last.clone_from(&census.flasks);
        }
        // Its beginning and its end are shown at once.
        let changes = pouring.is_some() != self.pouring.is_some();
        if changes || self.looks.is_multiple_of(POURING_EVERY) {
            self.pouring = pouring.map(|it| Pouring::of(it.volume_m3, it.rate_m3_s));
        }
        self.looks += 1;
    }

    /// The pour under way.
    pub fn pouring(&self) -> Option<Pouring> {
        self.pouring
    }

    /// Takes in that a bench with that scene is in use, and forgets readings of another one.
    pub fn begin(&mut self, scene: &Scene, texts: &Texts) {
        *self = Self {
            names: texts.flasks(scene),
            ..Self::default()
        };
    }

    /// Names of the flasks of the bench's scene, in its order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The liquid's volume in a flask at the last reading, m³ of the scene; `None` before the first one.
    pub fn volume(&self, flask: usize) -> Option<f64> {
        self.last.get(flask).map(|held| held.volume)
    }

    /// The panel's lines for the flasks of the bench's scene. One that hangs upside down, a funnel, has none: it holds nothing
    /// for long.
    pub fn lines(&self, scene: &Scene, is_broken: impl Fn(usize) -> bool) -> Vec<FlaskLine> {
        let acid = has_acid(scene);
        let line = |index: usize, name: &String| {
            let held = self.last.get(index);
            let held = held.and_then(|held| Some((held.temperature?, held.acid)));
            FlaskLine {
                name: name.clone(),
                broken: is_broken(index),
                temperature: held.map(|(celsius, _)| celsius.round() as i32),
                acid: (held.filter(|_| acid)).map(|(_, acid)| (100.0 * acid).round() as i32),
            }
        };
        let upright = |flask: &Flask| (flask.stage_from_flask.orientation * Vec3::Y).y > 0.0;
        let flasks = scene.flasks.iter().zip(&self.names).enumerate();
        flasks
            .filter(|(_, (flask, _))| upright(flask))
            .map(|(index, (_, name))| line(index, name))
            .collect()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use glam::Quat;

    fn reading(particles: u32, temperature: f32, acid: f32) -> Held {
        Held {
            particles,
            temperature: (particles > 0).then_some(temperature),
            acid,
            ..Held::default()
        }
    }

    #[test]
    fn each_flask_has_a_line_with_what_was_read_in_it() {
        let mut scene = Scene::builtin("water-into-acid").unwrap();
        let names = ["Beaker with water", "Beaker with 98\u{a0}% acid"];
        let texts = Texts::english().unwrap();
        let mut readings = Readings::default();
        readings.begin(&scene, &texts);
        let lines = readings.lines(&scene, |_| false);
        assert_eq!(lines.len(), names.len());
        assert_eq!([0, 1].map(|at| lines[at].name.as_str()), names);
        assert_eq!((lines[0].temperature, lines[0].acid), (None, None));
        // An empty flask has no temperature.
        readings.last = vec![reading(7, 99.6, 0.956), reading(0, 0.0, 0.0)];
        let lines = readings.lines(&scene, |_| false);
        assert_eq!((lines[0].temperature, lines[0].acid), (Some(100), Some(96)));
        assert_eq!((lines[1].temperature, lines[1].acid), (None, None));
        readings.last[0].volume = 1.6e-4;
        let volumes = [0, 1, 2].map(|flask| readings.volume(flask));
        assert_eq!(volumes, [Some(1.6e-4), Some(0.0), None]);
        // Without the first, the second's line is still the second's.
        scene.flasks[0].stage_from_flask.orientation = Quat::from_rotation_x(3.0);
        readings.last[1] = reading(7, 20.4, 0.0);
        let lines = readings.lines(&scene, |_| false);
        assert_eq!(
            (lines[0].name.as_str(), lines[0].temperature),
            (names[1], Some(20))
        );
        assert_eq!((lines.len(), lines[0].acid), (names.len() - 1, Some(0)));
        // Where there is no acid, none is shown.
        for liquid in &mut scene.liquids {
            liquid.acid_fraction = 0.0;
        }
        let lines = readings.lines(&scene, |flask| flask == 1);
        assert_eq!((lines[0].acid, lines[0].broken), (None, true));
    }

    /// Names stay as they are while a bench is in use, whatever happens to its liquid, and are those of the bench that follows.
    #[test]
    fn names_are_those_of_the_bench_in_use() {
        let mut scene = Scene::builtin("acid-into-water").unwrap();
        let texts = Texts::english().unwrap();
        let mut readings = Readings::default();
        readings.begin(&scene, &texts);
        scene.liquids.clear();
        let lines = readings.lines(&scene, |_| false);
        assert_eq!(lines[0].name, "Beaker with 98\u{a0}% acid");
        readings.last = vec![reading(7, 20.0, 0.0)];
        let next = Scene::builtin("acid-on-glove").unwrap();
        readings.begin(&next, &texts);
        let names = ["Tray", "Bottle with water", "Beaker with 98\u{a0}% acid"];
        assert_eq!(readings.names(), names);
        let lines = readings.lines(&next, |_| false);
        assert_eq!(
            (lines[0].name.as_str(), lines[0].temperature),
            ("Tray", None)
        );
    }
}
