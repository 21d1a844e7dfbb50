//! The heat of the flasks' glass, with line 26 of the physical chemistry.

use super::surroundings::Vessel;
use crate::chemistry::transport::Losses;
use crate::chemistry::wall_heat::{Ring, advance, rings};
use crate::parameters::Parameters;

/// Where a particle touches glass or air.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GlassTouch {
    /// Area of glass, m².
    pub glass: f64,
    /// Area of free surface, m².
    pub surface: f64,
    /// Flask and ring that the glass belongs to; `None` for what is solid and no flask of its own.
    pub ring: Option<(usize, usize)>,
}

/// The rings of all flasks.
#[derive(Clone, Debug, Default)]
pub struct ReferenceRings {
    rings: Vec<Vec<Ring>>,
    /// T of each flask's rings, °C.
    pub temperatures: Vec<Vec<f64>>,
    /// Heat that the liquid gave them in this frame, J.
    pub(super) taken: Vec<Vec<f64>>,
}

impl ReferenceRings {
    /// Glass of the temperature of the air, over the plates of `parameters`.
    pub(super) fn new(vessels: &[Vessel], losses: &Losses, parameters: &Parameters) -> Self {
        let heaters = parameters
            .heaters
            .iter()
            .copied()
            .chain(std::iter::repeat(0.0));
        let rings: Vec<_> = vessels
            .iter()
            .zip(heaters)
            .map(|(vessel, heater)| rings(&vessel.profile, losses, heater, parameters.frame_time))
            .collect();
        let each = |value: f64| rings.iter().map(|rings| vec![value; rings.len()]).collect();
        Self {
            temperatures: each(losses.ambient),
            taken: each(0.0),
            rings,
        }
    }

    /// Temperature, and heat transfer to liquid (W/(m² K)), of a ring.
    pub(super) fn ring(&self, (flask, ring): (usize, usize)) -> (f64, f64) {
        (
            self.temperatures[flask][ring],
            self.rings[flask][ring].to_liquid,
        )
    }

    /// The end of a frame: rings take the heat that the liquid gave, conduct it and lose it to air of `ambient` °C.
    pub(super) fn advance(&mut self, ambient: f64, frame_time: f64) {
        let flasks = self.rings.iter().zip(&mut self.temperatures);
        for ((rings, temperatures), taken) in flasks.zip(&mut self.taken) {
            advance(rings, temperatures, taken, ambient, frame_time);
            taken.fill(0.0);
        }
    }
}
