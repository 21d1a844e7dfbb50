//! Whether liquid of a scene gives off steam, and how many places steam and dew have.

use super::glass;
use crate::chemistry::dew::{AROUND, UP};
use crate::chemistry::{Chemistry, Physical};
use crate::parameters::Parameters;

/// Puffs of steam at most; a new one replaces its vent's oldest.
pub const PUFFS: u32 = 1024;

/// Puffs that a frame may bring.
pub(super) const VENTS: u32 = 4;

/// Places of dew on a flask.
const DEW_PLACES: usize = AROUND * UP;

/// The chemistry, where steam leaves the liquid.
pub(super) fn with_steam(parameters: &Parameters) -> Option<&Physical> {
    match &parameters.chemistry {
        Some(Chemistry::Physical(p)) if p.bubbles.is_some() => Some(p),
        _ => None,
    }
}

/// Places of dew on all flasks: none where no steam leaves the liquid, or no heat goes to the glass.
pub(super) fn dew_places(parameters: &Parameters, flasks: usize) -> usize {
    let chemistry = parameters.chemistry.as_ref();
    match (with_steam(parameters), glass::losses(chemistry)) {
        (Some(_), Some(_)) => DEW_PLACES * flasks,
        _ => 0,
    }
}
