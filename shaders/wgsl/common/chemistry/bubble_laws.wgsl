// The laws by which a bubble grows, rises, collapses and joins another.
//!include common/chemistry/particle_mass.wgsl
//!include common/chemistry/solution.wgsl
//!include common/chemistry/surface_tension.wgsl
//!include common/liquid/gravity.wgsl

/// One atmosphere, Pa, and the gas constant of water vapour, J/(kg K).
const ATMOSPHERE: f32 = 101325.0;
const STEAM_CONSTANT: f32 = 461.5;
/// Latent heat of water at 25 °C, J/kg, and what it loses a kelvin.
const LATENT: f32 = 2.442e6;
const LATENT_SLOPE: f32 = 2.29e3;
/// σ of water at 20 °C, N/m.
const WATER_TENSION: f32 = 0.07275;
const BUBBLE_PI: f32 = 3.14159265;

/// Density of steam at one atmosphere, kg/m³, °C.
fn steam_density(temperature: f32) -> f32 {
    return ATMOSPHERE / (STEAM_CONSTANT * (temperature - ABSOLUTE_ZERO));
}

/// T of steam of the specific enthalpy `enthalpy` (J/kg), °C; not below 0.
fn steam_temperature(enthalpy: f32) -> f32 {
    return max(ENTHALPY_ZERO + (enthalpy - STEAM_ENTHALPY) / STEAM_CAPACITY, 0.0);
}

/// Volume of steam, m³; of a bubble, and radius of a volume.
fn steam_volume(mass: f32, enthalpy: f32) -> f32 {
    if (mass <= 0.0) { return 0.0; }
    return mass * MASS / steam_density(steam_temperature(enthalpy / mass));
}

fn bubble_volume(radius: f32) -> f32 {
    return 4.0 / 3.0 * BUBBLE_PI * radius * radius * radius;
}

fn radius_of_volume(volume: f32) -> f32 {
    return pow(0.75 / BUBBLE_PI * volume, 1.0 / 3.0);
}

/// A liquid around a bubble.
struct Around {
    /// kg/m³.
    density: f32,
    /// Pa s.
    viscosity: f32,
    /// N/m.
    tension: f32,
    /// ρ cp, J/(m³ K).
    capacity: f32,
    /// Thermal diffusivity, m²/s.
    diffusivity: f32,
    /// Latent heat, J/kg.
    latent: f32,
}

/// Thermal conductivity of water at 0 °C, what it gains a kelvin (NIST, to 1 % from 20 to 100 °C), and of acid, W/(m K).
const CONDUCTIVITY: f32 = 0.578;
const CONDUCTIVITY_SLOPE: f32 = 0.00099;
const ACID_CONDUCTIVITY: f32 = 0.26;

fn around_of(acid: f32, temperature: f32) -> Around {
    let density = density_of(acid, temperature);
    let tension = WATER_TENSION * relative_tension(acid, temperature);
    let capacity = density * capacity_at(row_at(acid), temperature);
    let conductivity = mix(CONDUCTIVITY + CONDUCTIVITY_SLOPE * temperature, ACID_CONDUCTIVITY, acid);
    return Around(
        density, viscosity_of(acid, temperature), tension, capacity, conductivity / capacity,
        LATENT - LATENT_SLOPE * (temperature - ENTHALPY_ZERO));
}

/// Drag coefficient times speed of a bubble of `radius` in contaminated liquid, m/s: a sphere (Schiller and Naumann 1933), a
/// distorted bubble, or a cap (Ishii and Zuber 1979).
fn drag_speed(radius: f32, speed: f32, around: Around) -> f32 {
    let moving = max(speed, 1e-5);
    let reynolds = 2.0 * radius * moving * around.density / around.viscosity;
    let eotvos = 4.0 * radius * radius * GRAVITY * around.density / around.tension;
    let sphere = 24.0 / reynolds * (1.0 + 0.15 * pow(reynolds, 0.687));
    return moving * max(sphere, min(2.0 / 3.0 * sqrt(eotvos), 8.0 / 3.0));
}

