//! Sounds of a world: observations of its liquid and blows of its glass become events of sound in the scene's stage, real metres.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use vitriol_sim::bodies;
use vitriol_sim::chemistry::properties::Properties;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::{Flask, Scene};
use vitriol_sim::solver::{Bubbling, Census, Held, Skin};
use vitriol_sound::{Body, Bubbles, Drops, Event, Glass, Onto, Pour, Sound, Strike};

/// Emitters: what a flask's liquid and its bubbles do, its glass, and the others.
const POURS: u32 = 0;
const BOILS: u32 = 1000;
const GLASS: u32 = 2000;
const SPLASHES: [u32; 2] = [3000, 3001];
const SKIN: u32 = 3002;

/// How long a stream goes on after the observation that found it, s: two frames at 60 Hz, so that it does not stutter where one is late.
const LASTS: f64 = 0.035;
/// Speed below which what comes to a place takes nothing down and splashes nothing, m/s: a fall of 1 cm.
const SLOW: f64 = 0.45;
/// Liquid on the bench that is a puddle, in which drops leave bubbles, mL.
const PUDDLE: f64 = 0.5;
/// Of water at 20 °C, kg/m³.
const WATER: f64 = 998.0;

/// A flask's acoustic properties.
struct Vessel {
    /// Its glass while it is empty and in nobody's hand.
    glass: Glass,
    /// Volume of its inside, m³.
    capacity: f64,
    /// Height of its inside, m.
    height: f64,
}

/// Makes events of sound from a scene's observations, blows and breaks.
pub struct Audible {
    scale: f64,
    vessels: Vec<Vessel>,
    properties: Properties,
    /// Volume of the liquid on the bench at the last observation, mL.
    puddle: f64,
    /// The liquid in each flask then: its share of the capacity, and its density, kg/m³.
    fills: Vec<[f64; 2]>,
    /// Whether boiling is not heard.
    muted: bool,
}

impl Audible {
    /// The sounds of a scene.
    pub fn of(scene: &Scene) -> Self {
        let scale = scene.scale.length_scale;
        Self {
            scale,
            vessels: scene.flasks.iter().map(|it| vessel(it, scale)).collect(),
            properties: Properties::new(),
            puddle: 0.0,
            fills: vec![[0.0, WATER]; scene.flasks.len()],
            muted: false,
        }
    }

    /// Whether boiling is heard no more, for users whom it frightens.
    pub fn mute_boiling(&mut self, on: bool) {
        self.muted = on;
    }

    /// Sounds of an observation of the liquid, `elapsed` (s) after the observation before, at `time` (s) of the listener's clock; `poses`
    /// are the flasks', in the world.
    pub fn looked(
        &mut self,
        poses: &[Pose],
        census: &Census,
        elapsed: f64,
        time: f64,
    ) -> Vec<Event> {
        let mut events = Vec::new();
        if elapsed <= 0.0 {
            return events;
        }
        for (n, held) in census.flasks.iter().enumerate() {
            let (Some(vessel), Some(pose)) = (self.vessels.get(n), poses.get(n)) else {
                continue;
            };
            if bodies::is_nowhere(pose) {
                continue;
            }
            let volume = self.scale.powi(3) * held.volume;
            let share = (volume / vessel.capacity.max(1e-9)).clamp(0.0, 1.0);
            let density = self.density(held);
            self.fills[n] = [share, density];
            let place = self.scale as f32 * pose.transform_point(Vec3::ZERO);
            let says = |emitter: u32, position: Vec3, sound: Sound| Event {
                time,
                emitter: emitter + n as u32,
                position,
                sound,
            };
            if let Some(pour) = self.pour(held, elapsed, density) {
                let at = (self.scale * held.came.position).as_vec3();
                events.push(says(POURS, at, Sound::Pour(pour)));
            }
            let bubbles = self.bubbles(held, elapsed, density, share * vessel.height);
            if let Some(bubbles) = bubbles.filter(|_| !self.muted) {
                events.push(says(BOILS, place, Sound::Bubbles(bubbles)));
            }
        }
        for (held, emitter) in [census.table, census.floor].iter().zip(SPLASHES) {
            events.extend(self.splash(held, emitter, time));
        }
        self.puddle = 1e6 * self.scale.powi(3) * census.table.volume;
        events
    }

