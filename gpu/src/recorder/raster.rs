//! A raster scope: targets, then draws into them, each one expression.

use ash::vk;

use super::Recorder;
use super::binder::Binder;
use super::draw::Draw;
use crate::barrier::{Scope, Use};
use crate::submission::Storage;
use crate::{GpuError, Image, RasterPipeline};

/// What a target holds when the scope begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load<T> {
    /// This value everywhere.
    Clear(T),
    /// What was there.
    Keep,
    /// Anything: the scope draws over all of it.
    Discard,
}

/// A colour target.
#[derive(Clone, Copy)]
pub struct ColourTarget<'a> {
    /// Where to draw.
    pub image: &'a Image,
    /// What is there first.
    pub load: Load<[f32; 4]>,
}

/// The depth target.
#[derive(Clone, Copy)]
pub struct DepthTarget<'a> {
    /// Where depth goes.
    pub image: &'a Image,
    /// What is there first.
    pub load: Load<f32>,
}

/// Targets of a raster scope, all of the same extent.
#[derive(Clone, Copy)]
pub struct RasterTarget<'a> {
    /// Label in timings, markers and debuggers.
    pub label: &'a str,
    /// Colour targets in order of `@location`.
    pub colours: &'a [ColourTarget<'a>],
    /// Depth target.
    pub depth: Option<DepthTarget<'a>>,
    /// Bit per view (multiview): view i goes to layer i. 0: one picture, into
    /// the first layer.
    pub view_mask: u32,
}

/// An open raster scope.
pub struct Raster<'r> {
    storage: &'r mut Storage,
    colours: &'r [ColourTarget<'r>],
    depth: Option<DepthTarget<'r>>,
    view_mask: u32,
}

impl Recorder {
    /// Draws what `f` records into `target`. All draws of a scope come after
    /// all passes before it; none of them may read what another of them
    /// writes.
    ///
    /// # Errors
    /// [`GpuError::Raster`] where targets do not fit each other, the queue or
    /// the draws; those of `f`, and then nothing is drawn.
    pub fn raster(
        &mut self,
        target: &RasterTarget<'_>,
        f: impl FnOnce(&mut Raster<'_>) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        let extent = check_target(target, self.graphics)?;
        let storage = &mut *self.storage;
        storage.clear_pass();
        for colour in target.colours {
            storage.use_image(
                colour.image,
                vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
                Scope::COLOUR,
                !matches!(colour.load, Load::Keep),
            )?;
        }
        if let Some(depth) = &target.depth {
            storage.use_image(
                depth.image,
                vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                Scope::DEPTH,
                !matches!(depth.load, Load::Keep),
            )?;
        }
        f(&mut Raster {
            storage,
            colours: target.colours,
            depth: target.depth,
            view_mask: target.view_mask,
        })?;
        check_draws(storage, target.label)?;
        storage.open_pass(target.label.as_bytes())?;
        storage.begin_rendering(target, extent);
        storage.replay_draws();
        // SAFETY: rendering was begun above.
        unsafe { storage.core.device.cmd_end_rendering(storage.cmd) };
        storage.close_pass()
    }
}

fn refuse(label: &str, cause: &str) -> GpuError {
    GpuError::Raster {
        pass: label.to_owned(),
        cause: cause.to_owned(),
    }
}

fn check_target(target: &RasterTarget<'_>, graphics: bool) -> Result<[u32; 2], GpuError> {
    if !graphics {
        return Err(refuse(
            target.label,
            "recorded for the async queue; use QueueKind::Main",
        ));
    }
    let images = target
        .colours
        .iter()
        .map(|colour| (colour.image, vk::ImageUsageFlags::COLOR_ATTACHMENT))
        .chain(
            target
                .depth
                .iter()
                .map(|depth| (depth.image, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT)),
        );
    let layers = 32 - target.view_mask.leading_zeros();
    let mut extent = None;
    for (image, usage) in images {
        let desc = image.desc();
        if !desc.usage.contains(usage) {
            return Err(refuse(
                target.label,
                &format!("image \"{}\" was not made for {usage:?}", image.label()),
            ));
        }
        if desc.layers < layers {
            return Err(refuse(
                target.label,
                &format!(
                    "image \"{}\" has {} layers, the view mask needs {layers}",
                    image.label(),
                    desc.layers
                ),
            ));
        }
        if *extent.get_or_insert(desc.extent) != desc.extent {
            return Err(refuse(
                target.label,
                "its targets differ in extent; give them one",
            ));
        }
    }
    extent.ok_or_else(|| {
        refuse(
            target.label,
            "it has no target; give a colour or depth image",
        )
    })
}

/// No barrier can stand between the draws of a scope.
fn check_draws(storage: &Storage, label: &str) -> Result<(), GpuError> {
    for (index, written) in storage.uses.iter().enumerate() {
        let clash = |(other, used): (usize, &Use)| other != index && used.slot == written.slot;
        if !written.scope.writes().is_empty() && storage.uses.iter().enumerate().any(clash) {
            return Err(refuse(
                label,
                "two draws use a buffer that one of them writes; draw them in two scopes",
            ));
        }
    }
    Ok(())
}

impl Raster<'_> {
    /// A draw: name what it reads, then its vertices.
    pub fn draw<'d>(&'d mut self, pipeline: &'d RasterPipeline) -> Draw<'d> {
        let inner = &pipeline.inner;
        let mut binder = Binder::new(self.storage, &inner.layout, inner.label.as_bytes());
        let fits = inner.view_mask == self.view_mask
            && inner
                .colours
                .iter()
                .eq(self.colours.iter().map(|c| &c.image.desc().format))
            && inner.depth == self.depth.map(|depth| depth.image.desc().format);
        if !fits {
            let error = GpuError::Raster {
                pass: binder.label_text(),
                cause: "the pipeline was made for other formats or views than the scope's targets"
                    .to_owned(),
            };
            binder.fail(error);
        }
        Draw::new(self.storage, inner, binder)
    }
}

