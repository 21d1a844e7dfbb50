//! Steam and the visibility mask.

use crate::rig::{LEFT_QUARTER, Picture, Rig, cylinder, displayed, linear, ray};
use glam::{Affine3A, Vec3};
use vitriol_gpu::Image;
use vitriol_render::{Fov, FrameDesc, Panel, SceneDesc, SteamSource, View};
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

/// In the open a puff brightens the background by its opacity, softly; half in the bench as a puff of half the depth; behind it or without
/// radius not at all.
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
    let plain = rig.draw(&FrameDesc::empty(&views));
    let draw = |centre: Vec3, radius: f32, opacity: f32| {
        let puff = Puff {
            position: centre.to_array(),
            radius,
            depth: -(1.0 - opacity).ln(),
            ..Puff::default()
        };
        let puffs = rig.filled("puffs", &[puff]);
        let steam = Some(SteamSource {
            puffs: &puffs,
            count: 1,
            dew: None,
        });
        rig.draw(&FrameDesc {
            steam,
            ..FrameDesc::empty(&views)
        })
    };
    let change = |centre: Vec3, radius: f32, opacity: f32| {
        let (with, without) = (draw(centre, radius, opacity), middle(&plain.colour[0]));
        f64::from(middle(&with.colour[0])[0]) - f64::from(without[0])
    };
    let open = change(bench + towards * 0.1, 0.02, 0.6);
    let half = change(bench, 0.02, 0.6);
    assert!(open > 15.0, "{open}");
    // Three times its mean depth of 0.92 is in the middle of a puff.
    let opacity = |depth: f64| 1.0 - (-3.0 * depth).exp();
    let expected = opacity(0.458) / opacity(0.916);
    assert!((half / open - expected).abs() < 0.15, "{half} of {open}");
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

/// The effect of one puff, number `index` of six, before a panel that is black or white: per pixel the light that the puff adds, and the
/// share that it lets through, of red.
fn before_panels(rig: &Rig, view: View, puff: Puff, index: usize) -> Vec<(f64, f64)> {
    let mut all = [Puff::default(); 6];
    all[index] = puff;
    let puffs = rig.filled("puffs", &all);
    let pictures = [0_u32, 0xffff_ffff].map(|colour| {
        let image = even(rig, colour);
        let behind = Affine3A::from_translation(Vec3::new(0.0, 0.0, -0.4));
        rig.draw(&FrameDesc {
            steam: Some(SteamSource {
                puffs: &puffs,
                count: 6,
                dew: None,
            }),
            panel: Some(Panel {
                image: &image,
                stage_from_panel: view.stage_from_eye * behind,
                size: [0.6; 2],
            }),
            ..FrameDesc::empty(&[view])
        })
    });
    let red = |picture: &Picture| -> Vec<f64> {
        let pixels = picture.colour[0].chunks(4);
        pixels.map(|pixel| linear(pixel[0])).collect()
    };
    let [black, white] = pictures.map(|picture| red(&picture));
    black.iter().zip(white).map(|(b, w)| (*b, w - b)).collect()
}

/// An image of one colour.
pub fn even(rig: &Rig, colour: u32) -> Image {
    rig.image([1, 1], &[colour | 0xff00_0000])
}

/// Over its disc a puff has on the mean its own optical depth, and at one distance from its middle here more and there less.
#[test]
fn a_puff_is_as_deep_as_it_says_and_not_round() {
    let rig = rig();
    let eye = Vec3::new(0.0, 1.2, 0.5);
    let view = View::look_at(eye, eye - Vec3::Z, Fov::symmetric(0.2, 16.0 / 9.0));
    let (radius, depth) = (0.02_f32, 0.5);
    let mut mean = 0.0;
    for index in 0..6 {
        let puff = Puff {
            position: (eye - 0.25 * Vec3::Z).to_array(),
            radius,
            depth,
            ..Puff::default()
        };
        let seen = before_panels(&rig, view, puff, index);
        let (mut sum, mut ring) = (0.0, Vec::new());
        let mut area = 0.0;
        for (n, (_, open)) in seen.iter().enumerate() {
            let along = ray(&view, EXTENT, n as u32 % EXTENT[0], n as u32 / EXTENT[0]);
            let across = 0.25 * along.x.hypot(along.y) / -along.z / f64::from(radius);
            let thick = -open.max(1e-3).ln();
            if across < 1.0 {
                sum += thick;
                area += 1.0;
            }
            if (0.45..0.55).contains(&across) {
                ring.push(thick);
            }
        }
        let found = sum / area;
        assert!(
            (found / f64::from(depth) - 1.0).abs() < 0.2,
            "{index}: {found}"
        );
        mean += found / 6.0;
        let (least, most) = ring
            .iter()
            .fold((9.0_f64, 0.0_f64), |(a, b), &x| (a.min(x), b.max(x)));
        assert!(most > 1.5 * least, "{index}: {least} {most}");
    }
    eprintln!("{mean} of {depth}");
    assert!((mean / f64::from(depth) - 1.0).abs() < 0.1, "{mean}");
}

