//! Each pass against its formula.

use super::*;
use crate::kernel::Kernel;
use crate::reference::density::hashed_direction;
use crate::reference::measure::DensityError;
use crate::reference::neighbours::{find, find_by_brute_force};
use crate::reference::placement::Motion;
use crate::reference::{density, forces};
use glam::{Quat, Vec3};

#[test]
fn neighbours_are_those_of_brute_force() {
    let mut random = Random(5);
    let origin = [
        DVec3::ZERO,
        DVec3::splat(-0.4),
        DVec3::new(1e4, -1e4, 1e4),
        DVec3::new(-3e-3, 1e-9, 2e-3),
    ];
    for origin in origin {
        let cloud = random.points(600, 0.03);
        let points: Vec<_> = cloud.into_iter().map(|p| p + origin).collect();
        let odd_ones_out = |i: usize, j: usize| (i * j) % 7 != 1;
        let found = find(&points, H, odd_ones_out);
        assert_eq!(found, find_by_brute_force(&points, H, odd_ones_out));
        let pairs: usize = (0..600).map(|i| found.of(i).count()).sum();
        assert!(pairs > 1000, "{pairs}");
    }
}

#[test]
fn neighbours_survive_absurd_places() {
    let points = [
        DVec3::NAN,
        DVec3::splat(f64::INFINITY),
        DVec3::splat(1e300),
        DVec3::ZERO,
        DVec3::ZERO,
    ];
    let found = find(&points, H, |_, _| true);
    let counts: Vec<_> = (0..5).map(|i| found.of(i).count()).collect();
    assert_eq!(counts, [0, 0, 0, 1, 1]);
}

/// Shaken water in a low glass whose maps have nodes h/(6·`refinement`) apart.
fn shaken_water(refinement: u32) -> Reference {
    let profile = Profile::new(&[[0.0, 0.013], [0.014, 0.013]], 0.002).unwrap();
    let mut positions = fill(&profile, Pose::IDENTITY, 300, D, Some(1)).unwrap();
    let mut random = Random(2);
    for x in &mut positions {
        *x += random.point(0.3 * D);
    }
    let vessel = Vessel::with_refined_maps(profile, H, refinement);
    let surroundings = Surroundings::new(vec![vessel], None, None, H);
    Reference::new(parameters(), surroundings, positions, &[Pose::IDENTITY])
}

/// Tolerance of the slope of a wall's volume, by differences, from the map's
/// gradient, in units of 1/h. The map is linear between nodes
/// s = h/(6·`refinement`) apart and its slope is another table. So the
/// difference is that of the interval's middle: V″·s/2 with V″ ≤ 3/h² for a
/// plane wall. Interpolation adds V‴·s²·(1/24 + 1/8) with V‴ ≤ 16/h³.
fn map_tolerance(refinement: u32) -> f64 {
    let s = 1.0 / (6.0 * f64::from(refinement));
    1.5 * s + 16.0 / 6.0 * s * s
}

