//! Finds flasks that stand in each other.

use super::contents::Flask;
use glam::DVec3;
use std::f64::consts::TAU;

/// Size over that of the vessel below which its surface is not divided: thousands of times what f64
/// resolves, so that each half is smaller than the whole, however thin the other's wall is.
const RESOLUTION: f64 = 1e-12;

/// Whether the glass of two flasks overlaps. A small flask inside of a large
/// one is fine, so glass is compared with glass: points of each one's surface,
/// half a wall apart or nearer where it matters, against the other's signed distance.
pub(super) fn overlap(a: &Flask, b: &Flask) -> bool {
    let (centre_a, radius_a) = bounding_sphere(a);
    let (centre_b, radius_b) = bounding_sphere(b);
    if centre_a.distance(centre_b) > radius_a + radius_b {
        return false;
    }
    surface_in_glass(a, b) || surface_in_glass(b, a)
}

fn bounding_sphere(flask: &Flask) -> (DVec3, f64) {
    let half = 0.5 * flask.profile.rim_height();
    let radius = half.hypot(flask.profile.outer_radius());
    (stage_from(flask, DVec3::Y * half), radius)
}

fn stage_from(flask: &Flask, point: DVec3) -> DVec3 {
    let pose = flask.stage_from_flask;
    pose.orientation.as_dquat().normalize() * point + pose.position.as_dvec3()
}

/// A distance is at most that of a patch's middle plus the patch's own size, so what lies further from
/// the other's glass than that is not looked at in detail: a walk over all of a wide
/// vessel in steps of another's thin wall would not end.
fn surface_in_glass(of: &Flask, other: &Flask) -> bool {
    let pose = other.stage_from_flask;
    let inverse = pose.orientation.as_dquat().normalize().inverse();
    let profile = &other.profile;
    // Flasks that touch, as stacked or side by side, do not overlap.
    let touching = -0.05 * profile.wall();
    let (_, radius) = bounding_sphere(of);
    let wall = of.profile.wall().min(profile.wall());
    let step = (0.5 * wall).max(RESOLUTION * radius);
    let depth = |point: DVec3| {
        let local = inverse * (stage_from(of, point) - pose.position.as_dvec3());
        profile.signed_distance_glass(local.x.hypot(local.z), local.y) - touching
    };
    of.profile.outer_outline().windows(2).any(|pair| {
        let patch = Patch {
            ends: [pair[0], pair[1]],
            angles: [0.0, TAU],
        };
        patch.any_below_zero(&depth, step)
    })
}

/// A part of a surface of revolution: between two points (r, y) and two angles.
struct Patch {
    ends: [[f64; 2]; 2],
    angles: [f64; 2],
}

impl Patch {
    /// Whether `depth`, which changes by no more than one's way, is below zero somewhere on
    /// the patch, as far as middles of parts up to `step` in size tell.
    fn any_below_zero(&self, depth: &impl Fn(DVec3) -> f64, step: f64) -> bool {
        let [a, b] = self.ends;
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let angle = 0.5 * (self.angles[0] + self.angles[1]);
        let high = (b[0] - a[0]).hypot(b[1] - a[1]);
        let wide = a[0].max(b[0]) * (self.angles[1] - self.angles[0]);
        let here = depth(DVec3::new(
            middle[0] * angle.cos(),
            middle[1],
            middle[0] * angle.sin(),
        ));
        if here < 0.0 {
            return true;
        }
        // Sizes that overflow end the walk as well, since halves of infinity are infinite.
        let size = high + wide;
        let near = size.is_finite() && here <= 0.5 * size;
        if !near || high.max(wide) < step {
            return false;
        }
        let (ends, angles) = (self.ends, self.angles);
        let halves = if high > wide {
            [([a, middle], angles), ([middle, b], angles)]
        } else {
            [(ends, [angles[0], angle]), (ends, [angle, angles[1]])]
        };
        halves
            .into_iter()
            .any(|(ends, angles)| Patch { ends, angles }.any_below_zero(depth, step))
    }
}
