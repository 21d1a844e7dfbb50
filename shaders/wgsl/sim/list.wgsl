// Line 10: the neighbours within support radius plus margin, by ascending
// index, in fours strided so that neighbouring invocations read side by side.
// Pairs that glass separates are left out here, once, and not in each pass.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/glass/vessel.wgsl
//!include common/liquid/cell_starts.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/trial.wgsl

@group(0) @binding(0) var<storage, read> sorted_trial: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> sorted_position: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> sorted_velocity: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> sorted_tags: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(5) var<storage, read> block_sums: array<u32>;
@group(0) @binding(6) var<storage, read_write> trial: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> position: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> velocity: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> tags: array<vec2<u32>>;
@group(0) @binding(10) var<storage, read_write> list_origin: array<vec4<f32>>;
@group(0) @binding(11) var<storage, read_write> list_counts: array<u32>;
@group(0) @binding(12) var<storage, read_write> list: array<u32>;
@group(0) @binding(13) var<storage, read_write> counters: Counters;
@group(0) @binding(14) var<storage, read> sorted_push: array<vec4<f32>>;
@group(0) @binding(15) var<storage, read_write> wall_push: array<vec4<f32>>;
@group(0) @binding(16) var<storage, read> sorted_heat: array<vec4<f32>>;
@group(0) @binding(17) var<storage, read_write> heat: array<vec4<f32>>;
@group(0) @binding(18) var<storage, read> sorted_matter: array<vec4<f32>>;
@group(0) @binding(19) var<storage, read_write> matter: array<vec4<f32>>;
@group(0) @binding(27) var<storage, read> sorted_bulk: array<vec4<f32>>;
@group(0) @binding(28) var<storage, read_write> bulk: array<vec4<f32>>;
@group(0) @binding(32) var<storage, read> sorted_eddies: array<vec2<f32>>;
@group(0) @binding(33) var<storage, read_write> eddies: array<vec2<f32>>;

/// Whether two particles of different membership see each other past the glass.
fn visible(a: u32, x_a: vec3<f32>, b: u32, x_b: vec3<f32>) -> bool {
    var seen = true;
    if (FLASKS > 0u) {
        if (a != NOBODYS) {
            let pose = poses[step.after + a - 1u];
            seen = visible_from(a - 1u, flask_from_stage(pose, x_a), flask_from_stage(pose, x_b));
        }
        if (b != NOBODYS) {
            let pose = poses[step.after + b - 1u];
            seen = seen && visible_from(b - 1u, flask_from_stage(pose, x_b), flask_from_stage(pose, x_a));
        }
    }
    return seen;
}

/// Word of the list that holds particle i's neighbour k: neighbours lie in
/// fours, and the fours of neighbouring particles side by side.
fn place(k: u32, i: u32) -> u32 {
    return ((k >> 2u) * COUNT + i) * 4u + (k & 3u);
}

var<private> found: u32;
var<private> coincident: bool;
/// Whether any candidate has another membership.
var<private> mixed: bool;

/// Candidate n of a row: one of `count` from `first` on, then of those from `second` on.
fn candidate(n: u32, first: u32, count: u32, second: u32) -> u32 {
    return select(second + n - count, first + n, n < count);
}

/// Tests `count` particles from `first` on, and then `wrapped` from `second`
/// on, in one loop: two would both be walked on a software driver, the second
/// one for nothing. With `keep` it lists those that are neighbours: 32 are
/// tested and then the hits written, since what is written under a condition
/// costs such a driver the same whether it holds or not.
fn search(i: u32, x: vec3<f32>, membership: u32, first: u32, count: u32, second: u32, wrapped: u32, keep: bool) {
    for (var start = 0u; start < count + wrapped; start += 32u) {
        let tested = min(count + wrapped - start, 32u);
        var near = 0u;
        for (var n = 0u; n < tested; n++) {
            let j = candidate(start + n, first, count, second);
            let other = sorted_trial[j];
            let offset = x - other.xyz;
            let distance = dot(offset, offset);
            let hit = distance < CELL * CELL && j != i;
            near |= select(0u, 1u << n, hit);
            // A call within the condition would be a branch round a function, and this pass a seventh dearer (H200).
            let theirs = membership_in(other);
            mixed = mixed || (hit && theirs != membership);
            coincident = coincident || (hit && distance < 1e-8 * SUPPORT * SUPPORT);
        }
        while (near != 0u) {
            let j = candidate(start + firstTrailingBit(near), first, count, second);
            near &= near - 1u;
            // On a software driver the few pairs of mixed membership are
            // looked at afterwards.
            var seen = true;
            if (LANES > 1u) {
                if (mixed) {
                    let other = sorted_trial[j];
                    let theirs = membership_in(other);
                    if (theirs != membership) { seen = visible(membership, x, theirs, other.xyz); }
                }
            }
            if (seen) {
                if (keep && found < LIST_CAPACITY) { list[place(found, i)] = j; }
                found++;
            }
        }
    }
}

