// Table and floor.
//!include common/liquid/kernel.wgsl

/// Whether there is a table.
override TABLE: bool = false;
/// Height of the table's top, metres.
override TABLE_TOP: f32 = 0.0;
/// Height of the table's underside, metres.
override TABLE_UNDER: f32 = 0.0;
override TABLE_X: f32 = 0.0;
override TABLE_Z: f32 = 0.0;
/// Half of the table's extent, metres.
override TABLE_HALF_X: f32 = 0.0;
override TABLE_HALF_Z: f32 = 0.0;
/// Height of the floor, metres.
override FLOOR: f32 = 0.0;
/// Entries of the table of half-space volumes over one support radius.
override PLANE_COUNT: u32 = 2u;

/// Half-space map: (V, dV/d(distance)) at distances 0 to h.
@group(0) @binding(24) var<storage, read> plane: array<vec2<f32>>;

/// What a half-space is to a particle over it.
struct HalfSpace {
    /// V.
    volume: f32,
    /// dV/d(distance), 1/m.
    slope: f32,
}

/// The half-space whose surface lies `distance` below; nothing from h on.
fn half_space(distance: f32) -> HalfSpace {
    let at = clamp(abs(distance) / SUPPORT, 0.0, 1.0) * f32(PLANE_COUNT - 1u);
    let i = min(u32(at), PLANE_COUNT - 2u);
    let value = mix(plane[i], plane[i + 1u], at - f32(i));
    return HalfSpace(select(value.x, 1.0 - value.x, distance < 0.0), value.y);
}

/// Horizontal distance beyond the table's edge; negative above the table.
fn beyond_table(p: vec3<f32>) -> f32 {
    return max(abs(p.x - TABLE_X) - TABLE_HALF_X, abs(p.z - TABLE_Z) - TABLE_HALF_Z);
}

/// Heights above the table's top and above the floor, metres.
struct Heights {
    table: f32,
    floor: f32,
}

/// As far as they are in reach of a particle at `p`; else h.
fn heights(p: vec3<f32>) -> Heights {
    var above = Heights(SUPPORT, min(p.y - FLOOR, SUPPORT));
    if (TABLE) {
        if (p.y > TABLE_UNDER && beyond_table(p) < 0.0) { above.table = min(p.y - TABLE_TOP, SUPPORT); }
    }
    return above;
}
