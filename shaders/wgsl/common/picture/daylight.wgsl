//! The room's light: a window to the user's left, a bright ceiling, and what comes back from
//! floor and walls. All in linear Rec. 709, tone mapped by `display`. The figures are a day's; `frame` has the levels of other rooms.

//!include common/picture/frame.wgsl

/// The window's centre in the stage, metres: on the wall to the user's left.
const WINDOW: vec3<f32> = vec3<f32>(-1.6, 1.75, 0.35);
/// Its light, times square metres: such that the bench has, under the vessels, π times 0.755, 0.735 and 0.704.
const WINDOW_POWER: vec3<f32> = vec3<f32>(7.855, 7.643, 7.324);
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
        WINDOW_POWER * (frame.window_level / (1.0 + distance_squared)),
    );
}

/// Irradiance from ceiling and floor on a surface whose normal has the upward part `up`.
fn ambient_light(up: f32) -> vec3<f32> {
    return frame.sky_level * mix(FLOOR_LIGHT, CEILING_LIGHT, 0.5 + 0.5 * up);
}

/// The window's axes: out of it, along its width, and along its height.
const WINDOW_OUT: vec3<f32> = vec3<f32>(1.0, 0.0, 0.0);
const WINDOW_ACROSS: vec3<f32> = vec3<f32>(0.0, 0.0, -1.0);
const WINDOW_UP: vec3<f32> = vec3<f32>(0.0, 1.0, 0.0);
/// Half its width and height, and half the width of the bars between its four panes, metres: such that panes of `PANE_LIGHT` give the bench, under the
/// vessels, the key light's irradiance.
const WINDOW_HALF: vec2<f32> = vec2<f32>(1.181, 0.803);
const WINDOW_BAR: f32 = 0.035;
/// Half the width of their edges, metres: soft, so that thin highlights do not shimmer.
const WINDOW_EDGE: f32 = 0.03;
const PANE_LIGHT: vec3<f32> = vec3<f32>(9.25, 9.00, 8.625);
/// Half the angle that the window takes up, seen from the bench, rad: the root of half its width, as seen from there, times half its height, over the
/// 2.03 m to it.
const WINDOW_ANGLE = 0.38;

/// What the panes send out.
fn pane_light() -> vec3<f32> {
    return frame.window_level * PANE_LIGHT;
}

/// How much of what is seen from `position` (metres) along `direction` is the window's panes, 0 to 1, where there are no walls.
fn panes_seen(position: vec3<f32>, direction: vec3<f32>) -> f32 {
    let aside = position - WINDOW;
    let steep = dot(direction, WINDOW_OUT);
    let way = -dot(aside, WINDOW_OUT) / min(steep, -1e-6);
    if (steep > -1e-6 || way <= 0.0) { return 0.0; }
    let at = aside + way * direction;
    let place = abs(vec2<f32>(dot(at, WINDOW_ACROSS), dot(at, WINDOW_UP)));
    let inside = 1.0 - smoothstep(WINDOW_HALF - WINDOW_EDGE, WINDOW_HALF + WINDOW_EDGE, place);
    let bars = smoothstep(vec2<f32>(WINDOW_BAR - WINDOW_EDGE), vec2<f32>(WINDOW_BAR + WINDOW_EDGE), place);
    return inside.x * inside.y * bars.x * bars.y;
}

/// Tone mapping: a fit of the ACES film curve by K. Narkowicz (2016). The sRGB image does the
/// encoding.
fn display(unexposed: vec3<f32>) -> vec3<f32> {
    let light = frame.exposure * unexposed;
    return saturate(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14));
}
