//! Light, glass and scale of the whole picture.

use crate::rig::{Rig, cylinder, ray};
use glam::{Affine3A, DVec3, Vec3};
use vitriol_render::{
    Bone, ColourBy, Finish, FrameDesc, ParticleSource, RenderError, SceneDesc, VesselDesc, View,
};

const EXTENT: [u32; 2] = [320, 180];
const ASPECT: f32 = 16.0 / 9.0;

fn beaker() -> VesselDesc {
    cylinder([0.033, 0.035], 0.002, 0.096)
}

fn luminance(pixel: &[u8]) -> f64 {
    0.21 * f64::from(pixel[0]) + 0.72 * f64::from(pixel[1]) + 0.07 * f64::from(pixel[2])
}

/// A sphere is brightest between where it faces the window and where it
/// mirrors it.
#[test]
fn the_window_lights_the_side_that_faces_it() {
    let rig = Rig::new(EXTENT, 1);
    let view = View::bench(ASPECT);
    let centre = Vec3::new(0.0, 0.855, -0.40);
    let radius = 0.1;
    let picture = rig.draw_spheres(&[view], &[centre.extend(1.0).to_array()], radius);
    let (brightest, _) = picture.colour[0]
        .chunks(4)
        .enumerate()
        .filter(|(index, _)| picture.depth[0][*index] > 0.0)
        .max_by(|a, b| luminance(a.1).total_cmp(&luminance(b.1)))
        .unwrap();
    let (x, y) = (brightest as u32 % EXTENT[0], brightest as u32 / EXTENT[0]);
    let eye = view.stage_from_eye.translation.as_dvec3();
    let centre = centre.as_dvec3();
    let ray = ray(&view, EXTENT, x, y);
    let along = (centre - eye).dot(ray);
    let miss = (centre - eye - ray * along).length();
    let hit = eye + ray * (along - (f64::from(radius).powi(2) - miss * miss).sqrt());
    let normal = (hit - centre).normalize();
    let to_window = (DVec3::new(-1.6, 1.75, 0.35) - centre).normalize();
    let half = (to_window - ray).normalize();
    let (to_half, half_to_window) = (normal.angle_between(half), half.angle_between(to_window));
    assert!(
        to_half < 0.5 * half_to_window,
        "{to_half} of {half_to_window}"
    );
}

/// The middle pixel of a sphere with that attribute.
fn shade(rig: &Rig, attribute: [f32; 4], colour_by: ColourBy) -> Vec<u8> {
    let positions = rig.buffer("positions", &[[0.0, 0.855, -0.40, 1.0]]);
    let attributes = rig.buffer("attributes", &[attribute]);
    let picture = rig.draw(&FrameDesc {
        particles: Some(ParticleSource {
            positions: &positions,
            attributes: &attributes,
            count: 1,
            radius: 0.05,
        }),
        colour_by,
        ..FrameDesc::empty(&[View::bench(ASPECT)])
    });
    let index = (EXTENT[1] / 2 * EXTENT[0] + EXTENT[0] / 2) as usize;
    picture.colour[0][4 * index..][..4].to_vec()
}

#[test]
fn colour_follows_speed_and_stays_at_its_end() {
    let rig = Rig::new(EXTENT, 1);
    let centre = |speed: f32| shade(&rig, [0.0, 0.0, -speed, 0.0], ColourBy::Speed(2.0));
    let rest = centre(0.0);
    assert!(
        rest[2] > rest[0] && rest[2] > rest[1],
        "at rest {rest:?} is not blue"
    );
    let shades: Vec<f64> = [0.0, 0.5, 1.0, 1.5, 2.0]
        .map(|s| luminance(&centre(s)))
        .to_vec();
    assert!(
        shades.windows(2).all(|pair| pair[1] > pair[0] + 10.0),
        "{shades:?}"
    );
    assert_eq!(centre(2.0), centre(50.0));
}

/// Of one buffer, the attribute that is asked for is shown, from its own start to its own end.
#[test]
fn colour_follows_temperature_or_acid() {
    let rig = Rig::new(EXTENT, 1);
    let centre = |temperature: f32, acid: f32, colour_by: ColourBy| {
        shade(&rig, [temperature, acid, 7e8, -3e5], colour_by)
    };
    let heat = ColourBy::Temperature(20.0, 180.0);
    let warmer: Vec<f64> = [20.0, 60.0, 100.0, 140.0, 180.0]
        .map(|t| luminance(&centre(t, 0.4, heat)))
        .to_vec();
    let sourer: Vec<f64> = [0.0, 0.25, 0.5, 0.75, 1.0]
        .map(|c| luminance(&centre(20.0, c, ColourBy::Acid)))
        .to_vec();
    for shades in [&warmer, &sourer] {
        assert!(
            shades.windows(2).all(|pair| pair[1] > pair[0] + 10.0),
            "{shades:?}"
        );
    }
    assert_eq!(centre(20.0, 0.1, heat), centre(-40.0, 0.9, heat));
    assert_eq!(centre(180.0, 0.1, heat), centre(900.0, 0.9, heat));
    assert_eq!(
        centre(20.0, 0.3, ColourBy::Acid),
        centre(99.0, 0.3, ColourBy::Acid)
    );
}

