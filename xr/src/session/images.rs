//! A session's swapchains: colour and depth of both eyes and of an inset, and the panel.

use openxr as xr;
use vitriol_gpu::{Gpu, Image, ImageDesc, QueueKind, vk};

use super::chain::Chain;
use super::convert::{CallFailure, failed, refused};
use super::options::OpenXrOptions;
use super::system::ConnectedHeadset;
use crate::{InsetTargets, Targets, depth_extent};

/// The swapchains of a session.
pub(super) struct Images {
    pub eyes: Pair,
    pub inset: Option<Pair>,
    pub panel: Chain,
}

/// Swapchains of a picture for each eye.
pub(super) struct Pair {
    pub colour: EyeImages,
    /// `None` where the runtime takes no depth.
    pub depth: Option<EyeImages>,
}

/// Images of both eyes.
pub(super) enum EyeImages {
    /// One swapchain with a layer for each.
    Array(Chain),
    /// A swapchain for each, where the runtime has none with layers. Pictures are copied to an image of our own, whose
    /// layers are copied to theirs when they are released.
    Each { array: Image, chains: [Chain; 2] },
}

impl Images {
    /// Creates the swapchains that the runtime supports, the best first; warns of those that it refuses and that can be done without.
    pub(super) fn new(
        gpu: &Gpu,
        session: &xr::Session<xr::Vulkan>,
        headset: &ConnectedHeadset,
        options: &OpenXrOptions,
    ) -> Result<Self, CallFailure> {
        let formats = session
            .enumerate_swapchain_formats()
            .map_err(failed("xrEnumerateSwapchainFormats"))?;
        let offered = |format: vk::Format| formats.contains(&(format.as_raw() as u32));
        let (srgb, d32) = (vk::Format::R8G8B8A8_SRGB, vk::Format::D32_SFLOAT);
        if !offered(srgb) {
            let cause = "it has no images in 8-bit RGBA, sRGB".to_owned();
            return Err(refused("xrCreateSwapchain", cause));
        }
        let exts = session.instance().exts();
        let takes_depth = exts.khr_composition_layer_depth.is_some() && offered(d32);
        let pair = |[label, of_depth]: [&'static str; 2], extent| {
            let colour = EyeImages::new(gpu, session, label, extent, srgb)?;
            let depth = match takes_depth {
                true => EyeImages::new(gpu, session, of_depth, depth_extent(extent), d32)
                    .map(Some)
                    .or_else(|failure| failure.do_without("depth in the headset's images", None))?,
                false => None,
            };
            Ok::<_, CallFailure>(Pair { colour, depth })
        };
        let inset = |extent| pair(["inset", "inset's depth"], extent);
        Ok(Self {
            eyes: pair(["headset", "headset's depth"], headset.extent)?,
            inset: headset.inset.map(inset).transpose()?,
            panel: Chain::new(gpu, session, "panel", options.panel, 1, srgb)?,
        })
    }

    /// Acquires the frame's images when the compositor has released them; the panel's only if it is to change.
    pub(super) fn acquire(&mut self, gpu: &Gpu, panel: bool) -> Result<Targets, CallFailure> {
        let (colour, depth) = self.eyes.acquire(gpu)?;
        let inset = self.inset.as_mut().map(|inset| inset.acquire(gpu));
        Ok(Targets {
            colour,
            depth,
            inset: inset
                .transpose()?
                .map(|(colour, depth)| InsetTargets { colour, depth }),
            panel: match panel {
                true => Some(self.panel.acquire(gpu)?),
                false => None,
            },
        })
    }

    /// Gives all images back, with their contents if they were `drawn`. If the runtime refuses one, the others are given back all the
    /// same: the frame shows none of them, and the next one acquires new ones.
    pub(super) fn release(&mut self, gpu: &Gpu, drawn: bool) -> Result<(), CallFailure> {
        let eyes = self.eyes.release(gpu, drawn);
        let inset = self.inset.as_mut();
        let inset = inset.map_or(Ok(()), |inset| inset.release(gpu, drawn));
        eyes.and(inset).and(self.panel.release(gpu))
    }
}

impl Pair {
    fn acquire(&mut self, gpu: &Gpu) -> Result<(Image, Option<Image>), CallFailure> {
        let colour = self.colour.acquire(gpu)?;
        let depth = self.depth.as_mut().map(|depth| depth.acquire(gpu));
        Ok((colour, depth.transpose()?))
    }

    fn release(&mut self, gpu: &Gpu, drawn: bool) -> Result<(), CallFailure> {
        let colour = self.colour.release(gpu, drawn);
        let depth = self.depth.as_mut();
        colour.and(depth.map_or(Ok(()), |depth| depth.release(gpu, drawn)))
    }
}

impl EyeImages {
    fn new(
        gpu: &Gpu,
        session: &xr::Session<xr::Vulkan>,
        label: &'static str,
        extent: [u32; 2],
        format: vk::Format,
    ) -> Result<Self, CallFailure> {
        let chain = |layers| Chain::new(gpu, session, label, extent, layers, format);
        let array = chain(2)
            .map(Some)
            .or_else(|failure| failure.do_without("swapchains with a layer for each eye", None))?;
        if let Some(array) = array {
            return Ok(Self::Array(array));
        }
        let chains = [chain(1)?, chain(1)?];
        let desc = ImageDesc {
            layers: 2,
            ..*chains[0].desc()
        };
        let array = Image::new(gpu, label, desc)?;
        Ok(Self::Each { array, chains })
    }

    /// An image with a layer for each eye.
    fn acquire(&mut self, gpu: &Gpu) -> Result<Image, CallFailure> {
        match self {
            Self::Array(chain) => chain.acquire(gpu),
            Self::Each { array, chains } => {
                for chain in chains {
                    chain.acquire(gpu)?;
                }
                Ok(array.clone())
            }
        }
    }

    fn release(&mut self, gpu: &Gpu, drawn: bool) -> Result<(), CallFailure> {
        match self {
            Self::Array(chain) => chain.release(gpu),
            Self::Each { array, chains } => {
                let [left, right] = chains;
                if let (true, Some(left), Some(right)) = (drawn, left.acquired(), right.acquired())
                {
                    let mut rec = gpu.recorder(QueueKind::Main)?;
                    rec.copy_layer(array, 0, left)?;
                    rec.copy_layer(array, 1, right)?;
                    gpu.submit(rec)?;
                }
                left.release(gpu).and(right.release(gpu))
            }
        }
    }

    /// The upper left corner of an eye's image, of `extent` pixels.
    pub(super) fn corner(
        &self,
        eye: u32,
        extent: [u32; 2],
    ) -> xr::SwapchainSubImage<'_, xr::Vulkan> {
        match self {
            Self::Array(chain) => chain.corner(eye, extent),
            Self::Each { chains, .. } => chains[eye as usize].corner(0, extent),
        }
    }
}
