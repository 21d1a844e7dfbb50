//! A flask's colliding shape: its outline revolved, in convex pieces.

use std::f32::consts::TAU;

use glam::{Mat3, Quat, Vec2, Vec3};
use rapier3d::math::Pose as Pose3;
use rapier3d::prelude::SharedShape;

use super::units::UNIT;

/// Sides of a revolved piece that is no cylinder. A 24-gon of 40 mm radius is
/// within 0.4 mm of its circle.
const SIDES: usize = 24;
/// How far (in rapier's unit; 0.3 mm at real size) the colliding outline may leave the true one:
/// below what one sees at arm's length, and a fillet of twenty points becomes two or three.
const OUTLINE_TOLERANCE: f32 = 3e-4 / UNIT;
/// Height (in rapier's unit; 1 mm at real size) of the discs at foot and rim.
const DISC_HEIGHT: f32 = 1e-3 / UNIT;

/// A convex piece and where it lies in the flask's frame.
pub(super) type Piece = (SharedShape, Pose3);

/// The pieces of the flask whose outer surface is `outline` (radius, height;
/// heights never decrease), all in rapier's unit. The solid is filled up to
/// the rim: only liquid goes inside. `None` where the outline encloses nothing.
///
/// Straight walls become cylinders, which roll without corners. The rest
/// becomes convex hulls, with a thin cylinder as foot and as rim: parry (0.31)
/// makes its contacts from the first four corners of a hull's n-sided face, so
/// that a flask on a hull's base would stand on a sixth of it.
pub(super) fn pieces(outline: &[Vec2]) -> Option<Vec<Piece>> {
    let (tolerance, disc) = (OUTLINE_TOLERANCE, DISC_HEIGHT);
    let simple = simplify(outline, tolerance);
    let top = *simple.last()?;
    let foot = simple
        .iter()
        .filter(|point| point.y <= 0.1 * tolerance)
        .fold(0.0, |radius: f32, point| radius.max(point.x));
    let stands = foot > disc;

    let mut pieces = Vec::new();
    let mut hulls = false;
    for run in convex_runs(&simple) {
        let wall = wall(run);
        let height = wall[wall.len() - 1].y - wall[0].y;
        if height <= 0.1 * tolerance {
            continue;
        }
        let radius = wall
            .iter()
            .fold(0.0, |radius: f32, point| radius.max(point.x));
        if wall.iter().all(|point| radius - point.x <= tolerance) {
            pieces.push(cylinder(radius, wall[0].y, wall[wall.len() - 1].y));
        } else {
            hulls = true;
            // Clear of the planes of foot and rim, whose contacts are the cylinders'.
            let lowest = if stands { 0.5 * disc } else { 0.0 };
            pieces.push((hull(wall, lowest, top.y - 0.5 * disc)?, Pose3::IDENTITY));
        }
    }
    if hulls {
        if stands {
            pieces.push(cylinder(foot, 0.0, disc));
        }
        pieces.push(cylinder(top.x, top.y - disc, top.y));
    }
    (!pieces.is_empty()).then_some(pieces)
}

/// Drops the points that are within `tolerance` of the chord that replaces
/// them (Douglas and Peucker 1973).
fn simplify(points: &[Vec2], tolerance: f32) -> Vec<Vec2> {
    let [first, inner @ .., last] = points else {
        return points.to_vec();
    };
    let chord = (*last - *first).normalize_or_zero();
    let farthest = inner
        .iter()
        .map(|&point| chord.perp_dot(point - *first).abs())
        .enumerate()
        .max_by(|(_, a), (_, b)| a.total_cmp(b));
    match farthest {
        Some((index, distance)) if distance > tolerance => {
            let mut left = simplify(&points[..=index + 1], tolerance);
            left.pop();
            left.extend(simplify(&points[index + 1..], tolerance));
            left
        }
        _ => vec![*first, *last],
    }
}

/// Cuts the outline where it turns outwards, at a neck or a lip: between two
/// cuts radius is a concave function of height, so the solid of revolution is convex.
fn convex_runs(points: &[Vec2]) -> Vec<&[Vec2]> {
    let mut runs = Vec::new();
    let mut start = 0;
    for corner in 1..points.len() - 1 {
        let before = points[corner] - points[corner - 1];
        let after = points[corner + 1] - points[corner];
        if before.perp_dot(after) < 0.0 {
            runs.push(&points[start..=corner]);
            start = corner;
        }
    }
    runs.push(&points[start..]);
    runs
}

/// A run without the level pieces at its ends, which lie in the planes of its caps.
fn wall(run: &[Vec2]) -> &[Vec2] {
    let (bottom, top) = (run[0].y, run[run.len() - 1].y);
    let first = run.iter().rposition(|point| point.y <= bottom).unwrap_or(0);
    let last = run
        .iter()
        .position(|point| point.y >= top)
        .unwrap_or(run.len() - 1);
    if first < last {
        &run[first..=last]
    } else {
        run
    }
}

/// An upright cylinder between two heights; parry's is centred and along y, too.
fn cylinder(radius: f32, bottom: f32, top: f32) -> Piece {
    (
        SharedShape::cylinder(0.5 * (top - bottom), radius),
        Pose3::translation(0.0, 0.5 * (bottom + top), 0.0),
    )
}

