//! What wheel and secondary button do to a flask that the main button holds, and that it stands again once that is released.

use crate::desk::common::{By, Script, User, at_screen, points, puts_down, session, takes};
use crate::desk::seen::{SOURCE, Seen, level};
use crate::vr::common::hash;
use crate::vr::loss::replayed;
use glam::Vec3;
use vitriol_tests::gpu;
use vitriol_tests::screen::{self, Button};

/// Notches of the wheel, and by how much each raises the flask, m (`NOTCH` of the desk's hands).
const NOTCHES: i32 = 3;
const NOTCH: f32 = 0.02;
/// Events of a notch: winit 0.30.13 sends one as a wheel without a scroll axis, as this screen's, is pressed, and one as it is released.
const EVENTS: f32 = 2.0;
/// How far the pointer is dragged with the secondary button, pixels: an eighth of the window's height.
const DRAG: i32 = 30;
/// A tilt that is none, and one that is seen, degrees.
const UPRIGHT: f32 = 2.0;
const TILTED: f32 = 5.0;

/// Whether the flask has stood still for some frames.
fn rests(user: &mut User, seen: &Seen<'_>) -> bool {
    let at = seen.foot(SOURCE);
    user.brings(seen, (at, at), 1.0, false)
}

/// Drags the pointer up, or down, by [`DRAG`].
fn drags(user: &mut User, up: bool) {
    let [x, y] = user.pointer;
    user.point([x, if up { y - DRAG } else { y + DRAG }]);
}

fn raises_and_tilts(script: Script) -> Script {
    script
        .then("notes where it is", |user, seen, _| {
            user.noted[0] = seen.foot(SOURCE);
            rests(user, seen)
        })
        .then("turns the wheel", |user, seen, frame| {
            if frame == 0 {
                user.wheel(NOTCHES);
            }
            let risen = seen.foot(SOURCE).y - user.noted[0].y;
            risen > 0.5 * NOTCH && rests(user, seen)
        })
        .then("looks how high it is", |user, seen, _| {
            // With the two centimetres by which what is moved is lifted off the table, and one for how it comes to rest.
            let risen = seen.foot(SOURCE).y - user.noted[0].y;
            let wheel = EVENTS * NOTCHES as f32 * NOTCH;
            assert!((wheel - 0.01..wheel + 0.03).contains(&risen), "{risen} m");
            true
        })
        .then("drags with the secondary button", |user, seen, frame| {
            if frame == 0 {
                let side = seen.holder(SOURCE).unwrap();
                user.noted[1] = seen.palm(side);
                user.button(Button::Secondary, true);
                drags(user, true);
            }
            seen.tilt(SOURCE) > TILTED && rests(user, seen)
        })
        .then("looks that it only tilts", |user, seen, _| {
            let side = seen.holder(SOURCE).unwrap();
            // Dragged along, the hand would have gone with the pointer: by some 7 cm.
            let moved = level(seen.palm(side) - user.noted[1]);
            assert!(moved.length() < 0.03, "{moved}");
            // To the left or to the right, not towards the user.
            let axis = seen.axis(SOURCE);
            assert!(axis.z.abs() < 0.5 * axis.x.abs(), "{axis}");
            true
        })
        .then("drags back", |user, seen, frame| {
            if frame == 0 {
                drags(user, false);
            }
            seen.tilt(SOURCE) < UPRIGHT && rests(user, seen)
        })
        .then("lets the secondary button go", |user, _, _| {
            user.button(Button::Secondary, false);
            true
        })
}

#[test]
fn wheel_and_secondary_button_raise_and_tilt_what_is_held() {
    let name = "desk::hold::wheel_and_secondary_button_raise_and_tilt_what_is_held";
    let Some(screen) = screen::enter(name) else {
        return;
    };
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let script = raises_and_tilts(takes(points(Script::default())));
    let options = at_screen(folder.path());
    let sat = session(&gpu, (screen, By::Mouse), options, puts_down(script));
    assert_eq!(sat.ended_in, None);
    // 150 g of water: none was spilt, as it was tilted by a few degrees.
    let measured = sat.outcome.world.measure().unwrap();
    assert!(measured.in_flasks[SOURCE] > 0.149, "{measured:?}");
    let stands = sat.outcome.world.poses()[SOURCE];
    assert!((stands.orientation * Vec3::Y).y > 0.999, "{stands:?}");
    assert_eq!(sat.outcome.world.holder(SOURCE), None);
    assert_eq!(replayed(&gpu, sat.track), hash(&sat.outcome));
}
