//! The device's half of the mirror, and of the console's view: brings the left eye's picture to the window's size and copies it to where
//! another thread reads it. Nothing here waits.

use std::collections::VecDeque;
use std::sync::Arc;

use vitriol_gpu::{
    Buffer, ComputePipeline, CopyRegion, Gpu, GpuError, Image, QueueKind, Sampler, Ticket,
};
use vitriol_live::RawPicture;
use vitriol_run::{Blame, Failure};
use vitriol_shaders::{Library, layout, mirror};

/// Longest side of a mirror's picture, pixels: as high as an ordinary screen. A larger window
/// scales it up.
pub const LONGEST: u32 = 1080;

/// Buffers that a picture can be in: one is filled by the device, one is copied by the window's thread, one is spare.
const SLOTS: usize = 3;

/// The panel as a screen's window shows it where the picture is coarser than the window: sampled once, as a headset's runtime does with a
/// layer under the picture. The picture's alpha says where it is seen, so what stands before it hides it.
#[derive(Clone, Copy)]
pub struct Layer<'a> {
    /// Its image.
    pub image: &'a Image,
    /// From a place in the picture to the panel's, see [`layout::MirrorDraw`].
    pub panel_from_picture: [[f32; 4]; 4],
}

/// A picture as a window takes it.
pub struct Shrunk {
    /// 0x00RRGGBB, row by row; the slot is free again when this is dropped.
    pixels: Arc<Buffer>,
    /// Width and height, pixels.
    pub extent: [u32; 2],
}

impl Shrunk {
    /// The pixels, 0x00RRGGBB, row by row.
    ///
    /// # Errors
    /// An error of the device.
    pub fn pixels(&self) -> Result<Vec<u32>, GpuError> {
        let [width, height] = self.extent.map(|side| side as usize);
        self.pixels.read_host(width * height)
    }
}

impl From<Shrunk> for RawPicture {
    fn from(Shrunk { pixels, extent }: Shrunk) -> Self {
        Self::Device(pixels, extent)
    }
}

/// Shrinks pictures, three at most at a time.
pub struct Shrink {
    gpu: Gpu,
    pipeline: ComputePipeline,
    between: Sampler,
    /// The largest picture.
    most: [u32; 2],
    shrunk: Buffer,
    /// A slot whose buffer nobody else holds is free.
    slots: [Arc<Buffer>; SLOTS],
    under_way: VecDeque<(Ticket, Shrunk)>,
    /// Display time of the next picture, ns.
    due: i64,
}

impl Shrink {
    /// For pictures of `eye` pixels an eye, whose sides are `longest` pixels at most as they are shrunk.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(gpu: &Gpu, library: &Library, eye: [u32; 2], longest: u32) -> Result<Self, Failure> {
        let compiled = library.compile(&mirror::MIRROR, "main", &[]).other()?;
        let most = fit(eye, eye.map(|side| side.min(longest)));
        let bytes = 4 * u64::from(most[0]) * u64::from(most[1]);
        let slot = || Buffer::readback(gpu, "mirror, for the window", bytes).other();
        Ok(Self {
            gpu: gpu.clone(),
            pipeline: ComputePipeline::new(gpu, &compiled).other()?,
            between: Sampler::linear(gpu).other()?,
            most,
            shrunk: Buffer::storage(gpu, "mirror", bytes).other()?,
            slots: [slot()?.into(), slot()?.into(), slot()?.into()],
            under_way: VecDeque::new(),
            due: i64::MIN,
        })
    }

    /// Begins to shrink the first `drawn` pixels of `picture`'s first layer for a window of that size, behind what was
    /// submitted before. It is scaled up only where there is a `layer` that is then sharper. The picture is shown at `time`, and the least
    /// interval is `every` (display time, ns). Does nothing within that interval, or where no slot is free.
    ///
    /// # Errors
    /// An error of the device.
    pub fn begin(
        &mut self,
        (picture, layer): (&Image, Option<Layer<'_>>),
        drawn: [u32; 2],
        window: [u32; 2],
        (time, every): (i64, i64),
    ) -> Result<(), Failure> {
        // Display times are rounded. With this margin it is every third frame at 90 Hz, and never the fourth.
        if time < self.due.saturating_sub(every / 8) {
            return Ok(());
        }
        self.due = time.max(self.due.saturating_add(every));
        let mut slots = self.slots.iter_mut();
        let Some(pixels) =
            slots.find_map(|slot| Arc::get_mut(slot).is_some().then(|| Arc::clone(slot)))
        else {
            return Ok(());
        };
        let most = [0, 1].map(|side| {
            let enough = if layer.is_some() {
                u32::MAX
            } else {
                drawn[side]
            };
            self.most[side].min(enough).min(window[side])
        });
        let extent = fit(drawn, most);
        // In a picture of its size the panel is as sharp already.
        let layer = layer.filter(|_| extent != drawn);
        let mut rec = self.gpu.recorder(QueueKind::Main).other()?;
        rec.pass(&self.pipeline)
            .sampled("picture", picture)
            .sampled("panel", layer.map_or(picture, |it| it.image))
            .sampler("between", &self.between)
            .write("shrunk", &self.shrunk)
            .constants(&layout::MirrorDraw {
                drawn,
                extent,
                panel_from_picture: layer.map_or([[0.0; 4]; 4], |it| it.panel_from_picture),
            })
            .invocations_2d(extent)
            .other()?;
        let all = CopyRegion {
            from: 0,
            to: 0,
            bytes: 4 * u64::from(extent[0]) * u64::from(extent[1]),
        };
        rec.copy(&self.shrunk, &pixels, &[all]).other()?;
        let ticket = self.gpu.submit(rec).other()?;
        self.under_way
            .push_back((ticket, Shrunk { pixels, extent }));
        Ok(())
    }

    /// The next picture that the device is done with.
    ///
    /// # Errors
    /// An error of the device.
    pub fn done(&mut self) -> Result<Option<Shrunk>, Failure> {
        match self.under_way.front() {
            Some((ticket, _)) if ticket.is_done().other()? => {}
            _ => return Ok(None),
        }
        Ok(self.under_way.pop_front().map(|(_, shrunk)| shrunk))
    }
}

/// The largest extent of the aspect of `picture` that fits in `window`, pixels.
pub fn fit(picture: [u32; 2], window: [u32; 2]) -> [u32; 2] {
    let scale = (0..2)
        .map(|side| f64::from(window[side]) / f64::from(picture[side]))
        .fold(f64::INFINITY, f64::min);
    picture.map(|side| ((f64::from(side) * scale).round() as u32).max(1))
}

#[cfg(test)]
mod tests {
    use super::fit;

    #[test]
    fn a_picture_keeps_its_aspect() {
        // By hand: 2064 / 2208 = 0.9348.
        assert_eq!(fit([2064, 2208], [1080, 1080]), [1010, 1080]);
        assert_eq!(fit([2064, 2208], [467, 4000]), [467, 500]);
        assert_eq!(fit([320, 240], [800, 800]), [800, 600]);
        assert_eq!(fit([320, 240], [1, 1]), [1, 1]);
    }
}
