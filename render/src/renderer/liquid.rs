//! Selects the liquid and drops of a frame that are drawn.

use super::Renderer;
use crate::RenderError;
use crate::fluid::Fluid;
use crate::frame::FrameDesc;
use crate::source::LiquidSource;
use crate::spray::Flights;

impl Renderer {
    /// The flights of drops in that slot, if the frame has any.
    pub(super) fn flights(
        &self,
        frame: &FrameDesc<'_>,
        slot: usize,
    ) -> Result<Option<Flights<'_>>, RenderError> {
        // Coloured particles are drawn in place of drops.
        if frame.particles.is_some() {
            return Ok(None);
        }
        let Some((fluid, source)) = self.liquid(frame)? else {
            return Ok(None);
        };
        let bubbles = source.bubbles;
        let bubbles = bubbles.filter(|bubbles| bubbles.spray.is_some() && bubbles.count > 0);
        let cells = fluid.bubbles(slot);
        Ok(bubbles.map(|bubbles| Flights {
            buffer: &cells.flights,
            flying: &cells.flying,
            places: 2 * bubbles.count as usize,
        }))
    }

    /// The liquid surface and its source, if the frame has a liquid.
    pub(super) fn liquid<'a>(
        &self,
        frame: &FrameDesc<'a>,
    ) -> Result<Option<(&Fluid, LiquidSource<'a>)>, RenderError> {
        let Some(source) = frame.liquid else {
            return Ok(None);
        };
        let Some(fluid) = &self.fluid else {
            return Err(RenderError::NoLiquid);
        };
        fluid.check(&source)?;
        Ok(Some((fluid, source)))
    }
}
