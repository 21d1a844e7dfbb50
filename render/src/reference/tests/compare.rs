#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
use super::*;
use crate::camera::{Fov, View};
use crate::reference::Rays;
use glam::Vec3;
use std::f64::consts::PI;

const SPACING: f64 = 0.004;
const RADIUS: f64 = 0.002;

/// A left eye's frustum; a right eye's is its mirror image.
const LEFT: Fov = Fov {
    left: -0.32,
    right: 0.24,
    up: 0.24,
    down: -0.26,
};

fn eye(x: f32) -> Rays {
    let fov = if x > 0.0 {
        Fov {
            left: -LEFT.right,
            right: -LEFT.left,
            ..LEFT
        }
    } else {
        LEFT
    };
    let view = View {
        stage_from_eye: glam::Affine3A::from_translation(Vec3::new(x, 1.0, 0.0)),
        fov,
    };
    Rays::new(&view, [200, 180], 1.0)
}

/// A picture from the depth at which each ray hits and its way through the liquid, as view depths.
fn draw(rays: &Rays, hit: impl Fn(DVec3, DVec3) -> Option<(f64, f64)>) -> Picture {
    let [width, height] = rays.size();
    let hits: Vec<_> = (0..width * height)
        .map(|pixel| hit(rays.eye, rays.through(pixel)).unwrap_or((f64::INFINITY, 0.0)))
        .collect();
    let each =
        |of: fn(&(f64, f64)) -> f64| hits.iter().map(|hit| of(hit) as f32).collect::<Vec<_>>();
    Picture::drawn(rays, &each(|hit| hit.0), &each(|hit| hit.1))
}

/// The half-space beyond a plane through (0, 1, −0.4).
fn plane(normal: DVec3) -> impl Fn(DVec3, DVec3) -> Option<(f64, f64)> {
    move |eye, ray| {
        let point = DVec3::new(0.0, 1.0, -0.4);
        Some(((point - eye).dot(normal) / ray.dot(normal), 0.01))
    }
}

const CENTRE: DVec3 = DVec3::new(0.02, 1.01, -0.4);

fn ball(radius: f64) -> impl Fn(DVec3, DVec3) -> Option<(f64, f64)> {
    move |eye, ray| {
        let from = eye - CENTRE;
        let (aa, ab) = (ray.length_squared(), ray.dot(from));
        let root = ab * ab - aa * (from.length_squared() - radius * radius);
        let chord = 2.0 * root.max(0.0).sqrt() / aa;
        (root > 0.0).then(|| ((-ab - root.sqrt()) / aa, chord))
    }
}

#[test]
fn planes_differ_by_their_distance_and_tilt() {
    let rays = eye(-0.03);
    let truth = draw(&rays, plane(DVec3::Z));
    let interior = Interior::new(&truth, SPACING);
    let nearer = draw(&rays, |eye, ray| {
        plane(DVec3::Z)(eye, ray).map(|(depth, way)| (depth - 0.0005, way))
    });
    let found = difference(&truth, &nearer, &interior, SPACING);
    // f32 depths of 0.4 m: 3e-8 m.
    assert!((found.depth_rms - 0.25).abs() < 1e-4, "{found:?}");
    assert!((found.depth_mean + 0.25).abs() < 1e-4, "{found:?}");
    let tilted = draw(&rays, plane(DVec3::new(0.0, 0.1_f64.sin(), 0.1_f64.cos())));
    let found = difference(&truth, &tilted, &interior, SPACING);
    assert!((found.normal_angle - 0.1).abs() < 1e-3, "{found:?}");
    assert!(difference(&truth, &truth, &interior, SPACING).depth_rms == 0.0);
}

#[test]
fn silhouettes_count_by_area() {
    let rays = eye(-0.03);
    let square = |from: usize| {
        let inside = |pixel: usize| {
            (from..from + 40).contains(&(pixel % 200)) && (20..60).contains(&(pixel / 200))
        };
        let depth: Vec<f32> = (0..200 * 180)
            .map(|pixel| if inside(pixel) { 0.4 } else { f32::INFINITY })
            .collect();
        Picture::drawn(&rays, &depth, &vec![0.0; depth.len()])
    };
    assert_eq!(silhouette_iou(&square(50), &square(50)), 1.0);
    assert_eq!(silhouette_iou(&square(50), &square(58)), 32.0 / 48.0);
    assert_eq!(silhouette_iou(&square(50), &square(100)), 0.0);
}

