//! The window's light on the bench under a vessel of water against rays in f64, and the reflection at the vessel's base against Snell's
//! law.

use crate::liquid::{Liquid, SPACING, clear_rig, draw, frame, rig, upright_cylinder};
use crate::rig::{Picture, cylinder, displayed, linear, ray};
use glam::{Affine3A, DVec2, DVec3, Vec3};
use std::f64::consts::TAU;
use vitriol_render::{Fov, SceneDesc, SurfaceFilter, VesselDesc, View};

const EXTENT: [u32; 2] = [320, 240];
/// Radius of the water, and of the glass, m.
const RADIUS: f64 = 0.02;
const OUTER: f64 = 0.022;
const TOP: f32 = 0.75;
const INDEX: f64 = 1.333;
const GLASS: f64 = 1.47;

/// A cylinder with a base of that thickness, and water in it up to that many layers of particles.
fn beaker(base: f64) -> VesselDesc {
    cylinder([RADIUS, OUTER], base, 0.06)
}

fn water(foot: Vec3, base: f64, layers: usize) -> Vec<Vec3> {
    upright_cylinder(foot + Vec3::Y * base as f32, 0.0193, layers)
}

/// The light that a picture shows as `shown`: the tone mapping, undone.
fn undone(shown: f64) -> f64 {
    let mut ends = [0.0, 40.0];
    for _ in 0..60 {
        let light = 0.5 * (ends[0] + ends[1]);
        ends[usize::from(displayed(light) > shown)] = light;
    }
    ends[0]
}

/// Mean green light of 7 × 7 pixels about where a place is seen.
fn green(picture: &Picture, view: &View, at: Vec3) -> f64 {
    let clip = view.clip_from_scaled(1.0).project_point3(at);
    let middle = [clip.x * 160.0 + 160.0, clip.y * 120.0 + 120.0].map(|x| x as usize);
    let mut sum = 0.0;
    for n in 0..49 {
        let (x, y) = (middle[0] + n % 7 - 3, middle[1] + n / 7 - 3);
        sum += undone(linear(picture.colour[0][4 * (y * 320 + x) + 1])) / 49.0;
    }
    sum
}

/// The window's panes: their light on a place along a direction, 1 or 0.
fn panes(from: DVec3, along: DVec3) -> f64 {
    if along.x >= 0.0 {
        return 0.0;
    }
    let at = from + (-1.6 - from.x) / along.x * along - DVec3::new(-1.6, 1.75, 0.35);
    let inside =
        at.z.abs() < 1.181 && at.y.abs() < 0.803 && at.z.abs() > 0.035 && at.y.abs() > 0.035;
    f64::from(u8::from(inside))
}

/// Share of unpolarised light that a face lets pass from air at that cosine: Fresnel's equations by sines and tangents.
fn passes(cosine: f64) -> f64 {
    let (outside, inside) = (cosine.acos(), (cosine.acos().sin() / INDEX).asin());
    let (less, more) = (outside - inside, outside + inside);
    1.0 - 0.5 * ((less.sin() / more.sin()).powi(2) + (less.tan() / more.tan()).powi(2))
}

/// Irradiance by the window of a place under water of that depth over that of the open bench: all directions of the hemisphere, each
/// followed up.
fn share(foot: DVec2, depth: f64, stage: DVec3) -> f64 {
    let (mut under, mut open) = (0.0, 0.0);
    let (heights, turns) = (120, 720);
    for n in 0..heights * turns {
        // Even in the cosine's square: each counts for the same irradiance.
        let square = (f64::from(n / turns) + 0.5) / f64::from(heights);
        let (cosine, sine) = (square.sqrt(), (1.0 - square).sqrt());
        let turn = (f64::from(n % turns) + 0.5) / f64::from(turns) * TAU;
        let along = DVec3::new(sine * turn.cos(), cosine, sine * turn.sin());
        let place = stage + DVec3::new(foot.x, 0.0, foot.y);
        open += panes(place, along);
        let mut way = DVec3::new(
            along.x / INDEX,
            (1.0 - (sine / INDEX).powi(2)).sqrt(),
            along.z / INDEX,
        );
        let mut at = DVec3::new(foot.x, 0.0, foot.y);
        let lets = passes(cosine);
        for _ in 0..40 {
            let (a, b) = (way.x.hypot(way.z).powi(2), at.x * way.x + at.z * way.z);
            let c = at.x * at.x + at.z * at.z - RADIUS * RADIUS;
            let to_wall = ((b * b - a * c).max(0.0).sqrt() - b) / a;
            let to_surface = (depth - at.y) / way.y;
            if to_surface <= to_wall {
                at += to_surface * way;
                let out = DVec3::new(way.x * INDEX, cosine, way.z * INDEX);
                under += lets * lets * panes(stage + at, out);
                break;
            }
            at += to_wall * way;
            let normal = DVec3::new(at.x, 0.0, at.z).normalize();
            let facing = way.dot(normal);
            if INDEX * (1.0 - facing * facing).sqrt() < 1.0 {
                // Out through the wall, as if it were thin.
                let level = (way - facing * normal) * INDEX;
                let out = level + (1.0 - level.length_squared()).max(0.0).sqrt() * normal;
                under += lets * lets * panes(stage + at, out);
                break;
            }
            way -= 2.0 * facing * normal;
        }
    }
    under / open
}

