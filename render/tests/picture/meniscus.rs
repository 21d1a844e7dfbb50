//! The meniscus at a vessel's wall, against Young and Laplace's equation integrated in f64: a panel under a vessel is seen from above,
//! through a surface that climbs its wall.

use crate::liquid::{Liquid, clear_rig, draw, frame, upright_cylinder};
use crate::panel::image;
use crate::rig::{cylinder, linear, ray};
use glam::{Affine3A, Quat, Vec3};
use std::f64::consts::FRAC_PI_2;
use vitriol_render::{Fov, FrameDesc, Panel, View};

const EXTENT: [u32; 2] = [320, 240];
const RADIUS: f64 = 0.02;
const FLOOR: f64 = 0.0002;
const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);
/// The eye, and the panel below, from the foot, m; and the panel's side.
const EYE: f64 = 0.3;
const BELOW: f64 = 0.004;
const SIDE: f32 = 0.06;
/// Layers of particles.
const LAYERS: usize = 5;
const WATER: f64 = 1.333;
/// Share of light from below that a level surface of water lets through.
const PASSES: f64 = 0.98;
/// √(σ/(ρ g)) of water at 20 °C, m; the contact angle.
const CAPILLARY: f64 = 0.00273;
const CONTACT: f64 = std::f64::consts::FRAC_PI_6;

/// Slopes (rad) by the distance from an upright wall, each 1 µm: z'' = z (1 + z'²)^(3/2) / a², from far out, where z dies down, until the
/// wall's contact angle is reached.
fn slopes() -> Vec<f64> {
    let step = 1e-6;
    let bend = |z: f64, rise: f64| z * (1.0 + rise * rise).powf(1.5) / (CAPILLARY * CAPILLARY);
    let (mut z, mut rise) = (1e-7, 1e-7 / CAPILLARY);
    let mut found = Vec::new();
    while rise.atan() < FRAC_PI_2 - CONTACT {
        found.push(rise.atan());
        // Half a step on, of both.
        let (half, steeper) = (z + 0.5 * step * rise, rise + 0.5 * step * bend(z, rise));
        z += step * steeper;
        rise += step * bend(half, steeper);
    }
    found.reverse();
    found
}

/// Where a ray from above that meets the surface at `across` from the axis comes to the panel: refracted by the meniscus, mirrored by the
/// wall where it meets that, and refracted at the floor.
fn arrives(across: f64, height: f64, slope: f64) -> f64 {
    let down = (across / (EYE - FLOOR - height)).atan();
    // Angles from straight down, outwards; the surface's normal leans inwards by its slope.
    let inside = ((down - slope).sin() / WATER).asin() + slope;
    let mut at = across + height * inside.tan();
    let mut out = (WATER * inside.sin()).asin();
    if at > RADIUS {
        (at, out) = (2.0 * RADIUS - at, -out);
    }
    at + BELOW * out.tan()
}

#[test]
fn a_meniscus_is_young_and_laplaces() {
    let mut rig = clear_rig(EXTENT);
    rig.set_vessels(vec![cylinder([RADIUS, RADIUS + 0.002], FLOOR, 0.04)]);
    let places = upright_cylinder(FOOT + Vec3::Y * FLOOR as f32, 0.0205, LAYERS);
    let liquid = Liquid::new(&rig, &places, |_| 0.0);
    let image = image(&rig);
    let eye = FOOT + Vec3::Y * EYE as f32;
    let downwards = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let view = View {
        stage_from_eye: Affine3A::from_rotation_translation(downwards, eye),
        fov: Fov::symmetric(0.12, 4.0 / 3.0),
    };
    let vessels = [Affine3A::from_translation(FOOT)];
    let middle = FOOT - Vec3::Y * BELOW as f32 + Vec3::Y * FLOOR as f32;
    let (picture, surfaces) = draw(
        &rig,
        &FrameDesc {
            panel: Some(Panel {
                image: &image,
                stage_from_panel: Affine3A::from_rotation_translation(downwards, middle),
                size: [SIDE; 2],
            }),
            ..frame(&[view], &vessels, &liquid)
        },
    );
    assert_eq!(surfaces.len(), 1);
    let slopes = slopes();
    let row = EXTENT[1] / 2;
    let across = |x: u32, depth: f64| {
        let along = ray(&view, EXTENT, x, row);
        depth * along.x / along.y
    };
    let depth = |x: u32| f64::from(surfaces[0].depth[(row * EXTENT[0] + x) as usize]);
    // Red grows to the right; blue is even, and shows what the surface mirrors.
    let red_from = |x: u32| {
        let at = 4 * (row * EXTENT[0] + x) as usize;
        let level = |channel: usize| linear(picture.colour[0][at + channel]);
        let red = (level(0) - level(2)) / PASSES + linear(77);
        let encoded = 1.055 * red.max(0.0).powf(1.0 / 2.4) - 0.055;
        (0.5 - encoded) * f64::from(SIDE)
    };
    // The left half, whose meniscus mirrors no window.
    let (mut flat, mut bent) = (Vec::new(), Vec::new());
    for x in 2..EXTENT[0] / 2 {
        let place = across(x, depth(x));
        let gap = RADIUS - place;
        // The particles' own surface is not level near the wall.
        let [before, after] = [x - 2, x + 2].map(|x| (across(x, depth(x)), depth(x)));
        let own = ((after.1 - before.1) / (before.0 - after.0)).atan();
        let slope = own + slopes.get((gap / 1e-6) as usize).unwrap_or(&0.0);
        let height = EYE - FLOOR - depth(x);
        let pair = (red_from(x), arrives(place, height, slope));
        // Nearer than a particle the lattice itself ends.
        if (0.002..0.008).contains(&gap) {
            bent.push((pair, arrives(place, height, own)));
        } else if (0.011..0.018).contains(&gap) {
            flat.push(pair);
        }
    }
    assert!(flat.len() > 30 && bent.len() > 30);
    // In the middle, without a meniscus, a colour's place is calibrated: the share of light that the surface keeps is not exactly known.
    let mean =
        |of: &dyn Fn(&(f64, f64)) -> f64| flat.iter().map(of).sum::<f64>() / flat.len() as f64;
    let (found, expected) = (mean(&|pair| pair.0), mean(&|pair| pair.1));
    let scale = mean(&|pair| (pair.0 - found) * (pair.1 - expected))
        / mean(&|pair| (pair.0 - found).powi(2));
    assert!((scale - 1.0).abs() < 0.05, "{scale}");
    let (mut squares, mut furthest) = (0.0, 0.0_f64);
    for ((colour, meets), without) in &bent {
        let seen = expected + scale * (colour - found);
        squares += (seen - meets).powi(2);
        furthest = furthest.max((meets - without).abs());
    }
    let count = bent.len();
    let off = (squares / count as f64).sqrt();
    eprintln!("off by {off} m of {furthest}, {count} pixels");
    assert!(furthest > 0.0015, "{furthest}");
    assert!(off < 0.1 * furthest, "{off} of {furthest}");
}
