//! Outlines of glass as the rays of `common/picture/glass_light.wgsl` meet them: segments with the normals at their
//! ends, each two `vec4`.

use glam::Vec2;

/// Segments that meet at less than this share a smooth normal; a beaker's rim and foot stay sharp.
const CREASE_COS: f32 = 0.77;

/// How far a point may lie beside the segment that replaces it, over the greatest radius: 20 µm on a
/// beaker of 250 mL, of which a headset's pixel at arm's length is 30 times as large.
const TOLERANCE: f32 = 5e-4;

/// The segments of a closed outline about +Y, (r, y) in the scene's unit, from the axis up the outside, over
/// the rim, and down the inside to the axis: (r, y) of both ends, then both normals, which
/// point out of the glass. Points that coincide are taken as one.
pub fn segments(outer: &[[f64; 2]], inner: &[[f64; 2]]) -> Vec<[f32; 4]> {
    let points = |outline: &[[f64; 2]]| -> Vec<Vec2> {
        let points: Vec<_> = outline
            .iter()
            .map(|&[r, y]| Vec2::new(r as f32, y as f32))
            .collect();
        simplified(&points)
    };
    let mut points: Vec<Vec2> = points(outer)
        .into_iter()
        .chain(points(inner).into_iter().rev())
        .collect();
    points.dedup_by(|a, b| a.distance(*b) < 1e-6);
    let tangents: Vec<Vec2> = points
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).normalize())
        .collect();
    let normal = |tangent: Vec2| Vec2::new(tangent.y, -tangent.x);
    let mut table = Vec::new();
    for (index, &tangent) in tangents.iter().enumerate() {
        let smooth = |neighbour: Option<&Vec2>| match neighbour {
            Some(other) if other.dot(tangent) > CREASE_COS => (tangent + *other).normalize(),
            _ => tangent,
        };
        let before = index.checked_sub(1).and_then(|index| tangents.get(index));
        let (a, b) = (points[index], points[index + 1]);
        let (from, to) = (
            normal(smooth(before)),
            normal(smooth(tangents.get(index + 1))),
        );
        table.push([a.x, a.y, b.x, b.y]);
        table.push([from.x, from.y, to.x, to.y]);
    }
    table
}

/// The outline without points that lie within [`TOLERANCE`] of the rest (Douglas and Peucker).
fn simplified(points: &[Vec2]) -> Vec<Vec2> {
    let reach = points.iter().map(|point| point.x).fold(0.0, f32::max);
    let mut kept = Vec::new();
    keep(points, TOLERANCE * reach, &mut kept);
    kept.extend(points.last());
    kept
}

fn keep(points: &[Vec2], tolerance: f32, kept: &mut Vec<Vec2>) {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
        return;
    };
    let along = (last - first).normalize_or_zero();
    let aside = |point: &Vec2| (*point - first).perp_dot(along).abs();
    let furthest = points
        .iter()
        .enumerate()
        .map(|(index, point)| (index, aside(point)))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    match furthest {
        Some((index, way)) if way > tolerance && points.len() > 2 => {
            keep(&points[..=index], tolerance, kept);
            keep(&points[index..], tolerance, kept);
        }
        _ if points.len() > 1 => kept.push(first),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn cup_is_its_corners_and_every_normal_points_out() {
        let outer: Vec<[f64; 2]> = std::iter::once([0.0, 0.0])
            .chain((0..=20).map(|step| [0.042, 0.005 * f64::from(step)]))
            .collect();
        let inner = [[0.0, 0.002], [0.040, 0.002], [0.040, 0.1]];
        let table = segments(&outer, &inner);
        let ends: Vec<_> = table.iter().step_by(2).copied().collect();
        let normals: Vec<_> = table.iter().skip(1).step_by(2).copied().collect();
        let expected = [
            [0.0, 0.0, 0.042, 0.0],
            [0.042, 0.0, 0.042, 0.1],
            [0.042, 0.1, 0.040, 0.1],
            [0.040, 0.1, 0.040, 0.002],
            [0.040, 0.002, 0.0, 0.002],
        ];
        assert_eq!(ends, expected);
        // Down, outwards, up, to the axis, up.
        let out = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 1.0]];
        for (normal, [r, y]) in normals.iter().zip(out) {
            // Corners are sharp: both ends have the segment's own.
            for at in [0, 2] {
                assert!((normal[at] - r).abs() < 1e-6 && (normal[at + 1] - y).abs() < 1e-6);
            }
        }
    }

    /// On a sphere's outline the smoothed normals are the radii, and dropped points lie within the tolerance.
    #[test]
    fn round_outline_is_smooth() {
        let outer: Vec<[f64; 2]> = (0..=256)
            .map(|step| {
                let (sin, cos) = (PI * f64::from(step) / 256.0).sin_cos();
                [(0.05 * sin).max(0.0), -0.05 * cos]
            })
            .collect();
        let table = segments(&outer, &[]);
        let count = table.len() / 2;
        // A chord of the angle 2a leaves its arc by 1 − cos a: 50 of them, or by halving 64.
        assert!((40..70).contains(&count), "{count} segments");
        for pair in table.chunks(2) {
            let [ends, normals] = pair else { continue };
            let (at, normal) = (
                Vec2::new(ends[0], ends[1]) / 0.05,
                Vec2::new(normals[0], normals[1]),
            );
            // The pole has the chord's normal.
            assert!(at.dot(normal) > 0.999, "{at} {normal}");
            let middle = 0.5 * (at + Vec2::new(ends[2], ends[3]) / 0.05);
            assert!(1.0 - middle.length() < 1.5 * TOLERANCE, "{middle}");
        }
    }
}
