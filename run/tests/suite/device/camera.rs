//! The camera from the track's head.

use crate::device::common::{BEFORE, SIZE, coloured, experiment, frame, in_room, liquid, scene};
use std::f32::consts::FRAC_PI_2;

use glam::{Quat, Vec3};
use vitriol_run::scenery::drawn_liquid;
use vitriol_run::track::key;
use vitriol_run::{Camera, Carriers, Colour, Marks, Shot};
use vitriol_shaders::Library;
use vitriol_sim::bodies::Worn;
use vitriol_sim::scene::{PictureRoom, Scene};
use vitriol_sim::solver::{Came, Census, Skin};
use vitriol_sim::world::World;
use vitriol_tests::gpu;
use vitriol_xr::{Hand, Pose, Switch};

/// Half of the vertical field of view, 40°.
const HALF_FIELD: f64 = 20.0;

#[test]
fn the_picture_follows_the_head() {
    let device = gpu::device();
    let level = Pose::new(BEFORE, Quat::IDENTITY);
    let mut laboratory = experiment(&device, Some(level), Library::embedded());
    // What is straight ahead is in the middle, before the first step too.
    let (x, y) = liquid(laboratory.picture(0).unwrap());
    assert!(x.abs() < 1.0 && y.abs() < 15.0, "{x} {y}");

    // Pixels from the axis: tangents, half a picture being tan(20°) high.
    let pixels = |tangent: f64| tangent / HALF_FIELD.to_radians().tan() * f64::from(SIZE.1) / 2.0;
    let angle = 10f64.to_radians();
    let turned = |q: Quat| Pose::new(BEFORE, q);
    for (head, moves) in [
        // To the left: the liquid goes to the right. OpenXR's axes: +Y up.
        (
            turned(Quat::from_rotation_y(angle as f32)),
            (pixels(angle.tan()), 0.0),
        ),
        // Up: it goes down.
        (
            turned(Quat::from_rotation_x(angle as f32)),
            (0.0, pixels(angle.tan())),
        ),
        // Aside by 0.1 m of the 0.6 m between.
        (
            Pose::new(BEFORE + 0.1 * Vec3::X, Quat::IDENTITY),
            (-pixels(0.1 / 0.6), 0.0),
        ),
        (level, (0.0, 0.0)),
    ] {
        laboratory.step(&frame(0, head)).unwrap();
        let (new_x, new_y) = liquid(laboratory.picture(0).unwrap());
        // The liquid settles, and its near side is nearer than its middle; what
        // is asked for is 44 pixels.
        let off = (new_x - x - moves.0).hypot(new_y - y - moves.1);
        assert!(
            off < 6.0,
            "{head:?}: ({new_x}, {new_y}) instead of {moves:?}"
        );
    }
}

#[test]
fn a_fixed_camera_stays() {
    let device = gpu::device();
    let mut laboratory = experiment(&device, None, Library::embedded());
    let before = liquid(laboratory.picture(0).unwrap());
    let away = Pose::new(BEFORE, Quat::from_rotation_y(0.5));
    laboratory.step(&frame(0, away)).unwrap();
    let after = liquid(laboratory.picture(0).unwrap());
    // Settling in a small picture; a head turned by 0.5 rad moves it out of
    // the picture.
    let moved = (after.0 - before.0).hypot(after.1 - before.1);
    assert!(moved < 5.0, "{moved}");
}

/// What watchers see from close by is the glass. From the tripod the picture is 0.304 m high at the beaker (20.5° from 0.84 m). From close by
/// it is 0.172 m: a beaker of 95 mm × 70 mm that is seen from 23° above fills two thirds of it. The film's own picture stays as it is.
#[test]
fn a_close_up_shows_the_glass_and_leaves_the_film_alone() {
    let device = gpu::device();
    let mut laboratory = experiment(&device, None, Library::embedded());
    laboratory.step(&frame(0, Pose::IDENTITY)).unwrap();
    // Observations are collected with it: they have where liquid is.
    laboratory.heard().unwrap();
    let film = laboratory.picture(0).unwrap().to_vec();
    let close = laboratory.close_up(f64::INFINITY).unwrap().unwrap();
    assert!(
        laboratory.picture(0).unwrap() == film,
        "the film has another picture"
    );
    // The beaker is at x = 0.
    let (aside, _) = liquid(&close);
    assert!(aside.abs() < 3.0, "{aside} pixels aside");
    let coloured = |picture: &[u8]| {
        let spread = |pixel: &[u8]| {
            let channels = [pixel[0], pixel[1], pixel[2]];
            channels.iter().max().unwrap() - channels.iter().min().unwrap()
        };
        let pixels = picture.chunks_exact(4);
        pixels.filter(|pixel| spread(pixel) > 60).count()
    };
    let [far, near] = [coloured(&film), coloured(&close)];
    // The liquid is seen from nearly the same height, and its edges blur.
    let times = near as f64 / far as f64 / (0.304 / 0.172_f64).powi(2);
    assert!((times - 1.0).abs() < 0.15, "{near} pixels and {far}");
    // A camera at the head has the same picture from close by.
    let head = Pose::new(BEFORE, Quat::from_rotation_y(0.3));
    let mut worn = experiment(&device, Some(head), Library::embedded());
    worn.step(&frame(0, head)).unwrap();
    worn.heard().unwrap();
    let same = worn.close_up(f64::INFINITY).unwrap().unwrap();
    assert!(same == close, "the tripod goes with the head");
}

