//! The OpenXR session: a [`Headset`] that outlives the loss of its runtime.

// OpenXR and Vulkan are unsafe interfaces; every block states why its call is valid.
#![allow(unsafe_code)]

mod actions;
mod bindings;
mod chain;
mod convert;
mod events;
mod eyes;
mod images;
mod layers;
mod live;
mod mask;
mod options;
mod provider;
mod refusals;
mod seek;
mod seen;
mod stage;
mod system;
mod views;

use openxr as xr;
use vitriol_gpu::Gpu;

use convert::{CallFailure, failed, parts};
use eyes::Eyes;
use live::{Begun, Live};
pub use options::OpenXrOptions;
use seek::Seek;

use crate::headset::{HeadsetFrame, Inset, Pause, Shown, Targets, Turn, View};
use crate::{FrameInfo, Hand, Headset, HeadsetError, Pose, PoseFrame, SessionState, Side};

/// Longest that a turn without a frame waits.
const IDLE: std::time::Duration = std::time::Duration::from_millis(50);

/// Tries at another device after one was lost: with their waits half a minute.
const TRIES: u32 = 10;

/// A headset through OpenXR: API 1.0 with XR_KHR_vulkan_enable2, and those of local_floor, composition_layer_depth, visibility_mask,
/// display_refresh_rate, hand_interaction, hand_tracking, user_presence, quad_views, foveated_rendering and Pico's controllers that the
/// runtime offers.
pub struct OpenXr {
    options: OpenXrOptions,
    entry: xr::Entry,
    /// `None` while there is no runtime.
    live: Option<Live>,
    /// Times of the tries to find the runtime again.
    seek: Seek,
    /// Whether the program has asked for the end.
    leaving: bool,
    /// Why the session was lost in the middle of a frame.
    lost: Option<String>,
    /// Tries that are left at a device where there is none: a driver that lost one may need a while.
    patience: u32,
    // Readable without a session too.
    gpu: Gpu,
    extent: [u32; 2],
    inset: Option<[u32; 2]>,
    name: String,
    // Continued by a new session.
    index: u64,
    head: Pose,
    eyes: Eyes,
    gaze: Option<Pose>,
    hands: [Hand; 2],
}

impl OpenXr {
    /// Finds runtime and headset, and has the runtime open the device. While the headset is switched off it tries again, as long as
    /// `waits` returns true; `waits` gets the remedy.
    ///
    /// # Errors
    /// [`HeadsetError::NoRuntime`] where loader, runtime or headset are absent, with the remedy; otherwise the refusal of the runtime or
    /// the device.
    pub fn open(
        options: OpenXrOptions,
        mut waits: impl FnMut(&str) -> bool,
    ) -> Result<Self, HeadsetError> {
        let entry = system::entry()?;
        let mut seek = Seek::begin();
        let live = loop {
            if !seek.wait(IDLE) {
                continue;
            }
            match Live::start(&entry, &options) {
                Ok(live) => break live,
                Err(CallFailure::Fatal(HeadsetError::Asleep { remedy })) if waits(&remedy) => {}
                Err(CallFailure::Fatal(error)) => return Err(error),
                Err(CallFailure::Lost(cause)) => {
                    return Err(HeadsetError::NoRuntime {
                        remedy: format!(
                            "The OpenXR runtime went away while the session was opened ({cause}): \
                             start it again."
                        ),
                    });
                }
            }
        };
        Ok(Self {
            gpu: live.gpu.clone(),
            extent: live.extent,
            inset: live.inset,
            name: live.name.clone(),
            live: Some(live),
            options,
            entry,
            seek: Seek::begin(),
            leaving: false,
            lost: None,
            patience: 0,
            index: 0,
            head: Pose::IDENTITY,
            eyes: Eyes::default(),
            gaze: None,
            hands: [Hand::default(), Hand::default()],
        })
    }

    fn is_running(&self) -> bool {
        self.live.as_ref().is_some_and(|live| live.running)
    }

