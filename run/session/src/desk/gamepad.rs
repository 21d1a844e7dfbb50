//! A gamepad beside mouse and keyboard: what its buttons and sticks stand for.

use gilrs::{Axis, Button, EventType, Gilrs, GilrsBuilder};

use super::input::{Axes, DeskKey, Input};

/// Deflection of a stick, of 1, up to which it counts as let go. Our choice: a hand must not drift where a stick does not return to its
/// middle, and a thin stream needs small deflections; XInput's 0.24 of the left stick would take a quarter of its way.
const DEAD: f32 = 0.15;

/// All gamepads of the machine as one. They may come and go.
pub struct Gamepad {
    /// `None` where the system lists no gamepads.
    source: Option<Gilrs>,
    pad: Pad,
}

impl Gamepad {
    /// The machine's gamepads. It is no error if there are none.
    pub fn open() -> Self {
        // The filters have another dead zone, and the motors are not used.
        let source = GilrsBuilder::new()
            .with_default_filters(false)
            .with_force_feedback(false)
            .build();
        let source = source
            .inspect_err(|error| tracing::info!("gamepads are not used: {error}"))
            .ok();
        Self {
            source,
            pad: Pad::default(),
        }
    }

    /// Hands over what was done since the last frame; does not wait.
    pub fn poll(&mut self, mut takes: impl FnMut(Input)) {
        while let Some(event) = self.source.as_mut().and_then(Gilrs::next_event) {
            for input in self.pad.take(event.event) {
                takes(input);
            }
        }
    }
}

/// What is held on a gamepad. Deflections are -1 to 1, to the right and up.
#[derive(Debug, Default)]
struct Pad {
    left: [f32; 2],
    right: [f32; 2],
    cross: [f32; 2],
    keys: Vec<DeskKey>,
}

impl Pad {
    /// What an event of the gamepad stands for.
    fn take(&mut self, event: EventType) -> Vec<Input> {
        match event {
            EventType::ButtonPressed(button, _) => self.press(button, true),
            EventType::ButtonReleased(button, _) => self.press(button, false),
            EventType::AxisChanged(axis, value, _) if value.is_finite() => {
                let of = match axis {
                    Axis::LeftStickX => &mut self.left[0],
                    Axis::LeftStickY => &mut self.left[1],
                    Axis::RightStickX => &mut self.right[0],
                    Axis::RightStickY => &mut self.right[1],
                    // Many pads report their D-pad as two axes.
                    Axis::DPadX => &mut self.cross[0],
                    Axis::DPadY => &mut self.cross[1],
                    _ => return Vec::new(),
                };
                *of = value;
                vec![Input::Axes(self.axes())]
            }
            EventType::Disconnected => {
                let held = std::mem::take(self).keys.into_iter();
                let up = held.map(|key| Input::Key { key, down: false });
                up.chain([Input::Axes(Axes::default())]).collect()
            }
            _ => Vec::new(),
        }
    }

    fn press(&mut self, button: Button, down: bool) -> Vec<Input> {
        let way = if down { 1.0 } else { 0.0 };
        match button {
            Button::DPadLeft => self.cross[0] = -way,
            Button::DPadRight => self.cross[0] = way,
            Button::DPadDown => self.cross[1] = -way,
            Button::DPadUp => self.cross[1] = way,
            _ => {
                let Some(key) = key(button) else {
                    return Vec::new();
                };
                self.keys.retain(|it| *it != key);
                if down {
                    self.keys.push(key);
                }
                return vec![Input::Key { key, down }];
            }
        }
        vec![Input::Axes(self.axes())]
    }

    fn axes(&self) -> Axes {
        // Each by itself: a thumb that raises strays to the side, and must not tilt.
        let [aside, up] = self.right.map(|it| live([it, 0.0])[0]);
        Axes {
            walk: live(self.left),
            raise: up,
            tilt: -aside,
            turn: self.cross,
        }
    }
}

/// A deflection without its dead zone: nothing in it, and beyond it from 0 to 1 in the same direction.
fn live([x, y]: [f32; 2]) -> [f32; 2] {
    let far = x.hypot(y);
    if far <= DEAD {
        return [0.0; 2];
    }
    let share = (far.min(1.0) - DEAD) / (1.0 - DEAD) / far;
    [share * x, share * y]
}

