//! Records a frame: the liquid's surface, the picture with the glass over it, then smooth edges and steam.

mod copies;
mod liquid;

use vitriol_gpu::{Buffer, Gpu, Image, ImageDesc, Recorder, Sampler, bytes_of_elements, vk};
use vitriol_shaders::{Library, ShaderId, layout};

use crate::RenderError;
use crate::desc::RenderDesc;
use crate::fluid::{Cells, Fluid, zeros};
use crate::fovea::foveae;
use crate::frame::FrameDesc;
use crate::hands::Hands;
use crate::hidden::hidden_words;
use crate::lanes;
use crate::panel::{Panel, no_panel};
use crate::pipelines::Pipelines;
use crate::scene::{Scene, SceneDesc};
use crate::solids::Solids;
use crate::spheres::Spheres;
use crate::spray::Spray;
use crate::tiles::Tiles;

/// Format of the picture. Shaders cannot write an image of an sRGB format, so they encode the colours
/// themselves; the bits can be copied to an sRGB image.
const PICTURE_FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;

/// Draws frames into its own layered image, a layer a view, and depths.
///
/// It records into the caller's recorder, so the picture comes after whatever
/// solver passes were recorded or submitted before it on that queue, and reads
/// the solver's buffers where they are.
pub struct Renderer {
    gpu: Gpu,
    desc: RenderDesc,
    pipelines: Pipelines,
    scene: Scene,
    frame: Buffer,
    fluid: Option<Fluid>,
    /// The pixels that the lenses hide, a bit each.
    hidden: Option<Buffer>,
    tiles: Tiles,
    /// Bound in place of buffers that a frame does not have.
    nothing: Buffer,
    spheres: Spheres,
    spray: Spray,
    hands: Hands,
    solids: Solids,
    /// The picture before its edges are smoothed.
    drawn: Image,
    between: Sampler,
    /// Bound in place of a panel's image where a frame has no panel.
    no_panel: Image,
    picture: Image,
    depths: Buffer,
}

impl Renderer {
    /// A renderer of an empty scene, with shaders from `library`. Does not wait for the device: it may record to the main queue at once,
    /// and to another after [`Renderer::set_scene`].
    ///
    /// # Errors
    /// [`RenderError::ViewCount`], [`RenderError::TooManyPixels`], [`RenderError::Lanes`]; [`RenderError::Gpu`] where the device
    /// cannot have the images, [`RenderError::Shader`].
    pub fn new(gpu: &Gpu, library: &Library, desc: &RenderDesc) -> Result<Self, RenderError> {
        if !(1..=2).contains(&desc.views) {
            return Err(RenderError::ViewCount { views: desc.views });
        }
        desc.check(gpu.info().limits.storage_bytes)?;
        // Checked without a liquid too, since its pipelines take the lanes.
        lanes::of_neighbours(gpu.info(), desc.lanes.neighbours)?;
        lanes::of_splats(gpu.info(), desc.lanes.pixels)?;
        let image = |label| {
            let desc = ImageDesc {
                extent: desc.extent,
                layers: desc.views,
                format: PICTURE_FORMAT,
                usage: vk::ImageUsageFlags::STORAGE | vk::ImageUsageFlags::SAMPLED,
            };
            Image::new(gpu, label, desc)
        };
        let (extent, views, lanes) = (desc.extent, desc.views, desc.lanes);
        let pixels = (views * extent[0] * extent[1]) as usize;
        Ok(Self {
            gpu: gpu.clone(),
            desc: *desc,
            pipelines: Pipelines::new(gpu, library, desc.foveated)?,
            scene: Scene::new(gpu, &SceneDesc::default())?.0,
            frame: Buffer::uniform(gpu, "frame", bytes_of_elements::<layout::Frame>(1))?,
            fluid: match desc.liquid {
                Some(liquid) => Some(Fluid::new(gpu, library, liquid, extent, views, lanes)?),
                None => None,
            },
            hidden: None,
            tiles: Tiles::new(gpu, library, extent, views)?,
            nothing: zeros(gpu)?,
            spheres: Spheres::new(gpu, library, lanes)?,
            spray: Spray::new(gpu, library)?,
            hands: Hands::new(gpu, library, desc.foveated)?,
            solids: Solids::new(gpu, extent, views)?,
            drawn: image("drawn")?,
            between: Sampler::linear(gpu)?,
            no_panel: no_panel(gpu)?,
            picture: image("picture")?,
            depths: Buffer::storage(gpu, "picture depth", bytes_of_elements::<f32>(pixels))?,
        })
    }

