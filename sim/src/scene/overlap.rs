//! Finds flasks that stand in each other.

use super::Flask;
use glam::DVec3;
use std::f64::consts::TAU;

/// Whether the glass of two flasks overlaps. A small flask inside of a large
/// one is fine, so glass is compared with glass: points of each one's surface,
/// half a wall apart or nearer, against the other's signed distance.
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

fn surface_in_glass(of: &Flask, other: &Flask) -> bool {
    let pose = other.stage_from_flask;
    let inverse = pose.orientation.as_dquat().normalize().inverse();
    let profile = &other.profile;
    // Flasks that touch, as stacked or side by side, do not overlap.
    let touching = -0.05 * profile.wall();
    let step = 0.5 * of.profile.wall().min(profile.wall());
    let reach = profile.outer_radius();
    surface(of, step).any(|point| {
        let local = inverse * (stage_from(of, point) - pose.position.as_dvec3());
        let r = local.x.hypot(local.z);
        let near = r <= reach && (0.0..=profile.rim_height()).contains(&local.y);
        near && profile.signed_distance_glass(r, local.y) < touching
    })
}

/// Points of the outer surface, in the flask's frame, up to `step` apart.
fn surface(flask: &Flask, step: f64) -> impl Iterator<Item = DVec3> + '_ {
    flask
        .profile
        .outer_outline()
        .windows(2)
        .flat_map(move |pair| {
            let [a, b] = [pair[0], pair[1]];
            let rows = ((b[0] - a[0]).hypot(b[1] - a[1]) / step).ceil().max(1.0) as usize;
            (0..=rows).map(move |i| {
                let t = i as f64 / rows as f64;
                [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
            })
        })
        .flat_map(move |[r, y]| {
            let count = (TAU * r / step).ceil().max(1.0) as usize;
            (0..count).map(move |i| {
                let angle = TAU * i as f64 / count as f64;
                DVec3::new(r * angle.cos(), y, r * angle.sin())
            })
        })
}
