//! Liquid behind a vessel's wall, against Snell's and Beer's laws. A ray that goes level through a cylinder keeps n times its distance
//! from the axis (Bouguer), whatever glass is between: at x from the axis it passes through 2 √(r² − (x/n)²) of liquid, up to the glass's
//! own outline.

use crate::liquid::{Liquid, draw, frame, rig, upright_cylinder};
use crate::rig::{Rig, cylinder, displayed, linear, ray};
use glam::{Affine3A, Quat, Vec3};
use vitriol_render::{BoxDesc, Fov, FrameDesc, SceneDesc, SurfaceFilter, View};

const EXTENT: [u32; 2] = [320, 240];
/// Radius of the liquid, and of the glass, m.
const RADIUS: f64 = 0.02;
const OUTER: f64 = 0.022;
const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);
/// Refractive index of borosilicate glass.
const GLASS: f64 = 1.47;
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

/// A room without furniture, with that many cylinders and a bench, or `table` in its place.
fn in_a_room(vessels: usize, table: Option<BoxDesc>) -> Rig {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let scene = SceneDesc::laboratory(Vec::new(), FOOT.y, 1.0);
    rig.set_scene(&SceneDesc {
        vessels: (0..vessels)
            .map(|_| cylinder([RADIUS, OUTER], 0.002, 0.05))
            .collect(),
        table: table.or(scene.table),
        furnished: false,
        ..scene
    });
    rig
}

/// The cylinder level across the line of sight, with its axis' middle there.
fn level(middle: Vec3) -> Affine3A {
    let turned = Quat::from_rotation_z(-std::f32::consts::FRAC_PI_2);
    Affine3A::from_rotation_translation(turned, middle - Vec3::X * 0.025)
}

/// The value from `from` on, within 2 mm, for which `missed` is least, to 1 µm.
fn least(from: f64, missed: impl Fn(f64) -> f64) -> f64 {
    let places = (0..2000).map(|n| from + 1e-6 * f64::from(n));
    places
        .min_by(|&a, &b| missed(a).total_cmp(&missed(b)))
        .unwrap()
}

/// An empty cylinder, level and across the line of sight: the bench's far edge is seen through it moved towards its axis, by Bouguer's law. At
/// b from the axis a ray is turned away from that by 2 (asin(b/r) − asin(b/nr) − asin(b/R) + asin(b/nR)), and leaves at b from it.
#[test]
fn an_empty_cylinder_moves_what_is_behind_it() {
    const HIGH: f64 = 0.034;
    let rig = in_a_room(1, None);
    let eye = FOOT + Vec3::new(0.0, HIGH as f32, 0.3);
    let view = View::look_at(eye, eye - Vec3::Z, Fov::symmetric(0.1, 4.0 / 3.0));
    let middle = FOOT + Vec3::Y * HIGH as f32;
    // The bench ends 0.38 m behind the axis.
    let missed = |b: f64, turned: f64| {
        let fall = (b / 0.3).asin() + turned;
        let along = (0.38 + b * fall.sin()) / fall.cos();
        HIGH - b * fall.cos() - along * fall.sin()
    };
    let turned = |b: f64| {
        let by = |radius: f64| (b / radius).asin() - (b / (GLASS * radius)).asin();
        2.0 * (by(RADIUS) - by(OUTER))
    };
    let row = |y: u32| {
        let along = ray(&view, EXTENT, EXTENT[0] / 2, y);
        0.3 * -along.y / along.y.hypot(along.z)
    };
    let picture = rig.draw(&FrameDesc {
        vessels: &[level(middle)],
        ..FrameDesc::empty(&[view])
    });
    let red = |y: u32| linear(picture.colour[0][4 * (y * EXTENT[0] + EXTENT[0] / 2) as usize]);
    let step = |y: u32| (red(y + 1) - red(y)).abs();
    let inside = (EXTENT[1] / 2..EXTENT[1] - 1).filter(|&y| row(y) < 0.8 * RADIUS);
    let y = inside.max_by(|&a, &b| step(a).total_cmp(&step(b))).unwrap();
    let found = 0.5 * (row(y) + row(y + 1));
    let bent = least(0.0085, |b| missed(b, turned(b)).abs());
    let straight = least(0.014, |b| missed(b, 0.0).abs());
    eprintln!("{found} m from the axis, {bent} expected, {straight} without it");
    // A pixel is 0.25 mm wide there.
    assert!((found - bent).abs() < 2.5e-4, "{found} {bent}");
    assert!(straight - bent > 5e-3, "{straight} {bent}");
}

