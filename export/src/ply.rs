//! PLY (G. Turk, 1994), binary, little-endian: vertices with normals, triangles; or vertices with numbers.

use crate::cloud::Cloud;
use crate::mesh::Mesh;

/// A mesh as the bytes of a file. `comment` is a line that describes it.
pub fn bytes(mesh: &Mesh, comment: &str) -> Vec<u8> {
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment {comment}\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\n\
         property float nx\nproperty float ny\nproperty float nz\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len()
    );
    let mut bytes = header.into_bytes();
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
        for value in position.to_array().into_iter().chain(normal.to_array()) {
            bytes.extend((value as f32).to_le_bytes());
        }
    }
    for triangle in &mesh.triangles {
        bytes.push(3);
        for corner in triangle {
            bytes.extend((*corner as i32).to_le_bytes());
        }
    }
    bytes
}

/// A cloud of points as the bytes of a file; each column is a property of its vertices.
pub fn points(cloud: &Cloud, comment: &str) -> Vec<u8> {
    let names = ["x", "y", "z"].into_iter();
    let names = names.chain(cloud.columns.iter().map(|(name, _)| *name));
    let properties: String = names
        .map(|name| format!("property float {name}\n"))
        .collect();
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment {comment}\nelement vertex {}\n{properties}end_header\n",
        cloud.positions.len()
    );
    let mut bytes = header.into_bytes();
    for (n, position) in cloud.positions.iter().enumerate() {
        let numbers = cloud.columns.iter().map(|(_, values)| values[n]);
        for value in position.to_array().into_iter().chain(numbers) {
            bytes.extend((value as f32).to_le_bytes());
        }
    }
    bytes
}
