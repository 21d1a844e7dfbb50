// Words of `sleep`: number of particles that are awake, number of those that rebuilds of this frame sort, and then one for each flask.
const SLEEP_AWAKE = 0u;
const SLEEP_SORTED = 1u;
const SLEEP_FLASKS = 2u;

/// The word of a flask whose liquid sleeps; and what it is more than while liquid settles, by the number of frames left (`solver/sleep.rs`).
const ASLEEP = 1u;
const SETTLES = 256u;