/// At b between its radii a ray meets the inner face of the same cylinder so flat that it is mirrored: it turns towards the axis by
/// 2 (asin(b/R) − asin(b/nR)), away from it by π − 2 asin(b/nr), and leaves at b from it. A box that hangs behind is seen by it alone.
#[test]
fn the_inner_face_mirrors_near_the_outline() {
    // The lower edge of the box at the back, over the axis and behind it, m: what rises past it sees the wall.
    const EDGE: [f64; 2] = [0.06, 0.15];
    let middle = FOOT + Vec3::Y * 0.034;
    let low = middle + Vec3::new(-0.8, EDGE[0] as f32, -EDGE[1] as f32);
    let max = low + Vec3::new(1.6, 0.2, 0.05);
    let rig = in_a_room(1, Some(BoxDesc { min: low, max }));
    let eye = middle + Vec3::Z * 0.3;
    let band = middle + Vec3::Y * 0.021;
    let view = View::look_at(eye, band, Fov::symmetric(0.015, 4.0 / 3.0));
    let picture = rig.draw(&FrameDesc {
        vessels: &[level(middle)],
        ..FrameDesc::empty(&[view])
    });
    let red = |y: u32| linear(picture.colour[0][4 * (y * EXTENT[0] + EXTENT[0] / 2) as usize]);
    let place = |y: u32| {
        let along = ray(&view, EXTENT, EXTENT[0] / 2, y);
        0.3 * along.y / along.y.hypot(along.z)
    };
    let step = |y: u32| (red(y + 1) - red(y)).abs();
    let within = (0..EXTENT[1] - 1).filter(|&y| (0.0203..0.0218).contains(&place(y)));
    let y = within.max_by(|&a, &b| step(a).total_cmp(&step(b))).unwrap();
    let found = 0.5 * (place(y) + place(y + 1));

    let height = |b: f64| {
        let towards = 2.0 * ((b / OUTER).asin() - (b / (GLASS * OUTER)).asin());
        let away = std::f64::consts::PI - 2.0 * (b / (GLASS * RADIUS)).asin();
        let rises = (b / 0.3).asin() + away - towards;
        let along = (EDGE[1] + b * rises.sin()) / rises.cos();
        b * rises.cos() + along * rises.sin()
    };
    let expected = least(0.0201, |b| (height(b) - EDGE[0]).abs());
    eprintln!("{found} m from the axis, {expected} expected");
    // A pixel is 0.04 mm wide there.
    assert!((found - expected).abs() < 6e-5, "{found} {expected}");
}

/// Seen from aside and above, the base's underside mirrors acid over it: what it shows has come through 20 mm of that and more. Water, whose index
/// is less, would be hidden by what glass mirrors at so flat an angle.
#[test]
fn a_base_shows_the_liquid_over_it() {
    let rig = in_a_room(1, None);
    let target = FOOT + Vec3::new(0.0, 0.0018, OUTER as f32);
    let view = View::look_at(
        target + Vec3::new(0.0, 0.16, 0.28),
        target,
        Fov::symmetric(0.1, 4.0 / 3.0),
    );
    let vessels = [Affine3A::from_translation(FOOT)];
    let empty = rig.draw(&FrameDesc {
        vessels: &vessels,
        ..FrameDesc::empty(&[view])
    });
    let pixel = 4 * (EXTENT[1] / 2 * EXTENT[0] + EXTENT[0] / 2) as usize;
    let blueness = |colour: &[u8]| linear(colour[pixel + 2]) / linear(colour[pixel]);
    let least = (TINTS[1][1] / TINTS[1][0]).powf(0.02 / 0.06);
    // The surface of 7.5 mm mirrors the ray as the base does.
    for layers in [9, 3] {
        let places = upright_cylinder(FOOT + Vec3::Y * 0.002, 0.0193, layers);
        let mut liquid = Liquid::new(&rig, &places, |_| 1.0);
        liquid.table = None;
        let (picture, _) = draw(&rig, &frame(&[view], &vessels, &liquid));
        let kept = blueness(&picture.colour[0]) / blueness(&empty.colour[0]);
        eprintln!("{layers}: {kept} of blue over red, {least} at most");
        assert!(kept < least, "{layers}: {kept} {least}");
    }
}

