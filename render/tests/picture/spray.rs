//! Drops of spray: each hides as much of the picture as it is large, also where it is finer than a pixel.

use crate::liquid::{Liquid, MASS, draw, frame, rig};
use crate::rig::{Picture, Rig, linear};
use glam::Vec3;
use std::f64::consts::PI;
use vitriol_render::{Bone, Finish, Fov, FrameDesc, RestingDrop, SceneDesc, SurfaceFilter, View};
use vitriol_shaders::layout::{Bubble, Drops};

const EXTENT: [u32; 2] = [320, 240];
/// Distance of the flights from the eye, m, and pixels per unit of the tangent.
const DISTANCE: f32 = 0.4;
const FOCAL: f64 = 120.0 / 0.1;

fn view() -> View {
    let eye = Vec3::new(0.0, 1.0, 0.0);
    let field = 2.0 * (0.1_f32).atan();
    View::look_at(eye, eye - Vec3::Z, Fov::symmetric(field, 4.0 / 3.0))
}

/// Acid fraction of the drops.
const HALF: f32 = 0.5;
/// How far about their place drops of a jet lie, and of a film that was here, m.
const JET: f32 = 0.0;
const FILM: f32 = 0.006;

/// A picture of flights of jets: places (m, from the middle), radius of a drop (m) and number of drops in each.
fn drawn(rig: &Rig, places: &[[f32; 2]], radius: f32, number: f32) -> Picture {
    drawn_before(rig, &[], JET, places, radius, number)
}

/// A picture of flights whose drops lie `about` (m), [`JET`] or [`FILM`], behind a hand; parameters are those of [`drawn`].
fn drawn_before(
    rig: &Rig,
    hand: &[Bone],
    about: f32,
    places: &[[f32; 2]],
    radius: f32,
    number: f32,
) -> Picture {
    drawn_in(rig, &[view()], hand, about, places, (radius, number))
}

/// A picture as of [`drawn_before`], in the views `views`.
fn drawn_in(
    rig: &Rig,
    views: &[View],
    hand: &[Bone],
    about: f32,
    places: &[[f32; 2]],
    (radius, number): (f32, f32),
) -> Picture {
    drawn_with(rig, views, (hand, &[]), about, places, (radius, number))
}

/// A picture as of [`drawn_in`], with drops that rest.
fn drawn_with(
    rig: &Rig,
    views: &[View],
    (hand, resting): (&[Bone], &[RestingDrop]),
    about: f32,
    places: &[[f32; 2]],
    (radius, number): (f32, f32),
) -> Picture {
    let volume = 4.0 / 3.0 * std::f32::consts::PI * radius.powi(3);
    let mut drops = vec![Drops::default(); 2 * places.len().max(1)];
    for (n, place) in places.iter().enumerate() {
        drops[2 * n] = Drops {
            position: [place[0], 1.0 + place[1], -DISTANCE],
            velocity: [1.0, 0.0, 0.0],
            mass: number * volume * 1000.0 / MASS,
            acid: HALF * number * volume * 1000.0 / MASS,
            density: 1000.0,
            radius,
            about,
            ..Drops::default()
        };
    }
    let mut liquid = Liquid::new(rig, &[], |_| 0.0);
    let of_drops = rig.filled("drops", &drops);
    let count = places.len().max(1);
    let bubbles = rig.filled("bubbles", &vec![Bubble::default(); count]);
    liquid.bubbles = Some((bubbles, count as u32));
    liquid.drops = Some(of_drops);
    let frame = FrameDesc {
        hands: [hand, &[]],
        resting,
        ..frame(views, &[], &liquid)
    };
    draw(rig, &frame).0
}

/// Sum over the picture of the share that is hidden, pixels: `dark` is the light of a drop that fills pixels.
fn hidden(picture: &Picture, plain: &Picture) -> f64 {
    let levels = picture.colour[0].chunks(4).zip(plain.colour[0].chunks(4));
    levels
        .map(|(a, b)| (linear(a[0]) - linear(b[0])).abs())
        .sum()
}

