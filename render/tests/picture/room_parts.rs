//! Tiles that see one part of the room are drawn by a pipeline without the others: the picture is the same as by the pipeline of the whole
//! room.

use crate::rig::Rig;
use glam::{Affine3A, Vec3};
use vitriol_render::{BoxDesc, Fov, FrameDesc, Pane, PlateDesc, SceneDesc, View};

const EXTENT: [u32; 2] = [320, 240];

/// A pane behind all walls, which is never seen: each tile may see it, so none is drawn by a pipeline for a part.
fn pane_behind(view: &View) -> Pane {
    Pane {
        stage_from_pane: view.stage_from_eye
            * Affine3A::from_translation(Vec3::new(0.0, 0.0, -4e9)),
        size: [4e10; 2],
    }
}

/// Eyes all over the room, near and far, that look anywhere; the fields of a headset and of a long lens.
fn views() -> impl Iterator<Item = View> {
    // Steps of the plastic number's powers fill a space evenly.
    let places = (1..=80u32).map(|n| {
        [
            0.754_877_7,
            0.569_840_3,
            0.430_159_7,
            0.324_718,
            0.245_122_3,
            0.185_037_6,
        ]
        .map(|step: f32| (f32::from(n as u16) * step).fract())
    });
    places.map(|[x, y, z, u, v, w]| {
        let eye = Vec3::new(-1.5, 0.1, -0.9) + Vec3::new(3.8, 2.5, 3.2) * Vec3::new(x, y, z);
        let target = Vec3::new(-1.2, 0.2, -1.7) + Vec3::new(2.6, 2.0, 1.9) * Vec3::new(u, v, w);
        View::look_at(
            eye,
            target,
            Fov::symmetric(if v < 0.5 { 0.35 } else { 1.4 }, 4.0 / 3.0),
        )
    })
}

/// Eyes next to the planes of the shelf's and the hood's sides, which are soft far from where they end.
fn along_planes() -> impl Iterator<Item = View> {
    [-0.5, -0.42, 0.42, 0.5, 0.8, 0.88].into_iter().map(|x| {
        let eye = Vec3::new(x, 1.5, -0.2);
        let fov = Fov::symmetric(1.2, 4.0 / 3.0);
        View::look_at(eye, Vec3::new(x + 0.1, 2.0, -1.7), fov)
    })
}

/// Number of pixels whose colour (by more than one level, by which two programs may round) or depth differs.
fn differ(rig: &Rig, view: View, length_scale: f32) -> usize {
    let views = [view];
    let frame = FrameDesc {
        length_scale,
        ..FrameDesc::empty(&views)
    };
    let parts = rig.draw(&frame);
    let all = rig.draw(&FrameDesc {
        pane: Some(pane_behind(&view)),
        ..frame
    });
    let colours = parts.colour[0].chunks(4).zip(all.colour[0].chunks(4));
    let depths = parts.depth[0].iter().zip(&all.depth[0]);
    colours
        .zip(depths)
        .filter(|((a, b), (near, far))| {
            a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 1)
                || (*near - *far).abs() > 1e-6 * near.abs()
        })
        .count()
}

/// Compares the pictures of those views.
fn a_part_is_as_the_whole(compares: impl Fn(usize) -> bool) {
    let mut rig = Rig::new(EXTENT, 1);
    let whole = SceneDesc {
        plates: vec![PlateDesc {
            middle: [0.12, -0.4],
            radius: 0.07,
        }],
        ..SceneDesc::laboratory(Vec::new(), 0.75, 1.0)
    };
    let small = SceneDesc {
        table: Some(BoxDesc {
            min: Vec3::new(-0.3, 0.4, -0.6),
            max: Vec3::new(0.3, 0.44, -0.2),
        }),
        ..whole.clone()
    };
    let bare = SceneDesc {
        furnished: false,
        ..whole.clone()
    };
    let open = SceneDesc {
        room: None,
        ..whole.clone()
    };
    // Twenty times as large, as scenes are solved.
    let scaled = SceneDesc::laboratory(Vec::new(), 0.75, 0.05);
    for (name, scene, scale) in [
        ("whole", &whole, 1.0),
        ("small table", &small, 1.0),
        ("bare", &bare, 1.0),
        ("no room", &open, 1.0),
        ("scaled", &scaled, 0.05),
    ] {
        rig.set_scene(scene);
        let all = views().chain(along_planes()).enumerate();
        for (n, view) in all.filter(|(n, _)| compares(*n)) {
            assert_eq!(differ(&rig, view, scale), 0, "{name}, view {n}");
        }
    }
}

#[test]
fn a_part_of_the_room_is_drawn_as_the_whole_is() {
    a_part_is_as_the_whole(|view| view.is_multiple_of(5));
}

/// Each of the lists has tiles: what a pipeline paints black is seen black.
#[test]
fn each_part_is_drawn_by_its_pipeline() {
    let scene = SceneDesc::laboratory(Vec::new(), 0.75, 1.0);
    let view = View::look_at(
        Vec3::new(0.0, 1.2, 0.0),
        Vec3::new(0.1, 0.95, -0.9),
        Fov::symmetric(1.5, 4.0 / 3.0),
    );
    let painted = |sees: u32| {
        let black = format!("if (SEES == {sees}u) {{ colour = vec3<f32>(0.0); }}");
        let mut rig = Rig::edited(EXTENT, |name, text| match name {
            "render/picture.wgsl" => {
                let end = "return Seen(vec4<f32>(colour, alpha), reversed);";
                text.replace(end, &format!("{black}\n    {end}"))
            }
            _ => text,
        });
        rig.set_scene(&scene);
        let picture = rig.draw(&FrameDesc::empty(&[view]));
        let pixels = picture.colour[0].chunks(4);
        pixels.filter(|pixel| pixel[..3] == [0, 0, 0]).count()
    };
    // The bench, walls, the table, all.
    let found = [1, 2, 7, 15].map(painted);
    assert!(found.iter().all(|&count| count > 1000), "{found:?}");
    assert!(found.iter().sum::<usize>() <= 320 * 240, "{found:?}");
}

mod long {
    use super::*;

    /// The views that the quick test leaves out.
    #[test]
    fn a_part_of_the_room_is_drawn_as_the_whole_is_from_everywhere() {
        a_part_is_as_the_whole(|view| !view.is_multiple_of(5));
    }
}
