//! The panel against rays in f64, objects before it, and the fading of the picture.

use crate::glass::beaker;
use crate::liquid::{self, Liquid, lattice};
use crate::rig::{Picture, Rig, linear, ray};
use glam::{Affine3A, DVec3, EulerRot, Quat, Vec3};
use vitriol_gpu::Image;
use vitriol_render::camera::NEAR;
use vitriol_render::{Bone, Finish, Fov, FrameDesc, Panel, SceneDesc, SurfaceFilter, View};

pub const EXTENT: [u32; 2] = [320, 240];
const TEXELS: [u32; 2] = [256, 160];
const SIZE: [f32; 2] = [0.6, 0.375];

/// Red grows to the right, green downwards.
pub fn image(rig: &Rig) -> Image {
    let [width, height] = TEXELS;
    let level = |n: u32, all: u32| (255.0 * (n as f32 + 0.5) / all as f32).round() as u8;
    let texels: Vec<u32> = (0..width * height)
        .map(|n| {
            let (red, green) = (level(n % width, width), level(n / width, height));
            u32::from_le_bytes([red, green, 77, 255])
        })
        .collect();
    rig.image(TEXELS, &texels)
}

/// An eye with an oblique line of sight.
pub fn view() -> View {
    let turn = Quat::from_euler(EulerRot::YXZ, 0.2, -0.1, 0.15);
    View {
        stage_from_eye: Affine3A::from_rotation_translation(turn, Vec3::new(0.1, 1.4, 0.2)),
        fov: Fov {
            left: -0.6,
            right: 0.5,
            up: 0.4,
            down: -0.5,
        },
    }
}

/// A panel that the eye sees, most of it, at that distance along its axis and from aside.
pub fn panel<'a>(view: &View, image: &'a Image, distance: f32) -> Panel<'a> {
    let turn = Quat::from_euler(EulerRot::YXZ, 0.3, -0.2, 0.1);
    let place = Affine3A::from_rotation_translation(turn, Vec3::new(-0.05, 0.03, -distance));
    Panel {
        image,
        stage_from_panel: view.stage_from_eye * place,
        size: SIZE,
    }
}

/// Where a pixel's ray meets the panel, over half its sides, and its view depth there.
pub fn on_panel(view: &View, panel: &Panel<'_>, x: u32, y: u32) -> Option<([f64; 2], f64)> {
    let pose = panel.stage_from_panel;
    let (origin, middle) = (view.stage_from_eye.translation, pose.translation);
    let (right, up, out) = (
        pose.matrix3.x_axis.as_dvec3(),
        pose.matrix3.y_axis.as_dvec3(),
        pose.matrix3.z_axis.as_dvec3(),
    );
    let ray = ray(view, EXTENT, x, y);
    let to_middle: DVec3 = (middle - origin).as_dvec3();
    let way = to_middle.dot(out) / ray.dot(out);
    (way > 0.0 && ray.dot(out) < 0.0).then(|| {
        let at = way * ray - to_middle;
        let half = panel.size.map(|side| 0.5 * f64::from(side));
        let axis = -view.stage_from_eye.matrix3.z_axis.as_dvec3();
        (
            [at.dot(right) / half[0], at.dot(up) / half[1]],
            way * ray.dot(axis),
        )
    })
}

pub fn pixels() -> impl Iterator<Item = (u32, u32, usize)> {
    let [width, height] = EXTENT;
    (0..width * height).map(move |n| (n % width, n / width, n as usize))
}

pub fn rgba(picture: &Picture, index: usize) -> [u8; 4] {
    picture.colour[0][4 * index..][..4].try_into().unwrap()
}

/// Where a ray meets the panel, the picture has the panel's colour and depth there, and lets a layer under it be seen. The gradient's own
/// filter is less than a level, but darker than the mean in light.
#[test]
fn each_pixel_has_what_its_ray_meets() {
    let rig = Rig::new(EXTENT, 1);
    let (view, image) = (view(), image(&rig));
    for (distance, scale) in [(0.7, 1.0), (0.7, 0.05), (1.5, 1.0)] {
        let panel = panel(&view, &image, distance);
        let picture = rig.draw(&FrameDesc {
            panel: Some(panel),
            length_scale: scale,
            ..FrameDesc::empty(&[view])
        });
        let (mut within, mut beside) = (0, 0);
        for (x, y, index) in pixels() {
            let [red, green, blue, alpha] = rgba(&picture, index);
            let Some((at, depth)) = on_panel(&view, &panel, x, y) else {
                assert_eq!(alpha, 255);
                continue;
            };
            let farthest = at[0].abs().max(at[1].abs());
            if farthest < 0.97 {
                let expected = [0.5 + 0.5 * at[0], 0.5 - 0.5 * at[1]].map(|share| 255.0 * share);
                for (found, expected) in [red, green].into_iter().zip(expected) {
                    assert!(
                        (f64::from(found) - expected).abs() < 2.0,
                        "({x}, {y}): {found} {expected}"
                    );
                }
                assert!(
                    blue.abs_diff(77) <= 1 && alpha == 0,
                    "({x}, {y}): {blue} {alpha}"
                );
                let reversed = f64::from(picture.depth[0][index]);
                assert!((reversed * depth / f64::from(NEAR) - 1.0).abs() < 1e-4);
                within += 1;
            } else if farthest > 1.05 {
                assert_eq!(alpha, 255, "({x}, {y})");
                assert_eq!(picture.depth[0][index], 0.0);
                beside += 1;
            }
        }
        assert!(within > 3000 && beside > 3000, "{within} {beside}");
    }
    // From behind there is nothing.
    let mut away = panel(&view, &image, 0.7);
    away.stage_from_panel.matrix3 *= glam::Mat3A::from_rotation_y(std::f32::consts::PI);
    let picture = rig.draw(&FrameDesc {
        panel: Some(away),
        ..FrameDesc::empty(&[view])
    });
    assert!(picture.depth[0].iter().all(|depth| *depth == 0.0));
}

