//! Which views a session has: two, or two and an inset in each.
//!
//! The inset is the runtime's own foveation (XR_VARJO_quad_views, which later became OpenXR's own "stereo with foveated inset"). Where
//! XR_VARJO_foveated_rendering is offered too it follows the gaze, which the runtime has at first hand; otherwise, and while the gaze is
//! lost, it is where the runtime puts it.

use openxr as xr;
use xr::sys;

use super::convert::{CallFailure, failed, refused};

/// Views of a session with an inset: the left and the right eye's, then the left and the right inset.
const QUAD: usize = 4;

/// The views of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Views {
    /// The left and the right eye.
    Stereo,
    /// The left and the right eye, and an inset in each.
    Quad {
        /// Whether the inset follows the gaze.
        follows: bool,
    },
}

impl Views {
    /// The best that an instance's runtime offers; its extensions are on only where they are asked for.
    pub(super) fn offered(
        instance: &xr::Instance,
        system: xr::SystemId,
    ) -> Result<Self, CallFailure> {
        if instance.exts().varjo_quad_views.is_none() {
            return Ok(Self::Stereo);
        }
        let offered = instance
            .enumerate_view_configurations(system)
            .map_err(failed("xrEnumerateViewConfigurations"))?;
        let quad = Self::Quad {
            follows: follows(instance, system),
        };
        Ok(match offered.contains(&quad.kind()) {
            true => quad,
            false => Self::Stereo,
        })
    }

    /// The view configuration's type in OpenXR.
    pub(super) fn kind(self) -> xr::ViewConfigurationType {
        match self {
            Self::Stereo => xr::ViewConfigurationType::PRIMARY_STEREO,
            Self::Quad { .. } => xr::ViewConfigurationType::PRIMARY_STEREO_WITH_FOVEATED_INSET,
        }
    }

    /// Recommended width and height of both pictures of a pair, pixels, first of the eyes, then of the inset.
    pub(super) fn extents(
        self,
        instance: &xr::Instance,
        system: xr::SystemId,
    ) -> Result<([u32; 2], Option<[u32; 2]>), CallFailure> {
        let views = match self {
            Self::Quad { follows: true } => foveated_sizes(instance, system, self.kind()),
            _ => instance.enumerate_view_configuration_views(system, self.kind()),
        };
        let views = views.map_err(failed("xrEnumerateViewConfigurationViews"))?;
        let extents = match (self, &views[..]) {
            (Self::Stereo, [left, right]) => (common(left, right), None),
            (Self::Quad { .. }, [left, right, inner @ ..]) if views.len() == QUAD => {
                (common(left, right), Some(common(&inner[0], &inner[1])))
            }
            _ => return Err(wrong(self, format!("it has {} views", views.len()))),
        };
        if extents.0.contains(&0) || extents.1.is_some_and(|inset| inset.contains(&0)) {
            return Err(wrong(self, format!("its pictures are empty, {extents:?}")));
        }
        Ok(extents)
    }

    /// The space that shows whether the runtime has the gaze that the inset follows; `None` where the inset follows none, and where the
    /// runtime refuses the space.
    pub(super) fn gaze(self, session: &xr::Session<xr::Vulkan>) -> Option<xr::Space> {
        if self != (Self::Quad { follows: true }) {
            return None;
        }
        let kind = xr::ReferenceSpaceType::COMBINED_EYE_VARJO;
        let made = session.create_reference_space(kind, xr::Posef::IDENTITY);
        made.inspect_err(|answer| {
            tracing::warn!(%answer, "the runtime refuses the gaze's space; the inset does not follow the gaze");
        })
        .ok()
    }

    /// Locates all views in `space` at that time. The inset follows the `gaze` while that is tracked in the head's space.
    pub(super) fn locate(
        self,
        session: &xr::Session<xr::Vulkan>,
        space: &xr::Space,
        (gaze, head): (Option<&xr::Space>, &xr::Space),
        time: xr::Time,
    ) -> Result<(xr::ViewStateFlags, Vec<xr::View>), CallFailure> {
        let located = match self {
            Self::Quad { follows: true } => {
                let active = gaze.is_some_and(|gaze| is_tracked(gaze, head, time));
                locate_foveated(session, self.kind(), time, space, active)
            }
            _ => session.locate_views(self.kind(), time, space),
        };
        let (flags, found) = located.map_err(failed("xrLocateViews"))?;
        let wanted = match self {
            Self::Stereo => 2,
            Self::Quad { .. } => QUAD,
        };
        match found.len() < wanted {
            false => Ok((flags, found)),
            true => {
                let cause = format!("it gives {} views of {wanted}", found.len());
                Err(refused("xrLocateViews", cause))
            }
        }
    }
}

fn wrong(views: Views, cause: String) -> CallFailure {
    let cause = format!("{:?}: {cause}", views.kind());
    refused("xrEnumerateViewConfigurationViews", cause)
}

/// Both eyes have a layer of one image: as large as the larger one, within both limits.
fn common(left: &xr::ViewConfigurationView, right: &xr::ViewConfigurationView) -> [u32; 2] {
    let size = |a: u32, b: u32, limit_a: u32, limit_b: u32| a.max(b).min(limit_a).min(limit_b);
    [
        size(
            left.recommended_image_rect_width,
            right.recommended_image_rect_width,
            left.max_image_rect_width,
            right.max_image_rect_width,
        ),
        size(
            left.recommended_image_rect_height,
            right.recommended_image_rect_height,
            left.max_image_rect_height,
            right.max_image_rect_height,
        ),
    ]
}

