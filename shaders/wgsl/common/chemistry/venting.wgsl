// Gas that bubbles let go from each flask, and how fast it goes. `sim/live.wgsl` takes up what the step before added.

/// What bubbles of a flask let go.
struct Venting {
    /// Since the step before took it up, in quanta.
    quanta: atomic<u32>,
    /// Mean of the last `VENTED_OVER`, m³/s.
    flow: f32,
}

/// m³.
const VENTED_QUANTUM: f32 = 1e-12;
/// Time over which the flow is a mean, s. Chosen: bubbles burst one by one, and a pool's steam comes in puffs that last longer.
const VENTED_OVER: f32 = 0.1;

@group(0) @binding(57) var<storage, read_write> venting: array<Venting>;

/// Adds a bubble's gas (m³) to what flask k lets go.
fn vent_gas(k: u32, volume: f32) {
    atomicAdd(&venting[k].quanta, u32(min(volume / VENTED_QUANTUM, 1e8)));
}

/// Takes up what the step before added for flask k; the next one lasts `time`.
fn take_up_vented(k: u32, time: f32) {
    let volume = f32(atomicExchange(&venting[k].quanta, 0u)) * VENTED_QUANTUM;
    let kept = exp(-time / VENTED_OVER);
    venting[k].flow = venting[k].flow * kept + volume / time * (1.0 - kept);
}
