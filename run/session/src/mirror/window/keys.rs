//! What keys, mouse and wheel of the window stand for.

use std::sync::mpsc::Sender;

use winit::event::{ElementState, KeyEvent, MouseScrollDelta, WindowEvent};
use winit::keyboard::{Key, NamedKey, PhysicalKey};

use super::lay::within;
use crate::decision::Decision;
use crate::desk::input::{DeskKey, Input};
use crate::menu;

/// Pixels of a touchpad's scrolling that are a notch of a wheel: three lines of text. Our choice.
const NOTCH: f64 = 50.0;

/// What a key of a desk stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning {
    /// It moves hands or view.
    Moves(DeskKey),
    /// It decides, as in the mirror.
    Decides(Decision),
}

/// What a key of a desk stands for; `None` where nothing.
pub fn meaning(key: &Key) -> Option<Meaning> {
    let moves = match key {
        Key::Named(named) => match named {
            NamedKey::Escape => return Some(Meaning::Decides(Decision::AskEnd)),
            NamedKey::ArrowLeft => DeskKey::Left,
            NamedKey::ArrowRight => DeskKey::Right,
            NamedKey::ArrowUp => DeskKey::Up,
            NamedKey::ArrowDown => DeskKey::Down,
            NamedKey::PageUp => DeskKey::Raise,
            NamedKey::PageDown => DeskKey::Lower,
            NamedKey::Space => DeskKey::Grip,
            NamedKey::Tab => DeskKey::OtherHand,
            NamedKey::Shift => DeskKey::Slow,
            NamedKey::Control => DeskKey::Orbit,
            NamedKey::Home => DeskKey::Home,
            NamedKey::F11 => DeskKey::FullScreen,
            NamedKey::Enter => DeskKey::Press,
            _ => return None,
        },
        Key::Character(text) => {
            let key = text.chars().next()?.to_ascii_lowercase();
            match key {
                ' ' => DeskKey::Grip,
                'q' => DeskKey::TiltLeft,
                'e' => DeskKey::TiltRight,
                'w' => DeskKey::Swirl,
                'g' => DeskKey::Gloves,
                // What is on the key of a plus and a minus in other layouts, with Shift or without it.
                '+' | '=' => DeskKey::ZoomIn,
                '-' | '_' => DeskKey::ZoomOut,
                'v' => DeskKey::SideView,
                'r' => DeskKey::PanelView,
                _ => return menu::decision(key).map(Meaning::Decides),
            }
        }
        _ => return None,
    };
    Some(Meaning::Moves(moves))
}

/// What came of an event of the window.
#[derive(Debug, PartialEq)]
pub enum Outcome {
    /// Nothing more is to be done.
    Taken,
    /// A decision.
    Decided(Decision),
    /// Full screen, or back to a window.
    FullScreen,
}

/// Sends what is done with mouse and keyboard in a window.
pub struct Listener {
    input: Sender<Input>,
    /// Keys that are down, with what they stood for when they were pressed: Shift may have come or gone since.
    down: Vec<(PhysicalKey, DeskKey)>,
    /// The key that is down and takes a hold.
    held: Option<PhysicalKey>,
}

impl Listener {
    /// One that sends it there.
    pub fn new(input: Sender<Input>) -> Self {
        Self {
            input,
            down: Vec::new(),
            held: None,
        }
    }

    fn send(&self, input: Input) {
        // A session that has ended takes none.
        let _ = self.input.send(input);
    }

