//! Glass, table and floor as the reference surface asks for them.

use glam::{DAffine3, DQuat, DVec3};
use vitriol_render::reference::Surroundings;
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::visibility::leaves_through_mouth;
use vitriol_sim::scene::{Scene, TableTop};

/// What is solid in a scene at one moment, for its particles.
pub struct Glassware {
    flasks: Vec<(Profile, DAffine3)>,
    table: Option<TableTop>,
    /// Thickness of the table, scene's unit.
    slab: f64,
    floor: f64,
    positions: Vec<DVec3>,
    members: Vec<Option<usize>>,
}

impl Glassware {
    /// The scene's flasks at `poses`, around particles at `positions` (stage,
    /// scene's unit) that are in the flasks `members`.
    pub fn new(
        scene: &Scene,
        poses: &[Pose],
        positions: Vec<DVec3>,
        members: Vec<Option<usize>>,
    ) -> Self {
        let flasks = scene.flasks.iter().zip(poses).map(|(flask, pose)| {
            let orientation: DQuat = pose.orientation.as_dquat().normalize();
            let stage_from_flask =
                DAffine3::from_rotation_translation(orientation, pose.position.as_dvec3());
            (flask.profile.clone(), stage_from_flask.inverse())
        });
        Self {
            flasks: flasks.collect(),
            table: scene.table,
            slab: TableTop::THICKNESS / scene.scale.length_scale,
            floor: scene.floor.height,
            positions,
            members,
        }
    }

    /// Signed distance to the table, beside which there is none.
    fn table_distance(&self, at: DVec3) -> f64 {
        self.table.map_or(f64::INFINITY, |table| {
            let beyond = |k: usize, x: f64| (x - table.centre[k]).abs() - 0.5 * table.size[k];
            let above = (at.y - table.top).max(table.top - self.slab - at.y);
            above.max(beyond(0, at.x)).max(beyond(1, at.z))
        })
    }

    /// View depth at which a ray from `eye` meets the table or the floor;
    /// infinite where it does not. `ray` has the length 1 along the eye's axis.
    pub fn opaque(&self, eye: DVec3, ray: DVec3) -> f64 {
        let ahead = |t: f64| if t > 0.0 { t } else { f64::INFINITY };
        let floor = ahead((self.floor - eye.y) / ray.y);
        let Some(table) = self.table else {
            return floor;
        };
        let centre = DVec3::new(
            table.centre[0],
            table.top - 0.5 * self.slab,
            table.centre[1],
        );
        let half = 0.5 * DVec3::new(table.size[0], self.slab, table.size[1]);
        let (a, b) = ((centre - half - eye) / ray, (centre + half - eye) / ray);
        let (first, last) = (a.min(b).max_element(), a.max(b).min_element());
        if first < last {
            floor.min(ahead(first))
        } else {
            floor
        }
    }
}

impl Surroundings for Glassware {
    /// 0 outside, k + 1 in flask k.
    fn side(&self, particle: usize) -> usize {
        self.members[particle].map_or(0, |flask| flask + 1)
    }

    fn distance(&self, side: usize, at: DVec3) -> f64 {
        match side.checked_sub(1).and_then(|flask| self.flasks.get(flask)) {
            Some(flask) => {
                let (profile, r, y) = in_flask(flask, at);
                profile.signed_distance_inner(r, y)
            }
            None => self
                .flasks
                .iter()
                .map(|flask| in_flask(flask, at))
                .map(|(profile, r, y)| profile.signed_distance_glass(r, y))
                .fold((at.y - self.floor).min(self.table_distance(at)), f64::min),
        }
    }

    fn is_solid(&self, side: usize, at: DVec3) -> bool {
        match side.checked_sub(1).and_then(|flask| self.flasks.get(flask)) {
            Some(flask) => {
                let (profile, r, y) = in_flask(flask, at);
                y < profile.rim_height() && !profile.is_inside(r, y)
            }
            None => {
                at.y < self.floor
                    || self.table_distance(at) < 0.0
                    || self.flasks.iter().any(|flask| {
                        let (profile, r, y) = in_flask(flask, at);
                        let in_outer = (0.0..profile.rim_height()).contains(&y)
                            && r <= profile.outer_radius_at(y);
                        in_outer && !profile.is_inside(r, y)
                    })
            }
        }
    }