#[test]
fn interior_keeps_a_spacing_from_edges() {
    let truth = draw(&eye(-0.03), ball(0.04));
    let interior = Interior::new(&truth, SPACING);
    let pixel = 0.36 * truth.rays.pixel_area().sqrt();
    assert_eq!(interior.margin, (SPACING / pixel).ceil() as usize);
    // By brute force: the way to the nearest pixel without liquid, along rows
    // or columns, whichever is longer.
    let at = |pixel: usize| [pixel % 200, pixel / 200];
    let empty: Vec<_> = (0..truth.depth.len())
        .filter(|&pixel| truth.depth[pixel].is_infinite())
        .map(at)
        .collect();
    for pixel in (0..truth.depth.len()).filter(|&pixel| truth.depth[pixel].is_finite()) {
        let [x, y] = at(pixel);
        let away = empty.iter().map(|&[u, v]| x.abs_diff(u).max(y.abs_diff(v)));
        let away = away.min().unwrap();
        let towards = -truth.rays.through(pixel).normalize();
        let facing = truth.normal[pixel].dot(towards) > 0.25;
        // Diagonally an edge may be one pixel farther.
        let (least, surely) = (interior.margin + 1, interior.margin + 2);
        let inside = interior.inside[pixel];
        assert!(!inside || facing && away >= least, "({x}, {y})");
        assert!(inside || !facing || away < surely, "({x}, {y})");
    }
    assert!(interior.pixels().count() > 1000);
}

#[test]
fn interior_leaves_out_what_is_seen_edgewise() {
    // 80° from the eye's axis and farther to the sides, above a cosine of ¼.
    let slanting = DVec3::new(0.0, 80_f64.to_radians().sin(), 80_f64.to_radians().cos());
    let truth = draw(&eye(-0.03), plane(slanting));
    let interior = Interior::new(&truth, SPACING);
    assert!(interior.pixels().count() > 100);
    for pixel in interior.pixels() {
        let towards = -truth.rays.through(pixel).normalize();
        // Normals of f32 depths.
        assert!(slanting.dot(towards) > 0.249);
    }
    let interior = Interior::new(&draw(&eye(-0.03), plane(DVec3::Z)), SPACING);
    assert!(interior.pixels().count() > 20_000);
}

/// Compares two eyes' pictures where by the truth both see the liquid.
fn reprojected(truths: &[Picture; 2], pictures: [&Picture; 2]) -> Difference {
    let interiors = truths.each_ref().map(|truth| Interior::new(truth, SPACING));
    let seen = [0, 1].map(|k| Seen {
        truth: &truths[k],
        interior: &interiors[k],
    });
    reprojection(pictures, seen, SPACING)
}

#[test]
fn what_both_eyes_see_fits() {
    let [left, right] = [eye(-0.03), eye(0.03)];
    for normal in [DVec3::Z, DVec3::new(0.5, 0.3, 1.0).normalize()] {
        let truths = [&left, &right].map(|rays| draw(rays, plane(normal)));
        let [a, b] = &truths;
        let found = reprojected(&truths, [a, b]);
        assert!(found.pixels > 5000 && found.depth_rms < 1e-3, "{found:?}");
        assert!(found.normal_angle < 1e-3, "{found:?}");
        // A right picture that is nearer by a quarter of a radius along the rays.
        let nearer = draw(&right, |eye, ray| {
            plane(normal)(eye, ray).map(|(depth, way)| (depth - 0.25 * RADIUS, way))
        });
        let found = reprojected(&truths, [a, &nearer]);
        assert!((found.depth_rms - 0.25).abs() < 1e-3, "{found:?}");
    }
}

#[test]
fn an_eye_taken_for_symmetric_is_found_out() {
    // The right eye's picture drawn with the left one's frustum: the plane lies
    // by tan(0.32) − tan(0.24) of its depth to the side, and at 45° as much behind.
    let [left, right] = [eye(-0.03), eye(0.03)];
    let normal = DVec3::new(1.0, 0.0, 1.0).normalize();
    let truths = [&left, &right].map(|rays| draw(rays, plane(normal)));
    let shift = LEFT.left.tan() + LEFT.right.tan();
    let shifted = draw(&right, |eye, ray| {
        plane(normal)(eye, ray + DVec3::X * f64::from(shift))
    });
    let found = reprojected(&truths, [&truths[0], &shifted]);
    assert!(found.depth_rms > 5.0, "{found:?}");
}

#[test]
fn a_part_behind_another_is_not_compared() {
    // A ball before a wall: the wall's strips that one eye sees are left out.
    let [left, right] = [eye(-0.03), eye(0.03)];
    let both = |eye: DVec3, ray: DVec3| ball(0.03)(eye, ray).or_else(|| Some((0.7 / -ray.z, 0.01)));
    let truths = [&left, &right].map(|rays| draw(rays, both));
    let found = reprojected(&truths, [&truths[0], &truths[1]]);
    // Bilinear on the ball.
    assert!(found.depth_rms < 0.02, "{found:?}");
}

#[test]
fn thickness_gives_the_volume() {
    let picture = draw(&eye(-0.03), ball(0.04));
    let expected = 4.0 / 3.0 * PI * 0.04_f64.powi(3);
    // Pixels cut the silhouette.
    assert!(
        (volume(&picture) / expected - 1.0).abs() < 2e-3,
        "{}",
        volume(&picture) / expected
    );
}
