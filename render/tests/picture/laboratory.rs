//! The laboratory about the bench against geometry and light in f64: where sink, tray and a sign are seen, where a number stands, and how
//! bright rooms are.

use crate::rig::{Picture, Rig, cylinder, displayed, linear};
use glam::{Affine3A, Vec3};
use vitriol_render::{Fov, FrameDesc, Label, PlateDesc, RoomLight, SceneDesc, VesselDesc, View};

const EXTENT: [u32; 2] = [640, 480];

/// The bench of `SceneDesc::laboratory`.
const TABLE: [[f32; 2]; 2] = [[-0.8, -0.78], [0.8, -0.12]];
const TOP: f32 = 0.75;

fn look(eye: Vec3, target: Vec3, half: f32) -> View {
    View::look_at(eye, target, Fov::symmetric(half, 4.0 / 3.0))
}

/// Where a place is seen, pixels.
fn seen(view: &View, at: Vec3) -> [f32; 2] {
    let clip = view.clip_from_scaled(1.0).project_point3(at);
    [
        (0.5 + 0.5 * clip.x) * EXTENT[0] as f32,
        (0.5 + 0.5 * clip.y) * EXTENT[1] as f32,
    ]
}

fn rgb(picture: &Picture, x: usize, y: usize) -> [f64; 3] {
    let pixel = 4 * (y * EXTENT[0] as usize + x);
    [0, 1, 2].map(|channel| linear(picture.colour[0][pixel + channel]))
}

/// First and last column of a row that are as `is` says, from the first to before the second column.
fn columns(picture: &Picture, y: f32, range: [f32; 2], is: impl Fn([f64; 3]) -> bool) -> [f32; 2] {
    let found: Vec<usize> = (range[0] as usize..range[1] as usize)
        .filter(|&x| is(rgb(picture, x, y as usize)))
        .collect();
    let ends = [found.first(), found.last()];
    ends.map(|end| *end.unwrap() as f32 + 0.5)
}

#[test]
fn sink_and_tray_are_at_the_far_edge() {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_scene(&SceneDesc::laboratory(Vec::new(), TOP, 1.0));
    // From above, so that nothing is before anything.
    let sink = [TABLE[1][0] - 0.37, TABLE[0][1] + 0.055];
    let middle = Vec3::new(sink[0] + 0.15, TOP, sink[1] + 0.08);
    let view = look(middle + Vec3::new(0.0, 0.8, 0.05), middle, 0.35);
    let picture = rig.draw(&FrameDesc::empty(&[view]));
    let y = seen(&view, middle)[1];
    // Across the middle of its far half, where no drain is. The basin is dark, its rim is not.
    let dark = |[_, green, _]: [f64; 3]| green < 0.16;
    let found = columns(&picture, y, [0.0, 639.0], dark);
    let edges = [0.0, 0.30].map(|x| seen(&view, Vec3::new(sink[0] + x, TOP, middle.z))[0]);
    // The part of the right wall that the window lights is not dark.
    assert!((found[0] - edges[0]).abs() < 2.0, "{found:?} {edges:?}");
    assert!(found[1] < edges[1] + 1.0, "{found:?} {edges:?}");
    let rim = columns(&picture, y, [0.0, edges[0] - 0.5], |[_, green, _]| {
        green > 0.62
    });
    let outer = seen(&view, Vec3::new(sink[0] - 0.01, TOP, middle.z))[0];
    assert!((rim[0] - outer).abs() < 1.5, "{rim:?} {outer}");

    let tray = [TABLE[0][0] + 0.06, TABLE[0][1] + 0.07];
    let middle = Vec3::new(tray[0] + 0.17, TOP, tray[1] + 0.0675);
    let view = look(middle + Vec3::new(0.0, 0.8, 0.05), middle, 0.35);
    let picture = rig.draw(&FrameDesc::empty(&[view]));
    let y = seen(&view, middle)[1];
    let found = columns(&picture, y, [0.0, 639.0], |[red, ..]| red > 0.75);
    // Its upper edge.
    let edges = [0.0, 0.34].map(|x| seen(&view, Vec3::new(tray[0] + x, TOP + 0.018, middle.z))[0]);
    for (found, edge) in found.into_iter().zip(edges) {
        assert!((found - edge).abs() < 1.5, "{found} {edge}");
    }
}

