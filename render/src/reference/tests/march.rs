#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
use super::*;
use crate::camera::Fov;
use crate::reference::{Anisotropy, Nothing, Shape};
use glam::Vec3;
use std::f64::consts::PI;

/// Wide to the left and down, as a headset's left eye.
const ASYMMETRIC: Fov = Fov {
    left: -0.5,
    right: 0.3,
    up: 0.35,
    down: -0.45,
};

#[test]
fn rays_go_where_the_projection_says() {
    let view = View::look_at(
        Vec3::new(0.3, 1.1, 0.2),
        Vec3::new(0.0, 0.8, -0.4),
        ASYMMETRIC,
    );
    for length_scale in [1.0, 0.05] {
        let rays = Rays::new(&view, [64, 48], length_scale);
        let clip_from_scaled = view.clip_from_scaled(length_scale as f32);
        for (x, y) in [(0.5, 0.5), (63.5, 0.5), (20.5, 40.5)] {
            let depth = 0.7 / length_scale;
            let point = rays.eye + rays.direction(x, y) * depth;
            let ndc = clip_from_scaled.project_point3(point.as_vec3());
            let drawn = [(ndc.x + 1.0) * 32.0, (ndc.y + 1.0) * 24.0];
            // f32's projection.
            assert!((f64::from(drawn[0]) - x).abs() < 1e-3, "{drawn:?} {x} {y}");
            assert!((f64::from(drawn[1]) - y).abs() < 1e-3, "{drawn:?} {x} {y}");
            let (u, v, seen) = rays.project(point).unwrap();
            assert!((u - x).abs() < 1e-9 && (v - y).abs() < 1e-9);
            assert!((seen - depth).abs() < 1e-9);
        }
    }
}

/// One kernel, whose level set is an ellipsoid, before an asymmetric frustum.
fn one_kernel() -> (Shape, Field<'static>, Picture) {
    let p = Anisotropy::new(0.02, 0.04);
    let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.5, 0.3, -0.8);
    let shape = Shape {
        centre: DVec3::new(0.02, 0.8, -0.41),
        lengths: DVec3::new(0.02, 0.012, 0.008),
        axes: DMat3::from_quat(turn),
    };
    let field = Field::new(&[shape], &[p.spacing.powi(3)], p.spacing, &Nothing);
    let view = View::look_at(
        Vec3::new(0.0, 0.9, -0.2),
        Vec3::new(0.0, 0.8, -0.4),
        ASYMMETRIC,
    );
    let picture = Picture::new(&field, &Rays::new(&view, [96, 80], 1.0), true);
    (shape, field, picture)
}

/// q at which V det(G) P(q) is the surface's level.
fn level(shape: &Shape, field: &Field<'_>) -> f64 {
    let (mut low, mut high) = (0.0, 2.0);
    for _ in 0..60 {
        let q = 0.5 * (low + high);
        let at = shape.centre + shape.axes.x_axis * (q * shape.lengths.x);
        if field.value(at) > SURFACE {
            low = q;
        } else {
            high = q;
        }
    }
    low
}

#[test]
fn one_kernel_is_an_ellipsoid() {
    let (shape, field, picture) = one_kernel();
    let q = level(&shape, &field);
    let g = shape.g();
    let mut seen = 0;
    for pixel in 0..picture.depth.len() {
        let ray = picture.rays.through(pixel);
        // |G (eye + t ray − centre)|² = q².
        let (a, b) = (g * ray, g * (picture.rays.eye - shape.centre));
        let (aa, ab, bb) = (a.length_squared(), a.dot(b), b.length_squared() - q * q);
        let root = ab * ab - aa * bb;
        let found = picture.depth[pixel];
        // A chord shorter than a step may be missed.
        let chord = 2.0 * root.max(0.0).sqrt() / aa * ray.length();
        if chord < 0.75 * field.shortest() {
            continue;
        }
        seen += 1;
        let depth = (-ab - root.sqrt()) / aa;
        assert!(
            (found - depth).abs() < 1e-4 * field.spacing(),
            "{found} {depth}"
        );
        assert!((picture.thickness[pixel] - chord).abs() < 2e-4 * field.spacing());
        let at = picture.rays.eye + ray * depth;
        let normal = (g * (g * (at - shape.centre))).normalize();
        // As steep as the surface's place is precise.
        assert!((picture.normal[pixel] - normal).length() < 1e-3);
    }
    assert!(seen > 100, "{seen}");
}

#[test]
fn its_volume_is_the_integral() {
    let (shape, field, picture) = one_kernel();
    let true_volume = 4.0 / 3.0 * PI * (level(&shape, &field) * shape.lengths).element_product();
    let seen = picture.solid.iter().sum::<f64>() * picture.rays.pixel_area();
    // Pixels at the silhouette, whose chords are under a step.
    assert!(
        (seen / true_volume - 1.0).abs() < 0.01,
        "{seen} {true_volume}"
    );
}

#[test]
fn a_ball_of_particles_is_a_ball() {
    // 2,100 particles of 5 mm fill a ball of radius 4 cm as a lattice does.
    let spacing = 0.005;
    let radius = 0.04;
    let centre = DVec3::new(0.0, 0.8, -0.4);
    let row = -9..=9;
    let positions: Vec<DVec3> = row
        .clone()
        .flat_map(|x| row.clone().map(move |y| (x, y)))
        .flat_map(|(x, y)| {
            row.clone()
                .map(move |z| DVec3::new(x.into(), y.into(), z.into()))
        })
        .map(|site| site * spacing)
        .filter(|at| at.length() < radius)
        .map(|at| centre + at)
        .collect();
    let p = Anisotropy::new(spacing, 2.0 * spacing);
    let field = Field::new(
        &p.shapes(&positions, &Nothing),
        &vec![spacing.powi(3); positions.len()],
        spacing,
        &Nothing,
    );
    let view = View::look_at(Vec3::new(0.0, 0.9, 0.0), centre.as_vec3(), ASYMMETRIC);
    let picture = Picture::new(&field, &Rays::new(&view, [120, 120], 1.0), true);
    let volume = picture.solid.iter().sum::<f64>() * picture.rays.pixel_area();
    let true_volume = positions.len() as f64 * spacing.powi(3);
    assert!((volume / true_volume - 1.0).abs() < 0.05);
    let (mut depths, mut angles) = (Vec::new(), Vec::new());
    for (pixel, &found) in picture.depth.iter().enumerate() {
        let ray = picture.rays.through(pixel);
        let from = picture.rays.eye - centre;
        let (aa, ab) = (ray.length_squared(), ray.dot(from));
        let root = ab * ab - aa * (from.length_squared() - radius * radius);
        if root <= 0.0 {
            continue;
        }
        let depth = (-ab - root.sqrt()) / aa;
        let normal = (from + ray * depth) / radius;
        if normal.dot(-ray.normalize()) > 0.4 {
            depths.push((found - depth) / (0.5 * spacing));
            angles.push(normal.dot(picture.normal[pixel]).clamp(-1.0, 1.0).acos());
        }
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    // A lattice cut to a ball is terraced: half a particle's radius, 8°.
    assert!(mean(&depths).abs() < 0.3, "{}", mean(&depths));
    assert!(
        mean(&angles).to_degrees() < 8.0,
        "{}",
        mean(&angles).to_degrees()
    );
}
