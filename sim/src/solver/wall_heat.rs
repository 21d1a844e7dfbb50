//! The heat of the flasks' glass in the shaders' layout.

use super::spec::SolverSpec;
use crate::chemistry::Chemistry;
use crate::chemistry::transport::Losses;
use crate::chemistry::wall_heat::{RINGS, rings};
use vitriol_shaders::layout::GlassRing;

/// The heat losses to glass and air, where the scene models them.
pub(super) fn losses(chemistry: Option<&Chemistry>) -> Option<&Losses> {
    match chemistry {
        Some(Chemistry::Physical(physical)) => physical.losses.as_ref(),
        _ => None,
    }
}

/// Rings of all flasks; 0 where heat is not lost.
pub(super) fn ring_count(chemistry: Option<&Chemistry>, flasks: usize) -> usize {
    losses(chemistry).map_or(0, |_| RINGS * flasks)
}

/// The constants of all rings, flask by flask.
pub(super) fn constants(spec: &SolverSpec<'_>) -> Vec<GlassRing> {
    let p = &spec.parameters;
    let Some(losses) = losses(p.chemistry.as_ref()) else {
        return Vec::new();
    };
    let heaters = p.heaters.iter().copied().chain(std::iter::repeat(0.0));
    let all = spec.flasks.iter().zip(heaters);
    all.flat_map(|(profile, heater)| rings(profile, losses, heater, p.frame_time))
        .map(|ring| GlassRing {
            capacity: ring.capacity as f32,
            to_air: ring.to_air as f32,
            upwards: ring.upwards as f32,
            heated: ring.heated as f32,
            to_liquid: (ring.to_liquid / p.rest_density) as f32,
            quantum: ring.quantum as f32,
            quantum_per_mass: (ring.quantum / p.particle_mass()) as f32,
        })
        .collect()
}