    /// Takes an event of a window of that size (pixels) which shows a picture of `extent`.
    pub fn take(&mut self, event: &WindowEvent, window: [u32; 2], extent: [u32; 2]) -> Outcome {
        match event {
            WindowEvent::CursorMoved { position, .. } => {
                let at = within(window, extent, [position.x, position.y]);
                self.send(Input::Pointer(at));
            }
            WindowEvent::MouseInput { state, button, .. } => {
                let (button, down) = (*button, *state == ElementState::Pressed);
                self.send(Input::Button { button, down });
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => *lines,
                    MouseScrollDelta::PixelDelta(way) => (way.y / NOTCH) as f32,
                };
                self.send(Input::Wheel(notches));
            }
            WindowEvent::Focused(false) => {
                self.down.clear();
                self.send(Input::Left);
                return self.let_go();
            }
            WindowEvent::KeyboardInput {
                event,
                is_synthetic: false,
                ..
            } if !event.repeat => return self.key(event),
            _ => {}
        }
        Outcome::Taken
    }

    fn key(&mut self, event: &KeyEvent) -> Outcome {
        let same = |it: &(PhysicalKey, DeskKey)| it.0 == event.physical_key;
        if event.state == ElementState::Released {
            if self.held == Some(event.physical_key) {
                return self.let_go();
            }
            if let Some(at) = self.down.iter().position(same) {
                let (_, key) = self.down.swap_remove(at);
                self.send(Input::Key { key, down: false });
            }
            return Outcome::Taken;
        }
        match meaning(&event.logical_key) {
            Some(Meaning::Moves(DeskKey::FullScreen)) => Outcome::FullScreen,
            Some(Meaning::Moves(key)) => {
                self.down.push((event.physical_key, key));
                self.send(Input::Key { key, down: true });
                Outcome::Taken
            }
            // With Ctrl a letter is a shortcut of another program, pressed by habit.
            Some(Meaning::Decides(decision)) if !self.orbits() => {
                let decision = decision.by_key();
                if let Decision::Hold(_) = decision {
                    self.held = Some(event.physical_key);
                }
                Outcome::Decided(decision)
            }
            _ => Outcome::Taken,
        }
    }

    /// The key that takes a hold is up, if one was down.
    fn let_go(&mut self) -> Outcome {
        match self.held.take() {
            Some(_) => Outcome::Decided(Decision::Hold(None)),
            None => Outcome::Taken,
        }
    }

    fn orbits(&self) -> bool {
        self.down.iter().any(|(_, key)| *key == DeskKey::Orbit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vitriol_run::Action;
    use vitriol_run::choices::CHOICES;

    fn of(text: &str) -> Option<Meaning> {
        meaning(&Key::Character(text.into()))
    }

    #[test]
    fn keys_that_move_decide_nothing() {
        let moves = |key| Some(Meaning::Moves(key));
        for (text, key) in [
            ("q", DeskKey::TiltLeft),
            ("E", DeskKey::TiltRight),
            ("W", DeskKey::Swirl),
            ("g", DeskKey::Gloves),
            ("+", DeskKey::ZoomIn),
            ("_", DeskKey::ZoomOut),
            ("v", DeskKey::SideView),
            ("R", DeskKey::PanelView),
        ] {
            assert_eq!(of(text), moves(key), "{text}");
        }
        for (named, key) in [
            (NamedKey::ArrowUp, DeskKey::Up),
            (NamedKey::PageDown, DeskKey::Lower),
            (NamedKey::Space, DeskKey::Grip),
            (NamedKey::Control, DeskKey::Orbit),
        ] {
            assert_eq!(meaning(&Key::Named(named)), moves(key), "{named:?}");
        }
        assert_eq!(of("x"), None);
        assert_eq!(meaning(&Key::Named(NamedKey::F5)), None);
    }

    /// All scenes, and what else a session is asked for, have their keys here as in the mirror. The end has Escape.
    #[test]
    fn other_keys_decide_as_in_the_mirror() {
        let decides = |decision| Some(Meaning::Decides(decision));
        let end = meaning(&Key::Named(NamedKey::Escape));
        assert_eq!(end, decides(Decision::AskEnd));
        // A desk's bench stays where it is, whoever asks (`placement`).
        assert_eq!(of("a"), decides(Decision::Recentre));
        for choice in CHOICES {
            let scene = Decision::Act(Action::Scene(choice.scene.into()));
            assert_eq!(
                of(&choice.key.to_string()),
                decides(scene),
                "{}",
                choice.scene
            );
        }
        let keys = [
            menu::START,
            menu::TOGGLE,
            menu::SUMMARY,
            menu::HINT,
            menu::SKIP,
            menu::FINISH,
        ];
        for key in keys.into_iter().chain(menu::ANSWERS) {
            let expected = menu::decision(key).map(Meaning::Decides);
            assert!(
                expected.is_some() && of(&key.to_string()) == expected,
                "{key}"
            );
        }
    }
}
