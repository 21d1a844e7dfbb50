//! Compares the renderer's picture with the reference surface.

use glam::DVec3;
use vitriol_render::View;
use vitriol_render::reference::{
    Anisotropy, Difference, Field, Interior, Picture, Rays, Seen, Shape, difference, reprojection,
    silhouette_iou, volume,
};
use vitriol_run::Failure;
use vitriol_run::glassware::Glassware;

use super::report::{self, DrawnRow, Figures, Manner};
use super::states::State;
use super::views::{STANDS, Stand};

/// Drawn picture of an eye, by rows from the top, scene's unit.
pub struct Drawn {
    /// View depths; not finite or not above 0 where there is no liquid.
    pub depth: Vec<f32>,
    /// Ways through the liquid, in view depth.
    pub ways: Vec<f32>,
}

/// Draws a state's liquid for two eyes in a given manner.
pub trait Draw {
    /// Draws and waits.
    ///
    /// # Errors
    /// The device's error.
    fn draw(
        &mut self,
        state: &State,
        eyes: &[View; 2],
        manner: Manner,
    ) -> Result<[Drawn; 2], Failure>;
}

/// The reference surface of a state's particles.
pub fn shapes(state: &State) -> Vec<Shape> {
    let scale = &state.world.scene().scale;
    let parameters = Anisotropy::new(scale.spacing, scale.support());
    parameters.shapes(&state.positions, &state.glassware)
}

/// True pictures from one stand: the left and the right eye's, and the left eye's one frame later.
struct Truth {
    pictures: [Picture; 3],
    interiors: [Interior; 3],
}

impl Truth {
    /// Marches through all of the liquid for the left eye where `whole`.
    fn new(field: &Field<'_>, glassware: &Glassware, rays: [Rays; 3], whole: bool) -> Self {
        let [left, right, next] = rays;
        let mut pictures = [(left, whole), (right, false), (next, false)]
            .map(|(rays, whole)| Picture::new(field, &rays, whole));
        for picture in &mut pictures {
            picture.hide(|eye, ray| glassware.opaque(eye, ray));
        }
        let interiors = pictures
            .each_ref()
            .map(|picture| Interior::new(picture, field.spacing()));
        Self {
            pictures,
            interiors,
        }
    }

    fn seen(&self, place: usize) -> Seen<'_> {
        Seen {
            truth: &self.pictures[place],
            interior: &self.interiors[place],
        }
    }
}

/// A left eye's picture, true and drawn.
pub struct Sample {
    /// The liquid.
    pub state: &'static str,
    /// The true picture.
    pub truth: Picture,
    /// The drawn picture.
    pub drawn: Picture,
    /// Particle spacing, scene's unit.
    pub spacing: f64,
}

/// One comparison at one resolution.
pub struct Task<'a> {
    /// The liquid.
    pub state: &'a State,
    /// Its shapes.
    pub shapes: &'a [Shape],
    /// Width and height of an eye's picture, pixels.
    pub size: [u32; 2],
    /// Whether the true picture's thickness is wanted.
    pub whole: bool,
    /// How it is drawn.
    pub manners: &'a [Manner],
}

