//! What the pointer's ray meets, and how a hand stands at what it is to take.

use glam::{Mat3, Quat, Vec2, Vec3};
use vitriol_xr::{Around, Kind, Pointed, Pose, Side, Thing};

use super::Hands;
use super::gloves::other;
use super::obstacles::{axis, counts, level, slides};

/// How far the ray may pass beside what it picks, m. Our choice: a rod is 7 mm thick.
const BESIDE: f32 = 0.03;
/// The same for a place on the bench that keys moved, m.
const BESIDE_PLACE: f32 = 0.04;
/// From the palm to the glass before a hand closes, m: less than half of how far a hand reaches (`GRIP_REACH` of the bodies).
const GAP: f32 = 0.02;
/// Where on its height a flask is taken, and a rod.
const AT_FLASK: f32 = 0.55;
const AT_ROD: f32 = 0.75;
/// Cosine of the lean from which on a thing lies.
pub(super) const LIES: f32 = 0.7;
/// Distance of the palm from other things, m, at which a closing hand takes the right one.
const APART: f32 = 0.04;
/// Farthest place that a ray points to, m.
const FAR: f32 = 5.0;

/// A ray: its origin, and a unit vector.
pub(super) type Ray = (Vec3, Vec3);

impl Hands {
    /// What a press would act on, after the last frame; `None` while the active hand holds something or takes it.
    pub fn pointed(&self) -> Option<Pointed> {
        let picked = self.picked.filter(|_| self.press.is_none());
        match picked {
            _ if !self.movers[self.active as usize].is_free() => None,
            _ if self.on_panel => Some(Pointed::Panel),
            _ if self.on_glove => Some(Pointed::Glove(other(self.active))),
            picked => picked.map(Pointed::Thing),
        }
    }
}

/// Where a ray meets the plane through `point` with that normal.
pub(super) fn plane((from, along): Ray, point: Vec3, normal: Vec3) -> Option<Vec3> {
    let steep = along.dot(normal);
    let way = (point - from).dot(normal) / steep;
    // A ray along the plane gives infinity or no number, and is refused with them.
    (steep.abs() > 1e-3 && way > 0.0 && way < FAR).then(|| from + way * along)
}

/// Where a ray meets the level plane at that height, m, seen from above.
pub(super) fn at_height(ray: Ray, height: f32) -> Option<Vec2> {
    plane(ray, height * Vec3::Y, Vec3::Y).map(level)
}

/// How far a ray passes beside a point before it, m.
pub(super) fn beside((from, along): Ray, point: Vec3) -> f32 {
    let away = point - from;
    (away - away.dot(along).max(0.0) * along).length()
}

/// Whether a hand can close on a thing.
fn is_of_use(thing: &Thing, table: f32) -> bool {
    counts(thing, table) && thing.grips
}

/// A picked thing, how far beside it the ray passes and how far along the ray it is, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Picked {
    pub thing: usize,
    pub beside: f32,
    pub along: f32,
}

/// The thing that the ray passes nearest, within a few centimetres, and that no hand holds.
pub(super) fn by_ray((from, ray): Ray, around: &Around) -> Option<Picked> {
    let picked = free_things(around).filter_map(|(thing, it)| {
        let count = ((it.height / 0.02).ceil() as usize).clamp(2, 64);
        let nearest = (0..=count).filter_map(|n| {
            let height = it.height * n as f32 / count as f32;
            let away = it.pose.position + height * axis(it) - from;
            let along = away.dot(ray);
            let beside = (away - along * ray).length() - it.radius;
            (along > 0.0).then(|| Picked {
                thing,
                beside: beside.max(0.0),
                along,
            })
        });
        nearest.min_by(|a, b| a.beside.total_cmp(&b.beside))
    });
    picked
        .filter(|it| it.beside <= BESIDE)
        .min_by(|a, b| (a.beside + 0.01 * a.along).total_cmp(&(b.beside + 0.01 * b.along)))
}

/// The thing at a place on the bench.
pub(super) fn by_place(at: Vec2, around: &Around) -> Option<usize> {
    let near = free_things(around).map(|(index, it)| {
        let middle = it.pose.position + 0.5 * it.height * axis(it);
        (index, level(middle).distance(at) - it.radius)
    });
    near.filter(|&(_, apart)| apart <= BESIDE_PLACE)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(index, _)| index)
}

fn free_things(around: &Around) -> impl Iterator<Item = (usize, &Thing)> {
    let things = around.things.iter().enumerate();
    things.filter(move |(index, thing)| {
        !around.holds.contains(&Some(*index)) && is_of_use(thing, around.table)
    })
}

