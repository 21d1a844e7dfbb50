//! A screen without a monitor: Xvfb, an X server that draws into memory, and control of the windows that a program opens there.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    AtomEnum, BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ChangeWindowAttributesAux,
    ClientMessageEvent, ConfigureWindowAux, ConnectionExt as _, EventMask, ImageFormat, InputFocus,
    KEY_PRESS_EVENT, KEY_RELEASE_EVENT, MOTION_NOTIFY_EVENT, MapState,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

use crate::installed::not_tested;
use crate::program::Kept;
use crate::wait::until;

/// Marks a test that runs on the screen.
const INSIDE: &str = "VITRIOL_SCREEN";

/// Symbols of keys that have no character (X11's keysymdef.h), and of Space. A letter or a digit is its own symbol.
pub mod key {
    /// The space bar.
    pub const SPACE: u32 = 0x20;
    /// Tab.
    pub const TAB: u32 = 0xff09;
    /// Escape.
    pub const ESCAPE: u32 = 0xff1b;
    /// Home.
    pub const HOME: u32 = 0xff50;
    /// The arrow to the left.
    pub const LEFT: u32 = 0xff51;
    /// The arrow that points up.
    pub const UP: u32 = 0xff52;
    /// The arrow to the right.
    pub const RIGHT: u32 = 0xff53;
    /// The arrow that points down.
    pub const DOWN: u32 = 0xff54;
    /// Page up.
    pub const PAGE_UP: u32 = 0xff55;
    /// Page down.
    pub const PAGE_DOWN: u32 = 0xff56;
    /// F11.
    pub const F11: u32 = 0xffc8;
    /// Shift, of the left hand.
    pub const SHIFT: u32 = 0xffe1;
    /// Ctrl, of the left hand.
    pub const CONTROL: u32 = 0xffe3;
}

/// A button of the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// The left one.
    Main = 1,
    /// The wheel, pressed.
    Middle = 2,
    /// The right one.
    Secondary = 3,
}

/// The wheel's button of the X protocol for a notch up, and for one down.
const WHEEL: [u8; 2] = [4, 5];

/// The screen seen from inside.
pub struct Screen {
    connection: RustConnection,
    root: u32,
}

/// A window on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window(u32);

/// Runs the test `name` (module path and function, as the test's own runner knows it) on a screen of its own: returns the screen in the
/// process that runs there, and `None` in the one outside, where the test is over then.
///
/// Where there is no Xvfb, a message goes to standard error and the test is over too.
///
/// # Panics
/// Where the test fails on the screen; where there can be none and `CI=true`.
#[must_use]
pub fn enter(name: &str) -> Option<Screen> {
    if std::env::var_os(INSIDE).is_some() {
        let (connection, number) = x11rb::connect(None).expect("the screen answers");
        let root = connection.setup().roots[number].root;
        eprintln!("on the screen");
        return Some(Screen { connection, root });
    }
    match Server::start() {
        Ok(server) => {
            let done = Command::new(std::env::current_exe().expect("this test's program"))
                .args(["--exact", name, "--nocapture", "--include-ignored"])
                .env(INSIDE, "")
                .env("DISPLAY", &server.display)
                .stdin(Stdio::null())
                .stdout(Stdio::piped())
                .output()
                .expect("this test starts");
            let said = String::from_utf8_lossy(&done.stderr);
            assert!(
                done.status.success(),
                "{name} failed on the screen ({}):\n{said}",
                done.status
            );
            assert!(said.contains("on the screen"), "there is no test {name}");
        }
        Err(cause) => not_tested(&format!("no screen for {name}: {cause}")),
    }
    None
}

struct Server {
    _child: Kept,
    display: String,
}

impl Server {
    /// Starts it on the first display that is free.
    fn start() -> Result<Self, String> {
        let mut child = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x1024x24"])
            .args(["-nolisten", "tcp"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| format!("Xvfb (package xvfb) cannot be run: {error}"))?;
        let stdout = child.stdout.take().expect("Xvfb's standard output");
        let mut number = String::new();
        // It prints its number once it listens.
        let _ = BufReader::new(stdout).read_line(&mut number);
        let server = Self {
            _child: Kept(child),
            display: format!(":{}", number.trim()),
        };
        match number.trim().is_empty() {
            true => Err("Xvfb does not start".to_owned()),
            false => Ok(server),
        }
    }
}

impl Screen {
    /// The window whose title has `part`, if there is one.
    ///
    /// # Panics
    /// Where the screen does not answer; so do all others.
    pub fn find(&self, part: &str) -> Option<Window> {
        let tree = self.connection.query_tree(self.root).expect("a question");
        let windows = tree.reply().expect("the windows").children;
        let windows = windows.into_iter().map(Window);
        windows.into_iter().find(|window| {
            self.title(*window)
                .is_some_and(|title| title.contains(part))
        })
    }

