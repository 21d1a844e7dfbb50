//! One OpenXR session from its making to its loss: instance, device, swapchains, spaces, actions.

use openxr as xr;
use vitriol_gpu::ash::vk::Handle as _;
use vitriol_gpu::{Gpu, QueueKind};

use super::actions::Actions;
use super::convert::{CallFailure, failed};
use super::images::Images;
use super::mask::Mask;
use super::options::OpenXrOptions;
use super::provider::Runtime;
use super::refusals::Refusals;
use super::stage::Stage;
use super::system::{self, ConnectedHeadset};
use super::views::Views;
use crate::SessionState;

/// The display rate that is asked for at least where the runtime offers a choice, Hz: the time of a step
/// and of a picture is laid out for it (docs/measurements/performance.md). A display that is faster stays so.
const RATE: f32 = 90.0;

/// The frame that has begun.
#[derive(Clone, Copy)]
pub(super) struct Begun {
    pub time: xr::Time,
    pub period: xr::Duration,
    pub should_render: bool,
}

/// A session. Its parts are dropped from top to bottom, each before the part that it depends on; the device outlives the session by the
/// guard that the session holds.
pub(super) struct Live {
    pub stream: xr::FrameStream<xr::Vulkan>,
    pub waiter: xr::FrameWaiter,
    pub images: Images,
    pub head: xr::Space,
    /// Space of the gaze that an inset follows.
    pub gaze: Option<xr::Space>,
    pub stage: Stage,
    pub actions: Actions,
    pub session: xr::Session<xr::Vulkan>,
    pub instance: xr::Instance,
    pub gpu: Gpu,
    pub views: Views,
    pub extent: [u32; 2],
    pub inset: Option<[u32; 2]>,
    pub name: String,
    pub blend: xr::EnvironmentBlendMode,
    pub masks: [Mask; 2],
    /// The display's rates, Hz; empty without a choice.
    pub rates: Vec<f32>,
    /// The last state that the runtime reported.
    pub state: SessionState,
    /// Whether it is between xrBeginSession and xrEndSession.
    pub running: bool,
    /// Whether the runtime wants the session to end.
    pub ended: bool,
    /// Whether somebody wears the headset, as far as is known.
    pub present: bool,
    /// The time from which on the stage will have moved.
    pub moves_at: Option<xr::Time>,
    /// Whether the head has been located in this session.
    pub seen: bool,
    /// Whether the head's position has been known in this session, and is not known in this frame.
    pub placed: bool,
    pub lost: bool,
    /// Frames in which only its orientation was known.
    pub turning: u32,
    /// Index of the first combination of extras that is tried for a frame (`layers`).
    pub rung: usize,
    /// Calls that were refused.
    pub refusals: Refusals,
    /// A frame that was waited for and has not begun.
    waited: Option<Begun>,
    pub begun: Option<Begun>,
}

