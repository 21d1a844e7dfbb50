//! Mouse and keyboard of the desk's window, and a gamepad: what they send, and what of it is held and new in a frame.

use std::f32::consts::{PI, TAU};

use winit::event::MouseButton;

use super::hands::{Controls, SLOW};
use super::view::{Turns, Viewpoint};

/// One event of mouse or keyboard in the window, or of a gamepad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// The pointer moved there: 0 to 1 from the picture's upper left, beyond that beside it.
    Pointer([f32; 2]),
    /// A button of the mouse went down or up.
    Button {
        /// Which.
        button: MouseButton,
        /// Whether it went down.
        down: bool,
    },
    /// The wheel turned by so many notches, up positive.
    Wheel(f32),
    /// A key went down or up; it does not repeat.
    Key {
        /// Which.
        key: DeskKey,
        /// Whether it went down.
        down: bool,
    },
    /// The window lost the keyboard: all keys and buttons are up.
    Left,
    /// The sticks of a gamepad are there now.
    #[cfg_attr(not(feature = "gamepad"), allow(dead_code))]
    Axes(Axes),
}

/// How far sticks are moved, -1 to 1 each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Axes {
    /// The active hand goes to the right, and away from the viewer.
    pub walk: [f32; 2],
    /// It rises.
    pub raise: f32,
    /// It tilts to the left.
    pub tilt: f32,
    /// The eye goes to the right about the bench, and rises.
    pub turn: [f32; 2],
}

/// A key that moves hands or view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeskKey {
    /// The active hand goes to the left.
    Left,
    /// It goes to the right.
    Right,
    /// It goes away from the viewer.
    Up,
    /// It comes nearer.
    Down,
    /// It rises.
    Raise,
    /// It sinks.
    Lower,
    /// It tilts to the left.
    TiltLeft,
    /// It tilts to the right.
    TiltRight,
    /// While it is held, the hand swirls what it holds.
    Swirl,
    /// It takes hold, or puts down.
    Grip,
    /// The other hand becomes the active one.
    OtherHand,
    /// The active hand pulls the other one's glove off.
    Gloves,
    /// While it is held all is slower.
    Slow,
    /// While it is held, arrows and a drag turn the view.
    Orbit,
    /// A narrower view.
    ZoomIn,
    /// A wider view.
    ZoomOut,
    /// The bench from the side, and back.
    SideView,
    /// The panel fills the picture, and back.
    PanelView,
    /// The first view.
    Home,
    /// Full screen, and back.
    FullScreen,
    /// Presses the panel's button under the pointer.
    Press,
}

/// Tilt that a drag over the picture's width with the secondary button asks for, rad. Our choice: of 1280 pixels one is 0.2°, and a
/// beaker in the left third is emptied to the right (100°) before the pointer is in the picture's last quarter.
const TILTS: f32 = TAU / 1.5;
/// Turn of the view that a drag over the picture's width asks for, rad, and rise of the eye over its height, m.
const TURNS: f32 = PI;
const RISES: f32 = 1.0;
/// Speed at which keys raise the eye, m/s, while they turn it by a radian a second. Our choice: both take some two seconds from end to end.
const KEYS_RISE: f32 = 0.5;
/// Notches of the wheel, turned with the view's key, that halve or double the view.
const ZOOMS: f32 = 5.0;
/// Way of the pointer, in shares of the picture, up to which the middle button is clicked and not dragged. Our choice: a hand that clicks
/// moves it by some pixels.
const CLICKS: f32 = 0.01;

/// What is held, and what is new since the last frame.
#[derive(Debug, Default)]
pub struct Inputs {
    keys: Vec<DeskKey>,
    axes: Axes,
    pointer: Option<[f32; 2]>,
    /// While the secondary button is down, where the pointer was when it went down: a drag that tilts does not move the hand.
    tilting: Option<[f32; 2]>,
    /// The main button is down, and is the hands'.
    down: bool,
    /// The main button went down with the view's key, and turns the view.
    turning: bool,
    /// While the middle button is down, the pointer's way since it went down, in shares of the picture.
    middle: Option<f32>,
    new: New,
}

/// What is new since the last frame.
#[derive(Debug, Default)]
struct New {
    press: bool,
    release: bool,
    pointed: bool,
    wheel: f32,
    tilt: f32,
    keys: Vec<DeskKey>,
    turns: Turns,
}