    fn apart(&self, a: usize, b: usize) -> bool {
        let leaves = |from: usize, to: usize| {
            self.members[from]
                .and_then(|flask| self.flasks.get(flask))
                .is_none_or(|(profile, flask_from_stage)| {
                    let [from, to] = [from, to]
                        .map(|one| flask_from_stage.transform_point3(self.positions[one]));
                    leaves_through_mouth(profile, from, to)
                })
        };
        self.members[a] != self.members[b] && !(leaves(a, b) && leaves(b, a))
    }
}

/// (r, y) of a place in a flask's frame.
fn in_flask((profile, flask_from_stage): &(Profile, DAffine3), at: DVec3) -> (&Profile, f64, f64) {
    let local = flask_from_stage.transform_point3(at);
    (profile, local.x.hypot(local.z), local.y)
}
//! Compares what a renderer draws with the reference surface.

use glam::DVec3;
use vitriol_render::View;
use vitriol_render::reference::{
    Anisotropy, Difference, Field, Interior, Picture, Rays, Seen, Shape, difference, reprojection,
    silhouette_iou, volume,
};

use super::glassware::Glassware;
use super::report::{self, Figures, Manner};
use super::states::State;
use super::views::{STANDS, Stand};
use crate::failure::Failure;

/// What was drawn for an eye, by rows from the top, scene's unit.
pub struct Drawn {
    /// View depths; not finite or not above 0 where there is no liquid.
    pub depth: Vec<f32>,
    /// Ways through the liquid, in view depth.
    pub ways: Vec<f32>,
}

/// Draws a state's liquid for two eyes in a manner.
pub trait Draw {
    /// Draws and waits.
    ///
    /// # Errors
    /// What the device says.
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

/// True pictures from one stand: the left and the right eye's, and the left
/// eye's a frame later.
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

/// A left eye's picture, true and as each manner draws it.
pub struct Sample {
    /// The liquid.
    pub state: &'static str,
    /// The true picture.
    pub truth: Picture,
    /// What was drawn.
    pub drawn: Picture,
    /// Particle spacing, scene's unit.
    pub spacing: f64,
}

/// What is compared at one resolution.
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
    /// Judges every manner from every stand; `keep` is given the first stand's
    /// left eye.
    ///
    /// # Errors
    /// What the device says.
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

    /// The figures of what was drawn from a stand.
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
            size: self.size,
            margin_px: truth.interiors[0].margin,
            manner,
            figures: Figures {
                silhouette_iou: both(&|eye| silhouette_iou(&truth.pictures[eye], &drawn[eye])),
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
//! The picture against the truth: what the renderer draws in screen space
//! compared with the surface of Yu and Turk, marched on the CPU.

pub mod glassware;
pub mod judge;
pub mod report;
pub mod screen;
pub mod sheet;
pub mod states;
pub mod views;
//! What `vitriol fidelity` found.

use std::fmt::Write;

use serde::Serialize;

use crate::report::DeviceStatement;
use crate::report::units::grouped;

/// What `vitriol fidelity` prints and writes.
#[derive(Debug, Clone, Serialize)]
pub struct Fidelity {
    /// The device that drew.
    pub device: DeviceStatement,
    /// The liquids.
    pub states: Vec<StateRow>,
    /// Each way of drawing at each resolution, over all states and views.
    pub rows: Vec<Row>,
    /// The same one by one.
    pub pictures: Vec<Picture>,
    /// Wall time, s.
    pub seconds: f64,
}

/// A liquid that was looked at.
#[derive(Debug, Clone, Serialize)]
pub struct StateRow {
    /// Its name.
    pub state: String,
    /// The scene.
    pub scene: String,
    /// Simulated time, s.
    pub seconds: f64,
    /// Particles.
    pub particles: usize,
    /// Particle spacing d, m; a particle's radius is half of it.
    pub spacing_m: f64,
    /// Their volume, mL.
    pub volume_ml: f64,
}

/// How a liquid is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Manner {
    /// The filter, or `reference` for the truth itself, whose figures are what
    /// the measures make of an exact picture.
    pub filter: &'static str,
    /// Whether with Yu and Turk's anisotropy.
    pub anisotropy: bool,
}

impl Manner {
    /// The truth.
    pub const REFERENCE: Self = Self::new("reference", true);