/// λ at one particle alone moves all by λ·∂C_i/∂x_j, where C has what walls mirror: V_b, and once more what it grew by.
/// Along a wall what the gradient moves is divided by the share 1 − V_b that is liquid.
#[test]
fn displacement_is_the_gradient_of_the_density() {
    let refinement = 4;
    let water = shaken_water(refinement);
    let positions = water.positions.clone();
    let neighbours = water.neighbours(&positions);
    let lambda = -1e-9;
    let before = water.walls_before();
    let walls = water
        .surroundings
        .sums(&positions, &water.membership, &water.motion);
    let steep = |i: &usize| walls[*i].gradient.length() * H > 1.0;
    let by_the_wall = (0..300).find(steep).unwrap();
    let free = (0..300).find(|&i| walls[i].volume == 0.0).unwrap();
    // A wall's gradient that is a third wrong is off by 0.33; that of the mirror is twice a map's.
    for (i, tolerance) in [(free, 1e-6), (by_the_wall, 2.0 * map_tolerance(refinement))] {
        let mut change = vec![0.0; 300];
        change[i] = lambda;
        let mut moved = positions.clone();
        water.displace(&mut moved, &neighbours, &change);
        for j in neighbours.of(i).chain([i]) {
            let eps = 1e-5 * H;
            let density = |shift: DVec3| {
                let mut shifted = positions.clone();
                shifted[j] += shift;
                water.mirrored_densities(&shifted, &neighbours, &before)[i]
            };
            let slope =
                DVec3::AXES.map(|axis| (density(eps * axis) - density(-eps * axis)) / (2.0 * eps));
            let slope = DVec3::from_array(slope);
            let own = (moved[j] - positions[j]) / lambda;
            let normal = walls[j].gradient.normalize_or_zero();
            let across = normal * own.dot(normal);
            let own = across + (own - across) * (1.0 - walls[j].volume).max(0.3);
            let off = (own - slope).abs().max_element();
            assert!(off < tolerance / H, "{i} {j}: {own} {slope}");
        }
    }
}

/// Of all particles: what is left of the difference is the map's
/// interpolation, for it goes with the distance of the nodes.
#[test]
fn a_walls_gradient_is_the_slope_of_its_volume() {
    let worst = [1, 2, 4].map(|refinement| {
        let water = shaken_water(refinement);
        let sums = |shift: DVec3| {
            let shifted: Vec<_> = water.positions.iter().map(|&x| x + shift).collect();
            water
                .surroundings
                .sums(&shifted, &water.membership, &water.motion)
        };
        let own = sums(DVec3::ZERO);
        let steepest = own.iter().map(|wall| wall.gradient.length() * H);
        assert!(steepest.fold(0.0, f64::max) > 1.0);
        let eps = 1e-5 * H;
        let mut worst: f64 = 0.0;
        for (k, axis) in DVec3::AXES.into_iter().enumerate() {
            let (low, high) = (sums(-eps * axis), sums(eps * axis));
            for i in 0..own.len() {
                let slope = (high[i].volume - low[i].volume) / (2.0 * eps);
                worst = worst.max((own[i].gradient[k] - slope).abs() * H);
            }
        }
        assert!(worst < map_tolerance(refinement), "{refinement}: {worst}");
        worst
    });
    assert!(
        worst[1] < 0.65 * worst[0] && worst[2] < 0.65 * worst[1],
        "{worst:?}"
    );
}

#[test]
fn multipliers_take_back_but_never_pull() {
    let (mut lambda, mut change) = (vec![0.0, 0.0, -1.0], vec![0.0; 3]);
    density::multipliers(&[1.5, 0.5, 0.8], 0.5, (0.0, 0.25), &mut lambda, &mut change);
    // −0.25·0.5/0.5; clamped; −1 + 0.25·0.2/0.5.
    assert_eq!(lambda, [-0.25, 0.0, -0.9]);
    let expected = [-0.25, 0.0, 0.1];
    assert!(
        change
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-15)
    );
    density::multipliers(&[1.0; 3], 0.5, (0.5, 0.25), &mut lambda, &mut change);
    assert!((lambda[0] + 0.375).abs() < 1e-15 && (lambda[2] + 0.85).abs() < 1e-15);
}

#[test]
fn gradient_sum_is_the_lattices() {
    let p = parameters();
    let mut water = in_the_open(p.clone(), Vec::new());
    for x in -2..=2 {
        for y in -2..=2 {
            for z in -2..=2 {
                water
                    .positions
                    .push(DVec3::new(x.into(), y.into(), z.into()) * D);
            }
        }
    }
    let kernel = Kernel::new(H);
    let neighbours = find(&water.positions, H, |_, _| true);
    let centre = 62;
    let sum: f64 = neighbours
        .of(centre)
        .map(|j| (p.particle_volume() * kernel.dw(water.positions[j].length())).powi(2))
        .sum();
    assert!((sum / p.gradient_sum() - 1.0).abs() < 1e-12);
}

