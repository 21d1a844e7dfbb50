//! The OpenXR session: a [`Headset`] that outlives the loss of its runtime.

// OpenXR and Vulkan are unsafe interfaces; every block states why its call is valid.
#![allow(unsafe_code)]

mod actions;
mod bindings;
mod chain;
mod convert;
mod events;
mod layers;
mod live;
mod mask;
mod options;
mod pinch;
mod provider;
mod seek;
mod stage;
mod system;

use openxr as xr;
use vitriol_gpu::Gpu;

use convert::{CallFailure, failed, fov, located, pose};
use live::{Begun, Live};
pub use options::OpenXrOptions;
use seek::Seek;
use system::STEREO;

use crate::headset::{HeadsetFrame, Shown, Targets, Turn, View};
use crate::{Fov, FrameInfo, Hand, Headset, HeadsetError, Pose, PoseFrame, SessionState, Side};

/// Longest that a turn without a frame waits.
const IDLE: std::time::Duration = std::time::Duration::from_millis(50);

/// A headset through OpenXR: API 1.0 with XR_KHR_vulkan_enable2, and what else the runtime
/// offers of local_floor, composition_layer_depth, visibility_mask, display_refresh_rate,
/// hand_interaction, hand_tracking, user_presence and Pico's controllers.
pub struct OpenXr {
    options: OpenXrOptions,
    entry: xr::Entry,
    /// `None` while there is no runtime.
    live: Option<Live>,
    /// When to look for the runtime again.
    seek: Seek,
    /// The program has asked for the end.
    leaving: bool,
    /// Why the session was lost in the middle of a frame.
    lost: Option<String>,
    // Readable without a session too.
    gpu: Gpu,
    extent: [u32; 2],
    name: String,
    // Continued by a new session.
    index: u64,
    head: Pose,
    views: [View; 2],
    hands: [Hand; 2],
}

impl OpenXr {
    /// Finds runtime and headset, and has the runtime open the device.
    ///
    /// # Errors
    /// [`HeadsetError::NoRuntime`] where loader, runtime or headset are absent, with the remedy;
    /// else what the runtime or the device refused.
    pub fn open(options: OpenXrOptions) -> Result<Self, HeadsetError> {
        let entry = system::entry()?;
        let live = Live::start(&entry, &options).map_err(|failure| match failure {
            CallFailure::Lost(cause) => HeadsetError::NoRuntime {
                remedy: format!(
                    "The OpenXR runtime went away while the session was opened ({cause}): start it \
                     again."
                ),
            },
            CallFailure::Fatal(error) => error,
        })?;
        let eye = View {
            stage_from_eye: Pose::IDENTITY,
            fov: Fov::default(),
        };
        Ok(Self {
            gpu: live.gpu.clone(),
            extent: live.extent,
            name: live.name.clone(),
            live: Some(live),
            options,
            entry,
            seek: Seek::begin(),
            leaving: false,
            lost: None,
            index: 0,
            head: Pose::IDENTITY,
            views: [eye; 2],
            hands: [Hand::default(), Hand::default()],
        })
    }

    fn is_running(&self) -> bool {
        self.live.as_ref().is_some_and(|live| live.running)
    }

    /// Another try at the runtime, if it is time for one.
    fn seek(&mut self) -> Result<Turn, HeadsetError> {
        let again = |cause: String| Ok(Turn::Lost { cause });
        if !self.seek.wait(IDLE) {
            return again("the runtime is not there yet".to_owned());
        }
        match Live::start(&self.entry, &self.options) {
            Ok(live) => {
                self.gpu = live.gpu.clone();
                self.extent = live.extent;
                self.name = live.name.clone();
                self.live = Some(live);
                Ok(Turn::Renewed)
            }
            Err(CallFailure::Fatal(error @ HeadsetError::Gpu(_))) => Err(error),
            Err(CallFailure::Lost(cause)) => {
                tracing::debug!(cause, "no runtime yet");
                again(cause)
            }
            Err(CallFailure::Fatal(error)) => {
                tracing::debug!(%error, "no runtime yet");
                again(error.to_string())
            }
        }
    }

    /// One turn of a live session.
    fn turn(&mut self) -> Result<Turn, CallFailure> {
        let Some(live) = &mut self.live else {
            return Ok(Turn::Paused);
        };
        // The caller may not have ended the frame before.
        live.end_empty()?;
        live.take_events()?;
        if live.ended {
            return Ok(Turn::Ended);
        }
        if !live.running {
            std::thread::sleep(IDLE);
            return Ok(Turn::Paused);
        }
        let begun = live.begin()?;
        let visible = matches!(live.state, SessionState::Focused | SessionState::Visible);
        // Frames go on at the runtime's pace, so that it can show the session again at any time.
        if !visible || !live.present {
            live.end_empty()?;
            return Ok(Turn::Paused);
        }
        live.actions.read(
            &live.session,
            &live.stage.space,
            begun.time,
            &mut self.hands,
        )?;
        let head = live
            .head
            .locate(&live.stage.space, begun.time)
            .map_err(failed("xrLocateSpace"))?;
        if let Some(head) = located(&head) {
            self.head = head;
        }
        locate_views(live, begun, &mut self.views)?;
        let recentred = live
            .moves_at
            .take_if(|at| at.as_nanos() <= begun.time.as_nanos())
            .is_some();
        let frame = HeadsetFrame {
            index: self.index,
            poses: PoseFrame {
                step: 0,
                time_ns: 0,
                stage_from_view: self.head,
                hands: self.hands.clone(),
                scenario: Vec::new(),
                info: FrameInfo {
                    xr_time: begun.time.as_nanos(),
                    period_ns: begun.period.as_nanos(),
                    fov: self.views.map(|view| view.fov),
                    session_state: live.state,
                },
            },
            should_render: begun.should_render,
            recentred,
        };
        self.index += 1;
        let told = |pose: &Pose| (pose.position.to_array(), pose.orientation.to_array());
        let hand = |hand: &Hand| {
            let is_known = hand.active && hand.valid;
            is_known.then(|| (told(&hand.stage_from_grip), hand.squeeze))
        };
        let [left, right] = &self.hands;
        tracing::debug!(
            "frame for {} ns: head {:?}, left {:?}, right {:?}",
            begun.time.as_nanos(),
            told(&self.head),
            hand(left),
            hand(right)
        );
        Ok(Turn::Frame(Box::new(frame)))
    }