#[test]
fn drops_hide_their_own_area() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    rig.set_scene(&SceneDesc {
        furnished: false,
        ..SceneDesc::laboratory(Vec::new(), 0.75, 1.0)
    });
    // Over many places within a pixel; apart, and not where only the window is mirrored.
    let places: Vec<[f32; 2]> = (0..180)
        .map(|n| {
            let [x, y] = [(n % 15) as f32 - 7.0, (n / 15) as f32 - 5.5];
            [0.0062 * x + 1e-5 * n as f32, 0.0061 * y]
        })
        .collect();
    let plain = drawn(&rig, &[], 0.0, 0.0);
    let of = |pixels: f64| {
        let radius = (pixels / FOCAL) as f32 * DISTANCE;
        let area = places.len() as f64 * PI * pixels * pixels;
        hidden(&drawn(&rig, &places, radius, 1.0), &plain) / area
    };
    let whole = of(4.0);
    assert!(whole > 0.02, "{whole}");
    for pixels in [0.35, 0.5, 0.8, 1.6] {
        let share = of(pixels) / whole;
        eprintln!("radius {pixels} pixels: {share} of its area");
        // Shares have 31 steps, levels 255; FXAA moves light between pixels, and does not add any.
        assert!((0.75..1.25).contains(&share), "{pixels}: {share}");
    }
}

/// Drops that rest are seen as drops are that fly there, to the last bit.
#[test]
fn drops_that_rest_are_seen_as_those_that_fly() {
    let rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let radius = (4.0 / FOCAL) as f32 * DISTANCE;
    let places = [[0.0, 0.0], [0.01, 0.004], [-0.02, 0.01]];
    let resting = places.map(|[x, y]| RestingDrop {
        position: Vec3::new(x, 1.0 + y, -DISTANCE),
        radius,
        acid: HALF,
    });
    let flies = drawn(&rig, &places, radius, 1.0);
    let rests = drawn_with(&rig, &[view()], (&[], &resting), JET, &[], (0.0, 0.0));
    let plain = drawn(&rig, &[], 0.0, 0.0);
    assert!(flies.colour[0] != plain.colour[0]);
    assert!(rests.colour[0] == flies.colour[0]);
}

/// Drops have the legend's tints, of which water lets blue through and acid red.
#[test]
fn drops_are_tinted_as_their_liquid() {
    let rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let light = |acid: f32| -> [f64; 3] {
        let resting = [RestingDrop {
            position: Vec3::new(0.0, 1.0, -DISTANCE),
            radius: (8.0 / FOCAL) as f32 * DISTANCE,
            acid,
        }];
        let picture = drawn_with(&rig, &[view()], (&[], &resting), JET, &[], (0.0, 0.0));
        // A square within it.
        let mut sum = [0.0; 3];
        for (x, y) in (116..124).flat_map(|y| (156..164).map(move |x| (x, y))) {
            let pixel = 4 * (y * EXTENT[0] as usize + x);
            for (channel, sum) in sum.iter_mut().enumerate() {
                *sum += linear(picture.colour[0][pixel + channel]);
            }
        }
        sum
    };
    let [water, acid] = [0.0, 1.0].map(light);
    // What is mirrored has no tint.
    let [red, blue] = [0, 2].map(|channel| water[channel] / acid[channel]);
    assert!(red < 0.75 && blue > 1.5, "{red} {blue}");
}

/// More flights than a workgroup takes, with empty places between them: each is where either eye sees it.
#[test]
fn every_drop_is_in_both_eyes() {
    let rig = rig(EXTENT, 2, SurfaceFilter::NarrowRange);
    let places: Vec<[f32; 2]> = (0..100)
        .map(|n| [(n % 10) as f32 - 4.5, (n / 10) as f32 - 4.5].map(|step| 0.006 * step))
        .collect();
    let field = Fov::symmetric(2.0 * (0.1_f32).atan(), 4.0 / 3.0);
    let eyes = [-0.004, 0.006].map(|x| {
        let eye = Vec3::new(x, 1.0, 0.0);
        View::look_at(eye, eye - Vec3::Z, field)
    });
    let radius = (3.0 / FOCAL) as f32 * DISTANCE;
    let plain = drawn_in(&rig, &eyes, &[], JET, &[], (0.0, 0.0));
    let picture = drawn_in(&rig, &eyes, &[], JET, &places, (radius, 1.0));
    for (n, eye) in eyes.iter().enumerate() {
        for [x, y] in &places {
            let at = Vec3::new(*x, 1.0 + y, -DISTANCE);
            let clip = eye.clip_from_scaled(1.0).project_point3(at);
            let [column, row] = [(0, clip.x), (1, clip.y)]
                .map(|(axis, place)| ((0.5 + 0.5 * place) * EXTENT[axis] as f32) as usize);
            let pixel = row * EXTENT[0] as usize + column;
            assert!(
                picture.depth[n][pixel] > plain.depth[n][pixel],
                "eye {n}: {x} {y}"
            );
        }
    }
}

