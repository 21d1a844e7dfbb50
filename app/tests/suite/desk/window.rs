//! The window: other sizes of it, what its view shows, and the keys that turn the view, fill the screen and end the session.

use crate::desk::common::{By, Script, at_screen, points, sat, session, session_at, spec};
use crate::desk::seen::{SOURCE, Seen};
use crate::vr::common::hash;
use crate::vr::loss::replayed;
use glam::Vec3;
use vitriol_session::desk::DeskSpec;
use vitriol_tests::gpu;
use vitriol_tests::screen::{self, key};
use vitriol_xr::Side;

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
    let script = SIZES.into_iter().fold(points(Script::default()), resizes);
    let Some((gpu, sat)) = sat(name, By::Mouse, |_, _| script) else {
        return;
    };
    assert_eq!(sat.ended_in, None);
    // Nothing of it is in what was simulated.
    assert_eq!(replayed(&gpu, sat.track), hash(&sat.outcome));
}

/// Frames in which a session that one Escape ends would have ended.
const GOES_ON: u64 = 20;

#[test]
fn escape_ends_when_it_is_pressed_twice() {
    let name = "desk::window::escape_ends_when_it_is_pressed_twice";
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
    let Some((_gpu, sat)) = sat(name, By::Keys, |_, _| script) else {
        return;
    };
    assert_eq!(sat.ended_in, Some("presses it twice"));
    assert!(sat.outcome.frames > GOES_ON, "{}", sat.outcome.frames);
    assert_eq!(sat.screen.find("Vitriol"), None);
}

/// A window manager fills the screen; the program asks it to, and to end that.
#[test]
fn f11_asks_for_the_whole_screen_and_back() {
    let name = "desk::window::f11_asks_for_the_whole_screen_and_back";
    let Some(screen) = screen::enter(name) else {
        return;
    };
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    screen.watch();
    let presses = |script: Script, fills: bool| {
        script.then("presses F11", move |user, _, frame| {
            if frame == 0 {
                user.tap(key::F11);
            }
            let asked = user.screen.asked_to_fill();
            assert!(asked.iter().all(|it| *it == fills), "{asked:?}");
            !asked.is_empty()
        })
    };
    let script = [true, false].into_iter().fold(Script::default(), presses);
    let sat = session(&gpu, (screen, By::Keys), at_screen(folder.path()), script);
    assert_eq!(sat.ended_in, None);
}

/// How far the eye goes to the right, m: 9° about a bench that is 0.67 m away.
const TURNS: f32 = 0.1;
/// What a hand that rests moves at most, m.
const RESTS: f32 = 0.01;

/// Where the eye is, m.
fn eye(seen: &Seen<'_>) -> Vec3 {
    seen.frame.stage_from_view.position
}

#[test]
fn arrows_turn_the_view_with_control_and_move_no_hand() {
    let name = "desk::window::arrows_turn_the_view_with_control_and_move_no_hand";
    let script = Script::default()
        .then("waits", |user, seen, frame| {
            user.noted = Side::BOTH.map(|side| seen.palm(side));
            frame >= 10
        })
        .then("holds Ctrl and an arrow", |user, seen, frame| {
            let turned = eye(seen).x > TURNS;
            if frame == 0 {
                user.hold(key::CONTROL, true);
                user.hold(key::RIGHT, true);
            } else if turned {
                // Without Ctrl the arrow would move the hand.
                user.hold(key::RIGHT, false);
                user.hold(key::CONTROL, false);
            }
            turned
        })
        .then("goes back", |user, seen, frame| {
            if frame == 0 {
                user.tap(key::HOME);
            }
            for side in Side::BOTH {
                let moved = seen.palm(side).distance(user.noted[side as usize]);
                assert!(moved < RESTS, "{side:?}: {moved} m");
            }
            eye(seen).x.abs() < 0.1 * TURNS
        });
    let Some((_gpu, sat)) = sat(name, By::Keys, |_, _| script) else {
        return;
    };
    assert_eq!(sat.ended_in, None);
}

/// Angle that a window is opened with, degrees; another one; and what is the same, since the view comes to rest ever more slowly.
const NARROW: f32 = 40.0;
const WIDER: f32 = 45.0;
const SAME: f32 = 0.5;

/// The angle between the picture's upper and lower side, degrees.
fn angle(seen: &Seen<'_>) -> f32 {
    let fov = &seen.frame.info.fov[0];
    (fov.up - fov.down).to_degrees()
}

#[test]
fn a_window_opens_with_its_field_of_view_and_the_wheel_changes_it() {
    let name = "desk::window::a_window_opens_with_its_field_of_view_and_the_wheel_changes_it";
    let Some(screen) = screen::enter(name) else {
        return;
    };
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let script = Script::default()
        .then("looks", |_, seen, _| {
            assert!((angle(seen) - NARROW).abs() < SAME, "{}", angle(seen));
            true
        })
        .then("turns the wheel with Ctrl", |user, seen, frame| {
            if frame == 0 {
                // A wheel is the window's over which the pointer is.
                user.point([160, 120]);
                user.hold(key::CONTROL, true);
                user.wheel(-2);
                user.hold(key::CONTROL, false);
            }
            angle(seen) > WIDER
        })
        .then("goes home", |user, seen, frame| {
            if frame == 0 {
                user.tap(key::HOME);
            }
            (angle(seen) - NARROW).abs() < SAME
        });
    let spec = DeskSpec {
        fov: NARROW,
        ..spec()
    };
    let (seat, options) = ((screen, By::Mouse), at_screen(folder.path()));
    let sat = session_at(&gpu, seat, options, script, (spec, |desk| desk));
    assert_eq!(sat.ended_in, None);
}