/// The key that a button stands for; gilrs names the four by where they lie, as layouts have different letters on them.
fn key(button: Button) -> Option<DeskKey> {
    Some(match button {
        Button::South => DeskKey::Grip,
        Button::East => DeskKey::OtherHand,
        Button::West => DeskKey::Press,
        Button::North => DeskKey::SideView,
        Button::LeftTrigger => DeskKey::ZoomOut,
        Button::RightTrigger => DeskKey::ZoomIn,
        Button::LeftTrigger2 => DeskKey::Slow,
        Button::Start => DeskKey::PanelView,
        Button::Select => DeskKey::Home,
        _ => return None,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A button's event. The number that the system has for it is of no importance.
    fn press(pad: &mut Pad, button: Button, down: bool) -> Vec<Input> {
        let code = button.to_nec().unwrap();
        pad.take(match down {
            true => EventType::ButtonPressed(button, code),
            false => EventType::ButtonReleased(button, code),
        })
    }

    /// The axes after one of them has changed.
    fn moved(pad: &mut Pad, axis: Axis, value: f32) -> Axes {
        let code = Button::South.to_nec().unwrap();
        let inputs = pad.take(EventType::AxisChanged(axis, value, code));
        let [Input::Axes(axes)] = inputs[..] else {
            unreachable!("{inputs:?}");
        };
        axes
    }

    /// The table of `docs/desk.md`.
    #[test]
    fn buttons_are_keys() {
        let mut pad = Pad::default();
        for (button, key) in [
            (Button::South, DeskKey::Grip),
            (Button::East, DeskKey::OtherHand),
            (Button::West, DeskKey::Press),
            (Button::North, DeskKey::SideView),
            (Button::LeftTrigger, DeskKey::ZoomOut),
            (Button::RightTrigger, DeskKey::ZoomIn),
            (Button::LeftTrigger2, DeskKey::Slow),
            (Button::Start, DeskKey::PanelView),
            (Button::Select, DeskKey::Home),
        ] {
            for down in [true, false] {
                let expected = [Input::Key { key, down }];
                assert_eq!(press(&mut pad, button, down), expected, "{button:?}");
            }
        }
        assert!(press(&mut pad, Button::Mode, true).is_empty());
    }

    #[test]
    fn sticks_move_raise_and_tilt() {
        let mut pad = Pad::default();
        assert_eq!(moved(&mut pad, Axis::LeftStickX, 1.0).walk, [1.0, 0.0]);
        moved(&mut pad, Axis::LeftStickX, 0.0);
        // Away from the player is away from the viewer.
        assert_eq!(moved(&mut pad, Axis::LeftStickY, 1.0).walk, [0.0, 1.0]);
        assert_eq!(moved(&mut pad, Axis::RightStickY, -1.0).raise, -1.0);
        // To the right tilts to the right, which is negative.
        assert_eq!(moved(&mut pad, Axis::RightStickX, 1.0).tilt, -1.0);
    }

    /// A stick that does not return to its middle moves nothing; beyond the dead zone motion begins at none, and ends at the whole. In
    /// between it is (0.5 - 0.15) / 0.85, but for the rounding of f32.
    #[test]
    fn a_stick_has_a_dead_zone() {
        let mut pad = Pad::default();
        moved(&mut pad, Axis::LeftStickX, 0.1);
        assert_eq!(moved(&mut pad, Axis::LeftStickY, 0.1).walk, [0.0; 2]);
        moved(&mut pad, Axis::LeftStickX, 0.0);
        assert!(moved(&mut pad, Axis::LeftStickY, 0.151).walk[1] < 0.01);
        let [across, away] = moved(&mut pad, Axis::LeftStickY, -0.5).walk;
        assert!(across == 0.0 && (away + 0.35 / 0.85).abs() < 1e-6, "{away}");
        // A stick's corner is no faster than its side.
        moved(&mut pad, Axis::LeftStickX, 1.0);
        let [across, away] = moved(&mut pad, Axis::LeftStickY, 1.0).walk;
        assert!((across.hypot(away) - 1.0).abs() < 1e-6);
        // Whoever raises does not tilt by straying a little.
        moved(&mut pad, Axis::RightStickX, 0.12);
        let axes = moved(&mut pad, Axis::RightStickY, 1.0);
        assert_eq!((axes.raise, axes.tilt), (1.0, 0.0));
    }

    /// As buttons and as axes.
    #[test]
    fn the_d_pad_turns_the_view() {
        let turn = |x: f32, y: f32| {
            let turn = [x, y];
            [Input::Axes(Axes {
                turn,
                ..Axes::default()
            })]
        };
        let mut pad = Pad::default();
        for (button, [x, y]) in [
            (Button::DPadLeft, [-1.0, 0.0]),
            (Button::DPadRight, [1.0, 0.0]),
            (Button::DPadUp, [0.0, 1.0]),
            (Button::DPadDown, [0.0, -1.0]),
        ] {
            assert_eq!(press(&mut pad, button, true), turn(x, y), "{button:?}");
            assert_eq!(press(&mut pad, button, false), turn(0.0, 0.0));
        }
        assert_eq!(moved(&mut pad, Axis::DPadX, -1.0).turn, [-1.0, 0.0]);
        assert_eq!(moved(&mut pad, Axis::DPadY, 1.0).turn, [-1.0, 1.0]);
    }

    /// A pad whose cable is pulled holds nothing any more.
    #[test]
    fn a_pad_that_is_gone_lets_go() {
        let mut pad = Pad::default();
        press(&mut pad, Button::LeftTrigger2, true);
        press(&mut pad, Button::South, true);
        press(&mut pad, Button::South, false);
        moved(&mut pad, Axis::LeftStickX, 1.0);
        let up = Input::Key {
            key: DeskKey::Slow,
            down: false,
        };
        let still = Input::Axes(Axes::default());
        assert_eq!(pad.take(EventType::Disconnected), [up, still]);
        assert_eq!(pad.take(EventType::Disconnected), [still]);
    }

    /// A driver whose axis has no range.
    #[test]
    fn what_is_no_number_is_passed_over() {
        let mut pad = Pad::default();
        let code = Button::South.to_nec().unwrap();
        let event = EventType::AxisChanged(Axis::DPadX, f32::NAN, code);
        assert!(pad.take(event).is_empty());
    }
}