impl Inputs {
    /// Takes an event in.
    pub fn take(&mut self, input: Input) {
        match input {
            Input::Pointer(at) => self.point(at),
            Input::Wheel(notches) if self.is_held(DeskKey::Orbit) => {
                self.new.turns.zoom += notches / ZOOMS;
            }
            Input::Wheel(notches) => self.new.wheel += notches,
            Input::Button { button, down } => match (button, down) {
                (MouseButton::Left, true) if self.is_held(DeskKey::Orbit) => self.turning = true,
                (MouseButton::Left, true) => self.press(),
                (MouseButton::Left, false) if std::mem::take(&mut self.turning) => {}
                (MouseButton::Left, false) => self.release(),
                (MouseButton::Right, down) => self.tilting = down.then(|| self.place()),
                (MouseButton::Middle, true) => self.middle = Some(0.0),
                (MouseButton::Middle, false)
                    if self.middle.take().is_some_and(|way| way < CLICKS) =>
                {
                    self.press_key(DeskKey::OtherHand);
                }
                _ => {}
            },
            Input::Key { key, down: true } => {
                self.keys.push(key);
                self.press_key(key);
            }
            // One of two keys that stand for it may still be down.
            Input::Key { key, down: false } => {
                if let Some(at) = self.keys.iter().position(|it| *it == key) {
                    self.keys.swap_remove(at);
                }
            }
            Input::Left => {
                self.keys.clear();
                (self.tilting, self.turning, self.middle) = (None, false, None);
                self.release();
            }
            Input::Axes(axes) => self.axes = axes,
        }
    }

    fn is_held(&self, key: DeskKey) -> bool {
        self.keys.contains(&key)
    }

    /// A key is new in the next frame.
    fn press_key(&mut self, key: DeskKey) {
        self.new.keys.push(key);
        if key == DeskKey::OtherHand {
            // What this hand holds is no longer the button's.
            self.down = false;
        }
    }

    fn point(&mut self, at: [f32; 2]) {
        let before = self.pointer.replace(at).unwrap_or(at);
        let [across, down] = [at[0] - before[0], at[1] - before[1]];
        if let Some(way) = &mut self.middle {
            *way += across.hypot(down);
        }
        if self.turning || self.middle.is_some_and(|way| way >= CLICKS) {
            // The bench goes with the pointer.
            self.new.turns.yaw -= TURNS * across;
            self.new.turns.rise += RISES * down;
        } else if self.tilting.is_some() {
            // The lip goes with the pointer.
            self.new.tilt -= TILTS * across;
        } else if self.middle.is_none() {
            self.new.pointed = true;
        }
    }

    fn press(&mut self) {
        self.down = true;
        self.new.press = true;
    }

    fn release(&mut self) {
        self.new.release |= std::mem::take(&mut self.down);
    }

    /// The pointer's place; the picture's middle as long as it has not moved.
    fn place(&self) -> [f32; 2] {
        self.pointer.unwrap_or([0.5; 2])
    }

    /// The place that the hands follow, 0 to 1 from the picture's upper left.
    pub fn pointer(&self) -> [f32; 2] {
        let followed = self.tilting.unwrap_or_else(|| self.place());
        followed.map(|at| at.clamp(0.0, 1.0))
    }

    /// Keys held against each other, -1 to 1.
    fn axis(&self, less: DeskKey, more: DeskKey) -> f32 {
        f32::from(u8::from(self.is_held(more))) - f32::from(u8::from(self.is_held(less)))
    }

    /// How the view is to turn in a frame that comes `passed` seconds after the last one. To be taken before [`Inputs::controls`].
    pub fn turns(&mut self, passed: f32) -> Turns {
        let mut turns = std::mem::take(&mut self.new.turns);
        let share = if self.is_held(DeskKey::Slow) {
            SLOW
        } else {
            1.0
        };
        let [mut across, mut up] = self.axes.turn;
        if self.is_held(DeskKey::Orbit) {
            across += self.axis(DeskKey::Left, DeskKey::Right);
            up += self.axis(DeskKey::Down, DeskKey::Up);
        }
        turns.yaw += share * passed * across;
        turns.rise += KEYS_RISE * share * passed * up;
        turns.zoom += share * passed * self.axis(DeskKey::ZoomOut, DeskKey::ZoomIn);
        let pressed = |key: DeskKey| self.new.keys.contains(&key);
        turns.side = pressed(DeskKey::SideView);
        turns.panel = pressed(DeskKey::PanelView);
        turns.home = pressed(DeskKey::Home);
        turns
    }

