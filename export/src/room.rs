//! Table and room as meshes.

use glam::DVec3;
use vitriol_render::BoxDesc;
use vitriol_run::scenery::laboratory;
use vitriol_run::stage;
use vitriol_sim::scene::Scene;

use crate::mesh::Mesh;

/// The table, where there is one, and the room as seen from within, in the stage, m.
pub fn meshes(scene: &Scene) -> [Mesh; 2] {
    let desc = laboratory(scene);
    let place = |mesh: Mesh| mesh.moved(|at| stage::stage_from_scene(scene, at), |normal| normal);
    let table = desc.table.map(|table| boxed(&table)).unwrap_or_default();
    let room = desc.room.map(|room| boxed(&room).turned());
    [place(table), place(room.unwrap_or_default())]
}

/// A box, its normals outward.
fn boxed(desc: &BoxDesc) -> Mesh {
    let (low, high) = (desc.min.as_dvec3(), desc.max.as_dvec3());
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for side in [low, high] {
            let outward = if side == high { 1.0 } else { -1.0 };
            let normal = DVec3::AXES[axis] * outward;
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let corner = |a: DVec3, b: DVec3| {
                let mut at = DVec3::ZERO;
                at[axis] = side[axis];
                at[u] = a[u];
                at[v] = b[v];
                at
            };
            let round = [(low, low), (high, low), (high, high), (low, high)];
            let [a, b, c, d] = round.map(|(p, q)| mesh.add(corner(p, q), normal));
            let face = if outward > 0.0 {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, c, b], [a, d, c]]
            };
            mesh.triangles.extend(face);
        }
    }
    mesh
}
