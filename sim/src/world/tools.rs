//! Tools that touch the liquid, as the solver has them in a step.

use super::{World, WorldError};
use crate::bodies::Worn;
use crate::pose::Pose;
use crate::scene::ToolKind;
use crate::solver::Touch;
use glam::Vec3;
use vitriol_gpu::Recorder;

/// Fastest that a rod drags liquid along, m/s at real size: a hand that stirs has a tenth of it. Above lies a tracker's leap.
const FASTEST: f32 = 5.0;

impl World {
    /// stage_from_tool of each of [`Scene::tools`](crate::scene::Scene), after the last step, in the scene's frame.
    pub fn tools(&self) -> &[Pose] {
        self.bodies.tools()
    }

    /// Index of the hand that holds a tool.
    pub fn tool_holder(&self, tool: usize) -> Option<usize> {
        self.bodies.tool_holder(tool)
    }

    /// What the user wears.
    pub fn worn(&self) -> Worn {
        self.bodies.worn()
    }

    /// How the lower end of a tool moved in the last step, m/s.
    pub fn tool_speed(&self, tool: usize) -> f32 {
        let step = self.scene.scale.frame_time as f32;
        let now = self.tools().get(tool);
        let before = self.bodies.tools_before().nth(tool);
        match (now, before) {
            (Some(now), Some(before)) => now.position.distance(before.position) / step,
            _ => 0.0,
        }
    }

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