    /// Waits for a window whose title has `part`.
    pub fn wait_for(&self, part: &str) -> Window {
        until(&format!("a window of {part}"), || self.find(part))
    }

    /// Receives from now on what [`Screen::opened`] and [`Screen::asked_to_fill`] look for.
    pub fn watch(&self) {
        let events = ChangeWindowAttributesAux::new().event_mask(EventMask::SUBSTRUCTURE_NOTIFY);
        self.checked(self.connection.change_window_attributes(self.root, &events));
    }

    /// Windows that were opened since [`Screen::watch`] or the last call.
    pub fn opened(&self) -> usize {
        let opens = |event: &Event| matches!(event, Event::CreateNotify(_));
        self.events().filter(opens).count()
    }

    /// What windows asked the window manager for since [`Screen::watch`] or the last call: to fill the screen, or no longer (`false`).
    /// There is no window manager here that does it (Extended Window Manager Hints 1.5, `_NET_WM_STATE`).
    pub fn asked_to_fill(&self) -> Vec<bool> {
        let (state, fills) = (
            self.atom("_NET_WM_STATE"),
            self.atom("_NET_WM_STATE_FULLSCREEN"),
        );
        let asks = |event: Event| match event {
            Event::ClientMessage(it) if it.type_ == state => {
                let [action, of, ..] = it.data.as_data32();
                // 1 adds the state, and 0 removes it.
                (of == fills).then_some(action == 1)
            }
            _ => None,
        };
        self.events().filter_map(asks).collect()
    }

    /// The events that came so far.
    fn events(&self) -> impl Iterator<Item = Event> {
        // An answer comes after the events of earlier requests.
        let asked = self.connection.get_input_focus().expect("a question");
        asked.reply().expect("an answer");
        std::iter::from_fn(move || {
            self.connection
                .poll_for_event()
                .expect("the screen's events")
        })
    }

    /// A window's title; `None` of one without a title, or that is gone.
    pub fn title(&self, window: Window) -> Option<String> {
        let (name, utf8) = (self.atom("_NET_WM_NAME"), self.atom("UTF8_STRING"));
        let asked = self
            .connection
            .get_property(false, window.0, name, utf8, 0, 1024)
            .expect("a question");
        let title = asked.reply().ok()?.value;
        (!title.is_empty()).then(|| String::from_utf8_lossy(&title).into_owned())
    }

    /// Width and height of a window, pixels.
    pub fn extent(&self, window: Window) -> [u32; 2] {
        let size = self.connection.get_geometry(window.0).expect("a question");
        let size = size.reply().expect("the window is there");
        [size.width.into(), size.height.into()]
    }

    /// The picture of a window: width, height, and pixels of red, green and blue, row by row.
    pub fn picture(&self, window: Window) -> ([u32; 2], Vec<[u8; 3]>) {
        let size = self.connection.get_geometry(window.0).expect("a question");
        let size = size.reply().expect("the window is there");
        let image = self
            .connection
            .get_image(
                ImageFormat::Z_PIXMAP,
                window.0,
                0,
                0,
                size.width,
                size.height,
                u32::MAX,
            )
            .expect("a question")
            .reply()
            .expect("the window's picture");
        // Xvfb's 24 bits lie in 32, blue first.
        let pixels = image.data.chunks_exact(4).map(|p| [p[2], p[1], p[0]]);
        (
            [size.width.into(), size.height.into()],
            pixels.collect::<Vec<_>>(),
        )
    }

    /// Gives a window another size, pixels.
    pub fn resize(&self, window: Window, [width, height]: [u32; 2]) {
        let size = ConfigureWindowAux::new().width(width).height(height);
        self.checked(self.connection.configure_window(window.0, &size));
    }

