//! The window, on a thread of its own, so that the frame loop never waits for the screen or its server.

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
use winit::dpi::PhysicalSize;
use winit::error::EventLoopError;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop, EventLoopProxy};
use winit::keyboard::Key;
use winit::window::{Window as Frame, WindowId};

use super::shrink::{Shrunk, fit};
use crate::decision::Decision;
use crate::menu;

/// Longest side of the window when it opens, pixels.
const OPENS_AT: u32 = 800;
/// Longest wait for the screen's server, at the beginning and at the end.
const PATIENCE: Duration = Duration::from_secs(2);

/// A message to the window.
pub enum Say {
    /// A new title.
    Title(String),
    /// A new picture.
    Picture(Shrunk),
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
}

/// Width and height of the window; 0 once it is closed.
#[derive(Default)]
struct Extent(AtomicU64);

impl Extent {
    fn set(&self, [width, height]: [u32; 2]) {
        let both = u64::from(width) << 32 | u64::from(height);
        self.0.store(both, Ordering::Relaxed);
    }

    fn get(&self) -> Option<[u32; 2]> {
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
        // winit's own message for this names a line of its source.
        if cfg!(target_os = "linux") && std::env::var_os("DISPLAY").is_none() {
            return Err("there is no X server (DISPLAY is not set)").other();
        }
        let extent = Arc::new(Extent::default());
        extent.set(fit(eye, [OPENS_AT; 2]));
        let (shared, (opened, opening)) = (Arc::clone(&extent), channel());
        let (end, ended) = channel();
        let leaving = Leaving {
            extent: Arc::clone(&extent),
            _end: end,
        };
        let thread = std::thread::Builder::new()
            .name("mirror".into())
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
                    extent: shared,
                    decisions,
                    frame: None,
                    shown: None,
                };
                if let Err(error) = events.run_app(&mut face) {
                    tracing::warn!("the mirror window is gone: {error}");
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
        })
    }

    /// Its width and height, pixels; `None` once it is closed, or while it is minimised to nothing.
    pub fn extent(&self) -> Option<[u32; 2]> {
        self.extent.get()
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

/// An event loop outside the main thread, on which the frame loop runs.
fn event_loop() -> Result<EventLoop<Say>, EventLoopError> {
    let mut builder = EventLoop::with_user_event();
    #[cfg(target_os = "linux")]
    winit::platform::x11::EventLoopBuilderExtX11::with_any_thread(&mut builder, true);
    #[cfg(windows)]
    winit::platform::windows::EventLoopBuilderExtWindows::with_any_thread(&mut builder, true);
    builder.build()
}

/// The window's pixels in memory.
type Pixels = Surface<Rc<Frame>, Rc<Frame>>;

/// The window on its own thread.
struct Face {
    extent: Arc<Extent>,
    decisions: Sender<Decision>,
    frame: Option<(Rc<Frame>, Pixels)>,
    /// The last picture, 0x00RRGGBB row by row, and its width and height.
    shown: Option<(Vec<u32>, [u32; 2])>,
}

/// Nothing, or an error of screen or device.
type WindowResult = Result<(), Box<dyn std::error::Error>>;

impl Face {
    fn open(&mut self, events: &ActiveEventLoop) -> WindowResult {
        let [width, height] = self.extent.get().unwrap_or([OPENS_AT; 2]);
        let wanted = Frame::default_attributes()
            .with_title("Vitriol")
            .with_inner_size(PhysicalSize::new(width, height));
        let frame = Rc::new(events.create_window(wanted)?);
        let context = Context::new(Rc::clone(&frame))?;
        let surface = Surface::new(&context, Rc::clone(&frame))?;
        self.extent.set(frame.inner_size().into());
        self.frame = Some((frame, surface));
        Ok(())
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
        if let Some((picture, extent)) = &self.shown {
            lay(&mut pixels, [width, height], picture, *extent);
        }
        frame.pre_present_notify();
        pixels.present()?;
        Ok(())
    }

    fn hear(&mut self, what: Say) -> WindowResult {
        let Some((frame, _)) = &self.frame else {
            return Ok(());
        };
        match what {
            Say::Title(title) => frame.set_title(&title),
            Say::Picture(shrunk) => {
                self.shown = Some((shrunk.pixels()?, shrunk.extent));
                frame.request_redraw();
            }
            Say::End => {}
        }
        Ok(())
    }

    /// Closes the window where it cannot go on. The session goes on.
    fn settle(&mut self, events: &ActiveEventLoop, outcome: WindowResult) {
        if let Err(error) = outcome {
            tracing::warn!("the mirror window is closed: {error}");
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
            let heard = self.hear(what);
            self.settle(events, heard);
        }
    }

    /// Drops the window while the event loop still runs, which sends that to the screen.
    fn exiting(&mut self, _: &ActiveEventLoop) {
        self.frame = None;
        self.extent.set([0, 0]);
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(size) => {
                self.extent.set(size.into());
                if let Some((frame, _)) = &self.frame {
                    frame.request_redraw();
                }
            }
            WindowEvent::RedrawRequested => {
                let drawn = self.draw();
                self.settle(events, drawn);
            }
            WindowEvent::KeyboardInput { event, .. } => {
                if let Key::Character(text) = &event.logical_key
                    && event.state.is_pressed()
                    && !event.repeat
                    && let Some(decision) = text.chars().next().and_then(menu::decision)
                {
                    // A session that has ended takes no decisions.
                    let _ = self.decisions.send(decision);
                }
            }
            _ => {}
        }
    }
}

/// Lays `picture` as large as it fits in the middle of `window`.
fn lay(window: &mut [u32], [width, height]: [u32; 2], picture: &[u32], extent: [u32; 2]) {
    let [across, down] = fit(extent, [width, height]).map(|side| side as usize);
    let [width, height] = [width as usize, height as usize];
    let [columns, rows] = extent.map(|side| side as usize);
    let (across, down) = (across.min(width), down.min(height));
    let (left, upper) = ((width - across) / 2, (height - down) / 2);
    for (y, line) in window
        .chunks_exact_mut(width)
        .skip(upper)
        .take(down)
        .enumerate()
    {
        let row = &picture[columns * (y * rows / down)..][..columns];
        for (x, pixel) in line[left..left + across].iter_mut().enumerate() {
            *pixel = row[x * columns / across];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::lay;

    #[test]
    fn a_picture_lies_in_the_middle() {
        // 2 × 1 in 5 × 4: twice as large, a row above and one below, a column at the right.
        let mut window = [0; 20];
        lay(&mut window, [5, 4], &[1, 2], [2, 1]);
        let rows: Vec<&[u32]> = window.chunks(5).collect();
        // 5 / 2 = 2.5 times: 5 × 3 (2.5 rounded), of which the first three columns are the first.
        assert_eq!(rows[0], [1, 1, 1, 2, 2]);
        assert_eq!(rows[2], [1, 1, 1, 2, 2]);
        assert_eq!(rows[3], [0; 5]);
        // Its own size: as it is.
        let mut window = [0; 6];
        lay(&mut window, [3, 2], &[1, 2, 3, 4, 5, 6], [3, 2]);
        assert_eq!(window, [1, 2, 3, 4, 5, 6]);
    }
}
