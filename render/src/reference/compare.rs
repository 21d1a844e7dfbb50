//! How far a picture is from the truth, and two pictures of one liquid from
//! each other. Distances are in particle radii, ½ d.

use glam::DVec3;

use super::march::Picture;

/// Cosine between ray and normal below which a surface counts to its
/// silhouette: seen so flatly, a depth says more of the pixel than of the liquid.
const GRAZING: f64 = 0.25;

/// How far off the tangent plane of a pixel's surface its neighbour's may lie,
/// in depth, before it is another part that lies before or behind; particle
/// spacings.
const EDGE: f64 = 1.0;

/// |A ∩ B| / |A ∪ B| of the pixels with liquid; 1 where neither has any.
pub fn silhouette_iou(a: &Picture, b: &Picture) -> f64 {
    let (mut both, mut either) = (0_usize, 0_usize);
    for (a, b) in a.depth.iter().zip(&b.depth) {
        both += usize::from(a.is_finite() && b.is_finite());
        either += usize::from(a.is_finite() || b.is_finite());
    }
    if either == 0 {
        1.0
    } else {
        both as f64 / either as f64
    }
}

/// Pixels away from silhouettes.
#[derive(Clone, Debug)]
pub struct Interior {
    inside: Vec<bool>,
    /// Distance that was kept from silhouettes, pixels.
    pub margin: usize,
}

impl Interior {
    /// Those of the true picture of particles of spacing `spacing` (scene's
    /// unit) that are seen from the front and a spacing, at its nearest depth,
    /// away from any edge: of the liquid, of one part before another, and of
    /// the picture.
    pub fn new(truth: &Picture, spacing: f64) -> Self {
        let [width, height] = truth.rays.size();
        let nearest = truth.depth.iter().copied().fold(f64::INFINITY, f64::min);
        let pixel = nearest * truth.rays.pixel_area().sqrt();
        let margin = (spacing / pixel).ceil().max(1.0) as usize;
        let edge = |pixel: usize| {
            let (x, y) = (pixel % width, pixel / width);
            // Where one has liquid and the other not, the difference is infinite
            // or no number; where neither has, it is no edge.
            let off_plane = |from: usize, other: usize| {
                let normal = truth.normal[from];
                let through = |pixel: usize| truth.rays.through(pixel).dot(normal);
                let expected = truth.depth[from] * through(from) / through(other);
                (truth.depth[other] - expected).abs()
            };
            let jumps = |other: usize| {
                let seen = [pixel, other].map(|at| truth.depth[at].is_finite());
                let step = off_plane(pixel, other).min(off_plane(other, pixel));
                seen[0] != seen[1] || (seen[0] && step > EDGE * spacing)
            };
            let border = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
            border
                || jumps(pixel - 1)
                || jumps(pixel + 1)
                || jumps(pixel - width)
                || jumps(pixel + width)
        };
        let edges: Vec<bool> = (0..width * height).map(edge).collect();
        let by_row = dilate(&edges, width, 1, margin);
        let near_edge = dilate(&by_row, height, width, margin);
        let facing = |pixel: usize| {
            let towards = -truth.rays.through(pixel).normalize();
            truth.depth[pixel].is_finite() && truth.normal[pixel].dot(towards) > GRAZING
        };
        Self {
            inside: (0..width * height)
                .map(|pixel| !near_edge[pixel] && facing(pixel))
                .collect(),
            margin,
        }
    }

    fn pixels(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.inside.len()).filter(|&pixel| self.inside[pixel])
    }
}

/// Spreads what is true by `margin` along lines of `length` pixels that lie
/// `stride` apart.
fn dilate(mask: &[bool], length: usize, stride: usize, margin: usize) -> Vec<bool> {
    let mut spread = vec![false; mask.len()];
    for (pixel, _) in mask.iter().enumerate().filter(|(_, set)| **set) {
        let at = pixel / stride % length;
        let first = pixel - at * stride;
        for other in at.saturating_sub(margin)..=(at + margin).min(length - 1) {
            spread[first + other * stride] = true;
        }
    }
    spread
}

/// Means over pixels; NaN where there were none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Root mean square of the depths' differences, particle radii.
    pub depth_rms: f64,
    /// Their mean, particle radii: above 0 where the second lies behind.
    pub depth_mean: f64,
    /// Mean angle between the normals, rad.
    pub normal_angle: f64,
    /// Pixels that were compared.
    pub pixels: usize,
}

/// Adds differences up.
#[derive(Default)]
struct Differences {
    squares: f64,
    sum: f64,
    angles: f64,
    pixels: usize,
}

impl Differences {
    fn add(&mut self, depth: f64, a: DVec3, b: DVec3) {
        self.squares += depth * depth;
        self.sum += depth;
        self.angles += a.cross(b).length().atan2(a.dot(b));
        self.pixels += 1;
    }

    fn over(&self, spacing: f64) -> Difference {
        let (count, radius) = (self.pixels as f64, 0.5 * spacing);
        Difference {
            depth_rms: (self.squares / count).sqrt() / radius,
            depth_mean: self.sum / count / radius,
            normal_angle: self.angles / count,
            pixels: self.pixels,
        }
    }
}

/// `drawn` less `truth` over the pixels of the interior that both have.
pub fn difference(
    truth: &Picture,
    drawn: &Picture,
    interior: &Interior,
    spacing: f64,
) -> Difference {
    let mut differences = Differences::default();
    for pixel in interior.pixels().filter(|&at| drawn.depth[at].is_finite()) {
        differences.add(
            drawn.depth[pixel] - truth.depth[pixel],
            truth.normal[pixel],
            drawn.normal[pixel],
        );
    }
    differences.over(spacing)
}

