//! Bubbles in a tank, seen from above, against rays that are followed in f64 by Snell's and Fresnel's laws, with every bubble tried.

use crate::liquid::{Liquid, SPACING, clear_rig, draw, frame, rig};
use crate::rig::{Picture, Rig, displayed, linear, ray};
use glam::{Affine3A, DVec3, Vec3};
use vitriol_gpu::Buffer;
use vitriol_render::{BoxDesc, Fov, FrameDesc, SceneDesc, SurfaceFilter, VesselDesc, View};
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
        vessels: vec![tank(1.0)],
        table,
        room,
        ..SceneDesc::default()
    });
}

/// The tank in a scene whose unit is drawn as so many metres.
fn tank(unit: f64) -> VesselDesc {
    let outline = |points: [[f64; 2]; 3]| points.map(|[r, y]| [r / unit, y / unit]).to_vec();
    let thick = RADIUS + 0.002;
    VesselDesc {
        inner: outline([[0.0, INNER_FLOOR], [RADIUS, INNER_FLOOR], [RADIUS, 0.05]]),
        outer: outline([[0.0, 0.0], [thick, 0.0], [thick, 0.05]]),
        ..VesselDesc::default()
    }
}

fn origin() -> DVec3 {
    FOOT.as_dvec3() + DVec3::Y * INNER_FLOOR
}

