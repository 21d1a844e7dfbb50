#![allow(clippy::unwrap_used)]
use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use vitriol_gpu::QueueKind;
use vitriol_shaders::Library;
use vitriol_sim::scene::Preset;
use vitriol_sim::world::World;
use vitriol_tests::gpu;

use super::*;
use crate::ply;

/// Radii of what is put into the beaker, m: a census takes none for more than eight particles.
const RADII: [f64; 3] = [0.3e-3, 1.5e-3, 3e-3];

/// A file's header, and its points' numbers.
fn read(bytes: &[u8], columns: usize) -> (String, Vec<Vec<f32>>) {
    let end = b"end_header\n";
    let at = bytes
        .windows(end.len())
        .position(|part| part == end)
        .unwrap();
    let (header, data) = bytes.split_at(at + end.len());
    let words: Vec<f32> = data
        .chunks_exact(4)
        .map(|word| f32::from_le_bytes(word.try_into().unwrap()))
        .collect();
    let points = words.chunks(columns).map(<[f32]>::to_vec).collect();
    (String::from_utf8(header.to_vec()).unwrap(), points)
}

/// Bubbles that are put into boiling water are in the file where and as large as they were put, and have the volume that the device's
/// census counts; so are drops. Where there are none, there is a file without points; drawn smaller, all is smaller.
#[test]
fn clouds_are_what_is_in_the_world() {
    let device = gpu::device();
    let mut scene = Scene::builtin("boiling-water")
        .unwrap()
        .with_preset(Preset::Fast);
    let mut world = World::new(&device, &Library::embedded(), &scene, 1).unwrap();
    let parameters = world.solver().parameters().clone();
    let mut state = world.snapshot().unwrap();
    let none = Cloud::of_bubbles(&scene, &parameters, &state.solver).unwrap();
    let (header, points) = read(&ply::points(&none, "bubbles"), 6);
    assert!(header.contains("element vertex 0\n"), "{header}");
    assert!(points.is_empty());

    let base = world.poses()[0].transform_point(Vec3::ZERO).as_dvec3();
    let places = [0.0, 0.01, 0.02].map(|x| base + DVec3::new(x, 0.02 + x, 0.0));
    for (n, (&place, &radius)) in places.iter().zip(&RADII).enumerate() {
        let still = [place, DVec3::ZERO];
        state
            .solver
            .put_bubble(&parameters, 7 + 3 * n, 1, still, [radius, 100.0]);
    }
    // Four drops that lie about: a record's mass is that of all of them over a particle's.
    let (radius, density) = (0.4e-3, 960.0);
    let held = 4.0 * density * 4.0 / 3.0 * PI * radius * radius * radius;
    let drops = &mut state.solver.drops_mut()[14];
    drops.position = (base + DVec3::Y * 0.2).as_vec3().to_array();
    drops.velocity = [0.1, 2.0, -0.3];
    (drops.mass, drops.radius) = ((held / parameters.particle_mass()) as f32, radius as f32);
    (drops.density, drops.about) = (density as f32, 0.003);
    world.restore(&state).unwrap();

    let census = world.look_on(QueueKind::Main, &[]).unwrap().get().unwrap();
    let state = world.solver().snapshot().unwrap();
    let cloud = Cloud::of_bubbles(&scene, &parameters, &state).unwrap();
    let (header, points) = read(&ply::points(&cloud, "bubbles"), 6);
    let names: Vec<&str> = header
        .lines()
        .filter(|l| l.starts_with("property"))
        .collect();
    let expected = ["x", "y", "z", "radius", "steam", "air"];
    assert_eq!(names, expected.map(|name| format!("property float {name}")));
    assert_eq!(points.len(), 3);
    // Steam at 100 °C and one atmosphere has 0.588 kg/m³ as an ideal gas (18.015 g/mol).
    let steam_density = 101_325.0 * 18.015e-3 / (8.314 * 373.15);
    let mut volume = 0.0;
    for (point, (place, radius)) in points.iter().zip(places.iter().zip(RADII)) {
        let [x, y, z, drawn, steam, air] = <[f32; 6]>::try_from(&point[..]).unwrap();
        assert!((Vec3::new(x, y, z).as_dvec3() - *place).length() < 1e-6);
        assert!((f64::from(drawn) / radius - 1.0).abs() < 1e-6);
        let mass = steam_density * 4.0 / 3.0 * PI * radius.powi(3);
        assert!(
            (f64::from(steam) / mass - 1.0).abs() < 2e-3,
            "{steam} {mass}"
        );
        assert_eq!(air, 0.0);
        volume += 4.0 / 3.0 * PI * f64::from(drawn).powi(3);
    }
    let seen = census.flasks[0].bubbles;
    assert_eq!(seen.here.count, 3);
    assert!(
        (volume / seen.volume - 1.0).abs() < 1e-2,
        "{volume} {seen:?}"
    );

    let spray = Cloud::of_spray(&scene, &parameters, &state).unwrap();
    let (_, points) = read(&ply::points(&spray, "spray"), 9);
    assert_eq!(points.len(), 1);
    let first = <[f32; 9]>::try_from(&points[0][..]).unwrap();
    let [_, y, _, drawn, number, about, vx, vy, vz] = first;
    assert!((f64::from(y) - base.y - 0.2).abs() < 1e-6);
    assert!((f64::from(drawn) / radius - 1.0).abs() < 1e-6);
    assert!((number - 4.0).abs() < 1e-4, "{number}");
    assert_eq!((about, [vx, vy, vz]), (0.003, [0.1, 2.0, -0.3]));

    scene.scale.length_scale = 0.05;
    let small = Cloud::of_bubbles(&scene, &parameters, &state).unwrap();
    assert!((small.positions[2] - 0.05 * cloud.positions[2]).length() < 1e-9);
    assert!((small.columns[0].1[2] / cloud.columns[0].1[2] - 0.05).abs() < 1e-9);
    assert!((small.columns[1].1[2] / cloud.columns[1].1[2] - 0.05f64.powi(3)).abs() < 1e-12);

    // Vapour without volume has neither.
    let plain = Scene::builtin("beaker").unwrap();
    let parameters = World::new(&device, &Library::embedded(), &plain, 1).unwrap();
    let parameters = parameters.solver().parameters().clone();
    assert_eq!(Cloud::of_bubbles(&plain, &parameters, &state), None);
    assert_eq!(Cloud::of_spray(&plain, &parameters, &state), None);
}
