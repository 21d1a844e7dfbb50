//! Signs on the wall, in analytic shapes: corrosive (GHS05 of the United Nations' Globally Harmonized System), eye protection must be
//! worn (M004 of ISO 7010), eye wash (E011 of ISO 7010); and a periodic table. Drawn by us, simplified.

//!include common/picture/sight.wgsl

const SIGN_WHITE = vec3<f32>(0.80);
const SIGN_BLACK = vec3<f32>(0.02);
/// Safety red, blue and green of ISO 3864, roughly: RAL 3001, 5005 and 6032.
const SIGN_RED = vec3<f32>(0.55, 0.02, 0.02);
const SIGN_BLUE = vec3<f32>(0.01, 0.09, 0.33);
const SIGN_GREEN = vec3<f32>(0.01, 0.24, 0.09);

/// Distance to a capsule.
fn to_capsule(p: vec2<f32>, a: vec2<f32>, b: vec2<f32>, radius: f32) -> f32 {
    let along = b - a;
    return length(p - a - saturate(dot(p - a, along) / dot(along, along)) * along) - radius;
}

/// Distance to a box with round corners.
fn to_box(p: vec2<f32>, half: vec2<f32>, round_: f32) -> f32 {
    let q = abs(p) - half + round_;
    return length(max(q, vec2<f32>(0.0))) + min(max(q.x, q.y), 0.0) - round_;
}

/// A sign's albedo (rgb), and how much of the pixel it takes; p from its middle, over half its size; `sharp` likewise.
fn corrosive(p: vec2<f32>, sharp: f32) -> vec4<f32> {
    let corner = abs(p.x) + abs(p.y);
    let share = saturate((1.0 - corner) * sharp + 0.5);
    var albedo = mix(SIGN_RED, SIGN_WHITE, saturate((0.84 - corner) * sharp + 0.5));
    // Two tubes that pour, their drops, and what they eat: a bar, and a hand.
    var black = 1.0;
    for (var side = -1.0; side < 2.0; side += 2.0) {
        let q = vec2<f32>(side * p.x, p.y);
        let tube = to_capsule(q, vec2<f32>(0.12, 0.30), vec2<f32>(0.36, 0.40), 0.075);
        black = min(black, max(tube, -to_capsule(q, vec2<f32>(0.14, 0.31), vec2<f32>(0.34, 0.39), 0.04)));
        black = min(black, to_capsule(q, vec2<f32>(0.09, 0.26), vec2<f32>(0.13, 0.31), 0.075));
        let fall = vec2<f32>(q.x - 0.20, q.y);
        black = min(black, to_capsule(fall, vec2<f32>(-0.08, 0.12), vec2<f32>(-0.08, 0.05), 0.026));
        black = min(black, to_capsule(fall, vec2<f32>(0.02, 0.09), vec2<f32>(0.02, 0.02), 0.026));
        let eaten = length(q - vec2<f32>(0.17, -0.13)) - 0.08;
        let bar = to_box(q - vec2<f32>(0.31, -0.20), vec2<f32>(0.24, 0.07), 0.01);
        let hand = min(
            to_capsule(q, vec2<f32>(0.10, -0.23), vec2<f32>(0.38, -0.19), 0.06),
            to_capsule(q, vec2<f32>(0.38, -0.22), vec2<f32>(0.50, -0.27), 0.07),
        );
        black = min(black, max(select(hand, bar, side < 0.0), -eaten));
    }
    albedo = mix(albedo, SIGN_BLACK, saturate(0.5 - black * sharp));
    return vec4<f32>(albedo, share);
}

