/// What changes from pass to pass of one substep.
struct Step {
    /// Δt_s, seconds.
    time: f32,
    /// Residual coefficient of this iteration, divided by the constraint gradient sum.
    residual: f32,
    /// Momentum coefficient of this iteration.
    momentum: f32,
    /// XSPH coefficient μ for one substep.
    viscosity: f32,
    /// Low-pass weight of the carried multiplier.
    carry: f32,
    /// Time for which surface tension acts at once, seconds.
    tension: f32,
    /// First pose of the substep's start.
    before: u32,
    /// First pose of the substep's end.
    after: u32,
    /// First pose of the next substep's end.
    next: u32,
    /// What the bubbles do before and after this substep: `BUBBLES_ACTED`, `BUBBLES_ACT`.
    bubbles: u32,
    /// Share of the way to its next volume that a particle's gas goes in this substep.
    approach: f32,
    /// Time of the next step of the bubbles, seconds, and first of their records before it.
    bubble_time: f32,
    before_bubbles: u32,
    /// Share of the way from a cavity's last place and size to its present ones at this substep's end.
    cavity: f32,
    /// k_v of Eq. 17.
    intensity: f32,
}

/// Bubbles acted after the substep before; they act after this one.
const BUBBLES_ACTED: u32 = 1u;
const BUBBLES_ACT: u32 = 2u;

var<immediate> step: Step;

/// 0, as no compiler knows: no scene has 2³¹ poses.
fn unknown_zero() -> u32 {
    return step.next >> 31u;
}
