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

/// The window's axes: out of it, towards where vessels stand on the bench (0, 0.75, −0.40), along its width, and along its height.
const WINDOW_OUT: vec3<f32> = vec3<f32>(0.71652, -0.54933, -0.42991);
const WINDOW_ACROSS: vec3<f32> = vec3<f32>(-0.51450, 0.0, -0.85749);
const WINDOW_UP: vec3<f32> = vec3<f32>(0.47105, 0.83560, -0.28263);
/// Half its width and height, and half the width of the bars between its four panes, metres: such that panes of `PANE_LIGHT` give the bench, under the
/// vessels, the key light's irradiance.
const WINDOW_HALF: vec2<f32> = vec2<f32>(0.935, 1.535);
const WINDOW_BAR: f32 = 0.065;
/// Half the width of their edges, metres: soft, so that thin highlights do not shimmer.
const WINDOW_EDGE: f32 = 0.045;
const PANE_LIGHT: vec3<f32> = vec3<f32>(5.55, 5.40, 5.175);

/// How much of what is seen from `position` (metres) along `direction`, of length 1 and nearer than `end` (metres), is the window's panes, 0 to 1.
fn panes_seen(position: vec3<f32>, direction: vec3<f32>, end: f32) -> f32 {
    let aside = position - WINDOW;
    let steep = dot(direction, WINDOW_OUT);
    let way = -dot(aside, WINDOW_OUT) / min(steep, -1e-6);
    if (steep > -1e-6 || way <= 0.0 || way >= end) { return 0.0; }
    let at = aside + way * direction;
    let place = abs(vec2<f32>(dot(at, WINDOW_ACROSS), dot(at, WINDOW_UP)));
    let inside = smoothstep(WINDOW_HALF + WINDOW_EDGE, WINDOW_HALF - WINDOW_EDGE, place);
    let bars = smoothstep(vec2<f32>(WINDOW_BAR - WINDOW_EDGE), vec2<f32>(WINDOW_BAR + WINDOW_EDGE), place);
    return inside.x * inside.y * bars.x * bars.y;
}

/// Tone mapping: a fit of the ACES film curve by K. Narkowicz (2016). The sRGB image does the
/// encoding.
fn display(light: vec3<f32>) -> vec3<f32> {
    return saturate(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14));
}
