//! Bubbles in a tank, seen from above, against rays that are followed in f64 by Snell's and Fresnel's laws, with every bubble tried.

use crate::liquid::{Liquid, SPACING, draw, frame, rig};
use crate::rig::{Picture, Rig, linear, ray};
use glam::{Affine3A, DVec3, Vec3};
use vitriol_gpu::Buffer;
use vitriol_render::{BoxDesc, Fov, SceneDesc, SurfaceFilter, VesselDesc, View};
use vitriol_shaders::layout::Bubble;

const EXTENT: [u32; 2] = [320, 240];
const INDEX: f64 = 1.333;
/// Radius of the tank and its liquid's depth, m.
const RADIUS: f64 = 0.03;
const DEPTH: f64 = 12.0 * SPACING as f64;
const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);
const INNER_FLOOR: f64 = 0.002;
/// How uneven the surface of a lattice of particles is, m at the bottom: normals that are off by 1° bend a ray by a third of that.
const UNEVEN: f64 = 3e-4;

/// A ball of vapour: its middle from the middle of the tank's inner floor, and its radius, m.
type Ball = (DVec3, f64);

fn scene(rig: &mut Rig, table: Option<BoxDesc>, room: Option<BoxDesc>) {
    rig.set_scene(&SceneDesc {
        vessels: vec![VesselDesc {
            inner: vec![[0.0, INNER_FLOOR], [RADIUS, INNER_FLOOR], [RADIUS, 0.05]],
            outer: vec![[0.0, 0.0], [RADIUS + 0.002, 0.0], [RADIUS + 0.002, 0.05]],
            marks: Vec::new(),
        }],
        table,
        room,
    });
}

fn origin() -> DVec3 {
    FOOT.as_dvec3() + DVec3::Y * INNER_FLOOR
}

/// The tank's liquid with these bubbles.
fn liquid(rig: &Rig, balls: &[Ball]) -> Liquid {
    let mut places = Vec::new();
    for n in 0..12 * 24 * 24 {
        let [x, y, z] = [n % 24, n / 576, n / 24 % 24];
        let at = SPACING * Vec3::new(x as f32 - 11.5, y as f32 + 0.5, z as f32 - 11.5);
        if f64::from(at.with_y(0.0).length()) < RADIUS - 0.4 * f64::from(SPACING) {
            places.push(origin().as_vec3() + at);
        }
    }
    let mut liquid = Liquid::new(rig, &places, |_| 0.0);
    let bubbles: Vec<_> = balls
        .iter()
        .map(|&(middle, radius)| Bubble {
            position: (origin() + middle).as_vec3().to_array(),
            radius: radius as f32,
            mass: 1.0,
            ..Bubble::default()
        })
        .collect();
    let bytes = size_of_val(&bubbles[..]).max(size_of::<Bubble>());
    let buffer = Buffer::storage(&rig.gpu, "bubbles", bytes as u64).unwrap();
    rig.gpu.write(&buffer, &bubbles).unwrap();
    liquid.bubbles = Some((buffer, bubbles.len() as u32));
    liquid
}

fn above() -> View {
    let eye = origin().as_vec3() + Vec3::new(0.0, 0.3, 0.0);
    let down = Vec3::new(0.0, -1.0, -1e-3);
    View::look_at(eye, eye + down, Fov::symmetric(0.19, 4.0 / 3.0))
}

fn drawn(rig: &Rig, balls: &[Ball]) -> Picture {
    let vessels = [Affine3A::from_translation(FOOT)];
    draw(rig, &frame(&[above()], &vessels, &liquid(rig, balls))).0
}

/// Snell's law: the direction behind a face whose normal is on the ray's side; `None` for total reflection.
fn bent(way: DVec3, normal: DVec3, from: f64, to: f64) -> Option<DVec3> {
    let along = way.dot(normal);
    let across = (way - along * normal) * (from / to);
    let rest = 1.0 - across.length_squared();
    (rest > 0.0).then(|| across - rest.sqrt() * normal)
}

/// Where a ray of the picture goes on in the liquid, from the tank's middle.
fn entered(x: u32, y: u32) -> (DVec3, DVec3) {
    let view = above();
    let way = ray(&view, EXTENT, x, y);
    let eye = view.stage_from_eye.translation.as_dvec3() - origin();
    let at = eye + way * (DEPTH - eye.y) / way.y;
    (at, bent(way, DVec3::Y, 1.0, INDEX).unwrap())
}

/// How far a ray passes from a ball's middle, if it comes to it.
fn miss(at: DVec3, way: DVec3, middle: DVec3) -> f64 {
    (middle - at).reject_from(way).length()
}

