//! Liquid behind a vessel's wall, against Snell's and Beer's laws. A ray that goes level through a cylinder keeps n times its distance
//! from the axis (Bouguer), whatever glass is between: at x from the axis it passes through 2 √(r² − (x/n)²) of liquid, up to the glass's
//! own outline.

use crate::liquid::{Liquid, draw, frame, rig, upright_cylinder};
use crate::rig::{cylinder, displayed, linear, ray};
use glam::{Affine3A, Vec3};
use vitriol_render::{Fov, FrameDesc, SurfaceFilter, View};

const EXTENT: [u32; 2] = [320, 240];
/// Radius of the liquid, and of the glass, m.
const RADIUS: f64 = 0.02;
const OUTER: f64 = 0.022;
const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);
/// Refractive index of water at 20 °C, and of sulfuric acid of 98 %.
const INDICES: [f64; 2] = [1.333, 1.4305];
/// Share that 60 mm let through of red, and of blue light.
const TINTS: [[f64; 2]; 2] = [[0.40, 0.92], [0.96, 0.22]];
/// Red and blue light of the hemispheres about a level ray: half of the ceiling's and half of the floor's.
const LIGHT: [f64; 2] = [0.38, 0.40];

#[test]
fn a_full_cylinder_is_a_lens() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    rig.set_vessels(vec![cylinder([RADIUS, OUTER], 0.002, 0.05)]);
    let places = upright_cylinder(FOOT + Vec3::Y * 0.002, 0.0193, 9);
    let eye = FOOT + Vec3::new(0.0, 0.013, 0.3);
    let view = View::look_at(eye, eye - Vec3::Z, Fov::symmetric(0.2, 4.0 / 3.0));
    let vessels = [Affine3A::from_translation(FOOT)];
    let empty = rig.draw(&FrameDesc {
        vessels: &vessels,
        ..FrameDesc::empty(&[view])
    });
    for (kind, acid) in [0.0, 1.0].into_iter().enumerate() {
        let mut liquid = Liquid::new(&rig, &places, |_| acid);
        liquid.table = None;
        let (picture, _) = draw(&rig, &frame(&[view], &vessels, &liquid));
        let index = INDICES[kind] + if kind == 1 { 0.002 } else { 0.0 };
        let (mut compared, mut worst, mut at_outline) = (0, 0.0_f64, 0);
        let row = EXTENT[1] / 2;
        for x in 0..EXTENT[0] {
            let along = ray(&view, EXTENT, x, row);
            let apart = 0.3 * along.x.abs() / along.x.hypot(along.z);
            let pixel = 4 * (row * EXTENT[0] + x) as usize;
            if apart < 0.85 * OUTER {
                // Reflection of the glass before it, which may be of nothing or of a window: Schlick, n = 1.47.
                let rest = 1.0 - (1.0 - (apart / OUTER).powi(2)).sqrt();
                let mirrors = 0.036 + 0.964 * rest.powi(5);
                let way = 2.0 * (RADIUS * RADIUS - (apart / index).powi(2)).sqrt();
                for (channel, place) in [(0, 0), (1, 2)] {
                    let kept = TINTS[kind][channel].powf(way / 0.06);
                    let least = (1.0 - mirrors) * displayed(LIGHT[channel] * kept);
                    let found = linear(picture.colour[0][pixel + place]);
                    let expected = found.clamp(least, least + mirrors);
                    worst = worst.max((found - expected).abs());
                }
                compared += 1;
            } else if (0.93 * OUTER..0.97 * OUTER).contains(&apart) {
                // Beyond the inner wall, where there is no liquid.
                let blueness = |colour: &[u8]| linear(colour[pixel + 2]) - linear(colour[pixel]);
                let tint = blueness(&picture.colour[0]) - blueness(&empty.colour[0]);
                let seen = if kind == 0 { tint } else { -tint };
                assert!(seen > 0.03, "{apart} m: {seen}");
                at_outline += 1;
            }
        }
        eprintln!("{kind}: off by {worst} of {compared}, {at_outline} at the outline");
        assert!(compared > 50 && at_outline > 2);
        // Thickness is that of particles, to some per cent: 5 % of it are 0.02 of acid's blue.
        assert!(worst < 0.04, "{kind}: {worst}");
    }
}

/// A stream down the wall, 4 mm thick and 24 mm wide, seen from above through the open rim. A ray that glass mirrors goes on through an empty
/// vessel: it keeps what two straight ways through the stream let through, of which the longest is 34 mm at this slant. As if the vessel
/// were full, it would come five times through 40 mm.
#[test]
fn a_stream_along_a_wall_is_as_light_as_it_is_thin() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    rig.set_vessels(vec![cylinder([RADIUS, OUTER], 0.002, 0.05)]);
    let mut places = upright_cylinder(FOOT + Vec3::Y * 0.002, 0.0193, 15);
    places.retain(|at| at.x > FOOT.x + 0.8 * RADIUS as f32);
    let eye = FOOT + Vec3::new(-0.05, 0.25, 0.25);
    let view = View::look_at(eye, FOOT + Vec3::Y * 0.02, Fov::symmetric(0.25, 4.0 / 3.0));
    let vessels = [Affine3A::from_translation(FOOT)];
    let empty = rig.draw(&FrameDesc {
        vessels: &vessels,
        ..FrameDesc::empty(&[view])
    });
    let mut liquid = Liquid::new(&rig, &places, |_| 0.0);
    liquid.table = None;
    let (picture, surfaces) = draw(&rig, &frame(&[view], &vessels, &liquid));
    let least = TINTS[0][0].powf(2.0 * 0.034 / 0.06);
    let wet = (surfaces[0].depth.iter().enumerate()).filter(|(_, depth)| **depth > 0.0);
    let (mut seen, mut dark) = (0, 0);
    for (pixel, _) in wet {
        let red = |colour: &[u8]| linear(colour[4 * pixel]);
        seen += 1;
        dark += u32::from(red(&picture.colour[0]) < least * red(&empty.colour[0]));
    }
    eprintln!("{dark} of {seen} pixels are darker");
    assert!(seen > 1000, "{seen}");
    assert!(100 * dark < seen, "{dark} of {seen}");
}