    /// A filter by its name in the scene's file, with or without anisotropy.
    pub const fn new(filter: &'static str, anisotropy: bool) -> Self {
        Self { filter, anisotropy }
    }
}

/// What one picture or several are off by.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Figures {
    /// Intersection over union of the silhouettes; the least of several.
    pub silhouette_iou: f64,
    /// Root mean square of the depths' differences away from silhouettes,
    /// particle radii.
    pub depth_rms_radii: f64,
    /// Their mean; above 0 where the drawn surface lies behind.
    pub depth_mean_radii: f64,
    /// Mean angle between the normals there, degrees.
    pub normal_angle_deg: f64,
    /// Root mean square of what one eye's depth is off from the other's on what
    /// both see, particle radii.
    pub reprojection_rms_radii: f64,
    /// The same between two successive places of a moving head.
    pub flicker_rms_radii: f64,
    /// Mean angle between the normals at these, degrees.
    pub flicker_normal_deg: f64,
    /// Volume by the thickness over the particles' volume; of several the one
    /// that is farthest from 1.
    pub volume_ratio: f64,
}

/// A way of drawing at a resolution, over all states and views.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Row {
    /// Width and height of an eye's picture, pixels.
    pub size: [u32; 2],
    /// Pixels that were kept away from silhouettes, the most of the views.
    pub margin_px: usize,
    /// How it is drawn.
    #[serde(flatten)]
    pub manner: Manner,
    /// What it is off by.
    #[serde(flatten)]
    pub figures: Figures,
}

/// A way of drawing in one place.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Picture {
    /// The liquid.
    pub state: &'static str,
    /// Where the head is.
    pub view: &'static str,
    /// Width and height of an eye's picture, pixels.
    pub size: [u32; 2],
    /// Pixels that were kept away from silhouettes.
    pub margin_px: usize,
    /// How it is drawn.
    #[serde(flatten)]
    pub manner: Manner,
    /// What it is off by.
    #[serde(flatten)]
    pub figures: Figures,
}

impl Figures {
    /// Over several pictures, each counting alike; NaN among them is one that
    /// had nothing to compare, and is left out.
    fn of(each: &[Self]) -> Self {
        let values = |get: fn(&Self) -> f64| each.iter().map(get).filter(|value| !value.is_nan());
        let mean = |get: fn(&Self) -> f64| values(get).sum::<f64>() / values(get).count() as f64;
        let rms = |get: fn(&Self) -> f64| {
            let squares: f64 = values(get).map(|value| value * value).sum();
            (squares / values(get).count() as f64).sqrt()
        };
        let off = |ratio: &f64| (ratio - 1.0).abs();
        Self {
            silhouette_iou: values(|f| f.silhouette_iou).fold(f64::NAN, f64::min),
            depth_rms_radii: rms(|f| f.depth_rms_radii),
            depth_mean_radii: mean(|f| f.depth_mean_radii),
            normal_angle_deg: mean(|f| f.normal_angle_deg),
            reprojection_rms_radii: rms(|f| f.reprojection_rms_radii),
            flicker_rms_radii: rms(|f| f.flicker_rms_radii),
            flicker_normal_deg: mean(|f| f.flicker_normal_deg),
            volume_ratio: values(|f| f.volume_ratio)
                .max_by(|a, b| off(a).total_cmp(&off(b)))
                .unwrap_or(f64::NAN),
        }
    }
}

/// Sums pictures up by resolution and manner, in the order of their first.
pub fn rows(pictures: &[Picture]) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for picture in pictures {
        let (size, manner) = (picture.size, picture.manner);
        if rows
            .iter()
            .any(|row| (row.size, row.manner) == (size, manner))
        {
            continue;
        }
        let same = || {
            let all = pictures.iter();
            all.filter(|other| (other.size, other.manner) == (size, manner))
        };
        let figures: Vec<Figures> = same().map(|other| other.figures).collect();
        rows.push(Row {
            size,
            margin_px: same().map(|other| other.margin_px).max().unwrap_or(0),
            manner,
            figures: Figures::of(&figures),
        });
    }
    rows
}