/// Rate at which drag slows down a bubble that takes half of its volume of liquid along, 1/s.
fn drag_rate(relative: vec3<f32>, radius: f32, around: Around) -> f32 {
    return 0.75 / radius * drag_speed(radius, length(relative), around);
}

/// Velocity relative to the liquid after `time`, m/s: drag, and twice the acceleration that the liquid lacks or has over free fall
/// (`buoyancy`, m/s²), as a bubble has the inertia of half of the liquid that it displaces (Magnaudet and Eames 2000).
/// Others around it do not slow it down: in a pool that is churned they rise in one another's wakes (Ishii and Zuber 1979).
fn risen(relative: vec3<f32>, buoyancy: vec3<f32>, drag: f32, time: f32) -> vec3<f32> {
    return (relative + 2.0 * time * buoyancy) / (1.0 + drag * time);
}

/// Nusselt number of a bubble with that speed, as Chen and Mayinger measured it (1992); of a sphere at rest 2.
fn nusselt(radius: f32, speed: f32, around: Around) -> f32 {
    let kinematic = around.viscosity / around.density;
    let reynolds = 2.0 * radius * speed / kinematic;
    return max(0.185 * pow(reynolds, 0.7) * sqrt(kinematic / around.diffusivity), 2.0);
}

/// Radius after `time` in liquid that is `superheat` (K) above its boiling point, of which the share `effective` drives growth:
/// Scriven's growth 2β√(αt) with Labuntsov's fit of β, or what its rise brings it, whichever is more.
fn grown(radius: f32, superheat: f32, effective: f32, speed: f32, vapour_density: f32, around: Around, time: f32) -> f32 {
    let jakob = around.capacity * superheat * effective / (vapour_density * around.latent);
    if (jakob <= 0.0) { return radius; }
    let small = BUBBLE_PI / (6.0 * jakob);
    let spreads = 12.0 / BUBBLE_PI * jakob * jakob * (1.0 + 0.5 * pow(small, 2.0 / 3.0) + small);
    let brought = jakob * nusselt(radius, speed, around);
    return sqrt(radius * radius + max(spreads, brought) * around.diffusivity * time);
}

/// The same in liquid that is `subcooling` (K) below it; 0 once the bubble is gone.
fn collapsed(radius: f32, subcooling: f32, effective: f32, speed: f32, vapour_density: f32, around: Around, time: f32) -> f32 {
    let jakob = around.capacity * subcooling * effective / (vapour_density * around.latent);
    let lost = jakob * nusselt(radius, speed, around) * around.diffusivity * time;
    return sqrt(max(radius * radius - lost, 0.0));
}

/// Film between two bubbles when they meet, over that at which it breaks: 0.1 mm and 10 nm.
const FILM: f32 = 9.21;

/// Time in which the film between two bubbles drains, s (Prince and Blanch 1990).
fn drainage_time(a: f32, b: f32, around: Around) -> f32 {
    let mean = 2.0 * a * b / (a + b);
    return sqrt(mean * mean * mean * around.density / (16.0 * around.tension)) * FILM;
}

/// How long a film lasts at the surface, s; 0: until it has drained.
override FOAM_TIME: f32 = 0.0;

/// Time from which on a bubble that lies at the surface bursts, s: its film drains as that between it and a bubble without end, of which
/// the mean radius r is twice its own, but besides 2σ/r its lift over its cross section presses on it. Surface tension holds no cap that is
/// wider than a stable bubble.
fn life_of_film(radius: f32, around: Around) -> f32 {
    if (radius > stable_radius(around)) { return 0.0; }
    if (FOAM_TIME > 0.0) { return FOAM_TIME; }
    let pressure = around.tension / radius + 4.0 / 3.0 * around.density * GRAVITY * radius;
    return radius * sqrt(0.5 * around.density / pressure) * FILM;
}

/// Radius beyond which bubbles do not join: larger ones are caps, which break up in a stirred pool (Ishii and Zuber 1979).
fn stable_radius(around: Around) -> f32 {
    return 2.0 * sqrt(around.tension / (max(GRAVITY, 1e-6) * around.density));
}