/// A thin veil scatters the hemispheres' light from all sides alike, and the window's by Henyey and Greenstein's law with g = 0.85:
/// blurred by the window's own size, and by a second drop, it is somewhat less forward.
#[test]
fn mist_is_bright_against_the_window() {
    let rig = rig();
    let place = Vec3::new(0.0, 1.2, -0.1);
    let to_window = Vec3::new(-1.5, 1.9, 0.5) - place;
    let window = 7.4 / (1.0 + f64::from(to_window.length_squared()));
    for turned in [0.6_f32, 1.2, 1.8] {
        // The eye is where light of the window arrives that is turned by that angle.
        let on = -to_window.normalize();
        let aside = on.cross(Vec3::Y).normalize();
        let eye = place + 0.25 * (turned.cos() * on + turned.sin() * aside);
        let view = View::look_at(eye, place, Fov::symmetric(0.2, 16.0 / 9.0));
        let puff = Puff {
            position: place.to_array(),
            radius: 0.02,
            depth: 0.15,
            ..Puff::default()
        };
        let seen = before_panels(&rig, view, puff, 1);
        let (light, open) = seen[(EXTENT[1] / 2 * EXTENT[0] + EXTENT[0] / 2) as usize];
        let found = light / (1.0 - open);
        let law = |g: f64| {
            (1.0 - g * g) / 4.0 / (1.0 + g * g - 2.0 * g * f64::from(turned.cos())).powf(1.5)
        };
        let [least, most] = [0.75, 0.85].map(|g| displayed(0.38 + window * law(g)));
        let [least, most] = [least.min(most), least.max(most)];
        eprintln!("{turned}: {found} of {least} to {most}");
        assert!(
            (0.88 * least..1.12 * most).contains(&found),
            "{turned}: {found} of {least} to {most}"
        );
    }
}

/// In a vessel steam ends at the glass: beside it there is none, within it there is.
#[test]
fn steam_stays_in_its_vessel() {
    let mut rig = rig();
    let inner = 0.02;
    rig.set_vessels(vec![cylinder([inner, 0.022], 0.002, 0.1)]);
    let foot = Vec3::new(0.0, 0.75, -0.4);
    let middle = foot + Vec3::Y * 0.05;
    let eye = middle + Vec3::Z * 0.3;
    let view = View::look_at(eye, middle, Fov::symmetric(0.2, 16.0 / 9.0));
    let vessels = [Affine3A::from_translation(foot)];
    let puff = Puff {
        position: middle.to_array(),
        radius: 0.03,
        depth: 2.0,
        ..Puff::default()
    };
    let puffs = rig.filled("puffs", &[puff]);
    let draw = |count: u32| {
        rig.draw(&FrameDesc {
            vessels: &vessels,
            steam: Some(SteamSource {
                puffs: &puffs,
                count,
                dew: None,
            }),
            ..FrameDesc::empty(&[view])
        })
    };
    let (plain, steam) = (draw(0), draw(1));
    let (mut within, mut beside) = (0, 0);
    for (n, (a, b)) in plain.colour[0]
        .chunks(4)
        .zip(steam.colour[0].chunks(4))
        .enumerate()
    {
        let along = ray(&view, EXTENT, n as u32 % EXTENT[0], n as u32 / EXTENT[0]);
        let across = 0.3 * (along.x / along.z).abs();
        let high = 0.3 * (along.y / along.z).abs();
        if across > inner {
            // Dithered anew.
            assert!(a[0].abs_diff(b[0]) <= 1, "{across} m beside the axis");
            beside += usize::from(across < 0.028);
        } else if across < 0.5 * inner && high < 0.01 {
            within += usize::from(a[0].abs_diff(b[0]) > 3);
        }
    }
    assert!(within > 100 && beside > 100, "{within} {beside}");
}

/// Hidden pixels are black and nearest; the rest is as without a mask.
#[test]
fn hidden_area_is_black_and_costs_no_light() {
    let mut rig = rig();
    let views = [View::bench(16.0 / 9.0)];
    let plain = rig.draw(&FrameDesc::empty(&views));
    rig.renderer.set_visibility_mask(&[&LEFT_QUARTER]).unwrap();
    let masked = rig.draw(&FrameDesc::empty(&views));
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
    assert_eq!(rig.draw(&FrameDesc::empty(&views)).colour, plain.colour);
}
