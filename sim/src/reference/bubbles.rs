//! Bubbles that rise from particle to particle and leave at the surface, with
//! line 26 of the physical chemistry.

use super::dilution::Pairs;
use crate::chemistry::physical::{Content, Steam};
use crate::chemistry::table::steam_enthalpy;
use crate::chemistry::transport::Potential;
use crate::kernel::Kernel;
use crate::parameters::Parameters;
use glam::DVec3;

/// Where fewer neighbours than this are above, over a full neighbourhood's,
/// vapour leaves.
const COVERED: f64 = 0.7;

/// What a particle's vapour does in a substep.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rise {
    /// What the particle gets of it, less what it gives and what leaves.
    pub gained: Steam,
    /// What leaves the liquid.
    pub gone: Steam,
}

/// What every particle's vapour does in a substep, in bubbles of the speed `speed` (m/s).
pub fn rise(
    parameters: &Parameters,
    speed: f64,
    pairs: &Pairs,
    contents: &[Content],
    of: &[Potential],
) -> Vec<Rise> {
    let kernel = Kernel::new(parameters.support_radius);
    let volume = parameters.particle_volume();
    // Share of a particle's vapour that rises out of it where there is liquid all around.
    let spacings = speed * parameters.substep_time() / parameters.spacing;
    let share = -(-spacings).exp_m1();
    // What of it goes to a neighbour `up` m above at `distance` m: by the kernel, over the
    // same for a full neighbourhood, of whose weight W(0) is the particle's own and a
    // quarter of the rest counts as above.
    let towards = |up: f64, distance: f64| {
        let full = 0.25 * (1.0 - volume * kernel.w(0.0));
        (up / distance).max(0.0) * volume * kernel.w(distance) / full
    };
    let rising = |i: usize| contents[i].mass * contents[i].vapour * share;
    let specific = |i: usize| steam_enthalpy(of[i].temperature);
    // Mass, and its enthalpy, that comes from below, and what covers i.
    let sums = pairs.sums(|i, j| {
        let distance = pairs.distance(i, j);
        let up = pairs.positions[j].y - pairs.positions[i].y;
        let come = rising(j) * towards(-up, distance);
        DVec3::new(come, come * specific(j), towards(up, distance))
    });
    let rise = |(i, sums): (usize, DVec3)| {
        let passed = rising(i) * sums.z;
        let gone = rising(i) * (1.0 - sums.z / COVERED).max(0.0);
        Rise {
            gained: Steam {
                mass: sums.x - passed - gone,
                enthalpy: sums.y - (passed + gone) * specific(i),
            },
            gone: Steam {
                mass: gone,
                enthalpy: gone * specific(i),
            },
        }
    };
    sums.into_iter().enumerate().map(rise).collect()
}
