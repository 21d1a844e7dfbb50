//! A sign against rays in f64: the disc of its image is seen, before the panel too, and no layer through it.

use crate::panel::{EXTENT, image, on_panel, panel, pixels, rgba, view};
use crate::rig::Rig;
use glam::{Affine3A, Vec3};
use vitriol_render::camera::NEAR;
use vitriol_render::{FrameDesc, Panel};

/// A disc of nine tenths of its radius is in it, one of eleven beside it: the edge between is smoothed.
#[test]
fn a_sign_is_the_disc_of_its_image() {
    let rig = Rig::new(EXTENT, 1);
    let (view, image) = (view(), image(&rig));
    let panel = panel(&view, &image, 0.7);
    // Before the panel's left half, and half beside it.
    let before = Affine3A::from_translation(Vec3::new(-0.3, 0.05, 0.1));
    let sign = Panel {
        image: &image,
        stage_from_panel: panel.stage_from_panel * before,
        size: [0.2, 0.2],
    };
    for scale in [1.0, 0.05] {
        let draw = |sign| {
            rig.draw(&FrameDesc {
                panel: Some(panel),
                sign,
                length_scale: scale,
                ..FrameDesc::empty(&[view])
            })
        };
        let (picture, without) = (draw(Some(sign)), draw(None));
        let (mut within, mut beside) = (0, 0);
        for (x, y, index) in pixels() {
            let on = on_panel(&view, &sign, x, y);
            let radius = on.map_or(9.0, |([x, y], _)| x.hypot(y));
            if radius < 0.9 {
                let (at, depth) = on.unwrap();
                let [red, green, _, alpha] = rgba(&picture, index);
                let expected = [0.5 + 0.5 * at[0], 0.5 - 0.5 * at[1]].map(|share| 255.0 * share);
                for (found, expected) in [red, green].into_iter().zip(expected) {
                    // As wide as 30 pixels: each has four levels' light.
                    let off = (f64::from(found) - expected).abs();
                    assert!(off < 5.0, "({x}, {y}): {found} {expected}");
                }
                assert_eq!(alpha, 255, "({x}, {y})");
                let reversed = f64::from(picture.depth[0][index]);
                assert!((reversed * depth / f64::from(NEAR) - 1.0).abs() < 1e-4);
                within += 1;
            } else if radius > 1.1 {
                assert_eq!(rgba(&picture, index), rgba(&without, index), "({x}, {y})");
                assert_eq!(picture.depth[0][index], without.depth[0][index]);
                beside += 1;
            }
        }
        assert!(within > 500 && beside > 3000, "{within} {beside}");
    }
    // A sign behind the panel is not seen.
    let behind = Affine3A::from_translation(Vec3::new(0.05, 0.02, -0.1));
    let hidden = Panel {
        stage_from_panel: panel.stage_from_panel * behind,
        size: [0.1, 0.1],
        ..sign
    };
    let draw = |sign| {
        rig.draw(&FrameDesc {
            panel: Some(panel),
            sign,
            ..FrameDesc::empty(&[view])
        })
    };
    assert_eq!(draw(Some(hidden)).colour, draw(None).colour);
}
