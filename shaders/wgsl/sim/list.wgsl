// Line 10: the neighbours within support radius plus margin, row by row of cells.
// Pairs that glass separates are left out here, once, and not in each pass.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/turnover_plan.wgsl
//!include common/glass/vessel.wgsl
//!include common/liquid/cell_starts.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/list_block.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/trial.wgsl

/// Invocations that search one particle's neighbours: more than share its sums, as more candidates are tested than neighbours found.
override LIST_LANES: u32 = 1u;

@group(0) @binding(0) var<storage, read> sorted_trial: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> sorted_position: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> sorted_velocity: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> sorted_tags: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> cell_starts: array<u32>;
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
/// See `common/chemistry/turnover_plan.wgsl`.
@group(0) @binding(34) var<storage, read_write> kept: array<f32>;
/// As `common/liquid/listed.wgsl` has it.
@group(0) @binding(52) var<storage, read_write> long_lists: array<atomic<u32>>;

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

/// Where neighbours are written: the first four, from each to the next, and how many there is room for.
struct Place {
    first: u32,
    stride: u32,
    room: u32,
}

/// A particle's place in the list.
fn place_of(i: u32) -> Place {
    return Place(four_in_blocks(0u, i, LIST_CAPACITY / 4u), LIST_BLOCK, LIST_CAPACITY);
}

/// First of the fours of a long list of so many neighbours. The sum stops where there is no room any more: that of a million in one place would come
/// round to a small one.
fn claim(i: u32, neighbours: u32) -> u32 {
    let fours = (neighbours + 3u) / 4u;
    var first = atomicLoad(&long_lists[0]);
    while (first <= LONG_FOURS) {
        let asked = atomicCompareExchangeWeak(&long_lists[0], first, min(first + fours, LONG_FOURS + 1u));
        if (asked.exchanged) { break; }
        first = asked.old_value;
    }
    atomicStore(&long_lists[1u + i], first);
    return first;
}

/// The place from there on; without room if too many asked.
fn long_place(first: u32, neighbours: u32) -> Place {
    let fits = first + (neighbours + 3u) / 4u <= LONG_FOURS;
    return Place(PLACES + first, 1u, select(0u, neighbours, fits));
}

var<private> place: Place;
var<private> found: u32;

/// Word of the list for neighbour k.
fn word(k: u32) -> u32 {
    return (place.first + (k >> 2u) * place.stride) * 4u + (k & 3u);
}

var<private> coincident: bool;
/// Whether any neighbour has another membership; where a lane is alone.
var<private> mixed: bool;
/// First cell of the half of the table that the particle is in.
var<private> own_half: u32;

/// A row of three cells along x: particles from `first` on, and then from `second` on where it goes on in another block.
struct Row {
    first: u32,
    count: u32,
    second: u32,
    second_count: u32,
}

/// Particle n of a row.
fn candidate(n: u32, row: Row) -> u32 {
    return select(row.second + n - row.count, row.first + n, n < row.count);
}

/// One of the nine rows around a cell. At a block's first or last cell it lies in two blocks.
fn row_at(cell: vec3<i32>, row: u32) -> Row {
    let y = cell.y + i32(row % 3u) - 1;
    let z = cell.z + i32(row / 3u) - 1;
    let last = (1 << BLOCK_BITS) - 1;
    let at = cell.x & last;
    let low = own_half + cell_index(vec3<i32>(cell.x - 1, y, z));
    let middle = own_half + cell_index(vec3<i32>(cell.x, y, z));
    let high = own_half + cell_index(vec3<i32>(cell.x + 1, y, z));
    let parted = at == 0 || at == last;
    let first = start_of(low);
    let end = start_of(low + select(3u, select(2u, 1u, at == 0), parted));
    let second = start_of(select(high, middle, at == 0));
    let second_end = select(second, start_of(high + 1u), parted);
    return Row(first, end - first, second, second_end - second);
}

