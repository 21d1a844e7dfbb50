//! Acid on the goggles.

use crate::rig::Rig;
use glam::Affine3A;
use vitriol_render::{Fov, FrameDesc, View};

const EXTENT: [u32; 2] = [96, 80];

/// Two eyes that see nothing but the background, whose frusta are mirror images.
fn eyes() -> [View; 2] {
    let eye = |left: f32, right: f32| View {
        stage_from_eye: Affine3A::IDENTITY,
        fov: Fov {
            left,
            right,
            up: 0.7,
            down: -0.9,
        },
    };
    [eye(-0.9, 0.7), eye(-0.7, 0.9)]
}

/// Splashes come one by one, each darker than the background and less blue, and the right eye's are the left one's in a mirror. The middle
/// of the picture stays free.
#[test]
fn splashes_cover_what_is_aside() {
    let rig = Rig::new(EXTENT, 2);
    let views = eyes();
    let draw = |goggles: f32| {
        rig.draw(&FrameDesc {
            goggles,
            ..FrameDesc::empty(&views)
        })
    };
    let clean = draw(0.0);
    let [width, height] = EXTENT.map(|side| side as usize);
    let mut before = 0;
    for splashes in 1..=6 {
        let picture = draw(splashes as f32 / 6.0);
        let covered = |eye: usize, x: usize, y: usize| {
            let at = 4 * (y * width + x);
            let [clean, now] = [&clean, &picture].map(|it| &it.colour[eye][at..at + 3]);
            assert!(now.iter().zip(clean).all(|(now, clean)| now <= clean));
            // Nothing is brighter, and blue goes first.
            now[2] + 4 < clean[2]
        };
        let mut count = 0;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let left = covered(0, x, y);
            assert_eq!(left, covered(1, width - 1 - x, y), "{x} {y}");
            count += usize::from(left);
        }
        assert!(!covered(0, width / 2, height / 2), "the middle is covered");
        assert!(count > before + 60, "splash {splashes}: {before} {count}");
        before = count;
    }
    // π r² of all six, less what is beyond the edges and too faint for eight bits.
    let share = before as f32 / (width * height) as f32;
    assert!((0.12..0.30).contains(&share), "{share}");
}

/// In a part of the eyes' pictures splashes are where the eyes see them.
#[test]
fn a_part_has_the_splashes_of_the_whole() {
    let rig = Rig::new(EXTENT, 2);
    let views = eyes();
    // So many pixels from the left and the top, and so large.
    let [corner, size] = [[10, 8], [48, 40]];
    let parts = views.map(|view| {
        let Fov {
            left,
            right,
            up,
            down,
        } = view.fov;
        let along = |from: f32, to: f32, pixel: u32, pixels: u32| {
            let share = pixel as f32 / pixels as f32;
            (from.tan() + share * (to.tan() - from.tan())).atan()
        };
        View {
            fov: Fov {
                left: along(left, right, corner[0], EXTENT[0]),
                right: along(left, right, corner[0] + size[0], EXTENT[0]),
                up: along(up, down, corner[1], EXTENT[1]),
                down: along(up, down, corner[1] + size[1], EXTENT[1]),
            },
            ..view
        }
    });
    let whole = rig.draw(&FrameDesc {
        goggles: 1.0,
        ..FrameDesc::empty(&views)
    });
    let part = rig.draw(&FrameDesc {
        goggles: 1.0,
        extent: Some(size),
        part_of: Some(&views),
        ..FrameDesc::empty(&parts)
    });
    let mut covered = 0;
    for (x, y) in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))) {
        for eye in 0..2 {
            let at = |x: u32, y: u32| 4 * (y * EXTENT[0] + x) as usize;
            let inner = &part.colour[eye][at(x, y)..][..3];
            let outer = &whole.colour[eye][at(x + corner[0], y + corner[1])..][..3];
            // Rounding of tangents.
            let apart = inner.iter().zip(outer).map(|(a, b)| a.abs_diff(*b)).max();
            assert!(apart <= Some(1), "{x} {y}: {inner:?} {outer:?}");
            covered += u32::from(inner[2] < whole.colour[0][at(48, 40)..][2] - 4);
        }
    }
    assert!(covered > 200, "{covered}");
}
