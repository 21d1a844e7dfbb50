// The flask constraint (section 5, Eqs 18–23, Fig. 4), two-sided: inside
// before means inside after, but for the open top; and what is outside does
// not pass in. `flask/region.rs` is the same in f64.
//!include common/glass/glass_distance.wgsl
//!include common/glass/ground.wgsl
//!include common/liquid/particle.wgsl

/// d_margin, metres: 0.001 h.
override MARGIN: f32 = 5e-6;
/// Whether flask constraints are generated; without, membership is by region alone.
override CONSTRAINT: bool = true;

struct Constrained {
    position: vec3<f32>,
    membership: u32,
    generated: bool,
}

fn glass_distance(k: u32, p: vec3<f32>) -> f32 {
    return glass(k, p).distance;
}

/// Fig. 4: vertically to a proper height, then radially at the radius of that height.
fn into_liquid_space(k: u32, p: vec3<f32>) -> vec3<f32> {
    let gap = min(MARGIN, 0.25 * (flasks[k].rim - flasks[k].floor));
    let y = clamp(p.y, flasks[k].floor + gap, flasks[k].rim - gap);
    let glass = inner_radius(k, y);
    let limit = max(glass - MARGIN, 0.5 * glass);
    let r = length(p.xz);
    let scale = select(1.0, limit / r, r > limit);
    return vec3<f32>(p.x * scale, y, p.z * scale);
}

fn from_inside(k: u32, before: vec3<f32>, after: vec3<f32>) -> Constrained {
    if (is_inside(k, after)) { return Constrained(after, k + 1u, false); }
    if (after.y >= flasks[k].rim && crosses_mouth(k, before, after)) {
        let clear = flasks[k].rim + MARGIN;
        if (after.y < clear && glass_distance(k, after) < 0.5 * MARGIN) {
            return Constrained(vec3<f32>(after.x, clear, after.z), NOBODYS, true);
        }
        return Constrained(after, NOBODYS, false);
    }
    return Constrained(into_liquid_space(k, after), k + 1u, true);
}

/// Out of the glass or the liquid space by the shortest way along the outer
/// surface's normal: where a flask was put down upon a particle.
fn out_of_glass(k: u32, p: vec3<f32>) -> vec3<f32> {
    let r = max(length(p.xz), 1e-6);
    let aside = flasks[k].outer + MARGIN;
    return vec3<f32>(p.x / r * aside, p.y, p.z / r * aside);
}

fn from_outside(k: u32, before: vec3<f32>, after: vec3<f32>) -> Constrained {
    var start = before;
    let was_in = is_inside(k, before);
    let here = glass(k, before);
    if (was_in || here.distance < 0.0) {
        // Still in the glass by rounding or by the map's interpolation: along its normal first.
        start = before + here.normal * (2.0 * MARGIN - here.distance);
        if (was_in || glass_distance(k, start) < 0.0 || is_inside(k, start)) {
            start = out_of_glass(k, before);
        }
    }
    let path = after - start;
    let size = length(path);
    if (after.y < flasks[k].rim && start.y >= flasks[k].rim && crosses_mouth(k, start, after)) {
        if (is_inside(k, after)) { return Constrained(after, k + 1u, false); }
        return Constrained(into_liquid_space(k, after), k + 1u, true);
    }
    // Sphere tracing. Steps of at least a quarter of the wall end a walk along the glass.
    let least = 0.25 * flasks[k].wall;
    var clear = 0.0;
    var at = 0.0;
    var struck = false;
    for (var step = 0u; step < 64u; step++) {
        let distance = glass_distance(k, start + path * (at / max(size, 1e-12)));
        if (distance < MARGIN && at > 0.0) { struck = true; break; }
        if (at >= size) { break; }
        clear = at;
        at = min(at + max(distance, least), size);
    }
    if (!struck) {
        if (is_inside(k, after)) { return Constrained(start, NOBODYS, true); }
        return Constrained(after, NOBODYS, any(start != before));
    }
    for (var step = 0u; step < 12u; step++) {
        let middle = 0.5 * (clear + at);
        if (glass_distance(k, start + path * (middle / size)) < MARGIN) { at = middle; } else { clear = middle; }
    }
    let hit = start + path * (clear / size);
    // The rest of the motion along the glass, so that a drop runs down it.
    let normal = glass(k, hit).normal;
    let rest = after - hit;
    var slid = hit + rest - normal * min(dot(rest, normal), 0.0) + normal * MARGIN;
    let gap = glass(k, slid);
    if (gap.distance < MARGIN) { slid += gap.normal * (2.0 * MARGIN - gap.distance); }
    if (glass_distance(k, slid) < 0.0 || is_inside(k, slid) || length(slid - hit) > 2.0 * length(rest) + 8.0 * MARGIN) {
        slid = hit;
    }
    return Constrained(slid, NOBODYS, true);
}

/// Line 23: keeps a particle on its side of every wall. `before` is where it
/// was under the poses from `before_first` on, `after` where it is predicted
/// under those from `after_first` on (stage frame).
fn constrain(membership: u32, before: vec3<f32>, after: vec3<f32>, before_first: u32, after_first: u32) -> Constrained {
    var result = Constrained(after, membership, false);
    // Clamps and maxima would make a number of what is none, and it would stay.
    if (!is_finite(after)) { return result; }
    if (!CONSTRAINT) {
        result.membership = NOBODYS;
        for (var k = 0u; k < FLASKS; k++) {
            if (is_inside(k, flask_from_stage(poses[after_first + k], after))) { result.membership = k + 1u; }
        }
        return result;
    }
    if (FLASKS > 0u) {
        if (membership != NOBODYS) {
            let k = membership - 1u;
            let p = from_inside(k, flask_from_stage(poses[before_first + k], before),
                                flask_from_stage(poses[after_first + k], after));
            result.membership = p.membership;
            if (p.generated) {
                result.generated = true;
                result.position = stage_from_flask(poses[after_first + k], p.position);
            }
        }
        if (result.membership == NOBODYS) {
            for (var k = 0u; k < FLASKS; k++) {
                let local_before = flask_from_stage(poses[before_first + k], before);
                let local_after = flask_from_stage(poses[after_first + k], result.position);
                let reach = length(local_after - local_before) + flasks[k].wall
                    + flasks[k].outer + 0.5 * flasks[k].rim;
                let middle = vec3<f32>(0.0, 0.5 * flasks[k].rim, 0.0);
                let near = length(local_before - middle) <= reach;
                if (near && k + 1u != membership && result.membership == NOBODYS) {
                    let p = from_outside(k, local_before, local_after);
                    result.membership = p.membership;
                    if (p.generated) {
                        result.generated = true;
                        result.position = stage_from_flask(poses[after_first + k], p.position);
                    }
                }
            }
        }
    }
    if (result.membership == NOBODYS) {
        if (TABLE) {
            let p = result.position;
            let edge = beyond_table(p);
            if (p.y < TABLE_TOP + MARGIN && p.y > TABLE_UNDER - MARGIN && edge < 0.0) {
                // From below it stays below, from above above; from the side it stays beside.
                if (before.y <= TABLE_UNDER) {
                    result.position.y = TABLE_UNDER - MARGIN;
                } else if (before.y >= TABLE_TOP || beyond_table(before) < 0.0) {
                    result.position.y = TABLE_TOP + MARGIN;
                } else {
                    result.position = vec3<f32>(before.x, p.y, before.z);
                }
            }
        }
        result.position.y = max(result.position.y, FLOOR + MARGIN);
    }
    return result;
}
