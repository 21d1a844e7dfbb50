//! Dew on a vessel's inner wall: drops of which each bends what comes through it elsewhere, so that what is behind is seen between them
//! alone, and the room's light is seen in them as in mist.
//!
//! Once they touch, drops join as they grow, and cover the same share of the wall at every size (Beysens & Knobler 1986: 0.55);
//! before that they grow at their places.

//!include common/chemistry/dew.wgsl
//!include common/picture/daylight.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/mist_phase.wgsl

/// By vessel and place; shorter than one vessel's where no dew is.
@group(0) @binding(17) var<storage, read> dew: array<Dew>;

/// Share of a wall that drops cover once they touch.
const DEW_COVER = 0.55;
/// Film of which they do, kg/m²: of hemispheres with a radius of 5 µm, as on a breath figure, 2/3 of that times their share.
const DEW_TOUCHES = 0.00183;
/// A turn, rad.
const DEW_TURN = 6.2831853;

/// Whether a vessel may have dew: shards have none.
fn has_dew(vessel: u32) -> bool {
    return vessel < frame.blocker_count && (vessel + 1u) * DEW_AROUND * DEW_UP <= arrayLength(&dew);
}

/// Share of a wall that a film's drops cover.
fn dew_cover(film: f32) -> f32 {
    return DEW_COVER * min(pow(film / DEW_TOUCHES, 2.0 / 3.0), 1.0);
}

/// Share that dew covers of the wall of a vessel at p (its frame). Between places with much and without, films would make an edge.
fn dew_at(vessel: u32, p: vec3<f32>) -> f32 {
    let floor_ = frame.vessels[vessel].inner_floor;
    let share = (p.y - floor_) / (frame.vessels[vessel].rim - floor_);
    let up = clamp(share * f32(DEW_UP) - 0.5, 0.0, f32(DEW_UP - 1u));
    let low = min(u32(up), DEW_UP - 2u);
    // From the middle of the last place before the first.
    let around = (atan2(p.z, p.x) / DEW_TURN + 1.0) * f32(DEW_AROUND) - 0.5;
    let left = u32(around) % DEW_AROUND;
    let right = (left + 1u) % DEW_AROUND;
    let first = (vessel * DEW_UP + low) * DEW_AROUND;
    let next = first + DEW_AROUND;
    let below = vec2<f32>(dew[first + left].film, dew[first + right].film);
    let above = vec2<f32>(dew[next + left].film, dew[next + right].film);
    if (all(below == vec2<f32>(0.0)) && all(above == vec2<f32>(0.0))) { return 0.0; }
    let low_cover = mix(dew_cover(below.x), dew_cover(below.y), fract(around));
    let high_cover = mix(dew_cover(above.x), dew_cover(above.y), fract(around));
    return mix(low_cover, high_cover, up - f32(low));
}

/// What dew that covers that share sends to the eye at `place` (stage), times what it hides, and the share that is still open. `facing` is the
/// cosine between the wall's normal on the eye's side and the way to the eye.
fn dew_seen(cover: f32, place: vec3<f32>, to_eye: vec3<f32>, normal: vec3<f32>, facing: f32) -> vec4<f32> {
    // From aside a hemisphere shows more of itself over the wall that it is on.
    let depth = -log(1.0 - cover) * 0.5 * (1.0 + 1.0 / facing);
    let open = exp(-depth);
    let key = key_light(place * frame.metres_per_unit);
    // On the mean what is scattered has come through half of it.
    let window = window_scattered(dot(to_eye, -key.direction), 0.5 * depth);
    let back = sent_back(depth) * saturate(dot(normal, key.direction));
    let light = ambient_light(0.0) + (window + back) * key.light;
    return vec4<f32>(display(light) * (1.0 - open), open);
}
