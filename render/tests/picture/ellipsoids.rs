//! Ellipsoids against known neighbourhoods, and against the same mathematics
//! in f64 with an eigen-solve by Jacobi's rotations.

use crate::lanes::of_neighbours;
use crate::liquid::{
    Liquid, SPACING, SUPPORT, draw, ellipsoids, frame, lattice, rig, rig_of_lanes,
};
use glam::{DMat3, DVec3, Mat3, Vec3};
use vitriol_render::{Lanes, SurfaceFilter, View};
use vitriol_shaders::layout::Ellipsoid;
use vitriol_tests::gpu;

const D: f64 = SPACING as f64;
/// Radius of a sphere of the volume d³.
const LONE: f64 = 0.6204 * D;

fn shapes(positions: &[Vec3]) -> Vec<Ellipsoid> {
    shapes_of_lanes(positions, Lanes::CHOSEN)
}

fn shapes_of_lanes(positions: &[Vec3], lanes: Lanes) -> Vec<Ellipsoid> {
    let rig = rig_of_lanes([64, 36], 1, SurfaceFilter::NarrowRange, lanes);
    let liquid = Liquid::new(&rig, positions, |_| 0.0);
    let views = [View::bench(16.0 / 9.0)];
    draw(&rig, &frame(&views, &[], &liquid));
    ellipsoids(&rig, positions.len())
}

fn matrix(e: &Ellipsoid) -> DMat3 {
    let ([xx, yy, zz], [xy, xz, yz]) = (e.diagonal, e.others);
    Mat3::from_cols(
        Vec3::new(xx, xy, xz),
        Vec3::new(xy, yy, yz),
        Vec3::new(xz, yz, zz),
    )
    .as_dmat3()
}

fn differ(a: DMat3, b: DMat3) -> f64 {
    (0..3)
        .map(|i| (a.col(i) - b.col(i)).abs().max_element())
        .fold(0.0, f64::max)
}

#[test]
fn few_particles_are_drops_at_their_places() {
    let at = Vec3::new(0.1, 0.8, -0.4);
    for positions in [vec![at], vec![at, at + Vec3::X * SPACING]] {
        for (e, place) in shapes(&positions).iter().zip(&positions) {
            assert!(differ(matrix(e), DMat3::from_diagonal(DVec3::splat(LONE))) < 1e-6 * D);
            assert!(Vec3::from(e.centre).distance(*place) < 1e-6);
        }
    }
}

#[test]
fn what_contracted_is_drawn_as_small_as_it_is() {
    let rig = rig([64, 36], 1, SurfaceFilter::NarrowRange);
    let mut liquid = Liquid::new(&rig, &[Vec3::new(0.1, 0.8, -0.4)], |_| 0.0);
    liquid.volumes = Some(rig.buffer("volumes", &[[0.729, 0.0, 0.0, 0.0]]));
    let views = [View::bench(16.0 / 9.0)];
    draw(&rig, &frame(&views, &[], &liquid));
    let e = ellipsoids(&rig, 1)[0];
    // The root of a pow that a driver may take by logarithms.
    let sphere = DMat3::from_diagonal(DVec3::splat(0.9 * LONE));
    assert!(differ(matrix(&e), sphere) < 1e-5 * D);
}

#[test]
fn bulk_is_round_and_unseen() {
    let positions = lattice(4, 0.0, |_| true);
    let middle = nearest(&positions, Vec3::ZERO);
    let e = shapes(&positions)[middle];
    let axes = eigen(matrix(&e)).0;
    // Of a lattice the covariance is isotropic, and 0.9 d what closes the gaps.
    assert!(
        axes.iter().all(|axis| (axis / D - 0.9).abs() < 0.01),
        "{axes:?}"
    );
    assert!(Vec3::from(e.centre).distance(positions[middle]) < 1e-6);
    assert_eq!(e.visible, 0.0);
}

/// At a plane the ellipsoid lies flat on it, and its top is where the liquid
/// ends: half a spacing above the uppermost layer.
#[test]
fn plane_is_flat_and_neither_shrinks_nor_swells() {
    for jitter in [0.0, 0.15] {
        let positions = lattice(4, jitter, |x| x.y < 0.0);
        let all = shapes(&positions);
        let on_top = (0..positions.len()).filter(|&i| {
            let x = positions[i] / SPACING;
            x.y > -0.8 && x.x.abs().max(x.z.abs()) < 1.6
        });
        let mut tops = Vec::new();
        for i in on_top {
            let e = &all[i];
            assert_eq!(e.visible, 1.0);
            let (axes, vectors) = eigen(matrix(e));
            let normal = vectors.col(2);
            let tilt = normal.y.abs().acos().to_degrees();
            assert!(tilt < if jitter == 0.0 { 0.1 } else { 20.0 }, "{tilt}°");
            assert!(axes[0] > 1.4 * axes[2], "{axes:?}");
            // The support of an ellipsoid in a direction is |M n|.
            let top = f64::from(e.centre[1]) + (matrix(e) * DVec3::Y).length();
            tops.push(top / D);
        }
        let mean = tops.iter().sum::<f64>() / tops.len() as f64;
        assert!(
            mean.abs() < 0.12,
            "jitter {jitter}: the surface is {mean} d off"
        );
    }
}