/// Tests a row's particles in one loop: one for what lies in another block
/// would be walked on a software driver too, and half of the time for nothing. 32 are
/// tested and then the hits written, since what is written under a condition
/// costs such a driver the same whether it holds or not. The few pairs of mixed
/// membership are looked at afterwards.
fn search_alone(i: u32, x: vec3<f32>, membership: u32, row: Row) {
    for (var start = 0u; start < row.count + row.second_count; start += 32u) {
        let tested = min(row.count + row.second_count - start, 32u);
        var near = 0u;
        for (var n = 0u; n < tested; n++) {
            let j = candidate(start + n, row);
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
            let j = candidate(start + firstTrailingBit(near), row);
            near &= near - 1u;
            if (found < place.room) { list[word(found)] = j; }
            found++;
        }
    }
}

/// Whether particle j is a neighbour that glass does not hide.
fn is_neighbour(i: u32, x: vec3<f32>, membership: u32, j: u32, other: vec4<f32>) -> bool {
    let offset = x - other.xyz;
    let distance = dot(offset, offset);
    var near = distance < CELL * CELL && j != i;
    coincident = coincident || (near && distance < 1e-8 * SUPPORT * SUPPORT);
    let theirs = membership_in(other);
    if (near && theirs != membership) { near = visible(membership, x, theirs, other.xyz); }
    return near;
}

/// An invocation among those of its particle. Those of a workgroup are in its subgroups in their order, as everywhere that lanes
/// shuffle.
struct Lane {
    own: u32,
    /// Where in the subgroup the particle's first one is.
    first: u32,
}

/// Which of a particle's lanes say `yes`, a bit each.
fn lanes_with(lane: Lane, yes: bool) -> u32 {
    let of_subgroup = subgroupBallot(yes);
    return (of_subgroup[lane.first >> 5u] >> (lane.first & 31u)) & (0xffffffffu >> (32u - LIST_LANES));
}

/// Lists j of each lane that has a neighbour there, by ascending lane.
fn list_together(i: u32, lane: Lane, near: bool, j: u32) {
    let hits = lanes_with(lane, near);
    let k = found + countOneBits(hits & ((1u << lane.own) - 1u));
    if (near && k < place.room) { list[word(k)] = j; }
    found += countOneBits(hits);
}

/// All lanes of a particle walk a row together. Each fetches two candidates before it asks about either: the pass waits for its
/// fetches, not for its arithmetic. The loop is the subgroup's, as long as its longest row: Vulkan promises a ballot of all lanes only where
/// all come by.
fn search_together(i: u32, lane: Lane, x: vec3<f32>, membership: u32, row: Row) {
    let end = row.count + row.second_count;
    let longest = subgroupMax(end);
    for (var first = 0u; first < longest; first += 2u * LIST_LANES) {
        let n = first + lane.own;
        let after = n + LIST_LANES;
        // Beyond the row's end the particle itself, which is no neighbour.
        let j = select(i, candidate(n, row), n < end);
        let k = select(i, candidate(after, row), after < end);
        let other = sorted_trial[j];
        let next = sorted_trial[k];
        list_together(i, lane, is_neighbour(i, x, membership, j, other), j);
        list_together(i, lane, is_neighbour(i, x, membership, k, next), k);
    }
}

/// The nine rows around a particle, each looked up by one lane for all. One that is removed has empty rows: its lanes go along.
fn search_rows_together(i: u32, lane: Lane, x: vec3<f32>, membership: u32) {
    let cell = cell_of(x);
    for (var known = 0u; known < 9u; known += LIST_LANES) {
        let mine = row_at(cell, min(known + lane.own, 8u));
        let there = vec4<u32>(mine.first, mine.count, mine.second, mine.second_count);
        let words = select(there, vec4<u32>(0u), membership == REMOVED);
        for (var n = 0u; n < min(LIST_LANES, 9u - known); n++) {
            let row = subgroupShuffle(words, lane.first + n);
            search_together(i, lane, x, membership, Row(row.x, row.y, row.z, row.w));
        }
    }
}

