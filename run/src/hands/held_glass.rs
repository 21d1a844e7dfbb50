//! A flask as fingers meet it.

use glam::{Vec2, Vec3};
use vitriol_sim::flask::Profile;

/// How far the outline may be from the profile's, m: less than a finger gives way, and a beaker is then three
/// segments of 257.
const TOLERANCE: f32 = 1e-4;

/// The outside of a flask: what its outline sweeps about the y axis of its frame, closed at the rim.
#[derive(Clone, Debug, PartialEq)]
pub struct Glass {
    /// Of points (radius, height), m, from the axis at the base over the rim to the axis.
    outline: Vec<Segment>,
}

/// One segment of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Segment {
    from: Vec2,
    along: Vec2,
    /// One over the square of its length.
    inverse: f32,
    /// Radius over height along it.
    slope: f32,
}

impl Segment {
    fn of(pair: &[Vec2]) -> Self {
        let along = pair[1] - pair[0];
        Self {
            from: pair[0],
            along,
            inverse: along.length_squared().max(f32::MIN_POSITIVE).recip(),
            slope: along.x / along.y,
        }
    }
}

impl Glass {
    /// That of a profile, at `length_scale` real metres for a unit of its own.
    pub fn of(profile: &Profile, length_scale: f64) -> Self {
        let real =
            |&[r, y]: &[f64; 2]| Vec2::new((r * length_scale) as f32, (y * length_scale) as f32);
        let points: Vec<_> = profile.outer_outline().iter().map(real).collect();
        let mut outline = simplified(&points);
        if let Some(rim) = outline.last().copied() {
            outline.push(Vec2::new(0.0, rim.y));
        }
        Self {
            outline: outline.windows(2).map(Segment::of).collect(),
        }
    }

    /// Signed distance (m) of a place in the flask's frame from the outside; negative within.
    pub fn distance(&self, at: Vec3) -> f32 {
        let at = Vec2::new((at.x * at.x + at.z * at.z).sqrt(), at.y);
        let mut nearest = f32::INFINITY;
        let mut inside = false;
        for segment in &self.outline {
            let Segment { from, along, .. } = *segment;
            let away = at - from;
            let share = (away.dot(along) * segment.inverse).clamp(0.0, 1.0);
            nearest = nearest.min((away - share * along).length_squared());
            // A ray towards greater radii crosses the outline an odd number of times from within.
            let crosses = (from.y > at.y) != (from.y + along.y > at.y);
            inside ^= crosses && away.x < segment.slope * away.y;
        }
        if inside {
            -nearest.sqrt()
        } else {
            nearest.sqrt()
        }
    }
}

/// The fewest of the points whose segments are within the tolerance of all (U. Ramer 1972; D. Douglas and T. Peucker 1973).
fn simplified(points: &[Vec2]) -> Vec<Vec2> {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
        return Vec::new();
    };
    let along = last - first;
    let away = |point: &Vec2| {
        let from = *point - first;
        let share = from.dot(along) / along.length_squared().max(f32::MIN_POSITIVE);
        (from - share.clamp(0.0, 1.0) * along).length()
    };
    let farthest = points.iter().map(away).enumerate();
    match farthest.max_by(|(_, a), (_, b)| a.total_cmp(b)) {
        Some((index, distance)) if distance > TOLERANCE => {
            let mut kept = simplified(&points[..=index]);
            kept.pop();
            kept.extend(simplified(&points[index..]));
            kept
        }
        _ => vec![first, last],
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use vitriol_sim::flask::glassware::GLASSWARE;

    /// As in the profile's own table, for each vessel there is, outside and within.
    #[test]
    fn a_few_segments_are_as_good_as_the_table() {
        for named in &GLASSWARE {
            let profile = named.profile(1.0).unwrap();
            let glass = Glass::of(&profile, 1.0);
            assert!(
                glass.outline.len() <= 40,
                "{}: {}",
                named.name,
                glass.outline.len()
            );
            let rim = profile.rim_height() as f32;
            for n in 1..40 {
                let y = rim * n as f32 / 40.0;
                let radius = profile.outer_radius_at(y.into()) as f32;
                for (apart, turn) in [(0.01, 0.3), (0.0, 1.0), (-0.001, 2.0)] {
                    let r = radius + apart;
                    let found =
                        glass.distance(Vec3::new(r * f32::cos(turn), y, r * f32::sin(turn)));
                    // On a slope the way to the wall is shorter than across.
                    assert!(
                        found.abs() <= f32::abs(apart) + 2.0 * TOLERANCE,
                        "{}: {y} {apart}",
                        named.name
                    );
                    assert!(
                        apart == 0.0 || found.signum() == apart.signum(),
                        "{}: {y} {apart} {found}",
                        named.name
                    );
                }
            }
            assert!((glass.distance(Vec3::Y * (rim + 0.02)) - 0.02).abs() < 1e-6);
        }
    }
}
