//! How high a held body must be so that it touches neither the table nor other bodies.
//!
//! The held body is a cloud of points on its surface, every other body is what lies under a capsule seen from above: a column from the
//! table to its top. A tilted flask may so be beside a beaker with its foot and over it with its lip.

use std::f32::consts::TAU;

use glam::{Quat, Vec2, Vec3};
use vitriol_xr::{Around, Kind, Thing};

/// What a rod keeps from the outside of a flask's mouth, and the thickness of a flask's bottom, m: glass is 1 to 3 mm thick.
const WALL: f32 = 0.003;
/// Cosine of the lean up to which a flask is upright: 10°. Rods are dipped into such flasks, and such flasks are swirled.
pub(super) const UPRIGHT: f32 = 0.985;
/// How far beside a flask the pointer is, m, until a rod leaves that: more than a key that moves the rod asks for at a time.
const LEAVES: f32 = 0.05;
/// Points around a ring, and distance of rings along the axis, m.
const SIDES: usize = 12;
const RINGS_APART: f32 = 0.02;
/// Most rings.
const MOST_RINGS: usize = 14;
/// Distance of places along a way, m, and the most of them.
const PLACES_APART: f32 = 0.015;
const MOST_PLACES: usize = 40;
/// Depth under the table, m, from which on a body does not count: it fell or broke.
const FALLEN: f32 = 0.3;

/// Distances that are kept, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clear {
    /// Over the table.
    pub table: f32,
    /// Over the top of other bodies.
    pub glass: f32,
    /// Beside other bodies.
    pub aside: f32,
}

impl Clear {
    /// What is never gone below while something is carried. Beside glass it covers the gap between two points of the cloud.
    pub const HARD: Self = Self {
        table: 0.0,
        glass: 0.003,
        aside: 0.008,
    };
    /// Where something is put down.
    pub const RESTING: Self = Self {
        table: 0.0,
        glass: 0.0,
        aside: 0.002,
    };
}

/// The surface of a held body as points from the point at which it is held, in its own axes, m.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    points: Vec<Vec3>,
}

impl Shape {
    /// A thing that is held `centre` metres over its foot.
    pub fn of(thing: &Thing, centre: f32) -> Self {
        let rings = ((thing.height / RINGS_APART).ceil() as usize).clamp(1, MOST_RINGS);
        let mut points = Vec::new();
        let mut ring = |radius: f32, height: f32| {
            points.extend((0..SIDES).map(|n| {
                let at = Vec2::from_angle(TAU * n as f32 / SIDES as f32) * radius;
                Vec3::new(at.x, height - centre, at.y)
            }));
        };
        for n in 0..=rings {
            let radius = if n == rings { thing.rim } else { thing.radius };
            ring(radius, thing.height * n as f32 / rings as f32);
        }
        // Foot and mouth are closed: what is thin and stands under their middle counts.
        for (radius, height) in [(thing.radius, 0.0), (thing.rim, thing.height)] {
            ring(0.5 * radius, height);
            ring(0.0, height);
        }
        Self { points }
    }

    /// The points in the stage's axes.
    pub fn turned(&self, orientation: Quat) -> Vec<Vec3> {
        let turned = self.points.iter().map(|&point| orientation * point);
        turned.collect()
    }
}

#[derive(Clone, Copy, Debug)]
struct Column {
    ends: [Vec2; 2],
    radius: f32,
    foot: f32,
    top: f32,
    /// Radius of the way into it, m, for a rod.
    mouth: Option<f32>,
}

impl Column {
    /// Whether a place is over the way into it.
    fn is_entered(&self, place: Vec2) -> bool {
        let apart = distance(self.ends, place);
        self.mouth.is_some_and(|mouth| apart <= mouth)
    }
}

/// The table and what stands on it, for one held body.
#[derive(Clone, Debug)]
pub(super) struct Bench {
    table: f32,
    columns: Vec<Column>,
}

impl Bench {
    /// What the body of that index must clear while it is carried. A rod goes into a flask, through its mouth.
    pub fn carrying(around: &Around, held: usize) -> Self {
        let thing = around.things.get(held);
        let dips = thing.is_some_and(|it| it.kind == Kind::Rod);
        Self::new(around, held, dips)
    }

    /// What must not be where that body is put down.
    pub fn resting(around: &Around, held: usize) -> Self {
        Self::new(around, held, false)
    }

    fn new(around: &Around, held: usize, dips: bool) -> Self {
        let held_thing = around.things.get(held);
        let others = around.things.iter().enumerate();
        let columns = others
            .filter(|&(index, other)| {
                let stands = counts(other, around.table) && !slides(other);
                index != held && stands && held_thing.is_some_and(|it| hinders(it, other))
            })
            .map(|(_, other)| column(other, dips))
            .collect();
        Self {
            table: around.table,
            columns,
        }
    }

