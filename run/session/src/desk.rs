//! A desk in place of a headset: a window, whose picture is seen from an eye that goes round the bench, and hands that follow mouse and
//! keyboard.

#[cfg(feature = "gamepad")]
mod gamepad;
mod hands;
pub(crate) mod input;
mod rate;
mod view;

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use glam::{Quat, Vec3};
use vitriol_gpu::{Gpu, GpuError, Image, ImageDesc, vk};
use vitriol_run::Failure;
use vitriol_xr::{
    Around, FrameInfo, Hand, Headset, HeadsetError, HeadsetFrame, Line, Pointed, Pose, PoseFrame,
    Shown, Targets, Turn, View,
};

use self::hands::Hands;
use self::input::{Input, Inputs};
use self::rate::{rate, rates};
use self::view::Viewpoint;
pub use self::view::{FOV, FOVS};
use crate::decision::Decision;
use crate::frame_clock::FrameClock;
use crate::mirror::{Display, Extent, Opening, Window};
use crate::placement::{SCENE_TABLE, SEATED};
use crate::reopening::Reopening;
use crate::stand_in::EPOCH;

/// How a desk's window opens, and what a click does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeskSpec {
    /// Width and height of the window as it opens, pixels of a screen of the usual density.
    pub size: [u32; 2],
    /// Whether it fills the screen.
    pub full_screen: bool,
    /// Angle between the upper and the lower side of the first view, degrees, as [`FOVS`] allow.
    pub fov: f32,
    /// Height of text over the picture, times the usual, as [`SCALES`] allow.
    pub scale: f32,
    /// Whether one click takes and the next puts down; else a hand holds while the button is down.
    pub toggles: bool,
}

/// Least and greatest height of text over the picture, times the usual. Our choice: 9 pixels in a window of 800 × 500, and a strip of two
/// lines that covers less than a quarter of it.
pub const SCALES: [f32; 2] = [0.5, 2.0];

/// A window with mouse and keyboard as a headset with hands.
pub struct Desk {
    gpu: Gpu,
    targets: Targets,
    /// Width and height of the largest picture, pixels: those of the largest screen.
    largest: [u32; 2],
    /// Width and height of this frame's picture, pixels.
    wanted: [u32; 2],
    window: Arc<Extent>,
    events: Receiver<Input>,
    #[cfg(feature = "gamepad")]
    gamepad: gamepad::Gamepad,
    inputs: Inputs,
    view: Viewpoint,
    hands: Hands,
    around: Around,
    clock: FrameClock,
    /// The rate at which it begins, Hz, and those from which a governor may choose.
    rate: f64,
    rates: Vec<f32>,
    index: u64,
    leaving: bool,
    name: String,
    reopening: Reopening,
}

/// The head of who sits at the bench and has these hands: it stays, so that what is worn comes to it. The eye of the window goes round the
/// bench, and is farther back, so that it has bench and panel before it.
const USER: Pose = Pose::new(
    Vec3::new(0.0, SCENE_TABLE + SEATED, 0.0),
    // Half a radian down, at the vessels.
    Quat::from_xyzw(-0.247_404, 0.0, 0.0, 0.968_912_4),
);

/// What to do where there is no screen.
const REMEDY: &str = "a desk needs a screen; start it from a graphical login, or simulate recorded hands \
                      without one by `vitriol replay`";

/// Opens a window and waits for it; its keys decide as the mirror's do. The window is for
/// [`Session::mirrored`](crate::session::Session::mirrored).
///
/// # Errors
/// [`Failure::NoDevice`] where there is no screen for a window; an error of the device.
pub fn open(
    gpu: &Gpu,
    spec: DeskSpec,
    decisions: Sender<Decision>,
) -> Result<(Desk, Window), Failure> {
    let (input, events) = channel();
    let opening = Opening {
        size: spec.size,
        full_screen: spec.full_screen,
        scale: spec.scale,
        input,
    };
    let (window, display) = Window::of_desk(opening, decisions).map_err(|failure| {
        Failure::NoDevice(format!("no window can be opened ({failure}): {REMEDY}").into())
    })?;
    let targets = targets(gpu).map_err(|error| Failure::Other(error.into()))?;
    let desk = Desk::new(gpu, (spec, display), (&window, events), targets);
    Ok((desk, window))
}

/// The session copies its picture for headsets. The window takes it from where it was drawn, so a pixel is enough, and the panel is in it.
fn targets(gpu: &Gpu) -> Result<Targets, GpuError> {
    let desc = ImageDesc {
        extent: [1, 1],
        layers: 1,
        format: vk::Format::R8G8B8A8_SRGB,
        usage: vk::ImageUsageFlags::SAMPLED,
    };
    Ok(Targets {
        colour: Image::new(gpu, "desk's colour", desc)?,
        depth: None,
        inset: None,
        panel: None,
    })
}