/// Blue over red of a liquid with that acid by height (m over the floor), over that of an empty vessel, about where `target` is seen from aside and
/// above: the mean of 5 × 5 pixels.
fn yellowness(target: Vec3, acid: impl Fn(f32) -> f32) -> f64 {
    let rig = in_a_room(1, None);
    let places = upright_cylinder(FOOT + Vec3::Y * 0.002, 0.0193, 12);
    let eye = target + Vec3::new(0.0, 0.2, 0.28);
    let view = View::look_at(eye, target, Fov::symmetric(0.15, 4.0 / 3.0));
    let vessels = [Affine3A::from_translation(FOOT)];
    let empty = rig.draw(&FrameDesc {
        vessels: &vessels,
        ..FrameDesc::empty(&[view])
    });
    let mut liquid = Liquid::new(&rig, &places, |at| acid(at.y - FOOT.y - 0.002));
    liquid.table = None;
    let (picture, _) = draw(&rig, &frame(&[view], &vessels, &liquid));
    let light = |colour: &[u8], channel: usize| {
        let pixel = |n: u32| (EXTENT[1] / 2 + n / 5 - 2) * EXTENT[0] + EXTENT[0] / 2 + n % 5 - 2;
        (0..25)
            .map(|n| linear(colour[4 * pixel(n) as usize + channel]))
            .sum::<f64>()
    };
    let blueness = |colour: &[u8]| light(colour, 2) / light(colour, 0);
    blueness(&picture.colour[0]) / blueness(&empty.colour[0])
}

/// 22 mm of acid under 7.5 mm of water, seen close to the far wall: a straight ray meets water alone, the bent one 25 mm of acid and more.
#[test]
fn a_ray_that_is_bent_into_acid_is_as_yellow_as_that() {
    let target = FOOT + Vec3::new(0.0, 0.002 + 0.030, -0.013);
    let found = yellowness(target, |height| f32::from(u8::from(height < 0.0225)));
    let water = yellowness(target, |_| 0.0);
    let most = (TINTS[1][1] / TINTS[1][0]).powf(0.025 / 0.06);
    eprintln!("{found}, of water {water}; {most} at most");
    assert!(water > 1.0 && found < most, "{found} {water} {most}");
}

/// A rim shows the light that comes up in its wall, with the colour of what wets that: 45 mm of water keep 1.87 of blue over red, of acid 0.33, and a
/// quarter of what is seen is behind the rim.
#[test]
fn a_rim_has_the_colour_of_the_liquid() {
    let target = FOOT + Vec3::new(0.0, 0.05, 0.5 * (RADIUS + OUTER) as f32);
    let [water, acid] = [0.0, 1.0].map(|acid| yellowness(target, |_| acid));
    eprintln!("{water} {acid}");
    assert!(water > 1.4 && acid < 0.6, "{water} {acid}");
}

/// An empty vessel's rim is grey, though a full one stands before its floor.
#[test]
fn a_rim_has_no_colour_of_another_vessel() {
    let rig = in_a_room(2, None);
    let places = upright_cylinder(FOOT + Vec3::Y * 0.002, 0.0193, 12);
    let behind = FOOT - Vec3::Z * 0.05;
    // The way from the eye to the empty one's floor goes through the liquid, which is 30 mm deep.
    let target = behind + Vec3::new(0.0, 0.05, 0.5 * (RADIUS + OUTER) as f32);
    let eye = target + Vec3::new(0.0, 0.2, 0.28);
    let view = View::look_at(eye, target, Fov::symmetric(0.15, 4.0 / 3.0));
    let vessels = [FOOT, behind].map(Affine3A::from_translation);
    let mut liquid = Liquid::new(&rig, &places, |_| 1.0);
    liquid.table = None;
    let (picture, _) = draw(&rig, &frame(&[view], &vessels, &liquid));
    let pixel = 4 * (EXTENT[1] / 2 * EXTENT[0] + EXTENT[0] / 2) as usize;
    let [red, blue] = [0, 2].map(|channel| linear(picture.colour[0][pixel + channel]));
    eprintln!("{red} of red, {blue} of blue");
    assert!(blue > 0.9 * red, "{red} {blue}");
}
