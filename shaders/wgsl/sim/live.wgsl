// Lists the places in which there is a bubble, drops, or what comes to one, so that the passes over bubbles and drops are as large as
// what there is: of 16,384 places few have anything. Dormant itself while there is nothing to be listed (`LIVE_GROUPS`): the list stays
// empty, and the flow of gas 0. The list's order is that in which threads come; no place depends on another's.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/drops.wgsl
//!include common/chemistry/live_places.wgsl
//!include common/chemistry/dividing.wgsl
//!include common/chemistry/venting.wgsl
//!include common/glass/vessel.wgsl
//!include common/liquid/lane_sums.wgsl

/// Those before the step, and after it.
@group(0) @binding(0) var<storage, read> bubbles: array<Bubble>;
@group(0) @binding(1) var<storage, read> claims: array<u32>;
@group(0) @binding(2) var<storage, read> merging: array<i32>;
@group(0) @binding(3) var<storage, read> drops: array<Drops>;
@group(0) @binding(4) var<storage, read_write> live: array<atomic<u32>>;
/// By set of records and slot: one more than the place that takes the half of a bubble which divides.
@group(0) @binding(6) var<storage, read_write> splits: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> live_args: array<atomic<u32>>;

/// Whether a place has something. A place is written over once more after its bubble is gone, so that both records say the same of
/// what left from it; a bubble may also come to a place by joining and burst in one step, which leaves both records empty.
fn has_something(slot: u32) -> bool {
    if (is_there(bubbles[slot]) || is_there(bubbles[SLOTS + slot]) || claims[slot] > 0u) { return true; }
    // A cavity that is gone shrinks for one step more, after which neither record may have it.
    if (bubbles[slot].radius_before > 0.0 || bubbles[SLOTS + slot].radius_before > 0.0) { return true; }
    if (any(bubbles[slot].gone != bubbles[SLOTS + slot].gone) || bubbles[slot].air_gone != bubbles[SLOTS + slot].air_gone) {
        return true;
    }
    if (SPRAY) {
        if (drops[2u * slot].mass > 0.0 || drops[2u * slot + 1u].mass > 0.0) { return true; }
    }
    if (parent_of(slot, step.before_bubbles) != NO_PARENT) { return true; }
    let joins = 3u * (step.before_bubbles + slot);
    return merging[joins] != 0 || merging[joins + 1u] != 0 || merging[joins + 2u] != 0;
}

/// Whether a place may take the half of a bubble.
fn is_free(slot: u32) -> bool {
    let joins = 3u * (step.before_bubbles + slot);
    let joined = merging[joins] != 0 || merging[joins + 1u] != 0 || merging[joins + 2u] != 0;
    return !is_there(bubbles[step.before_bubbles + slot]) && claims[slot] == 0u && !joined;
}

/// The other set's list begins anew: its step is over.
fn clear_other() {
    let other = 1u - set_of_step();
    atomicStore(&live[SLOTS + other], 0u);
    atomicStore(&live_args[SET_ARGS * other + BUBBLE_ARGS], 0u);
    atomicStore(&live_args[SET_ARGS * other + DROPS_ARGS], 0u);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let slot = id.x;
    if (slot == 0u) { clear_other(); }
    if (slot < FLASKS) { take_up_vented(slot, step.bubble_time); }
    if (slot >= SLOTS || !has_something(slot)) { return; }
    if (is_free(slot)) {
        let parent = parent_of(slot, step.before_bubbles);
        if (parent != NO_PARENT) { atomicMax(&splits[step.before_bubbles + parent], slot + 1u); }
    }
    let n = atomicAdd(&live[count_of_live()], 1u);
    atomicStore(&live[n], slot);
    let first = SET_ARGS * set_of_step();
    atomicMax(&live_args[first + BUBBLE_ARGS], n * LANES / 64u + 1u);
    atomicMax(&live_args[first + DROPS_ARGS], 2u * n / 64u + 1u);
}
