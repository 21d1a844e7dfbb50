#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
use super::*;
use crate::reference::{Anisotropy, Nothing};
use glam::IVec3;
use vitriol_tests::random::Random;

fn shaken_lattice(low: IVec3, high: IVec3, shake: f64) -> Vec<DVec3> {
    let mut random = Random(5);
    let mut positions = Vec::new();
    for x in low.x..high.x {
        for y in low.y..high.y {
            for z in low.z..high.z {
                let site = IVec3::new(x, y, z).as_dvec3() + 0.5;
                positions.push(site + random.point(2.0 * shake));
            }
        }
    }
    positions
}

fn field(p: &Anisotropy, positions: &[DVec3]) -> Field<'static> {
    let volumes = vec![p.spacing.powi(3); positions.len()];
    Field::new(
        &p.shapes(positions, &Nothing),
        &volumes,
        p.spacing,
        &Nothing,
    )
}

#[test]
fn holds_the_particles_volume() {
    // Whatever their shapes: ∫φ = number × d³.
    let p = Anisotropy::new(0.1, 0.2);
    let positions = Random(3).points(40, 0.4);
    let field = field(&p, &positions);
    let [low, high] = field.bounds();
    let step = 0.01;
    let count = ((high - low) / step).ceil().as_ivec3();
    let mut sum = 0.0;
    for x in 0..count.x {
        for y in 0..count.y {
            for z in 0..count.z {
                let at = IVec3::new(x, y, z).as_dvec3() + 0.5;
                sum += field.value(low + at * step) * step.powi(3);
            }
        }
    }
    // The midpoint rule at a quarter of the sharpest kernel's smoothing length.
    assert!(
        (sum / (40.0 * p.spacing.powi(3)) - 1.0).abs() < 2e-3,
        "{sum}"
    );
}

#[test]
fn the_gradient_is_the_slope() {
    let p = Anisotropy::new(0.1, 0.2);
    let mut random = Random(11);
    let field = field(&p, &random.points(60, 0.4));
    let step = 1e-6;
    for _ in 0..200 {
        let at = random.point(0.5);
        let along = |axis| {
            let [ahead, behind] = [at + step * axis, at - step * axis].map(|at| field.value(at));
            (ahead - behind) / (2.0 * step)
        };
        let slope = DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z));
        // Central differences of a function that has a third derivative.
        assert!((field.gradient(at) - slope).length() < 1e-4 * (1.0 + slope.length()));
    }
}

#[test]
fn a_half_space_ends_where_it_should() {
    // The outermost particles lie half a spacing below the true surface, y = 0,
    // shaken, since a liquid at rest is no lattice.
    for shake in [0.2, 0.3, 0.4] {
        let p = Anisotropy::new(1.0, 2.0);
        let (low, high) = (IVec3::new(-8, -7, -8), IVec3::new(8, 0, 8));
        let positions = shaken_lattice(low, high, shake);
        let field = field(&p, &positions);
        let mut random = Random(1);
        let (mut height, mut level) = (0.0, 0.0);
        let count = 300;
        for _ in 0..count {
            let at = random.point(6.0).with_y(0.0);
            level += field.value(at) / f64::from(count);
            let mut y = 1.0;
            while field.value(at.with_y(y)) < SURFACE {
                y -= 0.005;
            }
            height += y / f64::from(count);
        }
        // A twelfth of a particle's radius.
        assert!(
            height.abs() < 0.04,
            "shaken by {shake}: {height}, φ there {level}"
        );
    }
}

#[test]
fn a_lone_droplet_has_its_volume() {
    let p = Anisotropy::new(1.0, 2.0);
    let field = field(&p, &[DVec3::ZERO]);
    let radius = (0.75 / PI).cbrt();
    for (scale, inside) in [(0.97, true), (1.03, false)] {
        let at = DVec3::new(0.6, 0.0, 0.8) * (scale * radius);
        assert_eq!(field.value(at) > SURFACE, inside, "{}", field.value(at));
    }
}

/// A glass box: liquid space is y > 0 for side 1, all else is solid to it.
struct Floor;

impl Surroundings for Floor {
    fn side(&self, _: usize) -> usize {
        1
    }

    fn distance(&self, _: usize, at: DVec3) -> f64 {
        at.y
    }

    fn apart(&self, _: usize, _: usize) -> bool {
        false
    }
}

#[test]
fn a_liquid_ends_at_its_wall() {
    let p = Anisotropy::new(1.0, 2.0);
    let positions = shaken_lattice(IVec3::new(-5, 0, -5), IVec3::new(5, 6, 5), 0.2);
    let volumes = vec![1.0; positions.len()];
    let field = Field::new(&p.shapes(&positions, &Floor), &volumes, 1.0, &Floor);
    let mut random = Random(8);
    for _ in 0..50 {
        let at = random.point(5.0).with_y(0.0);
        assert_eq!(field.value(at - DVec3::Y * 1e-6), 0.0);
        assert!(field.value(at + DVec3::Y * 1e-6) > 2.0 * SURFACE);
        let slanting = DVec3::new(0.5, 1.0, 0.2);
        assert!((field.normal(at, slanting) + DVec3::Y).length() < 1e-9);
    }
}
