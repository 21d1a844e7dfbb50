#![allow(clippy::unwrap_used)]
use std::f64::consts::PI;

use glam::{Quat, Vec3};
use vitriol_sim::scene::Preset;

use super::*;

/// A small beaker of 31 mm with `depth` (m) of liquid in it, at spacing `d`: rings that fill it evenly up to the wall.
fn beaker(d: f64, depth: f64, pose: Pose) -> (Scene, Pose, Liquid) {
    let text = Scene::builtin_text("beaker").unwrap();
    let text = text
        .replace("spacing = 0.0025 ", &format!("spacing = {d} "))
        .replace("particles = 13894", "particles = 100")
        .replace(
            "profile = \"beaker-250\"",
            "points = [[0.0, 0.0155], [0.05, 0.0155]]\nwall = 0.0012",
        );
    let scene = Scene::parse(&text, "small.toml")
        .unwrap()
        .with_preset(Preset::Balanced);
    let profile = &scene.flasks[0].profile;
    let (radius, floor) = (profile.inner_radius(0.02), profile.floor_height());
    let rings = (radius / d).round() as usize;
    let layers = (depth / d).round() as usize;
    let filled = PI * radius * radius * d * layers as f64;
    let mut liquid = Liquid::default();
    for layer in 0..layers {
        for ring in 0..rings {
            let r = radius * (ring as f64 + 0.5) / rings as f64;
            let around = (2.0 * PI * r / d).round().max(3.0) as usize;
            for n in 0..around {
                // Not one above the other.
                let angle = 2.0 * PI * (n as f64 + 0.37 * (ring + layer) as f64) / around as f64;
                let at = DVec3::new(
                    r * angle.cos(),
                    floor + d * (layer as f64 + 0.5),
                    r * angle.sin(),
                );
                liquid
                    .positions
                    .push(pose.transform_point(at.as_vec3()).as_dvec3());
            }
        }
    }
    let count = liquid.positions.len();
    liquid.volumes = vec![filled / count as f64; count];
    liquid.members = vec![Some(0); count];
    (scene, pose, liquid)
}

/// Volume within what bounds the liquid, about `centre`.
fn volume(surfaces: &Surfaces, centre: DVec3) -> f64 {
    let flux = |mesh: &Mesh| mesh.clone().moved(|at| at - centre, |normal| normal).flux();
    flux(&surfaces.air_liquid) - flux(&surfaces.glass_liquid)
}

/// ∮ n dA, 0 of a closed surface, over the area of the free one.
fn gap(surfaces: &Surfaces) -> f64 {
    let vector = |mesh: &Mesh| -> DVec3 {
        let each = mesh.triangles.iter().map(|&triangle| {
            let [a, b, c] = mesh.corners(triangle);
            0.5 * (b - a).cross(c - a)
        });
        each.sum()
    };
    let sum = vector(&surfaces.air_liquid) - vector(&surfaces.glass_liquid);
    sum.length() / surfaces.air_liquid.area()
}

/// A cylinder of known radius filled to a known level: volume, the free surface πr², the wetted glass πr² + 2πr·h, the glass's own volume,
/// upright and tilted. The free surface's error shrinks with the particles.
#[test]
fn a_filled_cylinder_has_its_areas_and_volumes() {
    let upright = Pose::new(Vec3::new(0.0, 0.75, -0.4), Quat::IDENTITY);
    let tilted = Pose::new(
        Vec3::new(0.1, 0.9, -0.3),
        Quat::from_rotation_z(0.7) * Quat::from_rotation_x(-0.3),
    );
    let mut errors = Vec::new();
    for (d, pose) in [(0.002, upright), (0.002, tilted), (0.0014, upright)] {
        let (scene, pose, liquid) = beaker(d, 0.016, pose);
        let filled: f64 = liquid.volumes.iter().sum();
        let profile = scene.flasks[0].profile.clone();
        let surfaces = Surfaces::around(&scene, &[pose], liquid);
        let centre = pose.position.as_dvec3();

        let r = profile.inner_radius(0.02);
        let level = profile.level_for_volume(filled).unwrap() - profile.floor_height();
        let free = surfaces.air_liquid.area() / (PI * r * r) - 1.0;
        let wet = surfaces.glass_liquid.area() / (PI * r * r + 2.0 * PI * r * level) - 1.0;
        let volume = volume(&surfaces, centre) / filled - 1.0;
        let glass = |mesh: &Mesh| mesh.clone().moved(|at| at - centre, |n| n).flux();
        let glass = glass(&surfaces.air_glass) + glass(&surfaces.glass_liquid);
        let glass = glass / profile.glass_volume() - 1.0;
        eprintln!(
            "d {d}: volume {volume:.4}, free {free:.4}, wet {wet:.4}, glass {glass:.4}, gap {:.4}",
            gap(&surfaces)
        );
        // Bumps of rings and layers.
        assert!(volume.abs() < 0.003, "{volume}");
        assert!(free.abs() < 0.004, "{free}");
        assert!(wet.abs() < 0.015, "{wet}");
        assert!(glass.abs() < 0.001, "{glass}");
        // Both are cut along the same curve, each by its own chords.
        assert!(gap(&surfaces) < 0.001, "{}", gap(&surfaces));
        errors.push(wet.abs());
    }
    // The same, to the rounding of poses in f32 and to where the grid lies.
    assert!((errors[0] - errors[1]).abs() < 5e-4, "{errors:?}");
    assert!(errors[2] < errors[0], "{errors:?}");
}

