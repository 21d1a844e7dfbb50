//! A stand-in for a headset: images of any size on the device at hand, a clock that paces frames
//! and notes which come too late, and a pose track as the wearer. It is for measurements and tests and
//! shows nothing.

use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::frame_clock::FrameClock;
use super::panel::PANEL;
use super::reopening::Reopening;
use glam::{Quat, Vec3};
use vitriol_gpu::{Gpu, GpuError, Image, ImageDesc, QueueKind, Ticket, vk};
use vitriol_run::EYES_APART;
use vitriol_xr::track::{Track, TrackSource};
use vitriol_xr::{
    Fov, Headset, HeadsetError, HeadsetFrame, Pose, PoseFrame, PoseSource, SessionState, Shown,
    Side, Targets, Turn, View, depth_extent,
};

/// An eye's frustum, rad: 54° outwards, 40° inwards, 42° up, 55° down, as of a headset whose eyes
/// see more aside than towards the nose.
const LEFT_EYE: Fov = Fov {
    left: -0.94,
    right: 0.70,
    up: 0.73,
    down: -0.96,
};

/// Time on the runtime's clock at the start, ns. Not 0, where the simulation's time begins, so that a test finds code
/// that mistakes one for the other.
pub const EPOCH: i64 = 1_000_000_000_000;

/// How the stand-in's clock runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// In real time: a frame begins a period before its picture is to be shown, and a picture that is not done by then
    /// is late.
    Real,
    /// One period a frame, however long the frame takes.
    Free,
}

/// What a stand-in is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandInSpec {
    /// Width and height of an eye's picture, pixels.
    pub extent: [u32; 2],
    /// Frames a second.
    pub rate_hz: f64,
    /// How its clock runs.
    pub timing: Timing,
}

/// A frame's picture as the stand-in's compositor saw it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ready {
    /// The frame.
    pub index: u64,
    /// From the frame's begin to the end of its work on the device.
    pub after: Duration,
}

/// A headset without hardware: it has images on the device at hand, a clock that paces frames, and a pose track as its wearer.
pub struct StandIn {
    gpu: Gpu,
    spec: StandInSpec,
    /// The images that it was given last.
    pub targets: Targets,
    /// At the track's start; cloned where the wearer starts over.
    wearer: TrackSource,
    playing: TrackSource,
    rounds: u64,
    clock: FrameClock,
    index: u64,
    view: Pose,
    leaving: bool,
    /// Display rates that it offers, Hz.
    pub rates: Vec<f32>,
    /// Where its wearer looks, in the stage; `None` where it does not report that.
    pub gaze: Option<Pose>,
    /// What the left and the right hand feel.
    pub felt: [f32; 2],
    compositor: Option<Compositor>,
    name: String,
    reopening: Reopening,
}

/// Waits for pictures on a thread of its own, since the frame loop must not.
struct Compositor {
    frames: Option<Sender<(u64, Instant, Ticket)>>,
    seen: Arc<Mutex<Vec<Ready>>>,
    thread: Option<JoinHandle<()>>,
}

impl StandIn {
    /// A headset whose wearer moves as in `track`, over and over.
    ///
    /// # Errors
    /// [`GpuError`] where the device has no room for the images.
    pub fn new(gpu: &Gpu, track: Track, spec: StandInSpec) -> Result<Self, GpuError> {
        let wearer = TrackSource::new(track);
        Ok(Self {
            gpu: gpu.clone(),
            targets: targets(gpu, spec.extent)?,
            playing: wearer.clone(),
            wearer,
            rounds: 0,
            clock: FrameClock::new(spec.rate_hz),
            index: 0,
            view: Pose::IDENTITY,
            leaving: false,
            rates: Vec::new(),
            gaze: None,
            felt: [0.0; 2],
            compositor: (spec.timing == Timing::Real).then(Compositor::start),
            name: format!(
                "a stand-in of 2 × {} × {} at {} Hz on {}",
                spec.extent[0],
                spec.extent[1],
                spec.rate_hz,
                gpu.info().name
            ),
            spec,
            reopening: Reopening::default(),
        })
    }

    /// This stand-in, which goes on with the device that `reopens` opens where its own is lost.
    pub fn reopening(mut self, reopens: impl FnMut() -> Result<Gpu, GpuError> + 'static) -> Self {
        self.reopening = Reopening::by(reopens);
        self
    }

    /// Goes on with another device, as after a loss.
    ///
    /// # Errors
    /// As for [`StandIn::new`].
    pub fn move_to(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        self.targets = targets(gpu, self.spec.extent)?;
        self.gpu = gpu.clone();
        Ok(())
    }

    /// Frames whose work on the device is done, in order; none with [`Timing::Free`].
    pub fn ready(&self) -> Vec<Ready> {
        let seen = self.compositor.as_ref().map(|it| &it.seen);
        seen.map_or_else(Vec::new, |seen| {
            seen.lock().unwrap_or_else(PoisonError::into_inner).clone()
        })
    }

