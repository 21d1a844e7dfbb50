//! Steam and the visibility mask.

use crate::rig::{LEFT_QUARTER, Rig, without_particles};
use glam::Vec3;
use vitriol_gpu::Buffer;
use vitriol_render::{FrameDesc, SceneDesc, SteamSource, View};
use vitriol_shaders::layout::Puff;

const EXTENT: [u32; 2] = [320, 180];

fn rig() -> Rig {
    let mut rig = Rig::new(EXTENT, 1);
    rig.set_scene(&SceneDesc::laboratory(Vec::new(), 0.75, 1.0));
    rig
}

fn middle(picture: &[u8]) -> [u8; 3] {
    let index = 4 * (EXTENT[1] / 2 * EXTENT[0] + EXTENT[0] / 2) as usize;
    [picture[index], picture[index + 1], picture[index + 2]]
}

/// In the open a puff brightens what is behind it by its opacity, round and
/// softly; half in the bench by half; behind it or without radius not at all.
#[test]
fn puffs_fade_against_what_is_there() {
    let rig = rig();
    let eye = Vec3::new(0.0, 0.95, 0.0);
    let view = View {
        ..View::look_at(eye, Vec3::new(0.0, 0.75, -0.4), View::bench(16.0 / 9.0).fov)
    };
    let views = [view];
    let bench = Vec3::new(0.0, 0.75, -0.4);
    let towards = (eye - bench).normalize();
    let plain = rig.draw(&without_particles(&views));
    let draw = |centre: Vec3, radius: f32, opacity: f32| {
        let puff = Puff {
            position: centre.to_array(),
            radius,
            depth: -(1.0 - opacity).ln(),
            ..Puff::default()
        };
        let puffs = Buffer::storage(&rig.gpu, "puffs", size_of::<Puff>() as u64).unwrap();
        rig.gpu.write(&puffs, &[puff]).unwrap();
        let steam = Some(SteamSource {
            puffs: &puffs,
            count: 1,
        });
        rig.draw(&FrameDesc {
            steam,
            ..without_particles(&views)
        })
    };
    let change = |centre: Vec3, radius: f32, opacity: f32| {
        let (with, without) = (draw(centre, radius, opacity), middle(&plain.colour[0]));
        f64::from(middle(&with.colour[0])[0]) - f64::from(without[0])
    };
    let open = change(bench + towards * 0.1, 0.02, 0.6);
    let half = change(bench, 0.02, 0.6);
    assert!(open > 20.0, "{open}");
    assert!((half / open - 0.5).abs() < 0.2, "{half} of {open}");
    assert_eq!(change(bench - towards * 0.1, 0.02, 0.6), 0.0);
    assert_eq!(change(bench + towards * 0.1, 0.0, 0.6), 0.0);
    let all = draw(bench + towards * 0.1, 0.02, 0.6);
    assert_eq!(all.depth, plain.depth);
    let pairs = all.colour[0].chunks(4).zip(plain.colour[0].chunks(4));
    let changed = pairs.filter(|(a, b)| a != b).count();
    // π r² at this distance: a pixel is 0.0009 rad.
    let pixel = 2.0 * (10.25_f64.to_radians()).tan() / f64::from(EXTENT[1]);
    let distance = f64::from((eye - bench).length() - 0.1);
    let disc = std::f64::consts::PI * (0.02 / distance / pixel).powi(2);
    let share = changed as f64 / disc;
    assert!((0.6..1.05).contains(&share), "{share} of the disc");
}

/// What is hidden is black and nearest; the rest is as without a mask.
#[test]
fn hidden_area_is_black_and_costs_no_light() {
    let mut rig = rig();
    let views = [View::bench(16.0 / 9.0)];
    let plain = rig.draw(&without_particles(&views));
    rig.renderer.set_visibility_mask(&[&LEFT_QUARTER]).unwrap();
    let masked = rig.draw(&without_particles(&views));
    for y in 0..EXTENT[1] {
        for x in 0..EXTENT[0] {
            let index = (y * EXTENT[0] + x) as usize;
            let (new, old) = (
                &masked.colour[0][4 * index..][..3],
                &plain.colour[0][4 * index..][..3],
            );
            if x < EXTENT[0] / 4 - 1 {
                assert_eq!((new, masked.depth[0][index]), (&[0, 0, 0][..], 1.0));
            } else if x > EXTENT[0] / 4 + 8 {
                // Smoothed edges reach a few pixels.
                assert_eq!((new, masked.depth[0][index]), (old, plain.depth[0][index]));
            }
        }
    }
    assert!(rig.renderer.set_visibility_mask(&[]).is_err());
    rig.renderer.set_visibility_mask(&[&[]]).unwrap();
    assert_eq!(rig.draw(&without_particles(&views)).colour, plain.colour);
}