/// A finger across the panel, half of it before and half behind.
#[test]
fn a_glove_is_seen_before_it() {
    let rig = Rig::new(EXTENT, 1);
    let (view, image) = (view(), image(&rig));
    let panel = panel(&view, &image, 0.7);
    let at = |x: f32, z: f32| {
        panel
            .stage_from_panel
            .transform_point3(Vec3::new(x, 0.02, z))
    };
    let finger = Bone::new(Finish::Glove, [at(-0.2, 0.08), at(0.2, -0.08)], [0.012; 2]);
    let draw = |panel: Option<Panel<'_>>, hand: &[Bone]| {
        rig.draw(&FrameDesc {
            panel,
            hands: [&[], hand],
            ..FrameDesc::empty(&[view])
        })
    };
    let (both, alone) = (draw(Some(panel), &[finger]), draw(None, &[finger]));
    let bare = draw(Some(panel), &[]);
    let (mut before, mut behind) = (0, 0);
    for (.., index) in pixels() {
        let (finger, plane) = (alone.depth[0][index], bare.depth[0][index]);
        if finger == 0.0 {
            continue;
        }
        assert_eq!(both.depth[0][index], finger.max(plane));
        if finger > 1.02 * plane && plane > 0.0 {
            // The layer is not seen through it; at its outline it is smoothed together with the panel.
            before += usize::from(rgba(&both, index) == rgba(&alone, index));
            assert!(rgba(&both, index)[3] > 0);
        } else if plane > 1.02 * finger {
            assert_eq!(rgba(&both, index), rgba(&bare, index));
            behind += 1;
        }
    }
    assert!(before > 200 && behind > 200, "{before} {behind}");
}

/// Glass is over the picture's panel: no layer that is under the picture may be seen there.
#[test]
fn glass_is_seen_before_it() {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_vessels(vec![beaker(0.03, 0.12)]);
    let (view, image) = (view(), image(&rig));
    let panel = panel(&view, &image, 0.7);
    let draw = |at: Vec3| {
        let vessels = [Affine3A::from_translation(
            panel.stage_from_panel.transform_point3(at),
        )];
        rig.draw(&FrameDesc {
            panel: Some(panel),
            vessels: &vessels,
            ..FrameDesc::empty(&[view])
        })
    };
    let (before, behind) = (
        draw(Vec3::new(0.0, -0.05, 0.15)),
        draw(Vec3::new(0.0, -0.05, -0.15)),
    );
    let (mut covered, mut dimmed) = (0, 0);
    for (x, y, index) in pixels() {
        let on = on_panel(&view, &panel, x, y);
        if on.is_none_or(|(at, _)| at[0].abs().max(at[1].abs()) > 0.97) {
            continue;
        }
        assert_eq!(rgba(&behind, index)[3], 0, "({x}, {y})");
        if rgba(&before, index)[3] == 255 {
            covered += 1;
            dimmed += usize::from(rgba(&before, index)[..3] != rgba(&behind, index)[..3]);
        }
    }
    // A wall dims the light by some levels everywhere.
    assert!(
        covered > 1000 && dimmed > covered * 9 / 10,
        "{covered} {dimmed}"
    );
}

/// Of a panel that stands half in the bench, the lower half is neither seen nor seen through.
#[test]
fn what_is_in_the_bench_is_not_seen() {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_scene(&SceneDesc::laboratory(Vec::new(), 0.75, 1.0));
    let view = View::bench(4.0 / 3.0);
    let image = image(&rig);
    let panel = Panel {
        image: &image,
        stage_from_panel: Affine3A::from_translation(Vec3::new(0.0, 0.75, -0.4)),
        size: [0.3, 0.2],
    };
    let picture = rig.draw(&FrameDesc {
        panel: Some(panel),
        ..FrameDesc::empty(&[view])
    });
    let without = rig.draw(&FrameDesc::empty(&[view]));
    let (mut above, mut below) = (0, 0);
    for (x, y, index) in pixels() {
        let Some((at, _)) = on_panel(&view, &panel, x, y) else {
            continue;
        };
        if at[0].abs() < 0.95 && (0.05..0.95).contains(&at[1]) {
            assert_eq!(rgba(&picture, index)[3], 0, "({x}, {y})");
            above += 1;
        } else if at[1] < -0.05 {
            assert_eq!(rgba(&picture, index), rgba(&without, index), "({x}, {y})");
            below += 1;
        }
    }
    assert!(above > 1000 && below > 1000, "{above} {below}");
}

