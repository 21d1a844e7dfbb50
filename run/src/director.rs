//! The film's director: wide while somebody reaches and carries, close to the glass in which liquid meets liquid or boils; and which
//! moments are worth showing. The side that it is seen from is chosen in `sightline.rs`.

use glam::{Affine3A, Quat, Vec3};
use vitriol_lesson::{Event, layered};
use vitriol_render::{Fov, View};
use vitriol_sim::scene::Scene;
use vitriol_sim::world::World;

use crate::run::LastSeen;
use crate::scenery::affine;
use crate::sightline::{Glass, beside, turn};

/// How far the bench is shown at the start, s: long enough to see what stands on it.
const OPENING: f64 = 0.5;
/// How long the camera stays after the last thing that happened, s. What boils over drips for about as long.
const TAIL: f64 = 2.0;
/// Least time between two changes of the camera's place, s: films that change faster are hard to follow.
const SHORTEST: f64 = 0.7;
/// A held flask that is tilted further and whose lip is so near another one's axis (beside its radius, m) is about to be poured from.
/// Chosen: a beaker of 250 mL with 20 mL in it pours from 70° on.
const TILTED: f32 = 65.0;
const NEAR: f32 = 0.05;
/// Gas in a flask's liquid from which on it boils, real m³: a bubble of 6 mm.
const GAS: f64 = 1e-7;
/// Liquid on bench and floor that more than this was added to is worth showing, real m³: two drops.
const SPILT: f64 = 1e-7;
/// Share of the picture's height that a glass fills when seen closely, and that is below it.
const FILLED: f32 = 2.0 / 3.0;
const BELOW: f32 = 0.05;
/// From a glass's foot to the eye of a student who sits at the bench, up and towards the user, m: eyes are 1.1 to 1.2 m above the floor
/// then (sitting eye height 0.74 m over a stool of 0.4 m, NASA-STD-3000), and the bench is 0.75 m high.
const EYE: Vec3 = Vec3::new(0.0, 0.37, 0.76);
/// Where the glass's middle is in the picture's width, where that is more than its height: the inset is to the right of it.
const ASIDE: f32 = 0.4;
/// The camera follows a glass that is moved with this time constant, s: it lets a swirl be seen and shows no trembling.
const FOLLOWS: f64 = 0.5;

/// How much of the way to a glass the camera goes in that time, s.
pub(crate) fn followed(elapsed: f64) -> f32 {
    (1.0 - (-elapsed / FOLLOWS).exp()) as f32
}

/// A director of a scene's film.
#[derive(Debug)]
pub struct Director {
    /// What shows the whole bench, from the side from which hands hid least of it at the start.
    wide: View,
    /// The flask that is shown closely, and where its foot is, smoothed, m in the scene's stage.
    close: Option<(usize, Vec3)>,
    /// How far the eye is turned about that glass, radians.
    turn: f32,
    layered: Option<usize>,
    time: f64,
    /// When the camera's place changed last, s.
    changed: f64,
    /// The end of what is worth showing, s.
    shown_until: f64,
    spilt: f64,
    events: usize,
    /// When it began to boil, and where.
    boils: Option<(f64, usize)>,
}

impl Director {
    /// At a scene's start, with the view of its bench; `None` of a scene at another size, whose tripod is close already.
    pub fn of(scene: &Scene, wide: View) -> Option<Self> {
        let layered = layered(scene);
        (scene.scale.length_scale == 1.0).then(|| Self {
            wide,
            close: None,
            turn: 0.0,
            layered: layered
                .and_then(|name| scene.flasks.iter().position(|flask| flask.name == name)),
            time: 0.0,
            changed: f64::NEG_INFINITY,
            shown_until: OPENING,
            spilt: 0.0,
            events: 0,
            boils: None,
        })
    }