/// A room that is asked for stands in for the scene's, in the scene that a track changes to as well: an evening's, of 70 lx, is darker
/// than a day's, of 800 lx, whatever the eye adapts to.
#[test]
fn the_room_that_is_asked_for_is_drawn() {
    let device = gpu::device();
    let of = |scene: &Scene, asked| in_room(&device, scene, asked);
    let evening = Some(PictureRoom::Dark);
    let mean = |picture: &[u8]| {
        let levels = picture.chunks_exact(4).map(|pixel| u64::from(pixel[1]));
        levels.sum::<u64>() / (picture.len() as u64 / 4)
    };
    let mut asked = of(&scene(), evening);
    let mut dark = scene();
    dark.picture.room = PictureRoom::Dark;
    let said = of(&dark, None).picture(0).unwrap().to_vec();
    assert!(
        asked.picture(0).unwrap() == said,
        "another picture than of a scene that says so"
    );
    let day = mean(of(&scene(), None).picture(0).unwrap());
    assert!(10 * mean(&said) < 7 * day, "{} of {day}", mean(&said));
    let mut other = frame(0, Pose::IDENTITY);
    other.scenario.push(Switch {
        key: key::SCENE.into(),
        value: "beaker".into(),
    });
    asked.step(&other).unwrap();
    let after = mean(asked.picture(0).unwrap());
    assert!(10 * after < 7 * day, "{after} of {day}");
}

/// A hand is drawn where it is, by OpenXR's axes: held up beside the glass it covers what it covers and nothing else; a hand that
/// sleeps is not there.
#[test]
fn the_head_sees_the_hands() {
    let gpu = gpu::device();
    let head = Pose::new(BEFORE, Quat::IDENTITY);
    // 20 cm to the right of the glass and 10 cm nearer.
    let place = Vec3::new(0.2, 0.79, -0.3);
    let picture = |active: bool| {
        let mut laboratory = coloured(&gpu, Some(head), Library::embedded(), Colour::Liquid);
        let mut frame = frame(0, head);
        frame.hands[1] = Hand {
            active,
            valid: active,
            // Its broad side to the eye.
            stage_from_grip: Pose::new(place, Quat::from_rotation_y(FRAC_PI_2)),
            ..Hand::default()
        };
        laboratory.step(&frame).unwrap();
        laboratory.picture(0).unwrap().to_vec()
    };
    let (with, without) = (picture(true), picture(false));
    let (width, height) = SIZE;
    let (mut sum, mut count) = (0.0, 0.0);
    let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
    let pixels = with.chunks_exact(4).zip(without.chunks_exact(4));
    for (index, (a, b)) in (0u32..).zip(pixels) {
        if a != b {
            sum += f64::from(index % width) + 0.5 - 0.5 * f64::from(width);
            let y = f64::from(index / width) + 0.5 - 0.5 * f64::from(height);
            ends = [ends[0].min(y), ends[1].max(y)];
            count += 1.0;
        }
    }
    // 40° upright: so many pixels are a radian's tangent.
    let focal = 0.5 * f64::from(height) / 20.0_f64.to_radians().tan();
    let ahead = f64::from(BEFORE.z - place.z);
    let right = f64::from(place.x - BEFORE.x) / ahead * focal;
    // With its cuff it is some 84 mm broad and 250 mm long, and between the fingers are gaps.
    let hand = 0.084 * 0.25 * (focal / ahead).powi(2);
    assert!(
        (0.5 * hand..1.2 * hand).contains(&count),
        "{count} of {hand} pixels"
    );
    let x = sum / count;
    let millimetre = 1e-3 * focal / ahead;
    assert!(
        (x - right).abs() < 30.0 * millimetre,
        "{x} instead of {right}"
    );
    // Fingers hang down from the middle of the palm, and the cuff is above it.
    let [above, below] = ends.map(|end| end / millimetre);
    assert!((105.0..150.0).contains(&below), "{below}");
    assert!((-140.0..-90.0).contains(&above), "{above}");
}

/// Acid that came to the face is seen by the head that wears goggles, in pictures of the liquid; a camera elsewhere does not look through
/// them, and colours of speed stay what the map says.
#[test]
fn the_head_sees_splashes_on_its_goggles() {
    let gpu = gpu::device();
    let (scene, library) = (scene(), Library::embedded());
    let world = World::new(&gpu, &library, &scene, 1).unwrap();
    let shot = Shot {
        liquid: Some(drawn_liquid(&world)),
        ..Shot::of(SIZE.into())
    };
    let mut camera = Camera::new(&gpu, &library, &scene, &shot).unwrap();
    let mut census = Census::default();
    census.skin[Skin::Face as usize].came = Came {
        particles: 20,
        volume: 1e-6,
        acid: 0.98,
        ..Came::default()
    };
    let mut splashed = Marks::default();
    splashed.take(&census, Carriers::of(&world, &[vec![], vec![]]));
    // Pixels that the splashes change.
    let changed = |camera: &mut Camera, marks: &Marks, colour: Colour| {
        let mut shoot = |marks: &Marks| {
            camera.show_marks(marks);
            camera.shoot(&world, colour).unwrap()
        };
        let (clean, marked) = (shoot(&Marks::default()), shoot(marks));
        let pixels = clean.chunks_exact(4).zip(marked.chunks_exact(4));
        pixels.filter(|(a, b)| a != b).count()
    };
    assert_eq!(changed(&mut camera, &splashed, Colour::Liquid), 0);
    camera.follow(&Pose::new(BEFORE, Quat::IDENTITY));
    let covered = changed(&mut camera, &splashed, Colour::Liquid);
    let share = covered as f32 / (SIZE.0 * SIZE.1) as f32;
    assert!((0.03..0.6).contains(&share), "{share}");
    assert_eq!(changed(&mut camera, &splashed, Colour::Speed), 0);
    let mut off = splashed.clone();
    off.wears(Worn {
        goggles: Some(false),
        gloves: None,
    });
    assert_eq!(changed(&mut camera, &off, Colour::Liquid), 0);
}