    /// Tries the runtime again, if it is time for a try.
    fn seek(&mut self) -> Result<Turn, HeadsetError> {
        let again = |cause: String| Ok(Turn::Lost { cause });
        if !self.seek.wait(IDLE) {
            return again("the runtime is not there yet".to_owned());
        }
        match Live::start(&self.entry, &self.options) {
            Ok(live) => {
                self.gpu = live.gpu.clone();
                self.extent = live.extent;
                self.inset = live.inset;
                self.name = live.name.clone();
                self.live = Some(live);
                self.patience = 0;
                Ok(Turn::Renewed)
            }
            Err(CallFailure::Fatal(error @ HeadsetError::Gpu(_))) if self.patience == 0 => {
                Err(error)
            }
            Err(CallFailure::Lost(cause)) => {
                tracing::debug!(cause, "no runtime yet");
                again(cause)
            }
            Err(CallFailure::Fatal(error)) => {
                let without_device = matches!(error, HeadsetError::Gpu(_));
                self.patience = self.patience.saturating_sub(without_device.into());
                tracing::debug!(%error, "no runtime yet");
                again(error.to_string())
            }
        }
    }

    /// One turn of a live session. The frame goes on without calls that the runtime refuses.
    fn turn(&mut self) -> Result<Turn, CallFailure> {
        let paused = |cause| Ok(Turn::Paused { cause });
        let Some(live) = &mut self.live else {
            return paused(Pause::Off);
        };
        live.refusals.begin();
        // The caller may not have ended the frame before.
        let ended = live.end_empty();
        live.refusals.bear(ended)?;
        let taken = live.take_events();
        live.refusals.bear(taken)?;
        if live.ended {
            return Ok(Turn::Ended);
        }
        if !live.running {
            std::thread::sleep(IDLE);
            return paused(Pause::Off);
        }
        let begun = live.begin();
        let Some(begun) = live.refusals.bear(begun)? else {
            std::thread::sleep(IDLE);
            return paused(Pause::Off);
        };
        let visible = matches!(live.state, SessionState::Focused | SessionState::Visible);
        // Frames go on at the runtime's pace, so that it can show the session again at any time.
        let pause = if !visible || !live.present {
            Some(Pause::Off)
        } else {
            let seen = find_head(live, begun, &mut self.head);
            let seen = live.refusals.bear(seen)?.unwrap_or(live.seen);
            (!seen).then_some(Pause::Unseen)
        };
        if let Some(cause) = pause {
            let ended = live.end_empty();
            live.refusals.bear(ended)?;
            return paused(cause);
        }
        let space = &live.stage.space;
        let read = live
            .actions
            .read(&live.session, space, begun.time, &mut self.hands);
        let joints = live.refusals.bear(read)?;
        if joints.is_none() {
            asleep(&mut self.hands);
        }
        let located = self.eyes.locate(live, begun, &self.head);
        live.refusals.bear(located)?;
        let recentred = live
            .moves_at
            .take_if(|at| at.as_nanos() <= begun.time.as_nanos())
            .is_some();
        let frame = HeadsetFrame {
            index: self.index,
            poses: PoseFrame {
                stage_from_view: self.head,
                hands: self.hands.clone(),
                info: FrameInfo {
                    xr_time: begun.time.as_nanos(),
                    period_ns: begun.period.as_nanos(),
                    fov: self.eyes.views().map(|view| view.fov),
                    session_state: live.state,
                },
                ..PoseFrame::default()
            },
            should_render: begun.should_render,
            recentred,
            lost: live.lost,
            joints: joints.unwrap_or_default(),
        };
        self.index += 1;
        self.log(&frame);
        Ok(Turn::Frame(Box::new(frame)))
    }

    fn log(&self, frame: &HeadsetFrame) {
        let told = |pose: &Pose| (pose.position.to_array(), pose.orientation.to_array());
        let hand = |hand: &Hand| {
            let is_known = hand.active && hand.valid;
            is_known.then(|| (told(&hand.stage_from_grip), hand.squeeze))
        };
        let [left, right] = &self.hands;
        tracing::debug!(
            "frame for {} ns: head {:?}, left {:?}, right {:?}",
            frame.poses.info.xr_time,
            told(&self.head),
            hand(left),
            hand(right)
        );
    }

