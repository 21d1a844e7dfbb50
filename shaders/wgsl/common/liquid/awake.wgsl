// Which particles sleep (`sim/sleep.wgsl`). They lie behind all others in each array, so a pass over particles ends before them, and the places and
// lists that they have stay valid.
//!include common/liquid/particle.wgsl
//!include common/liquid/sleep_words.wgsl

/// Whether liquid that sleeps is left out.
override SLEEP: bool = false;

/// Number of particles that are awake; number of those that rebuilds of this frame sort; then, by flask, whether its liquid sleeps or settles.
@group(0) @binding(59) var<storage, read> sleep: array<u32>;

/// Frames for which liquid in a flask settles from the lattice that it was filled in: each begins with it at rest.
fn frames_to_settle(membership: u32) -> u32 {
    if (SLEEP) {
        if (membership > NOBODYS && membership != REMOVED) { return max(sleep[SLEEP_FLASKS + membership - 1u], SETTLES) - SETTLES; }
    }
    return 0u;
}

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
        return sleep[SLEEP_FLASKS + membership - 1u] == ASLEEP;
    }
    return false;
}

/// Number of particles that a rebuild of the list sorts: all of them where a flask fell asleep or woke up. The same throughout a frame, also where
/// fewer are awake after a rebuild: else its later passes would leave out the last ones.
fn sorted_count() -> u32 {
    if (SLEEP) { return sleep[SLEEP_SORTED]; }
    return COUNT;
}