#[test]
fn the_bench_under_water_has_the_light_that_comes_down() {
    let rig = {
        let mut rig = clear_rig(EXTENT);
        rig.set_scene(&SceneDesc {
            vessels: vec![beaker(0.001)],
            ..SceneDesc::laboratory(Vec::new(), TOP, 1.0)
        });
        rig
    };
    let foot = Vec3::new(0.0, TOP, -0.4);
    let vessels = [Affine3A::from_translation(foot)];
    let (mut least, mut most, mut worst) = (f64::MAX, f64::MIN, 0.0_f64);
    for layers in [5, 9] {
        let depth = f64::from(SPACING) * layers as f64;
        let mut liquid = Liquid::new(&rig, &water(foot, 0.001, layers), |_| 0.0);
        liquid.table = None;
        let eye = foot + Vec3::new(0.0, 0.5, 0.001);
        let view = View::look_at(eye, foot, Fov::symmetric(0.11, 4.0 / 3.0));
        let (picture, _) = draw(&rig, &frame(&[view], &vessels, &liquid));
        for (x, z) in [
            (-0.6, 0.0),
            (0.0, 0.0),
            (0.6, 0.0),
            (0.0, 0.6),
            (0.0, -0.6),
            (0.45, -0.45),
        ] {
            let place = DVec2::new(x, z) * RADIUS;
            // A place under water is seen straight from above where it is, to some tenths of a millimetre: through its surface.
            let surface = foot + Vec3::new(place.x as f32, 0.001 + depth as f32, place.y as f32);
            let found = green(&picture, &view, surface);
            let stage = foot.as_dvec3();
            let to_window = DVec3::new(-1.6, 1.75, 0.35) - stage;
            let square = to_window.length_squared();
            let sun = 7.643 * to_window.y / square.sqrt() / (1.0 + square);
            // The sky comes down as through a plane; two faces keep 2 % each from a ray to the eye, and mirror as much of the ceiling.
            let ratio = ((found - 0.0204 * 0.55) / (0.98 * 0.33) - 0.55) / sun;
            let expected = share(place, depth, stage);
            eprintln!("{layers} layers, ({x}, {z}): {ratio:.3}, {expected:.3}");
            worst = worst.max((ratio - expected).abs() / (0.1 + 0.12 * expected));
            least = least.min(expected);
            most = most.max(expected);
        }
    }
    // The shader's window is a lobe of the same width as the real one, and has two heights: where light is gathered it is 12 % too dim,
    // and a shadow's edge is too soft.
    assert!(worst < 1.0, "{worst}");
    // Places differ widely, so no mean value would pass.
    assert!(most > least + 0.8, "{least} {most}");
}

