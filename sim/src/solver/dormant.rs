//! Passes that are dormant: as long as they would change nothing, the device dispatches no workgroup of them. It decides by what the passes
//! before have left, never by what the host has read back, so nothing can change unnoticed in between.

use super::bubbles::GROUP;
use super::transfer::read;
use super::{Solver, SolverError, lanes};
use crate::chemistry::bubbles::Bubbles;
use crate::parameters::Parameters;
use vitriol_shaders::layout::TurnoverPlan;

/// Words of a dispatch's size, padded.
pub(super) const SIZE_WORDS: u64 = 4;

/// Threads of a workgroup of `sim/census_bubbles.wgsl`.
const LOOK_GROUP: u32 = 256;

/// Words of a plan of turnovers.
pub(super) const PLAN_WORDS: u64 = size_of::<TurnoverPlan>() as u64 / 4;

/// Bits of a K that is faster than all others: of which nothing is known.
const UNKNOWN: u32 = u32::MAX;

/// Distances at which [`turnover_rate`] looks at a pair's exchange. Between two of them the greatest is 1e-5 more.
const DISTANCES: u32 = 1000;

/// Which passes are dormant.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub struct Dormant {
    /// `turnover`, throughout the last frame.
    pub turnover: bool,
    /// `live`, `bubbles`, `spray` and `cavity`, until a bubble is to be born.
    pub bubbles: bool,
    /// The look at bubbles and drops, until then: there were none since the last one.
    pub looks: bool,
}

/// Bound of a particle's turnover over time and diffusivity, 1/m²: of one that is much lighter than its neighbours, has as many as a list
/// has room for, and all of them where a pair exchanges most. One with a longer list exchanges nothing.
pub(super) fn turnover_rate(p: &Parameters) -> f64 {
    let capacity = p.list_capacity();
    let exchange = p.exchange(capacity);
    let distance = |n: u32| p.support_radius * f64::from(n) / f64::from(DISTANCES);
    let pairs = (1..DISTANCES).map(|n| exchange.coefficient(distance(n)));
    // The harmonic mean of two masses is twice the smaller one at most.
    2.0 * f64::from(capacity) * pairs.fold(0.0, f64::max)
}

/// Workgroups of the pass over turnovers.
pub(super) fn turnover_groups(count: u32, lanes: u32, group: u32) -> u32 {
    (count * lanes).div_ceil(group)
}

/// `claims` where no bubble is to be born, and whether there are some is not known. Behind the places are the sizes of the dispatches that
/// list places, and that look at them.
pub(super) fn unclaimed(bubbles: &Bubbles) -> Vec<u32> {
    let slots = bubbles.slots();
    let mut claims = vec![0; slots as usize];
    claims.extend([slots / GROUP, 1, 1, 0]);
    claims.extend([slots.div_ceil(LOOK_GROUP), 1, 1, 0]);
    claims
}

/// Where in `claims` the size of the look's dispatch over the places of bubbles is, bytes.
pub(super) fn look_size(bubbles: &Bubbles) -> u64 {
    4 * (u64::from(bubbles.slots()) + SIZE_WORDS)
}

impl Solver {
    /// `turnover_plan` where nothing is known of the frame before.
    pub(super) fn awake_turnover(&self) -> TurnoverPlan {
        let group = lanes::group(&self.gpu, self.lanes);
        TurnoverPlan {
            groups: [turnover_groups(self.count, self.lanes, group), 1, 1],
            fastest: UNKNOWN,
            ..TurnoverPlan::default()
        }
    }

    /// Which passes are dormant after the last frame; waits for the device.
    ///
    /// # Errors
    /// [`SolverError::Gpu`] where the device fails.
    pub fn dormant(&self) -> Result<Dormant, SolverError> {
        let slots = self.parameters.bubbles().map_or(0, Bubbles::slots) as usize;
        let plan = read::<TurnoverPlan>(&self.gpu, &self.buffers.turnover_plan, 1)?;
        let turnovers = plan.first().map_or(0, |plan| plan.groups[0]);
        let claims = read::<u32>(
            &self.gpu,
            &self.buffers.claims,
            slots + 2 * SIZE_WORDS as usize,
        )?;
        let sleeps = |at: usize| slots > 0 && claims.get(at) == Some(&0);
        Ok(Dormant {
            turnover: self.pipelines.turnover.is_some() && turnovers == 0,
            bubbles: sleeps(slots),
            looks: sleeps(slots + SIZE_WORDS as usize),
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::chemistry::transport::{Diffusivities, Potential, turnover};
    use crate::scene::Scene;

    #[test]
    fn no_neighbourhood_turns_over_more() {
        let p = Parameters::from_scene(&Scene::builtin("water-into-acid").unwrap());
        let capacity = p.list_capacity();
        let exchange = p.exchange(capacity);
        let of = |mass: f64| Potential {
            mass,
            acid: 0.0,
            temperature: 20.0,
            enthalpy: 0.0,
            capacity: 4000.0,
            variance: 0.0,
        };
        let eddies = Diffusivities::with(1e-5);
        let fastest = eddies.eddies + eddies.heat.max(eddies.acid);
        let bound = turnover_rate(&p) * p.substep_time() * fastest;
        let mut most = 0.0_f64;
        for n in 0..777 {
            let distance = p.support_radius * f64::from(n) / 777.0;
            for mass in [0.5, 1.0, 1e6] {
                let pair = turnover(&exchange, &eddies, distance, &of(1.0), &of(mass));
                most = most.max(f64::from(capacity) * pair);
            }
        }
        // `MOST_DORMANT` leaves a tenth.
        assert!(
            most < 1.0001 * bound && most > 0.99 * bound,
            "{most} {bound}"
        );
    }
}