impl Live {
    /// Makes everything from the instance on, or nothing.
    pub(super) fn start(entry: &xr::Entry, options: &OpenXrOptions) -> Result<Self, CallFailure> {
        let instance = system::instance(entry, options.gaze, options.inset)?;
        let mut headset = system::headset(&instance, options.inset)?;
        let system = headset.system;
        let gpu = Gpu::open(&mut Runtime::new(&instance, system, options), &options.gpu)?;
        let handles = gpu.handles();
        let binding = xr::vulkan::SessionCreateInfo {
            instance: handles.instance.as_raw() as _,
            physical_device: handles.physical.as_raw() as _,
            device: handles.device.as_raw() as _,
            queue_family_index: handles.family,
            queue_index: handles.queue_index,
        };
        // SAFETY: instance, device and queue were made through this runtime and live as long as
        // the session, which holds `gpu`; where a call may use the queue, it is locked.
        let created = gpu.with_queue(QueueKind::Main, |_| unsafe {
            instance.create_session_with_guard::<xr::Vulkan>(
                system,
                &binding,
                Box::new(gpu.clone()),
            )
        });
        let (session, waiter, stream) = created.map_err(failed("xrCreateSession"))?;
        let stage = Stage::new(&session)?;
        let head = session
            .create_reference_space(xr::ReferenceSpaceType::VIEW, xr::Posef::IDENTITY)
            .map_err(failed("xrCreateReferenceSpace"))?;
        let actions = Actions::new(&instance, &session)?;
        let images = match Images::new(&gpu, &session, &headset, options) {
            Err(refusal) if headset.inset.is_some() => {
                refusal.do_without(system::INSET, ())?;
                headset = system::headset(&instance, false)?;
                Images::new(&gpu, &session, &headset, options)?
            }
            images => images?,
        };
        let ConnectedHeadset {
            views,
            extent,
            inset,
            blend,
            ..
        } = headset;
        let rates = choose_rate(&session);
        let runtime = instance
            .properties()
            .map_err(failed("xrGetInstanceProperties"))?;
        let name = format!(
            "{} {}, {}",
            runtime.runtime_name,
            runtime.runtime_version,
            gpu.info().name
        );
        tracing::info!(name, ?extent, ?inset, ?views, stage = ?stage.kind, "headset");
        Ok(Self {
            masks: Mask::of_eyes(&session, views),
            rates,
            stream,
            waiter,
            images,
            head,
            gaze: views.gaze(&session),
            stage,
            actions,
            session,
            instance,
            gpu,
            views,
            extent,
            inset,
            name,
            blend,
            state: SessionState::Unknown,
            running: false,
            ended: false,
            present: true,
            moves_at: None,
            seen: false,
            placed: false,
            lost: false,
            turning: 0,
            rung: 0,
            refusals: Refusals::default(),
            waited: None,
            begun: None,
        })
    }

    /// Waits for the next frame and begins it.
    pub(super) fn begin(&mut self) -> Result<Begun, CallFailure> {
        // A frame that was waited for and has not begun comes first: the runtime gives no other before.
        let frame = match self.waited {
            Some(frame) => frame,
            None => {
                let state = self.waiter.wait().map_err(failed("xrWaitFrame"))?;
                let frame = Begun {
                    time: state.predicted_display_time,
                    period: state.predicted_display_period,
                    should_render: state.should_render,
                };
                *self.waited.insert(frame)
            }
        };
        self.gpu
            .with_queue(QueueKind::Main, |_| self.stream.begin())
            .map_err(failed("xrBeginFrame"))?;
        self.waited = None;
        self.begun = Some(frame);
        Ok(frame)
    }

    /// Ends the frame, if one has begun, with nothing to show.
    pub(super) fn end_empty(&mut self) -> Result<(), CallFailure> {
        let Some(begun) = self.begun.take() else {
            return Ok(());
        };
        let released = self.images.release(&self.gpu, false);
        self.end_with_nothing(begun)?;
        released
    }

    pub(super) fn end_with_nothing(&mut self, begun: Begun) -> Result<(), CallFailure> {
        let (stream, blend) = (&mut self.stream, self.blend);
        self.gpu
            .with_queue(QueueKind::Main, |_| stream.end(begun.time, blend, &[]))
            .map_err(failed("xrEndFrame"))
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        // Both fail on a lost session, where nothing is left to end.
        let _ = self.end_empty();
        // The swapchains' images go next.
        let _ = self.gpu.wait_idle();
    }
}

/// Asks for the rate next to [`RATE`], where there is a choice and the display is slower; a refusal leaves it as it is. Returns the rates
/// that there are.
fn choose_rate(session: &xr::Session<xr::Vulkan>) -> Vec<f32> {
    if session.instance().exts().fb_display_refresh_rate.is_none() {
        return Vec::new();
    }
    let rates = session
        .enumerate_display_refresh_rates()
        .unwrap_or_default();
    let now = session.get_display_refresh_rate().unwrap_or_default();
    let best = rates
        .iter()
        .copied()
        .min_by(|a, b| (a - RATE).abs().total_cmp(&(b - RATE).abs()));
    if let Some(best) = best.filter(|best| *best > now)
        && let Err(answer) = session.request_display_refresh_rate(best)
    {
        tracing::warn!(best, %answer, "display rate refused");
    }
    rates
}
