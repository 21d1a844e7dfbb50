//! One OpenXR session from its making to its loss: instance, device, swapchains, spaces, actions.

use openxr as xr;
use vitriol_gpu::ash::vk::Handle as _;
use vitriol_gpu::{Gpu, QueueKind, vk};

use super::actions::Actions;
use super::chain::Chain;
use super::convert::{CallFailure, failed};
use super::mask::Mask;
use super::options::OpenXrOptions;
use super::provider::Runtime;
use super::stage::Stage;
use super::system::{self, ConnectedHeadset};
use crate::{HeadsetError, SessionState, Targets};

/// The display rate that is asked for where the runtime offers a choice, Hz: the time of a step
/// and of a picture is laid out for it (docs/measurements/performance.md).
const RATE: f32 = 90.0;

/// The frame that has begun.
#[derive(Clone, Copy)]
pub(super) struct Begun {
    pub time: xr::Time,
    pub period: xr::Duration,
    pub should_render: bool,
}

/// A session. Its parts are dropped from top to bottom, each before what it is of; the device
/// outlives the session by the guard that the session holds.
pub(super) struct Live {
    pub stream: xr::FrameStream<xr::Vulkan>,
    pub waiter: xr::FrameWaiter,
    pub colour: Chain,
    pub depth: Option<Chain>,
    pub panel: Chain,
    pub head: xr::Space,
    pub stage: Stage,
    pub actions: Actions,
    pub session: xr::Session<xr::Vulkan>,
    pub instance: xr::Instance,
    pub gpu: Gpu,
    pub extent: [u32; 2],
    pub name: String,
    pub blend: xr::EnvironmentBlendMode,
    pub masks: [Mask; 2],
    /// Runtime's last word on the session.
    pub state: SessionState,
    /// Between xrBeginSession and xrEndSession.
    pub running: bool,
    /// The runtime wants the session to go.
    pub ended: bool,
    /// Someone wears the headset, as far as is known.
    pub present: bool,
    /// When the stage will have moved.
    pub moves_at: Option<xr::Time>,
    pub begun: Option<Begun>,
}

impl Live {
    /// Everything from the instance on, or nothing.
    pub(super) fn start(entry: &xr::Entry, options: &OpenXrOptions) -> Result<Self, CallFailure> {
        let instance = system::instance(entry)?;
        let ConnectedHeadset {
            system,
            extent,
            blend,
        } = system::headset(&instance)?;
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
        let formats = session
            .enumerate_swapchain_formats()
            .map_err(failed("xrEnumerateSwapchainFormats"))?;
        let offered = |format: vk::Format| formats.contains(&(format.as_raw() as u32));
        let srgb = vk::Format::R8G8B8A8_SRGB;
        if !offered(srgb) {
            return Err(CallFailure::Fatal(HeadsetError::Refused {
                call: "xrCreateSwapchain",
                cause: "it has no images in 8-bit RGBA, sRGB".to_owned(),
            }));
        }
        let d32 = vk::Format::D32_SFLOAT;
        let takes_depth = instance.exts().khr_composition_layer_depth.is_some() && offered(d32);
        let chain = |label, extent, layers, format| {
            Chain::new(&gpu, &session, label, extent, layers, format)
        };
        let colour = chain("headset", extent, 2, srgb)?;
        let depth = match takes_depth {
            true => Some(chain("headset's depth", extent, 2, d32)?),
            false => None,
        };
        let panel = chain("panel", options.panel, 1, srgb)?;
        choose_rate(&session);
        let runtime = instance
            .properties()
            .map_err(failed("xrGetInstanceProperties"))?;
        let name = format!(
            "{} {}, {}",
            runtime.runtime_name,
            runtime.runtime_version,
            gpu.info().name
        );
        tracing::info!(name, ?extent, stage = ?stage.kind, "headset");
        Ok(Self {
            masks: [Mask::of(&session, 0), Mask::of(&session, 1)],
            stream,
            waiter,
            colour,
            depth,
            panel,
            head,
            stage,
            actions,
            session,
            instance,
            gpu,
            extent,
            name,
            blend,
            state: SessionState::Unknown,
            running: false,
            ended: false,
            present: true,
            moves_at: None,
            begun: None,
        })
    }

    /// Waits for the next frame and begins it.
    pub(super) fn begin(&mut self) -> Result<Begun, CallFailure> {
        let state = self.waiter.wait().map_err(failed("xrWaitFrame"))?;
        let begun = Begun {
            time: state.predicted_display_time,
            period: state.predicted_display_period,
            should_render: state.should_render,
        };
        self.gpu
            .with_queue(QueueKind::Main, |_| self.stream.begin())
            .map_err(failed("xrBeginFrame"))?;
        self.begun = Some(begun);
        Ok(begun)
    }

    /// Ends the frame, if one has begun, with nothing to show.
    pub(super) fn end_empty(&mut self) -> Result<(), CallFailure> {
        let Some(begun) = self.begun.take() else {
            return Ok(());
        };
        self.release()?;
        self.gpu
            .with_queue(QueueKind::Main, |_| {
                self.stream.end(begun.time, self.blend, &[])
            })
            .map_err(failed("xrEndFrame"))
    }

    /// The frame's images, when the compositor has let go of them.
    pub(super) fn acquire(&mut self) -> Result<Targets, CallFailure> {
        Ok(Targets {
            colour: self.colour.acquire(&self.gpu)?,
            depth: match &mut self.depth {
                Some(depth) => Some(depth.acquire(&self.gpu)?),
                None => None,
            },
            panel: self.panel.acquire(&self.gpu)?,
        })
    }

    /// Images of the right size that are not the compositor's: for a frame whose session is lost.
    pub(super) fn stale(&self) -> Targets {
        Targets {
            colour: self.colour.stale(),
            depth: self.depth.as_ref().map(Chain::stale),
            panel: self.panel.stale(),
        }
    }

    /// Gives all images back.
    pub(super) fn release(&mut self) -> Result<(), CallFailure> {
        self.colour.release(&self.gpu)?;
        if let Some(depth) = &mut self.depth {
            depth.release(&self.gpu)?;
        }
        self.panel.release(&self.gpu)
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        // Both fail on a session that is lost, where nothing is left to be ended.
        let _ = self.end_empty();
        // The swapchains' images go next.
        let _ = self.gpu.wait_idle();
    }
}

/// Asks for the rate next to [`RATE`], where there is a choice; a refusal leaves it as it is.
fn choose_rate(session: &xr::Session<xr::Vulkan>) {
    if session.instance().exts().fb_display_refresh_rate.is_none() {
        return;
    }
    let rates = session
        .enumerate_display_refresh_rates()
        .unwrap_or_default();
    let best = rates
        .into_iter()
        .min_by(|a, b| (a - RATE).abs().total_cmp(&(b - RATE).abs()));
    if let Some(best) = best
        && let Err(answer) = session.request_display_refresh_rate(best)
    {
        tracing::warn!(best, %answer, "display rate refused");
    }
}
