//! The label at a desk's pointer: the name of what that is at, and what a press does there.

use glam::Vec3;
use vitriol_xr::{Around, Pointed, Pose, Thing, View};

use super::Session;
use crate::mirror::Label;
use crate::projection::bounds;

/// What of a hand is around its palm's middle, m: half a hand (0.19 m, median of adults: NASA-STD-3000).
const HAND: f32 = 0.095;

impl Session {
    /// Shows the label of what a pointer is at, as `eye` sees it, in a frame with these bodies.
    pub(super) fn show_label(&mut self, pointed: Option<Pointed>, around: &Around, eye: &View) {
        let label = pointed.and_then(|it| self.label(it, around, eye));
        if let Some(mirror) = &mut self.mirror {
            mirror.label(label);
        }
    }

    fn label(&self, pointed: Pointed, around: &Around, eye: &View) -> Option<Label> {
        let words = &self.texts.pointed;
        let (text, corners) = match pointed {
            Pointed::Thing(index) => (self.thing(index)?, body(around.things.get(index)?)),
            Pointed::Glove(side) => {
                let grip = self.placement.last.as_ref()?.hand(side).stage_from_grip;
                (words.glove.clone(), block(&grip, HAND, [-HAND, HAND]))
            }
            Pointed::Panel => {
                let (button, corners) = self.panel.aimed()?;
                let placed = self.placement.stage_from_scene();
                let corners = corners.map(|at| placed.transform_point(at));
                (words.button(&button.text, button.holds), corners.to_vec())
            }
        };
        let bounds = bounds(eye, corners)?;
        Some(Label { text, bounds })
    }

    /// The text for a flask, or for the tool behind the flasks; `None` where there is none of that index.
    fn thing(&self, index: usize) -> Option<String> {
        let (words, world) = (&self.texts.pointed, &self.run.world);
        let (scene, names) = (world.scene(), self.readings.names());
        let Some(name) = names.get(index) else {
            let tool = scene.tools.get(index.checked_sub(names.len())?)?;
            return Some(words.tool(tool.kind).to_owned());
        };
        // A user who is examined is told nothing that the lesson is judged by.
        let told = self.guide.tells(&self.run);
        let volume = self.readings.volume(index).filter(|_| told);
        let millilitres = 1e6 * scene.scale.length_scale.powi(3);
        let volume = volume.map(|volume| (millilitres * volume).round() as u32);
        Some(words.flask(name, volume))
    }
}

/// The corners of a block around a body.
fn body(thing: &Thing) -> Vec<Vec3> {
    block(&thing.pose, thing.radius, [0.0, thing.height])
}

/// The corners of a block around the y axis of a pose, as far to the sides and along that axis, m.
fn block(pose: &Pose, radius: f32, along: [f32; 2]) -> Vec<Vec3> {
    let sides = [-radius, radius];
    let corner = |y: f32| {
        sides
            .into_iter()
            .flat_map(move |x| sides.map(|z| pose.transform_point(Vec3::new(x, y, z))))
    };
    along.into_iter().flat_map(corner).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;
    use vitriol_xr::Kind;

    /// All of a beaker that lies is within its block, which is no larger than that in any direction.
    #[test]
    fn a_block_is_around_a_body() {
        let turned = Quat::from_rotation_z(1.2);
        let beaker = Thing {
            pose: Pose::new(Vec3::new(0.1, 0.8, -0.4), turned),
            radius: 0.035,
            rim: 0.03,
            height: 0.1,
            kind: Kind::Flask,
            grips: true,
        };
        let corners = body(&beaker);
        assert_eq!(corners.len(), 8);
        for way in [Vec3::X, Vec3::Y, Vec3::Z].map(|it| turned * it) {
            let along = corners.iter().map(|at| at.dot(way));
            let most = along.clone().fold(f32::NEG_INFINITY, f32::max);
            let extent = most - along.fold(f32::INFINITY, f32::min);
            let expected = if way == turned * Vec3::Y { 0.1 } else { 0.07 };
            // Rounding of single precision.
            assert!((extent - expected).abs() < 2e-6, "{way}: {extent}");
        }
        let middle = corners.iter().sum::<Vec3>() / 8.0;
        let expected = beaker.pose.transform_point(0.05 * Vec3::Y);
        assert!((middle - expected).length() < 2e-6, "{middle}");
    }
}
