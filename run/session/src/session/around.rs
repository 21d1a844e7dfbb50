//! The bench for a headset that puts hands by a pointer, and the lines that it has drawn.

use glam::Vec3;
use vitriol_render::{Bone, Finish, MOST_BONES};
use vitriol_sim::scene::{Flask, Tool, ToolKind};
use vitriol_sim::world::World;
use vitriol_xr::{Around, Kind, Line, Pose, PoseFrame, Side, Thing};

use super::Session;
use crate::clock::MOST_STEPS;
use crate::panel;
use crate::placement::SCENE_TABLE;

impl Session {
    /// The bench as it is before the next frame.
    pub(super) fn bench_around(&self) -> Around {
        let world = &self.run.world;
        let pace = match self.instructor.holds_time() {
            true => 0.0,
            false => self.steps.clock.rate,
        };
        let longest = f64::from(MOST_STEPS) * world.scene().scale.frame_time;
        Around {
            scene: self.scenes,
            pace: pace as f32,
            longest: longest as f32,
            ..of(world, &self.placement.stage_from_scene())
        }
    }

    /// Hands of the last frame in the scene's stage, and its head, or the eye of a screen's picture: that goes round the bench while its
    /// user's head stays.
    pub(super) fn viewed(&self) -> Option<PoseFrame> {
        let seen = self.placement.seen()?;
        Some(PoseFrame {
            stage_from_view: self.eye.unwrap_or(seen.stage_from_view),
            ..seen
        })
    }
}

/// The bodies of `world` as they are now, where the scene is `placed` in the headset's stage.
fn of(world: &World, placed: &Pose) -> Around {
    let scene = world.scene();
    let scale = scene.scale.length_scale;
    let flasks = scene.flasks.iter().zip(world.poses()).enumerate();
    let flasks = flasks.map(|(index, (of, pose))| {
        let grips = !of.fixed && !world.is_broken(index);
        flask(of, scale, stage_from(placed, scale, pose), grips)
    });
    let worn = world.worn();
    let tools = scene.tools.iter().zip(world.tools());
    let tools = tools.map(|(of, pose)| {
        let grips = !(worn.goggles == Some(true) && of.kind == ToolKind::Goggles);
        tool(of, stage_from(placed, scale, pose), grips)
    });
    let count = scene.flasks.len();
    let held_by = |side: Side| {
        let hand = Some(side as usize);
        let tool = || (0..scene.tools.len()).find(|&tool| world.tool_holder(tool) == hand);
        let flask = (0..count).find(|&flask| world.holder(flask) == hand);
        flask.or_else(|| tool().map(|tool| count + tool))
    };
    let top = (scene.table).map_or(SCENE_TABLE, |table| (scale * table.top) as f32);
    Around {
        table: placed.transform_point(top * Vec3::Y).y,
        things: flasks.chain(tools).collect(),
        holds: Side::BOTH.map(held_by),
        gloves: worn.gloves.unwrap_or_default(),
        panel: (placed.compose(&panel::scene_from_panel()), panel::SIZE),
        ..Around::default()
    }
}

/// The pose of a body in the headset's stage, real metres; `pose` is in the scene's frame and unit.
fn stage_from(placed: &Pose, scale: f64, pose: &vitriol_sim::pose::Pose) -> Pose {
    placed.compose(&Pose::new(scale as f32 * pose.position, pose.orientation))
}

fn flask(flask: &Flask, scale: f64, pose: Pose, grips: bool) -> Thing {
    let profile = &flask.profile;
    let rim = profile.outer_outline().last().map_or(0.0, |last| last[0]);
    Thing {
        pose,
        radius: (scale * profile.outer_radius()) as f32,
        rim: (scale * rim) as f32,
        height: (scale * profile.rim_height()) as f32,
        kind: Kind::Flask,
        grips,
    }
}

fn tool(tool: &Tool, pose: Pose, grips: bool) -> Thing {
    let [radius, height] = tool.kind.cylinder().map(|m| m as f32);
    Thing {
        pose,
        radius,
        rim: radius,
        height,
        kind: match tool.kind {
            ToolKind::Rod | ToolKind::Thermometer => Kind::Rod,
            ToolKind::Cloth => Kind::Cloth,
            ToolKind::Goggles => Kind::Goggles,
            ToolKind::Gloves => Kind::Gloves,
            ToolKind::Sash => Kind::Sash,
        },
        grips,
    }
}

