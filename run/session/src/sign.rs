//! A sign in the scene: a disc near a flask, that shows with a moving picture what to do there.
//!
//! It is drawn and nothing more: it is part of neither simulation nor recording.

pub mod asked;
pub mod drawing;
pub mod place;
mod strokes;

use egui::epaint::{
    ClippedShape, ColorImage, ImageDelta, Rect, TessellationOptions, Tessellator, TextureId,
    textures::TextureOptions,
};
use egui::{Color32, TexturesDelta};
use glam::{Affine3A, Vec3};
use vitriol_gpu::{Gpu, Image, Recorder};
use vitriol_render::Panel;
use vitriol_run::Failure;
use vitriol_shaders::Library;

use super::painter::{self, Painter};
use drawing::{Pictogram, STEPS};
use place::{WIDTH, facing};

/// Width and height of its picture, pixels: one and a half of a headset's (20 a degree) at 0.6 m.
const PIXELS: u32 = 256;
/// Steps of the motion a second: it begins anew every 2.4 s, far from what flickers (WCAG 2.1, 2.3.1: three flashes a second).
const STEPS_A_SECOND: f64 = 10.0;
/// Time in which the sign comes to where it should be but for a third, s. Ours.
const FOLLOWS: f64 = 0.12;

/// A sign: a disc with a moving pictogram, and its place in the scene.
pub struct Sign {
    painter: Painter,
    image: Image,
    /// What its picture shows.
    painted: Option<Pictogram>,
    /// What is shown since when (s), and where.
    shown: Option<(Pictogram, f64)>,
    middle: Vec3,
    /// Time of the last frame, s.
    last: f64,
    head: Vec3,
}

/// A sign of a frame.
pub struct Drawn {
    image: Image,
    scene_from_sign: Affine3A,
}

impl Drawn {
    /// The sign as the renderer takes it, in the scene's stage.
    pub fn panel(&self) -> Panel<'_> {
        Panel {
            image: &self.image,
            stage_from_panel: self.scene_from_sign,
            size: [WIDTH; 2],
        }
    }
}

impl Sign {
    /// A sign that shows nothing yet.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(gpu: &Gpu, library: &Library) -> Result<Self, Failure> {
        Ok(Self {
            painter: Painter::new(gpu, library, "sign")?,
            image: painter::image(gpu, "sign", [PIXELS; 2])?,
            painted: None,
            shown: None,
            middle: Vec3::ZERO,
            last: 0.0,
            head: Vec3::Z,
        })
    }

    /// Shows that pictogram, whose step is chosen here, at a place, to a head (both in the scene's stage, m), in the frame that is
    /// shown at `time` (s).
    pub fn show(&mut self, pictogram: Pictogram, middle: Vec3, head: Vec3, time: f64) {
        self.head = head;
        let since = match &self.shown {
            Some((shown, since)) if shown.lesson == pictogram.lesson => {
                let share = 1.0 - (-(time - self.last).max(0.0) / FOLLOWS).exp();
                self.middle = self.middle.lerp(middle, share as f32);
                *since
            }
            // Another one is where it should be at once.
            _ => {
                self.middle = middle;
                time
            }
        };
        self.last = time;
        let steps = (STEPS_A_SECOND * (time - since).max(0.0)) as u64;
        let step = (steps % u64::from(STEPS)) as u32;
        let now = Pictogram { step, ..pictogram };
        self.shown = Some((now, since));
        if self.painted != Some(now) {
            self.paint(&now);
        }
    }

    /// Hides the sign.
    pub fn hide(&mut self) {
        self.shown = None;
    }

    /// The sign as it is drawn, if it is shown. Its picture is to be recorded before.
    pub fn drawn(&self) -> Option<Drawn> {
        self.shown.is_some().then(|| Drawn {
            image: self.image.clone(),
            scene_from_sign: facing(self.middle, self.head),
        })
    }

    /// Records its picture, if it has changed since it was recorded last.
    ///
    /// # Errors
    /// An error of the device.
    pub fn record(&mut self, rec: &mut Recorder) -> Result<(), Failure> {
        self.painter.record(rec, &self.image)
    }

    fn paint(&mut self, pictogram: &Pictogram) {
        let mut textures = TexturesDelta::default();
        if self.painted.is_none() {
            // Areas of one colour: a texel is enough.
            let white = ColorImage::filled([1, 1], Color32::WHITE);
            let delta = ImageDelta::full(white, TextureOptions::LINEAR);
            textures.set.push((TextureId::default(), delta));
        }
        self.painted = Some(*pictogram);
        let clip_rect = Rect::from_min_size(egui::Pos2::ZERO, egui::Vec2::splat(PIXELS as f32));
        let shapes = pictogram.shapes(0.5 * PIXELS as f32).into_iter();
        let shapes = shapes.map(|shape| ClippedShape { clip_rect, shape });
        let options = TessellationOptions {
            prerasterized_discs: false,
            ..TessellationOptions::default()
        };
        let mut tessellator = Tessellator::new(1.0, options, [1, 1], Vec::new());
        let meshes = tessellator.tessellate_shapes(shapes.collect());
        self.painter.take(meshes, textures);
    }
}
