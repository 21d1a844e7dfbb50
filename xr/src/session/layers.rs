//! The end of a frame: what is shown, layer by layer.

use openxr as xr;
use vitriol_gpu::QueueKind;

use super::chain::Chain;
use super::convert::{CallFailure, failed, fovf, posef};
use super::live::{Begun, Live};
use super::stage::Stage;
use crate::{Pose, Shown, View};

impl Live {
    /// Gives the images back and shows them.
    pub(super) fn show(&mut self, begun: Begun, shown: &Shown) -> Result<(), CallFailure> {
        self.release()?;
        let depths = self.depth.as_ref().map(|depth| depths(depth, shown));
        let views = [0, 1].map(|eye| {
            let view = view(&self.colour, eye, shown);
            let Some(depths) = &depths else {
                return view;
            };
            let mut raw = view.into_raw();
            raw.next = std::ptr::from_ref(&depths[eye as usize]).cast();
            // SAFETY: what the builder had set stays as it is, and `depths` lives until the frame
            // has ended.
            unsafe { xr::CompositionLayerProjectionView::from_raw(raw) }
        });
        let world = xr::CompositionLayerProjection::new()
            .space(&self.stage.space)
            .views(&views);
        let panel = shown
            .panel
            .as_ref()
            .map(|(at, width)| quad(&self.stage, &self.panel, at, *width));
        let mut layers: Vec<&xr::CompositionLayerBase<'_, xr::Vulkan>> = vec![&world];
        if let Some(panel) = &panel {
            layers.push(panel);
        }
        let stream = &mut self.stream;
        self.gpu
            .with_queue(QueueKind::Main, |_| {
                stream.end(begun.time, self.blend, &layers)
            })
            .map_err(failed("xrEndFrame"))
    }
}

fn quad<'a>(
    stage: &'a Stage,
    panel: &'a Chain,
    stage_from_panel: &Pose,
    width: f32,
) -> xr::CompositionLayerQuad<'a, xr::Vulkan> {
    let [across, down] = panel.extent();
    xr::CompositionLayerQuad::new()
        .layer_flags(xr::CompositionLayerFlags::BLEND_TEXTURE_SOURCE_ALPHA)
        .space(&stage.space)
        .eye_visibility(xr::EyeVisibility::BOTH)
        .sub_image(panel.part(0))
        .pose(posef(stage_from_panel))
        .size(xr::Extent2Df {
            width,
            height: width * down as f32 / across as f32,
        })
}

fn view<'a>(
    colour: &'a Chain,
    eye: u32,
    shown: &Shown,
) -> xr::CompositionLayerProjectionView<'a, xr::Vulkan> {
    let View {
        stage_from_eye,
        fov,
    } = &shown.views[eye as usize];
    xr::CompositionLayerProjectionView::new()
        .pose(posef(stage_from_eye))
        .fov(fovf(fov))
        .sub_image(colour.corner(eye, shown.extent))
}

/// Depth 1 at the near plane and 0 at infinity: the extension has the plane of the smaller depth
/// in `near_z` and lets it be the far one, and infinite (XR_KHR_composition_layer_depth).
fn depths(depth: &Chain, shown: &Shown) -> [xr::sys::CompositionLayerDepthInfoKHR; 2] {
    [0, 1].map(|eye| xr::sys::CompositionLayerDepthInfoKHR {
        ty: xr::sys::CompositionLayerDepthInfoKHR::TYPE,
        next: std::ptr::null(),
        sub_image: *depth.corner(eye, shown.extent).as_raw(),
        min_depth: 0.0,
        max_depth: 1.0,
        near_z: f32::INFINITY,
        far_z: shown.near,
    })
}
