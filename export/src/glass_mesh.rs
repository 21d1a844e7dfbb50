//! Glass as meshes: outlines turned about the flask's axis, in the flask's frame.

use std::f64::consts::TAU;

use glam::DVec3;
use vitriol_sim::flask::Profile;

use crate::mesh::Mesh;

/// Fewest sectors about the axis, and most.
const SECTORS: [usize; 2] = [48, 720];
/// Radius below which a point lies on the axis, m or the scene's unit.
const ON_AXIS: f64 = 1e-9;

/// The surface that faces the liquid's space, up to the rim; normals point out of the glass. No edge is longer than some
/// `cell`.
pub fn inner(profile: &Profile, cell: f64) -> Mesh {
    // Down to the axis, so that the glass lies on the left.
    let down: Vec<[f64; 2]> = profile.inner_outline().iter().rev().copied().collect();
    lathed(&down, cell)
}

/// The surface that faces the outside, with the rim's top; likewise.
pub fn outer(profile: &Profile, cell: f64) -> Mesh {
    let mut up = profile.outer_outline().to_vec();
    up.extend(profile.inner_outline().last());
    lathed(&up, cell)
}

/// An outline (r, y) turned about +Y; normals point to its right.
fn lathed(outline: &[[f64; 2]], cell: f64) -> Mesh {
    let outline = fine(outline, cell);
    let reach = outline.iter().map(|[r, _]| *r).fold(0.0, f64::max);
    let sectors = (TAU * reach / cell).ceil() as usize;
    let sectors = sectors.clamp(SECTORS[0], SECTORS[1]);
    let mut mesh = Mesh::default();
    // Each segment for itself: its ends have its own normals, so that edges stay sharp.
    for pair in outline.windows(2) {
        let [[r0, y0], [r1, y1]] = [pair[0], pair[1]];
        let length = (r1 - r0).hypot(y1 - y0);
        if length < ON_AXIS {
            continue;
        }
        let normal = [(y1 - y0) / length, -(r1 - r0) / length];
        let mut ring = |r: f64, y: f64| -> Vec<u32> {
            let at = |sector: usize| {
                // The last is the first, to the bit.
                let angle = TAU * (sector % sectors) as f64 / sectors as f64;
                let (sin, cos) = angle.sin_cos();
                let place = DVec3::new(r * cos, y, r * sin);
                (
                    place,
                    DVec3::new(normal[0] * cos, normal[1], normal[0] * sin),
                )
            };
            (0..sectors)
                .map(|sector| {
                    let (place, normal) = at(sector);
                    mesh.add(place, normal)
                })
                .collect()
        };
        let (low, high) = (ring(r0, y0), ring(r1, y1));
        for sector in 0..sectors {
            let next = (sector + 1) % sectors;
            if r0 > ON_AXIS {
                mesh.triangles.push([low[sector], high[sector], low[next]]);
            }
            if r1 > ON_AXIS {
                mesh.triangles.push([low[next], high[sector], high[next]]);
            }
        }
    }
    mesh
}

/// The outline with points at most `cell` apart.
fn fine(outline: &[[f64; 2]], cell: f64) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = outline.first().copied().into_iter().collect();
    for pair in outline.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let parts = ((b[0] - a[0]).hypot(b[1] - a[1]) / cell).ceil().max(1.0);
        let along = |n: f64| [0, 1].map(|k| a[k] + (b[k] - a[k]) * n / parts);
        points.extend((1..=parts as usize).map(|n| along(n as f64)));
    }
    points
}

#[cfg(test)]
#[path = "tests/glass_mesh.rs"]
mod tests;