    /// The result of a call in the middle of a frame; `None` where the runtime refused it. A loss is kept for the next turn, which reports
    /// it.
    fn settle<T>(&mut self, result: Result<T, CallFailure>) -> Result<Option<T>, HeadsetError> {
        let borne = match &mut self.live {
            Some(live) => live.refusals.bear(result),
            None => result.map(Some),
        };
        match borne {
            Ok(value) => Ok(value),
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
        if let Some(live) = self.live.take()
            && live.inset.is_some()
            && live.refusals.gave_up_on_views()
        {
            tracing::warn!("the runtime refuses {}; it goes on without", system::INSET);
            self.options.inset = false;
        }
        asleep(&mut self.hands);
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

    fn inset(&self) -> Option<Inset> {
        let views = self.eyes.inset();
        self.inset.map(|extent| Inset { extent, views })
    }

    fn hidden_area(&self) -> [Vec<[f32; 2]>; 2] {
        let of = |eye: usize| {
            let masks = self.live.as_ref().map(|live| &live.masks[eye]);
            masks.map(|mask| mask.in_picture(&self.eyes.views()[eye].fov))
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

    fn acquire(&mut self, panel: bool) -> Result<Option<Targets>, HeadsetError> {
        let acquired = match (&mut self.live, &self.lost) {
            (Some(live), None) => live.images.acquire(&live.gpu, panel),
            _ => return Ok(None),
        };
        self.settle(acquired)
    }

    fn locate_views(&mut self) -> Result<[View; 2], HeadsetError> {
        if let (Some(live), None) = (&mut self.live, &self.lost)
            && let Some(begun) = live.begun
        {
            let located = self.eyes.locate(live, begun, &self.head);
            let gaze = live.actions.gaze(&live.stage.space, begun.time);
            self.settle(located)?;
            self.gaze = self.settle(gaze)?.flatten();
        }
        Ok(self.eyes.views())
    }

    fn gaze(&self) -> Option<Pose> {
        self.gaze
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
        let vibrated = match (&mut self.live, &self.lost) {
            (Some(live), None) => live.actions.vibrate(&live.session, side, amplitude),
            _ => Ok(()),
        };
        self.settle(vibrated).map(|_| ())
    }

    fn lose_device(&mut self) {
        self.lost
            .get_or_insert_with(|| "the Vulkan device was lost".to_owned());
        self.patience = TRIES;
    }

    fn rates(&self) -> &[f32] {
        self.live.as_ref().map_or(&[], |live| &live.rates)
    }

    fn request_rate(&mut self, rate: f32) -> Result<(), HeadsetError> {
        let asked = match (&self.live, &self.lost) {
            (Some(live), None) => live
                .session
                .request_display_refresh_rate(rate)
                .map_err(failed("xrRequestDisplayRefreshRateFB")),
            _ => Ok(()),
        };
        self.settle(asked).map(|_| ())
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

/// Frames with nothing but the head's orientation after which a session begins all the same: two seconds at 90 Hz. Some headsets never
/// report more.
const TURNS: u32 = 180;

/// Locates the head at the frame's display time; parts that are not known keep their values. Returns whether it has been located in this
/// session: before that, nothing that is drawn or placed would be where it is meant to be.
fn find_head(live: &mut Live, begun: Begun, head: &mut Pose) -> Result<bool, CallFailure> {
    let found = live
        .head
        .locate(&live.stage.space, begun.time)
        .map_err(failed("xrLocateSpace"))?;
    let (position, orientation) = parts(&found);
    head.orientation = orientation.unwrap_or(head.orientation);
    head.position = position.unwrap_or(head.position);
    live.placed |= position.is_some();
    live.lost = live.placed && position.is_none();
    live.turning += u32::from(orientation.is_some());
    live.seen |= orientation.is_some() && (position.is_some() || live.turning > TURNS);
    Ok(live.seen)
}

/// Marks both hands as unknown; their poses stay.
fn asleep(hands: &mut [Hand; 2]) {
    for hand in hands {
        hand.active = false;
        hand.valid = false;
        hand.tracked = false;
    }
}