/// Light falls with `shown`, by the sRGB encoding's own formula (IEC 61966-2-1), and ends.
#[test]
fn the_picture_fades() {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_scene(&SceneDesc::laboratory(Vec::new(), 0.75, 1.0));
    let (view, image) = (View::bench(4.0 / 3.0), image(&rig));
    let panel = Panel {
        image: &image,
        stage_from_panel: Affine3A::from_translation(Vec3::new(0.0, 0.9, -0.4)),
        size: [0.15, 0.1],
    };
    let draw = |shown: f32| {
        rig.draw(&FrameDesc {
            panel: Some(panel),
            shown,
            ..FrameDesc::empty(&[view])
        })
    };
    let whole = draw(1.0);
    let mut even = 0;
    for shown in [0.6, 0.2, 0.0] {
        let faded = draw(shown);
        for (x, y, index) in pixels() {
            // Where the light is even, so that no edge is smoothed in the one and not in the other.
            if !is_even(&whole, x, y) {
                continue;
            }
            even += 1;
            for (a, b) in rgba(&whole, index)[..3].iter().zip(rgba(&faded, index)) {
                // Two levels of the darker one, for rounding and dither.
                let most = linear(b.saturating_add(2)) - linear(b.saturating_sub(2));
                let off = f64::from(shown) * linear(*a) - linear(b);
                assert!(off.abs() <= most, "({x}, {y}), {shown}: {a} {b}");
            }
        }
        assert_eq!(faded.depth, whole.depth);
    }
    assert!(even > 3 * 60_000, "{even}");
}

/// Whether the pixels around differ by less than what smoothing takes for an edge.
fn is_even(picture: &Picture, x: u32, y: u32) -> bool {
    let around = [-1, 0, 1].into_iter().flat_map(|dy| {
        [-1, 0, 1].map(|dx| {
            let at = [(x, dx, EXTENT[0]), (y, dy, EXTENT[1])];
            let [x, y] = at.map(|(n, by, all)| n.saturating_add_signed(by).min(all - 1));
            rgba(picture, (y * EXTENT[0] + x) as usize)[1]
        })
    });
    let (least, most) = around.fold((255, 0), |(least, most), level| {
        (level.min(least), level.max(most))
    });
    most - least < 5
}

/// Liquid shows a panel that it stands before. One that is elsewhere, whose light a ball bends or mirrors towards the eye, would be a dark
/// block in it: no pixel of the ball shows it.
#[test]
fn liquid_shows_a_panel_that_it_stands_before_alone() {
    let rig = liquid::rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let (view, image) = (view(), image(&rig));
    let ahead = |up: f32, away: f32| {
        let from_eye = Vec3::new(0.0, up, -away);
        view.stage_from_eye * Affine3A::from_translation(from_eye)
    };
    let middle: Vec3 = ahead(0.0, 0.25).translation.into();
    let ball = lattice(10, 0.2, |x| x.length() < 9.0);
    let ball: Vec<Vec3> = ball.into_iter().map(|x| x + middle).collect();
    let ball = Liquid::new(&rig, &ball, |_| 0.0);
    let draw = |stage_from_panel: Option<Affine3A>| {
        let panel = stage_from_panel.map(|stage_from_panel| Panel {
            image: &image,
            stage_from_panel,
            size: [0.6; 2],
        });
        let desc = FrameDesc {
            panel,
            ..liquid::frame(std::slice::from_ref(&view), &[], &ball)
        };
        liquid::draw(&rig, &desc)
    };
    let (bare, surfaces) = draw(None);
    let wet = |index: &usize| surfaces[0].depth[*index] > 0.0;
    let wet: Vec<usize> = pixels().map(|(.., index)| index).filter(wet).collect();
    let changed = |with: &Picture| {
        let differs = |index: &&usize| rgba(&bare, **index) != rgba(with, **index);
        wet.iter().filter(differs).count()
    };
    // Behind the ball, and over the lines of sight through it, of which none is 0.05 m off at 0.55 m. A lens of water of that radius, 22 mm, has
    // its focus 45 mm behind its middle, and spreads light over 0.13 m there.
    let [behind, over] = [(0.0, 0.35), (0.36, 0.55)].map(|(up, away)| {
        let (picture, _) = draw(Some(ahead(up, away)));
        changed(&picture)
    });
    assert!(2 * behind > wet.len(), "{behind} of {}", wet.len());
    assert_eq!(over, 0, "of {}", wet.len());
}