/// Whether the headset supports an inset that follows the gaze.
fn follows(instance: &xr::Instance, system: xr::SystemId) -> bool {
    if instance.exts().varjo_foveated_rendering.is_none() {
        return false;
    }
    let mut foveated = sys::SystemFoveatedRenderingPropertiesVARJO {
        ty: sys::SystemFoveatedRenderingPropertiesVARJO::TYPE,
        next: std::ptr::null_mut(),
        supports_foveated_rendering: sys::FALSE,
    };
    let mut properties = sys::SystemProperties::out((&raw mut foveated).cast());
    // SAFETY: instance and system are the runtime's. It fills the properties and what is chained to them, which is
    // the structure of an extension that is on, and lives through the call.
    let answer = unsafe {
        (instance.fp().get_system_properties)(instance.as_raw(), system, properties.as_mut_ptr())
    };
    answer.into_raw() >= 0 && foveated.supports_foveated_rendering.into()
}

/// [`xr::Instance::enumerate_view_configuration_views`] with the sizes for an inset that follows the gaze.
fn foveated_sizes(
    instance: &xr::Instance,
    system: xr::SystemId,
    kind: xr::ViewConfigurationType,
) -> xr::Result<Vec<xr::ViewConfigurationView>> {
    let active = sys::FoveatedViewConfigurationViewVARJO {
        ty: sys::FoveatedViewConfigurationViewVARJO::TYPE,
        next: std::ptr::null_mut(),
        foveated_rendering_active: sys::TRUE,
    };
    let mut chained = [active; QUAD];
    let mut views = chained.each_mut().map(|active| sys::ViewConfigurationView {
        ty: sys::ViewConfigurationView::TYPE,
        next: std::ptr::from_mut(active).cast(),
        recommended_image_rect_width: 0,
        max_image_rect_width: 0,
        recommended_image_rect_height: 0,
        max_image_rect_height: 0,
        recommended_swapchain_sample_count: 0,
        max_swapchain_sample_count: 0,
    });
    let mut count = 0;
    // SAFETY: instance and system are the runtime's, and there is room for as many views as are stated. Each has a structure of its own
    // chained to it, of an extension that is on, which lives through the call.
    let answer = unsafe {
        (instance.fp().enumerate_view_configuration_views)(
            instance.as_raw(),
            system,
            kind,
            QUAD as u32,
            &mut count,
            views.as_mut_ptr(),
        )
    };
    if answer.into_raw() < 0 {
        return Err(answer);
    }
    let views = views.iter().take(count as usize);
    Ok(views
        .map(|view| xr::ViewConfigurationView {
            recommended_image_rect_width: view.recommended_image_rect_width,
            max_image_rect_width: view.max_image_rect_width,
            recommended_image_rect_height: view.recommended_image_rect_height,
            max_image_rect_height: view.max_image_rect_height,
            recommended_swapchain_sample_count: view.recommended_swapchain_sample_count,
            max_swapchain_sample_count: view.max_swapchain_sample_count,
        })
        .collect())
}

/// Whether the runtime has the gaze at that time, by the rule of XR_VARJO_foveated_rendering. A runtime that refuses the query has not.
fn is_tracked(gaze: &xr::Space, head: &xr::Space, time: xr::Time) -> bool {
    gaze.locate(head, time).is_ok_and(|found| {
        found
            .location_flags
            .contains(xr::SpaceLocationFlags::ORIENTATION_TRACKED)
    })
}

/// [`xr::Session::locate_views`] with an inset that follows the gaze while that is `active`.
///
/// Pictures have the sizes of the active state at all times, since swapchains keep theirs: while the gaze is lost the inset, which
/// is wider then, has fewer pixels for each degree.
fn locate_foveated(
    session: &xr::Session<xr::Vulkan>,
    kind: xr::ViewConfigurationType,
    time: xr::Time,
    space: &xr::Space,
    active: bool,
) -> xr::Result<(xr::ViewStateFlags, Vec<xr::View>)> {
    let active = sys::ViewLocateFoveatedRenderingVARJO {
        ty: sys::ViewLocateFoveatedRenderingVARJO::TYPE,
        next: std::ptr::null(),
        foveated_rendering_active: active.into(),
    };
    let info = sys::ViewLocateInfo {
        ty: sys::ViewLocateInfo::TYPE,
        next: (&raw const active).cast(),
        view_configuration_type: kind,
        display_time: time,
        space: space.as_raw(),
    };
    let mut state = sys::ViewState {
        ty: sys::ViewState::TYPE,
        next: std::ptr::null_mut(),
        view_state_flags: xr::ViewStateFlags::EMPTY,
    };
    let mut views = [sys::View {
        ty: sys::View::TYPE,
        next: std::ptr::null_mut(),
        pose: xr::Posef::IDENTITY,
        fov: xr::Fovf::default(),
    }; QUAD];
    let mut count = 0;
    // SAFETY: session and space are the runtime's, the chained structure is of an extension that is on and lives through the call, and
    // there is room for as many views as are stated.
    let answer = unsafe {
        (session.instance().fp().locate_views)(
            session.as_raw(),
            &info,
            &mut state,
            QUAD as u32,
            &mut count,
            views.as_mut_ptr(),
        )
    };
    if answer.into_raw() < 0 {
        return Err(answer);
    }
    let found = views.iter().take(count as usize).map(|view| xr::View {
        pose: view.pose,
        fov: view.fov,
    });
    Ok((state.view_state_flags, found.collect()))
}