#[test]
fn a_jet_is_as_many_drops_as_its_mass_says_and_they_are_where_it_broke_up() {
    let rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let radius = (3.0 / FOCAL) as f32 * DISTANCE;
    let plain = drawn(&rig, &[], 0.0, 0.0);
    for (number, seen) in [(1.0, 1), (3.0, 3), (7.0, 7), (30.0, 8)] {
        let picture = drawn(&rig, &[[0.03, 0.0]], radius, number);
        let (width, middle) = (EXTENT[0] as usize, EXTENT[1] as usize / 2);
        let differs: Vec<bool> = (0..width)
            .map(|x| {
                (middle - 12..middle + 12)
                    .any(|y| picture.depth[0][y * width + x] != plain.depth[0][y * width + x])
            })
            .collect();
        let starts: Vec<usize> = (1..differs.len())
            .filter(|&x| differs[x] && !differs[x - 1])
            .collect();
        assert_eq!(starts.len(), seen, "{number}: {starts:?}");
        // Rayleigh's 9.01 radii of the jet, in pixels; each drop is up to a fifth of that beside its place.
        let step = 3.0 * 9.01 / (0.75 * 9.01_f64).cbrt();
        for pair in starts.windows(2) {
            assert!(
                ((pair[1] - pair[0]) as f64 - step).abs() <= 0.4 * step + 1.0,
                "{starts:?}"
            );
        }
        let all = (starts[starts.len() - 1] - starts[0]) as f64;
        assert!((all - step * (starts.len() - 1) as f64).abs() <= 0.2 * step + 1.0);
    }
}

/// Columns and rows of the pixels in which pictures differ, and by how many levels.
fn changed(a: &Picture, b: &Picture) -> Vec<[f64; 3]> {
    let pixels = a.colour[0].chunks(4).zip(b.colour[0].chunks(4)).enumerate();
    let width = EXTENT[0] as usize;
    pixels
        .filter(|(_, (a, b))| a != b)
        .map(|(n, (a, b))| {
            let apart = (0..3).map(|k| a[k].abs_diff(b[k])).max().unwrap();
            [(n % width) as f64, (n / width) as f64, f64::from(apart)]
        })
        .collect()
}

/// Drops of a film fly as far about as their bubble reached.
#[test]
fn drops_of_a_film_are_about_their_bubble() {
    let rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    let radius = 2e-4_f32;
    let plain = drawn(&rig, &[], 0.0, 0.0);
    let picture = drawn_before(&rig, &[], FILM, &[[0.0, 0.0]], radius, 8.0);
    let places = changed(&picture, &plain);
    let aside = |at: &[f64; 3]| (at[0] - 159.5).abs().max((at[1] - 119.5).abs());
    let furthest = places.iter().map(aside).fold(0.0, f64::max);
    let pixels = f64::from(FILM) * FOCAL / f64::from(DISTANCE);
    // Nearer ones are seen a little larger; the place of each is a lot in a cube.
    assert!(
        (0.5 * pixels..1.1 * pixels + 2.0).contains(&furthest),
        "{furthest} of {pixels}"
    );
    assert!(places.len() > 8, "{}", places.len());
}

/// A drop finer than a pixel hides a part of the glove behind it, and shows nothing through it.
#[test]
fn a_fine_drop_makes_no_hole_in_a_glove() {
    let mut rig = rig(EXTENT, 1, SurfaceFilter::NarrowRange);
    rig.set_scene(&SceneDesc::laboratory(Vec::new(), 0.75, 1.0));
    let finger = [Bone::new(
        Finish::Glove,
        [-0.1, 0.1].map(|x| Vec3::new(x, 1.0, -DISTANCE - 0.1)),
        [0.04; 2],
    )];
    let radius = (0.2 / FOCAL) as f32 * DISTANCE;
    let with = |places: &[[f32; 2]]| drawn_before(&rig, &finger, JET, places, radius, 1.0);
    let (glove, drops) = (
        with(&[]),
        with(&[[-0.01, 0.0], [0.0, 0.004], [0.01, -0.003]]),
    );
    let places = changed(&drops, &glove);
    assert!((1..20).contains(&places.len()), "{places:?}");
    for place in &places {
        // A share of 0.07 of at most 255 levels is brighter; the background behind the glove is 100 and more.
        assert!(place[2] < 40.0, "{places:?}");
    }
    assert_eq!(drops.depth, glove.depth);
}
