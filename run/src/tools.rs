//! What lies on the bench beside the glass, as it is drawn: of bones, as hands are.

use glam::{Affine3A, Mat3A, Vec3};
use vitriol_render::{Bone, Finish, Pane, Scale};
use vitriol_sim::scene::{PANE, ToolKind};
use vitriol_sim::world::World;
use vitriol_xr::Pose;

/// The lowest and highest mark of a thermometer's scale, just over its bulb and under its top, °C.
const SHOWN: [f32; 2] = [-10.0, 150.0];
/// Height of a thermometer's bulb, and by how much it is thicker than the stem, m.
const BULB: f32 = 0.012;
const BULB_OVER: f32 = 0.0015;
/// How far the scale keeps away from bulb and top, m.
const SCALE_INSIDE: f32 = 0.006;

/// One tool's parts in its own frame, real metres; `celsius` is what a thermometer shows.
fn parts(kind: ToolKind, celsius: f64) -> Vec<Bone> {
    let [radius, height] = kind.cylinder().map(|m| m as f32);
    let part = |finish: Finish, ends: [Vec3; 2], radius: f32| Bone::new(finish, ends, [radius; 2]);
    // Between two heights of the axis, round ends included.
    let stem = |finish, from: f32, to: f32, radius: f32| {
        part(
            finish,
            [from + radius, to - radius].map(|y| y * Vec3::Y),
            radius,
        )
    };
    match kind {
        ToolKind::Rod => vec![stem(Finish::Rod, 0.0, height, radius)],
        ToolKind::Thermometer => {
            let scale = Scale {
                celsius: SHOWN,
                // From the middle of the stem's lower end.
                heights: [BULB + SCALE_INSIDE, height - SCALE_INSIDE].map(|y| y - radius),
                reading: celsius as f32,
            };
            vec![
                stem(Finish::Column, 0.0, BULB, radius + BULB_OVER),
                stem(Finish::Scale(scale), 0.0, height, radius),
            ]
        }
        ToolKind::Cloth => {
            let thick = 0.5 * height;
            let fold = |n: i32| {
                let z = thick * n as f32;
                let half = (radius * radius - z * z).sqrt() - thick;
                let end = |x: f32| Vec3::new(x, thick, z);
                part(Finish::Cloth, [end(-half), end(half)], thick)
            };
            (-6..=6).step_by(2).map(fold).collect()
        }
        ToolKind::Gloves => {
            let side = 0.5 * height;
            let end = |x: f32, z: f32| Vec3::new(x, side, z);
            let across = |z: f32| {
                let half = radius - side;
                part(Finish::Card, [end(-half, z), end(half, z)], side)
            };
            let tuft = [
                Vec3::new(-0.02, height, 0.0),
                Vec3::new(0.02, height + 0.01, 0.005),
            ];
            vec![
                across(-0.3 * side),
                across(0.3 * side),
                part(Finish::Glove, tuft, 0.012),
            ]
        }
        ToolKind::Goggles => goggles(),
        ToolKind::Sash => {
            let [tall, thick] = PANE.map(|m| m as f32);
            // Lying, its axis goes to the left, and its +x is up.
            let rail = |from: [f32; 2], to: [f32; 2]| {
                let end = |[along, up]: [f32; 2]| Vec3::new(up, along, 0.0);
                part(Finish::Steel, [end(from), end(to)], thick)
            };
            let (low, high) = (thick, height - thick);
            vec![
                stem(Finish::Steel, 0.0, height, radius),
                rail([low, 0.0], [low, tall]),
                rail([high, 0.0], [high, tall]),
                rail([low, tall], [high, tall]),
            ]
        }
    }
}

/// Two rings about the lenses, and the bridge between them; lenses up.
fn goggles() -> Vec<Bone> {
    const SIDES: usize = 6;
    /// Half axes of a lens, where its middle is to the side, and how thick its frame is, m. Our choice: 14 cm in all.
    const LENS: [f32; 2] = [0.032, 0.024];
    const ASIDE: f32 = 0.036;
    const THICK: f32 = 0.006;
    let ring = |side: f32| {
        let at = move |n: usize| {
            let angle = std::f32::consts::TAU * n as f32 / SIDES as f32;
            let [x, z] = [LENS[0] * angle.cos(), LENS[1] * angle.sin()];
            Vec3::new(side * ASIDE + x, 0.03, z)
        };
        (0..SIDES).map(move |n| [at(n), at(n + 1)])
    };
    let foot = |x: f32, z: f32| [Vec3::new(x, 0.03, z), Vec3::new(x, THICK, z)];
    let feet = [-1.0, 1.0].map(|side| foot(side * (ASIDE + LENS[0]), 0.0));
    (ring(-1.0).chain(ring(1.0)).chain(feet))
        .map(|ends| Bone::new(Finish::Frame, ends, [THICK; 2]))
        .collect()
}