fn eye_protection(p: vec2<f32>, sharp: f32) -> vec4<f32> {
    let share = saturate((1.0 - length(p)) * sharp + 0.5);
    // A head with shoulders, and goggles over it.
    let head = p * vec2<f32>(1.0, 0.82) - vec2<f32>(0.0, 0.12);
    let shoulders = max(to_box(p - vec2<f32>(0.0, -0.82), vec2<f32>(0.56, 0.36), 0.24), length(p) - 0.86);
    let white = min(length(head) - 0.42, shoulders);
    let q = vec2<f32>(abs(p.x), p.y);
    let glass = to_box(q - vec2<f32>(0.20, 0.20), vec2<f32>(0.165, 0.12), 0.07);
    let strap = to_box(p - vec2<f32>(0.0, 0.24), vec2<f32>(0.50, 0.035), 0.0);
    let albedo = mix(SIGN_BLUE, SIGN_WHITE, saturate(0.5 - white * sharp));
    return vec4<f32>(mix(albedo, SIGN_BLUE, saturate(0.5 - min(glass, strap) * sharp)), share);
}

fn eye_wash(p: vec2<f32>, sharp: f32) -> vec4<f32> {
    let share = saturate(0.5 - to_box(p, vec2<f32>(1.0), 0.06) * sharp);
    // A face over a bowl with two jets, and the cross.
    let q = vec2<f32>(abs(p.x + 0.22), p.y);
    var white = length(p - vec2<f32>(-0.22, 0.42)) - 0.26;
    white = min(white, to_capsule(q, vec2<f32>(0.10, -0.02), vec2<f32>(0.16, -0.36), 0.035));
    white = min(white, max(length(p - vec2<f32>(-0.22, -0.34)) - 0.50, p.y + 0.40));
    let cross_ = p - vec2<f32>(0.58, 0.42);
    white = min(white, min(to_box(cross_, vec2<f32>(0.26, 0.09), 0.0), to_box(cross_, vec2<f32>(0.09, 0.26), 0.0)));
    white = max(white, -(to_box(q - vec2<f32>(0.10, 0.46), vec2<f32>(0.06, 0.025), 0.02)));
    return vec4<f32>(mix(SIGN_GREEN, SIGN_WHITE, saturate(0.5 - white * sharp)), share);
}

/// The albedo of a poster of the periodic table; `at` from its lower left corner over its cells' edge, of which it has 20 by 12.
fn periodic_table(at: vec2<f32>, sharp: f32) -> vec3<f32> {
    let cell = vec2<i32>(floor(at)) - vec2<i32>(1, 1);
    let row = 8 - cell.y;
    let column = cell.x;
    let within = column >= 0 && column < 18;
    var colour = vec3<f32>(0.0);
    if (row >= 0 && row < 7 && within) {
        let taken = row > 2 || (row == 0 && (column == 0 || column == 17)) || (row > 0 && (column < 2 || column > 11));
        colour = vec3<f32>(0.60, 0.42, 0.14);
        if (column < 2) { colour = vec3<f32>(0.62, 0.17, 0.13); }
        if (column > 11) { colour = vec3<f32>(0.22, 0.50, 0.27); }
        if (column == 16 || (row == 0 && column == 0)) { colour = vec3<f32>(0.13, 0.42, 0.55); }
        if (column == 17) { colour = vec3<f32>(0.36, 0.25, 0.55); }
        colour *= select(0.0, 1.0, taken);
    }
    // Lanthanides and actinides under it.
    if ((row == 7 || row == 8) && column > 1 && column < 17) { colour = vec3<f32>(0.55, 0.30, 0.42); }
    let paper = vec3<f32>(0.72, 0.72, 0.69);
    if (colour.x == 0.0) { return paper; }
    colour *= 0.62;
    let inside = abs(fract(at) - 0.5);
    let share = saturate((0.44 - max(inside.x, inside.y)) * sharp + 0.5);
    // The symbol's place: one or two letters, too small to be read.
    let letter = to_box(fract(at) - vec2<f32>(0.46, 0.55), vec2<f32>(0.10 + 0.12 * lot(u32(row * 18 + column), 0u), 0.16), 0.02);
    let ink = saturate(0.5 - letter * sharp) * saturate(1.6 - 2.0 / sharp);
    return mix(paper, mix(colour, 0.25 * colour, 0.6 * ink), mix(0.77, share, saturate(0.7 * sharp - 0.7)));
}
