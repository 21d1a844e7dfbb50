//! Draws egui's triangles, those of the panel and of the signs, with three buffers and a shader. A ready-made renderer would need
//! the device's command buffers, which `vitriol_gpu` keeps to itself.

use std::sync::Arc;

use egui::epaint::{ImageData, Primitive};
use egui::{ClippedPrimitive, Rect, TexturesDelta};
use vitriol_gpu::{Buffer, Gpu, Image, ImageDesc, RasterPipeline, Recorder, vk};
use vitriol_shaders::{Library, layout, panel};

use vitriol_run::{Blame, Failure};

/// The picture's format: bytes are sRGB-encoded and blended as they are, as egui expects.
const FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;
/// Background, sRGB: dark, so that panel and signs do not outshine the bench.
pub const GROUND: [f32; 4] = [0.075, 0.085, 0.10, 1.0];

/// A picture to be painted.
///
/// # Errors
/// An error of the device.
pub fn image(gpu: &Gpu, label: &str, extent: [u32; 2]) -> Result<Image, Failure> {
    let desc = ImageDesc {
        extent,
        layers: 1,
        format: FORMAT,
        usage: vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED,
    };
    Image::new(gpu, label, desc).other()
}

/// Triangles within a rectangle.
struct Part {
    clip: Rect,
    indices: u32,
}

/// Draws egui's triangles into a picture.
pub struct Painter {
    gpu: Gpu,
    /// Name of what it paints, for measurements.
    label: &'static str,
    pipeline: RasterPipeline,
    texture: Texture,
    vertices: Vec<u32>,
    indices: Vec<Vec<u32>>,
    parts: Vec<Part>,
    buffers: Option<Buffers>,
    /// There is a picture that was not recorded.
    pub changed: bool,
}

/// On the device; made anew where they are too small.
struct Buffers {
    vertices: Buffer,
    indices: Vec<Buffer>,
    texture: Buffer,
}

/// egui's font and what else it fills areas with.
#[derive(Default)]
struct Texture {
    size: [usize; 2],
    texels: Vec<u32>,
    /// Not on the device yet as it is. It seldom changes, and is half a megabyte.
    changed: bool,
}

impl Painter {
    /// A painter of what is called `label`.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(gpu: &Gpu, library: &Library, label: &'static str) -> Result<Self, Failure> {
        let compile = |entry| library.compile(&panel::PANEL, entry, &[]).other();
        let (vertex, fragment) = (compile("vertex")?, compile("fragment")?);
        let pipeline = RasterPipeline::new(gpu, &vertex, &fragment, FORMAT);
        Ok(Self {
            gpu: gpu.clone(),
            label,
            pipeline: pipeline.other()?,
            texture: Texture::default(),
            vertices: Vec::new(),
            indices: Vec::new(),
            parts: Vec::new(),
            buffers: None,
            changed: false,
        })
    }

    /// Takes a new picture.
    pub fn take(&mut self, meshes: Vec<ClippedPrimitive>, textures: TexturesDelta) {
        for (_, delta) in textures.set {
            let ImageData::Color(image) = delta.image;
            self.texture.set(delta.pos, &image);
        }
        self.vertices.clear();
        self.indices.clear();
        self.parts.clear();
        for ClippedPrimitive {
            clip_rect,
            primitive,
        } in meshes
        {
            // The layout uses no callbacks.
            let Primitive::Mesh(mesh) = primitive else {
                continue;
            };
            let first = (self.vertices.len() / 5) as u32;
            for vertex in &mesh.vertices {
                let floats = [vertex.pos.x, vertex.pos.y, vertex.uv.x, vertex.uv.y];
                self.vertices.extend(floats.map(f32::to_bits));
                self.vertices
                    .push(u32::from_le_bytes(vertex.color.to_array()));
            }
            self.indices
                .push(mesh.indices.iter().map(|index| first + index).collect());
            self.parts.push(Part {
                clip: clip_rect,
                indices: mesh.indices.len() as u32,
            });
        }
        self.changed = true;
    }

    /// Records the picture, if there is a new one.
    ///
    /// # Errors
    /// An error of the device.
    pub fn record(&mut self, rec: &mut Recorder, image: &Image) -> Result<(), Failure> {
        if !std::mem::take(&mut self.changed) {
            return Ok(());
        }
        self.make_room()?;
        let Some(buffers) = &self.buffers else {
            return Ok(());
        };
        rec.upload(&buffers.vertices, &self.vertices).other()?;
        if std::mem::take(&mut self.texture.changed) {
            rec.upload(&buffers.texture, &self.texture.texels).other()?;
        }
        for (buffer, indices) in buffers.indices.iter().zip(&self.indices) {
            rec.upload(buffer, indices).other()?;
        }
        let [width, height] = image.desc().extent;
        rec.raster(self.label, image, GROUND, |raster| {
            for (part, indices) in self.parts.iter().zip(&buffers.indices) {
                let Rect { min, max } = part.clip;
                raster
                    .draw(&self.pipeline)
                    .read("vertices", &buffers.vertices)
                    .read("texture", &buffers.texture)
                    .constants(&layout::PanelDraw {
                        clip: [min.x, min.y, max.x, max.y],
                        size: [width as f32, height as f32],
                        texels: self.texture.size.map(|side| side as u32),
                    })
                    .indexed(indices, part.indices)?;
            }
            Ok(())
        })
        .other()
    }

    fn make_room(&mut self) -> Result<(), Failure> {
        let fits = |buffer: &Buffer, words: usize| buffer.bytes() >= 4 * words as u64;
        let enough = self.buffers.as_ref().is_some_and(|buffers| {
            fits(&buffers.vertices, self.vertices.len())
                && fits(&buffers.texture, self.texture.texels.len())
                && buffers.indices.len() >= self.indices.len()
                && (buffers.indices.iter().zip(&self.indices))
                    .all(|(buffer, indices)| fits(buffer, indices.len()))
        });
        if enough {
            return Ok(());
        }
        self.texture.changed = true;
        // Half as much again as is needed now, since texts grow.
        let room = |label, words: usize| {
            let bytes = 4 * (words + words / 2).max(1024) as u64;
            Buffer::storage(&self.gpu, label, bytes).other()
        };
        let indices = self.indices.iter();
        self.buffers = Some(Buffers {
            vertices: room("painter's vertices", self.vertices.len())?,
            texture: room("painter's texture", self.texture.texels.len())?,
            indices: indices
                .map(|indices| room("painter's indices", indices.len()))
                .collect::<Result<_, _>>()?,
        });
        Ok(())
    }
}

impl Texture {
    /// Replaces all, or the part at `pos`.
    fn set(&mut self, pos: Option<[usize; 2]>, image: &Arc<egui::ColorImage>) {
        self.changed = true;
        let texels = image.pixels.iter();
        let texels = texels.map(|colour| u32::from_le_bytes(colour.to_array()));
        let Some([left, upper]) = pos else {
            self.size = image.size;
            self.texels = texels.collect();
            return;
        };
        let width = image.size[0].max(1);
        for (n, texel) in texels.enumerate() {
            let at = (upper + n / width) * self.size[0] + left + n % width;
            if let Some(slot) = self.texels.get_mut(at) {
                *slot = texel;
            }
        }
    }
}