#[test]
fn hashed_directions_are_opposite_unit_vectors() {
    let mut mean = DVec3::ZERO;
    for i in 0..1000 {
        let direction = hashed_direction(i, i + 1);
        assert!((direction.length() - 1.0).abs() < 1e-12);
        assert_eq!(hashed_direction(i + 1, i), -direction);
        mean += direction / 1000.0;
    }
    // Standard error 0.03.
    assert!(mean.length() < 0.1, "{mean}");
}

#[test]
fn glass_moves_like_a_rigid_body() {
    let (omega, velocity, time) = (3.0, Vec3::new(0.2, -0.1, 0.4), 1e-3);
    let axis = Vec3::new(0.6, 0.0, 0.8);
    let start = Quat::from_rotation_z(0.5);
    let before = Pose::new(Vec3::new(1.0, 0.5, 0.2), start);
    let turn = Quat::from_axis_angle(axis, omega * 4.0 * time);
    let after = Pose::new(before.position + velocity * 4.0 * time, turn * start);
    let motion = Motion::of_substep(before, after, 2, 4, f64::from(time));
    let point = DVec3::new(1.1, 0.5, 0.3);
    let spin = axis.as_dvec3() * f64::from(omega);
    let arm = point - motion.after.position;
    let expected = velocity.as_dvec3() + spin.cross(arm);
    // ω²r·Δt/2 and the f32 poses' rounding over Δt.
    let error = (motion.velocity_at(point) - expected).length();
    assert!(error < 2e-3, "{error}");
}

#[test]
fn viscosity_does_not_depend_on_substeps() {
    let of = |substeps: u32| {
        let p = Parameters {
            substeps,
            viscosity: 0.3,
            ..parameters()
        };
        (1.0 - p.substep_viscosity()).powi(substeps as i32)
    };
    // (1 − μ)^(Δt_f/Δt_ref) = 0.7².
    for substeps in [1, 3, 12] {
        assert!((of(substeps) - 0.49).abs() < 1e-12);
    }
}

#[test]
fn vorticity_of_a_rigid_rotation_is_twice_its_rate() {
    let mut positions = Vec::new();
    for i in 0..1000 {
        positions.push(DVec3::new((i % 10).into(), (i / 10 % 10).into(), (i / 100).into()) * D);
    }
    let spin = DVec3::new(1.0, -2.0, 0.5);
    let velocities: Vec<_> = positions.iter().map(|x| spin.cross(*x)).collect();
    let neighbours = find(&positions, H, |_, _| true);
    let kernel = Kernel::new(H);
    let curl = forces::vorticity(&kernel, D.powi(3), &positions, &velocities, &neighbours);
    // Σ V₀ ∇W⊗x over the lattice is −1 to within its second-order error.
    assert!(
        (curl[555] - 2.0 * spin).length() < 0.05 * spin.length(),
        "{}",
        curl[555]
    );
    let push = forces::confinement(&kernel, (D.powi(3), 1.0), &positions, &curl, &neighbours);
    // Where |ω| does not vary there is nothing to confine.
    assert!(push[555].length() < 1e-6, "{}", push[555]);
    // It is ε·|ω| at most, and perpendicular to ω.
    for (push, curl) in push.iter().zip(&curl) {
        assert!(push.length() <= curl.length() && push.dot(*curl).abs() < 1e-9);
    }
}

#[test]
fn percentile_is_by_rank() {
    let densities: Vec<_> = (1..=200).map(|i| 1.0 + f64::from(i) / 1000.0).collect();
    let error = DensityError::of(&densities);
    assert!((error.p99 - 0.198).abs() < 1e-12 && (error.mean - 0.1005).abs() < 1e-12);
    assert_eq!(DensityError::of(&[0.5]), DensityError::default());
    assert_eq!(DensityError::of(&[]), DensityError::default());
}
