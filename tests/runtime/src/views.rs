//! View configurations: both eyes, or both and an inset in each (XR_VARJO_quad_views, XR_VARJO_foveated_rendering).

use openxr::sys;
use serde_json::json;
use sys::{Handle as _, Result as R, ViewConfigurationType};

use crate::abi::{Buffer, chained, fill, fill_with, given};
use crate::instance::LARGEST;
use crate::script::{Fov, Known, Pose};
use crate::state::{State, call, told};

const STEREO: ViewConfigurationType = ViewConfigurationType::PRIMARY_STEREO;
const QUAD: ViewConfigurationType = ViewConfigurationType::PRIMARY_QUAD_VARJO;
/// The extension of the inset, and the one by which it follows the gaze.
const INSET: &str = "XR_VARJO_quad_views";
pub(crate) const FOLLOWS: &str = "XR_VARJO_foveated_rendering";

impl State {
    /// Number of views of that configuration, where the instance offers it.
    pub(crate) fn instance_offers(
        &mut self,
        instance: sys::Instance,
        views: ViewConfigurationType,
    ) -> Result<usize, R> {
        let inset = self.instance(instance)?.extensions.iter();
        let inset = inset.into_iter().any(|name| name == INSET);
        match views {
            STEREO => Ok(2),
            QUAD if inset => Ok(self.world.inset.views as usize),
            _ => Err(R::ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED),
        }
    }

    /// Number of views of that configuration, where the instance of the session offers it.
    pub(crate) fn session_offers(
        &mut self,
        session: sys::Session,
        views: ViewConfigurationType,
    ) -> Result<usize, R> {
        let instance = self.session(session)?.instance;
        self.instance_offers(sys::Instance::from_raw(instance), views)
    }

    /// Number of views of a frame of the session.
    pub(crate) fn views_of(&mut self, session: sys::Session) -> Result<usize, R> {
        let views = self.session(session)?.views;
        self.session_offers(session, views)
    }

    /// Field of view of an eye's inset, about the gaze where it follows that and the gaze is known.
    fn inset(&self, follows: bool) -> Fov {
        let gaze = self.world.gaze.filter(|_| follows);
        let towards = gaze.map_or(glam::Vec3::NEG_Z, |gaze| {
            let seen = self.world.head.0.inverse().compose(&gaze);
            seen.orientation * glam::Vec3::NEG_Z
        });
        let [aside, above] = [towards.x, towards.y].map(|it| (it / -towards.z).atan());
        let half = self.world.inset.half;
        Fov {
            left: aside - half,
            right: aside + half,
            up: above + 0.75 * half,
            down: above - 0.75 * half,
        }
    }
}

pub(crate) extern "system" fn enumerate_view_configurations(
    instance: sys::Instance,
    system: sys::SystemId,
    capacity: u32,
    count: Option<&mut u32>,
    kinds: Buffer<ViewConfigurationType>,
) -> R {
    call("xrEnumerateViewConfigurations", |state| {
        state.system(instance, system)?;
        let mut offered = vec![QUAD, STEREO];
        offered.retain(|views| state.instance_offers(instance, *views).is_ok());
        fill_with(capacity, count, &kinds, &offered)
    })
}

pub(crate) extern "system" fn get_view_configuration_properties(
    instance: sys::Instance,
    system: sys::SystemId,
    views: ViewConfigurationType,
    properties: Option<&mut sys::ViewConfigurationProperties>,
) -> R {
    call("xrGetViewConfigurationProperties", |state| {
        state.system(instance, system)?;
        state.instance_offers(instance, views)?;
        let properties = given!(properties, sys::ViewConfigurationProperties);
        properties.view_configuration_type = views;
        properties.fov_mutable = sys::TRUE;
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn enumerate_view_configuration_views(
    instance: sys::Instance,
    system: sys::SystemId,
    views: ViewConfigurationType,
    capacity: u32,
    count: Option<&mut u32>,
    eyes: Buffer<sys::ViewConfigurationView>,
) -> R {
    call("xrEnumerateViewConfigurationViews", |state| {
        state.system(instance, system)?;
        let wanted = state.instance_offers(instance, views)?;
        let follows = state.instance(instance)?.extensions.iter();
        let follows = follows.into_iter().any(|name| name == FOLLOWS);
        let (stereo, inset) = (state.world.extent, state.world.inset);
        fill(capacity, count, &eyes, wanted, |index, eye| {
            // SAFETY: OpenXR's callers chain structures that live through the call.
            let foveated: Option<&sys::FoveatedViewConfigurationViewVARJO> = unsafe {
                let ty = sys::FoveatedViewConfigurationViewVARJO::TYPE;
                chained(eye.next.cast_const(), ty)
            };
            let active = foveated.is_some_and(|it| it.foveated_rendering_active.into());
            let [width, height] = match (index < 2, follows && active) {
                (true, false) => stereo,
                (false, false) => inset.extent,
                (first, true) => inset.following[usize::from(!first)],
            };
            eye.recommended_image_rect_width = width;
            eye.max_image_rect_width = LARGEST;
            eye.recommended_image_rect_height = height;
            eye.max_image_rect_height = LARGEST;
            eye.recommended_swapchain_sample_count = 1;
            eye.max_swapchain_sample_count = 1;
        })
    })
}

pub(crate) extern "system" fn locate_views(
    session: sys::Session,
    info: Option<&sys::ViewLocateInfo>,
    flags: Option<&mut sys::ViewState>,
    capacity: u32,
    count: Option<&mut u32>,
    views: Buffer<sys::View>,
) -> R {
    // SAFETY: OpenXR's callers chain structures that live through the call.
    let foveated: Option<&sys::ViewLocateFoveatedRenderingVARJO> = info.and_then(|info| unsafe {
        chained(info.next, sys::ViewLocateFoveatedRenderingVARJO::TYPE)
    });
    let active = foveated.map(|it| bool::from(it.foveated_rendering_active));
    let locate = |state: &mut State| {
        let info = given!(info, sys::ViewLocateInfo);
        let flags = given!(flags, sys::ViewState);
        if state.session(session)?.views != info.view_configuration_type {
            return Err(R::ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
        }
        let wanted = state.views_of(session)?;
        let follows = active == Some(true) && state.session_has(session, FOLLOWS).is_ok();
        let inset = state.inset(follows);
        let there = state.world.head;
        let raw = session.into_raw();
        let (head, known) = state.seen_from(info.space, raw, info.display_time, there)?;
        let (ipd, eyes) = (state.world.ipd, state.world.fov);
        // The bits are the same.
        let shown = known.show(&head).0.into_raw();
        flags.view_state_flags = sys::ViewStateFlags::from_raw(shown);
        fill(capacity, count, &views, wanted, |index, view| {
            let fov = eyes.get(index).copied().unwrap_or(inset);
            put(view, &head, known, [-0.5, 0.5][index % 2] * ipd, fov);
        })
    };
    // Logged only where it carries this information, as there are several calls in a frame.
    match active {
        Some(active) => told("xrLocateViews", json!({ "follows": active }), |state, _| {
            locate(state)
        }),
        None => call("xrLocateViews", locate),
    }
}

/// Fills in a view `side` m to the right of the middle of the head.
fn put(view: &mut sys::View, head: &Pose, known: Known, side: f32, fov: Fov) {
    let eye = head.compose(&Pose::at(side, 0.0, 0.0));
    view.pose = known.show(&eye).1;
    view.fov = sys::Fovf {
        angle_left: fov.left,
        angle_right: fov.right,
        angle_up: fov.up,
        angle_down: fov.down,
    };
}
