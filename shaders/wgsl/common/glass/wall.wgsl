// What the walls in a particle's reach are to it, together: the record `boundary`, (∇V, V).

fn wall_gradient(boundary: vec4<f32>) -> vec3<f32> {
    return boundary.xyz;
}

fn wall_volume(boundary: vec4<f32>) -> f32 {
    return boundary.w;
}