/// A plate's ceramic, rim and lamp are where they are put, in scenes of any scale, and beside it is the bench.
#[test]
fn a_hot_plate_is_let_into_the_bench() {
    let mut rig = Rig::new(EXTENT, 1);
    let (middle, radius) = (Vec3::new(0.12, TOP, -0.4), 0.0675);
    let view = look(middle + Vec3::new(0.0, 0.4, 0.02), middle, 0.35);
    for scale in [1.0, 0.05] {
        let plate = PlateDesc {
            middle: [middle.x / scale, middle.z / scale],
            radius: radius / scale,
        };
        let bench = SceneDesc::laboratory(Vec::new(), TOP, scale);
        let mut draw = |plates: Vec<PlateDesc>| {
            rig.set_scene(&SceneDesc {
                plates,
                ..bench.clone()
            });
            rig.draw(&FrameDesc {
                length_scale: scale,
                ..FrameDesc::empty(&[view])
            })
        };
        let (picture, plain) = (draw(vec![plate]), draw(Vec::new()));
        let y = seen(&view, middle)[1];
        let at = |x: f32| seen(&view, middle + x * Vec3::X)[0];
        // Reflectances of 0.03, 0.5 and, of the bench, 0.33.
        let dark = |[_, green, _]: [f64; 3]| green < 0.15;
        let found = columns(&picture, y, [0.0, 639.0], dark);
        for (found, x) in found.into_iter().zip([-radius + 0.003, radius - 0.003]) {
            assert!((found - at(x)).abs() < 1.5, "{scale}: {found} {}", at(x));
        }
        let rim = columns(&picture, y, [0.0, 320.0], |[_, green, _]| green > 0.62);
        assert!((rim[0] - at(-radius)).abs() < 1.5, "{scale}: {rim:?}");
        let beside = at(-radius) as usize - 6;
        assert_eq!(
            rgb(&picture, beside, y as usize),
            rgb(&plain, beside, y as usize)
        );
        // Towards the user.
        let lamp = seen(&view, middle + (radius - 0.011) * Vec3::Z);
        let [red, green, _] = rgb(&picture, lamp[0] as usize, lamp[1] as usize);
        assert!(red > 0.5 && red > 4.0 * green, "{scale}: {red} {green}");
    }
}

#[test]
fn a_sign_is_on_the_wall() {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_scene(&SceneDesc::laboratory(Vec::new(), TOP, 1.0));
    let middle = Vec3::new(0.65, 1.62, -1.7);
    for eye in [Vec3::new(0.3, 1.6, 0.0), Vec3::new(0.5, 1.2, -0.6)] {
        let view = look(eye, middle, 0.2);
        let picture = rig.draw(&FrameDesc::empty(&[view]));
        for (side, x) in [-0.11, 0.11].into_iter().enumerate() {
            // Each edge in its own row: the plane leans.
            let edge = seen(&view, middle + x * Vec3::X);
            let blue = |[red, _, blue]: [f64; 3]| blue > 4.0 * red;
            let found = columns(&picture, edge[1], [40.0, 600.0], blue)[side];
            assert!((found - edge[0]).abs() < 1.5, "{found} {edge:?} from {eye}");
        }
    }
}

/// A number's middle is at its mark's height, and its label where it is put.
#[test]
fn numbers_and_labels_are_printed_at_their_heights() {
    let (radius, foot) = (0.034_f32, Vec3::new(0.0, TOP, -0.4));
    let (marks, volumes) = (vec![0.02, 0.05], vec![40, 80]);
    let mut rig = Rig::new(EXTENT, 1);
    let vessel = |volumes: Vec<u32>, label| VesselDesc {
        marks: marks.clone(),
        volumes,
        label,
        ..cylinder([0.032, 0.034], 0.002, 0.09)
    };
    let label = Label {
        lines: vec!["H₂O".to_owned()],
        bottom: 0.06,
        letters: 0.005,
        angles: [-0.7, 0.3],
    };
    let vessels = [Affine3A::from_translation(foot)];
    // Level with the point that it looks at.
    let mut draw = |height: f32, volumes: &[u32], label: Option<&Label>| {
        let eye = foot + Vec3::new(0.0, height, 0.3);
        let view = look(eye, eye - Vec3::Z, 0.2);
        let desc = vessel(volumes.to_vec(), label.cloned());
        // Without furniture, whose edges glass bends: where they end at the print, smoothing draws them out over it.
        rig.set_scene(&SceneDesc {
            furnished: false,
            ..SceneDesc::laboratory(vec![desc], TOP, 1.0)
        });
        let frame = FrameDesc {
            vessels: &vessels,
            ..FrameDesc::empty(std::slice::from_ref(&view))
        };
        (view, rig.draw(&frame))
    };
    let changed = |a: &Picture, b: &Picture| {
        let differs = |index: &usize| {
            (0..3).any(|n| a.colour[0][4 * index + n].abs_diff(b.colour[0][4 * index + n]) > 12)
        };
        let (width, pixels) = (EXTENT[0] as usize, 640 * 480);
        let places: Vec<[usize; 2]> = (0..pixels)
            .filter(differs)
            .map(|index| [index % width, index / width])
            .collect();
        let ends = |axis: usize| {
            let along = places.iter().map(|place| place[axis]);
            [along.clone().min().unwrap(), along.max().unwrap()].map(|end| end as f32 + 0.5)
        };
        [ends(0), ends(1)]
    };
    let (view, without) = draw(0.05, &[], None);
    let (_, with) = draw(0.05, &volumes, None);
    let [across, down] = changed(&with, &without);
    let at = |angle: f32, height: f32| {
        let out = Vec3::new(radius * angle.sin(), height, radius * angle.cos());
        seen(&view, foot + out)
    };
    // Digits of 0.13 radii about the height, from 0.27 rad on; two of them, a blank, and mL.
    let middle = 0.5 * (down[0] + down[1]);
    let expected = at(0.3, 0.05)[1];
    assert!((middle - expected).abs() < 1.0, "{middle} {expected}");
    let tall = (at(0.3, 0.05 - 0.065 * radius)[1] - at(0.3, 0.05 + 0.065 * radius)[1]).abs();
    assert!(
        (down[1] - down[0] + 1.0 - tall).abs() < 2.5,
        "{down:?} {tall}"
    );
    let first = at(0.27, 0.05)[0];
    assert!((across[0] - first).abs() < 3.0, "{across:?} {first}");
    let last = at(0.27 + 0.13 * 29.0 / 7.0, 0.05)[0];
    assert!((across[1] - last).abs() < 3.0, "{across:?} {last}");

    let (view, without) = draw(0.065, &[], None);
    let (_, with) = draw(0.065, &[], Some(&label));
    let [_, down] = changed(&with, &without);
    let at = |height: f32| {
        let out = Vec3::new(radius * -0.7_f32.sin(), height, radius * 0.7_f32.cos());
        seen(&view, foot + out)[1]
    };
    // One line of 5 mm and margins of 0.7 of that.
    let high = 0.06 + 0.005 * 2.1;
    assert!((down[1] - at(0.06)).abs() < 2.5, "{down:?} {}", at(0.06));
    assert!((down[0] - at(high)).abs() < 2.5, "{down:?} {}", at(high));
}