    /// The wearer when the frame's picture is shown.
    fn poses(&mut self) -> Result<PoseFrame, HeadsetError> {
        let length = self.wearer.track().duration().max(self.clock.seconds());
        let time = self.clock.time();
        let rounds = (time / length) as u64;
        if rounds > self.rounds {
            (self.rounds, self.playing) = (rounds, self.wearer.clone());
        }
        let within = (time - rounds as f64 * length).max(0.0);
        let refused = |cause: String| HeadsetError::Refused {
            call: "the stand-in's track",
            cause,
        };
        let frame = self.playing.next(0, within);
        let frame = frame.map_err(|error| refused(error.to_string()))?;
        let mut frame = frame.ok_or_else(|| refused("it has ended".into()))?;
        (frame.step, frame.time_ns) = (0, 0);
        frame.scenario.clear();
        frame.info.xr_time = EPOCH + (1e9 * time).round() as i64;
        frame.info.period_ns = self.clock.period_ns();
        frame.info.fov = [LEFT_EYE, mirrored(LEFT_EYE)];
        frame.info.session_state = SessionState::Focused;
        self.view = frame.stage_from_view;
        Ok(frame)
    }
}

fn targets(gpu: &Gpu, eyes: [u32; 2]) -> Result<Targets, GpuError> {
    let image = |label, extent, layers, format| {
        let desc = ImageDesc {
            extent,
            layers,
            format,
            usage: vk::ImageUsageFlags::SAMPLED,
        };
        Image::new(gpu, label, desc)
    };
    let rgba = vk::Format::R8G8B8A8_SRGB;
    Ok(Targets {
        colour: image("stand-in's colour", eyes, 2, rgba)?,
        depth: Some(image(
            "stand-in's depth",
            depth_extent(eyes),
            2,
            vk::Format::D32_SFLOAT,
        )?),
        inset: None,
        panel: Some(image("stand-in's panel", PANEL, 1, rgba)?),
    })
}

/// The other eye's frustum.
fn mirrored(fov: Fov) -> Fov {
    Fov {
        left: -fov.right,
        right: -fov.left,
        ..fov
    }
}

impl Headset for StandIn {
    fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    fn extent(&self) -> [u32; 2] {
        self.spec.extent
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn next(&mut self) -> Result<Turn, HeadsetError> {
        if self.leaving {
            return Ok(Turn::Ended);
        }
        if let Some(gpu) = self.reopening.next()? {
            self.move_to(&gpu)?;
            return Ok(Turn::Renewed);
        }
        match self.spec.timing {
            Timing::Real => {
                self.clock.wait();
            }
            Timing::Free => self.clock.step(),
        }
        let frame = HeadsetFrame {
            index: self.index,
            poses: self.poses()?,
            should_render: true,
            recentred: false,
            lost: false,
            joints: [None, None],
        };
        self.index += 1;
        Ok(Turn::Frame(Box::new(frame)))
    }

    fn acquire(&mut self, panel: bool) -> Result<Option<Targets>, HeadsetError> {
        let mut targets = self.targets.clone();
        targets.panel = targets.panel.filter(|_| panel);
        Ok(Some(targets))
    }

    fn locate_views(&mut self) -> Result<[View; 2], HeadsetError> {
        let eye = |side: f32, fov| View {
            stage_from_eye: self.view.compose(&Pose::new(
                Vec3::X * (side * 0.5 * EYES_APART),
                Quat::IDENTITY,
            )),
            fov,
        };
        Ok([eye(-1.0, LEFT_EYE), eye(1.0, mirrored(LEFT_EYE))])
    }

    fn gaze(&self) -> Option<Pose> {
        self.gaze
    }

    fn end(&mut self, _shown: Option<&Shown>) -> Result<(), HeadsetError> {
        let (Some(compositor), Some(begin)) = (&self.compositor, self.clock.began()) else {
            return Ok(());
        };
        // An empty submission behind the pictures on their queue is done when they are.
        let fence = self.gpu.submit(self.gpu.recorder(QueueKind::Main)?)?;
        if let Some(frames) = &compositor.frames {
            // It listens until it is dropped.
            let _ = frames.send((self.index - 1, begin, fence));
        }
        Ok(())
    }

    fn vibrate(&mut self, side: Side, amplitude: f32) -> Result<(), HeadsetError> {
        self.felt[side as usize] = amplitude;
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

impl Compositor {
    fn start() -> Self {
        let (frames, queue) = channel::<(u64, Instant, Ticket)>();
        let seen = Arc::new(Mutex::new(Vec::new()));
        let writes = Arc::clone(&seen);
        let thread = std::thread::spawn(move || {
            for (index, begin, ticket) in queue {
                // The frame loop reports a lost device, and goes on with another.
                if ticket.wait().is_err() {
                    continue;
                }
                let after = begin.elapsed();
                let mut seen = writes.lock().unwrap_or_else(PoisonError::into_inner);
                seen.push(Ready { index, after });
            }
        });
        Self {
            frames: Some(frames),
            seen,
            thread: Some(thread),
        }
    }
}

impl Drop for Compositor {
    fn drop(&mut self) {
        self.frames = None;
        if let Some(thread) = self.thread.take() {
            // It does not panic.
            let _ = thread.join();
        }
    }
}
