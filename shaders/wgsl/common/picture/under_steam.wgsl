//! Steam over what was drawn.

//!include common/picture/encode.wgsl
//!include common/picture/steam_light.wgsl
//!include common/picture/tile_pixels.wgsl

/// A pixel's colour, sRGB and alpha, with the steam before it.
fn under_steam(colour: vec4<f32>, place: Place) -> vec4<f32> {
    let steam = steam_over(place.pixel, place.eye, place.tile);
    let light = frame.shown * steam.rgb + steam.a * decoded(colour.rgb);
    // Behind steam the panel is the picture's.
    let alpha = select(1.0, colour.a, steam.a == 1.0);
    return vec4<f32>(encoded(light) + dither(vec2<f32>(place.pixel) + 0.5), alpha);
}
