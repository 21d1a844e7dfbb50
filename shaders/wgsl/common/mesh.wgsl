//! Vertices of a mesh, which the vertex shader fetches by index.

struct MeshVertex {
    /// In the mesh's own frame, in the scene's unit.
    position: vec3<f32>,
    /// 0 glass, 1 enamel on it.
    material: u32,
    /// Unit length, out of the solid.
    normal: vec3<f32>,
    /// Across a printed line: 0 in its middle, ±1 at its strip's edges.
    across: f32,
}

@group(0) @binding(1) var<storage, read> vertices: array<MeshVertex>;