/// The table for people.
pub fn describe(found: &Fidelity) -> String {
    let mut text = format!("{}, {}\n", found.device.name, found.device.driver);
    for state in &found.states {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{}: {} after {} s, {} particles of {:.2} mm, {:.1} mL",
            state.state,
            state.scene,
            state.seconds,
            grouped(state.particles as u64),
            1e3 * state.spacing_m,
            state.volume_ml
        );
    }
    let _ = writeln!(
        text,
        "\n{:<11} {:<15} {:<5} {:>6} {:>6} {:>7} {:>7} {:>7} {:>8} {:>8} {:>7} {:>6}",
        "pixels",
        "filter",
        "aniso",
        "margin",
        "IoU",
        "depth",
        "(mean)",
        "normal",
        "reproj.",
        "flicker",
        "(norm.)",
        "volume"
    );
    for row in &found.rows {
        let f = &row.figures;
        let _ = writeln!(
            text,
            "{:<11} {:<15} {:<5} {:>6} {:>6.3} {:>7.3} {:>7.3} {:>6.1}° {:>8.3} {:>8.3} {:>6.1}° {:>6.3}",
            format!("{}×{}", row.size[0], row.size[1]),
            row.manner.filter,
            if row.manner.anisotropy { "yes" } else { "no" },
            row.margin_px,
            f.silhouette_iou,
            f.depth_rms_radii,
            f.depth_mean_radii,
            f.normal_angle_deg,
            f.reprojection_rms_radii,
            f.flicker_rms_radii,
            f.flicker_normal_deg,
            f.volume_ratio
        );
    }
    let _ = writeln!(
        text,
        "\nIoU and volume: the worst view; the rest: over all of them. Depth, reprojection and \
         flicker: rms in particle radii, at least `margin` pixels from silhouettes.\n{:.0} s",
        found.seconds
    );
    text
}
//! The renderer, for the judge.

use glam::Affine3A;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_render::{
    ColourBy, FrameDesc, LiquidDesc, RenderDesc, RenderError, Renderer, SceneDesc, Surface,
    SurfaceFilter, View,
};
use vitriol_shaders::Library;

use super::judge::{Draw, Drawn};
use super::report::Manner;
use super::states::State;
use crate::camera::{affine, laboratory, liquid_of};
use crate::failure::{Blame, Failure};

/// What is compared, the renderer's default first.
pub const MANNERS: [Manner; 5] = [
    Manner::new("narrow-range", true),
    Manner::new("curvature-flow", true),
    Manner::new("none", true),
    Manner::new("narrow-range", false),
    Manner::new("curvature-flow", false),
];

/// A renderer for each manner, at one resolution.
pub struct Screen {
    renderers: Vec<(Manner, Renderer)>,
}

impl Screen {
    /// Renderers for two eyes' pictures of `size` pixels of at most `particles`.
    ///
    /// # Errors
    /// What the device says.
    pub fn new(
        gpu: &Gpu,
        library: &Library,
        size: [u32; 2],
        particles: u32,
    ) -> Result<Self, Failure> {
        let renderer = |&manner: &Manner| {
            let desc = RenderDesc {
                views: 2,
                liquid: Some(LiquidDesc {
                    filter: match manner.filter {
                        "narrow-range" => SurfaceFilter::NarrowRange,
                        "curvature-flow" => SurfaceFilter::CurvatureFlow,
                        _ => SurfaceFilter::None,
                    },
                    anisotropic: manner.anisotropy,
                    ..LiquidDesc::new(particles)
                }),
                ..RenderDesc::film(size)
            };
            Ok((manner, Renderer::new(gpu, library, &desc).other()?))
        };
        Ok(Self {
            renderers: MANNERS
                .iter()
                .map(renderer)
                .collect::<Result<_, Failure>>()?,
        })
    }

    /// Takes up the vessels of a state's scene.
    ///
    /// # Errors
    /// What the device says.
    pub fn set_scene(&mut self, state: &State) -> Result<(), Failure> {
        let bare = SceneDesc {
            vessels: laboratory(state.world.scene()).vessels,
            ..SceneDesc::default()
        };
        for (_, renderer) in &mut self.renderers {
            renderer.set_scene(&bare).other()?;
        }
        Ok(())
    }
}

