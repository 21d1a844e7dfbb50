// What the walls in a particle's reach are to it, together: the record `boundary`, (∇V, V).

/// Whether glass is made of boundary particles; else of volume maps.
override SOLIDS: bool = false;

fn pack_walls(gradient: vec3<f32>, volume: f32) -> vec4<f32> {
    return vec4<f32>(gradient, volume);
}

fn wall_gradient(boundary: vec4<f32>) -> vec3<f32> {
    return boundary.xyz;
}

fn wall_volume(boundary: vec4<f32>) -> f32 {
    return boundary.w;
}