/// From aside, the far wall ends below in the mirror of the base, at the ray that goes through it and comes back within the wall.
#[test]
fn a_base_mirrors_at_its_underside() {
    let foot = Vec3::new(0.0, TOP, -0.4);
    let vessels = [Affine3A::from_translation(foot)];
    let mut edges = Vec::new();
    for base in [0.001, 0.006] {
        let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
        rig.set_scene(&SceneDesc {
            vessels: vec![beaker(base)],
            ..SceneDesc::laboratory(Vec::new(), TOP, 1.0)
        });
        let mut liquid = Liquid::new(&rig, &water(foot, base, 12), |_| 0.0);
        liquid.table = None;
        let target = foot + Vec3::Y * (base as f32 + 0.004);
        let eye = target + Vec3::new(0.0, 0.16, 0.28);
        let view = View::look_at(eye, target, Fov::symmetric(0.08, 4.0 / 3.0));
        let (picture, _) = draw(&rig, &frame(&[view], &vessels, &liquid));
        // The row at which the bench behind gives way to the mirrored room, in the middle column.
        let shown = |y: u32| linear(picture.colour[0][4 * (y * 320 + 160) as usize + 1]);
        let step = |y: u32| (shown(y + 1) - shown(y)).abs();
        let found = (20..220).max_by(|&a, &b| step(a).total_cmp(&step(b)));
        let found = f64::from(found.unwrap()) + 1.0;

        // The ray that leaves the base's underside at its edge, followed back to the front of the glass, in the plane of the axis.
        let mut expected = f64::NAN;
        for n in 0..24_000 {
            let y = 0.01 * f64::from(n);
            let [above, below] = [0, 1].map(|row| ray(&view, EXTENT, 160, y as u32 + row));
            let along = above.lerp(below, y.fract()).normalize();
            let from = eye.as_dvec3() - foot.as_dvec3();
            let outer = from + (from.z - OUTER) / -along.z * along;
            let slope = |sine: f64| sine / (1.0 - sine * sine).sqrt();
            let in_glass = slope(-along.y / GLASS);
            let in_water = slope(-along.y / INDEX);
            // From the front wall's inner face down to the floor, then through the base, of which the vertical part is kept.
            let inner = outer.y - (OUTER - RADIUS) * in_glass;
            let to_floor = (inner - base) / in_water;
            let across = (INDEX * INDEX - along.y * along.y).sqrt()
                / (GLASS * GLASS - INDEX * INDEX + along.y * along.y).sqrt();
            let reached = to_floor + base * across - RADIUS;
            if reached < RADIUS {
                expected = y;
                break;
            }
        }
        eprintln!("{base}: {found} {expected}");
        assert!((found - expected).abs() < 2.0, "{base}: {found} {expected}");
        edges.push(found);
    }
    // A mirror at the floor would have both at the same height over it.
    assert!((edges[1] - edges[0]).abs() > 4.0, "{edges:?}");
}

/// The window in still water: seen from where Snell's mirror shows a pane, and from where it shows the wall.
#[test]
fn still_water_mirrors_the_window() {
    for furnished in [false, true] {
        let mut rig = clear_rig(EXTENT);
        rig.set_scene(&SceneDesc {
            vessels: vec![beaker(0.001)],
            furnished,
            ..SceneDesc::laboratory(Vec::new(), TOP, 1.0)
        });
        let foot = Vec3::new(0.0, TOP, -0.4);
        let vessels = [Affine3A::from_translation(foot)];
        // Up to the rim, of which nothing is before the surface.
        let mut liquid = Liquid::new(&rig, &water(foot, 0.001, 22), |_| 0.0);
        liquid.table = None;
        let surface = foot + Vec3::Y * (0.001 + 22.0 * SPACING);
        let mut cosine = 0.0;
        let found = [Vec3::new(-1.6, 2.15, 0.95), Vec3::new(-1.6, 2.15, -1.3)].map(|mirrored| {
            let towards = (mirrored - surface).normalize();
            let eye = surface + 0.3 * Vec3::new(-towards.x, towards.y, -towards.z);
            cosine = f64::from(towards.y);
            let view = View::look_at(eye, surface, Fov::symmetric(0.15, 4.0 / 3.0));
            let (picture, _) = draw(&rig, &frame(&[view], &vessels, &liquid));
            green(&picture, &view, surface)
        });
        let pane = 9.0 * (1.0 - passes(cosine));
        eprintln!("{furnished}: {found:?}, a pane {pane}");
        // Through the water the bench is seen too, at places that have half of the window's light more or less: 0.12.
        assert!(
            (found[0] - found[1] - pane).abs() < 0.15,
            "{found:?} {pane}"
        );
    }
}
