#![allow(clippy::unwrap_used)]
use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::*;

/// An ellipsoid with these half-axes, somewhere: |x/a| − 1, which is no distance.
struct Ellipsoid(DVec3);

const CENTRE: DVec3 = DVec3::new(0.013, -0.4, 7.7);

impl Level for Ellipsoid {
    fn value(&self, at: DVec3) -> f64 {
        1.0 - ((at - CENTRE) / self.0).length()
    }

    fn gradient(&self, at: DVec3) -> DVec3 {
        let scaled = (at - CENTRE) / self.0;
        -scaled / (self.0 * scaled.length().max(1e-12))
    }
}

fn mesh(axes: DVec3, cell: f64) -> Mesh {
    surface(&Ellipsoid(axes), &[[CENTRE - axes, CENTRE + axes]], cell)
}

/// Each edge has two triangles, which go along it in opposite ways: the mesh is closed, and all its sides face one way.
fn is_closed(mesh: &Mesh) -> bool {
    let mut edges: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    for [a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry([*from.min(to), *from.max(to)]).or_default() +=
                if from < to { 1 } else { -1 };
        }
    }
    edges.values().all(|balance| *balance == 0)
}

/// Volume 4π/3 abc and, of a sphere, area 4πr²: their errors shrink with the square of the cell.
#[test]
fn volume_and_area_converge() {
    for axes in [DVec3::ONE, DVec3::new(1.0, 0.6, 0.8)] {
        let volume = 4.0 / 3.0 * PI * axes.element_product();
        let errors = [0.2, 0.1, 0.05].map(|cell| {
            let mesh = mesh(axes, cell);
            assert!(is_closed(&mesh));
            let centred = mesh.clone().moved(|at| at - CENTRE, |normal| normal);
            let volume = 1.0 - centred.flux() / volume;
            let area = 1.0 - mesh.area() / (4.0 * PI);
            [volume, if axes == DVec3::ONE { area } else { 0.0 }]
        });
        eprintln!("axes {axes}: errors of volume and area {errors:?}");
        for pair in errors.windows(2) {
            for (coarse, fine) in pair[0].iter().zip(pair[1]) {
                // Inscribed: less than the whole. A quarter, and 15 % for where the cells happen to lie.
                assert!(*coarse >= 0.0 && fine <= 0.29 * coarse, "{errors:?}");
            }
        }
        assert!(errors[2][0] < 2e-3, "{errors:?}");
    }
}

/// Vertices lie on the level set, and normals are its own.
#[test]
fn vertices_lie_on_the_level_set() {
    let axes = DVec3::new(1.0, 0.6, 0.8);
    let level = Ellipsoid(axes);
    let mesh = mesh(axes, 0.1);
    for (&at, normal) in mesh.positions.iter().zip(&mesh.normals) {
        assert!(level.value(at).abs() < 1e-6, "{}", level.value(at));
        let outward = ((at - CENTRE) / (axes * axes)).normalize();
        assert!(normal.dot(outward) > 1.0 - 1e-6);
    }
}

/// What is far apart takes no cells between.
#[test]
fn far_drops_cost_what_they_are() {
    struct Drops;
    impl Level for Drops {
        fn value(&self, at: DVec3) -> f64 {
            0.1 - at.length().min((at - 1000.0).length())
        }
        fn gradient(&self, at: DVec3) -> DVec3 {
            let from = if at.length() < 500.0 { at } else { at - 1000.0 };
            -from.normalize_or_zero()
        }
    }
    let around = |at: f64| [DVec3::splat(at - 0.1), DVec3::splat(at + 0.1)];
    let mesh = surface(&Drops, &[around(0.0), around(1000.0)], 0.02);
    assert!(is_closed(&mesh));
    let area = 2.0 * 4.0 * PI * 0.01;
    assert!(
        (mesh.area() / area - 1.0).abs() < 0.02,
        "{}",
        mesh.area() / area
    );
}