/// One eye's truth with its interior.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The true picture.
    pub truth: &'a Picture,
    /// Its pixels away from silhouettes.
    pub interior: &'a Interior,
}

/// What `from` shows, seen by the other eye, against what `to` shows there:
/// over the pixels that by the truth both eyes see, away from silhouettes.
/// `from` and `to` are of these two eyes.
///
/// The same measures the flicker of a liquid that does not move between two
/// places of a head that does.
pub fn reprojection(
    [from, to]: [&Picture; 2],
    [first, second]: [Seen<'_>; 2],
    spacing: f64,
) -> Difference {
    let mut differences = Differences::default();
    let place = |picture: &Picture, pixel: usize| {
        picture.rays.eye + picture.rays.through(pixel) * picture.depth[pixel]
    };
    for pixel in first
        .interior
        .pixels()
        .filter(|&at| from.depth[at].is_finite())
    {
        let seen_by_both = second
            .truth
            .rays
            .project(place(first.truth, pixel))
            .and_then(|at| Some((at, sample(second.truth, second.interior, at)?)))
            // Half a particle: less than any edge before another part.
            .is_some_and(|((_, _, depth), (found, _))| (found - depth).abs() < 0.5 * spacing);
        if !seen_by_both {
            continue;
        }
        let there = to.rays.project(place(from, pixel));
        let compared = there.and_then(|at| Some((at.2, sample(to, second.interior, at)?)));
        if let Some((depth, (found, normal))) = compared {
            differences.add(found - depth, from.normal[pixel], normal);
        }
    }
    differences.over(spacing)
}

/// Depth and normal between pixel centres; none where a pixel has no liquid or
/// is not of the interior.
fn sample(
    picture: &Picture,
    interior: &Interior,
    (x, y, _): (f64, f64, f64),
) -> Option<(f64, DVec3)> {
    let [width, height] = picture.rays.size();
    let (u, v) = (x - 0.5, y - 0.5);
    let (column, row) = (u.floor(), v.floor());
    let beyond =
        column < 0.0 || row < 0.0 || column + 1.0 >= width as f64 || row + 1.0 >= height as f64;
    if beyond {
        return None;
    }
    let first = row as usize * width + column as usize;
    let (s, t) = (u - column, v - row);
    let corners = [
        (first, (1.0 - s) * (1.0 - t)),
        (first + 1, s * (1.0 - t)),
        (first + width, (1.0 - s) * t),
        (first + width + 1, s * t),
    ];
    let (mut inverse, mut normal) = (0.0, DVec3::ZERO);
    for (pixel, weight) in corners {
        if !interior.inside[pixel] || !picture.depth[pixel].is_finite() {
            return None;
        }
        // In one over the depth a plane is linear in the picture.
        inverse += weight / picture.depth[pixel];
        normal += weight * picture.normal[pixel];
    }
    Some((1.0 / inverse, normal.normalize_or_zero()))
}

/// Volume that a picture sees, scene's unit cubed.
pub fn volume(picture: &Picture) -> f64 {
    picture.solid.iter().sum::<f64>() * picture.rays.pixel_area()
}

#[cfg(test)]
#[path = "tests/compare.rs"]
mod tests;
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

/// A picture by the depth of what each ray hits and its way through it, as view
/// depths.
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

#[test]
fn what_both_eyes_see_fits() {
    let [left, right] = [eye(-0.03), eye(0.03)];
    for normal in [DVec3::Z, DVec3::new(0.5, 0.3, 1.0).normalize()] {
        let truths = [&left, &right].map(|rays| draw(rays, plane(normal)));
        let interiors = truths.each_ref().map(|truth| Interior::new(truth, SPACING));
        let seen = [0, 1].map(|k| Seen {
            truth: &truths[k],
            interior: &interiors[k],
        });
        let [a, b] = &truths;
        let found = reprojection([a, b], seen, SPACING);
        assert!(found.pixels > 5000 && found.depth_rms < 1e-3, "{found:?}");
        assert!(found.normal_angle < 1e-3, "{found:?}");
        // A right picture that is nearer by a quarter of a radius along the rays.
        let nearer = draw(&right, |eye, ray| {
            plane(normal)(eye, ray).map(|(depth, way)| (depth - 0.25 * RADIUS, way))
        });
        let found = reprojection([a, &nearer], seen, SPACING);
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
    let interiors = truths.each_ref().map(|truth| Interior::new(truth, SPACING));
    let seen = [0, 1].map(|k| Seen {
        truth: &truths[k],
        interior: &interiors[k],
    });
    let shift = LEFT.left.tan() + LEFT.right.tan();
    let shifted = draw(&right, |eye, ray| {
        plane(normal)(eye, ray + DVec3::X * f64::from(shift))
    });
    let found = reprojection([&truths[0], &shifted], seen, SPACING);
    assert!(found.depth_rms > 5.0, "{found:?}");
}

#[test]
fn a_part_behind_another_is_not_compared() {
    // A ball before a wall: the wall's strips that one eye sees are left out.
    let [left, right] = [eye(-0.03), eye(0.03)];
    let both = |eye: DVec3, ray: DVec3| ball(0.03)(eye, ray).or_else(|| Some((0.7 / -ray.z, 0.01)));
    let truths = [&left, &right].map(|rays| draw(rays, both));
    let interiors = truths.each_ref().map(|truth| Interior::new(truth, SPACING));
    let seen = [0, 1].map(|k| Seen {
        truth: &truths[k],
        interior: &interiors[k],
    });
    let found = reprojection([&truths[0], &truths[1]], seen, SPACING);
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