impl Storage {
    fn begin_rendering(&self, target: &RasterTarget<'_>, [width, height]: [u32; 2]) {
        let colours: Vec<_> = target
            .colours
            .iter()
            .map(|colour| {
                let (op, value) = load_op(colour.load);
                let clear = vk::ClearColorValue {
                    float32: value.unwrap_or_default(),
                };
                attachment(colour.image, target.view_mask, op)
                    .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
                    .clear_value(vk::ClearValue { color: clear })
            })
            .collect();
        let depth = target.depth.map(|depth| {
            let (op, value) = load_op(depth.load);
            let clear = vk::ClearDepthStencilValue {
                depth: value.unwrap_or_default(),
                stencil: 0,
            };
            attachment(depth.image, target.view_mask, op)
                .image_layout(vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL)
                .clear_value(vk::ClearValue {
                    depth_stencil: clear,
                })
        });
        let area = vk::Rect2D::default().extent(vk::Extent2D { width, height });
        let mut info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(1)
            .view_mask(target.view_mask)
            .color_attachments(&colours);
        if let Some(depth) = &depth {
            info = info.depth_attachment(depth);
        }
        let viewport = vk::Viewport {
            x: 0.0,
            y: 0.0,
            width: width as f32,
            height: height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        // SAFETY: the buffer is recording, the images are held by the storage
        // and in the named layouts; `check_target` saw to extents and layers.
        unsafe {
            let device = &self.core.device;
            device.cmd_begin_rendering(self.cmd, &info);
            device.cmd_set_viewport(self.cmd, 0, &[viewport]);
            device.cmd_set_scissor(self.cmd, 0, &[area]);
        }
    }
}

fn load_op<T>(load: Load<T>) -> (vk::AttachmentLoadOp, Option<T>) {
    match load {
        Load::Clear(value) => (vk::AttachmentLoadOp::CLEAR, Some(value)),
        Load::Keep => (vk::AttachmentLoadOp::LOAD, None),
        Load::Discard => (vk::AttachmentLoadOp::DONT_CARE, None),
    }
}

fn attachment(
    image: &Image,
    view_mask: u32,
    load: vk::AttachmentLoadOp,
) -> vk::RenderingAttachmentInfo<'static> {
    let inner = &image.inner;
    vk::RenderingAttachmentInfo::default()
        .image_view(if view_mask == 0 {
            inner.plain_view
        } else {
            inner.array_view
        })
        .load_op(load)
        .store_op(vk::AttachmentStoreOp::STORE)
}
