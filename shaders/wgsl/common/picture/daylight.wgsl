//! The room's light: a window to the user's left, a bright ceiling, and what comes back from
//! floor and walls. All in linear Rec. 709, tone mapped by `display`.

/// The window's centre in the stage, metres.
const WINDOW: vec3<f32> = vec3<f32>(-1.5, 1.9, 0.5);
/// Its light, times square metres.
const WINDOW_POWER: vec3<f32> = vec3<f32>(7.4, 7.2, 6.9);
const CEILING_LIGHT: vec3<f32> = vec3<f32>(0.52, 0.55, 0.60);
const FLOOR_LIGHT: vec3<f32> = vec3<f32>(0.24, 0.22, 0.20);

/// The window's light on a surface that faces it: direction towards it, and its irradiance.
struct Key {
    direction: vec3<f32>,
    light: vec3<f32>,
}

/// `position` in metres.
fn key_light(position: vec3<f32>) -> Key {
    let to_window = WINDOW - position;
    let distance_squared = dot(to_window, to_window);
    return Key(
        to_window * inverseSqrt(distance_squared),
        WINDOW_POWER / (1.0 + distance_squared),
    );
}

/// Irradiance from ceiling and floor on a surface whose normal has the upward part `up`.
fn ambient_light(up: f32) -> vec3<f32> {
    return mix(FLOOR_LIGHT, CEILING_LIGHT, 0.5 + 0.5 * up);
}

/// What a mirror sees in `direction`: walls between floor and ceiling, and the window's four panes.
fn surroundings(direction: vec3<f32>) -> vec3<f32> {
    var seen = mix(FLOOR_LIGHT, CEILING_LIGHT, smoothstep(-0.3, 0.5, direction.y));
    // Where the direction meets the plane x = -1; the panes' edges are soft, so that thin
    // highlights do not shimmer.
    let hit = direction.yz / max(-direction.x, 1e-3);
    let pane = abs(hit - vec2<f32>(0.35, 0.75));
    let inside = smoothstep(vec2<f32>(1.00, 0.62), vec2<f32>(0.90, 0.54), pane);
    let bars = smoothstep(vec2<f32>(0.02), vec2<f32>(0.06), pane);
    let open = inside.x * inside.y * bars.x * bars.y * step(0.0, -direction.x);
    seen += open * vec3<f32>(5.2, 5.4, 5.6);
    return seen;
}

/// Tone mapping: a fit of the ACES film curve by K. Narkowicz (2016). The sRGB image does the
/// encoding.
fn display(light: vec3<f32>) -> vec3<f32> {
    return saturate(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14));
}
