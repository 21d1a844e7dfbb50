//! A panel seen through a liquid whose acid changes from place to place, against rays in f64: d/ds (n dr/ds) = ∇n, by Runge and Kutta's
//! fourth order.

use crate::liquid::{Liquid, SPACING, clear_rig, draw, frame};
use crate::panel::image;
use crate::rig::{Rig, cylinder, linear, ray};
use glam::{Affine3A, DVec2, Vec3};
use vitriol_gpu::Image;
use vitriol_render::{Fov, FrameDesc, Panel, View};

const EXTENT: [u32; 2] = [320, 240];
/// Radius of the liquid, and of the glass, m.
const RADIUS: f64 = 0.02;
const OUTER: f64 = 0.022;
const FLOOR: f64 = 0.002;
const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);
/// The eye, from the foot: up and towards the user.
const EYE: DVec2 = DVec2::new(0.015, 0.3);
/// Height and width of the panel behind, m.
const SIDE: f32 = 0.08;
/// Refractive index of borosilicate glass, of water at 20 °C, and the difference to that of acid of 98 %.
const GLASS: f64 = 1.47;
const WATER: f64 = 1.333;
const ACID: f64 = 0.0975 / 0.98;

fn tank() -> Rig {
    let mut rig = clear_rig(EXTENT);
    rig.set_vessels(vec![cylinder([RADIUS, OUTER], FLOOR, 0.05)]);
    rig
}

/// A full cylinder of particles, each shaken by up to so many spacings.
fn places(jitter: f32) -> Vec<Vec3> {
    let mut noise = 7_u32;
    let mut shake = || {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((noise >> 8) as f32 / 16_777_216.0 - 0.5) * 2.0 * jitter
    };
    let mut places = Vec::new();
    for n in 0..12 * 16 * 16 {
        let [x, y, z] = [n % 16, n / 256, n / 16 % 16];
        let at = Vec3::new(x as f32 - 7.5, y as f32 + 0.5, z as f32 - 7.5);
        let shaken = at + Vec3::new(shake(), shake(), shake());
        if (SPACING * at).with_y(0.0).length() < 0.0193 {
            places.push(FOOT + Vec3::Y * FLOOR as f32 + SPACING * shaken);
        }
    }
    places
}

/// Snell's law at a face across the second axis: the direction (up, on) of length 1.
fn refracted(direction: DVec2, from: f64, to: f64) -> DVec2 {
    let up = direction.x * from / to;
    DVec2::new(up, direction.y.signum() * (1.0 - up * up).sqrt())
}

/// The height above the foot at which a ray in the plane through the axis comes to a plane `behind` the axis: through glass of 2 mm, 40 mm
/// of liquid whose acid changes with height, and glass again. None where it does not stay in the liquid.
fn arrives(slope: f64, behind: f64, acid: &dyn Fn(f64) -> f64) -> Option<f64> {
    let mut at = EYE;
    let on = |at: &mut DVec2, way: DVec2, z: f64| *at += way * ((z - at.y) / way.y);
    let air = DVec2::new(slope, -1.0).normalize();
    on(&mut at, air, OUTER);
    let glass = refracted(air, 1.0, GLASS);
    on(&mut at, glass, RADIUS);
    let index = |y: f64| WATER + ACID * acid(y - FLOOR);
    let step = 1e-5;
    let mut optical = refracted(glass, GLASS, index(at.x)) * index(at.x);
    // With dt = ds/n: r'' = n ∇n.
    let force = |at: DVec2| {
        let h = 1e-6;
        let squares = index(at.x + h).powi(2) - index(at.x - h).powi(2);
        DVec2::new(squares / (4.0 * h), 0.0)
    };
    while at.y > -RADIUS {
        let dt = (step / optical.length()).min((at.y + RADIUS).max(1e-9) / -optical.y);
        let k1 = (optical, force(at));
        let k2 = (optical + 0.5 * dt * k1.1, force(at + 0.5 * dt * k1.0));
        let k3 = (optical + 0.5 * dt * k2.1, force(at + 0.5 * dt * k2.0));
        let k4 = (optical + dt * k3.1, force(at + dt * k3.0));
        at += dt / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
        optical += dt / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
        if !(FLOOR + 0.003..FLOOR + 0.027).contains(&at.x) {
            return None;
        }
    }
    let glass = refracted(optical.normalize(), index(at.x), GLASS);
    on(&mut at, glass, -OUTER);
    on(&mut at, refracted(glass, GLASS, 1.0), -behind);
    Some(at.x)
}

/// The picture of a panel behind the liquid, whose green grows downwards.
fn seen(rig: &Rig, view: View, image: &Image, behind: f32, liquid: &Liquid) -> Vec<u8> {
    let middle = FOOT + Vec3::new(0.0, 0.015, -behind);
    let (views, vessels) = ([view], [Affine3A::from_translation(FOOT)]);
    let panel = Panel {
        image,
        stage_from_panel: Affine3A::from_translation(middle),
        size: [SIDE; 2],
    };
    let frame = FrameDesc {
        panel: Some(panel),
        ..frame(&views, &vessels, liquid)
    };
    draw(rig, &frame).0.colour.swap_remove(0)
}

