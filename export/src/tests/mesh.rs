#![allow(clippy::unwrap_used)]
use std::f64::consts::PI;

use super::*;
use crate::nets::{self, Level};

/// A ball about the origin.
struct Ball(f64);

impl Level for Ball {
    fn value(&self, at: DVec3) -> f64 {
        self.0 - at.length()
    }

    fn gradient(&self, at: DVec3) -> DVec3 {
        -at.normalize_or_zero()
    }
}

fn sphere(cell: f64) -> Mesh {
    nets::surface(&Ball(1.0), &[[DVec3::splat(-1.0), DVec3::splat(1.0)]], cell)
}

/// A cap of height h of a sphere has an area of 2πRh; where the cut is a step, as a wall's is, it is found as well.
#[test]
fn a_cap_has_its_area() {
    let (whole, height) = (sphere(0.05), 0.3);
    for side in [(|at: DVec3| at.y - 0.7) as fn(DVec3) -> f64, |at: DVec3| {
        if at.y > 0.7 { 5.0 } else { -0.1 }
    }] {
        let cap = whole.where_positive(side);
        // Chords of 0.05 on a radius of 1 lose 0.1 %.
        let error = cap.area() / (2.0 * PI * height) - 1.0;
        assert!(error.abs() < 2e-3, "{error}");
        let lowest = cap.positions.iter().map(|at| at.y).fold(1.0, f64::min);
        assert!((lowest - 0.7).abs() < 1e-4, "{lowest}");
        let rest = whole.where_positive(|at| -side(at));
        assert!((cap.area() + rest.area() - whole.area()).abs() < 1e-9);
    }
}

/// ⅓∮x·n dA, of parts that are moved about, adds up to the volume; turned, it is negative.
#[test]
fn parts_add_up_to_the_volume() {
    let whole = sphere(0.1);
    let mut parts = whole.where_positive(|at| at.x - 0.2);
    parts.append(&whole.where_positive(|at| 0.2 - at.x));
    assert!((parts.flux() - whole.flux()).abs() < 1e-3);
    assert!((whole.clone().turned().flux() + whole.flux()).abs() < 1e-12);
    let moved = whole.clone().moved(|at| at + DVec3::X * 3.0, |n| n);
    assert!((moved.flux() - whole.flux()).abs() < 1e-9);
}
