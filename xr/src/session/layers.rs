//! The end of a frame: its composition layers.
//!
//! The panel has a layer of its own under the picture, and the picture's alpha is 0 where the panel is seen with nothing before it. So its
//! text is sampled once, from its own pixels, however coarse the picture is at the time, and a hand before it is seen before it. A layer
//! over the picture would cover the hand. The picture has the panel as well: where a runtime refuses such a layer the picture is shown
//! without alpha, and the mirror shows it. Nothing is multiplied with alpha beforehand.

use openxr as xr;
use vitriol_gpu::QueueKind;

use super::chain::Chain;
use super::convert::{CallFailure, failed, fovf, posef};
use super::images::{EyeImages, Pair};
use super::live::{Begun, Live};
use super::stage::Stage;
use crate::{HeadsetError, Pose, Shown, View, depth_extent};

/// Distance at which depth ends for a runtime that refuses an infinite range, m. Depths that were drawn for an infinite one then have a
/// relative error of distance over this.
const FAR: f32 = 1e5;

/// Parts of a frame beside the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Extras {
    depth: DepthRange,
    panel: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DepthRange {
    Infinite,
    Finite,
    None,
}

/// Combinations to try, the best first.
const ALL: [Extras; 6] = {
    const fn with(depth: DepthRange, panel: bool) -> Extras {
        Extras { depth, panel }
    }
    [
        with(DepthRange::Infinite, true),
        with(DepthRange::Finite, true),
        with(DepthRange::None, true),
        with(DepthRange::Infinite, false),
        with(DepthRange::Finite, false),
        with(DepthRange::None, false),
    ]
};

impl Live {
    /// Gives the images back and shows them. If the runtime refuses the frame and accepts it without some extras, these are left out from
    /// then on; if it accepts none, the frame ends empty.
    pub(super) fn show(&mut self, begun: Begun, shown: &Shown) -> Result<(), CallFailure> {
        if self.images.inset.is_some() && shown.inset.is_none() {
            // The runtime requires the inset's picture. It is not called, as its refusal would be the program's fault.
            self.begun = Some(begun);
            self.end_empty()?;
            return Err(CallFailure::Fatal(HeadsetError::NoInset));
        }
        let released = self.images.release(&self.gpu, true);
        if let Err(failure) = released {
            self.end_with_nothing(begun)?;
            return Err(failure);
        }
        let mut refusal = None;
        for (rung, extras) in ALL.iter().enumerate().skip(self.rung) {
            match self.end_with(begun, shown, *extras) {
                Err(CallFailure::Fatal(HeadsetError::Refused { call, cause })) => {
                    refusal = Some(HeadsetError::Refused { call, cause });
                }
                ended => {
                    if let (Ok(()), Some(refusal)) = (&ended, refusal) {
                        tracing::warn!("{refusal}; it takes a frame with {extras:?}");
                        self.rung = rung;
                    }
                    return ended;
                }
            }
        }
        self.end_with_nothing(begun)?;
        refusal.map_or(Ok(()), |refusal| Err(CallFailure::Fatal(refusal)))
    }

    fn end_with(&mut self, begun: Begun, shown: &Shown, extras: Extras) -> Result<(), CallFailure> {
        let images = &self.images;
        let eyes = (&images.eyes, shown.views, shown.extent);
        let inset = images.inset.as_ref().zip(shown.inset);
        let inset = inset.map(|(pair, inset)| (pair, inset.views, inset.extent));
        let ends = match extras.depth {
            DepthRange::Infinite => Some(f32::INFINITY),
            DepthRange::Finite => Some(FAR),
            DepthRange::None => None,
        };
        // The eyes' parts, then the inset's, as they were located.
        let all: Vec<Part<'_>> = [Some(eyes), inset].into_iter().flatten().collect();
        let depths: Vec<_> = all
            .iter()
            .map(|(pair, _, extent)| {
                let depth = pair.depth.as_ref().zip(ends);
                depth.map(|(depth, far)| depths(depth, *extent, shown.near, far))
            })
            .collect();
        let views: Vec<_> = all
            .iter()
            .zip(&depths)
            .flat_map(|(part, depths)| [0, 1].map(|eye| (eye, part, depths)))
            .map(|(eye, part, depths)| {
                let view = view(part, eye);
                let Some(depths) = depths else {
                    return view;
                };
                let mut raw = view.into_raw();
                raw.next = std::ptr::from_ref(&depths[eye]).cast();
                // SAFETY: what the builder had set stays as it is, and `depths` lives, and stays where it is, until the
                // frame has ended.
                unsafe { xr::CompositionLayerProjectionView::from_raw(raw) }
            })
            .collect();
        // A swapchain whose image was never released has nothing to show.
        let panel = shown
            .panel
            .filter(|_| extras.panel && images.panel.has_shown());
        let panel = panel.map(|(at, width)| quad(&self.stage, &images.panel, &at, width));
        let flags = match panel {
            Some(_) => {
                xr::CompositionLayerFlags::BLEND_TEXTURE_SOURCE_ALPHA
                    | xr::CompositionLayerFlags::UNPREMULTIPLIED_ALPHA
            }
            None => xr::CompositionLayerFlags::EMPTY,
        };
        let world = xr::CompositionLayerProjection::new()
            .layer_flags(flags)
            .space(&self.stage.space)
            .views(&views);
        let mut layers: Vec<&xr::CompositionLayerBase<'_, xr::Vulkan>> = vec![&world];
        if let Some(panel) = &panel {
            layers.insert(0, panel);
        }
        let (stream, blend) = (&mut self.stream, self.blend);
        self.gpu
            .with_queue(QueueKind::Main, |_| stream.end(begun.time, blend, &layers))
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
        .space(&stage.space)
        .eye_visibility(xr::EyeVisibility::BOTH)
        .sub_image(panel.part(0))
        .pose(posef(stage_from_panel))
        .size(xr::Extent2Df {
            width,
            height: width * down as f32 / across as f32,
        })
}

/// Pictures of both eyes, with the views, and the width and height, with which they were drawn.
type Part<'a> = (&'a Pair, [View; 2], [u32; 2]);

fn view<'a>(
    (pair, views, extent): &Part<'a>,
    eye: usize,
) -> xr::CompositionLayerProjectionView<'a, xr::Vulkan> {
    let View {
        stage_from_eye,
        fov,
    } = &views[eye];
    xr::CompositionLayerProjectionView::new()
        .pose(posef(stage_from_eye))
        .fov(fovf(fov))
        .sub_image(pair.colour.corner(eye as u32, *extent))
}

/// Depth 1 at the near plane and 0 at `far`: the extension has the plane of the smaller depth
/// in `near_z` and lets it be the far one, and infinite (XR_KHR_composition_layer_depth).
fn depths(
    depth: &EyeImages,
    extent: [u32; 2],
    near: f32,
    far: f32,
) -> [xr::sys::CompositionLayerDepthInfoKHR; 2] {
    [0, 1].map(|eye| xr::sys::CompositionLayerDepthInfoKHR {
        ty: xr::sys::CompositionLayerDepthInfoKHR::TYPE,
        next: std::ptr::null(),
        sub_image: *depth.corner(eye, depth_extent(extent)).as_raw(),
        min_depth: 0.0,
        max_depth: 1.0,
        near_z: far,
        far_z: near,
    })
}