    /// Least height of the held point over the place `at`, m, with these points of the body about it.
    pub fn floor(&self, points: &[Vec3], at: Vec2, clear: &Clear) -> f32 {
        let mut height = f32::NEG_INFINITY;
        for &point in points {
            let place = at + level(point);
            let mut under = self.table + clear.table;
            for column in &self.columns {
                if column.is_entered(place) {
                    under = under.max(column.foot + WALL + clear.table);
                } else if distance(column.ends, place) <= column.radius + clear.aside {
                    under = under.max(column.top + clear.glass);
                }
            }
            height = height.max(under - point.y);
        }
        height
    }

    /// The same along a straight way.
    pub fn path(&self, points: &[Vec3], from: Vec2, to: Vec2, clear: &Clear) -> f32 {
        let places = places(from, to);
        places.fold(f32::NEG_INFINITY, |height, at| {
            height.max(self.floor(points, at, clear))
        })
    }

    /// How far the way is free at this height.
    pub fn farthest(&self, points: &[Vec3], way: [Vec2; 2], height: f32, clear: &Clear) -> Vec2 {
        let free = |&at: &Vec2| self.floor(points, at, clear) <= height;
        let reached = places(way[0], way[1]).take_while(free).last();
        reached.unwrap_or(way[0])
    }

    /// Where a rod of that radius goes if the pointer wants it at `aim`. While its lower end is in a flask it stays in the mouth, until the
    /// pointer is well beside the flask or the rod is over the rim.
    pub fn within_mouth(&self, end: Vec3, aim: Vec2, radius: f32) -> Vec2 {
        let mut columns = self.columns.iter();
        let flask = columns.find(|it| it.is_entered(level(end)) && end.y < it.top);
        let Some((flask, mouth)) = flask.and_then(|it| Some((it, it.mouth?))) else {
            return aim;
        };
        let middle = flask.ends[0].lerp(flask.ends[1], 0.5);
        let way = aim - middle;
        if way.length() > flask.radius + LEAVES {
            return aim;
        }
        // A millimetre less, so that no rounding brings it into the wall.
        middle + way.clamp_length_max((mouth - radius - 0.001).max(0.0))
    }

    /// Whether the body can stand at that place.
    pub fn is_free(&self, points: &[Vec3], at: Vec2) -> bool {
        let lowest = points
            .iter()
            .fold(f32::INFINITY, |low, point| low.min(point.y));
        let stands = self.table - lowest;
        self.floor(points, at, &Clear::RESTING) <= stands + 1e-4
    }
}

/// Least height over the place `at` that is `over` (m) above the table, and above the top of all that is within `aside` of it.
pub(super) fn hover(around: &Around, at: Vec2, over: f32, aside: f32) -> f32 {
    let near = |thing: &&Thing| counts(thing, around.table) && !slides(thing);
    let columns = around
        .things
        .iter()
        .filter(near)
        .map(|it| column(it, false));
    let under = columns
        .filter(|it| distance(it.ends, at) <= it.radius + aside)
        .fold(around.table, |under, it| under.max(it.top));
    under + over
}

/// Whether a thing is still on the bench, at a place that is a number: it neither broke nor is worn.
pub(super) fn counts(thing: &Thing, table: f32) -> bool {
    let sizes = thing.radius.is_finite() && thing.rim.is_finite() && thing.height.is_finite();
    let there = thing.is_flask() || thing.grips;
    sizes && there && thing.pose.is_valid() && thing.pose.position.y > table - FALLEN
}

/// Whether it only slides up and down: it hangs over the bench, and all pass under it.
pub(super) fn slides(thing: &Thing) -> bool {
    thing.kind == Kind::Sash
}

/// A point of the stage as seen from above: x and z, m.
pub(super) fn level(point: Vec3) -> Vec2 {
    Vec2::new(point.x, point.z)
}

/// The axis of a thing.
pub(super) fn axis(thing: &Thing) -> Vec3 {
    thing.pose.orientation * Vec3::Y
}

fn column(thing: &Thing, dips: bool) -> Column {
    let foot = thing.pose.position;
    let axis = axis(thing);
    let top = foot + thing.height * axis;
    let lies = (1.0 - axis.y * axis.y).max(0.0).sqrt();
    Column {
        ends: [level(foot), level(top)],
        radius: thing.radius,
        foot: foot.y,
        top: foot.y.max(top.y) + lies * thing.radius,
        mouth: (dips && thing.is_flask() && axis.y > UPRIGHT).then_some(thing.rim - WALL),
    }
}

/// Whether a held body must go over another one, and cannot be put down on it. Tools lie on each other, and rods lie about.
fn hinders(held: &Thing, other: &Thing) -> bool {
    other.is_flask() || (held.is_flask() && other.kind != Kind::Rod)
}

/// Distance of a place from a line between two.
fn distance([a, b]: [Vec2; 2], at: Vec2) -> f32 {
    let along = b - a;
    let length = along.length_squared().max(f32::MIN_POSITIVE);
    let share = ((at - a).dot(along) / length).clamp(0.0, 1.0);
    (a + share * along).distance(at)
}

/// Places along a way, both ends included.
fn places(from: Vec2, to: Vec2) -> impl Iterator<Item = Vec2> {
    let count = (from.distance(to) / PLACES_APART).ceil() as usize;
    let count = count.clamp(1, MOST_PLACES);
    (0..=count).map(move |n| from.lerp(to, n as f32 / count as f32))
}
