//! How a flask stays in the hand, and how it is put down: by a second click, by another window, in a window of another size, and while the
//! other hand is used.

use crate::desk::common::{
    By, Sat, Script, at_screen, points, puts_down, sat, session_at, spec, stands, takes,
};
use crate::desk::hold::raises_and_lowers_by_keys;
use crate::desk::seen::{SOURCE, Seen, TARGET, level};
use crate::vr::common::hash;
use crate::vr::loss::replayed;
use glam::Vec3;
use vitriol_gpu::Gpu;
use vitriol_session::desk::DeskSpec;
use vitriol_sim::bodies::GRIP_REACH;
use vitriol_tests::gpu;
use vitriol_tests::screen::{self, Button, key};

/// How far the flask is carried, m, away from the other one.
const ASIDE: f32 = 0.08;
/// Where a flask is to be, m: a finger's breadth.
const NEAR: f32 = 0.02;
/// How far from where it was pointed to a flask may be after one movement, m: it is carried above the point at which the pointer is.
const UNDER: f32 = 0.05;
/// A flask that a hand steadies stays where it is, m.
const STEADY: f32 = 0.005;

/// Where the flask is carried to.
fn aside(home: Vec3) -> Vec3 {
    home - ASIDE * Vec3::X
}

/// Carries the flask away from the other one, by the pointer alone.
fn carries_aside(script: Script) -> Script {
    script.then("carries it aside", |user, seen, frame| {
        let to = aside(user.home.unwrap());
        user.brings(seen, (seen.foot(SOURCE), to), NEAR, frame == 0)
    })
}

/// Both flasks stand, nothing was spilt, and a replay comes to the same bits.
pub fn is_whole(gpu: &Gpu, sat: Sat) {
    assert_eq!(sat.ended_in, None);
    let world = &sat.outcome.world;
    let measured = world.measure().unwrap();
    // 150 g of water.
    assert!(measured.in_flasks[SOURCE] > 0.149, "{measured:?}");
    for flask in [SOURCE, TARGET] {
        let stands = world.poses()[flask];
        assert_eq!(world.holder(flask), None);
        assert!((stands.orientation * Vec3::Y).y > 0.999, "{stands:?}");
    }
    assert_eq!(replayed(gpu, sat.track), hash(&sat.outcome));
}

/// How far the source stands from where it stood, m.
fn moved(sat: &Sat) -> Vec3 {
    let stood = sat.outcome.world.scene().flasks[SOURCE].stage_from_flask;
    sat.outcome.world.poses()[SOURCE].position - stood.position
}

/// With no button down it is carried.
#[test]
fn a_click_takes_and_a_click_puts_down() {
    let name = "desk::taken::a_click_takes_and_a_click_puts_down";
    let Some(screen) = screen::enter(name) else {
        return;
    };
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let script = points(Script::default()).then("clicks it", |user, seen, frame| {
        if frame == 0 {
            user.click();
        }
        seen.holder(SOURCE).is_some()
    });
    let script = carries_aside(script).then("clicks again", |user, seen, frame| {
        if frame == 0 {
            user.click();
        }
        stands(seen, SOURCE)
    });
    let (seat, options) = ((screen, By::Mouse), at_screen(folder.path()));
    let spec = DeskSpec {
        toggles: true,
        ..spec()
    };
    let sat = session_at(&gpu, seat, options, script, (spec, |desk| desk));
    let away = moved(&sat) + ASIDE * Vec3::X;
    // As near as it was carried, and 1 cm for how it is put down.
    assert!(level(away).length() < NEAR + 0.01, "{away}");
    is_whole(&gpu, sat);
}

/// The button is still down when another window gets the keyboard; what a user does then is for that one.
#[test]
fn another_window_puts_the_flask_down() {
    let name = "desk::taken::another_window_puts_the_flask_down";
    let script = carries_aside(takes(points(Script::default())))
        .then("goes to another window", |user, seen, frame| {
            if frame == 0 {
                user.screen.unfocus();
            }
            stands(seen, SOURCE)
        })
        .then("lets the button go there", |user, seen, frame| {
            if frame == 0 {
                user.button(Button::Main, false);
            }
            assert!(seen.holder(SOURCE).is_none());
            seen.lasts > 0.3
        });
    if let Some((gpu, sat)) = sat(name, By::Mouse, |_, _| script) {
        is_whole(&gpu, sat);
    }
}