    /// Looks at the state after a step of `frame_time` (s), with the run's events so far and the places of the hands, m in the scene's
    /// stage.
    pub fn observe(
        &mut self,
        world: &World,
        (seen, events): (&LastSeen, &[Event]),
        hands: [Vec3; 2],
        frame_time: f64,
    ) {
        // Once: a wide shot that turned later would look like another bench.
        if self.time == 0.0 {
            let flasks = 0..world.poses().len();
            let glasses: Vec<Glass> = flasks.map(|flask| glass(world, flask)).collect();
            self.wide = beside(self.wide, &glasses, hands);
        }
        let found = |event: &&Event| matches!(event, Event::Poured(_) | Event::Incident(_));
        let events = events.iter().filter(found).count();
        self.time += frame_time;
        let boiling = boiling(seen);
        if let (None, Some(flask)) = (self.boils, boiling) {
            self.boils = Some((self.time, flask));
        }
        let subject = boiling
            .or_else(|| poured_into(world))
            .or_else(|| self.layered.filter(|flask| world.holder(*flask).is_some()));
        let spilt: f64 = seen.spilt.iter().sum();
        let happens = spilt > self.spilt + SPILT || events > self.events;
        if subject.is_some() || happens {
            self.shown_until = self.time + TAIL;
        }
        if happens {
            (self.spilt, self.events) = (spilt, events);
        }
        let now = self.close.map(|(flask, _)| flask);
        // It stays where it was until nothing has happened there for a while.
        let wanted = subject.or(now.filter(|_| self.time < self.shown_until));
        if wanted != now && self.time > self.changed + SHORTEST {
            self.close = wanted.map(|flask| (flask, world.poses()[flask].position));
            self.changed = self.time;
            self.turn = wanted.map_or(0.0, |flask| turn(EYE, &glass(world, flask), hands));
        }
        if let Some((flask, foot)) = &mut self.close {
            *foot = foot.lerp(world.poses()[*flask].position, followed(frame_time));
        }
    }

    /// Whether something happens, happened just now, or the film just began.
    pub fn shows(&self) -> bool {
        self.time <= self.shown_until
    }

    /// Where the camera is, for pictures of this width over height.
    pub fn view(&self, scene: &Scene, aspect: f32) -> View {
        let Some((flask, foot)) = self.close else {
            return self.wide;
        };
        let across = if aspect > 1.0 { ASIDE } else { 0.5 };
        close_to(foot, size(scene, flask), self.turn, (aspect, across))
    }

    /// How far the eye is turned about the glass that is seen closely, radians.
    pub fn turned(&self) -> f32 {
        self.turn
    }

    /// When it began to boil, s after the scene's start, and in which flask.
    pub fn boils(&self) -> Option<(f64, usize)> {
        self.boils
    }

    /// Simulated time since the scene's start, s.
    pub fn time(&self) -> f64 {
        self.time
    }
}

/// A glass of that height and radius (m) with its foot there, from the eyes of a student who sits before it; `across` is where its middle
/// is in the picture's width.
pub(crate) fn close_to(
    foot: Vec3,
    [height, radius]: [f32; 2],
    turn: f32,
    (aspect, across): (f32, f32),
) -> View {
    let eye = foot + Quat::from_rotation_y(turn) * EYE;
    let middle = foot + 0.5 * height * Vec3::Y;
    let away = (middle - eye).normalize();
    // Its height is foreshortened, and its foot and rim are seen as ellipses.
    let fills = height * away.with_y(0.0).length() + 2.0 * radius * away.y.abs();
    let picture = fills / FILLED;
    let right = away.cross(Vec3::Y).normalize();
    let target = middle
        + right.cross(away) * ((0.5 - BELOW - 0.5 * FILLED) * picture)
        + right * ((0.5 - across) * aspect * picture);
    let field = 2.0 * (0.5 * picture / target.distance(eye)).atan();
    View::look_at(eye, target, Fov::symmetric(field, aspect))
}