/// The tank's liquid with these bubbles, in a scene whose unit is drawn as so many metres.
fn liquid(rig: &Rig, balls: &[Ball], unit: f32) -> Liquid {
    let mut places = Vec::new();
    for n in 0..12 * 24 * 24 {
        let [x, y, z] = [n % 24, n / 576, n / 24 % 24];
        let at = SPACING * Vec3::new(x as f32 - 11.5, y as f32 + 0.5, z as f32 - 11.5);
        if f64::from(at.with_y(0.0).length()) < RADIUS - 0.4 * f64::from(SPACING) {
            places.push(origin().as_vec3() + at);
        }
    }
    let mut liquid = Liquid::in_units(rig, &places, |_| 0.0, unit);
    let bubbles: Vec<_> = balls
        .iter()
        .map(|&(middle, radius)| Bubble {
            position: ((origin() + middle).as_vec3() / unit).to_array(),
            radius: radius as f32 / unit,
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
    drawn_in_units(rig, balls, 1.0)
}

fn drawn_in_units(rig: &Rig, balls: &[Ball], unit: f32) -> Picture {
    let vessels = [Affine3A::from_translation(FOOT / unit)];
    let (views, liquid) = ([above()], liquid(rig, balls, unit));
    let frame = FrameDesc {
        length_scale: unit,
        ..frame(&views, &vessels, &liquid)
    };
    draw(rig, &frame).0
}

/// Snell's law: the direction behind a face whose normal is on the ray's side; `None` for total reflection.
fn bent(way: DVec3, normal: DVec3, from: f64, to: f64) -> Option<DVec3> {
    let along = way.dot(normal);
    let across = (way - along * normal) * (from / to);
    let rest = 1.0 - across.length_squared();
    (rest > 0.0).then(|| across - rest.sqrt() * normal)
}

/// Where a ray of the picture enters the liquid and its direction there, from the tank's middle.
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

/// Bubbles of 0.5 to 4.5 mm all over the tank.
fn all_over() -> Vec<Ball> {
    let lot = |n: u32| f64::from(n.wrapping_mul(2_654_435_769) >> 8) / f64::from(1 << 24);
    (0..70)
        .map(|n| {
            let radius = 5e-4 * (1.0 + 8.0 * lot(4 * n).powi(2));
            let (angle, out) = (6.3 * lot(4 * n + 1), 0.022 * lot(4 * n + 2).sqrt());
            let up = radius + (DEPTH - 2.5 * radius) * lot(4 * n + 3);
            (DVec3::new(out * angle.cos(), up, out * angle.sin()), radius)
        })
        .collect()
}

/// A scene whose unit is drawn as 5 cm, and one drawn at twice its size, have the same bubbles and foam at the same pixels as one at real
/// size.
#[test]
fn bubbles_are_seen_at_every_scale() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let mut balls = all_over();
    let half_out = |x: f64, z: f64| (DVec3::new(x, DEPTH, z), 0.005);
    balls.extend([half_out(0.010, 0.004), half_out(-0.008, -0.009)]);
    let mut pictures = [1.0, 0.05, 2.0].map(|unit: f32| {
        rig.set_vessels(vec![tank(unit.into())]);
        [&[][..], &balls].map(|balls| drawn_in_units(&rig, balls, unit))
    });
    let [[plain, real], others @ ..] = &mut pictures;
    let differ = |a: &Picture, b: &Picture, levels: u8| -> usize {
        let pairs = a.colour[0].chunks_exact(4).zip(b.colour[0].chunks_exact(4));
        let apart = |a: &[u8], b: &[u8]| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max();
        pairs.filter(|(a, b)| apart(a, b) > Some(levels)).count()
    };
    let seen = differ(plain, real, 3);
    assert!(seen > 3000, "{seen} pixels of bubbles");
    for [other_plain, other] in others {
        // Rays may pass an edge on either side by rounding, and the light behind it is far from that beside it.
        let of_liquid = differ(plain, other_plain, 3);
        let of_bubbles = differ(real, other, 3);
        eprintln!("{of_bubbles} of {seen} pixels differ, {of_liquid} without bubbles");
        assert!(of_bubbles * 100 <= seen, "{of_bubbles} of {seen}");
    }
}

/// Among bubbles all over the tank, beyond the radius over n a bubble mirrors all light, and its ring differs from the liquid; beside all
/// of them nothing differs.
#[test]
fn rays_find_the_bubbles_that_they_meet_and_no_others() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    scene(&mut rig, None, None);
    let balls = all_over();
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

/// Where a ray of the picture comes to the height of the table's top, through a ball or past it.
fn ends(x: u32, y: u32, ball: Option<Ball>) -> Option<DVec3> {
    let (mut at, mut way) = entered(x, y);
    if let Some((middle, radius)) = ball {
        let along = (middle - at).dot(way);
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
    let table = f64::from(FOOT.y) + INNER_FLOOR - TABLE;
    (out.y < -0.3).then(|| under + out * (table / -out.y))
}

/// Height of the table's top, m, well under the tank.
const TABLE: f64 = 0.62;

/// Through a bubble the table's edge is seen where Snell's law at its two faces, at the surface and under the base puts it: the bubble is
/// a lens that diverges.
#[test]
fn a_bubble_is_a_lens() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let room = BoxDesc {
        min: Vec3::new(-2.0, 0.0, -2.0),
        max: Vec3::new(2.0, 2.7, 2.0),
    };
    let radius = 0.007;
    for edge in [0.012, 0.035, 0.045] {
        let table = BoxDesc {
            min: Vec3::new(edge as f32, TABLE as f32 - 1e-4, -1.0),
            max: Vec3::new(0.5, TABLE as f32, 0.2),
        };
        scene(&mut rig, Some(table), Some(room));
        let mut apart = Vec::new();
        // Under a particle, and between two.
        for phase in [0.0, 0.5] {
            let middle = f64::from(SPACING) * (phase - 3.0);
            let ball = (DVec3::new(middle, 0.014, 0.002), radius);
            let bubbly = drawn(&rig, &[ball]);
            // Vapour has not water's tint, of which 60 mm let 40 % of red light through.
            let red = |x: u32, y: u32| {
                let (at, way) = entered(x, y);
                let chord = 2.0 * (radius.powi(2) - miss(at, way, ball.0).powi(2)).sqrt();
                let level = bubbly.colour[0][4 * (y * EXTENT[0] + x) as usize];
                linear(level) * 0.40_f64.powf(chord / 0.06)
            };
            for y in 124..=136 {
                let inside = |x: &u32| {
                    let (at, way) = entered(*x, y);
                    miss(at, way, ball.0) < 0.45 * radius
                };
                let row: Vec<u32> = (0..EXTENT[0]).filter(inside).collect();
                let Some(&[first, last]) =
                    row.first().zip(row.last()).map(|(a, b)| [*a, *b]).as_ref()
                else {
                    panic!("row {y} passes by the bubble");
                };
                // Half way between the light of floor and table at either end.
                let between = 0.5 * (red(first, y) + red(last, y));
                let crossing = |beyond: &dyn Fn(u32) -> bool| {
                    row.iter().position(|&x| beyond(x)).unwrap() as f64
                };
                let seen = crossing(&|x| red(x, y) > between);
                let wanted = crossing(&|x| ends(x, y, Some(ball)).is_none_or(|end| end.x > edge));
                let straight = row.iter().filter_map(|&x| ends(x, y, None));
                assert!(straight.fold(f64::MIN, |most, end| most.max(end.x)) < edge);
                apart.push(seen - wanted);
            }
        }
        let mean = apart.iter().sum::<f64>() / apart.len() as f64;
        eprintln!("edge at {edge} m: seen {mean} pixels beside its place");
        assert!(mean.abs() < 0.5, "{edge} m: {mean} pixels, {apart:?}");
    }
}

/// Red light of a level hemisphere's floor and of its zenith, as the room has them without walls.
const LIGHT: [f64; 2] = [0.24, 0.52];

/// Red light from a direction with the upward part `up`.
fn sky(up: f64) -> f64 {
    LIGHT[0] + (LIGHT[1] - LIGHT[0]) * (0.5 + 0.5 * up)
}

/// Fresnel's share of unpolarised light, by the angles before and behind a face.
fn mirrored(cosine: f64, from: f64, to: f64) -> f64 {
    let before = cosine.acos();
    let sine = before.sin() * from / to;
    if sine >= 1.0 {
        return 1.0;
    }
    let behind = sine.asin();
    if before < 1e-6 {
        return ((from - to) / (from + to)).powi(2);
    }
    let s = (before - behind).sin() / (before + behind).sin();
    let p = (before - behind).tan() / (before + behind).tan();
    0.5 * (s * s + p * p)
}

/// A bubble half out of the liquid is a film, which mirrors at both faces, over a hollow of its own shape.
#[test]
fn foam_is_a_film_over_a_hollow() {
    let mut rig = clear_rig(EXTENT);
    scene(&mut rig, None, None);
    let (middle, radius) = (DVec3::new(0.002, DEPTH, -0.001), 0.008);
    let picture = drawn(&rig, &[(middle, radius)]);
    let view = above();
    let eye = view.stage_from_eye.translation.as_dvec3() - origin();
    let (mut compared, mut sum, mut worst) = (0, 0.0, 0.0_f64);
    for y in 0..EXTENT[1] {
        for x in 0..EXTENT[0] {
            let way = ray(&view, EXTENT, x, y);
            let along = (middle - eye).dot(way);
            let apart = miss(eye, way, middle);
            // Film and hollow show the window towards it and away from it: compared aside of that, and not where a pixel has film in part.
            let at = eye + way * along - middle;
            let to_window = DVec3::new(-0.905, 0.0, 0.425).dot(at);
            if !(0.1 * radius..0.92 * radius).contains(&apart) || to_window.abs() > 0.4 * apart {
                continue;
            }
            let half = (radius * radius - apart * apart).sqrt();
            let film = eye + way * (along - half);
            let outward = (film - middle) / radius;
            let face = mirrored(-way.dot(outward), 1.0, INDEX);
            let kept = 1.0 - 2.0 * face / (1.0 + face);
            let reflect = |way: DVec3, normal: DVec3| way - 2.0 * way.dot(normal) * normal;
            let hollow = (middle - (eye + way * (along + half))) / radius;
            let surface = mirrored(-way.dot(hollow), 1.0, INDEX);
            let within = bent(way, hollow, 1.0, INDEX).unwrap();
            let Some(out) = bent(within, DVec3::Y, INDEX, 1.0) else {
                continue;
            };
            let under = (1.0 - surface) * sky(out.y) + surface * sky(reflect(way, hollow).y);
            let all = kept * under + (1.0 - kept) * sky(reflect(way, outward).y);
            let level = picture.colour[0][4 * (y * EXTENT[0] + x) as usize];
            let off = linear(level) - displayed(all);
            compared += 1;
            sum += off;
            worst = worst.max(off.abs());
        }
    }
    let mean = sum / f64::from(compared);
    eprintln!("{compared} pixels, off by {mean} on the mean, {worst} at worst");
    // Water takes 1 % of red on that way, and the hollow's faces lie in a surface of particles.
    assert!(compared > 200 && mean.abs() < 0.006 && worst < 0.01);
}

/// Through one layer of bubbles one sees the table's edge. Through five it is white, and the same wherever a ray would have gone.
#[test]
fn many_bubbles_are_white_and_even() {
    let mut rig = clear_rig(EXTENT);
    let table = BoxDesc {
        min: Vec3::new(0.0, TABLE as f32 - 1e-4, -1.0),
        max: Vec3::new(0.5, TABLE as f32, 0.2),
    };
    let room = BoxDesc {
        min: Vec3::new(-2.0, 0.0, -2.0),
        max: Vec3::new(2.0, 2.7, 2.0),
    };
    scene(&mut rig, Some(table), Some(room));
    // Middle value, and the share of pixels within 0.02 of it, in the tank's middle.
    let seen = |layers: u32| {
        let balls: Vec<Ball> = (0..layers * 81)
            .map(|n| {
                let [x, y, z] = [n % 9, n / 81, n / 9 % 9].map(f64::from);
                let aside = 0.5 * (y % 2.0) - 4.0;
                let at = DVec3::new(x + aside, 0.0, z + aside) * 0.005;
                (at + DVec3::Y * (DEPTH - 0.0035 - 0.005 * y), 0.00255)
            })
            .filter(|ball| ball.0.with_y(0.0).length() < 0.025)
            .collect();
        let picture = drawn(&rig, &balls);
        let mut found = Vec::new();
        for y in 80..160 {
            for x in 120..200 {
                found.push(linear(picture.colour[0][4 * (y * EXTENT[0] + x) as usize]));
            }
        }
        found.sort_by(f64::total_cmp);
        let middle = found[found.len() / 2];
        let even = found
            .iter()
            .filter(|it| (*it - middle).abs() < 0.02)
            .count();
        (middle, even as f64 / found.len() as f64)
    };
    let ((one, broken), (white, even)) = (seen(1), seen(5));
    eprintln!("one layer {one}, {broken} of it even; five {white}, {even}");
    assert!(broken < 0.5, "{broken}");
    assert!(even > 0.85, "{even}");
    assert!(white > one + 0.1, "{one} {white}");
}
