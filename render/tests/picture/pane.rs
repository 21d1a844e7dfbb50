//! The transmittance of a pane of glass against Fresnel's equations, whatever it mirrors.

use crate::panel::{EXTENT, image, on_panel, panel, pixels, rgba, view};
use crate::rig::{Rig, linear, ray};
use glam::{Affine3A, DVec3, Quat, Vec3};
use vitriol_render::{FrameDesc, Pane};

/// Index of soda-lime glass, and the share of green light that 6 mm of float glass absorb: EN 410's 88 % pass, and 8 % are mirrored.
const INDEX: f64 = 1.52;
const TAKES: f64 = 0.03;

/// Share of light that passes a plate of two faces, by the amplitudes of both polarisations.
fn through(cosine: f64) -> f64 {
    let within = (1.0 - (1.0 - cosine * cosine) / (INDEX * INDEX)).sqrt();
    let s = (cosine - INDEX * within) / (cosine + INDEX * within);
    let p = (INDEX * cosine - within) / (INDEX * cosine + within);
    let face = 0.5 * (s * s + p * p);
    // Σ (1 − r)² r^2k.
    (1.0 - face).powi(2) / (1.0 - face * face) * (1.0 - TAKES)
}

/// Before a panel and before nothing: the difference of the two is the light behind, of which the pane lets its share through. It is seen
/// from either face, nearly along its normal and askew.
#[test]
fn a_pane_lets_through_what_fresnel_says() {
    let rig = Rig::new(EXTENT, 1);
    let (view, image) = (view(), image(&rig));
    let panel = panel(&view, &image, 0.7);
    for (askew, size) in [(0.1, 2.0), (1.2, 2.0), (0.1, 0.1)] {
        for turned in [0.0, std::f32::consts::PI] {
            let turn = Quat::from_rotation_y(askew + turned);
            let place = Affine3A::from_rotation_translation(turn, Vec3::new(0.0, 0.0, -0.3));
            let pane = Pane {
                stage_from_pane: view.stage_from_eye * place,
                size: [size; 2],
            };
            let draw = |behind: bool, pane| {
                rig.draw(&FrameDesc {
                    panel: behind.then_some(panel),
                    pane,
                    ..FrameDesc::empty(&[view])
                })
            };
            let (seen, own) = (draw(true, Some(pane)), draw(false, Some(pane)));
            let (clear, nothing) = (draw(true, None), draw(false, None));
            let normal = pane.stage_from_pane.matrix3.z_axis.as_dvec3();
            let inverse = pane.stage_from_pane.inverse();
            let (mut behind, mut beside) = (0, 0);
            for (x, y, index) in pixels() {
                let direction = ray(&view, EXTENT, x, y);
                let eye: DVec3 = view.stage_from_eye.translation.as_dvec3();
                let middle = pane.stage_from_pane.translation.as_dvec3();
                let way = (middle - eye).dot(normal) / direction.dot(normal);
                let at = inverse.transform_point3((eye + way * direction).as_vec3());
                let on = at.x.abs().max(at.y.abs()) / (0.5 * size);
                if !(way > 0.05 && on < 0.97) {
                    if on > 1.03 || way < 0.0 {
                        assert_eq!(rgba(&seen, index), rgba(&clear, index), "({x}, {y})");
                        beside += 1;
                    }
                    continue;
                }
                let green = |picture| linear(rgba(picture, index)[1]);
                let light = green(&clear) - green(&nothing);
                // A level is up to 0.009 of linear light there; levels end at white, and edges are smoothed.
                let axis = -view.stage_from_eye.matrix3.z_axis.as_dvec3();
                let depth = way * direction.dot(axis);
                let within = on_panel(&view, &panel, x, y)
                    .is_some_and(|([x, y], behind)| x.abs().max(y.abs()) < 0.9 && depth < behind);
                let white = [&seen, &own].iter().any(|it| rgba(it, index)[1] > 250);
                if light.abs() < 0.2 || white || !within {
                    continue;
                }
                let share = (green(&seen) - green(&own)) / light;
                let expected = through(direction.dot(normal).abs());
                let off = (share - expected).abs();
                assert!(off < 0.05, "({x}, {y}): {share} {expected}");
                behind += 1;
            }
            assert!(
                behind > 20 && (size > 1.0 || beside > 1000),
                "{behind} {beside}"
            );
        }
    }
}