    /// Sounds of blows among the flasks, of which some are `held`, at `time` (s).
    pub fn struck(
        &self,
        blows: &[bodies::Strike],
        held: impl Fn(usize) -> bool,
        time: f64,
    ) -> Vec<Event> {
        let glass = |flask: usize| {
            let [filled, density] = self.fills.get(flask)?.map(|it| it as f32);
            Some(Glass {
                filled,
                density,
                held: held(flask),
                ..self.vessels.get(flask)?.glass
            })
        };
        let event = |blow: &bodies::Strike| {
            let other = match blow.other {
                Some(other) => glass(other).map(Body::Glass)?,
                None => Body::Bench,
            };
            let glass = glass(blow.flask)?;
            // Masses go with the third power of length, speeds with the first.
            let impulse = f64::from(blow.impulse) * self.scale.powi(4);
            Some(Event {
                time,
                emitter: GLASS + blow.flask as u32,
                position: self.scale as f32 * blow.position,
                sound: Sound::Strike(Strike {
                    impulse: impulse as f32,
                    bodies: [Body::Glass(glass), other],
                }),
            })
        };
        blows.iter().filter_map(event).collect()
    }

    /// Sounds of flasks that broke, at `time` (s).
    pub fn broke(&self, breaks: &[bodies::Break], time: f64) -> Vec<Event> {
        let event = |broken: &bodies::Break| {
            let vessel = self.vessels.get(broken.flask)?;
            Some(Event {
                time,
                emitter: GLASS + broken.flask as u32,
                position: self.scale as f32 * broken.stage_from_flask.position,
                sound: Sound::Break(vessel.glass),
            })
        };
        breaks.iter().filter_map(event).collect()
    }

    /// The sound of acid that reaches the user's skin, at `position` (m, real), at `time` (s).
    pub fn burns(skin: Skin, position: DVec3, time: f64) -> Event {
        Event {
            time,
            emitter: SKIN + skin as u32,
            position: position.as_vec3(),
            sound: Sound::Sizzle(1.0),
        }
    }

    /// kg/m³, of liquid at 20 °C: its pitch goes with the root, and heat changes it by some per cent.
    fn density(&self, held: &Held) -> f64 {
        match held.particles {
            0 => WATER,
            _ => self
                .properties
                .densities(f64::from(held.acid).clamp(0.0, 1.0))[0],
        }
    }

    fn pour(&self, held: &Held, elapsed: f64, density: f64) -> Option<Pour> {
        let speed = self.scale * held.came.speed;
        // What splashes up and falls back is no stream; a single particle is a drop.
        (held.came.particles > 1 && speed > SLOW).then(|| Pour {
            flow: (self.scale.powi(3) * held.came.volume / elapsed) as f32,
            speed: speed as f32,
            density: density as f32,
            lasts: (elapsed + LASTS) as f32,
        })
    }

    fn bubbles(&self, held: &Held, elapsed: f64, density: f64, depth: f64) -> Option<Bubbles> {
        let Bubbling {
            here,
            born,
            collapsed,
            burst,
            ..
        } = held.bubbles;
        if born + collapsed.count + burst.count == 0 {
            return None;
        }
        let rate = |count: u32| (f64::from(count) / elapsed) as f32;
        let ended = [collapsed, burst];
        let count: u32 = ended.iter().map(|it| it.count).sum();
        let radii: f64 = ended.iter().map(|it| f64::from(it.count) * it.radius).sum();
        let radius = match count {
            0 => here.radius,
            _ => radii / f64::from(count),
        };
        let point = self.properties.boiling_point(f64::from(held.acid));
        let below = held
            .temperature
            .map_or(0.0, |celsius| point - f64::from(celsius));
        Some(Bubbles {
            departures: rate(born),
            collapses: rate(collapsed.count),
            bursts: rate(burst.count),
            radius: (self.scale * radius) as f32,
            subcooling: below.max(0.0) as f32,
            depth: (0.5 * depth) as f32,
            density: density as f32,
            lasts: (elapsed + LASTS) as f32,
        })
    }

