//! The label in the window, beside what the pointer is at.

use std::cell::Cell;
use std::rc::Rc;

use crate::desk::common::{By, Script, User, sat};
use crate::desk::seen::SOURCE;
use glam::Vec3;
use vitriol_tests::screen::Button;

/// Ground of the label, and of the panel's lowest line.
const GROUND: [u8; 3] = [54, 34, 84];
/// Fewest pixels of a label: a line of text 12 pixels high, ten letters wide.
const LABEL: usize = 1000;

/// How many pixels of the window have that ground, and whether none of them is within 5 pixels of the pointer.
fn ground(user: &User) -> (usize, bool) {
    let ([width, _], pixels) = user.screen.picture(user.window);
    let is_far = |n: usize| {
        let at = [n % width as usize, n / width as usize];
        (0..2).any(|side| at[side].abs_diff(user.pointer[side] as usize) > 5)
    };
    let ground = (0..pixels.len()).filter(|n| pixels[*n] == GROUND);
    (ground.clone().count(), ground.clone().all(is_far))
}

#[test]
fn a_label_is_beside_a_flask_until_that_is_held() {
    let name = "desk::label::a_label_is_beside_a_flask_until_that_is_held";
    let without = Rc::new(Cell::new(0));
    let [noted, before, after] = [0; 3].map(|_| Rc::clone(&without));
    let script = Script::default()
        .then("points at the table", move |user, seen, frame| {
            if frame == 0 {
                // Far from both flasks, to the left.
                user.point_at(seen, seen.foot(SOURCE) - 0.25 * Vec3::X);
            }
            noted.set(ground(user).0);
            !seen.is_ringed(SOURCE) && frame >= 10
        })
        .then("points at a flask", move |user, seen, frame| {
            if frame.is_multiple_of(10) {
                user.point_at(seen, seen.middle(SOURCE));
            }
            let (count, is_clear) = ground(user);
            let is_there = count > before.get() + LABEL;
            assert!(!is_there || is_clear, "the label covers the pointer");
            is_there && seen.is_ringed(SOURCE)
        })
        .then("takes it", move |user, seen, frame| {
            if frame == 0 {
                user.button(Button::Main, true);
            }
            seen.holder(SOURCE).is_some() && ground(user).0 < after.get() + LABEL / 2
        });
    let Some((_gpu, sat)) = sat(name, By::Mouse, |_, _| script) else {
        return;
    };
    assert_eq!(sat.ended_in, None);
}
