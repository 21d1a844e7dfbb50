#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
use super::*;
use crate::reference::Nothing;

/// Unit spacing, and the solver's h/d = 2.
fn parameters() -> Anisotropy {
    Anisotropy::new(1.0, 2.0)
}

/// A cubic lattice with steps smaller than a particle, which is nearly a
/// continuum.
fn dense(inside: impl Fn(DVec3) -> bool) -> Sums {
    let p = parameters();
    let mut sums = Sums::ZERO;
    for (offset, weight) in p.nodes() {
        if inside(offset) {
            sums.add(offset, weight, (p.radius / f64::from(NODES)).powi(3));
        }
    }
    sums
}

#[test]
fn a_full_neighbourhood_is_a_sphere() {
    let p = parameters();
    let shape = p.shape(DVec3::ONE, &dense(|_| true), f64::INFINITY);
    // The midpoint rule over cubes of R/8.
    assert!((shape.lengths / p.smoothing_length() - p.scale).length() < 0.01 * p.scale);
    assert!((shape.centre - DVec3::ONE).length() < 1e-12);
}

#[test]
fn on_a_plane_it_is_flat_by_the_integral() {
    let p = parameters();
    let normal = DVec3::new(2.0, -1.0, 0.5).normalize();
    let shape = p.shape(
        DVec3::ZERO,
        &dense(|offset| offset.dot(normal) < 0.0),
        f64::INFINITY,
    );
    // Over a half ball with w = 1 − (r/R)³ the mean lies ½(1/4 − 1/7)/(1/3 − 1/6) R
    // deep, the variance across is 0.15 R² less its square.
    let deep = 0.5 * (0.25 - 1.0 / 7.0) / (1.0 / 3.0 - 1.0 / 6.0);
    let across = (FULL_COVARIANCE - deep * deep) / FULL_COVARIANCE;
    let expected = DVec3::new(1.0, 1.0, across) * p.scale * p.smoothing_length();
    assert!(
        (shape.lengths - expected).length() < 0.02,
        "{} {expected}",
        shape.lengths
    );
    assert!(shape.axes.z_axis.dot(normal).abs() > 0.9999);
    let centre = -normal * (p.smoothing * deep * p.radius);
    assert!((shape.centre - centre).length() < 0.01, "{}", shape.centre);
    // G undoes the stretch.
    assert!((shape.g() * normal * shape.lengths.z - normal).length() < 1e-3);
}

#[test]
fn one_particle_is_a_small_sphere_where_it_is() {
    let p = parameters();
    let at = DVec3::new(0.3, 5.0, -2.0);
    let shape = p.shapes(&[at], &Nothing)[0];
    assert_eq!(shape.centre, at);
    assert!((shape.lengths - p.lone * p.smoothing_length()).length() < 1e-12);
}

#[test]
fn two_particles_are_long() {
    // Trusted at once, for the covariance of two to show.
    let p = Anisotropy {
        fade: [-2.0, -1.0],
        ..parameters()
    };
    let apart = DVec3::new(0.0, 1.2, 0.0);
    let shapes = p.shapes(&[DVec3::ZERO, apart], &Nothing);
    let w = 1.0 - 0.6_f64.powi(3);
    let along = w / (1.0 + w).powi(2) * 1.2 * 1.2 / (FULL_COVARIANCE * 4.0);
    let expected = p.scale * along * DVec3::new(1.0, 0.25, 0.25);
    assert!(
        (shapes[0].lengths - expected).length() < 1e-12,
        "{}",
        shapes[0].lengths
    );
    assert!(shapes[0].axes.x_axis.y.abs() > 1.0 - 1e-12);
    let moved = p.smoothing * w / (1.0 + w) * apart;
    assert!((shapes[0].centre - moved).length() < 1e-12);
}

/// A floor at y = 0.
struct FloorBelow;

impl Surroundings for FloorBelow {
    fn side(&self, _: usize) -> usize {
        0
    }

    fn distance(&self, _: usize, at: DVec3) -> f64 {
        at.y
    }

    fn apart(&self, a: usize, b: usize) -> bool {
        a + b == 1
    }
}

#[test]
fn a_wall_is_as_good_as_liquid() {
    // A lattice on a floor: its lowest layer half a spacing above.
    let p = parameters();
    let row = -4..=4;
    let lattice: Vec<DVec3> = row
        .clone()
        .flat_map(|x| (0..6).map(move |y| (x, y)))
        .flat_map(|(x, y)| row.clone().map(move |z| (x, y, z)))
        .map(|(x, y, z)| DVec3::new(x.into(), f64::from(y) + 0.5, z.into()))
        .collect();
    let centre = lattice
        .iter()
        .position(|&at| at == DVec3::new(0.0, 0.5, 0.0));
    let standing = p.shapes(&lattice, &FloorBelow)[centre.unwrap()];
    let floating = p.shapes(&lattice, &Nothing)[centre.unwrap()];
    // The continuum in the solid against a lattice above.
    assert!(
        (standing.lengths - p.scale).abs().max_element() < 0.12,
        "{standing:?}"
    );
    assert!((standing.centre.y - 0.5).abs() < 0.03, "{standing:?}");
    assert!(floating.lengths.z < 0.5 * p.scale, "{floating:?}");
    assert!(floating.centre.y > 0.8, "{floating:?}");
}

#[test]
fn glass_between_particles_parts_them() {
    let p = Anisotropy {
        fade: [-2.0, -1.0],
        ..parameters()
    };
    let positions = [DVec3::Y * 9.0, DVec3::Y * 9.5];
    let shapes = p.shapes(&positions, &FloorBelow);
    assert_eq!(shapes[0].centre, positions[0]);
}
