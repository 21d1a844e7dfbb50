//! Events that the device counted since the start.

use bytemuck::{Pod, Zeroable};
use serde::Serialize;

/// What happened, summed over all substeps and particles so far. A limiter
/// that acted is counted, never hidden.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq, Pod, Serialize, Zeroable)]
pub struct Counters {
    /// Times the neighbour list was rebuilt.
    pub list_rebuilds: u32,
    /// Times a particle had more neighbours than its list holds.
    pub list_overflows: u32,
    /// Corrections cut short so that a particle stays where its list is complete.
    pub list_limited: u32,
    /// Speeds cut to v_max (line 24).
    pub speed_limited: u32,
    /// Flask constraints generated (line 23).
    pub flask_constraints: u32,
    /// Particles taken out because they turned non-finite.
    pub nan_particles: u32,
    /// Particles and substeps in which diffusion exchanged less than D and Δt ask for.
    pub diffusion_limited: u32,
}
