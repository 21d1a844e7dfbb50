//! The arguments of a frame's end: read, and checked as a strict runtime does.

use openxr::sys;
use sys::{Handle as _, Result as R};

use crate::abi::{chained, list};
use crate::calls::{Depth, Ended, Layer, Part, ProjectionView};
use crate::instance::LAYERS;
use crate::pictures::is_depth;
use crate::script::{Fov, Pose};
use crate::state::State;

/// Reads the caller's arguments.
pub(crate) fn read(state: &State, info: &sys::FrameEndInfo) -> Ended {
    // SAFETY: OpenXR's callers pass an array of so many pointers.
    let layers: &[Option<&sys::CompositionLayerBaseHeader>] =
        unsafe { list(info.layer_count, info.layers.cast()) }.unwrap_or_default();
    Ended {
        time: info.display_time.as_nanos(),
        blend: info.environment_blend_mode.into_raw(),
        layers: layers.iter().map(|header| layer(state, *header)).collect(),
    }
}

fn layer(state: &State, header: Option<&sys::CompositionLayerBaseHeader>) -> Layer {
    let Some(header) = header else {
        return Layer::Other { kind: 0 };
    };
    let space = state.spaces.get(&header.space.into_raw());
    let space = space.map(|space| space.kind());
    let flags = header.layer_flags.into_raw();
    let whole = std::ptr::from_ref(header);
    if header.ty == sys::CompositionLayerProjection::TYPE {
        // SAFETY: by its type it is this structure, with an array of so many views.
        let views = unsafe {
            let whole = &*whole.cast::<sys::CompositionLayerProjection>();
            list(whole.view_count, whole.views)
        };
        let views = views.unwrap_or_default().iter().map(view).collect();
        Layer::Projection {
            space,
            flags,
            views,
        }
    } else if header.ty == sys::CompositionLayerQuad::TYPE {
        // SAFETY: by its type it is this structure.
        let quad = unsafe { &*whole.cast::<sys::CompositionLayerQuad>() };
        Layer::Quad {
            space,
            flags,
            eyes: quad.eye_visibility.into_raw(),
            image: part(&quad.sub_image),
            pose: Pose::read(&quad.pose),
            size: [quad.size.width, quad.size.height],
        }
    } else {
        Layer::Other {
            kind: header.ty.into_raw(),
        }
    }
}

fn view(view: &sys::CompositionLayerProjectionView) -> ProjectionView {
    // SAFETY: OpenXR's callers chain structures that live through the call.
    let depth: Option<&sys::CompositionLayerDepthInfoKHR> =
        unsafe { chained(view.next, sys::CompositionLayerDepthInfoKHR::TYPE) };
    ProjectionView {
        pose: Pose::read(&view.pose),
        fov: Fov {
            left: view.fov.angle_left,
            right: view.fov.angle_right,
            up: view.fov.angle_up,
            down: view.fov.angle_down,
        },
        image: part(&view.sub_image),
        depth: depth.map(|depth| Depth {
            image: part(&depth.sub_image),
            min: depth.min_depth,
            max: depth.max_depth,
            near: depth.near_z,
            far: depth.far_z,
        }),
    }
}

fn part(image: &sys::SwapchainSubImage) -> Part {
    let sys::Rect2Di { offset, extent } = image.image_rect;
    Part {
        swapchain: image.swapchain.into_raw(),
        rect: [offset.x, offset.y, extent.width, extent.height],
        layer: image.image_array_index,
    }
}

/// Properties of a frame on which a refusal can depend.
pub(crate) fn facts(ended: &Ended) -> Vec<String> {
    let mut facts = Vec::new();
    for layer in &ended.layers {
        let views = match layer {
            Layer::Projection { views, .. } => {
                facts.push("projection".to_owned());
                facts.push(format!("{} views", views.len()));
                views
            }
            Layer::Quad { .. } => {
                facts.push("quad".to_owned());
                continue;
            }
            Layer::Other { .. } => continue,
        };
        for depth in views.iter().filter_map(|view| view.depth) {
            facts.push("depth".to_owned());
            if depth.near.is_infinite() || depth.far.is_infinite() {
                facts.push("infinite depth".to_owned());
            }
        }
    }
    facts
}

