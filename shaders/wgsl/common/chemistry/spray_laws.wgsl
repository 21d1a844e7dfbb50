// The laws by which a bubble that bursts throws up drops, and by which these fly.
//!include common/chemistry/bubble_laws.wgsl

/// Drops that a bubble throws up in one way.
struct Burst {
    /// Of one drop, m.
    radius: f32,
    /// How many.
    number: f32,
    /// m/s.
    speed: f32,
    /// How far about their place they lie, m; 0 of drops in a row.
    about: f32,
}

/// Laplace number ρσR/μ² below which viscosity leaves no jet, and that above which it plays no part
/// (Deike et al. 2018; Gañán-Calvo 2018: an Ohnesorge number of 0.0045).
const LEAST_LAPLACE: f32 = 500.0;
const MOST_LAPLACE: f32 = 49383.0;
/// Bond number ρgR²/σ from which on a bubble lies too flat for a jet that breaks up (Walls, Henaux and Bird 2015).
const MOST_BOND: f32 = 3.0;

/// How many times smaller drops of a bubble are that has others all around it (Aurégan et al. 2025, arXiv 2511.00281).
const SMALLER: f32 = 5.0;
/// Share of gas where bubbles lie as close as they can.
const CLOSEST: f32 = 0.64;
/// Size of drops: Gañán-Calvo's 0.6 less a sixth, with which it is what Spiel (1994) measured of bubbles of 0.35 to 1.5 mm, to 8 %.
const JET_SIZE: f32 = 0.5;

/// Drops of the jet that shoots up where a bubble was: size r/l = 0.5 φ^(5/4) with l = μ²/(ρσ) and φ = La (500^-½ − La^-½)
/// (Gañán-Calvo 2017), number N = 7 exp(−R/3 mm) (Lewis and Schwartz 2004). The first one's speed is 19 σ/μ φ^(-3/4) (1 + 2.2 Bo)^(-3/4)
/// (Deike et al. 2018), and that of the n-th 1 − (n − 1)/N of it, since a jet that stretches is as fast at each height as it is high
/// (Gekle and Gordillo 2010): a bubble's surface has not the energy for all to be as fast as the first. They are those of the n-th by
/// the lot `which`. `crowd` is the share of gas around.
fn jet_of(radius: f32, around: Around, crowd: f32, which: f32) -> Burst {
    let per_viscosity = around.density * around.tension / (around.viscosity * around.viscosity);
    let laplace = min(per_viscosity * radius, MOST_LAPLACE);
    let bond = around.density * GRAVITY * radius * radius / around.tension;
    if (laplace <= LEAST_LAPLACE || bond >= MOST_BOND) { return Burst(0.0, 0.0, 0.0, 0.0); }
    // Towards the least Laplace number the law's speed grows without end.
    let excess = max(laplace * (inverseSqrt(LEAST_LAPLACE) - inverseSqrt(laplace)), 1.0);
    let neighbours = min(crowd / CLOSEST, 1.0);
    let size = radius * JET_SIZE / laplace * pow(excess, 1.25) * pow(SMALLER, -neighbours);
    let capillary = sqrt(around.tension / (around.density * radius));
    let speed = 19.0 * capillary * sqrt(laplace) * pow(excess * (1.0 + 2.2 * bond), -0.75);
    let number = 7.0 * exp(-radius / 3e-3);
    return Burst(size, number, speed * max(1.0 - floor(which * number) / number, 0.0), 0.0);
}

/// Radius from which on drops of films are followed: those of smaller bubbles are micrometres wide.
const FILM_FROM: f32 = 2e-3;
/// Film that has drained so far that it breaks by itself, over the radius squared, 1/m (Lhuissier and Villermaux 2012).
const THINNEST: f32 = 0.05;
/// Shortest time of drainage, s: before it a film is as thick as the bubble is wide.
const LEAST_DRAINED: f32 = 1e-3;
/// Greatest thickness of a film over the bubble's radius. Chosen.
const THICKEST: f32 = 0.1;

/// Thickness of a bubble's film that has lain at the surface for `time`, m: R (μR/(σt))^⅔ (Lhuissier and Villermaux 2012).
fn film_thickness(radius: f32, time: f32, around: Around) -> f32 {
    let drained = around.viscosity * radius / (around.tension * max(time, LEAST_DRAINED));
    return radius * clamp(pow(drained, 2.0 / 3.0), THINNEST * radius, THICKEST);
}

/// Drops of a bubble's film of that age (Lhuissier and Villermaux 2012): diameter R^(3/8) h^(5/8), number
/// 0.04 (R/a)² (R/h)^(7/8) with the capillary length a, and the speed √(2σ/(ρh)) at which the film opens. They have no more
/// liquid than half a sphere's film.
fn film_of(radius: f32, time: f32, around: Around) -> Burst {
    if (radius < FILM_FROM || GRAVITY <= 0.0) { return Burst(0.0, 0.0, 0.0, 0.0); }
    let thickness = film_thickness(radius, time, around);
    let capillary_square = around.tension / (around.density * GRAVITY);
    let size = 0.5 * pow(radius, 0.375) * pow(thickness, 0.625);
    let number = 0.04 * radius * radius / capillary_square * pow(radius / thickness, 0.875);
    let most = 2.0 * BUBBLE_PI * radius * radius * thickness / bubble_volume(size);
    return Burst(size, min(number, most), sqrt(2.0 * around.tension / (around.density * thickness)), radius);
}

/// Air of 20 °C: kg/m³ and Pa s.
const AIR_DENSITY: f32 = 1.204;
const AIR_VISCOSITY: f32 = 1.825e-5;

/// Velocity of a drop after `time` in air that rests (drag of a sphere: Schiller and Naumann 1933).
fn flown(velocity: vec3<f32>, gravity: vec3<f32>, radius: f32, density: f32, time: f32) -> vec3<f32> {
    let speed = max(length(velocity), 1e-5);
    let reynolds = 2.0 * radius * speed * AIR_DENSITY / AIR_VISCOSITY;
    // From Re = 1000 on it is that of a blunt body.
    let drag = max(24.0 / reynolds * (1.0 + 0.15 * pow(reynolds, 0.687)), 0.44);
    let rate = 0.375 * AIR_DENSITY / density * drag * speed / radius;
    return (velocity + gravity * time) / (1.0 + rate * time);
}
