//! Acid on the goggles.

use crate::rig::{Rig, without_particles};
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
            ..without_particles(&views)
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