/// The tools of `world` in the scene's stage, real metres: none that is worn, since it is before the eyes. `celsius` is what the thermometer
/// shows.
pub fn tools(world: &World, celsius: f64) -> Vec<Bone> {
    let scene = world.scene();
    let scale = scene.scale.length_scale as f32;
    let mut bones = Vec::new();
    for (tool, pose) in scene.tools.iter().zip(world.tools()) {
        if tool.kind == ToolKind::Goggles && world.worn().goggles == Some(true) {
            continue;
        }
        let stage_from_tool = Pose::new(scale * pose.position, pose.orientation);
        let mut parts = parts(tool.kind, celsius);
        for end in parts.iter_mut().flat_map(|bone| &mut bone.ends) {
            *end = stage_from_tool.transform_point(*end);
        }
        bones.extend(parts);
    }
    bones
}

/// The pane of the fume hood's sash in the scene's stage, real metres.
pub fn pane(world: &World) -> Option<Pane> {
    let scale = world.scene().scale.length_scale as f32;
    let pane = world.sash()?;
    let [along, up] = pane.sides.map(|side| scale * side);
    let [width, height] = [along.length(), up.length()];
    let axes = Mat3A::from_cols(
        (along / width).into(),
        (up / height).into(),
        (along.cross(up) / (width * height)).into(),
    );
    let middle = scale * pane.corner + 0.5 * (along + up);
    Some(Pane {
        stage_from_pane: Affine3A::from_mat3_translation(axes.into(), middle),
        size: [width, height],
    })
}

#[cfg(test)]
#[allow(clippy::panic)]
mod tests {
    use super::*;
    use vitriol_render::MOST_BONES;

    #[test]
    fn all_tools_together_are_drawn() {
        let all = ToolKind::ALL.map(|kind| parts(kind, 20.0).len());
        assert!(all.iter().sum::<usize>() <= MOST_BONES, "{all:?}");
        for kind in ToolKind::ALL {
            let [radius, height] = kind.cylinder().map(|m| m as f32);
            for bone in parts(kind, 80.0) {
                for (end, thick) in bone.ends.iter().zip(bone.radii) {
                    let aside = end.x.hypot(end.z) + thick;
                    let pane = if kind == ToolKind::Sash {
                        PANE[0] as f32
                    } else {
                        0.0
                    };
                    assert!(aside <= radius + pane + 0.006, "{kind:?}: {aside} m");
                    let over = [end.y - thick, height + 0.025 - end.y - thick];
                    assert!(over.iter().all(|it| *it >= -1e-6), "{kind:?}: {over:?}");
                }
            }
        }
    }

    /// The scale is on the stem, over the bulb and under the top, and shows the temperature that it is given; a degree is longer than a
    /// millimetre, so that it can be read.
    #[test]
    fn a_thermometer_has_a_scale() {
        let [bulb, stem] = parts(ToolKind::Thermometer, 37.5)[..] else {
            panic!("a bulb and a stem")
        };
        let Finish::Scale(scale) = stem.finish else {
            panic!("{:?}", stem.finish)
        };
        assert_eq!(scale.reading, 37.5);
        assert_eq!((stem.ends[0] - stem.ends[1]).with_y(0.0), Vec3::ZERO);
        let [low, high] = scale.heights.map(|height| stem.ends[0].y + height);
        assert!(low > bulb.ends[1].y + bulb.radii[1]);
        assert!(high < stem.ends[1].y + stem.radii[1]);
        let [cold, hot] = scale.celsius;
        // Ice and boiling acid of the lessons are on it.
        assert!(cold <= 0.0 && hot >= 140.0);
        assert!((high - low) / (hot - cold) > 1e-3);
    }
}
