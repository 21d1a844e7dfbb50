//! Whole pictures against kept ones, as an eye would compare them.
//!
//! Exact hashes would hold on one driver only. Both pictures are blurred over
//! two pixels, in which edges may fall differently, and compared in the encoded
//! levels, which are about even to the eye.
//!
//! `VITRIOL_KEEP_GOLDEN=1 ./lab test -p vitriol-render golden` keeps new ones: look at
//! them before they are committed.

use crate::liquid::{Liquid, SPACING, draw, frame, rig};
use crate::rig::{Rig, cylinder, ray};
use glam::{Affine3A, Vec3};
use std::path::PathBuf;
use vitriol_render::{Fov, SceneDesc, Surface, SurfaceFilter, VesselDesc, View};

const EXTENT: [u32; 2] = [320, 240];

/// Where the beaker stands.
const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);

/// Its inner radius, m.
const RADIUS: f32 = 0.02;

/// From before the beaker and above it.
fn look(fov: Fov) -> View {
    View::look_at(
        FOOT + Vec3::new(0.03, 0.075, 0.17),
        FOOT + Vec3::Y * 0.02,
        fov,
    )
}

fn still(filter: SurfaceFilter) -> Vec<u8> {
    let fov = Fov::symmetric(0.42, EXTENT[0] as f32 / EXTENT[1] as f32);
    beaker(EXTENT, filter, look(fov), true).0
}

/// A beaker on the bench with water over acid, and a drop that falls.
fn beaker(
    extent: [u32; 2],
    filter: SurfaceFilter,
    view: View,
    furnished: bool,
) -> (Vec<u8>, Surface) {
    let mut rig: Rig = rig(extent, 1, filter);
    let (radius, floor) = (f64::from(RADIUS), 0.002);
    let beaker = VesselDesc {
        marks: vec![0.012, 0.022, 0.032],
        ..cylinder([radius, radius + 0.002], floor, 0.05)
    };
    rig.set_scene(&SceneDesc {
        furnished,
        ..SceneDesc::laboratory(vec![beaker], 0.75, 1.0)
    });
    let foot = FOOT;
    let mut noise = 7_u32;
    let mut shake = || {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((noise >> 8) as f32 / 16_777_216.0 - 0.5) * 0.3
    };
    let mut places = Vec::new();
    for y in 0..9 {
        for x in -8..8 {
            for z in -8..8 {
                let at = Vec3::new(x as f32 + 0.5, y as f32 + 0.5, z as f32 + 0.5);
                if (at * Vec3::new(1.0, 0.0, 1.0)).length() * SPACING < 0.0193 {
                    let shaken = at + Vec3::new(shake(), shake(), shake());
                    places.push(foot + Vec3::Y * 0.002 + shaken * SPACING);
                }
            }
        }
    }
    places.push(foot + Vec3::new(0.0, 0.045, 0.0));
    let mut liquid = Liquid::new(&rig, &places, |x| if x.y < 0.763 { 0.9 } else { 0.0 });
    liquid.table = None;
    let (picture, surfaces) = draw(
        &rig,
        &frame(&[view], &[Affine3A::from_translation(foot)], &liquid),
    );
    (picture.colour[0].clone(), surfaces[0].clone())
}

/// How far a border is felt, pixels: a radius of the surface's filter.
const BORDER: usize = 16;

/// A picture of an asymmetric frustum is a part of that of the symmetric one around it: light, refraction and cuts at the glass use its
/// whole projection.
#[test]
fn asymmetric_frustum_is_a_part_of_a_symmetric_one() {
    let angle = |slope: f32| slope.atan();
    let whole = Fov {
        left: angle(-0.3),
        right: angle(0.3),
        up: angle(0.2),
        down: angle(-0.2),
    };
    let part = Fov {
        right: angle(0.1),
        up: angle(0.15),
        ..whole
    };
    // 800 pixels for a slope of 1.
    let sizes = [[480, 320], [320, 280]];
    let filter = SurfaceFilter::NarrowRange;
    let (large, _) = beaker(sizes[0], filter, look(whole), false);
    let (small, _) = beaker(sizes[1], filter, look(part), false);
    let mut off = [0; 2];
    for y in 0..280 {
        for x in 0..320 {
            let there = 4 * ((y + 40) * 480 + x);
            let pair = large[there..]
                .iter()
                .zip(&small[4 * (y * 320 + x)..])
                .take(3);
            let differs = pair.map(|(a, b)| a.abs_diff(*b)).max() > Some(8);
            off[usize::from(x >= 320 - BORDER || y < BORDER)] += u32::from(differs);
        }
    }
    // Pixels of half thickness and tiles fall alike; rounding decides at edges.
    assert!(off[0] < 30, "{off:?} of 89600 pixels differ");
    // The smaller picture has no liquid beyond its border: filters end there, and bent rays find none.
    assert!(off[1] < 150, "{off:?} of 89600 pixels differ");
}