    /// Rebuilds the pipelines whose shaders changed; `changed` is what
    /// [`Library::changed`] returned. On an error the old pipelines stay.
    ///
    /// # Errors
    /// [`RenderError::Shader`], [`RenderError::Gpu`].
    pub fn reload(&mut self, library: &Library, changed: &[ShaderId]) -> Result<(), RenderError> {
        // All that can fail comes before anything is replaced.
        let gpu = &self.gpu;
        let RenderDesc {
            extent,
            views,
            lanes,
            foveated,
            ..
        } = self.desc;
        let is_of = |folder: &str| changed.iter().any(|id| id.path().starts_with(folder));
        let liquid = self.desc.liquid.filter(|_| is_of("render/fluid/"));
        let fluid = liquid.map(|liquid| Fluid::new(gpu, library, liquid, extent, views, lanes));
        let fluid = fluid.transpose()?;
        let spheres = is_of("render/spheres/");
        let spheres = spheres.then(|| Spheres::new(gpu, library, lanes));
        let spheres = spheres.transpose()?;
        let spray = is_of("render/spray/").then(|| Spray::new(gpu, library));
        let spray = spray.transpose()?;
        let hands = is_of("render/hands/").then(|| Hands::new(gpu, library, foveated));
        let hands = hands.transpose()?;
        if Pipelines::uses(changed) {
            let tiles = Tiles::new(gpu, library, extent, views)?;
            self.pipelines = Pipelines::new(gpu, library, foveated)?;
            self.tiles = tiles;
        }
        if fluid.is_some() {
            self.fluid = fluid;
        }
        if let Some(spheres) = spheres {
            self.spheres = spheres;
        }
        if let Some(spray) = spray {
            self.spray = spray;
        }
        if let Some(hands) = hands {
            self.hands = hands;
        }
        Ok(())
    }

    /// Replaces the scene: builds and uploads its outlines, and waits for that and for what was uploaded before.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] out of memory or on device loss.
    pub fn set_scene(&mut self, desc: &SceneDesc) -> Result<(), RenderError> {
        let (scene, uploaded) = Scene::new(&self.gpu, desc)?;
        uploaded.wait()?;
        self.scene = scene;
        Ok(())
    }

    /// The ellipsoids that [`Renderer::record`] made last of liquid, as `array<Ellipsoid>`
    /// ([`layout::Ellipsoid`]) in the particles' order; `None` for a renderer
    /// without liquid.
    pub fn ellipsoids(&self) -> Option<&Buffer> {
        self.fluid.as_ref().map(|fluid| fluid.ellipsoids(0))
    }

    /// Takes a mesh of the part that each view's lens hides, as a runtime gives it: the corners of triangles, three each, at places of the
    /// picture from (0, 0) at its upper left to (1, 1). These pixels stay black and are not lit. Views without a mesh have an empty slice;
    /// waits for the upload.
    ///
    /// # Errors
    /// [`RenderError::Count`] for another number of views,
    /// [`RenderError::Gpu`].
    pub fn set_visibility_mask(&mut self, views: &[&[[f32; 2]]]) -> Result<(), RenderError> {
        if views.len() != self.desc.views as usize {
            return Err(RenderError::Count {
                what: "masks",
                given: views.len(),
                wanted: self.desc.views as usize,
            });
        }
        self.hidden = None;
        if views.iter().any(|corners| !corners.is_empty()) {
            let words = views
                .iter()
                .flat_map(|corners| hidden_words(corners, self.desc.extent));
            let words: Vec<u32> = words.collect();
            let buffer = Buffer::storage(&self.gpu, "hidden area", size_of_val(&words[..]) as u64)?;
            self.gpu.write(&buffer, &words)?;
            self.hidden = Some(buffer);
        }
        Ok(())
    }

    /// Width and height of each view, pixels, at most.
    pub fn extent(&self) -> [u32; 2] {
        self.desc.extent
    }

    /// The picture, a layer a view: `R8G8B8A8_UNORM` with sRGB-encoded values, so that it can be copied to an image of that encoding.
    /// Alpha is 1, and 0 where a frame's panel is seen with nothing before it: there a layer under the picture that shows the same may be
    /// seen in its place. The picture has the panel all the same, so it is not to be multiplied with alpha, which may be left out.
    pub fn image(&self) -> &Image {
        &self.picture
    }

