//! The window, on a thread of its own, so that the frame loop never waits for the screen or its server.

mod keys;
mod lay;

use std::num::NonZeroU32;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use softbuffer::{Context, Surface};
use vitriol_run::{Blame, Failure};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::error::EventLoopError;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop, EventLoopProxy};
use winit::keyboard::Key;
use winit::window::{Fullscreen, Window as Frame, WindowId};

use self::keys::{Listener, Outcome};
use self::lay::{lay, onto};
use super::label::Said as Label;
use super::over::Over;
use super::shrink::{LONGEST, Shrunk, fit};
use super::strip::Said;
use crate::decision::Decision;
use crate::desk::input::Input;
use crate::menu;

/// Longest side of a mirror when it opens, pixels of a screen of the usual density.
const OPENS_AT: u32 = 800;
/// Display time between two pictures of a mirror, ns: 30 a second.
const EVERY: i64 = 1_000_000_000 / 30;
/// Longest wait for the screen's server, at the beginning and at the end.
const PATIENCE: Duration = Duration::from_secs(2);

/// A message to the window.
pub enum Say {
    /// A new title.
    Title(String),
    /// A new picture.
    Picture(Shrunk),
    /// What the strip at its upper edge says from now on.
    Strip(Said),
    /// What the label at the pointer says from now on, or nothing.
    Label(Option<Label>),
    /// That the session is over.
    End,
}

/// The frame loop's handle of the window. Nothing that is sent to the window waits for it.
pub struct Window {
    proxy: EventLoopProxy<Say>,
    extent: Arc<Extent>,
    /// Disconnected when the thread has ended.
    ended: Receiver<()>,
    thread: Option<JoinHandle<()>>,
    /// Display time between two pictures, ns.
    pub(super) every: i64,
    /// Longest side of a picture, pixels.
    pub(super) longest: u32,
}

/// How a desk's window opens.
pub(crate) struct Opening {
    /// Width and height, pixels of a screen of the usual density.
    pub size: [u32; 2],
    /// Whether it fills the screen.
    pub full_screen: bool,
    /// Height of text over its picture, times the usual.
    pub scale: f32,
    /// Where mouse and keyboard are sent. It is disconnected once the window is closed.
    pub input: Sender<Input>,
}

/// The displays that a window can be on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Display {
    /// Width of the widest one and height of the highest one, pixels, and those of the window at least.
    pub largest: [u32; 2],
    /// Pictures in a thousand seconds, of the one that it opens on; `None` where that is unknown.
    pub rate_mhz: Option<u32>,
}

/// Width and height of the window; 0 once it is closed.
#[derive(Default)]
pub(crate) struct Extent(AtomicU64);

impl Extent {
    fn set(&self, [width, height]: [u32; 2]) {
        let both = u64::from(width) << 32 | u64::from(height);
        self.0.store(both, Ordering::Relaxed);
    }

    /// Both, pixels; `None` once it is closed, or while it is minimised to nothing.
    pub fn get(&self) -> Option<[u32; 2]> {
        let both = self.0.load(Ordering::Relaxed);
        let extent = [(both >> 32) as u32, both as u32];
        (!extent.contains(&0)).then_some(extent)
    }
}

/// Sets the extent to 0 when the thread ends, however it does, so that no picture is made for a window that is gone.
struct Leaving {
    extent: Arc<Extent>,
    _end: Sender<()>,
}

impl Drop for Leaving {
    fn drop(&mut self) {
        self.extent.set([0, 0]);
    }
}

impl Window {
    /// A window for pictures of the aspect of `eye`, whose keys decide as the terminal's do.
    ///
    /// # Errors
    /// Why there is none: no screen, or none that can be used.
    pub fn open(eye: [u32; 2], decisions: Sender<Decision>) -> Result<Self, Failure> {
        let asked = Asked::new(fit(eye, [OPENS_AT; 2]), decisions);
        Self::show(asked, (EVERY, LONGEST))
    }