/// Green of each row in the middle of [`seen`].
fn rows(rig: &Rig, view: View, image: &Image, behind: f32, liquid: &Liquid) -> Vec<f64> {
    let picture = seen(rig, view, image, behind, liquid);
    let [width, height] = EXTENT;
    let green = |x: u32, y: u32| linear(picture[(4 * (y * width + x) + 1) as usize]);
    let columns = width / 2 - 4..width / 2 + 4;
    (0..height)
        .map(|y| columns.clone().map(|x| green(x, y)).sum::<f64>() / 8.0)
        .collect()
}

#[test]
fn a_gradient_bends_as_rays_are() {
    let rig = tank();
    let image = image(&rig);
    let eye = FOOT + Vec3::new(0.0, EYE.x as f32, EYE.y as f32);
    let view = View::look_at(eye, eye - Vec3::Z, Fov::symmetric(0.12, 4.0 / 3.0));
    let slopes: Vec<f64> = (0..EXTENT[1])
        .map(|y| {
            let along = ray(&view, EXTENT, EXTENT[0] / 2, y);
            -along.y / along.z
        })
        .collect();
    let pixel = (slopes[0] - slopes[1]).abs();
    let linear_ = |y: f64| 0.1 + 14.0 * y;
    let bell = |y: f64| 0.3 * (-((y - 0.014) / 0.007).powi(2)).exp();
    let gradients: [(&str, &dyn Fn(f64) -> f64); 2] = [("even", &linear_), ("bell", &bell)];
    let uniform = |_: f64| 0.3;
    for behind in [0.06, 0.12] {
        let with = |acid: &dyn Fn(f64) -> f64, jitter: f32| {
            let height = |x: Vec3| f64::from(x.y - FOOT.y) - FLOOR;
            let liquid = Liquid::new(&rig, &places(jitter), |x| acid(height(x)) as f32);
            rows(&rig, view, &image, behind as f32, &liquid)
        };
        // Glass and liquid keep the same share of the panel's light: so a level stands for a height.
        let plain = with(&uniform, 0.0);
        let scale: Vec<(f64, f64)> = (0..plain.len())
            .filter_map(|y| Some((plain[y], arrives(slopes[y], behind, &uniform)?)))
            .collect();
        assert!(scale.len() > 80, "{}", scale.len());
        // However particles lie, mixed liquid bends no light: 0.01 of light is 1 mm at the panel.
        let shaken = with(&uniform, 0.3);
        for (y, (a, b)) in plain.iter().zip(&shaken).enumerate() {
            if arrives(slopes[y], behind, &uniform).is_some() {
                assert!((a - b).abs() < 0.01, "row {y}: {a} {b}");
            }
        }
        for (name, acid) in gradients {
            let bends = with(acid, 0.0);
            let (mut squares, mut furthest, mut count) = (0.0, 0.0_f64, 0);
            for (y, level) in bends.iter().enumerate() {
                let (Some(bent), Some(straight)) = (
                    arrives(slopes[y], behind, acid),
                    arrives(slopes[y], behind, &uniform),
                ) else {
                    continue;
                };
                let Some(pair) = scale
                    .windows(2)
                    .find(|pair| (pair[0].0 - level) * (pair[1].0 - level) <= 0.0)
                else {
                    continue;
                };
                let share = (level - pair[0].0) / (pair[1].0 - pair[0].0 + 1e-12);
                let found = pair[0].1 + share * (pair[1].1 - pair[0].1);
                let pixels = 1.0 / (pixel * (EYE.y + behind));
                squares += ((found - bent) * pixels).powi(2);
                furthest = furthest.max(((bent - straight) * pixels).abs());
                count += 1;
            }
            let off = (squares / f64::from(count)).sqrt();
            eprintln!("{name}, {behind} m behind: {off:.2} pixels of {furthest:.1}, {count} rows");
            assert!(count > 30 && furthest > 8.0, "{name}: {count} {furthest}");
            assert!(off < 0.12 * furthest, "{name}: {off} of {furthest}");
        }
    }
}

/// Without the tints both liquids are clear: of red light 40 mm of water keep 98.9 % (Pope and Fry), of other light more. Before them
/// stands glass, which mirrors some 4 % of some of the room at each face.
#[test]
fn untinted_liquids_are_clear() {
    let rig = tank();
    let image = image(&rig);
    let eye = FOOT + Vec3::new(0.0, EYE.x as f32, EYE.y as f32);
    let view = View::look_at(eye, eye - Vec3::Z, Fov::symmetric(0.12, 4.0 / 3.0));
    let middle = 4 * (EXTENT[1] / 2 * EXTENT[0] + EXTENT[0] / 2) as usize;
    let [water, acid] = [0.0, 1.0].map(|acid| {
        let liquid = Liquid::new(&rig, &places(0.0), |_| acid);
        let picture = seen(&rig, view, &image, 0.06, &liquid);
        [0, 1, 2].map(|channel| linear(picture[middle + channel]))
    });
    // The panel's middle.
    for (channel, level) in [127, 127, 77].into_iter().enumerate() {
        let (water, acid) = (water[channel], acid[channel]);
        assert!(water > 0.9 * linear(level), "{channel}: {water}");
        assert!(
            (water / acid - 1.0).abs() < 0.05,
            "{channel}: {water} {acid}"
        );
    }
}