    /// Depth of everything but glass (reversed, see [`crate::camera`]), as `array<f32>`: each view's pixels row by row. It can be copied
    /// to an image of 32-bit depth.
    pub fn depth(&self) -> &Buffer {
        &self.depths
    }

    /// Records the liquid's surface and thickness, and no picture: for
    /// [`Renderer::read_back_surface`].
    ///
    /// # Errors
    /// As for [`Renderer::record`].
    pub fn record_surface(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
    ) -> Result<(), RenderError> {
        self.record_shapes(rec, frame, 0)?;
        self.prepare(rec, frame, 0)
    }

    /// Records the passes before the lit picture: uniforms, tiles, the liquid's surface from that slot.
    fn prepare(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        slot: usize,
    ) -> Result<(), RenderError> {
        frame.check(&self.scene, &self.desc)?;
        let hides = self.mask(frame).is_some();
        let uniforms = frame.uniforms(&self.scene, &self.desc, hides);
        rec.upload(&self.frame, &[uniforms])?;
        let liquid = self.liquid(frame)?;
        let shapes = match &liquid {
            Some((fluid, source)) => (fluid.ellipsoids(slot), source.count),
            None => (&self.nothing, 0),
        };
        let (steam, views) = (frame.steam.as_ref(), frame.views.len() as u32);
        self.tiles.mark(rec, &self.frame, shapes, steam, views)?;
        if let Some(particles) = &frame.particles {
            let (solids, particles) = (&self.solids, (particles, views));
            self.spheres
                .record_nearest(rec, &self.frame, particles, solids, &self.tiles)?;
        }
        if let Some(flights) = self.flights(frame, slot)? {
            let drops = (flights, (frame.resting, frame.length_scale));
            self.spray
                .record_nearest(rec, &self.frame, drops, &self.solids, &self.tiles)?;
        }
        if has_hands(frame) {
            self.hands
                .record_marks(rec, &self.frame, frame, &self.tiles)?;
        }
        self.tiles.list(
            rec,
            &self.frame,
            self.hidden(frame),
            (frame.extent(self.desc.extent), views),
            &foveae(frame.foveation, frame.views),
        )?;
        liquid.map_or(Ok(()), |(fluid, source)| {
            let shapes = (slot, source.count, views);
            fluid.record_surface(rec, shapes, &self.frame, &self.tiles)
        })
    }

    /// The mask of pixels that the lenses hide in a frame; `None` where they hide none.
    fn mask(&self, frame: &FrameDesc<'_>) -> Option<&Buffer> {
        self.hidden.as_ref().filter(|_| frame.part_of.is_none())
    }

    fn hidden(&self, frame: &FrameDesc<'_>) -> &Buffer {
        self.mask(frame).unwrap_or(&self.nothing)
    }

    /// Records the picture of one frame.
    ///
    /// # Errors
    /// [`RenderError::Count`] and [`RenderError::TooManyParticles`] where the
    /// frame does not fit; [`RenderError::Gpu`].
    pub fn record(&self, rec: &mut Recorder, frame: &FrameDesc<'_>) -> Result<(), RenderError> {
        self.record_shapes(rec, frame, 0)?;
        self.record_picture(rec, frame, 0)
    }

    /// Records the part of a picture that reads the solver's buffers of the
    /// liquid: compute alone, into one of two slots (`slot` counted modulo two). So the
    /// picture of frame n can be drawn on the main queue while frame n + 1 is
    /// solved on the other:
    ///
    /// - the solver's frame n and this, on the async queue, after the
    ///   picture of frame n − 2, which had the same slot;
    /// - [`Renderer::record_picture`] on the main queue, after that.
    ///
    /// # Errors
    /// As for [`Renderer::record`].
    pub fn record_shapes(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        slot: usize,
    ) -> Result<(), RenderError> {
        match self.liquid(frame)? {
            Some((fluid, source)) => fluid.record_shapes(rec, frame, &source, slot),
            None => Ok(()),
        }
    }