/// A flask's height and outer radius, m.
pub(crate) fn size(scene: &Scene, flask: usize) -> [f32; 2] {
    let profile = &scene.flasks[flask].profile;
    [profile.rim_height(), profile.outer_radius()].map(|it| it as f32)
}

/// A flask where it is.
fn glass(world: &World, flask: usize) -> Glass {
    Glass {
        foot: world.poses()[flask].position,
        size: size(world.scene(), flask),
    }
}

/// The flask with the most gas, of those that boil.
pub(crate) fn boiling(seen: &LastSeen) -> Option<usize> {
    let gas = |flask: usize| seen.flasks[flask].bubbles.volume;
    // Air that a stream takes down does not boil.
    let boils = |flask: &usize| {
        seen.flasks[*flask]
            .superheat
            .is_some_and(|kelvin| kelvin > 0.0)
    };
    (0..seen.flasks.len())
        .filter(|flask| gas(*flask) > GAS)
        .filter(boils)
        .max_by(|a, b| gas(*a).total_cmp(&gas(*b)))
}

/// The flask that stands under the lip of one that is held and tilted.
pub(crate) fn poured_into(world: &World) -> Option<usize> {
    let scene = world.scene();
    let flasks: Vec<Affine3A> = world.poses().iter().map(affine).collect();
    let lips = (0..flasks.len()).filter_map(|flask| {
        let axis = flasks[flask].transform_vector3(Vec3::Y);
        let tilted = axis.y < TILTED.to_radians().cos();
        (tilted && world.holder(flask).is_some()).then(|| {
            let [height, radius] = size(scene, flask);
            let down = (axis * axis.y - Vec3::Y).normalize_or_zero();
            (
                flask,
                flasks[flask].transform_point3(height * Vec3::Y) + radius * down,
            )
        })
    });
    let lips: Vec<(usize, Vec3)> = lips.collect();
    (0..flasks.len()).find(|&under| {
        let foot = Vec3::from(flasks[under].translation);
        let [_, radius] = size(scene, under);
        lips.iter().any(|(flask, lip)| {
            let aside = (*lip - foot).with_y(0.0).length();
            *flask != under && lip.y > foot.y && aside < radius + NEAR
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A beaker of 250 mL (95 mm × 70 mm, ISO 3819) fills two thirds of the picture's height, and its lowest point is 5 % above the
    /// picture's edge: seen from afar within the perspective's 3 %. Across it is where it is asked for.
    #[test]
    fn a_glass_fills_two_thirds_of_the_picture() {
        let (height, radius) = (0.095_f32, 0.035_f32);
        let foot = Vec3::new(0.12, 0.75, -0.4);
        let ring = |level: f32| {
            (0..64).map(move |n| {
                let (sin, cos) = (n as f32 * std::f32::consts::TAU / 64.0).sin_cos();
                foot + Vec3::new(radius * cos, level, radius * sin)
            })
        };
        for (aspect, across) in [(16.0 / 9.0, ASIDE), (4.0 / 3.0, 0.5), (0.9, 0.5)] {
            let view = close_to(foot, [height, radius], 0.0, (aspect, across));
            let clip = view.clip_from_scaled(1.0);
            let heights = ring(0.0)
                .chain(ring(height))
                .map(|at| clip.project_point3(at).y);
            let (lowest, highest) = heights.fold((f32::MIN, f32::MAX), |(low, high), y| {
                (low.max(y), high.min(y))
            });
            // Clip space is 2 high, and +Y is down.
            assert!(
                (0.5 * (lowest - highest) - FILLED).abs() < 0.02,
                "{lowest} {highest}"
            );
            assert!((0.5 * (1.0 - lowest) - BELOW).abs() < 0.03, "{lowest}");
            let middle = clip.project_point3(foot + 0.5 * height * Vec3::Y);
            assert!((0.5 * (1.0 + middle.x) - across).abs() < 0.01, "{middle}");
        }
    }
}