/// Checks that the frame can be shown.
pub(crate) fn check(state: &mut State, session: sys::Session, ended: &Ended) -> Result<(), R> {
    if !state.world.blends.contains(&ended.blend) {
        return Err(R::ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
    }
    if ended.layers.len() > LAYERS as usize {
        return Err(R::ERROR_LAYER_LIMIT_EXCEEDED);
    }
    let depth_on = state
        .session_has(session, "XR_KHR_composition_layer_depth")
        .is_ok();
    let wanted = state.views_of(session)?;
    for layer in &ended.layers {
        match layer {
            Layer::Projection { space, views, .. } => {
                space.ok_or(R::ERROR_HANDLE_INVALID)?;
                if views.len() != wanted {
                    return Err(R::ERROR_VALIDATION_FAILURE);
                }
                for view in views {
                    check_view(state, session, view, depth_on)?;
                }
            }
            Layer::Quad {
                space,
                image,
                pose,
                size,
                ..
            } => {
                space.ok_or(R::ERROR_HANDLE_INVALID)?;
                if !pose.is_proper() {
                    return Err(R::ERROR_POSE_INVALID);
                }
                if !size.iter().all(|side| side.is_finite() && *side > 0.0) {
                    return Err(R::ERROR_VALIDATION_FAILURE);
                }
                check_part(state, session, image, false)?;
            }
            Layer::Other { .. } => return Err(R::ERROR_LAYER_INVALID),
        }
    }
    Ok(())
}

fn check_view(
    state: &State,
    session: sys::Session,
    view: &ProjectionView,
    depth_on: bool,
) -> Result<(), R> {
    if !view.pose.is_proper() {
        return Err(R::ERROR_POSE_INVALID);
    }
    let Fov {
        left,
        right,
        up,
        down,
    } = view.fov;
    let ahead = |angle: f32| angle.abs() < std::f32::consts::FRAC_PI_2;
    if ![left, right, up, down].into_iter().all(ahead) || left == right || up == down {
        return Err(R::ERROR_VALIDATION_FAILURE);
    }
    check_part(state, session, &view.image, false)?;
    // A structure of an extension that is off is ignored.
    let Some(depth) = view.depth.filter(|_| depth_on) else {
        return Ok(());
    };
    let in_range = 0.0 <= depth.min && depth.min < depth.max && depth.max <= 1.0;
    let apart = depth.near >= 0.0 && depth.far >= 0.0 && depth.near != depth.far;
    if !in_range || !apart {
        return Err(R::ERROR_VALIDATION_FAILURE);
    }
    check_part(state, session, &depth.image, true)
}

fn check_part(state: &State, session: sys::Session, part: &Part, depth: bool) -> Result<(), R> {
    let chain = state.swapchains.get(&part.swapchain);
    let chain = chain.filter(|chain| chain.session == session.into_raw());
    let chain = chain.ok_or(R::ERROR_HANDLE_INVALID)?;
    if !chain.released || is_depth(chain.format) != depth {
        return Err(R::ERROR_LAYER_INVALID);
    }
    if part.layer >= chain.layers {
        return Err(R::ERROR_VALIDATION_FAILURE);
    }
    let [x, y, width, height] = part.rect.map(i64::from);
    let [across, down] = chain.extent.map(i64::from);
    let inside =
        x >= 0 && y >= 0 && width > 0 && height > 0 && x + width <= across && y + height <= down;
    match inside {
        true => Ok(()),
        false => Err(R::ERROR_SWAPCHAIN_RECT_INVALID),
    }
}