/// Adds lines of the headset's stage to what is drawn in the scene's, as many as there is room for: beside the hands' own bones, and then
/// beside those of the tools.
pub(super) fn draw(
    lines: &[Line],
    placed: &Pose,
    [left, right]: &mut [Vec<Bone>; 2],
    tools: &mut Vec<Bone>,
) {
    let scene_from_stage = placed.inverse();
    let bone = |line: &Line| {
        Bone::new(
            Finish::Ray,
            [line.from, line.to].map(|end| scene_from_stage.transform_point(end)),
            [line.radius; 2],
        )
    };
    let mut bones = lines.iter().map(bone);
    for group in [left, right, tools] {
        let room = MOST_BONES.saturating_sub(group.len());
        group.extend(bones.by_ref().take(room));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use glam::Quat;
    use vitriol_sim::scene::Scene;

    /// A scene at a twentieth: its flasks are as large in the room as its file's own sizes over 20, and are where they are drawn.
    #[test]
    fn bodies_are_in_real_metres() {
        let scene = Scene::builtin("single-dilution").unwrap();
        let scale = scene.scale.length_scale;
        let placed = Pose::new(Vec3::new(1.0, 0.2, -3.0), Quat::from_rotation_y(0.5));
        for of in &scene.flasks {
            let pose = stage_from(&placed, scale, &of.stage_from_flask);
            let thing = flask(of, scale, pose, true);
            let outline = of.profile.outer_outline();
            // Single precision of lengths below 10 m.
            let near = |a: f32, b: f64| (f64::from(a) - b).abs() < 1e-5;
            let [rim, top] = *outline.last().unwrap();
            assert!(near(thing.height, scale * top) && near(thing.rim, scale * rim));
            assert!(
                outline
                    .iter()
                    .all(|it| scale * it[0] < f64::from(thing.radius) + 1e-6)
            );
            let at = scale as f32 * of.stage_from_flask.position;
            let there = placed.orientation * at + placed.position;
            assert!((thing.pose.position - there).length() < 1e-5);
        }
    }

    /// What is dipped, slides or is worn has such a kind.
    #[test]
    fn tools_are_of_their_kind() {
        let things = ToolKind::ALL.map(|kind| {
            let of = Tool {
                kind,
                stage_from_tool: vitriol_sim::pose::Pose::IDENTITY,
                worn: false,
            };
            (kind, tool(&of, Pose::IDENTITY, true))
        });
        for (kind, thing) in things {
            assert_eq!(thing.kind == Kind::Rod, kind.is_dipped(), "{kind:?}");
            assert_eq!(thing.kind == Kind::Sash, kind == ToolKind::Sash);
            let worn = matches!(thing.kind, Kind::Goggles | Kind::Gloves);
            assert_eq!(worn, kind.is_worn(), "{kind:?}");
            assert!(!thing.is_flask(), "{kind:?}");
        }
    }

    /// Lines go where bones are free, and no group has more than is drawn.
    #[test]
    fn lines_fill_what_is_free() {
        let line = Line {
            from: Vec3::ZERO,
            to: Vec3::X,
            radius: 0.001,
        };
        let placed = Pose::new(Vec3::Y, Quat::IDENTITY);
        let (mut hands, mut tools) = ([Vec::new(), Vec::new()], Vec::new());
        draw(&[line; 40], &placed, &mut hands, &mut tools);
        assert_eq!(
            hands.each_ref().map(Vec::len),
            [MOST_BONES, 40 - MOST_BONES]
        );
        assert_eq!(hands[0][0].ends, [Vec3::NEG_Y, Vec3::X - Vec3::Y]);
        draw(&[line; 100], &placed, &mut hands, &mut tools);
        assert_eq!(hands.each_ref().map(Vec::len), [MOST_BONES; 2]);
        assert_eq!(tools.len(), MOST_BONES);
    }
}
