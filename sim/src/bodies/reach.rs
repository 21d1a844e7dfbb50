//! How far a hand is from a flask.

use glam::{Vec2, Vec3};

/// Signed distance (m) of `point`, in the flask's frame, from the solid that
/// `outline` ([radius, height]) sweeps about the y axis, closed flat at the rim:
/// negative inside, so that of two flasks at the hand the one it is in is nearer.
pub(super) fn signed_distance(outline: &[[f32; 2]], point: Vec3) -> f32 {
    let p = Vec2::new(point.x.hypot(point.z), point.y);
    let rim = outline.last().map_or(Vec2::ZERO, |&last| last.into());
    let lid = (rim, Vec2::new(0.0, rim.y));
    let walls = outline
        .windows(2)
        .map(|pair| (Vec2::from(pair[0]), Vec2::from(pair[1])));

    let mut nearest_sq = f32::INFINITY;
    let mut inside = false;
    for (a, b) in walls.chain([lid]) {
        let along = b - a;
        let t =
            ((p - a).dot(along) / along.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        nearest_sq = nearest_sq.min((p - a - along * t).length_squared());
        // Even–odd rule with a ray towards greater radius; the axis closes the polygon
        // at radius 0, which no such ray from r ≥ 0 meets.
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + along.x * (p.y - a.y) / along.y {
            inside = !inside;
        }
    }
    let distance = nearest_sq.sqrt();
    if inside { -distance } else { distance }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beaker_from_every_side() {
        let outline = [[0.0, 0.0], [0.03, 0.0], [0.03, 0.1]];
        let cases = [
            (Vec3::new(0.05, 0.05, 0.0), 0.02),
            (Vec3::new(0.0, 0.05, -0.04), 0.01),
            (Vec3::new(0.0, 0.13, 0.0), 0.03),
            (Vec3::new(0.01, -0.02, 0.0), 0.02),
            (Vec3::new(0.06, 0.14, 0.0), 0.05),
            (Vec3::new(0.02, 0.05, 0.0), -0.01),
            (Vec3::new(0.0, 0.05, 0.0), -0.03),
        ];
        for (point, expected) in cases {
            let found = signed_distance(&outline, point);
            assert!(
                (found - expected).abs() < 1e-6,
                "{point}: {found} is not {expected}"
            );
        }
    }

    /// A waisted profile: the shortest way to its neck is not through its foot.
    #[test]
    fn erlenmeyer_neck() {
        let outline = [[0.0, 0.0], [0.04, 0.0], [0.01, 0.06], [0.01, 0.1]];
        assert!((signed_distance(&outline, Vec3::new(0.0, 0.08, 0.05)) - 0.04).abs() < 1e-6);
        assert!(signed_distance(&outline, Vec3::new(0.03, 0.01, 0.0)) < 0.0);
        assert!(signed_distance(&outline, Vec3::new(0.03, 0.05, 0.0)) > 0.0);
    }
}
