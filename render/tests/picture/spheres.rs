//! Sphere impostors against ray casting in f64.

use crate::rig::{Rig, right_of, turned_eye};
use glam::Vec3;
use vitriol_render::{FrameDesc, View};

const EXTENT: [u32; 2] = [320, 240];

/// f32 against f64: positions of about 1 m have an error of 6e-8 m, which at
/// 0.1 m from the eye is 6e-7, and a few roundings of the projection and of
/// the interpolation come on top.
const DEPTH_TOLERANCE: f64 = 1e-5;

/// A sphere's centre in the stage, given by the slopes and the distance at which the eye sees it.
fn seen_at(view: &View, slope_x: f32, slope_y: f32, distance: f32) -> [f32; 4] {
    let in_eye = Vec3::new(slope_x, slope_y, -1.0) * distance;
    view.stage_from_eye
        .transform_point3(in_eye)
        .extend(1.0)
        .to_array()
}

#[test]
fn one_sphere_anywhere_in_an_asymmetric_frustum() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    // In the middle, at each edge, cut by a corner, close up, and hardly two
    // pixels across.
    for (slope_x, slope_y, distance, radius, least) in [
        (0.0, 0.0, 0.5, 0.05, 300),
        (-1.3, 0.1, 0.5, 0.05, 300),
        (0.80, -1.3, 0.4, 0.06, 200),
        (0.2, 0.85, 0.3, 0.05, 200),
        (-0.4, -0.5, 0.1, 0.07, 10_000),
        (0.3, 0.1, 2.0, 0.0125, 0),
    ] {
        let spheres = [seen_at(&view, slope_x, slope_y, distance)];
        let picture = rig.draw_spheres(&[view], &spheres, radius);
        let reference = rig.reference(&view, &spheres, radius);
        let compared = reference.compare(&picture.depth[0], EXTENT, DEPTH_TOLERANCE);
        assert!(compared >= least, "{compared} pixels of {least}");
        let covered = picture.depth[0]
            .iter()
            .filter(|depth| **depth > 0.0)
            .count();
        assert!(covered > 0, "nothing at ({slope_x}, {slope_y})");
    }
}

#[test]
fn spheres_meet_where_they_intersect() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    let middle = Vec3::from_slice(&seen_at(&view, 0.0, 0.0, 0.4));
    // Neighbours of 0.6 spacings' radius, turned so that none is square on.
    let spheres: Vec<_> = (0..27)
        .map(|index| {
            let cell = Vec3::new(
                (index % 3) as f32,
                (index / 3 % 3) as f32,
                (index / 9) as f32,
            );
            (middle + (cell - 1.0) * 0.05).extend(1.0).to_array()
        })
        .collect();
    let picture = rig.draw_spheres(&[view], &spheres, 0.03);
    let reference = rig.reference(&view, &spheres, 0.03);
    assert!(reference.compare(&picture.depth[0], EXTENT, DEPTH_TOLERANCE) > 1500);
}

/// The eye is in the liquid and in one of its spheres, which is not seen from
/// within; those around it are, and none of those behind.
#[test]
fn eye_inside_the_liquid() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    let eye = Vec3::from(view.stage_from_eye.translation);
    let mut spheres = vec![(eye + Vec3::new(0.005, 0.0, 0.0)).extend(1.0).to_array()];
    for index in 0..6_i32.pow(3) {
        let cell = Vec3::new(
            (index % 6) as f32,
            (index / 6 % 6) as f32,
            (index / 36) as f32,
        );
        spheres.push((eye + (cell - 2.5) * 0.05).extend(1.0).to_array());
    }
    let picture = rig.draw_spheres(&[view], &spheres, 0.02);
    let reference = rig.reference(&view, &spheres, 0.02);
    assert!(reference.compare(&picture.depth[0], EXTENT, DEPTH_TOLERANCE) > 30_000);
}

#[test]
fn particles_that_were_taken_out_or_cannot_be_seen_leave_no_trace() {
    let rig = Rig::new(EXTENT, 1);
    let view = turned_eye();
    let empty = rig.draw(&FrameDesc::empty(&[view]));
    assert!(empty.depth[0].iter().all(|depth| *depth == 0.0));
    assert!(
        empty.colour[0]
            .chunks(4)
            .all(|pixel| pixel == &empty.colour[0][..4])
    );

    let mut taken_out = seen_at(&view, 0.0, 0.0, 0.5);
    taken_out[3] = -1.0;
    let behind = seen_at(&view, 0.1, 0.1, -0.5);
    let just_behind = seen_at(&view, 0.0, 0.0, -0.021);
    let nowhere = [
        [f32::NAN; 4],
        [f32::NAN, 1.0, 0.0, 1.0],
        [f32::INFINITY, 0.0, 0.0, 1.0],
        [1e30, 1e30, -1e30, 1.0],
        [-1e9, 0.0, 0.0, 1.0],
    ];
    let spheres = [&[taken_out, behind, just_behind][..], &nowhere[..]].concat();
    let picture = rig.draw_spheres(&[view], &spheres, 0.02);
    assert!(picture.colour == empty.colour && picture.depth == empty.depth);
    let none = rig.draw_spheres(&[view], &[], 0.02);
    assert!(none.colour == empty.colour && none.depth == empty.depth);
}

/// Two eyes, 64 mm apart, with mirrored frusta.
#[test]
fn each_eye_sees_its_own_picture() {
    let rig = Rig::new(EXTENT, 2);
    let left = turned_eye();
    let right = right_of(&left);
    let distance = 0.6;
    let spheres = [seen_at(&left, 0.05, 0.0, distance)];
    let picture = rig.draw_spheres(&[left, right], &spheres, 0.04);
    let mut centres = Vec::new();
    for (view, depth) in [left, right].iter().zip(&picture.depth) {
        let reference = rig.reference(view, &spheres, 0.04);
        assert!(reference.compare(depth, EXTENT, DEPTH_TOLERANCE) > 100);
        // Centre of the silhouette as a slope.
        let (mut sum, mut count) = (0.0, 0.0);
        for (index, _) in depth.iter().enumerate().filter(|(_, depth)| **depth > 0.0) {
            sum += (index % EXTENT[0] as usize) as f32 + 0.5;
            count += 1.0;
        }
        let (from, to) = (view.fov.left.tan(), view.fov.right.tan());
        centres.push(from + (to - from) * sum / count / EXTENT[0] as f32);
    }
    // Parallax: 64 mm over the distance, to a third of a pixel.
    let pixel = (left.fov.right.tan() - left.fov.left.tan()) / EXTENT[0] as f32;
    let parallax = centres[0] - centres[1];
    assert!(
        (parallax - 0.064 / distance).abs() < pixel / 3.0,
        "{parallax}"
    );
}