#[test]
fn as_in_double_precision() {
    let positions = lattice(3, 0.3, |x| {
        x.length() < 2.6 || (x.y.abs() < 1.0 && x.x > 0.0)
    });
    let truth: Vec<_> = (0..positions.len())
        .map(|i| reference(&positions, i))
        .collect();
    assert!(truth.len() > 100);
    for lanes in of_neighbours(&gpu::device()) {
        let neighbours = Some(lanes);
        let all = shapes_of_lanes(
            &positions,
            Lanes {
                neighbours,
                ..Lanes::CHOSEN
            },
        );
        for (i, (e, (centre, shape))) in all.iter().zip(&truth).enumerate() {
            let off = differ(matrix(e), *shape) / D;
            // f32 in sums of some thirty terms, and in the formula of the eigenvalues,
            // which loses half of its digits where two of them meet.
            assert!(off < 2e-3, "{lanes} lanes, particle {i}: {off} d");
            let off = (Vec3::from(e.centre).as_dvec3() - *centre).length();
            assert!(off < 1e-4 * D, "{lanes} lanes, particle {i}: {off} m");
        }
    }
}

/// Centre and M of a particle far from all walls.
fn reference(positions: &[Vec3], i: usize) -> (DVec3, DMat3) {
    let h = f64::from(SUPPORT);
    let x = positions[i].as_dvec3();
    let (mut weight, mut first, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
    for (j, other) in positions.iter().enumerate() {
        let r = (other.as_dvec3() - x) / h;
        let w = (1.0 - r.length().powi(3)).max(0.0);
        if i != j && r.length() < 1.0 {
            weight += w;
            first += w * r;
            second += DMat3::from_cols(r * r.x, r * r.y, r * r.z) * w;
        }
    }
    // A ball of weights holds (2π/3)(h/d)³.
    let full = std::f64::consts::TAU / 3.0 * (h / D).powi(3);
    let t = ((weight / full - 0.10) / 0.25).clamp(0.0, 1.0);
    let fade = t * t * (3.0 - 2.0 * t);
    let all = weight + 1.0;
    let mean = first / all;
    let outer = DMat3::from_cols(mean * mean.x, mean * mean.y, mean * mean.z);
    let (values, vectors) = eigen((second * (1.0 / all) - outer) * (1.0 / 0.15));
    let values = values.map(|value| value.max(values[0] / 4.0));
    let t = ((values[2] / values[0] - 0.6) / 0.3).clamp(0.0, 1.0);
    let round = t * t * (3.0 - 2.0 * t);
    let least = (0.5 + 0.4 * round) * D + 0.9 * mean.length().min(0.187) * h;
    let axes = values.map(|value| (value * least / values[2]).min(2.0 * D));
    let shape = vectors * DMat3::from_diagonal(DVec3::from(axes)) * vectors.transpose();
    let lone = DMat3::from_diagonal(DVec3::splat(LONE));
    (
        x + mean * (fade * 0.9 * h),
        shape * fade + lone * (1.0 - fade),
    )
}

/// Eigenvalues, the greatest first, and their vectors, by Jacobi's rotations.
fn eigen(m: DMat3) -> ([f64; 3], DMat3) {
    let mut a = m.to_cols_array_2d();
    let mut v = DMat3::IDENTITY.to_cols_array_2d();
    for _ in 0..30 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q].abs() < 1e-300 {
                continue;
            }
            let theta = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
            let (s, c) = theta.sin_cos();
            for row in &mut a {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            let (row_p, row_q) = (a[p], a[q]);
            a[p] = [0, 1, 2].map(|k| c * row_p[k] - s * row_q[k]);
            a[q] = [0, 1, 2].map(|k| s * row_p[k] + c * row_q[k]);
            for row in &mut v {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[j][j].total_cmp(&a[i][i]));
    let column = |k: usize| DVec3::new(v[0][k], v[1][k], v[2][k]);
    (
        order.map(|k| a[k][k]),
        DMat3::from_cols(column(order[0]), column(order[1]), column(order[2])),
    )
}

fn nearest(positions: &[Vec3], to: Vec3) -> usize {
    let mut order: Vec<usize> = (0..positions.len()).collect();
    order.sort_by(|&a, &b| {
        positions[a]
            .distance(to)
            .total_cmp(&positions[b].distance(to))
    });
    order[0]
}