impl Desk {
    fn new(
        gpu: &Gpu,
        (spec, display): (DeskSpec, Display),
        (window, events): (&Window, Receiver<Input>),
        targets: Targets,
    ) -> Self {
        let largest = display.largest.map(|side| side.max(1));
        let (rate, view) = (rate(display.rate_mhz), Viewpoint::new(spec.fov));
        Self {
            targets,
            largest,
            wanted: window.extent().unwrap_or(largest),
            window: window.shared_extent(),
            events,
            #[cfg(feature = "gamepad")]
            gamepad: gamepad::Gamepad::open(),
            inputs: Inputs::default(),
            hands: Hands::new(&USER, SCENE_TABLE)
                .with_choice()
                .with_toggles(spec.toggles),
            view,
            // No frame takes simulated time before the first one is shown.
            // Its longest frame is 0: no hand moves before the bench is there.
            around: Around::default(),
            clock: FrameClock::new(rate),
            rate,
            rates: rates(rate, gpu.info().kind),
            index: 0,
            leaving: false,
            name: format!("a window at {rate:.0} Hz on {}", gpu.info().name),
            gpu: gpu.clone(),
            reopening: Reopening::default(),
        }
    }

    /// This desk, which goes on with the device that `reopens` opens where its own is lost.
    pub fn reopening(mut self, reopens: impl FnMut() -> Result<Gpu, GpuError> + 'static) -> Self {
        self.reopening = Reopening::by(reopens);
        self
    }

    /// Takes the events of gamepad, mouse and keyboard; `false` once the window is closed. Of those before the first frame, which show
    /// nothing, only the pointer's place counts.
    fn take_events(&mut self) -> bool {
        #[cfg(feature = "gamepad")]
        {
            let begun = self.index > 0;
            self.gamepad.poll(|input| {
                if begun || matches!(input, Input::Axes(_)) {
                    self.inputs.take(input);
                }
            });
        }
        loop {
            match self.events.try_recv() {
                Ok(input) if self.index > 0 || matches!(input, Input::Pointer(_)) => {
                    self.inputs.take(input);
                }
                Ok(_) => {}
                Err(TryRecvError::Empty) => return true,
                Err(TryRecvError::Disconnected) => return false,
            }
        }
    }

    /// Head and hands in a frame that is shown `passed` seconds after the last one.
    fn poses(&mut self, passed: f32) -> PoseFrame {
        let [width, height] = self.wanted.map(|side| side as f32);
        let turns = self.inputs.turns(passed);
        let panel = self.around.panel;
        self.view.advance(&turns, panel, width / height, passed);
        let controls = self.inputs.controls(&self.view);
        // The view is of the screen, and hands are of the bench.
        let simulated = self.around.simulated(passed);
        let hands: [Hand; 2] = self.hands.advance(&controls, &self.around, simulated);
        PoseFrame {
            stage_from_view: USER,
            hands,
            info: FrameInfo {
                xr_time: EPOCH + (1e9 * self.clock.time()).round() as i64,
                period_ns: self.clock.period_ns(),
                fov: [self.view.fov(); 2],
                ..FrameInfo::default()
            },
            ..PoseFrame::default()
        }
    }
}

impl Headset for Desk {
    fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    fn eyes(&self) -> u32 {
        1
    }

    fn extent(&self) -> [u32; 2] {
        self.largest
    }

    fn wanted(&self) -> [u32; 2] {
        self.wanted
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn next(&mut self) -> Result<Turn, HeadsetError> {
        if self.leaving {
            return Ok(Turn::Ended);
        }
        if let Some(gpu) = self.reopening.next()? {
            self.targets = targets(&gpu)?;
            // The session begins anew at the display's rate, since the times of the old device say nothing about this one.
            self.clock.change(self.rate);
            self.rates = rates(self.rate, gpu.info().kind);
            self.gpu = gpu;
            return Ok(Turn::Renewed);
        }
        let passed = self.clock.wait() as f32;
        if !self.take_events() {
            self.leaving = true;
            return Ok(Turn::Ended);
        }
        // A window that is minimised shows nothing, and time goes on in it.
        let window = self.window.get();
        if let Some(size) = window {
            self.wanted = [0, 1].map(|side| size[side].min(self.largest[side]));
        }
        let frame = HeadsetFrame {
            index: self.index,
            poses: self.poses(passed),
            should_render: window.is_some(),
            recentred: false,
            lost: false,
            joints: [None, None],
        };
        self.index += 1;
        Ok(Turn::Frame(Box::new(frame)))
    }

    fn acquire(&mut self, _panel: bool) -> Result<Option<Targets>, HeadsetError> {
        Ok(Some(self.targets.clone()))
    }

    fn locate_views(&mut self) -> Result<[View; 2], HeadsetError> {
        let view = View {
            stage_from_eye: self.view.pose(),
            fov: self.view.fov(),
        };
        Ok([view; 2])
    }

    fn around(&mut self, around: Around) {
        self.around = around;
    }

    fn lines(&self) -> Vec<Line> {
        self.hands.lines()
    }

    fn pointed(&self) -> Option<Pointed> {
        self.hands.pointed()
    }

    fn end(&mut self, _shown: Option<&Shown>) -> Result<(), HeadsetError> {
        Ok(())
    }

    fn lose_device(&mut self) {
        self.reopening.lose();
    }

    fn rates(&self) -> &[f32] {
        &self.rates
    }

    fn request_rate(&mut self, rate: f32) -> Result<(), HeadsetError> {
        self.clock.change(rate.into());
        Ok(())
    }

    fn request_exit(&mut self) -> Result<(), HeadsetError> {
        self.leaving = true;
        Ok(())
    }
}