impl Draw for Screen {
    fn draw(
        &mut self,
        state: &State,
        eyes: &[View; 2],
        manner: Manner,
    ) -> Result<[Drawn; 2], Failure> {
        let asked = self.renderers.iter().find(|(other, _)| *other == manner);
        let Some((_, renderer)) = asked else {
            return Err(format!(
                "no renderer draws with the filter {}",
                manner.filter
            ))
            .other();
        };
        let vessels: Vec<Affine3A> = state.world.poses().iter().map(affine).collect();
        let frame = FrameDesc {
            views: eyes,
            vessels: &vessels,
            particles: None,
            liquid: Some(liquid_of(&state.world)),
            steam: None,
            colour_by: ColourBy::Acid,
            length_scale: state.world.scene().scale.length_scale as f32,
        };
        let draw = || -> Result<Vec<Surface>, RenderError> {
            let gpu = state.world.gpu();
            let mut rec = gpu.recorder(QueueKind::Main)?;
            renderer.record_surface(&mut rec, &frame)?;
            let surface = renderer.read_back_surface(&mut rec, &frame)?;
            gpu.submit(rec)?.wait()?;
            surface.views()
        };
        let drawn: Vec<Drawn> = draw().other()?.into_iter().map(drawn).collect();
        <[Drawn; 2]>::try_from(drawn)
            .map_err(|_| "the renderer did not draw two eyes")
            .other()
    }
}

/// A surface with a thickness for each of its pixels.
fn drawn(surface: Surface) -> Drawn {
    let [width, height] = surface.extent;
    let [across, down] = surface.thickness_extent;
    let (wider, higher) = (width.div_ceil(across), height.div_ceil(down));
    let way = |pixel: u32| {
        let (x, y) = (pixel % width / wider, pixel / width / higher);
        surface.thickness[(y * across + x) as usize]
    };
    Drawn {
        ways: (0..width * height).map(way).collect(),
        depth: surface.depth,
    }
}
//! The picture of the difference: for each state the true surface, the drawn
//! one, and what lies between.

use glam::DVec3;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use vitriol_render::reference::Picture;

use super::judge::Sample;
use crate::failure::{Blame, Failure};

/// Depth difference of the full colour, particle radii.
const FULL: f64 = 1.0;
/// Where there is nothing.
const NOTHING: [f64; 3] = [0.10, 0.10, 0.11];
/// Liquid that was not drawn, and what was drawn where there is none.
const MISSING: [f64; 3] = [0.10, 0.75, 0.25];
const TOO_MUCH: [f64; 3] = [0.85, 0.75, 0.10];
/// Drawn before and behind the truth.
const BEFORE: [f64; 3] = [0.15, 0.35, 0.95];
const BEHIND: [f64; 3] = [0.95, 0.20, 0.15];

/// A PNG with a row a sample: truth, drawn, difference.
///
/// # Errors
/// What the encoder says.
pub fn png(samples: &[Sample]) -> Result<Vec<u8>, Failure> {
    let size = samples.first().map_or([1, 1], |one| one.truth.rays.size());
    let [width, height] = size;
    let sheet = [3 * width, samples.len().max(1) * height];
    let mut bytes = vec![0; 3 * sheet[0] * sheet[1]];
    for (row, sample) in samples.iter().enumerate() {
        for pixel in 0..width * height {
            let colours = [
                shaded(&sample.truth, pixel),
                shaded(&sample.drawn, pixel),
                difference(sample, pixel),
            ];
            let (x, y) = (pixel % width, pixel / width + row * height);
            for (column, colour) in colours.iter().enumerate() {
                let first = 3 * (y * sheet[0] + column * width + x);
                let encoded = colour.map(|c| (255.0 * c.clamp(0.0, 1.0)).round() as u8);
                bytes[first..first + 3].copy_from_slice(&encoded);
            }
        }
    }
    let mut png = Vec::new();
    PngEncoder::new(&mut png)
        .write_image(
            &bytes,
            sheet[0] as u32,
            sheet[1] as u32,
            ExtendedColorType::Rgb8,
        )
        .other()?;
    Ok(png)
}