    /// A window that takes mouse and keyboard, and the displays that it can be on. It takes pictures of any size, as many as come.
    ///
    /// # Errors
    /// As for [`Window::open`].
    pub(crate) fn of_desk(
        opening: Opening,
        decisions: Sender<Decision>,
    ) -> Result<(Self, Display), Failure> {
        let (opened, display) = channel();
        let asked = Asked {
            full_screen: opening.full_screen,
            scale: opening.scale,
            listener: Some(Listener::new(opening.input)),
            opened: Some(opened),
            ..Asked::new(opening.size, decisions)
        };
        let window = Self::show(asked, (0, u32::MAX))?;
        let display = display.recv_timeout(PATIENCE);
        let display = display.map_err(|_| "the screen shows no window").other()?;
        Ok((window, display))
    }

    /// Shows it on a thread of its own. Between its pictures is `every` (ns) at least, and their sides are `longest` (pixels) at most.
    fn show(asked: Asked, (every, longest): (i64, u32)) -> Result<Self, Failure> {
        // winit's own message for this names a line of its source.
        if !names_screen() {
            return Err(NO_SCREEN).other();
        }
        let extent = Arc::clone(&asked.extent);
        let (opened, opening) = channel();
        let (end, ended) = channel();
        let leaving = Leaving {
            extent: Arc::clone(&extent),
            _end: end,
        };
        let thread = std::thread::Builder::new()
            .name("window".into())
            .spawn(move || {
                let _leaving = leaving;
                let events = match event_loop() {
                    Ok(events) => events,
                    Err(error) => {
                        let _ = opened.send(Err(error));
                        return;
                    }
                };
                if opened.send(Ok(events.create_proxy())).is_err() {
                    // `open` has given up waiting, so nobody would use the window.
                    return;
                }
                let mut face = Face {
                    asked,
                    frame: None,
                    shown: None,
                    over: None,
                    pointer: None,
                };
                if let Err(error) = events.run_app(&mut face) {
                    tracing::warn!("the window is gone: {error}");
                }
            });
        let thread = thread.other()?;
        let opened = opening.recv_timeout(PATIENCE);
        let opened = opened.map_err(|_| "the screen does not answer").other()?;
        Ok(Self {
            proxy: opened.other()?,
            extent,
            ended,
            thread: Some(thread),
            every,
            longest,
        })
    }

    /// Its width and height, pixels; `None` once it is closed, or while it is minimised to nothing.
    pub fn extent(&self) -> Option<[u32; 2]> {
        self.extent.get()
    }

    /// The same as it changes.
    pub(crate) fn shared_extent(&self) -> Arc<Extent> {
        Arc::clone(&self.extent)
    }

    /// Its title until the session has one: it has its picture when bench and shaders are ready, which may take minutes.
    pub fn entitle(&self, title: String) {
        self.say(Say::Title(title));
    }

    /// Sends it a message, which is lost if it is closed.
    pub fn say(&self, what: Say) {
        let _ = self.proxy.send_event(what);
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        self.say(Say::End);
        // The program does not wait for a screen that hangs.
        let hangs =
            self.ended.recv_timeout(PATIENCE) == Err(std::sync::mpsc::RecvTimeoutError::Timeout);
        if let (Some(thread), false) = (self.thread.take(), hangs) {
            let _ = thread.join();
        }
    }
}

/// What is said where the environment names no screen.
const NO_SCREEN: &str = if cfg!(feature = "wayland") {
    "there is neither a Wayland compositor nor an X server (WAYLAND_DISPLAY and DISPLAY are not set)"
} else {
    "there is no X server (DISPLAY is not set)"
};

/// Whether there is a screen for a window: on Linux one that the environment names, which is not asked. Of two, winit takes Wayland's; to it
/// an empty name is none.
pub fn names_screen() -> bool {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|it| !it.is_empty());
    let on_wayland = cfg!(feature = "wayland") && is_set("WAYLAND_DISPLAY");
    !cfg!(target_os = "linux") || is_set("DISPLAY") || on_wayland
}

