//! The panel: it fills the picture at a key, and its buttons are pressed with the mouse.

use crate::desk::common::{By, Script, User, sat};
use crate::desk::seen::{SOURCE, Seen, TARGET};
use crate::vr::common::switched;
use crate::vr::panel::place_at_desk;
use glam::Vec3;
use vitriol_run::Action;
use vitriol_run::track::key;
use vitriol_session::decision::Decision;
use vitriol_session::panel::PANEL;
use vitriol_sim::bodies::GRIP_REACH;
use vitriol_tests::screen::{Button, key as keys};
use vitriol_xr::Side;

/// R lets the panel fill the picture.
const FILLS: u32 = 'r' as u32;
/// B begins the scene anew.
const STARTS: u32 = 'b' as u32;
/// Ground of the strip at the window's upper edge.
const STRIP: [u8; 3] = [54, 34, 84];

/// Where a place of the panel is in the stage: shares of its width and height from its upper left.
fn on_panel(seen: &Seen<'_>, [x, y]: [f32; 2]) -> Vec3 {
    let (pose, [width, height]) = &seen.around.panel;
    pose.transform_point(Vec3::new((x - 0.5) * width, (0.5 - y) * height, 0.0))
}

/// The same of a place in pixels of the panel.
fn button(seen: &Seen<'_>, [x, y]: [f32; 2]) -> Vec3 {
    on_panel(seen, [x / PANEL[0] as f32, y / PANEL[1] as f32])
}

/// Whether a hand aims at that point, to half a button's height (23 of 864 pixels of 0.6 m).
fn is_aimed_at(seen: &Seen<'_>, point: Vec3) -> bool {
    Side::BOTH.into_iter().any(|side| {
        let aim = seen.frame.hand(side).stage_from_aim;
        let (way, to) = (aim.orientation * Vec3::NEG_Z, point - aim.position);
        way.dot(to) > 0.0 && (to - way * way.dot(to)).length() < 0.016
    })
}

/// Whether a hand pulls its trigger.
fn pulls(seen: &Seen<'_>) -> bool {
    (seen.frame.hands.iter()).any(|hand| hand.trigger > 0.6)
}

/// Whether the panel is as large as the picture, and the view at rest.
fn looks(user: &mut User, seen: &Seen<'_>) -> bool {
    let ends = [[0.0, 0.0], [1.0, 1.0]].map(|end| seen.place(on_panel(seen, end)));
    let was = user.noted;
    user.noted = ends.map(|[x, y]| Vec3::new(x, y, 0.0));
    let rests = (was.iter().zip(&user.noted)).all(|(was, is)| was.distance(*is) < 1e-3);
    let inside = ends
        .as_flattened()
        .iter()
        .all(|it| (0.0..=1.0).contains(it));
    rests && inside && ends[1][1] - ends[0][1] > 0.8
}

/// The window's picture where the panel's buttons are.
fn buttons(user: &User, seen: &Seen<'_>) -> Vec<[u8; 3]> {
    let ([width, height], pixels) = user.screen.picture(user.window);
    let corner = |at| {
        let [x, y] = seen.place(on_panel(seen, at));
        [x * width as f32, y * height as f32].map(|it| it as usize)
    };
    let ([left, upper], [right, lower]) = (corner([0.55, 0.1]), corner([0.95, 0.7]));
    let rows = pixels.chunks_exact(width as usize).take(lower).skip(upper);
    rows.flat_map(|row| row[left..right].to_vec()).collect()
}

/// Share of pixels that are not what they were.
fn changed(was: &[[u8; 3]], is: &[[u8; 3]]) -> f32 {
    // More than what an edge loses to another rounding of its place.
    let differs = |(a, b): (&[u8; 3], &[u8; 3])| (0..3).any(|it| a[it].abs_diff(b[it]) > 12);
    let count = was.iter().zip(is).filter(|pair| differs(*pair)).count();
    count as f32 / was.len().max(1) as f32
}

/// Lets the panel fill the picture.
fn looks_at_it(script: Script) -> Script {
    script.then("looks at the panel", |user, seen, frame| {
        if frame == 0 {
            user.tap(FILLS);
        }
        looks(user, seen)
    })
}

/// Clicks the button of what happened, which is there: the list of scenes gives way to the summary.
fn asks_what_happened(script: Script, summary: [f32; 2]) -> Script {
    let mut before = Vec::new();
    script
        .then("points at what happened", move |user, seen, frame| {
            if frame == 0 {
                user.point_at(seen, button(seen, summary));
            }
            is_aimed_at(seen, button(seen, summary)) && !pulls(seen) && frame >= 5
        })
        .then("clicks", move |user, seen, frame| {
            let now = buttons(user, seen);
            if frame == 0 {
                before = now;
                user.click();
                return false;
            }
            // A button that lights up under the pointer is some 5 % of that.
            changed(&before, &now) > 0.15
        })
}

