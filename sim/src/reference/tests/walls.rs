//! Nothing acts or passes through glass.

use super::*;
use crate::flask::{Side, VolumeMap, particles};
use crate::reference::motion::constrain;
use crate::reference::surroundings::Slab;
use crate::surface_tension::SurfaceTension;
use glam::{DVec2, Vec3};

/// Two glasses side by side whose outer walls touch: 4 mm between liquids.
fn two_glasses(parameters: Parameters, positions: Vec<DVec3>) -> (Reference, [Pose; 2]) {
    let poses = [0.0, 0.030].map(|x| Pose::from_position(Vec3::new(x, 0.0, 0.0)));
    let vessels = vec![Vessel::with_maps(narrow_glass(), H); 2];
    let surroundings = Surroundings::new(vessels, None, None, H);
    (
        Reference::new(parameters, surroundings, positions, &poses),
        poses,
    )
}

#[test]
fn glasses_that_touch_do_not_feel_each_other() {
    let profile = narrow_glass();
    let fill_at = |x: f32| {
        let pose = Pose::from_position(Vec3::new(x, 0.0, 0.0));
        let mut sites = fill(&profile, pose, 250, D, Some(4)).unwrap();
        // The lattice ends 3 mm before the wall: up to it.
        for site in &mut sites {
            let (axis, r) = (f64::from(x), (site.x - f64::from(x)).hypot(site.z));
            let scale = (0.0127 / r).min(1.27);
            (site.x, site.z) = (axis + scale * (site.x - axis), scale * site.z);
        }
        sites
    };
    let p = Parameters {
        viscosity: 0.3,
        surface: Some(SurfaceTension::new(0.072)),
        ..parameters()
    };
    let (mut alone, poses) = two_glasses(p.clone(), fill_at(0.0));
    // The neighbour's liquid, and drops on the outside of the first glass.
    let mut all = fill_at(0.0);
    all.extend(fill_at(0.030));
    all.extend((0..10).map(|i| DVec3::new(-0.0155, 0.004 + D * f64::from(i), 0.0)));
    let (mut beside, _) = two_glasses(p, all);
    let near = |i: usize, j: usize| alone.positions[i].distance(beside.positions[j]) < H;
    assert!(
        (0..250).any(|i| (250..500).any(|j| near(i, j))),
        "too far apart to tell"
    );
    assert!(
        (0..250).any(|i| (500..510).any(|j| near(i, j))),
        "too far apart to tell"
    );
    for _ in 0..4 {
        alone.step(&poses, &poses);
        beside.step(&poses, &poses);
    }
    // The same bits: the order of the sums is the same, too.
    assert!(alone.positions == beside.positions[..250]);
    assert!(alone.velocities == beside.velocities[..250]);
    assert_eq!(alone.membership, [Some(0); 250]);
}

#[test]
fn a_member_feels_the_inner_surface_of_its_own_glass_alone() {
    let (water, _) = two_glasses(parameters(), Vec::new());
    // By the outermost wall, and by the one that touches the other glass.
    for x in [-0.0125, 0.0125] {
        let at = [DVec3::new(x, 0.03, 0.0)];
        let sum = water.surroundings.sums(&at, &[Some(0)], &water.motion)[0];
        let map = VolumeMap::new(&narrow_glass(), Side::Inside, H).sample(0.0125, 0.03);
        assert_eq!(sum.volume, map.volume);
        assert_eq!(sum.gradient.x, map.volume_dr * x.signum());
    }
}

#[test]
fn what_pours_over_the_rim_is_seen() {
    let rim = 0.062;
    let (mut water, _) = two_glasses(
        parameters(),
        vec![
            DVec3::new(0.0, rim - 0.001, 0.0),
            // Above it through the mouth.
            DVec3::new(0.0, rim + 0.002, 0.0),
            // Past the rim: from the axis through the mouth, from the edge across glass.
            DVec3::new(0.0125, rim - 0.003, 0.0),
            DVec3::new(0.0155, rim + 0.0005, 0.0),
            // In both mouths' reach.
            DVec3::new(0.030 - 0.0125, rim - 0.0015, 0.0),
        ],
    );
    water.parameters.list_reach = 0.0;
    let neighbours = water.neighbours(&water.positions);
    let of = |i: usize| neighbours.of(i).collect::<Vec<_>>();
    assert_eq!(water.membership, [Some(0), None, Some(0), None, Some(1)]);
    assert_eq!(of(0), [1]);
    assert_eq!(of(1), [0]);
    assert!(of(2).is_empty() && of(4).is_empty());
    assert_eq!(of(3), [0usize; 0]);
}

#[test]
fn boundary_particles_and_maps_make_up_the_density_alike() {
    let profile = narrow_glass();
    let positions = fill(&profile, Pose::IDENTITY, 300, D, None).unwrap();
    let solids = particles::sample(&profile, 0.5 * D, H);
    let density = |vessel: Vessel| {
        let surroundings = Surroundings::new(vec![vessel], None, None, H);
        let mut water = Reference::new(
            parameters(),
            surroundings,
            positions.clone(),
            &[Pose::IDENTITY],
        );
        let neighbours = water.neighbours(&water.positions);
        let start = water.densities(&water.positions, &neighbours);
        for _ in 0..10 {
            water.step(&[Pose::IDENTITY], &[Pose::IDENTITY]);
        }
        assert!(water.membership.iter().all(Option::is_some));
        (start, water.density_error().mean)
    };
    let (maps, maps_error) = density(Vessel::with_maps(profile.clone(), H));
    let (solid, solid_error) = density(Vessel::with_particles(profile.clone(), solids, H));
    // On the axis, half a spacing above the floor: a lattice cut by a plane.
    let low = (0..300)
        .find(|&i| positions[i].x == 0.0 && positions[i].z == 0.0)
        .unwrap();
    // The half space is even where the lattice is not.
    assert!((maps[low] - 1.0).abs() < 0.06, "{}", maps[low]);
    // ψ makes up a full density on the solid particles themselves, where a
    // half space is one half: Akinci's liquid stands further off.
    assert!((1.2..1.6).contains(&solid[low]), "{}", solid[low]);
    assert!(
        maps_error < 0.02 && solid_error < 0.02,
        "{maps_error} {solid_error}"
    );
}

#[test]
fn table_and_floor_hold() {
    let table = Slab {
        top: 0.5,
        under: 0.46,
        centre: DVec2::new(0.1, 0.2),
        size: DVec2::new(0.4, 0.2),
    };
    let surroundings = Surroundings::new(Vec::new(), Some(table), Some(0.0), H);
    let margin = 1e-3 * H;
    let put = |from: [f64; 3], to: [f64; 3]| {
        let place = (DVec3::from_array(from), None);
        constrain(&surroundings, &[], margin, place, DVec3::from_array(to))
            .0
            .to_array()
    };
    assert_eq!(
        put([0.1, 0.51, 0.2], [0.12, 0.49, 0.2]),
        [0.12, 0.5 + margin, 0.2]
    );
    assert_eq!(
        put([0.1, 0.45, 0.2], [0.12, 0.47, 0.2]),
        [0.12, 0.46 - margin, 0.2]
    );
    assert_eq!(put([0.31, 0.47, 0.2], [0.29, 0.48, 0.2]), [0.31, 0.48, 0.2]);
    assert_eq!(put([0.31, 0.47, 0.2], [0.32, 0.45, 0.2]), [0.32, 0.45, 0.2]);
    assert_eq!(put([0.5, 0.1, 0.2], [0.5, -3.0, 0.2]), [0.5, margin, 0.2]);
}
