//! Errors of drawing.

use vitriol_gpu::GpuError;
use vitriol_shaders::ShaderError;

/// Why a picture was not drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device or its memory failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A shader failed.
    #[error(transparent)]
    Shader(#[from] ShaderError),
    /// The renderer was asked for a number of views that it does not have.
    #[error("{views} views asked for; a renderer has one (a film) or two (a headset)")]
    ViewCount {
        /// Views asked for.
        views: u32,
    },
    /// A frame has another number of something than the scene or target.
    #[error("the frame has {given} {what}, the renderer {wanted}; give as many, in the same order")]
    Count {
        /// The quantity that was counted.
        what: &'static str,
        /// How many the frame has.
        given: usize,
        /// How many were set up.
        wanted: usize,
    },
    /// A frame's picture is larger than the renderer's images, or of no pixels.
    #[error(
        "a picture of {extent:?} pixels of a renderer of {held:?}; draw at most that, and at least one"
    )]
    Extent {
        /// Width and height that the frame asks for, pixels.
        extent: [u32; 2],
        /// Width and height of the renderer's images, pixels.
        held: [u32; 2],
    },
    /// The pictures have more pixels than a buffer of the device has numbers.
    #[error(
        "a picture of {}x{} pixels needs more than the {limit} bytes of a buffer on this device; ask for a smaller --size: the largest \
         of this shape is {}x{}",
        extent[0], extent[1], largest[0], largest[1]
    )]
    TooManyPixels {
        /// Width and height of a view, pixels.
        extent: [u32; 2],
        /// Bytes of one storage buffer binding.
        limit: u64,
        /// Largest width and height of a view in that shape, pixels.
        largest: [u32; 2],
    },
    /// Lanes were asked for that shader or device do not have.
    #[error(
        "{asked} lanes for a particle's {of}; take a power of two from {least} to {most}, or leave it to the program"
    )]
    Lanes {
        /// The particle's property whose work they share.
        of: &'static str,
        /// Lanes asked for.
        asked: u32,
        /// Fewest lanes.
        least: u32,
        /// Most lanes on this device.
        most: u32,
    },
    /// A scene has more vessels than a picture.
    #[error("{given} vessels; a picture has at most {most}: leave some out, or draw none")]
    TooManyVessels {
        /// How many the scene has.
        given: usize,
        /// How many there may be.
        most: usize,
    },
    /// A hand has more bones than a picture.
    #[error("a hand of {given} bones; a picture has at most {most}: leave some out")]
    TooManyBones {
        /// How many the hand has.
        given: usize,
        /// How many there may be.
        most: usize,
    },
    /// A liquid surface was asked of a renderer that was made without one.
    #[error("this renderer has no liquid surface; make it with RenderDesc::liquid")]
    NoLiquid,
    /// A foveated frame was asked of a renderer that was made without.
    #[error("this renderer draws no foveated frames; make it with RenderDesc::foveated")]
    NotFoveated,
    /// More particles than the buffers hold.
    #[error("{count} particles asked for, but \"{buffer}\" holds {held}; pass the solver's count")]
    TooManyParticles {
        /// Particles asked for.
        count: u32,
        /// The shorter buffer's label.
        buffer: String,
        /// Particles that it holds.
        held: u64,
    },
}
