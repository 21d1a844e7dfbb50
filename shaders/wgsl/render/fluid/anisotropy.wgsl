//! Each particle's ellipsoid from the places of its neighbours (J. Yu & G. Turk, 2013), over the
//! solver's own list: one pass, and what it writes is a copy, so that the picture can be drawn
//! while the solver goes on.
//!
//! With the weights w = 1 − (r/R)³, R the support radius h, the mean x̄ of the neighbourhood and
//! its covariance C: a full neighbourhood has C = 0.15 R² I exactly, so Ĉ = C / (0.15 R²) needs
//! no scale with a unit. At a plane surface Ĉ's least eigenvalue is about one half, and that
//! is how flat the ellipsoid lies on it.
//!
//! Yu and Turk give every ellipsoid the same size. Here its least half axis is the distance from
//! where smoothing put the centre to the surface: half a spacing, and what x̄ was moved inwards.
//! So the liquid neither shrinks nor swells by being smoothed.
//!
//! What is solid counts as filled with liquid, in closed form: beyond the tangent plane of the
//! nearest wall a cap of the weight's ball has known moments. A particle at the glass is then as
//! round as one in the bulk, and is moved so that it meets the glass.
//!
//! A particle with few neighbours fades to a sphere of its own volume, at its own place: drops
//! in flight are drops.

//!include common/chemistry/bulk.wgsl
//!include common/chemistry/heat.wgsl
//!include common/glass/glass_distance.wgsl
//!include common/liquid/lane_sums.wgsl
//!include common/liquid/list_block.wgsl
//!include common/liquid/position.wgsl
//!include common/maths/eigen.wgsl
//!include common/picture/ellipsoid.wgsl

struct Neighbourhood {
    /// Number of particles.
    count: u32,
    /// Vessels that a wall may belong to.
    flasks: u32,
    /// 0: spheres; else ellipsoids.
    anisotropic: u32,
    /// 1 where particles have a temperature and an acid fraction.
    heated: u32,
    /// 1 where they have volumes of their own; else each is d³.
    swelling: u32,
    /// Particle spacing d.
    spacing: f32,
    /// Support radius h, within which the list lacks next to none.
    support: f32,
    /// Fours of neighbours that the list has room for, of each particle.
    fours: u32,
    /// Height of the floor.
    floor: f32,
    /// Height of the table's top.
    table_top: f32,
    /// Least x and z of the table.
    table_min: vec2<f32>,
    /// Greatest x and z of the table.
    table_max: vec2<f32>,
}

var<immediate> around: Neighbourhood;

@group(0) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> list_counts: array<u32>;
@group(0) @binding(2) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> ellipsoids: array<Ellipsoid>;
/// The record `bulk`.
@group(0) @binding(9) var<storage, read> volumes: array<vec4<f32>>;

/// Yu and Turk's λ: how far a centre goes to its neighbours' mean.
const SMOOTHING = 0.9;
/// Their k_r: an ellipsoid's axes differ by no more.
const FLATTEST = 4.0;
/// No half axis is longer, in spacings: a sheet's rim would reach into the air. Shorter ones leave gaps between particles at a wall
/// (docs/measurements/rendering.md).
const LONGEST = 2.0;
/// Offset of the mean of the neighbourhood of a particle half a spacing below a plane surface, for
/// h = 2 d, in support radii (by the moments below). One that sticks out has a greater one, and
/// is not to stick out by more for that.
const PLANE_OFFSET = 0.187;
/// Radius of a sphere of the volume d³, in spacings.
const LONE_RADIUS = 0.6204;
/// Half axis in the bulk, in spacings: closes the gaps between particles at a wall, also where
/// vapour in them has moved them apart.
const BULK_RADIUS = 0.9;
/// How far what lies at a wall reaches into it, in spacings: so that no gap between two
/// particles shows.
const INTO_WALL = 0.35;
/// Weight of the neighbours, in those of a full neighbourhood, at which a particle
/// begins to count as part of a body of liquid, and does so wholly.
const FADE = vec2<f32>(0.10, 0.35);
const TAU = 6.283185307;

/// Moments of the weight over a neighbourhood, in support radii: Σw, Σwr, Σwrrᵀ.
struct Moments {
    weight: f32,
    first: vec3<f32>,
    /// xx, yy, zz.
    squares: vec3<f32>,
    /// xy, xz, yz.
    products: vec3<f32>,
}

fn neighbours(i: u32, x: vec3<f32>, lane: u32) -> Moments {
    var sum = Moments(0.0, vec3<f32>(0.0), vec3<f32>(0.0), vec3<f32>(0.0));
    // A crowd's longer lists are not read: their first neighbours suffice for a picture.
    let number = min(list_counts[i], 4u * around.fours);
    for (var g = lane; g * 4u < number; g += LANES) {
        let four = list[four_in_blocks(g, i, around.fours)];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let r = (positions[j].xyz - x) / around.support;
            let square = dot(r, r);
            // What fills up the last four is the particle itself.
            let w = select(max(1.0 - square * sqrt(square), 0.0), 0.0, j == i);
            sum.weight += w;
            sum.first += w * r;
            sum.squares += w * r * r;
            sum.products += w * r.xxy * r.yzz;
        }
    }
    if (LANES > 1u) {
        sum.weight = lane_sum(sum.weight);
        sum.first = lane_sum3(sum.first);
        sum.squares = lane_sum3(sum.squares);
        sum.products = lane_sum3(sum.products);
    }
    return sum;
}