    /// The hands' controls in a frame that is seen from `view`.
    pub fn controls(&mut self, view: &Viewpoint) -> Controls {
        let ray = view.ray(self.pointer());
        let [right, away] = view.level();
        let Axes {
            mut walk,
            raise,
            tilt,
            ..
        } = self.axes;
        if !self.is_held(DeskKey::Orbit) {
            walk[0] += self.axis(DeskKey::Left, DeskKey::Right);
            walk[1] += self.axis(DeskKey::Down, DeskKey::Up);
        }
        let new = std::mem::take(&mut self.new);
        let edge = |key: DeskKey| new.keys.contains(&key);
        Controls {
            ray,
            right,
            away,
            // A click between two frames counts.
            pressed: self.down || new.press || new.release,
            press: new.press,
            release: new.release,
            pointed: new.pointed,
            wheel: new.wheel,
            tilt_drag: new.tilt,
            walk,
            raise: raise + self.axis(DeskKey::Lower, DeskKey::Raise),
            tilt: tilt + self.axis(DeskKey::TiltRight, DeskKey::TiltLeft),
            swirl: self.is_held(DeskKey::Swirl),
            slow: self.is_held(DeskKey::Slow),
            grip: edge(DeskKey::Grip),
            other: edge(DeskKey::OtherHand),
            gloves: edge(DeskKey::Gloves),
            panel_press: edge(DeskKey::Press),
            panel_down: self.is_held(DeskKey::Press),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn click(inputs: &mut Inputs, down: bool) {
        let button = MouseButton::Left;
        inputs.take(Input::Button { button, down });
    }

    fn key(inputs: &mut Inputs, key: DeskKey, down: bool) {
        inputs.take(Input::Key { key, down });
    }

    /// Pressed, press and release of the next frame.
    fn edges(inputs: &mut Inputs) -> [bool; 3] {
        let controls = inputs.controls(&Viewpoint::default());
        [controls.pressed, controls.press, controls.release]
    }

    #[test]
    fn a_click_between_two_frames_counts() {
        let mut inputs = Inputs::default();
        click(&mut inputs, true);
        click(&mut inputs, false);
        assert_eq!(edges(&mut inputs), [true, true, true]);
        assert_eq!(edges(&mut inputs), [false; 3]);
    }

    /// With Ctrl the arrows turn the view and move no hand; without it they do.
    #[test]
    fn arrows_move_the_hand_or_the_view() {
        let mut inputs = Inputs::default();
        key(&mut inputs, DeskKey::Right, true);
        assert_eq!(inputs.turns(0.1).yaw, 0.0);
        let controls = inputs.controls(&Viewpoint::default());
        assert_eq!(controls.walk, [1.0, 0.0]);
        key(&mut inputs, DeskKey::Orbit, true);
        assert!(inputs.turns(0.1).yaw > 0.0);
        let controls = inputs.controls(&Viewpoint::default());
        assert_eq!(controls.walk, [0.0; 2]);
        // A drag with it turns the view, and takes nothing.
        inputs.take(Input::Pointer([0.5, 0.5]));
        click(&mut inputs, true);
        inputs.take(Input::Pointer([0.4, 0.5]));
        key(&mut inputs, DeskKey::Right, false);
        assert!(inputs.turns(0.1).yaw > 0.2);
        click(&mut inputs, false);
        assert_eq!(edges(&mut inputs), [false; 3]);
        // Left, all keys are up.
        inputs.take(Input::Left);
        key(&mut inputs, DeskKey::Left, true);
        assert_eq!(inputs.turns(0.1).yaw, 0.0);
    }

    /// Sticks add to keys, and stay where they are from frame to frame; they move the hand with Ctrl too, as they are not the arrows.
    #[test]
    fn sticks_move_the_hand_and_the_view() {
        let mut inputs = Inputs::default();
        inputs.take(Input::Axes(Axes {
            walk: [0.5, -0.25],
            raise: 0.75,
            tilt: -1.0,
            turn: [1.0, -1.0],
        }));
        key(&mut inputs, DeskKey::TiltLeft, true);
        key(&mut inputs, DeskKey::Orbit, true);
        for _ in 0..2 {
            let turns = inputs.turns(0.1);
            assert!(turns.yaw > 0.0 && turns.rise < 0.0);
            let controls = inputs.controls(&Viewpoint::default());
            assert_eq!(controls.walk, [0.5, -0.25]);
            assert_eq!((controls.raise, controls.tilt), (0.75, 0.0));
        }
        inputs.take(Input::Axes(Axes::default()));
        assert_eq!(inputs.turns(0.1), Turns::default());
    }

    /// A drag with the secondary button tilts, and the hand stays where it was until the button goes up.
    #[test]
    fn a_drag_tilts_and_does_not_move() {
        let mut inputs = Inputs::default();
        inputs.take(Input::Pointer([0.5, 0.5]));
        click(&mut inputs, true);
        inputs.controls(&Viewpoint::default());
        let button = MouseButton::Right;
        inputs.take(Input::Button { button, down: true });
        inputs.take(Input::Pointer([0.75, 0.4]));
        let controls = inputs.controls(&Viewpoint::default());
        // A quarter of the width to the right: a sixth of a turn to the right. Left is positive.
        assert!((controls.tilt_drag + PI / 3.0).abs() < 1e-6);
        assert!(!controls.pointed);
        let near = |a: [f32; 2], b: [f32; 2]| (0..2).all(|side| (a[side] - b[side]).abs() < 1e-6);
        assert!(near(inputs.pointer(), [0.5, 0.5]));
        inputs.take(Input::Button {
            button,
            down: false,
        });
        inputs.take(Input::Pointer([0.6, 0.35]));
        assert!(near(inputs.pointer(), [0.6, 0.35]));
        let controls = inputs.controls(&Viewpoint::default());
        assert!(controls.pointed && controls.tilt_drag == 0.0);
        // Up and down it tilts nothing.
        inputs.take(Input::Button { button, down: true });
        inputs.take(Input::Pointer([0.6, 0.85]));
        let controls = inputs.controls(&Viewpoint::default());
        assert!(!controls.pointed && controls.tilt_drag == 0.0);
    }

    /// The wheel's button turns the view where it is dragged, and changes the hand where it is clicked; a hand's tremble is no drag.
    #[test]
    fn the_middle_button_turns_the_view_or_changes_the_hand() {
        let mut inputs = Inputs::default();
        let middle = |down| Input::Button {
            button: MouseButton::Middle,
            down,
        };
        inputs.take(Input::Pointer([0.5, 0.5]));
        inputs.controls(&Viewpoint::default());
        for (to, drags) in [([0.503, 0.502], false), ([0.3, 0.6], true)] {
            inputs.take(middle(true));
            inputs.take(Input::Pointer(to));
            inputs.take(middle(false));
            let turns = inputs.turns(0.0);
            assert_eq!(turns.yaw > 0.0 && turns.rise > 0.0, drags, "{to:?}");
            let controls = inputs.controls(&Viewpoint::default());
            assert_eq!(controls.other, !drags, "{to:?}");
            assert!(!controls.pointed && !controls.press, "{to:?}");
        }
        // Left in a drag, the button is up.
        inputs.take(middle(true));
        inputs.take(Input::Left);
        inputs.take(middle(false));
        assert!(!inputs.controls(&Viewpoint::default()).other);
    }

    /// Swirling lasts as long as its key is held; gloves are asked for once.
    #[test]
    fn keys_swirl_and_ask_for_gloves() {
        let mut inputs = Inputs::default();
        key(&mut inputs, DeskKey::Swirl, true);
        key(&mut inputs, DeskKey::Gloves, true);
        for asked in [true, false] {
            let controls = inputs.controls(&Viewpoint::default());
            assert_eq!((controls.swirl, controls.gloves), (true, asked));
        }
        key(&mut inputs, DeskKey::Swirl, false);
        assert!(!inputs.controls(&Viewpoint::default()).swirl);
    }
}