    fn splash(&self, held: &Held, emitter: u32, time: f64) -> Option<Event> {
        let came = &held.came;
        let speed = self.scale * came.speed;
        if came.particles == 0 || speed < SLOW {
            return None;
        }
        let one = self.scale.powi(3) * came.volume / f64::from(came.particles);
        Some(Event {
            time,
            emitter,
            position: (self.scale * came.position).as_vec3(),
            sound: Sound::Drops(Drops {
                count: came.particles,
                diameter: (6.0 * one / PI).cbrt() as f32,
                speed: speed as f32,
                onto: match self.puddle > PUDDLE && emitter == SPLASHES[0] {
                    true => Onto::Wet,
                    false => Onto::Bench,
                },
            }),
        })
    }
}

fn vessel(flask: &Flask, scale: f64) -> Vessel {
    let profile = &flask.profile;
    let height = profile.rim_height() - profile.floor_height();
    Vessel {
        glass: Glass {
            radius: (scale * profile.outer_radius()) as f32,
            wall: (scale * profile.wall()) as f32,
            height: (scale * height) as f32,
            filled: 0.0,
            density: WATER as f32,
            held: false,
        },
        capacity: scale.powi(3) * profile.capacity(),
        height: scale * height,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic)]
mod tests {
    use super::*;
    use vitriol_sim::solver::{BubbleCount as Number, Came};

    const FRAME: f64 = 1.0 / 90.0;

    fn audible(scene: &str) -> (Audible, Vec<Pose>) {
        let scene = Scene::builtin(scene).unwrap();
        let poses = scene.flasks.iter().map(|it| it.stage_from_flask);
        (Audible::of(&scene), poses.collect())
    }

    /// What came to the second flask, which has 160 mL of acid of 98 %.
    fn census(came: Came) -> Census {
        let held = Held {
            particles: 10_000,
            volume: 160e-6,
            temperature: Some(60.0),
            acid: 0.98,
            came,
            ..Held::default()
        };
        Census {
            flasks: vec![Held::default(), held],
            ..Census::default()
        }
    }

    fn came(particles: u32, speed: f64) -> Came {
        Came {
            particles,
            volume: f64::from(particles) * 15.6e-9,
            speed,
            position: DVec3::new(0.12, 0.8, -0.4),
            acid: 0.0,
            temperature: None,
        }
    }

    /// 90 particles of 15.6 mm³ in a frame of 90 Hz are 126 mL/s, into acid of 1.836 g/mL.
    #[test]
    fn what_comes_fast_into_a_liquid_pours() {
        let (mut audible, poses) = audible("water-into-acid");
        let events = audible.looked(&poses, &census(came(90, 1.2)), FRAME, 5.0);
        let [event] = events[..] else {
            panic!("{events:?}");
        };
        let Sound::Pour(pour) = event.sound else {
            panic!("{event:?}");
        };
        assert!((pour.flow / 126.4e-6 - 1.0).abs() < 0.01, "{pour:?}");
        assert_eq!((pour.speed, event.time), (1.2, 5.0));
        assert!((pour.density / 1836.0 - 1.0).abs() < 0.01, "{pour:?}");
        assert_eq!(event.position, Vec3::new(0.12, 0.8, -0.4));
        // What flows together does not, and no look has no time.
        for (came, elapsed) in [
            (came(90, 0.2), FRAME),
            (came(1, 2.0), FRAME),
            (came(9, 2.0), 0.0),
        ] {
            let events = audible.looked(&poses, &census(came), elapsed, 5.0);
            assert_eq!(events, [], "{came:?} {elapsed}");
        }
    }

    /// Acid of 70 % boils at 165 °C (Perry's table has 164 to 166).
    #[test]
    fn bubbles_are_of_a_liquid_so_far_below_its_boiling_point() {
        let (mut audible, poses) = audible("water-into-acid");
        let mut census = census(Came::default());
        let held = &mut census.flasks[1];
        (held.acid, held.temperature) = (0.70, Some(140.0));
        let number = |count: u32, radius: f64| Number { count, radius };
        held.bubbles = Bubbling {
            here: number(40, 2e-3),
            born: 3,
            collapsed: number(3, 1e-3),
            burst: number(1, 3e-3),
            ..Bubbling::default()
        };
        audible.mute_boiling(true);
        assert!(audible.looked(&poses, &census, 2.0 * FRAME, 1.0).is_empty());
        audible.mute_boiling(false);
        let events = audible.looked(&poses, &census, 2.0 * FRAME, 1.0);
        let [event] = events[..] else {
            panic!("{events:?}");
        };
        let Sound::Bubbles(bubbles) = event.sound else {
            panic!("{event:?}");
        };
        assert!((bubbles.departures - 135.0).abs() < 0.1, "{bubbles:?}");
        assert!((bubbles.collapses - 135.0).abs() < 0.1 && (bubbles.bursts - 45.0).abs() < 0.1);
        assert!((bubbles.radius - 1.5e-3).abs() < 1e-6, "{bubbles:?}");
        assert!((bubbles.subcooling - 25.0).abs() < 3.0, "{bubbles:?}");
        // Half of the height of 160 mL in a beaker 72 mm wide inside.
        assert!((0.012..0.025).contains(&bubbles.depth), "{bubbles:?}");
    }