/// Bubbles of 0.5 to 4.5 mm all over the tank. Beyond the radius over n a bubble mirrors all, and its ring differs from the liquid; beside all of them
/// nothing does.
#[test]
fn rays_find_the_bubbles_that_they_meet_and_no_others() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    scene(&mut rig, None, None);
    let lot = |n: u32| f64::from(n.wrapping_mul(2_654_435_769) >> 8) / f64::from(1 << 24);
    let balls: Vec<Ball> = (0..70)
        .map(|n| {
            let radius = 5e-4 * (1.0 + 8.0 * lot(4 * n).powi(2));
            let (angle, out) = (6.3 * lot(4 * n + 1), 0.022 * lot(4 * n + 2).sqrt());
            let up = radius + (DEPTH - 2.5 * radius) * lot(4 * n + 3);
            (DVec3::new(out * angle.cos(), up, out * angle.sin()), radius)
        })
        .collect();
    let [plain, bubbly] = [drawn(&rig, &[]), drawn(&rig, &balls)];
    let differs = |index: usize| {
        let levels = |picture: &Picture| picture.colour[0][4 * index..][..3].to_vec();
        let pairs = levels(&plain).into_iter().zip(levels(&bubbly));
        pairs.map(|(a, b)| a.abs_diff(b)).max().unwrap() > 3
    };
    let (mut rings, mut unseen, mut beside, mut wrong) = (0, 0, 0, 0);
    for y in 0..EXTENT[1] {
        for x in 0..EXTENT[0] {
            let (at, way) = entered(x, y);
            let under = at + way * (at.y / -way.y);
            if at.with_y(0.0).length() > 0.024 || under.with_y(0.0).length() > 0.024 {
                continue;
            }
            let index = (y * EXTENT[0] + x) as usize;
            let nearest = |ball: &&Ball| miss(at, way, ball.0) < ball.1 + UNEVEN;
            let mut met: Vec<&Ball> = balls.iter().filter(nearest).collect();
            met.sort_by(|a, b| b.0.y.total_cmp(&a.0.y));
            if met.is_empty() {
                beside += 1;
                wrong += i32::from(differs(index));
            } else if let [(middle, radius)] = met[..] {
                let apart = miss(at, way, *middle);
                if apart > radius / INDEX + 0.5 * UNEVEN && apart < radius - 0.5 * UNEVEN {
                    rings += 1;
                    unseen += i32::from(!differs(index));
                }
            }
        }
    }
    eprintln!(
        "{unseen} of {rings} pixels of rings unseen, {wrong} of {beside} beside bubbles differ"
    );
    assert!(rings > 150 && beside > 3000);
    assert!(unseen * 100 <= rings, "{unseen} of {rings}");
    // Light that was mirrored at a bubble may come out beside it, through another's face.
    assert_eq!(wrong, 0);
}

/// Through a bubble the table's edge is seen where Snell's law at its two faces, at the surface and under the base puts it: a lens that diverges.
#[test]
fn a_bubble_is_a_lens() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let edge = 0.012_f64;
    let table = BoxDesc {
        min: Vec3::new(edge as f32, 0.5, -1.0),
        max: Vec3::new(0.5, 0.62, 0.2),
    };
    let room = BoxDesc {
        min: Vec3::new(-2.0, 0.0, -2.0),
        max: Vec3::new(2.0, 2.7, 2.0),
    };
    scene(&mut rig, Some(table), Some(room));
    let ball = (DVec3::new(-0.008, 0.014, 0.002), 0.007);
    let [plain, bubbly] = [drawn(&rig, &[]), drawn(&rig, &[ball])];
    let red = |picture: &Picture, index: usize| linear(picture.colour[0][4 * index]);
    // Where a ray comes to the height of the table's top, through the ball or not.
    let ends = |x: u32, y: u32, through: bool| -> Option<DVec3> {
        let (mut at, mut way) = entered(x, y);
        if through {
            let (middle, radius) = ball;
            let to_middle = middle - at;
            let along = to_middle.dot(way);
            let half = (radius * radius - miss(at, way, middle).powi(2))
                .max(0.0)
                .sqrt();
            at += way * (along - half);
            let inside = bent(way, (at - middle) / radius, INDEX, 1.0)?;
            at += inside * (2.0 * (middle - at).dot(inside));
            way = bent(inside, (middle - at) / radius, 1.0, INDEX)?;
        }
        let under = at + way * (at.y / -way.y);
        let out = bent(way, DVec3::Y, INDEX, 1.0)?;
        (out.y < -0.3).then(|| under + out * ((f64::from(FOOT.y) + INNER_FLOOR - 0.62) / -out.y))
    };
    // What table and floor send up there, without a bubble: means of what the plain picture has.
    let mut sums = [(0.0, 0.0); 2];
    for y in 60..180 {
        for x in 60..260 {
            let Some(end) = ends(x, y, false) else {
                continue;
            };
            if (end.x - edge).abs() > 0.002 {
                let side = &mut sums[usize::from(end.x > edge)];
                *side = (
                    side.0 + red(&plain, (y * EXTENT[0] + x) as usize),
                    side.1 + 1.0,
                );
            }
        }
    }
    let [floor, table] = sums.map(|(sum, count)| sum / count);
    assert!(table > 1.3 * floor, "{table} and {floor}");
    let (mut right, mut all, mut otherwise) = (0, 0, 0);
    for y in 0..EXTENT[1] {
        for x in 0..EXTENT[0] {
            let (at, way) = entered(x, y);
            if miss(at, way, ball.0) > 0.5 * ball.1 {
                continue;
            }
            let (Some(end), Some(straight)) = (ends(x, y, true), ends(x, y, false)) else {
                continue;
            };
            // A pixel's edge is smoothed over the next, and from pixel to pixel the lens goes on by 5 mm.
            if (end.x - edge).abs() < 0.008 {
                continue;
            }
            // Vapour has not water's tint, of which 60 mm let 40 % of red light through.
            let chord = 2.0 * (ball.1.powi(2) - miss(at, way, ball.0).powi(2)).sqrt();
            let dimmed = red(&bubbly, (y * EXTENT[0] + x) as usize) * 0.40_f64.powf(chord / 0.06);
            let seen = dimmed > 0.5 * (table + floor);
            all += 1;
            right += i32::from(seen == (end.x > edge));
            otherwise += i32::from((straight.x > edge) != (end.x > edge));
        }
    }
    eprintln!("{right} of {all} pixels right, {otherwise} of them bent over the edge");
    assert!(otherwise > 100, "{otherwise}");
    assert!(right * 100 >= all * 98, "{right} of {all}");
}