/// Takes those of the first `listed` neighbours off the list that glass hides, and says how many are left.
fn drop_unseen(x: vec3<f32>, membership: u32, listed: u32) -> u32 {
    var kept = 0u;
    for (var k = 0u; k < listed; k++) {
        let j = list[word(k)];
        let other = sorted_trial[j];
        let theirs = membership_in(other);
        if (theirs == membership || visible(membership, x, theirs, other.xyz)) {
            list[word(kept)] = j;
            kept++;
        }
    }
    return kept;
}

/// A particle's list, by itself. Where there are more neighbours than places it is searched once more, into the long lists. That is a loop, because a
/// software driver would walk a second search for particles that need none.
fn list_alone(i: u32, x: vec3<f32>, membership: u32) {
    let cell = cell_of(x);
    for (var searches = membership != REMOVED; searches;) {
        found = 0u;
        for (var row = 0u; row < 9u; row++) { search_alone(i, x, membership, row_at(cell, row)); }
        let is_long = found > LIST_CAPACITY;
        if (FLASKS > 0u) {
            let listed = min(found, place.room);
            let kept = drop_unseen(x, membership, select(0u, listed, mixed));
            // A long list is told by its length, in which those behind glass remain.
            for (var k = kept; k < listed && mixed && is_long; k++) { list[word(k)] = i; }
            if (mixed && !is_long) { found = kept; }
        }
        searches = false;
        if (is_long && place.stride != 1u) {
            place = long_place(claim(i, found), found);
            searches = place.room > 0u;
        }
    }
}

/// The same by a particle's lanes. Those of others, whose lists are whole, go along where one searches once more.
fn list_by_lanes(i: u32, lane: Lane, x: vec3<f32>, membership: u32) {
    var searched = membership;
    for (var searches = true; searches;) {
        let before = found;
        found = 0u;
        search_rows_together(i, lane, x, searched);
        // Those that go along find nothing.
        found = max(found, before);
        let is_long = found > LIST_CAPACITY && place.stride != 1u;
        var first = 0u;
        if (is_long && lane.own == 0u) { first = claim(i, found); }
        first = subgroupShuffle(first, lane.first);
        if (is_long) { place = long_place(first, found); }
        let again = is_long && place.room > 0u;
        searched = select(REMOVED, membership, again);
        searches = any(subgroupBallot(again) != vec4<u32>(0u));
    }
    coincident = lanes_with(lane, coincident) != 0u;
}

/// A direction from a particle's identity: apart, but the same at each replay.
fn apart(identity: u32) -> vec3<f32> {
    var bits = identity * 747796405u + 2891336453u;
    bits = ((bits >> ((bits >> 28u) + 4u)) ^ bits) * 277803737u;
    let d = vec3<f32>(f32(bits & 1023u), f32((bits >> 10u) & 1023u), f32((bits >> 20u) & 1023u)) / 512.0 - 0.999;
    return d / length(d);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(subgroup_invocation_id) in_subgroup: u32) {
    let i = id.x / LIST_LANES;
    let own = id.x % LIST_LANES;
    if (i >= sorted_count()) { return; }
    let tag = sorted_tags[i];
    var x = sorted_trial[i].xyz;
    found = 0u;
    coincident = false;
    mixed = false;
    own_half = table_half_of(tag.x);
    place = place_of(i);
    if (LIST_LANES > 1u) {
        list_by_lanes(i, Lane(own, in_subgroup - own), x, tag.x);
        if (own != 0u) { return; }
    } else {
        list_alone(i, x, tag.x);
    }
    // Kernel gradients vanish at distance zero; particles in one place would
    // stay together for ever.
    if (coincident) { x += 1e-3 * SUPPORT * apart(tag.y); }
    if (found > LIST_CAPACITY) { atomicAdd(&counters.list_overflows, 1u); }
    // Of liquid that sleeps the list's own place is kept, and no longer one.
    list_counts[i] = select(found, min(found, LIST_CAPACITY), own_half > 0u);
    if (DORMANT_TURNOVER) { kept[i] = select(1.0, 0.0, found > LIST_CAPACITY); }
    // Sums take four at a time; the particle itself adds nothing to differences.
    for (var k = min(found, place.room); (k & 3u) != 0u; k++) { list[word(k)] = i; }
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