/// Liquid that wets the glass has the glass's surface, and none of it is in
/// the glass.
#[test]
fn wetted_glass_is_the_glass() {
    let fov = Fov::symmetric(0.42, EXTENT[0] as f32 / EXTENT[1] as f32);
    let view = look(fov);
    let (_, surface) = beaker(EXTENT, SurfaceFilter::NarrowRange, view, true);
    let (mut at_wall, mut most) = (0, f64::MIN);
    for (index, &depth) in surface
        .depth
        .iter()
        .enumerate()
        .filter(|(_, depth)| **depth > 0.0)
    {
        let (x, y) = (index as u32 % EXTENT[0], index as u32 / EXTENT[0]);
        let ray = ray(&view, EXTENT, x, y);
        let along = -ray.dot(view.stage_from_eye.matrix3.z_axis.as_dvec3());
        let eye = view.stage_from_eye.translation.as_dvec3();
        let at = eye + ray * (f64::from(depth) / along) - FOOT.as_dvec3();
        let beyond = at.x.hypot(at.z) - f64::from(RADIUS);
        most = most.max(beyond);
        at_wall += u32::from(beyond.abs() < 0.02 * f64::from(SPACING));
    }
    // Two steps towards it, in f32. The lattice touches the wall here and there.
    assert!(most < 0.01 * f64::from(SPACING), "{most} m into the glass");
    assert!(at_wall > 1500, "{at_wall} pixels at the wall");
}

fn path(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/picture/golden");
    folder.join(format!("{name}.png"))
}

/// Mean and greatest difference of two pictures' levels (0 to 255), blurred; of the mean, the part above one level: drivers encode and
/// dither to the next level or to that below.
fn difference(a: &[u8], b: &[u8]) -> (f64, f64) {
    let [width, height] = EXTENT.map(|side| side as usize);
    let blurred = |picture: &[u8], x: usize, y: usize, channel: usize| {
        let mut sum = 0.0;
        for dy in 0..3 {
            for dx in 0..3 {
                sum += f64::from(picture[4 * ((y + dy) * width + x + dx) + channel]);
            }
        }
        sum / 9.0
    };
    let (mut sum, mut most) = (0.0, 0.0_f64);
    for y in 0..height - 2 {
        for x in 0..width - 2 {
            for channel in 0..3 {
                let off = (blurred(a, x, y, channel) - blurred(b, x, y, channel)).abs();
                sum += (off - 1.0).max(0.0);
                most = most.max(off);
            }
        }
    }
    (sum / (3 * (width - 2) * (height - 2)) as f64, most)
}

/// Levels that drivers may differ by, on the mean: half of what
/// unfiltered particles differ by. An H200, which has four rays to the glass instead of one, differs by 0.065.
const MEAN: f64 = 0.075;

#[test]
fn still_beaker_looks_as_it_did() {
    for (name, filter) in [
        ("narrow-range", SurfaceFilter::NarrowRange),
        ("curvature-flow", SurfaceFilter::CurvatureFlow),
    ] {
        let picture = still(filter);
        let path = path(name);
        if std::env::var_os("VITRIOL_KEEP_GOLDEN").is_some() {
            image::save_buffer(
                &path,
                &picture,
                EXTENT[0],
                EXTENT[1],
                image::ColorType::Rgba8,
            )
            .unwrap();
        }
        let kept = image::open(&path).unwrap().to_rgba8().into_raw();
        let (mean, most) = difference(&picture, &kept);
        eprintln!("{name}: mean {mean:.3}, most {most:.1}");
        assert!(
            mean < MEAN,
            "{name}: {mean} levels on the mean, {most} at most"
        );
    }
    // The comparison can fail: without the filter it does.
    let rough = still(SurfaceFilter::None);
    let kept = image::open(path("narrow-range"))
        .unwrap()
        .to_rgba8()
        .into_raw();
    let (mean, most) = difference(&rough, &kept);
    eprintln!("no filter: mean {mean:.3}, most {most:.1}");
    assert!(
        mean > 2.0 * MEAN,
        "unfiltered particles pass: {mean} levels"
    );
}