    /// Keeps a loss in the middle of a frame for the next turn, which reports it.
    fn settle<T>(&mut self, result: Result<T, CallFailure>) -> Result<Option<T>, HeadsetError> {
        match result {
            Ok(value) => Ok(Some(value)),
            Err(CallFailure::Lost(cause)) => {
                self.lost = Some(cause);
                Ok(None)
            }
            Err(CallFailure::Fatal(error)) => Err(error),
        }
    }

    /// Drops the session and begins to look for the runtime.
    fn lose(&mut self, cause: String) -> Turn {
        tracing::warn!(cause, "OpenXR session lost");
        self.live = None;
        for hand in &mut self.hands {
            hand.active = false;
            hand.valid = false;
            hand.tracked = false;
        }
        self.seek = Seek::begin();
        Turn::Lost { cause }
    }
}

impl Headset for OpenXr {
    fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    fn extent(&self) -> [u32; 2] {
        self.extent
    }

    fn hidden_area(&self) -> [Vec<[f32; 2]>; 2] {
        let of = |eye: usize| {
            let masks = self.live.as_ref().map(|live| &live.masks[eye]);
            masks.map(|mask| mask.in_picture(&self.views[eye].fov))
        };
        [0, 1].map(|eye| of(eye).unwrap_or_default())
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn next(&mut self) -> Result<Turn, HeadsetError> {
        if self.leaving && (self.lost.is_some() || !self.is_running()) {
            return Ok(Turn::Ended);
        }
        if let Some(cause) = self.lost.take() {
            return Ok(self.lose(cause));
        }
        if self.live.is_none() {
            return self.seek();
        }
        match self.turn() {
            Ok(turn) => Ok(turn),
            Err(CallFailure::Lost(cause)) => Ok(self.lose(cause)),
            Err(CallFailure::Fatal(error)) => Err(error),
        }
    }

    fn acquire(&mut self) -> Result<Targets, HeadsetError> {
        let acquired = match (&mut self.live, &self.lost) {
            (Some(live), None) => live.acquire(),
            _ => Err(CallFailure::Lost("there is no session".to_owned())),
        };
        if let Some(targets) = self.settle(acquired)? {
            return Ok(targets);
        }
        // The copies go to images that nobody will see; the next turn says that they are lost.
        let stale = self.live.as_ref().map(Live::stale);
        stale.ok_or_else(|| HeadsetError::Refused {
            call: "xrAcquireSwapchainImage",
            cause: "no frame has begun".to_owned(),
        })
    }

    fn locate_views(&mut self) -> Result<[View; 2], HeadsetError> {
        if let (Some(live), None) = (&mut self.live, &self.lost)
            && let Some(begun) = live.begun
        {
            let located = locate_views(live, begun, &mut self.views);
            self.settle(located)?;
        }
        Ok(self.views)
    }

    fn end(&mut self, shown: Option<&Shown>) -> Result<(), HeadsetError> {
        let ended = match (&mut self.live, &self.lost, shown) {
            (Some(live), None, Some(shown)) => match live.begun.take() {
                Some(begun) => live.show(begun, shown),
                None => Ok(()),
            },
            (Some(live), None, None) => live.end_empty(),
            _ => Ok(()),
        };
        self.settle(ended).map(|_| ())
    }

    fn vibrate(&mut self, side: Side, amplitude: f32) -> Result<(), HeadsetError> {
        let vibrated = match (&self.live, &self.lost) {
            (Some(live), None) => live.actions.vibrate(&live.session, side, amplitude),
            _ => Ok(()),
        };
        self.settle(vibrated).map(|_| ())
    }

    fn request_exit(&mut self) -> Result<(), HeadsetError> {
        self.leaving = true;
        let asked = match (&self.live, &self.lost) {
            (Some(live), None) if live.running => live
                .session
                .request_exit()
                .map_err(failed("xrRequestExitSession")),
            _ => Ok(()),
        };
        self.settle(asked).map(|_| ())
    }
}

/// The eyes at the frame's display time; what is not known stays.
fn locate_views(live: &Live, begun: Begun, views: &mut [View; 2]) -> Result<(), CallFailure> {
    let (flags, found) = live
        .session
        .locate_views(STEREO, begun.time, &live.stage.space)
        .map_err(failed("xrLocateViews"))?;
    let valid = xr::ViewStateFlags::POSITION_VALID | xr::ViewStateFlags::ORIENTATION_VALID;
    if flags.contains(valid) {
        for (view, found) in views.iter_mut().zip(found) {
            *view = View {
                stage_from_eye: pose(found.pose),
                fov: fov(found.fov),
            };
        }
    }
    Ok(())
}
