//! The picture: particles, glass, bench and daylight, for one eye or two.
//!
//! A [`Renderer`] owns its images and pipelines and reads the solver's buffers
//! where they lie. One structure serves mono and stereo: the images have a
//! layer a view, each pass draws all of them, and mono is a view count of one.
//! Almost all of it is compute: there are GPUs with few units that rasterise.
//!
//! ```no_run
//! # use vitriol_render::*;
//! # fn film(gpu: &vitriol_gpu::Gpu, library: &vitriol_shaders::Library, scene: &SceneDesc,
//! #     frame: &FrameDesc) -> Result<Vec<u8>, RenderError> {
//! let mut renderer = Renderer::new(gpu, library, &RenderDesc::film([960, 540]))?;
//! renderer.set_scene(scene)?;
//! let mut rec = gpu.recorder(vitriol_gpu::QueueKind::Main)?;
//! renderer.record(&mut rec, frame)?;
//! let picture = renderer.read_back(&mut rec)?;
//! let ticket = gpu.submit(rec)?;
//! // Meanwhile the next frame is recorded and submitted.
//! ticket.wait()?;
//! picture.first_view()
//! # }
//! ```
//!
//! Liquid looks like liquid where a frame has [`FrameDesc::liquid`], and shows
//! its particles coloured by an attribute where it has
//! [`FrameDesc::particles`].

mod bone;
pub mod camera;
pub mod colour_map;
mod compute;
mod desc;
mod error;
mod fluid;
mod fovea;
mod frame;
mod half_depth;
mod hands;
mod hidden;
mod lanes;
mod light;
mod outline;
mod panel;
mod pass_pictures;
mod pipelines;
mod print;
mod readback;
pub mod reference;
mod renderer;
mod resting;
mod scene;
mod solids;
mod source;
mod spheres;
mod spray;
mod tiles;
pub mod tints;

pub use bone::{Bone, Finish, JOINED, MOST_BONES, Scale};
pub use camera::{Fov, View};
pub use colour_map::ColourMap;
pub use desc::{Lanes, LiquidDesc, RenderDesc, SurfaceFilter};
pub use error::RenderError;
pub use fluid::{Surface, SurfaceReadback};
pub use fovea::Foveation;
pub use frame::{ColourBy, FrameDesc};
pub use half_depth::HalfDepth;
pub use light::RoomLight;
pub use panel::{Pane, Panel};
pub use pass_pictures::{PassPicture, PassesReadback};
pub use print::Label;
pub use readback::PictureReadback;
pub use renderer::Renderer;
pub use resting::{MOST_RESTING, RestingDrop};
pub use scene::{BoxDesc, PlateDesc, SceneDesc, ShardDesc, VesselDesc};
pub use source::{
    BubbleSource, LiquidSource, Neighbours, ParticleSource, SpraySource, SteamSource, VesselTables,
};
pub use tints::Tint;