/// An event loop outside the main thread, on which the frame loop runs.
fn event_loop() -> Result<EventLoop<Say>, EventLoopError> {
    let mut builder = EventLoop::with_user_event();
    // Wayland's trait sets the same flag.
    #[cfg(target_os = "linux")]
    winit::platform::x11::EventLoopBuilderExtX11::with_any_thread(&mut builder, true);
    #[cfg(windows)]
    winit::platform::windows::EventLoopBuilderExtWindows::with_any_thread(&mut builder, true);
    builder.build()
}

/// The window's pixels in memory.
type Pixels = Surface<Rc<Frame>, Rc<Frame>>;

/// What a window is to be.
struct Asked {
    /// Its size; before it is open, the size that it is to open with.
    extent: Arc<Extent>,
    decisions: Sender<Decision>,
    /// Whether it opens over all of the screen.
    full_screen: bool,
    /// Height of text over its picture, times the usual.
    scale: f32,
    /// Takes mouse and keys, of a desk's window.
    listener: Option<Listener>,
    /// Where the display is sent once it is open.
    opened: Option<Sender<Display>>,
}

impl Asked {
    /// A mirror that opens with that size, pixels of a screen of the usual density.
    fn new(size: [u32; 2], decisions: Sender<Decision>) -> Self {
        let extent = Arc::new(Extent::default());
        extent.set(size);
        Self {
            extent,
            decisions,
            full_screen: false,
            scale: 1.0,
            listener: None,
            opened: None,
        }
    }
}

/// The window on its own thread.
struct Face {
    asked: Asked,
    frame: Option<(Rc<Frame>, Pixels)>,
    /// The last picture, 0x00RRGGBB row by row, and its width and height.
    shown: Option<(Vec<u32>, [u32; 2])>,
    /// Strip and label over it, once one of them said something.
    over: Option<Over>,
    /// Where the pointer is in it, pixels.
    pointer: Option<[f32; 2]>,
}

/// Nothing, or an error of screen or device.
type WindowResult = Result<(), Box<dyn std::error::Error>>;

impl Face {
    fn open(&mut self, events: &ActiveEventLoop) -> WindowResult {
        let asked = &mut self.asked;
        let [width, height] = asked.extent.get().unwrap_or([OPENS_AT; 2]);
        let whole = asked.full_screen.then_some(Fullscreen::Borderless(None));
        let wanted = Frame::default_attributes()
            .with_title("Vitriol")
            .with_inner_size(LogicalSize::new(width, height))
            .with_fullscreen(whole);
        let frame = Rc::new(events.create_window(wanted)?);
        let context = Context::new(Rc::clone(&frame))?;
        let surface = Surface::new(&context, Rc::clone(&frame))?;
        asked.extent.set(frame.inner_size().into());
        if let Some(opened) = asked.opened.take() {
            let monitor = frame.current_monitor().or_else(|| frame.primary_monitor());
            // On Wayland a window is on no monitor before its first picture.
            let monitor = monitor.or_else(|| events.available_monitors().next());
            let rate_mhz = monitor.and_then(|monitor| monitor.refresh_rate_millihertz());
            let mut largest: [u32; 2] = frame.inner_size().into();
            // It may be moved to any of them.
            for monitor in frame.available_monitors() {
                let [width, height]: [u32; 2] = monitor.size().into();
                largest = [largest[0].max(width), largest[1].max(height)];
            }
            // Where nobody waits any more, the window is closed soon.
            let _ = opened.send(Display { largest, rate_mhz });
        }
        self.frame = Some((frame, surface));
        Ok(())
    }