/// The nearest wall; far away for none.
fn nearest_wall(x: vec3<f32>) -> Gap {
    var wall = Gap(vec3<f32>(0.0, 1.0, 0.0), x.y - around.floor);
    let on_table = all(x.xz > around.table_min) && all(x.xz < around.table_max);
    let above = x.y - around.table_top;
    if (on_table && above > -around.spacing) { wall.distance = min(wall.distance, above); }
    for (var k = 0u; k < around.flasks; k++) {
        let offset = x - poses[k].position.xyz;
        let reach = flasks[k].outer + flasks[k].rim + around.support;
        if (dot(offset, offset) < reach * reach) {
            let here = glass(k, flask_from_stage(poses[k], x));
            if (here.distance < wall.distance) { wall = Gap(rotate(poses[k].orientation, here.normal), here.distance); }
        }
    }
    return wall;
}

/// Moments of the cap of the weight's ball beyond a plane at `t` support radii in the
/// direction −n, as if it were filled: 2πN ∫ over z from t to 1, N the particles in (h)³.
fn cap(n: vec3<f32>, distance: f32) -> Moments {
    let t = clamp(distance, 0.0, 1.0);
    let ratio = around.support / around.spacing;
    let number = TAU * ratio * ratio * ratio;
    let t2 = t * t;
    let t5 = t2 * t2 * t;
    let weight = 1.0 / 6.0 - t * (0.3 - t2 / 6.0 + t5 / 30.0);
    let first = 3.0 / 56.0 - t2 * (0.15 - t2 / 8.0 + t5 / 35.0);
    let along = 0.025 - t2 * t * (0.1 - 0.1 * t2 + t5 / 40.0);
    let aside = 0.025 - t * (3.0 / 56.0 - 0.05 * t2 + t2 * t2 / 40.0 - t5 * t2 / 280.0);
    return Moments(
        number * weight,
        -number * first * n,
        number * (vec3<f32>(aside) + (along - aside) * n * n),
        number * (along - aside) * n.xxy * n.yzz,
    );
}

/// M = Q diag(axes) Qᵀ.
fn with_axes(q: mat3x3<f32>, axes: vec3<f32>) -> Symmetric {
    let m = mat3x3<f32>(q[0] * axes.x, q[1] * axes.y, q[2] * axes.z) * transpose(q);
    return Symmetric(vec3<f32>(m[0].x, m[1].y, m[2].z), vec3<f32>(m[0].y, m[0].z, m[1].z));
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= around.count) { return; }
    let particle = positions[i];
    let x = particle.xyz;
    let d = around.spacing;
    let acid = acid_in(heat[around.heated * i]);
    // Liquid that contracts as it mixes is drawn as small as it is.
    var own = d;
    if (around.swelling != 0u) { own = d * pow(max(unpack_bulk(volumes[i]).volume, 1e-3), 1.0 / 3.0); }
    var out = Ellipsoid(x, acid, vec3<f32>(LONE_RADIUS * own), 1.0, vec3<f32>(0.0));
    if (around.anisotropic != 0u) {
        var sum = neighbours(i, x, lane);
        if (lane != 0u) { return; }
        let ratio = around.support / d;
        let full = TAU / 3.0 * ratio * ratio * ratio;
        let fade = smoothstep(FADE.x, FADE.y, sum.weight / full);

        let wall = nearest_wall(x);
        let solid = cap(wall.normal, wall.distance / around.support);
        let weight = sum.weight + solid.weight + 1.0;
        let mean = (sum.first + solid.first) / weight;
        let inverse = 1.0 / (0.15 * weight);
        let covariance = Symmetric(
            (sum.squares + solid.squares) * inverse - mean * mean / 0.15,
            (sum.products + solid.products) * inverse - mean.xxy * mean.yzz / 0.15,
        );
        let eigen = eigen_of(covariance);
        let values = max(eigen.values, vec3<f32>(eigen.values.x / FLATTEST));

        let moved = SMOOTHING * min(length(mean), PLANE_OFFSET) * around.support;
        let round = smoothstep(0.6, 0.9, values.z / values.x);
        let least = mix(0.5, BULK_RADIUS, round) * own + moved;
        let axes = min(values * (least / values.z), vec3<f32>(LONGEST * d));
        let shape = with_axes(eigen.vectors, axes);
        out.diagonal = mix(out.diagonal, shape.diagonal, fade);
        out.others = fade * shape.others;
        out.centre = x + fade * SMOOTHING * around.support * mean;

        // What lies at a wall reaches a little into it, and is cut there (`at_glass.wgsl`).
        let at_wall = fade * (1.0 - smoothstep(0.75 * d, 1.25 * d, wall.distance));
        let extent = length(apply(Symmetric(out.diagonal, out.others), wall.normal));
        let gap = wall.distance + dot(out.centre - x, wall.normal);
        out.centre += wall.normal * ((extent - INTO_WALL * d - gap) * at_wall);

        let deep = length(mean) < 0.05 && weight > 0.85 * full && wall.distance > 1.25 * d;
        out.visible = select(1.0, 0.0, deep);
    }
    if (is_taken_out(particle)) { out.visible = -1.0; }
    if (lane == 0u) { ellipsoids[i] = out; }
}