/// Size of the window while the flask is in the hand, pixels: of another aspect.
const RESIZED: [u32; 2] = [480, 300];

/// Whether the picture has the aspect of that size, to a pixel.
fn has_aspect(seen: &Seen<'_>, [width, height]: [u32; 2]) -> bool {
    let wanted = width as f32 / height as f32;
    (seen.aspect() / wanted - 1.0).abs() < 1.0 / height as f32
}

fn resized_in_mid_drag(script: Script) -> Script {
    script
        .then("resizes the window", |user, seen, frame| {
            if frame == 0 {
                user.screen.resize(user.window, RESIZED);
            }
            assert!(seen.holder(SOURCE).is_some());
            user.screen.extent(user.window) == RESIZED && has_aspect(seen, RESIZED)
        })
        .then("carries it on", |user, seen, frame| {
            assert!(seen.holder(SOURCE).is_some());
            let at = seen.foot(SOURCE);
            if frame == 0 {
                // It was taken by its middle. This is a single movement, whatever comes of it.
                let to = user.home.unwrap().with_y(at.y);
                user.point_at(seen, seen.middle(SOURCE) + (to - at));
            }
            // It takes less than a second.
            user.brings(seen, (at, at), 1.0, false) && seen.lasts > 1.0
        })
        .then("looks where it is", |user, seen, _| {
            let off = level(user.home.unwrap() - seen.foot(SOURCE));
            assert!(off.length() < UNDER, "{off}");
            true
        })
}

/// Takes the other flask with the other hand, which only steadies it, while the first one keeps what it holds.
fn steadies(script: Script) -> Script {
    script
        .then("changes the hand", |user, seen, frame| {
            if frame == 0 {
                user.noted = [SOURCE, TARGET].map(|flask| seen.foot(flask));
                user.tap(key::TAB);
                // It is the first hand's no more.
                user.button(Button::Main, false);
            }
            assert!(seen.holder(SOURCE).is_some());
            seen.lasts > 0.3
        })
        .then("points at the other flask", |user, seen, frame| {
            if frame.is_multiple_of(10) {
                user.point_at(seen, seen.middle(TARGET));
            }
            seen.is_ringed(TARGET) && seen.gap(TARGET) < GRIP_REACH
        })
        .then("takes it", |user, seen, frame| {
            if frame == 0 {
                user.button(Button::Main, true);
            }
            let holders = [SOURCE, TARGET].map(|flask| seen.holder(flask));
            assert!(holders[0].is_some() && holders[0] != holders[1]);
            holders[1].is_some()
        })
        .then("steadies it", |user, seen, _| {
            for flask in [SOURCE, TARGET] {
                assert!(seen.holder(flask).is_some());
                let moved = seen.foot(flask) - user.noted[flask];
                assert!(moved.length() < STEADY, "{flask}: {moved}");
            }
            seen.lasts > 0.5
        })
        .then("lets it go", |user, seen, frame| {
            if frame == 0 {
                user.button(Button::Main, false);
            }
            assert!(seen.holder(SOURCE).is_some());
            stands(seen, TARGET)
        })
        .then("puts the first one down", |user, seen, frame| {
            if frame == 0 {
                user.tap(key::TAB);
            } else if frame == 5 {
                user.tap(key::SPACE);
            }
            stands(seen, SOURCE)
        })
}

mod long {
    use super::*;

    /// And what is held still goes up and down by keys.
    #[test]
    fn a_window_may_change_its_size_while_a_flask_is_dragged() {
        let name = "desk::taken::long::a_window_may_change_its_size_while_a_flask_is_dragged";
        let script = resized_in_mid_drag(carries_aside(takes(points(Script::default()))));
        let script = raises_and_lowers_by_keys(script);
        if let Some((gpu, sat)) = sat(name, By::Mouse, |_, _| puts_down(script)) {
            is_whole(&gpu, sat);
        }
    }

    #[test]
    fn the_other_hand_steadies_a_flask() {
        let name = "desk::taken::long::the_other_hand_steadies_a_flask";
        let script = steadies(takes(points(Script::default())));
        let Some((gpu, sat)) = sat(name, By::Mouse, |_, _| script) else {
            return;
        };
        assert!(moved(&sat).length() < NEAR, "{}", moved(&sat));
        is_whole(&gpu, sat);
    }
}
