//! Lines that help a pointer: what a press would take, where a pour would fall, and what is under a hand.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};
use vitriol_xr::{Around, Line, Pose, Thing};

use super::obstacles::{axis, counts, level, slides};
use super::pointing::LIES;

/// Radius of the lines, m.
const THICK: f32 = 0.0012;
const THIN: f32 = 0.0008;
/// Straight parts of a ring, and the most lines: the picture has bones for so many.
const PARTS: usize = 12;
pub(super) const MOST: usize = 40;
/// From the palm's middle to the wrist, m: half a hand (0.19 m, median of adults: NASA-STD-3000); and radius of a ring around it.
const WRIST: f32 = 0.095;
const WRIST_RING: f32 = 0.045;
/// From a thing to its ring, and of a ring over what it lies on, m.
const OFF: f32 = 0.006;
const OVER: f32 = 0.003;
/// Half a cross on the bench, m.
const CROSS: f32 = 0.012;
/// Sine of the tilt from which on a pour's line is shown: 10°.
const TILTED: f32 = 0.17;

/// What a press would take: a ring around its foot, or a line along a thing that lies or hangs.
pub(super) fn mark(thing: &Thing, lines: &mut Vec<Line>) {
    let (foot, axis) = (thing.pose.position, axis(thing));
    if axis.y.abs() < LIES || slides(thing) {
        let over = (thing.radius + OFF) * Vec3::Y;
        lines.push(Line {
            from: foot + over,
            to: foot + thing.height * axis + over,
            radius: THICK,
        });
        return;
    }
    let flat = Pose::new(foot + OVER * Vec3::Y, Quat::IDENTITY);
    ring(&flat, thing.radius + OFF, THICK, lines);
}

/// A glove that a press would pull off: a ring around the wrist of the hand with that grip pose, whose +Y leads to the wrist.
pub(super) fn wrist(grip: &Pose, lines: &mut Vec<Line>) {
    let wrist = Pose::new(grip.transform_point(WRIST * Vec3::Y), grip.orientation);
    ring(&wrist, WRIST_RING, THICK, lines);
}

/// Where a hand that holds nothing points on the bench.
pub(super) fn cross(at: Vec3, lines: &mut Vec<Line>) {
    for arm in [Vec3::X, Vec3::Z] {
        lines.push(Line {
            from: at + OVER * Vec3::Y - CROSS * arm,
            to: at + OVER * Vec3::Y + CROSS * arm,
            radius: THIN,
        });
    }
}

/// Of a held thing at that pose: the way of the pour, where it is tilted and can be poured from, and rings: where the pour ends, and the
/// thing's shadow straight below.
pub(super) fn held(
    around: &Around,
    index: usize,
    pose: &Pose,
    lines: &mut Vec<Line>,
    rings: &mut Vec<Line>,
) {
    let Some(thing) = around.things.get(index).filter(|it| !slides(it)) else {
        return;
    };
    let axis = pose.orientation * Vec3::Y;
    let over = |place: Vec3| Pose::new(place + OVER * Vec3::Y, Quat::IDENTITY);
    if let Some(lip) = lip(thing, pose).filter(|_| thing.is_flask()) {
        let to = under(around, index, lip);
        lines.push(Line {
            from: lip,
            to,
            radius: THICK,
        });
        ring(&over(to), OFF, THICK, rings);
    }
    let middle = pose.position + 0.5 * thing.height * axis;
    let shadow = under(around, index, middle);
    ring(&over(shadow), thing.radius, THIN, rings);
}

/// The lowest point of a tilted flask's rim; `None` where it is upright.
fn lip(thing: &Thing, pose: &Pose) -> Option<Vec3> {
    let axis = pose.orientation * Vec3::Y;
    let down = axis.y * axis - Vec3::Y;
    let steep = down.length();
    (steep > TILTED).then(|| {
        let rim = pose.position + thing.height * axis;
        rim + thing.rim / steep * down
    })
}

/// What is straight below a point: the bottom of a flask through its mouth, the top of another thing, or the table.
fn under(around: &Around, but: usize, point: Vec3) -> Vec3 {
    let place = level(point);
    let others = around.things.iter().enumerate();
    let below = others
        .filter(|&(index, it)| index != but && counts(it, around.table) && !slides(it))
        .filter_map(|(_, it)| {
            let foot = it.pose.position;
            let away = level(foot).distance(place);
            let stands = axis(it).y > LIES && foot.y < point.y;
            let height = match it.is_flask() && away < it.rim {
                true => OVER,
                false => it.height,
            };
            (stands && away < it.radius).then_some(foot.y + height)
        });
    point.with_y(below.fold(around.table, f32::max))
}

/// A ring around the +Y axis of a pose.
fn ring(middle: &Pose, radius: f32, thick: f32, lines: &mut Vec<Line>) {
    let at = |n: usize| {
        let (sin, cos) = (TAU * n as f32 / PARTS as f32).sin_cos();
        middle.transform_point(radius * Vec3::new(cos, 0.0, sin))
    };
    lines.extend((0..PARTS).map(|n| Line {
        from: at(n),
        to: at(n + 1),
        radius: thick,
    }));
}