/// A matt surface in light from above and the viewer's left.
fn shaded(picture: &Picture, pixel: usize) -> [f64; 3] {
    if !picture.depth[pixel].is_finite() {
        return NOTHING;
    }
    let towards = -picture.rays.through(pixel).normalize();
    let light = (DVec3::new(-0.4, 0.8, 0.0) + towards).normalize();
    let normal = picture.normal[pixel];
    // The square root stands for the display's encoding.
    let level = (0.12 + 0.8 * normal.dot(light).max(0.0)).sqrt();
    [0.80, 0.88, 0.95].map(|c| c * level)
}

fn difference(sample: &Sample, pixel: usize) -> [f64; 3] {
    let (truth, drawn) = (sample.truth.depth[pixel], sample.drawn.depth[pixel]);
    match (truth.is_finite(), drawn.is_finite()) {
        (false, false) => NOTHING,
        (true, false) => MISSING,
        (false, true) => TOO_MUCH,
        (true, true) => {
            let off = (drawn - truth) / (0.5 * sample.spacing * FULL);
            let share = off.abs().min(1.0);
            let colour = if off < 0.0 { BEFORE } else { BEHIND };
            colour.map(|c| 1.0 + share * (c - 1.0))
        }
    }
}
//! The liquids that are looked at: built-in scenes and tracks through the
//! solver to stated times.

use glam::DVec3;
use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::{StepInput, World};
use vitriol_xr::PoseSource;
use vitriol_xr::track::TrackSource;

use crate::command::track;
use crate::experiment::grip;
use crate::failure::{Blame, Failure};
use crate::replay::Span;

use super::glassware::Glassware;

/// What a state is made of.
#[derive(Clone, Copy, Debug)]
pub struct StateSpec {
    /// Its name.
    pub name: &'static str,
    /// Built-in scene.
    pub scene: &'static str,
    /// Built-in track that moves it.
    pub track: &'static str,
    /// Simulated time, s.
    pub seconds: f64,
    /// What the views look at, stage, real metres.
    pub target: [f32; 3],
    /// Half the height of what they show there, metres.
    pub reach: f32,
}

/// A beaker at rest, a pour in its middle, and water on acid that boils. The
/// track closes its hand on the flask after 0.8 s, pours from 2.8 s to 5.2 s
/// and lets the flask drain.
pub const STATES: [StateSpec; 3] = [
    StateSpec {
        name: "still",
        scene: "two-flasks",
        track: "two-flasks",
        seconds: 0.5,
        target: [-0.12, 0.79, -0.40],
        reach: 0.06,
    },
    StateSpec {
        name: "pouring",
        scene: "two-flasks",
        track: "two-flasks",
        seconds: 4.2,
        target: [0.085, 0.85, -0.40],
        reach: 0.12,
    },
    StateSpec {
        name: "boiling",
        scene: "water-into-acid",
        track: "two-flasks",
        seconds: 5.2,
        target: [0.11, 0.84, -0.40],
        reach: 0.11,
    },
];

/// A liquid at one moment, on the device and here.
pub struct State {
    /// What it was made of.
    pub spec: StateSpec,
    /// The world; its device holds what the renderer draws.
    pub world: World,
    /// The particles that are there, stage, scene's unit.
    pub positions: Vec<DVec3>,
    /// Their volumes, scene's unit cubed.
    pub volumes: Vec<f64>,
    /// What is solid around them.
    pub glassware: Glassware,
}

/// Runs the states' scenes under `preset`.
///
/// # Errors
/// What scene, track or device say.
pub fn run(gpu: &Gpu, library: &Library, preset: Preset) -> Result<Vec<State>, Failure> {
    let of = |spec: &StateSpec| run_one(gpu, library, preset, *spec);
    STATES.iter().map(of).collect()
}