    /// Records the rest of the picture, with the liquid from that slot.
    ///
    /// # Errors
    /// As for [`Renderer::record`].
    pub fn record_picture(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        slot: usize,
    ) -> Result<(), RenderError> {
        self.prepare(rec, frame, slot)?;
        if let Some(particles) = &frame.particles {
            let (colour_by, solids) = (frame.colour_by, &self.solids);
            self.spheres.record_light(
                rec,
                &self.frame,
                particles,
                colour_by,
                solids,
                &self.tiles,
            )?;
        }
        if let Some(flights) = self.flights(frame, slot)? {
            self.spray
                .record_light(rec, &self.frame, flights, &self.solids, &self.tiles)?;
        }
        if has_hands(frame) {
            self.hands
                .record_light(rec, &self.frame, frame, &self.solids, &self.tiles)?;
        }
        self.draw_picture(rec, frame, slot)?;
        self.finish(rec, frame)
    }

    fn draw_picture<'a>(
        &'a self,
        rec: &mut Recorder,
        frame: &FrameDesc<'a>,
        slot: usize,
    ) -> Result<(), RenderError> {
        let liquid = self.liquid(frame)?;
        let of_liquid = |of: fn(&Fluid) -> &Buffer| {
            liquid
                .as_ref()
                .map_or(&self.nothing, |(fluid, _)| of(fluid))
        };
        let cells = liquid.as_ref().map(|(fluid, _)| fluid.bubbles(slot));
        let of_cells = |of: fn(&Cells) -> &Buffer| cells.map_or(&self.nothing, of);
        let dew = frame.steam.and_then(|steam| steam.dew);
        let shown = |panel: Option<Panel<'a>>| panel.map_or(&self.no_panel, |panel| panel.image);
        let (panel, sign) = (shown(frame.panel), shown(frame.sign));
        rec.group("picture", |rec| {
            let (coarse, _) = self.pipelines.coarse(frame.foveation.is_some());
            for (class, pipeline) in self.pipelines.picture.iter().chain(coarse) {
                let pass = rec
                    .pass(pipeline)
                    .label(class.picture())
                    .uniform("frame", &self.frame)
                    .read("surface", of_liquid(Fluid::surface))
                    .read("sums", of_liquid(Fluid::sums))
                    .read("bubble_heads", of_cells(|cells| &cells.heads))
                    .read("bubble_entries", of_cells(|cells| &cells.entries))
                    .read("hidden_area", self.hidden(frame))
                    .read("outlines", &self.scene.outlines)
                    .read("dew", dew.unwrap_or(&self.nothing))
                    .read("tiles", self.tiles.marks())
                    .read("solid_light", &self.solids.nearest)
                    .read("solid_depths", &self.solids.depths)
                    .sampled("panel", panel)
                    .sampled("sign_image", sign)
                    .sampler("between", &self.between)
                    .storage_image("drawn", &self.drawn)
                    .storage_image("finished", &self.picture)
                    .write("depths", &self.depths);
                self.tiles.over(*class, pass)?;
            }
            Ok(())
        })?;
        Ok(())
    }

    /// Smooths edges, and lays steam over them.
    fn finish(&self, rec: &mut Recorder, frame: &FrameDesc<'_>) -> Result<(), RenderError> {
        let puffs = frame.steam.map_or(&self.nothing, |steam| steam.puffs);
        rec.group("finish", |rec| {
            for (class, pipeline) in &self.pipelines.finish {
                let pass = rec
                    .pass(pipeline)
                    .label("finish")
                    .uniform("frame", &self.frame)
                    .sampled("drawn", &self.drawn)
                    .sampler("between", &self.between)
                    .read("puffs", puffs)
                    .read("puffs_in_tiles", self.tiles.puffs())
                    .read("depths", &self.depths)
                    .storage_image("finished", &self.picture);
                self.tiles.over(*class, pass)?;
            }
            for (class, pipeline) in self.pipelines.coarse(frame.foveation.is_some()).1 {
                let pass = rec
                    .pass(pipeline)
                    .label("finish")
                    .uniform("frame", &self.frame)
                    .sampled("drawn", &self.drawn)
                    .read("hidden_area", self.hidden(frame))
                    .read("puffs", puffs)
                    .read("puffs_in_tiles", self.tiles.puffs())
                    .read("depths", &self.depths)
                    .storage_image("finished", &self.picture);
                self.tiles.over(*class, pass)?;
            }
            Ok(())
        })?;
        Ok(())
    }
}

/// Whether a frame shows any hand.
fn has_hands(frame: &FrameDesc<'_>) -> bool {
    let groups = [frame.hands[0], frame.hands[1], frame.tools];
    groups.iter().any(|bones| !bones.is_empty())
}
