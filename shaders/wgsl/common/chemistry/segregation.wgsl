// Liquid that is not mixed below a particle's size: `chemistry/segregation.rs` in f32.
//!include common/chemistry/eddies.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/molecules.wgsl
//!include common/chemistry/solution.wgsl

/// δ, m.
override LAMELLA: f32 = 0.0003;
/// Acid fraction of the acid's layers.
override FEED: f32 = 0.98;

/// Intervals of the table over c and √Θ.
const LAMELLAE_INTERVALS: u32 = 16u;
/// Variance below which a liquid counts as mixed.
const MIXED: f32 = 1e-8;
const ENGULFMENT: f32 = 0.058;
const WATER_VISCOSITY: f32 = 0.89e-3;
/// Depth of the water below the mean from which a surface shows it.
const LEAST_DEPTH: f32 = 1e-3;
const PI: f32 = 3.14159265358979;

/// Row k of the table behind that of the solution, what lamellae differ in from their mean: [h at 25 °C (J/kg), cp at 20 °C (J/(kg K)),
/// dcp/dT (J/(kg K²)), c less that of the middle of the water].
fn lamellae(k: u32) -> vec4<f32> {
    return solution[2u * (SOLUTION_INTERVALS + 1u) + k];
}

fn excess_of(acid: f32, variance: f32) -> vec4<f32> {
    let most = acid * (FEED - acid);
    if (variance <= 0.0 || most <= 0.0) { return vec4<f32>(0.0); }
    let at = vec2<f32>(acid / FEED, sqrt(min(variance / most, 1.0))) * f32(LAMELLAE_INTERVALS);
    let low = clamp(floor(at), vec2<f32>(0.0), vec2<f32>(f32(LAMELLAE_INTERVALS - 1u)));
    let t = at - low;
    let node = u32(low.x) * (LAMELLAE_INTERVALS + 1u) + u32(low.y);
    let above = node + LAMELLAE_INTERVALS + 1u;
    let here = mix(lamellae(node), lamellae(node + 1u), t.y);
    let there = mix(lamellae(above), lamellae(above + 1u), t.y);
    return mix(here, there, t.x);
}

/// c of the most watery part.
fn poorest_of(acid: f32, variance: f32) -> f32 {
    return max(acid - excess_of(acid, variance).w, 0.0);
}

/// The two liquids that lamellae show at a surface.
struct Shown {
    /// c of the water's, and of the acid's.
    poorest: f32,
    richest: f32,
    /// Share of the volume that is the water's.
    share: f32,
}

/// What lamellae show; a mixture is all of one liquid.
fn shown_of_lamellae(acid: f32, variance: f32, temperature: f32) -> Shown {
    let poorest = poorest_of(acid, variance);
    let depth = acid - poorest;
    if (depth < LEAST_DEPTH) { return Shown(acid, acid, 1.0); }
    let richest = min(acid + variance / depth, 1.0);
    let water = variance / density_of(poorest, temperature);
    let rest = depth * depth / density_of(richest, temperature);
    return Shown(poorest, richest, water / (water + rest));
}

/// Heat is that of all of it, the boiling point that of the middle of its water, the rest that of the mean.
fn row_of_lamellae(acid: f32, variance: f32) -> Row {
    var row = row_at(acid);
    if (SEGREGATION && variance > 0.0) {
        let excess = excess_of(acid, variance);
        row.value.enthalpy += excess.x;
        row.value.capacity += excess.y;
        row.rise += excess.z;
        let water = row_at(max(acid - excess.w, 0.0));
        row.value.boiling_point = water.value.boiling_point;
        row.slope.boiling_point = water.slope.boiling_point;
    }
    return row;
}

/// s² after the share `gone` of the liquid has left where its fraction is `poorest`, as water.
fn without_lamellar_water(variance: f32, acid: f32, poorest: f32, gone: f32) -> f32 {
    let left = 1.0 - gone;
    let squares = variance * left - acid * acid * gone + poorest * poorest * gone * left;
    return max(squares / (left * left), 0.0);
}

/// Rate at which lamellae lose their variance, 1/s.
fn decay_rate(acid: f32, temperature: f32, eddies: Eddies) -> f32 {
    let viscosity = viscosity_of(acid, temperature);
    let warmth = (temperature - ABSOLUTE_ZERO) / 298.15;
    let diffusivity = ACID_DIFFUSIVITY * warmth * WATER_VISCOSITY / viscosity;
    let wave = PI / LAMELLA;
    let engulfed = sqrt(dissipation_of(eddies) * density_of(acid, temperature) / viscosity);
    return ENGULFMENT * engulfed + 2.0 * diffusivity * wave * wave;
}

/// Vapour, and the variance of what is left of the liquid.
struct Boiled {
    vapour: f32,
    variance: f32,
}

/// Least change of y of which a secant is taken, and the slopes dS/dy (K) that one may have.
const SECANT_FROM: f32 = 1e-5;
const FLATTEST: f32 = 300.0;
const STEEPEST: f32 = 2e4;

/// A particle of acid fraction `acid` with `start` of vapour, when `vapour` of it is.
fn boiled_to(acid: f32, start: f32, variance: f32, poorest: f32, vapour: f32) -> Boiled {
    let gone = (vapour - start) / (1.0 - start);
    let left = without_lamellar_water(variance, liquid_acid(acid, start), poorest, gone);
    return Boiled(vapour, left);
}

/// S at that vapour, K.
fn superheat_of(acid: f32, enthalpy: f32, at: Boiled) -> f32 {
    let row = row_of_lamellae(liquid_acid(acid, at.vapour), at.variance);
    return temperature_with_steam(row, enthalpy, at.vapour) - row.value.boiling_point;
}

/// y at which the most watery part has its boiling point, by secants.
fn flash(acid: f32, enthalpy: f32, start: f32, variance: f32, poorest: f32) -> f32 {
    let most = clamp(1.0 - acid / AZEOTROPE, 0.0, MOST_VAPOUR);
    let row = row_of_lamellae(liquid_acid(acid, start), variance);
    let boiling = row.value.boiling_point;
    let latent = steam_enthalpy(boiling) - enthalpy_at(row, boiling);
    var slope = -(latent / capacity_at(row, boiling) + row.slope.boiling_point * row.acid);
    var vapour = start;
    var here = superheat_of(acid, enthalpy, boiled_to(acid, start, variance, poorest, vapour));
    for (var step = 0u; step < 3u; step++) {
        let next = clamp(vapour - here / slope, 0.0, most);
        let there = superheat_of(acid, enthalpy, boiled_to(acid, start, variance, poorest, next));
        let change = next - vapour;
        if (abs(change) > SECANT_FROM) {
            let found = (there - here) / change;
            if (found >= -STEEPEST && found < -FLATTEST) { slope = found; }
        }
        vapour = next;
        here = there;
    }
    return vapour;
}