    #[test]
    fn drops_ring_where_there_is_a_puddle() {
        let (mut audible, poses) = audible("water-into-acid");
        let mut census = Census::default();
        census.table.came = came(4, 2.0);
        census.table.volume = 2e-6;
        let mut onto = || {
            let events = audible.looked(&poses, &census, FRAME, 1.0);
            let [
                Event {
                    sound: Sound::Drops(drops),
                    ..
                },
            ] = events[..]
            else {
                panic!("{events:?}");
            };
            // A ball of 15.6 mm³.
            assert!((drops.diameter - 3.1e-3).abs() < 5e-5, "{drops:?}");
            (drops.count, drops.onto)
        };
        assert_eq!(onto(), (4, Onto::Bench));
        assert_eq!(onto(), (4, Onto::Wet));
    }

    /// The paper's world is twenty times as large as what it shows.
    #[test]
    fn a_larger_world_sounds_as_what_it_shows() {
        let (mut audible, poses) = audible("vr-dilution");
        let times = 1.0 / audible.scale;
        assert!(times > 1.5, "it is no larger world: {times}");
        let large = Came {
            volume: 90.0 * 15.6e-9 * times.powi(3),
            speed: 1.2 * times,
            position: DVec3::Y * times,
            ..came(90, 0.0)
        };
        let mut census = census(large);
        census.flasks[1].volume *= times.powi(3);
        let events = audible.looked(&poses, &census, FRAME, 0.0);
        let Some(Event {
            sound: Sound::Pour(pour),
            position,
            ..
        }) = events.first()
        else {
            panic!("{events:?}");
        };
        assert!((pour.flow / 126.4e-6 - 1.0).abs() < 0.01, "{pour:?}");
        assert!((pour.speed - 1.2).abs() < 1e-5 && position.distance(Vec3::Y) < 1e-5);
    }

    #[test]
    fn a_break_is_heard_where_it_was() {
        let scene = Scene::builtin("two-flasks").unwrap();
        let audible = Audible::of(&scene);
        let broken = bodies::Break {
            flask: 1,
            stage_from_flask: Pose::from_position(Vec3::new(0.1, 0.75, -0.4)),
        };
        let events = audible.broke(&[broken], 2.0);
        assert_eq!(events.len(), 1);
        assert_eq!(events[0].position, broken.stage_from_flask.position);
        assert!(matches!(events[0].sound, Sound::Break(glass) if glass.height > 0.1));
    }

    #[test]
    fn a_blow_is_of_the_glass_that_it_is_of() {
        let (mut audible, poses) = audible("water-into-acid");
        audible.looked(&poses, &census(Came::default()), FRAME, 0.0);
        let blow = |other| bodies::Strike {
            flask: 1,
            other,
            speed: 0.1,
            impulse: 0.03,
            position: Vec3::Y,
        };
        let blows = [blow(None), blow(Some(0))];
        let events = audible.struck(&blows, |flask| flask == 0, 2.0);
        let [one, two] = [0, 1].map(|n: usize| match events[n].sound {
            Sound::Strike(strike) => strike,
            other => panic!("{other:?}"),
        });
        assert_eq!((one.impulse, one.bodies[1]), (0.03, Body::Bench));
        let [Body::Glass(struck), Body::Glass(other)] = two.bodies else {
            panic!("{two:?}");
        };
        // A beaker of 400 mL with 160 mL of acid, and an empty one of 250 mL in a hand.
        assert!(
            (struck.radius - 0.040).abs() < 2e-3 && !struck.held,
            "{struck:?}"
        );
        assert!((0.3..0.5).contains(&struck.filled), "{struck:?}");
        assert!((other.radius - 0.036).abs() < 2e-3 && other.held && other.filled == 0.0);
    }
}