/// A drop on the outer side of thin glass wets that side and not the inner one.
#[test]
fn a_drop_outside_does_not_wet_the_inside() {
    let pose = Pose::new(Vec3::new(0.0, 0.75, -0.4), Quat::IDENTITY);
    let (scene, pose, _) = beaker(0.002, 0.016, pose);
    let outer = scene.flasks[0].profile.outer_radius_at(0.02);
    let d = scene.scale.spacing;
    let mut positions = Vec::new();
    for x in 0..3 {
        for y in -2..3 {
            for z in -2..3 {
                let at = DVec3::new(
                    outer + d * (f64::from(x) + 0.5),
                    0.77 + d * f64::from(y),
                    -0.4 + d * f64::from(z),
                );
                positions.push(at);
            }
        }
    }
    let liquid = Liquid {
        volumes: vec![d.powi(3); positions.len()],
        members: vec![None; positions.len()],
        positions,
    };
    let filled: f64 = liquid.volumes.iter().sum();
    let surfaces = Surfaces::around(&scene, &[pose], liquid);
    let wet = &surfaces.glass_liquid;
    assert!(wet.area() > 0.5 * 25.0 * d * d, "{}", wet.area());
    for at in &wet.positions {
        let r = at.x.hypot(at.z + 0.4);
        assert!((r - outer).abs() < 1e-5, "{r}");
    }
    // A block of three layers keeps its volume within what its rounded edges take away.
    let volume = volume(&surfaces, DVec3::new(0.0, 0.75, -0.4)) / filled;
    assert!((0.75..1.05).contains(&volume), "{volume}");
}

/// A beaker filled to its rim, with glass thinner than a particle, is dry on its outside: what reaches over the rim counts there,
/// what is behind the glass does not.
#[test]
fn a_full_beaker_is_dry_outside() {
    let pose = Pose::new(Vec3::new(0.0, 0.75, -0.4), Quat::IDENTITY);
    let (scene, pose, liquid) = beaker(0.002, 0.05, pose);
    let profile = scene.flasks[0].profile.clone();
    let surfaces = Surfaces::around(&scene, &[pose], liquid);
    let (inner, rim) = (profile.inner_radius(0.02), 0.75 + profile.rim_height());
    for at in &surfaces.glass_liquid.positions {
        let outside = at.x.hypot(at.z + 0.4) > inner + 1e-5;
        // The rim's top may be wet, half a spacing below the surface.
        assert!(!outside || at.y > rim - 1e-5, "{at}");
    }
    for at in &surfaces.air_liquid.positions {
        assert!(at.y > rim - 0.002, "{at}");
    }
}

/// A jet that goes over the rim is one body: no wall of air stands in the mouth.
#[test]
fn liquid_over_the_rim_is_whole() {
    let pose = Pose::new(Vec3::new(0.0, 0.75, -0.4), Quat::IDENTITY);
    let (scene, pose, _) = beaker(0.002, 0.016, pose);
    let (rim, d) = (
        0.75 + scene.flasks[0].profile.rim_height(),
        scene.scale.spacing,
    );
    let mut liquid = Liquid::default();
    for x in -2..3 {
        for z in -2..3 {
            for y in -8..8 {
                let at = DVec3::new(
                    d * f64::from(x),
                    rim + d * (f64::from(y) + 0.5),
                    -0.4 + d * f64::from(z),
                );
                liquid.positions.push(at);
                liquid.volumes.push(d.powi(3));
                liquid.members.push((y < 0).then_some(0));
            }
        }
    }
    let surfaces = Surfaces::around(&scene, &[pose], liquid);
    assert!(surfaces.glass_liquid.triangles.is_empty());
    assert!(gap(&surfaces) < 0.01, "{}", gap(&surfaces));
    // Nothing of the surface lies in the jet's axis.
    let inner = surfaces
        .air_liquid
        .positions
        .iter()
        .filter(|at| at.x.hypot(at.z + 0.4) < d && (at.y - rim).abs() < 5.0 * d);
    assert_eq!(inner.count(), 0);
}

/// Its glass is nowhere, and its liquid is whole in the air.
#[test]
fn of_a_broken_beaker_the_liquid_is_left() {
    let pose = Pose::new(Vec3::new(0.0, 0.75, -0.4), Quat::IDENTITY);
    let (scene, pose, mut liquid) = beaker(0.002, 0.016, pose);
    liquid.members.fill(None);
    let filled: f64 = liquid.volumes.iter().sum();
    let nowhere = Pose::from_position(vitriol_sim::bodies::NOWHERE);
    let surfaces = Surfaces::around(&scene, &[nowhere], liquid);
    assert!(surfaces.air_glass.triangles.is_empty());
    assert!(surfaces.glass_liquid.triangles.is_empty());
    let off = volume(&surfaces, pose.position.as_dvec3()) / filled - 1.0;
    // A fifth of a spacing of 2 mm all round is a tenth of it.
    assert!(off.abs() < 0.1, "{off}");
}