#[test]
fn buttons_of_the_panel_are_pressed_with_the_mouse() {
    let name = "desk::panel::buttons_of_the_panel_are_pressed_with_the_mouse";
    let sat = sat(name, By::Mouse, |gpu, _| {
        let start = place_at_desk(gpu, &Decision::Act(Action::Start(None)));
        let summary = place_at_desk(gpu, &Decision::Summary);
        let script = looks_at_it(Script::default())
            .then(
                "points at the button of a new start",
                move |user, seen, frame| {
                    if frame == 0 {
                        user.point_at(seen, button(seen, start));
                    }
                    is_aimed_at(seen, button(seen, start)) && !pulls(seen)
                },
            )
            // The scene begins anew only after a second; the window's title then says so.
            .then("holds it", |user, seen, frame| {
                if frame == 0 {
                    user.button(Button::Main, true);
                }
                let title = user.screen.title(user.window);
                let begins = title.is_some_and(|it| it.contains("setting up"));
                if begins {
                    assert!(pulls(seen));
                    user.button(Button::Main, false);
                }
                begins
            })
            .then("waits for the bench", |user, seen, _| {
                let title = user.screen.title(user.window);
                !pulls(seen) && title.is_some_and(|it| !it.contains("setting up"))
            })
            // What fades in is dark at first.
            .then("waits for its light", |_, seen, frame| {
                frame >= 20 && seen.lasts > 0.5
            });
        asks_what_happened(script, summary)
    });
    let Some((_gpu, sat)) = sat else { return };
    assert_eq!(sat.ended_in, None);
    assert_eq!(switched(&sat.track, key::START), 1);
    assert_eq!(sat.outcome.attempts.len(), 2);
    // A press on the panel grips nothing.
    assert!(
        sat.outcome
            .attempts
            .iter()
            .all(|it| it.incidents.is_empty())
    );
}

/// Whether the window's title says that a bench is set up.
fn is_set_up(user: &User) -> bool {
    let title = user.screen.title(user.window);
    title.is_some_and(|it| it.contains("setting up"))
}

#[test]
fn a_key_that_loses_work_is_held() {
    let name = "desk::panel::a_key_that_loses_work_is_held";
    let script = Script::default()
        .then("taps B, and is told to hold it", |user, _, frame| {
            if frame.is_multiple_of(50) {
                user.tap(STARTS);
            }
            assert!(!is_set_up(user));
            let (_, pixels) = user.screen.picture(user.window);
            pixels[0] == STRIP
        })
        // No less of display time, in which a hold would have come to its end.
        .then("waits", |user, seen, _| {
            assert!(!is_set_up(user));
            seen.lasts > 1.5
        })
        .then("holds it", |user, _, _| {
            let begins = is_set_up(user);
            user.hold(STARTS, !begins);
            begins
        })
        .then("waits for the bench", |user, _, _| !is_set_up(user));
    let Some((_gpu, sat)) = sat(name, By::Keys, |_, _| script) else {
        return;
    };
    assert_eq!(sat.ended_in, None);
    assert_eq!(switched(&sat.track, key::START), 1);
}

/// Takes a flask by key with the active hand, which keeps it.
fn keeps(script: Script, flask: usize) -> Script {
    script
        .then("points at a flask", move |user, seen, frame| {
            if frame.is_multiple_of(10) {
                user.point_at(seen, seen.middle(flask));
            }
            seen.is_ringed(flask) && seen.gap(flask) < GRIP_REACH
        })
        .then("takes it by key", move |user, seen, frame| {
            if frame == 0 {
                user.tap(keys::SPACE);
            }
            seen.holder(flask).is_some()
        })
}

mod long {
    use super::*;

    /// Both hands keep what they hold, and where they hold it.
    #[test]
    fn a_button_is_pressed_with_both_hands_full() {
        let name = "desk::panel::long::a_button_is_pressed_with_both_hands_full";
        let sat = sat(name, By::Mouse, |gpu, _| {
            let summary = place_at_desk(gpu, &Decision::Summary);
            let script =
                keeps(Script::default(), SOURCE).then("changes the hand", |user, seen, frame| {
                    if frame == 0 {
                        user.tap(keys::TAB);
                    }
                    seen.lasts > 0.3
                });
            asks_what_happened(looks_at_it(keeps(script, TARGET)), summary)
        });
        let Some((_gpu, sat)) = sat else { return };
        assert_eq!(sat.ended_in, None);
        let world = &sat.outcome.world;
        let holders = [SOURCE, TARGET].map(|flask| world.holder(flask));
        assert!(holders.iter().all(Option::is_some), "{holders:?}");
        let stood = world.scene().flasks.iter().map(|it| it.stage_from_flask);
        for (was, is) in stood.zip(world.poses()) {
            let moved = was.position.distance(is.position);
            // As far as a hand that closes stirs what it takes.
            assert!(moved < 0.005, "{moved} m");
        }
    }
}