/// The rows of three cells along x that are this lane's, of the nine around a particle.
fn search_rows(i: u32, lane: u32, x: vec3<f32>, membership: u32, keep: bool) {
    let cell = cell_of(x);
    let last = (1 << CELL_BITS_X) - 1;
    let low = u32((cell.x - 1) & last);
    let high = u32((cell.x + 1) & last);
    let wraps = low > high;
    for (var row = lane; row < 9u; row += LANES) {
        let y = cell.y + i32(row % 3u) - 1;
        let z = cell.z + i32(row / 3u) - 1;
        let start = cell_index(vec3<i32>(0, y, z));
        let first = start_of(start + low);
        let end = start_of(start + select(high, u32(last), wraps) + 1u);
        let second = start_of(start);
        let second_end = select(second, start_of(start + high + 1u), wraps);
        search(i, x, membership, first, end - first, second, second_end - second, keep);
    }
}

/// Takes those of the first `listed` neighbours off the list that glass hides.
fn drop_unseen(i: u32, x: vec3<f32>, membership: u32, listed: u32) {
    var kept = 0u;
    for (var k = 0u; k < listed; k++) {
        let j = list[place(k, i)];
        let other = sorted_trial[j];
        let theirs = membership_in(other);
        if (theirs == membership || visible(membership, x, theirs, other.xyz)) {
            list[place(kept, i)] = j;
            kept++;
        }
    }
    if (listed > 0u) { found = kept; }
}

/// A direction from a particle's identity: apart, but the same at each replay.
fn apart(identity: u32) -> vec3<f32> {
    var bits = identity * 747796405u + 2891336453u;
    bits = ((bits >> ((bits >> 28u) + 4u)) ^ bits) * 277803737u;
    let d = vec3<f32>(f32(bits & 1023u), f32((bits >> 10u) & 1023u), f32((bits >> 20u) & 1023u)) / 512.0 - 0.999;
    return d / length(d);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let tag = sorted_tags[i];
    var x = sorted_trial[i].xyz;
    found = 0u;
    coincident = false;
    mixed = false;
    if (LANES > 1u) {
        // Counts first, so that each lane knows where its own part of the list begins.
        if (tag.x != REMOVED) { search_rows(i, lane, x, tag.x, false); }
        var total = found;
        var before = 0u;
        for (var step = 1u; step < LANES; step <<= 1u) {
            let other = subgroupShuffleXor(total, step);
            if ((lane & step) != 0u) { before += other; }
            total += other;
        }
        found = before;
        if (tag.x != REMOVED) { search_rows(i, lane, x, tag.x, true); }
        found = total;
        coincident = lane_sum(select(0.0, 1.0, coincident)) > 0.0;
        if (lane != 0u) { return; }
    } else {
        if (tag.x != REMOVED) { search_rows(i, 0u, x, tag.x, true); }
        let listed = min(found, LIST_CAPACITY);
        let overflowed = found > LIST_CAPACITY;
        if (overflowed) { atomicAdd(&counters.list_overflows, 1u); }
        found = listed;
        if (FLASKS > 0u) { drop_unseen(i, x, tag.x, select(0u, listed, mixed)); }
        if (overflowed) {
            // It still counts as full: see `common/liquid/full_list.wgsl`.
            for (var k = found; k < LIST_CAPACITY; k++) { list[place(k, i)] = i; }
            found = LIST_CAPACITY;
        }
    }
    // Kernel gradients vanish at distance zero; particles in one place would
    // stay together for ever.
    if (coincident) { x += 1e-3 * SUPPORT * apart(tag.y); }
    if (found > LIST_CAPACITY) { atomicAdd(&counters.list_overflows, 1u); }
    let listed = min(found, LIST_CAPACITY);
    list_counts[i] = listed;
    // Sums take four at a time; the particle itself adds nothing to differences.
    for (var k = listed; (k & 3u) != 0u; k++) { list[place(k, i)] = i; }
    var volume = 1.0;
    if (PHYSICAL) { volume = unpack_bulk(sorted_bulk[i]).volume; }
    trial[i] = pack_trial(x, volume);
    list_origin[i] = vec4<f32>(x, 0.0);
    position[i] = sorted_position[i];
    velocity[i] = sorted_velocity[i];
    tags[i] = tag;
    if (LOADS) { wall_push[i] = sorted_push[i]; }
    if (HEAT) { heat[i] = sorted_heat[i]; }
    if (PHYSICAL) { matter[i] = sorted_matter[i]; }
    if (PHYSICAL) { bulk[i] = sorted_bulk[i]; }
    if (PHYSICAL) { eddies[i] = sorted_eddies[i]; }
    if (i == 0u) { atomicAdd(&counters.rebuilds, 1u); }
}
