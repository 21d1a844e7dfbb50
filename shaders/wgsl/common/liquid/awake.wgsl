// Which particles sleep (`sim/sleep.wgsl`). They lie behind all others in each array, so a pass over particles ends before them, and the places and
// lists that they have stay valid.
//!include common/liquid/particle.wgsl

/// Whether liquid that sleeps is left out.
override SLEEP: bool = false;

/// Number of particles that are awake; number of those that rebuilds of this frame sort; then, by flask, whether its liquid sleeps.
@group(0) @binding(59) var<storage, read> sleep: array<u32>;

const SLEEP_AWAKE = 0u;
const SLEEP_SORTED = 1u;
const SLEEP_FLASKS = 2u;

/// Number of particles that a pass moves: the first ones.
fn awake_count() -> u32 {
    if (SLEEP) { return sleep[SLEEP_AWAKE]; }
    return COUNT;
}

/// Whether particles of a membership sleep.
fn sleeps(membership: u32) -> bool {
    if (SLEEP) {
        if (membership == NOBODYS) { return false; }
        // Taken out, a particle needs no pass.
        if (membership == REMOVED) { return true; }
        return sleep[SLEEP_FLASKS + membership - 1u] != 0u;
    }
    return false;
}

/// Number of particles that a rebuild of the list sorts: all of them where a flask fell asleep or woke up. The same throughout a frame, also where
/// fewer are awake after a rebuild: else its later passes would leave out the last ones.
fn sorted_count() -> u32 {
    if (SLEEP) { return sleep[SLEEP_SORTED]; }
    return COUNT;
}