fn hull(run: &[Vec2], lowest: f32, highest: f32) -> Option<SharedShape> {
    let mut points = Vec::with_capacity(run.len() * SIDES);
    for point in run {
        let height = point.y.clamp(lowest, highest);
        for side in 0..SIDES {
            // glam's trigonometry is libm's here, the same on every platform; std's is not.
            let around = Vec2::from_angle(TAU * side as f32 / SIDES as f32) * point.x;
            points.push(Vec3::new(around.x, height, around.y));
            if point.x == 0.0 {
                break;
            }
        }
    }
    SharedShape::convex_hull(&points)
}

/// A block about the outline, of a tool: a thin rod rolls for ever on a round side, and the corners of its ends are too near to each other
/// for parry (see [`UNIT`](super::units::UNIT)).
pub(super) fn block(outline: &[Vec2]) -> Option<Vec<Piece>> {
    let radius = outline.iter().fold(0.0_f32, |widest, it| it.x.max(widest));
    let half = 0.5 * outline.last()?.y;
    let solid = radius > 0.0 && half > 0.0;
    let shape = SharedShape::cuboid(radius, half, radius);
    solid.then(|| vec![(shape, Pose3::from_translation(half * Vec3::Y))])
}

/// The pieces of a sash: a bar along the body's y axis, and over it, in the orientation `stage_from_bar`, a pane as broad as the bar is
/// long, of the given height over its axis and the given thickness.
pub(super) fn sash(
    outline: &[Vec2],
    [height, thickness]: [f32; 2],
    stage_from_bar: Quat,
) -> Option<Vec<Piece>> {
    let mut pieces = block(outline)?;
    let half = 0.5 * outline.last()?.y;
    let up = stage_from_bar.inverse() * Vec3::Y;
    // Its sides: along the bar, up, and across.
    let axes = Mat3::from_cols(Vec3::Y.cross(up), Vec3::Y, up);
    let shape = SharedShape::cuboid(0.5 * thickness, half, 0.5 * height);
    let middle = half * Vec3::Y + 0.5 * height * up;
    let place = Pose3::from_parts(middle, Quat::from_mat3(&axes));
    let solid = height > 0.0 && thickness > 0.0;
    pieces.push((shape, place));
    solid.then_some(pieces)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use std::f32::consts::PI;

    use super::*;

    fn in_units(outline: &[[f32; 2]]) -> Option<Vec<Piece>> {
        let outline: Vec<Vec2> = outline.iter().map(|&p| Vec2::from(p) / UNIT).collect();
        pieces(&outline)
    }

    fn round_bottomed() -> Vec<[f32; 2]> {
        let radius = 0.0425;
        let neck: f32 = 0.017;
        let end = PI - (neck / radius).asin();
        let mut outline: Vec<[f32; 2]> = (0..=60)
            .map(|i| end * i as f32 / 60.0)
            .map(|angle| [radius * angle.sin(), radius * (1.0 - angle.cos())])
            .collect();
        outline[0] = [0.0, 0.0];
        outline.extend([[neck, 0.130], [0.021, 0.135], [0.021, 0.140]]);
        outline
    }

    /// The pieces together are the profile: a millimetre and a half beneath
    /// the outline there is glass, a millimetre and a half above it there is none.
    #[test]
    fn pieces_fill_the_outline() {
        let outlines = [
            vec![[0.0, 0.0], [0.035, 0.0], [0.035, 0.095]],
            vec![
                [0.0, 0.0],
                [0.032, 0.0],
                [0.035, 0.003],
                [0.035, 0.09],
                [0.038, 0.095],
            ],
            vec![
                [0.0, 0.0],
                [0.042, 0.0],
                [0.042, 0.01],
                [0.017, 0.105],
                [0.017, 0.14],
            ],
            vec![
                [0.0, 0.0],
                [0.042, 0.0],
                [0.042, 0.003],
                [0.013, 0.003],
                [0.013, 0.25],
            ],
            round_bottomed(),
        ];
        for outline in &outlines {
            let pieces = in_units(outline).unwrap();
            let filled = |point: Vec2| {
                // Between two corners of the 24-gon, where the hull is thinnest.
                let around = Vec2::from_angle(PI / SIDES as f32) * point.x;
                let point = Vec3::new(around.x, point.y, around.y) / UNIT;
                pieces
                    .iter()
                    .any(|(shape, pose)| shape.contains_point(pose, point))
            };
            for pair in outline.windows(2) {
                let (a, b) = (Vec2::from(pair[0]), Vec2::from(pair[1]));
                if a.distance(b) < 1e-3 {
                    continue;
                }
                let out = -(b - a).normalize().perp();
                for fraction in [0.1, 0.5, 0.9] {
                    let surface = a.lerp(b, fraction);
                    assert!(!filled(surface + out * 1.5e-3), "glass outside {surface}");
                    let inner = surface - out * 1.5e-3;
                    // Near a sharp corner the point beneath one wall lies beyond the other.
                    let beneath = super::super::reach::signed_distance(
                        outline,
                        Vec3::new(inner.x.max(0.0), inner.y, 0.0),
                    ) < -1e-3;
                    assert!(!beneath || filled(inner), "no glass beneath {surface}");
                }
            }
        }
    }

    /// A beaker is one cylinder; the shape that rolls and stands best.
    #[test]
    fn straight_walls_are_cylinders() {
        let beaker = in_units(&[[0.0, 0.0], [0.035, 0.0], [0.035, 0.095]]).unwrap();
        assert_eq!(beaker.len(), 1);
        let cylinder = beaker[0].0.as_cylinder().unwrap();
        assert_eq!(
            (cylinder.radius * UNIT, cylinder.half_height * UNIT),
            (0.035, 0.0475)
        );
        assert!(in_units(&[[0.0, 0.0], [0.02, 0.0], [0.03, 0.0]]).is_none());
    }
}
