//! How mist sends light on: drops of 5 µm scatter all of it, nearly straight ahead (van de Hulst 1957).

/// Mean cosine of the angle by which one drop scatters visible light.
const FORWARD = 0.85;
/// The same of the directions from the window's middle to its parts, half a radian away: that spreads what a drop scatters.
const WINDOW_SPREAD = 0.9;

/// Henyey and Greenstein's phase function with that mean cosine, times 4 π: 1 on the mean over all directions.
fn henyey_greenstein(mean: f32, cosine: f32) -> f32 {
    let across = 1.0 + mean * mean - 2.0 * mean * cosine;
    return (1.0 - mean * mean) * inverseSqrt(across * across * across);
}

/// Of light on a layer of mist, which absorbs none of it, the share that comes back out of it: ¾ (1 − g) τ/(1 + ¾ (1 − g) τ) (Eddington).
fn sent_back(depth: f32) -> f32 {
    let thick = 0.75 * (1.0 - FORWARD) * depth;
    return thick / (1.0 + thick);
}

/// What mist sends to the eye of the window's light, over what that is on a surface that faces it: `cosine` of the angle by which it is turned,
/// `depth` the optical depth of the mist that it came through.
///
/// Light of one direction has come through k drops as often as Poisson says, and each multiplies the mean cosine: so a thin veil is
/// bright before the window and dark beside it, and a thick one white. What is sent back does not get there. Irradiance is over π here, as a
/// white surface's light.
fn window_scattered(cosine: f32, depth: f32) -> f32 {
    let none = exp(-depth);
    let once = depth * none;
    let twice = 0.5 * depth * once;
    let more = max(1.0 - none - once - twice, 0.0);
    let first = WINDOW_SPREAD * FORWARD;
    var sum = none * henyey_greenstein(first, cosine);
    sum += once * henyey_greenstein(first * FORWARD, cosine);
    sum += twice * henyey_greenstein(first * FORWARD * FORWARD, cosine);
    sum += more * henyey_greenstein(first * FORWARD * FORWARD * FORWARD * FORWARD, cosine);
    return 0.25 * sum * (1.0 - sent_back(depth));
}