fn run_one(
    gpu: &Gpu,
    library: &Library,
    preset: Preset,
    spec: StateSpec,
) -> Result<State, Failure> {
    let scene = Scene::load(spec.scene).input()?.with_preset(preset);
    let track = track::load(spec.track)?;
    let seed = track.metadata.seed;
    let mut source = TrackSource::new(track);
    let mut world = World::new(gpu, library, &scene, seed).other()?;
    let length_scale = scene.scale.length_scale;
    let span = Span::covering(spec.seconds, scene.scale.frame_time);
    for step in 0..span.steps {
        let time = step as f64 * span.frame_time;
        let Some(frame) = source.next(step, time).other()? else {
            break;
        };
        let hands = frame.hands.each_ref().map(|hand| grip(hand, length_scale));
        world.step(&StepInput { hands }).other()?;
    }
    let state = world.solver().snapshot().other()?;
    let volume = scene.scale.spacing.powi(3);
    let present: Vec<usize> = (0..state.positions.len())
        .filter(|&slot| state.is_present(slot))
        .collect();
    let position = |&slot: &usize| {
        let [x, y, z, _] = state.positions[slot];
        DVec3::new(x.into(), y.into(), z.into())
    };
    let positions: Vec<DVec3> = present.iter().map(position).collect();
    let members = present.iter().map(|&slot| state.flask_of(slot));
    let glassware = Glassware::new(&scene, world.poses(), positions.clone(), members.collect());
    Ok(State {
        spec,
        volumes: present
            .iter()
            .map(|&slot| volume * state.volume_of(slot))
            .collect(),
        positions,
        glassware,
        world,
    })
}
//! Where the liquids are seen from.

use glam::{Affine3A, Vec3};
use vitriol_render::{Fov, View};

use super::states::StateSpec;

/// Distance between the eyes, metres: the median of grown people (Dodgson 2004).
const EYES_APART: f32 = 0.063;

/// By how much a frustum's outer half is wider than its mean, and the inner
/// half narrower; and the lower and upper one. A headset's are so.
const ASYMMETRY: [f32; 2] = [0.15, 0.1];

/// A head's way between two frames: 0.2 m/s at 90 Hz, metres.
const HEAD_STEP: f32 = 0.0022;

/// A place of the head.
#[derive(Clone, Copy, Debug)]
pub struct Stand {
    /// Its name.
    pub name: &'static str,
    /// From the target to between the eyes, metres.
    offset: [f32; 3],
}

/// Four places around what is looked at.
pub const STANDS: [Stand; 4] = [
    Stand {
        name: "before the bench",
        offset: [0.0, 0.18, 0.76],
    },
    Stand {
        name: "over the rim",
        offset: [-0.08, 0.34, 0.28],
    },
    Stand {
        name: "close",
        offset: [0.14, 0.08, 0.26],
    },
    Stand {
        name: "from the side",
        offset: [0.48, 0.02, 0.10],
    },
];

impl Stand {
    /// Left and right eye there, for pictures of `size` pixels, after so many
    /// frames of a head that moves to the right.
    pub fn eyes(&self, state: &StateSpec, size: [u32; 2], frame: u32) -> [View; 2] {
        let target = Vec3::from(state.target);
        let offset = Vec3::from(self.offset);
        let between = View::look_at(target + offset, target, Fov::symmetric(1.0, 1.0));
        let axes = between.stage_from_eye.matrix3;
        let middle = target + offset + Vec3::from(axes.x_axis) * (HEAD_STEP * frame as f32);
        let up = state.reach / offset.length();
        let right = up * size[0] as f32 / size[1] as f32;
        [-1.0, 1.0].map(|side: f32| {
            let eye = middle + Vec3::from(axes.x_axis) * (0.5 * side * EYES_APART);
            // Eyes look ahead side by side; their frusta are shifted to where
            // what they look at is.
            let towards = -0.5 * side * EYES_APART / offset.length();
            let wider = |outer: f32| 1.0 + ASYMMETRY[0] * outer;
            View {
                stage_from_eye: Affine3A {
                    matrix3: axes,
                    translation: eye.into(),
                },
                fov: Fov {
                    left: (towards - right * wider(-side)).atan(),
                    right: (towards + right * wider(side)).atan(),
                    up: (up * (1.0 - ASYMMETRY[1])).atan(),
                    down: -(up * (1.0 + ASYMMETRY[1])).atan(),
                },
            }
        })
    }
}
