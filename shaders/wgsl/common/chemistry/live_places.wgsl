// The list `live` of the places that have a bubble or drops (`sim/live.wgsl`): SLOTS entries, and behind them how many there are, by
// set of records.
//!include common/chemistry/slots.wgsl
//!include common/liquid/step.wgsl

/// Which set of records this step reads.
fn set_of_step() -> u32 {
    return select(0u, 1u, step.before_bubbles > 0u);
}

/// Where in `live` the number of this step's places is.
fn count_of_live() -> u32 {
    return SLOTS + set_of_step();
}

/// Places whose numbers differ from a place's in one of these bits may take the half of a bubble in it that divides.
const HALVES: u32 = 6u;
const NO_PARENT: u32 = 0xffffffffu;

/// Words of `live_args` of a set, and where in them are the sizes of the dispatches over bubbles and over drops, as `solver/bubbles.rs`
/// reads them.
const SET_ARGS: u32 = 8u;
const BUBBLE_ARGS: u32 = 0u;
const DROPS_ARGS: u32 = 3u;