/// Least distance of a point from a thing's surface, m; negative within.
fn distance(thing: &Thing, point: Vec3) -> f32 {
    let at = thing.pose.inverse().transform_point(point);
    let out = Vec2::new(
        at.x.hypot(at.z) - thing.radius,
        (at.y - thing.height).max(-at.y),
    );
    out.max(Vec2::ZERO).length() + out.max_element().min(0.0)
}

/// Distance of a point from the nearest thing that a hand could take there, m.
pub(super) fn nearest(around: &Around, point: Vec3, but: Option<usize>) -> f32 {
    let others = around.things.iter().enumerate();
    others
        .filter(|&(index, it)| Some(index) != but && is_of_use(it, around.table))
        .map(|(_, it)| distance(it, point))
        .fold(f32::INFINITY, f32::min)
}

/// Orientation of a hand whose thumb points there and whose palm looks against `out`; unit vectors, at right angles.
pub(super) fn orientation(side: Side, thumb: Vec3, out: Vec3) -> Quat {
    // +X enters the right palm and leaves the left one.
    let x = match side {
        Side::Right => out,
        Side::Left => -out,
    };
    let z = -thumb;
    Quat::from_mat3(&Mat3::from_cols(x, z.cross(x), z)).normalize()
}

/// From the user's middle to that hand's side.
pub(super) fn outwards(side: Side, right: Vec3) -> Vec3 {
    match side {
        Side::Right => right,
        Side::Left => -right,
    }
}

/// The grip pose (stage_from_grip) from which a hand takes the thing of that index; a long bar it takes next to `spot`.
pub(super) fn grip_at(
    side: Side,
    around: &Around,
    index: usize,
    [right, away]: [Vec3; 2],
    spot: Vec3,
) -> Option<Pose> {
    let thing = around.things.get(index)?;
    let axis = axis(thing);
    let foot = thing.pose.position;
    let aside = outwards(side, right);
    if slides(thing) || axis.y.abs() < LIES {
        let along = (spot - foot).dot(axis);
        let height = match (slides(thing), thing.is_flask()) {
            (true, _) => along.clamp(0.1 * thing.height, 0.9 * thing.height),
            (_, true) => AT_FLASK * thing.height,
            (_, false) => AT_ROD * thing.height,
        };
        let out = across(Vec3::Y, axis);
        let at = foot + height * axis + (thing.radius + GAP) * out;
        return Some(Pose::new(at, orientation(side, axis, out)));
    }
    if !matches!(thing.kind, Kind::Flask | Kind::Rod) {
        let at = foot.with_y(foot.y.max((foot + thing.height * axis).y) + GAP);
        return Some(Pose::new(at, orientation(side, -aside, Vec3::Y)));
    }
    let share = if thing.is_flask() { AT_FLASK } else { AT_ROD };
    let stand = |angle: f32| {
        let out = across(angle.cos() * aside - angle.sin() * away, axis);
        // An Erlenmeyer flask is narrower there than at its foot, and about as narrow as its neck.
        let from_axis = thing.rim.min(thing.radius) + GAP;
        let at = foot + share * thing.height * axis + from_axis * out;
        // Of a flask that stands on its head, too, the thumb is up.
        let thumb = if axis.y < 0.0 { -axis } else { axis };
        Pose::new(at, orientation(side, thumb, out))
    };
    // At its own side, or further to the user, where other glass is so near that the hand would take that.
    let stands = [0.0, 0.8, 1.6, -0.8, 2.4].map(stand);
    let apart = |pose: &Pose| nearest(around, pose.position, Some(index)) > APART;
    stands.into_iter().find(apart).or(Some(stands[0]))
}

/// The hand that takes a flask so that what is poured into the nearest other one does not run over it: that of the other side. `None` of
/// what is no flask, or the only one.
pub(super) fn pours_clear(around: &Around, index: usize, right: Vec3) -> Option<Side> {
    let from = around
        .things
        .get(index)
        .filter(|it| it.is_flask())?
        .pose
        .position;
    let others = around.things.iter().enumerate();
    let ways = others
        .filter(|&(other, it)| other != index && it.is_flask() && is_of_use(it, around.table))
        .map(|(_, it)| it.pose.position - from);
    let nearest = ways.min_by(|a, b| a.length().total_cmp(&b.length()))?;
    Some(if nearest.dot(right) > 0.0 {
        Side::Left
    } else {
        Side::Right
    })
}

/// The part of `vector` across the unit vector `axis`, as a unit vector.
fn across(vector: Vec3, axis: Vec3) -> Vec3 {
    let part = vector - vector.dot(axis) * axis;
    part.try_normalize()
        .unwrap_or_else(|| axis.any_orthonormal_vector())
}
