//! A moment as glTF 2.0 in one binary file (`.glb`): surfaces, table, room, cameras.

use glam::{DVec3, Mat4};
use serde_json::{Value, json};

use crate::cameras::NamedView;
use crate::mesh::Mesh;

/// Indices of refraction: glass of beakers (borosilicate 3.3, Schott: 1.473), and water at 20 °C (1.333), since the surfaces are of
/// liquids that mix.
const GLASS: f64 = 1.473;
const WATER: f64 = 1.333;

/// Number types and targets of buffers, as the format counts them.
const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// What a mesh is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Matter {
    /// Liquid on its upper side.
    Liquid,
    /// Glass.
    Glass,
    /// Opaque: table and room.
    Solid,
}

/// The file's bytes: named meshes in the stage (m; +Y up, as in glTF) and cameras.
pub fn bytes(meshes: &[(&str, &Mesh, Matter)], cameras: &[NamedView], seconds: f64) -> Vec<u8> {
    let mut file = File::default();
    for (name, mesh, matter) in meshes {
        // A mesh of nothing is none.
        if !mesh.triangles.is_empty() {
            file.mesh(name, mesh, *matter);
        }
    }
    for camera in cameras {
        file.camera(camera);
    }
    file.glb(seconds)
}

#[derive(Default)]
struct File {
    bin: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    cameras: Vec<Value>,
    nodes: Vec<Value>,
}

impl File {
    fn mesh(&mut self, name: &str, mesh: &Mesh, matter: Matter) {
        let positions = self.vectors(&mesh.positions, true);
        let normals = self.vectors(&mesh.normals, false);
        let count = 3 * mesh.triangles.len();
        let corners = mesh.triangles.iter().flatten();
        let view = self.view(corners.flat_map(|corner| corner.to_le_bytes()), INDICES);
        let indices = self.accessors.len();
        self.accessors.push(json!({
            "bufferView": view, "componentType": UNSIGNED, "count": count, "type": "SCALAR",
        }));
        self.nodes
            .push(json!({ "name": name, "mesh": self.meshes.len() }));
        self.meshes.push(json!({
            "name": name,
            "primitives": [{
                "attributes": { "POSITION": positions, "NORMAL": normals },
                "indices": indices,
                "material": matter as usize,
            }],
        }));
    }

    fn vectors(&mut self, vectors: &[DVec3], bounded: bool) -> usize {
        let rounded = || vectors.iter().map(|vector| vector.as_vec3());
        let bytes = rounded()
            .flat_map(|vector| vector.to_array())
            .flat_map(f32::to_le_bytes);
        let view = self.view(bytes, VERTICES);
        let mut accessor = json!({
            "bufferView": view, "componentType": FLOAT, "count": vectors.len(), "type": "VEC3",
        });
        if bounded {
            let least = rounded().fold(glam::Vec3::INFINITY, glam::Vec3::min);
            let most = rounded().fold(glam::Vec3::NEG_INFINITY, glam::Vec3::max);
            accessor["min"] = json!(least.to_array());
            accessor["max"] = json!(most.to_array());
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn view(&mut self, bytes: impl Iterator<Item = u8>, target: u32) -> usize {
        let offset = self.bin.len();
        self.bin.extend(bytes);
        self.views.push(json!({
            "buffer": 0, "byteOffset": offset, "byteLength": self.bin.len() - offset, "target": target,
        }));
        self.views.len() - 1
    }

    fn camera(&mut self, NamedView { name, view }: &NamedView) {
        let fov = view.fov;
        // The format has symmetric frusta alone: the one around it, and the true one beside it.
        // A reader of tracks takes any angle up to a right one, of which the tangent is no number that a viewer can use.
        let half = |a: f32, b: f32| a.abs().max(b.abs()).clamp(0.01, 1.5).tan();
        let (across, up) = (half(fov.left, fov.right), half(fov.up, fov.down));
        let matrix = Mat4::from(view.stage_from_eye).to_cols_array();
        self.nodes.push(json!({
            "name": name, "camera": self.cameras.len(), "matrix": matrix,
            "extras": { "fov_rad": [fov.left, fov.right, fov.up, fov.down] },
        }));
        self.cameras.push(json!({
            "name": name, "type": "perspective",
            "perspective": { "yfov": 2.0 * up.atan(), "aspectRatio": across / up, "znear": 0.01 },
        }));
    }

    fn glb(self, seconds: f64) -> Vec<u8> {
        let clear = |name: &str, ior: f64| {
            json!({
                "name": name,
                "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 0.0 },
                "extensions": {
                    "KHR_materials_transmission": { "transmissionFactor": 1.0 },
                    "KHR_materials_ior": { "ior": ior },
                },
            })
        };
        let solid = json!({
            "name": "solid",
            "pbrMetallicRoughness": { "baseColorFactor": [0.6, 0.6, 0.6, 1.0], "metallicFactor": 0.0 },
        });
        let all: Vec<usize> = (0..self.nodes.len()).collect();
        let mut json = json!({
            "asset": { "version": "2.0", "generator": concat!("vitriol ", env!("CARGO_PKG_VERSION")) },
            "extensionsUsed": ["KHR_materials_transmission", "KHR_materials_ior"],
            "materials": [clear("liquid", WATER), clear("glass", GLASS), solid],
            "scene": 0,
            "scenes": [{ "nodes": all, "extras": { "time_s": seconds } }],
            "nodes": self.nodes,
        });
        // The format has no empty lists.
        for (name, list) in [
            ("bufferViews", self.views),
            ("accessors", self.accessors),
            ("meshes", self.meshes),
            ("cameras", self.cameras),
        ] {
            if !list.is_empty() {
                json[name] = Value::Array(list);
            }
        }
        let mut bin = self.bin;
        if !bin.is_empty() {
            json["buffers"] = json!([{ "byteLength": bin.len() }]);
        }
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        bin.resize(bin.len().next_multiple_of(4), 0);
        let length = 12 + 8 + text.len() + if bin.is_empty() { 0 } else { 8 + bin.len() };
        let mut bytes = b"glTF".to_vec();
        bytes.extend(2_u32.to_le_bytes());
        bytes.extend((length as u32).to_le_bytes());
        let mut chunk = |kind: &[u8; 4], content: &[u8]| {
            bytes.extend((content.len() as u32).to_le_bytes());
            bytes.extend(kind);
            bytes.extend(content);
        };
        chunk(b"JSON", &text);
        if !bin.is_empty() {
            chunk(b"BIN\0", &bin);
        }
        bytes
    }
}
