//! Tools that touch the liquid, as the solver has them in a step.

use super::{World, WorldError};
use crate::pose::Pose;
use crate::scene::{PANE, Tool, ToolKind};
use crate::solver::{Pane, Touch};
use glam::Vec3;
use vitriol_gpu::Recorder;

/// Fastest that a rod drags liquid along, m/s at real size: a hand that stirs has a tenth of it. Above lies a tracker's leap.
const FASTEST: f32 = 5.0;

impl World {
    /// Records the action of tools on the liquid in the step that the bodies have taken. A rod that no hand holds lies still.
    pub(super) fn handle(&self, rec: &mut Recorder) -> Result<(), WorldError> {
        let scale = self.scene.scale;
        let step = scale.frame_time as f32;
        let fastest = FASTEST / scale.length_scale as f32;
        let moved = self.bodies.tools().iter().zip(self.bodies.tools_before());
        for (index, (tool, (now, before))) in self.scene.tools.iter().zip(moved).enumerate() {
            if tool.kind == ToolKind::Sash {
                self.solver
                    .stop_at(rec, &self.pane(now), scale.frame_time)?;
                continue;
            }
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

    /// The pane of a sash whose bar has the pose `bar` (stage_from_bar).
    fn pane(&self, bar: &Pose) -> Pane {
        let in_scene = |m: f64| (m / self.scene.scale.length_scale) as f32;
        let [_, width] = ToolKind::Sash.cylinder();
        let [height, thickness] = PANE.map(in_scene);
        let along = in_scene(width) * (bar.orientation * Vec3::Y);
        Pane {
            corner: bar.position,
            sides: [along, height * Vec3::Y],
            thickness,
        }
    }

    /// The pane of the fume hood's sash, where there is one.
    pub fn sash(&self) -> Option<Pane> {
        let sash = |tool: &Tool| tool.kind == ToolKind::Sash;
        let index = self.scene.tools.iter().position(sash)?;
        Some(self.pane(self.bodies.tools().get(index)?))
    }

    /// How far the fume hood's sash is open: from the table to its bar, m at real size.
    pub fn sash_open(&self) -> Option<f64> {
        let (pane, table) = (self.sash()?, self.scene.table?);
        let [radius, _] = ToolKind::Sash.cylinder();
        let over = f64::from(pane.corner.y) - table.top;
        Some(self.scene.scale.length_scale * over - radius)
    }
}