/// Light of the bench by the window's and the sky's formula, in each room.
#[test]
fn rooms_are_as_bright_as_they_say() {
    let mut rig = Rig::new(EXTENT, 1);
    let at = Vec3::new(0.0, TOP, -0.3);
    let view = look(at + Vec3::new(0.0, 0.6, 0.1), at, 0.1);
    let window = glam::DVec3::new(-1.6, 1.75, 0.35) - at.as_dvec3();
    let square = window.length_squared();
    for (light, levels) in [
        (RoomLight::DAY, [1.0, 1.0, 1.0]),
        (RoomLight::BRIGHT, [2.5, 1.6, 0.65]),
        (RoomLight::DARK, [0.04, 0.15, 2.5]),
    ] {
        let mut scene = SceneDesc::laboratory(Vec::new(), TOP, 1.0);
        scene.light = light;
        rig.set_scene(&scene);
        let picture = rig.draw(&FrameDesc::empty(&[view]));
        let found = rgb(&picture, 320, 240)[1];
        let sun = levels[0] * 7.643 * window.y / square.sqrt() / (1.0 + square);
        let expected = displayed(levels[2] * 0.33 * (levels[1] * 0.55 + sun));
        assert!(
            (found - expected).abs() < 0.006,
            "{light:?}: {found} {expected}"
        );
    }
}

/// Panes, bar and wall of the window, where geometry has them, with their own light; seen directly, and in still water's mirror.
#[test]
fn the_window_is_seen_and_mirrored() {
    for furnished in [false, true] {
        let mut rig = Rig::new(EXTENT, 1);
        rig.set_scene(&SceneDesc {
            furnished,
            ..SceneDesc::laboratory(Vec::new(), TOP, 1.0)
        });
        let window = Vec3::new(-1.6, 1.75, 0.35);
        let view = look(window + Vec3::new(2.2, 0.1, 0.2), window, 1.3);
        let picture = rig.draw(&FrameDesc::empty(&[view]));
        let light = |up: f32, across: f32| {
            let at = seen(&view, window + Vec3::new(0.0, up, across));
            rgb(&picture, at[0] as usize, at[1] as usize)[1]
        };
        // Panes are as bright as can be shown; the parts beside and between them have the ambient light alone.
        for (up, across) in [
            (0.4, 0.6),
            (-0.4, 0.6),
            (0.4, -0.6),
            (-0.4, -0.6),
            (0.7, 1.08),
        ] {
            assert!(light(up, across) > 0.99, "{furnished} ({up}, {across})");
        }
        let wall = displayed(0.60 * 0.385);
        for (up, across) in [(0.0, 0.6), (0.4, 0.0), (0.95, 0.3), (0.3, 1.4)] {
            let found = light(up, across);
            let least = if furnished { 0.1 } else { wall - 0.01 };
            assert!(
                (least..wall + 0.01).contains(&found),
                "{furnished} ({up}, {across}): {found}"
            );
        }
    }
}
