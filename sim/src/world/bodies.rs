//! The bodies after the last step: poses, the hands that hold them, blows and shards.

use super::World;
use crate::bodies::{Break, GRIP_REACH, Shard, Strike, Worn};
use crate::pose::Pose;
use glam::Vec3;

impl World {
    /// stage_from_flask of each flask, after the last step, in the scene's frame.
    pub fn poses(&self) -> &[Pose] {
        self.bodies.poses()
    }

    /// Distance (m) of a point in the scene's frame from a flask's outer surface, which is closed at the rim; negative within.
    /// `None` of a flask that no hand can grip.
    pub fn distance(&self, flask: usize, point: Vec3) -> Option<f32> {
        self.bodies.distance(flask, point)
    }

    /// Blows of the last step: of flasks on each other, on the table and on the floor.
    pub fn strikes(&self) -> &[Strike] {
        self.bodies.strikes()
    }

    /// Flasks that broke in the last step. Their poses are [`NOWHERE`](crate::bodies::NOWHERE) from then on.
    pub fn breaks(&self) -> &[Break] {
        self.bodies.breaks()
    }

    /// Whether a flask has broken.
    pub fn is_broken(&self, flask: usize) -> bool {
        self.bodies.is_broken(flask)
    }

    /// Shards of the flasks that have broken.
    pub fn shards(&self) -> Vec<Shard> {
        self.bodies.shards()
    }

    /// Whether a hand holds anything, a flask or a tool.
    pub fn holds(&self, hand: usize) -> bool {
        let bodies = 0..self.scene.flasks.len() + self.scene.tools.len();
        (bodies.into_iter()).any(|body| self.bodies.holder(body) == Some(hand))
    }

    /// Whether a hand that closes at a point in the scene's frame would take something.
    pub fn is_in_reach(&self, point: Vec3) -> bool {
        let reach = GRIP_REACH / self.scene.scale.length_scale as f32;
        let bodies = 0..self.scene.flasks.len() + self.scene.tools.len();
        let mut distances = bodies.filter_map(|body| self.bodies.distance(body, point));
        distances.any(|distance| distance <= reach)
    }

    /// Index of the hand that holds a flask.
    pub fn holder(&self, flask: usize) -> Option<usize> {
        self.bodies.holder(flask)
    }

    /// stage_from_tool of each of [`Scene::tools`](crate::scene::Scene), after the last step, in the scene's frame.
    pub fn tools(&self) -> &[Pose] {
        self.bodies.tools()
    }

    /// Index of the hand that holds a tool.
    pub fn tool_holder(&self, tool: usize) -> Option<usize> {
        self.bodies.tool_holder(tool)
    }

    /// Goggles and gloves that the user wears.
    pub fn worn(&self) -> Worn {
        self.bodies.worn()
    }

    /// Mean speed of the lower end of a tool in the last step, m/s.
    pub fn tool_speed(&self, tool: usize) -> f32 {
        let step = self.scene.scale.frame_time as f32;
        let now = self.tools().get(tool);
        let before = self.bodies.tools_before().nth(tool);
        match (now, before) {
            (Some(now), Some(before)) => now.position.distance(before.position) / step,
            _ => 0.0,
        }
    }
}
