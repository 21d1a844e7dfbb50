//! What wheel, secondary button and keys do to a flask that the main button holds, and that it stands again once that is released.

use crate::desk::common::{By, Script, User, points, puts_down, sat, takes};
use crate::desk::seen::{SOURCE, Seen, level};
use crate::desk::taken::is_whole;
use vitriol_tests::screen::{Button, key};

/// Notches of the wheel, and by how much each raises the flask, m (`NOTCH` of the desk's hands).
const NOTCHES: i32 = 3;
const NOTCH: f32 = 0.02;
/// Events of a notch: winit 0.30.13 sends one as a wheel without a scroll axis, as this screen's, is pressed, and one as it is released.
const EVENTS: f32 = 2.0;
/// How far the pointer is dragged to the right with the secondary button, pixels of 320, which are two thirds of a turn: 22.5°.
const DRAG: i32 = 30;
/// A tilt that is none, and one that is seen, degrees.
const UPRIGHT: f32 = 2.0;
const TILTED: f32 = 5.0;

/// How far keys raise the flask, and lower it then, m.
const RISES: f32 = 0.06;
const SINKS: f32 = 0.03;

/// Whether the flask has stood still for some frames.
fn rests(user: &mut User, seen: &Seen<'_>) -> bool {
    let at = seen.foot(SOURCE);
    user.brings(seen, (at, at), 1.0, false)
}

/// Drags the pointer to the right by so many pixels, or to the left where they are negative.
fn drags(user: &mut User, pixels: i32) {
    let [x, y] = user.pointer;
    user.point([x + pixels, y]);
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
                drags(user, DRAG);
            }
            seen.tilt(SOURCE) > TILTED && rests(user, seen)
        })
        .then("looks that it only tilts", |user, seen, _| {
            let side = seen.holder(SOURCE).unwrap();
            // Dragged along, the hand would have gone with the pointer: by some 10 cm.
            let moved = level(seen.palm(side) - user.noted[1]);
            assert!(moved.length() < 0.03, "{moved}");
            // To the right, where the pointer went, and not towards the user.
            let axis = seen.axis(SOURCE);
            assert!(axis.x > 0.0 && axis.z.abs() < 0.5 * axis.x, "{axis}");
            true
        })
        .then("drags back", |user, seen, frame| {
            if frame == 0 {
                drags(user, -DRAG);
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
    let script = raises_and_tilts(takes(points(Script::default())));
    let Some((gpu, sat)) = sat(name, By::Mouse, |_, _| puts_down(script)) else {
        return;
    };
    // It was tilted by a few degrees.
    is_whole(&gpu, sat);
}

/// Raises and lowers what is held with the page keys, to no side.
pub fn raises_and_lowers_by_keys(script: Script) -> Script {
    script
        .then("notes where it is", |user, seen, _| {
            user.noted[0] = seen.foot(SOURCE);
            rests(user, seen)
        })
        .then("holds Page Up", |user, seen, _| {
            let risen = seen.foot(SOURCE).y - user.noted[0].y;
            user.hold(key::PAGE_UP, risen < RISES);
            risen >= RISES
        })
        .then("notes how high it is", |user, seen, _| {
            user.noted[1] = seen.foot(SOURCE);
            rests(user, seen)
        })
        .then("holds Page Down", |user, seen, _| {
            let sunk = user.noted[1].y - seen.foot(SOURCE).y;
            user.hold(key::PAGE_DOWN, sunk < SINKS);
            sunk >= SINKS
        })
        .then("looks that it only rose and sank", |user, seen, _| {
            let aside = level(seen.foot(SOURCE) - user.noted[0]);
            assert!(aside.length() < 0.01, "{aside}");
            assert!(seen.tilt(SOURCE) < UPRIGHT, "{}", seen.tilt(SOURCE));
            rests(user, seen)
        })
}