impl Task<'_> {
    /// Judges every manner from every stand; `keep` takes the first stand's left eye.
    ///
    /// # Errors
    /// The device's error.
    pub fn judge(
        &self,
        draw: &mut dyn Draw,
        mut keep: impl FnMut(Manner, Sample),
    ) -> Result<Vec<report::Picture>, Failure> {
        let scene = self.state.world.scene();
        let (spacing, length_scale) = (scene.scale.spacing, scene.scale.length_scale);
        let field = Field::new(
            self.shapes,
            &self.state.volumes,
            spacing,
            &self.state.glassware,
        );
        let mut pictures = Vec::new();
        for (index, stand) in STANDS.iter().enumerate() {
            let [now, next] = [0, 1].map(|frame| stand.eyes(&self.state.spec, self.size, frame));
            let rays =
                [now[0], now[1], next[0]].map(|view| Rays::new(&view, self.size, length_scale));
            let truth = Truth::new(&field, &self.state.glassware, rays, self.whole);
            let exact = truth.pictures.clone();
            pictures.push(self.picture(stand, &truth, &exact, Manner::REFERENCE));
            for &manner in self.manners {
                let [left, right] = draw.draw(self.state, &now, manner)?;
                let [next, _] = draw.draw(self.state, &next, manner)?;
                let mut drawn = [(0, left), (1, right), (2, next)]
                    .map(|(k, drawn)| Picture::drawn(&rays[k], &drawn.depth, &drawn.ways));
                for picture in &mut drawn {
                    picture.hide(|eye, ray| self.state.glassware.opaque(eye, ray));
                }
                pictures.push(self.picture(stand, &truth, &drawn, manner));
                if index == 0 {
                    let [drawn, ..] = drawn;
                    let sample = Sample {
                        state: self.state.spec.name,
                        truth: exact[0].clone(),
                        drawn,
                        spacing,
                    };
                    keep(manner, sample);
                }
            }
        }
        Ok(pictures)
    }

    /// The figures of a picture drawn from a stand.
    fn picture(
        &self,
        stand: &Stand,
        truth: &Truth,
        drawn: &[Picture; 3],
        manner: Manner,
    ) -> report::Picture {
        let spacing = self.state.world.scene().scale.spacing;
        let both = |of: &dyn Fn(usize) -> f64| 0.5 * (of(0) + of(1));
        let off: [Difference; 2] = [0, 1].map(|eye| {
            difference(
                &truth.pictures[eye],
                &drawn[eye],
                &truth.interiors[eye],
                spacing,
            )
        });
        let [left, right, next] = drawn;
        let stereo = reprojection([left, right], [truth.seen(0), truth.seen(1)], spacing);
        let flicker = reprojection([left, next], [truth.seen(0), truth.seen(2)], spacing);
        let seen = volume(left);
        report::Picture {
            state: self.state.spec.name,
            view: stand.name,
            row: DrawnRow {
                size: self.size,
                margin_px: truth.interiors[0].margin,
                manner,
                figures: Figures {
                    silhouette_iou: both(&|eye| silhouette_iou(&truth.pictures[eye], &drawn[eye])),
                    compared: both(&|eye| {
                        let seen = truth.pictures[eye].depth.iter();
                        off[eye].pixels as f64
                            / seen.filter(|depth| depth.is_finite()).count() as f64
                    }),
                    depth_rms_radii: both(&|eye| off[eye].depth_rms.powi(2)).sqrt(),
                    depth_mean_radii: both(&|eye| off[eye].depth_mean),
                    normal_angle_deg: both(&|eye| off[eye].normal_angle).to_degrees(),
                    reprojection_rms_radii: stereo.depth_rms,
                    flicker_rms_radii: flicker.depth_rms,
                    flicker_normal_deg: flicker.normal_angle.to_degrees(),
                    volume_ratio: if seen > 0.0 {
                        seen / self.volume_before(&left.rays)
                    } else {
                        f64::NAN
                    },
                },
            },
        }
    }

    /// Volume of the particles that are in the picture, scene's unit cubed.
    fn volume_before(&self, rays: &Rays) -> f64 {
        let [width, height] = rays.size().map(|size| size as f64);
        let is_seen = |at: DVec3| {
            rays.project(at).is_some_and(|(x, y, depth)| {
                let ray = (at - rays.eye) / depth;
                let open = depth < self.state.glassware.opaque(rays.eye, ray);
                open && (0.0..width).contains(&x) && (0.0..height).contains(&y)
            })
        };
        let particles = self.state.positions.iter().zip(&self.state.volumes);
        let seen = particles.filter(|(position, _)| is_seen(**position));
        seen.map(|(_, volume)| volume).sum()
    }
}
