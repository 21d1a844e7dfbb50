//! Whether liquid of a scene gives off steam, and how many places steam and dew have.

use super::wall_heat;
use crate::chemistry::dew::{self, AROUND, UP};
use crate::chemistry::{Chemistry, Physical};
use crate::flask::Profile;
use crate::parameters::Parameters;
use vitriol_shaders::layout::DewRow;

/// Puffs of steam at most; a new one replaces its vent's oldest.
pub const PUFFS: u32 = 1024;

/// Puffs that a frame may bring.
pub(super) const VENTS: u32 = 4;

/// Words of `made`: puffs of each workgroup that makes them, and quanta of water that were washed off glass, as low and high word.
pub(super) const COUNTS: usize = VENTS as usize + 2;

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
    match (with_steam(parameters), wall_heat::losses(chemistry)) {
        (Some(_), Some(_)) => DEW_PLACES * flasks,
        _ => 0,
    }
}

/// Rows of the flasks' inner walls, as `sim/dew.wgsl` reads them.
pub(super) fn dew_rows(flasks: &[Profile]) -> Vec<DewRow> {
    let rows = flasks.iter().flat_map(dew::rows);
    let row = |row: dew::WallRow| DewRow {
        height: row.height as f32,
        radius: row.radius as f32,
        area: row.area as f32,
        capacity: row.capacity as f32,
    };
    rows.map(row).collect()
}
