// Whether `sim/turnover.wgsl` is dormant in a frame. As long as the eddies are slow, no particle can swap all that it has: then `kept`
// is 1, but 0 of particles whose list is full. After one frame in which the pass wrote that, it would write the same again; a list that is
// rebuilt meanwhile writes it (`sim/list.wgsl`).
//!include common/chemistry/molecules.wgsl

/// Whether the pass may be dormant; else it runs in each substep.
override DORMANT_TURNOVER: bool = false;
/// Bound of a particle's turnover over time and diffusivity, 1/m² (`turnover_rate` in `solver/dormant.rs`).
override TURNOVER_RATE: f32 = 0.0;
/// Workgroups of the pass.
override TURNOVER_GROUPS: u32 = 1u;

/// Turnover up to which it is dormant; from 1 on it has something to do. Chosen, with room for rounding.
const MOST_DORMANT: f32 = 0.9;

/// How a frame's turnovers are dispatched, and from what that follows.
struct TurnoverPlan {
    /// Size of the pass's dispatch.
    groups: vec3<u32>,
    /// Greatest K since the last plan, bits of an f32. A number that is negative or none has greater bits than all others.
    fastest: atomic<u32>,
    /// 1 where all eddies of the frame before were slow, so that `kept` holds what it has to.
    was_slow: u32,
}

@group(0) @binding(58) var<storage, read_write> turnover_plan: TurnoverPlan;

/// Notes a particle's eddies for the next frame's plan.
fn note_eddies(diffusivity: f32) {
    let bits = bitcast<u32>(diffusivity);
    // Most are slower than one that is noted already: if each took part in the maximum, all would wait for one word.
    if (bits > atomicLoad(&turnover_plan.fastest)) { atomicMax(&turnover_plan.fastest, bits); }
}

/// Plans a frame with substeps of `time` seconds; for one invocation.
fn plan_turnover(time: f32) {
    let slow = MOST_DORMANT / (TURNOVER_RATE * time) - max(ACID_DIFFUSIVITY, THERMAL_DIFFUSIVITY);
    let fastest = atomicExchange(&turnover_plan.fastest, 0u);
    let is_slow = fastest <= bitcast<u32>(max(slow, 0.0));
    turnover_plan.groups.x = select(TURNOVER_GROUPS, 0u, is_slow && turnover_plan.was_slow > 0u);
    turnover_plan.was_slow = select(0u, 1u, is_slow);
}
