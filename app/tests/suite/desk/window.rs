//! The window: other sizes of it, and the key that ends the session.

use crate::desk::common::{By, Script, at_screen, points, session};
use crate::desk::seen::{SOURCE, Seen};
use crate::vr::common::hash;
use crate::vr::loss::replayed;
use glam::Vec3;
use vitriol_tests::gpu;
use vitriol_tests::screen::{self, key};

/// Sizes that the window is given, pixels: an old screen's, and one wider than any.
const SIZES: [[u32; 2]; 2] = [[640, 480], [1000, 300]];

/// Whether a picture fills the window. Where it does not, bars of pure black are at two of its sides. One line may be lost to rounding;
/// of the next one most is lit, whose picture is of a room.
fn fills(([width, height], pixels): ([u32; 2], Vec<[u8; 3]>)) -> bool {
    let [width, height] = [width as usize, height as usize];
    let lit = |x: usize, y: usize| pixels[y * width + x] != [0; 3];
    let row = |y: usize| (0..width).filter(|x| lit(*x, y)).count() > width / 2;
    let column = |x: usize| (0..height).filter(|y| lit(x, *y)).count() > height / 2;
    row(1) && row(height - 2) && column(1) && column(width - 2)
}

/// Whether lengths across and down are the same in the picture: the field of view has the window's aspect, to a pixel of its shorter side,
/// and so has what was drawn.
fn is_undistorted(seen: &Seen<'_>, [width, height]: [u32; 2]) -> bool {
    let aspect = |[width, height]: [u32; 2]| width as f32 / height as f32;
    let wanted = aspect([width, height]);
    let pixel = 1.0 / width.min(height) as f32;
    let near = |found: f32| (found / wanted - 1.0).abs() < pixel;
    near(seen.aspect()) && near(aspect(seen.drawn))
}

/// Gives the window that size, looks at it, and finds the flask in it with the pointer.
fn resizes(script: Script, size: [u32; 2]) -> Script {
    let script = script
        .then("resizes the window", move |user, seen, frame| {
            if frame == 0 {
                user.screen.resize(user.window, size);
            }
            let done = user.screen.extent(user.window) == size;
            done && is_undistorted(seen, size) && fills(user.screen.picture(user.window))
        })
        .then("points at the table", |user, seen, frame| {
            if frame == 0 {
                // Far from both flasks, to the left.
                let table = seen.foot(SOURCE) - 0.25 * Vec3::X;
                user.point_at(seen, table);
            }
            !seen.is_ringed(SOURCE)
        });
    points(script)
}

#[test]
fn a_window_of_any_size_is_filled_and_its_pointer_hits() {
    let name = "desk::window::a_window_of_any_size_is_filled_and_its_pointer_hits";
    let Some(screen) = screen::enter(name) else {
        return;
    };
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let script = SIZES.into_iter().fold(points(Script::default()), resizes);
    let sat = session(&gpu, (screen, By::Mouse), at_screen(folder.path()), script);
    assert_eq!(sat.ended_in, None);
    // Nothing of it is in what was simulated.
    assert_eq!(replayed(&gpu, sat.track), hash(&sat.outcome));
}

/// Frames in which a session that one Escape ends would have ended.
const GOES_ON: u64 = 20;

#[test]
fn escape_ends_when_it_is_pressed_twice() {
    let name = "desk::window::escape_ends_when_it_is_pressed_twice";
    let Some(screen) = screen::enter(name) else {
        return;
    };
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let script = Script::default()
        .then("presses Escape", |user, _, frame| {
            if frame == 0 {
                user.tap(key::ESCAPE);
            }
            frame == GOES_ON
        })
        // Twice, since the first time may be too long ago.
        .then("presses it twice", |user, _, frame| {
            if frame == 0 {
                user.tap(key::ESCAPE);
                user.tap(key::ESCAPE);
            }
            false
        });
    let sat = session(&gpu, (screen, By::Keys), at_screen(folder.path()), script);
    assert_eq!(sat.ended_in, Some("presses it twice"));
    assert!(sat.outcome.frames > GOES_ON, "{}", sat.outcome.frames);
    assert_eq!(sat.screen.find("Vitriol"), None);
}