    /// Takes an event of a desk's window; in a mirror keys decide.
    fn take(&mut self, event: &WindowEvent) {
        let Some((frame, _)) = &self.frame else {
            return;
        };
        let asked = &mut self.asked;
        let decided = if let Some(listener) = &mut asked.listener {
            let size = (asked.extent.get()).unwrap_or_else(|| frame.inner_size().into());
            // The first picture will fill the window.
            let extent = self.shown.as_ref().map_or(size, |(_, extent)| *extent);
            match event {
                WindowEvent::CursorMoved { position, .. } => {
                    self.pointer = Some([position.x, position.y].map(|side| side as f32));
                }
                WindowEvent::CursorLeft { .. } => self.pointer = None,
                // What nobody sees need not be drawn.
                WindowEvent::Occluded(true) => asked.extent.set([0, 0]),
                WindowEvent::Occluded(false) | WindowEvent::Focused(true) => {
                    asked.extent.set(frame.inner_size().into());
                }
                _ => {}
            }
            match listener.take(event, size, extent) {
                Outcome::Taken => None,
                Outcome::Decided(decision) => Some(decision),
                Outcome::FullScreen => {
                    let whole = frame.fullscreen().is_none();
                    frame.set_fullscreen(whole.then_some(Fullscreen::Borderless(None)));
                    None
                }
            }
        } else {
            decision(event)
        };
        if let Some(decision) = decided {
            // A session that has ended takes no decisions.
            let _ = asked.decisions.send(decision);
        }
    }

    /// Shows the last picture, as large as it fits, in the middle.
    fn draw(&mut self) -> WindowResult {
        let Some((frame, surface)) = &mut self.frame else {
            return Ok(());
        };
        let [width, height]: [u32; 2] = frame.inner_size().into();
        let (Some(across), Some(down)) = (NonZeroU32::new(width), NonZeroU32::new(height)) else {
            return Ok(());
        };
        surface.resize(across, down)?;
        let mut pixels = surface.buffer_mut()?;
        pixels.fill(0);
        let window = [width, height];
        if let Some((picture, extent)) = &self.shown {
            lay(&mut pixels, window, picture, *extent);
        }
        if let Some(over) = &mut self.over {
            let extent = self.shown.as_ref().map_or(window, |(_, extent)| *extent);
            let density = frame.scale_factor() as f32;
            let place = |at| onto(window, extent, at);
            over.draw(&mut pixels, (window, density), place, self.pointer);
        }
        frame.pre_present_notify();
        pixels.present()?;
        Ok(())
    }

    fn receive(&mut self, what: Say) -> WindowResult {
        let Some((frame, _)) = &self.frame else {
            return Ok(());
        };
        let over = || Over::new(self.asked.scale);
        match what {
            Say::Title(title) => {
                frame.set_title(&title);
                return Ok(());
            }
            Say::Picture(shrunk) => self.shown = Some((shrunk.pixels()?, shrunk.extent)),
            Say::Strip(said) => self.over.get_or_insert_with(over).strip(said),
            Say::Label(said) => self.over.get_or_insert_with(over).label(said),
            Say::End => return Ok(()),
        }
        frame.request_redraw();
        Ok(())
    }

    /// Closes the window where it cannot go on. The session goes on, but at a desk.
    fn settle(&mut self, events: &ActiveEventLoop, outcome: WindowResult) {
        if let Err(error) = outcome {
            tracing::warn!("the window is closed: {error}");
            events.exit();
        }
    }
}

impl ApplicationHandler<Say> for Face {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.frame.is_none() {
            let opened = self.open(events);
            self.settle(events, opened);
        }
    }

    fn user_event(&mut self, events: &ActiveEventLoop, what: Say) {
        if let Say::End = what {
            events.exit();
        } else {
            let received = self.receive(what);
            self.settle(events, received);
        }
    }

    /// Drops the window while the event loop still runs, which sends that to the screen.
    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.frame = None;
        self.asked.extent.set([0, 0]);
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(size) => {
                self.asked.extent.set(size.into());
                if let Some((frame, _)) = &self.frame {
                    frame.request_redraw();
                }
            }
            WindowEvent::RedrawRequested => {
                let drawn = self.draw();
                self.settle(events, drawn);
            }
            event => self.take(&event),
        }
    }
}

/// What a key in a mirror decides.
fn decision(event: &WindowEvent) -> Option<Decision> {
    let WindowEvent::KeyboardInput { event, .. } = event else {
        return None;
    };
    match &event.logical_key {
        Key::Character(text) if event.state.is_pressed() && !event.repeat => {
            text.chars().next().and_then(menu::decision)
        }
        _ => None,
    }
}