#[test]
fn glass_shows_but_hides_nothing() {
    let mut rig = Rig::new(EXTENT, 1);
    let views = [View::bench(ASPECT)];
    let mut scene = SceneDesc::laboratory(Vec::new(), 0.75, 1.0);
    rig.set_scene(&scene);
    let without = rig.draw(&FrameDesc::empty(&views));
    assert!(
        without.depth[0].iter().all(|depth| *depth > 0.0),
        "the room has a hole"
    );
    scene.vessels.push(beaker());
    rig.set_scene(&scene);
    let vessels = [Affine3A::from_translation(Vec3::new(0.12, 0.75, -0.40))];
    let with = rig.draw(&FrameDesc {
        vessels: &vessels,
        ..FrameDesc::empty(&views)
    });
    assert_eq!(with.depth, without.depth);
    // The beaker's projection: the pixels that it changes lie in it, or in its shadow on the bench to the right; left of it and above it
    // nothing changes.
    let clip_from_stage = views[0].clip_from_scaled(1.0);
    let rim = clip_from_stage.project_point3(Vec3::new(0.12 - 0.035, 0.846, -0.40));
    let left = ((0.5 + 0.5 * rim.x) * EXTENT[0] as f32) as usize;
    let changed = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 3);
    let pairs = with.colour[0].chunks(4).zip(without.colour[0].chunks(4));
    let columns: Vec<usize> = pairs
        .enumerate()
        .filter(|(_, pair)| changed(*pair))
        .map(|(index, _)| index % EXTENT[0] as usize)
        .collect();
    assert!(
        columns.len() > 1000,
        "{} pixels show the glass",
        columns.len()
    );
    let first = columns.iter().min().unwrap();
    // The contact shadow reaches a little further than the glass.
    assert!(
        (left.saturating_sub(20)..=left + 1).contains(first),
        "{first} {left}"
    );
}

/// A scene simulated twenty times as large is drawn the same.
#[test]
fn another_length_scale_gives_the_same_picture() {
    let mut rig = Rig::new(EXTENT, 1);
    let views = [View::bench(ASPECT)];
    let mut draw = |scale: f32| {
        let grown = |points: Vec<[f64; 2]>| {
            let grow = |x: f64| x / f64::from(scale);
            points
                .into_iter()
                .map(|[r, y]| [grow(r), grow(y)])
                .collect()
        };
        let beaker = beaker();
        let vessel = VesselDesc {
            inner: grown(beaker.inner),
            outer: grown(beaker.outer),
            ..VesselDesc::default()
        };
        rig.set_scene(&SceneDesc::laboratory(vec![vessel], 0.75, scale));
        let at = Vec3::new(0.12, 0.75, -0.40) / scale;
        let position = at + Vec3::new(0.0, 0.04, 0.0) / scale;
        let positions = rig.buffer("positions", &[position.extend(1.0).to_array()]);
        let velocities = rig.buffer("velocities", &[[0.7 / scale, 0.0, 0.0, 0.0]]);
        let vessels = [Affine3A::from_translation(at)];
        let finger = Bone::new(
            Finish::Glove,
            [Vec3::new(0.05, 0.80, -0.38), Vec3::new(0.08, 0.84, -0.40)],
            [0.012, 0.009],
        );
        rig.draw(&FrameDesc {
            vessels: &vessels,
            particles: Some(ParticleSource {
                positions: &positions,
                attributes: &velocities,
                count: 1,
                radius: 0.02 / scale,
            }),
            // Hands are in real metres, as views are.
            hands: [&[finger], &[]],
            colour_by: ColourBy::Speed(1.0 / scale),
            length_scale: scale,
            ..FrameDesc::empty(&views)
        })
    };
    let (real, grown) = (draw(1.0), draw(0.05));
    // Edges may fall to either side of a pixel's centre by rounding.
    let differ = real.colour[0]
        .iter()
        .zip(&grown.colour[0])
        .filter(|(a, b)| a.abs_diff(**b) > 2)
        .count();
    assert!(differ < 40, "{differ} components differ");
}

#[test]
fn a_frame_that_does_not_fit_is_refused() {
    let mut rig = Rig::new([32, 32], 1);
    rig.set_scene(&SceneDesc::laboratory(vec![beaker()], 0.75, 1.0));
    let view = View::bench(1.0);
    let one = [Affine3A::IDENTITY];
    let fitting = FrameDesc {
        vessels: &one,
        ..FrameDesc::empty(&[])
    };
    let error = rig.refusal(&fitting);
    assert!(
        matches!(error, RenderError::Count { what: "views", .. }),
        "{error}"
    );
    let error = rig.refusal(&FrameDesc::empty(std::slice::from_ref(&view)));
    assert!(
        matches!(
            error,
            RenderError::Count {
                what: "vessel poses",
                ..
            }
        ),
        "{error}"
    );
    let buffer = rig.buffer("few", &[[0.0; 4]; 4]);
    let error = rig.refusal(&FrameDesc {
        views: std::slice::from_ref(&view),
        particles: Some(ParticleSource {
            positions: &buffer,
            attributes: &buffer,
            count: 5,
            radius: 0.01,
        }),
        ..fitting
    });
    assert!(
        matches!(error, RenderError::TooManyParticles { held: 4, .. }),
        "{error}"
    );
}

/// The room is around either eye.
#[test]
fn both_eyes_see_the_room() {
    let mut rig = Rig::new(EXTENT, 2);
    rig.set_scene(&SceneDesc::laboratory(Vec::new(), 0.75, 1.0));
    let left = View::bench(ASPECT);
    let mut right = left;
    right.stage_from_eye = left.stage_from_eye * Affine3A::from_translation(Vec3::X * 0.063);
    let picture = rig.draw(&FrameDesc::empty(&[left, right]));
    for (eye, depth) in picture.depth.iter().enumerate() {
        let holes = depth.iter().filter(|depth| **depth == 0.0).count();
        assert_eq!(holes, 0, "eye {eye} sees {holes} pixels of nothing");
    }
}