    /// Gives a window the keyboard, once it is on the screen.
    pub fn focus(&self, window: Window) {
        until("the window is on the screen", || {
            let asked = self.connection.get_window_attributes(window.0);
            let state = asked.expect("a question").reply().ok()?.map_state;
            (state == MapState::VIEWABLE).then_some(())
        });
        let focus =
            self.connection
                .set_input_focus(InputFocus::PARENT, window.0, x11rb::CURRENT_TIME);
        self.checked(focus);
    }

    /// Takes the keyboard from every window.
    pub fn unfocus(&self) {
        let focus =
            self.connection
                .set_input_focus(InputFocus::PARENT, self.root, x11rb::CURRENT_TIME);
        self.checked(focus);
    }

    /// Presses and releases the key of a letter or a digit, as a keyboard would, with the focus on
    /// the window.
    pub fn press(&self, window: Window, key: char) {
        self.focus(window);
        self.tap(u32::from(key));
    }

    /// Presses and releases the key of that symbol (see [`key`]), for the window that has the focus.
    pub fn tap(&self, symbol: u32) {
        self.key(symbol, true);
        self.key(symbol, false);
    }

    /// Presses the key of that symbol, or releases it.
    pub fn key(&self, symbol: u32, down: bool) {
        let kind = if down {
            KEY_PRESS_EVENT
        } else {
            KEY_RELEASE_EVENT
        };
        self.fake(kind, self.code(symbol), [0, 0]);
    }

    /// Moves the pointer to a place of a window, pixels from its upper left; it may lie outside the window.
    pub fn point(&self, window: Window, [x, y]: [i32; 2]) {
        let asked = self
            .connection
            .translate_coordinates(window.0, self.root, x as i16, y as i16);
        let at = asked.expect("a question").reply().expect("a place");
        // Its detail: the place is absolute.
        self.fake(MOTION_NOTIFY_EVENT, 0, [at.dst_x, at.dst_y]);
    }

    /// Presses a button of the mouse where the pointer is, or releases it.
    pub fn button(&self, button: Button, down: bool) {
        let kind = if down {
            BUTTON_PRESS_EVENT
        } else {
            BUTTON_RELEASE_EVENT
        };
        self.fake(kind, button as u8, [0, 0]);
    }

    /// Turns the wheel by so many notches, up positive.
    pub fn wheel(&self, notches: i32) {
        let button = WHEEL[usize::from(notches < 0)];
        for _ in 0..notches.unsigned_abs() {
            for kind in [BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT] {
                self.fake(kind, button, [0, 0]);
            }
        }
    }

    /// The code of the key that has that symbol without Shift.
    fn code(&self, symbol: u32) -> u8 {
        let setup = self.connection.setup();
        let (least, most) = (setup.min_keycode, setup.max_keycode);
        let map = self
            .connection
            .get_keyboard_mapping(least, most - least + 1)
            .expect("a question")
            .reply()
            .expect("the keyboard");
        let per_key = usize::from(map.keysyms_per_keycode);
        let place = map
            .keysyms
            .chunks(per_key)
            .position(|symbols| symbols[0] == symbol);
        least + place.expect("a key of that symbol") as u8
    }

    /// An event as mouse or keyboard would send it.
    fn fake(&self, kind: u8, detail: u8, [x, y]: [i16; 2]) {
        let faked = self
            .connection
            .xtest_fake_input(kind, detail, 0, self.root, x, y, 0);
        self.checked(faked);
    }

    /// Asks a window to close, as its frame's button does.
    pub fn close(&self, window: Window) {
        let data = [self.atom("WM_DELETE_WINDOW"), x11rb::CURRENT_TIME, 0, 0, 0];
        let asked = ClientMessageEvent::new(32, window.0, self.atom("WM_PROTOCOLS"), data);
        let sent = self
            .connection
            .send_event(false, window.0, EventMask::NO_EVENT, asked);
        self.checked(sent);
    }

    fn atom(&self, name: &str) -> u32 {
        let asked = self.connection.intern_atom(false, name.as_bytes());
        let atom = asked.expect("a question").reply().expect("a name").atom;
        assert_ne!(atom, u32::from(AtomEnum::NONE));
        atom
    }

    fn checked(
        &self,
        sent: Result<x11rb::cookie::VoidCookie<'_, RustConnection>, x11rb::errors::ConnectionError>,
    ) {
        sent.expect("a request").check().expect("the screen obeys");
    }
}
