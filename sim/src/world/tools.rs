//! Tools that touch the liquid, as the solver has them in a step.

use super::{World, WorldError};
use crate::scene::ToolKind;
use crate::solver::Touch;
use glam::Vec3;
use vitriol_gpu::Recorder;

/// Fastest that a rod drags liquid along, m/s at real size: a hand that stirs has a tenth of it. Above lies a tracker's leap.
const FASTEST: f32 = 5.0;

impl World {
    /// Records what tools do to the liquid in the step that the bodies have taken. A rod that nobody holds lies still.
    pub(super) fn handle(&self, rec: &mut Recorder) -> Result<(), WorldError> {
        let scale = self.scene.scale;
        let step = scale.frame_time as f32;
        let fastest = FASTEST / scale.length_scale as f32;
        let moved = self.bodies.tools().iter().zip(self.bodies.tools_before());
        for (index, (tool, (now, before))) in self.scene.tools.iter().zip(moved).enumerate() {
            let wipes = tool.kind == ToolKind::Cloth;
            let drags = tool.kind.is_dipped() && self.bodies.tool_holder(index).is_some();
            if !wipes && !drags {
                continue;
            }
            let [radius, height] = tool.kind.cylinder();
            let [radius, height] = [radius, height].map(|m| (m / scale.length_scale) as f32);
            let ends = [Vec3::ZERO, height * Vec3::Y];
            let velocity = |end: Vec3| {
                let way = now.transform_point(end) - before.transform_point(end);
                (way / step).clamp_length_max(fastest)
            };
            let touch = Touch {
                ends: ends.map(|end| now.transform_point(end)),
                velocities: ends.map(velocity),
                radius,
                wipes,
            };
            self.solver.handle(rec, &touch, scale.frame_time)?;
        }
        Ok(())
    }
}
