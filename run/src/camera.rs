//! The film's camera: on a tripod, or where the user's eyes were.

use glam::{Affine3A, Vec3};
use vitriol_gpu::{Gpu, QueueKind, Recorder};
use vitriol_lesson::Language;
use vitriol_render::{
    ColourBy, Fov, Foveation, FrameDesc, LiquidDesc, ParticleSource, PassPicture, RenderDesc,
    RenderError, Renderer, SteamSource, Tint, View,
};
use vitriol_shaders::Library;
use vitriol_sim::chemistry::adiabatic::{Feed, mix};
use vitriol_sim::chemistry::table::SolutionTable;
use vitriol_sim::scene::{Liquid, PictureFilter, PictureRoom, PictureTint, Scene};
use vitriol_sim::world::World;
use vitriol_sound::Listener;
use vitriol_xr::Hand;

use crate::failure::{Blame, Failure, blame_render};
use crate::hands::Gloves;
use crate::legend::Words;
use crate::marks::{Carriers, Marks};
use crate::scenery::{affine, filter, has_acid, laboratory, liquid_of, shards, tint};
use crate::stage;
use crate::tools::{pane, tools};

/// Radius of a drawn particle over the spacing d: closes the gaps between them.
const DRAWN_RADIUS: f64 = 0.6;

/// A fall over this height (m, real) gives the speed at the end of the colour
/// map: about that from one flask's lip to another's floor.
const COLOURED_FALL: f64 = 0.075;

/// Vertical field of view from the head, degrees: 66° across at 16:9. A
/// headset's own 90° and more, flattened into a film, makes the glass small
/// and the bench's edges long.
pub const HEAD_FIELD: f32 = 40.0;

/// Distance between a grown person's eyes, metres: the mean of some thousand
/// adults (N. Dodgson, 2004).
pub const EYES_APART: f32 = 0.063;

/// What a film's colours stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colour {
    /// Liquid in glass
    Liquid,
    /// Speed of the particles
    Speed,
    /// Temperature, where the scene models heat
    Temperature,
    /// Acid mass fraction, where the scene models heat
    Acid,
}

impl Colour {
    /// The name as it is given and reported.
    pub fn name(self) -> &'static str {
        match self {
            Self::Liquid => "liquid",
            Self::Speed => "speed",
            Self::Temperature => "temperature",
            Self::Acid => "acid",
        }
    }

    /// Whether only a scene that models heat has it.
    pub fn is_of_heat(self) -> bool {
        matches!(self, Self::Temperature | Self::Acid)
    }
}

/// A place to look from, in the stage, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Where the eye is.
    pub eye: Vec3,
    /// What is in the picture's middle.
    pub target: Vec3,
    /// Field of view from top to bottom, degrees.
    pub field: f32,
}

impl Look {
    /// What is seen of a scene, in its own frame, real metres.
    fn view(&self, scene: &Scene, aspect: f32) -> View {
        let origin = stage::origin(scene);
        let fov = Fov::symmetric(self.field.to_radians(), aspect);
        View::look_at(self.eye - origin, self.target - origin, fov)
    }
}

/// What a camera is to take.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// Width and height of a view, pixels.
    pub extent: [u32; 2],
    /// Views side by side: 1, or 2 for both eyes.
    pub eyes: u32,
    /// The liquid ([`drawn_liquid`](crate::scenery::drawn_liquid)), where it is to look like liquid.
    pub liquid: Option<LiquidDesc>,
    /// Filter of its surface; `None` for the scene's.
    pub filter: Option<PictureFilter>,
    /// What tells the liquids apart; `None` for the scene's.
    pub tint: Option<PictureTint>,
    /// How bright the room is; `None` for the scene's.
    pub room: Option<PictureRoom>,
    /// Where it is seen from; `None` for the tripod.
    pub look: Option<Look>,
    /// Where it is sharp; `None` for everywhere, as in every film.
    pub foveation: Option<Foveation>,
    /// Language of its legend.
    pub language: Language,
}

impl Shot {
    /// One view of coloured particles.
    pub fn of(extent: [u32; 2]) -> Self {
        Self {
            extent,
            eyes: 1,
            liquid: None,
            filter: None,
            tint: None,
            room: None,
            look: None,
            foveation: None,
            language: Language::default(),
        }
    }
}

/// Takes pictures of a world.
pub struct Camera {
    pub(crate) renderer: Renderer,
    eyes: u32,
    tint: Tint,
    foveation: Option<Foveation>,
    /// Where it is and what it sees.
    pub view: View,
    /// What the colours of temperature run over.
    temperatures: ColourBy,
    gloves: Gloves,
    /// The user's hands, where it shows what the head sees.
    hands: [Hand; 2],
    /// What a thermometer shows, °C.
    celsius: f64,
    /// Drops that lie where they came to rest, and splashes on the goggles.
    marks: Marks,
    /// Whether it is where the user's eyes are, behind the goggles.
    pub(crate) is_head: bool,
    words: Words,
}

impl Camera {
    /// A camera for such pictures of that scene, where the shot sets it until [`Camera::follow`] takes it away.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(gpu: &Gpu, library: &Library, scene: &Scene, shot: &Shot) -> Result<Self, Failure> {
        let extent = shot.extent;
        let drawn_tint = tint(shot.tint.unwrap_or(scene.picture.tint));
        let desc = RenderDesc {
            views: shot.eyes,
            liquid: shot.liquid.map(|liquid| LiquidDesc {
                filter: shot.filter.map_or(liquid.filter, filter),
                tint: drawn_tint,
                ..liquid
            }),
            foveated: shot.foveation.is_some(),
            ..RenderDesc::film(extent)
        };
        let mut renderer = Renderer::new(gpu, library, &desc).map_err(blame_render)?;
        let mut drawn = scene.clone();
        drawn.picture.room = shot.room.unwrap_or(scene.picture.room);
        renderer.set_scene(&laboratory(&drawn)).other()?;
        let aspect = extent[0] as f32 / extent[1] as f32;
        let seen = |look: &Look| look.view(scene, aspect);
        Ok(Self {
            renderer,
            eyes: shot.eyes,
            tint: drawn_tint,
            foveation: shot.foveation,
            view: shot
                .look
                .as_ref()
                .map_or_else(|| tripod(scene, aspect), seen),
            temperatures: temperatures(scene),
            gloves: Gloves::of(scene),
            hands: Default::default(),
            celsius: 20.0,
            marks: Marks::default(),
            is_head: false,
            words: Words::of(shot.language)?,
        })
    }

    /// Puts the camera where a head is: `stage_from_view`, in real metres. Pictures of the liquid then have the splashes on the goggles;
    /// in colours of an attribute these would be read as values of it.
    pub fn follow(&mut self, stage_from_view: &vitriol_xr::Pose) {
        self.is_head = true;
        let [width, height] = self.renderer.extent();
        self.view = View {
            stage_from_eye: Affine3A::from_rotation_translation(
                stage_from_view.orientation.normalize(),
                stage_from_view.position,
            ),
            fov: Fov::symmetric(HEAD_FIELD.to_radians(), width as f32 / height as f32),
        };
    }

    /// Ears where its view is: the middle between its eyes.
    pub fn listener(&self) -> Listener {
        let (_, orientation, position) = self.view.stage_from_eye.to_scale_rotation_translation();
        Listener {
            position,
            orientation,
        }
    }

    /// Shows these hands, in the scene's stage, real metres.
    pub fn show_hands(&mut self, hands: [Hand; 2]) {
        self.hands = hands;
    }

    /// Shows a thermometer at this temperature, °C.
    pub fn show_temperature(&mut self, celsius: f64) {
        self.celsius = celsius;
    }

    /// Shows these drops where they came to rest, and the splashes on the goggles where it is behind them.
    pub fn show_marks(&mut self, marks: &Marks) {
        self.marks.clone_from(marks);
    }

    /// Shows what another camera does: hands, drops and thermometer.
    pub(crate) fn show_like(&mut self, other: &Self) {
        self.hands.clone_from(&other.hands);
        self.marks.clone_from(&other.marks);
        self.celsius = other.celsius;
    }

    /// The world as it is now, coloured by speed where it has not what is asked
    /// for: rows from the top, sRGB-encoded RGBA bytes.
    /// Waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn shoot(&self, world: &World, colour: Colour) -> Result<Vec<u8>, Failure> {
        let mut picture = self.shoot_bare(world, colour)?;
        let width = (self.eyes * self.renderer.extent()[0]) as usize;
        let colours = (colour != Colour::Liquid).then(|| self.colour_by(world, colour));
        let tinted = self.tint == Tint::Artificial && has_acid(world.scene());
        (self.words).draw(&mut picture, width, colours, tinted);
        Ok(picture)
    }

    /// The same without a legend.
    ///
    /// # Errors
    /// An error of the device.
    pub fn shoot_bare(&self, world: &World, colour: Colour) -> Result<Vec<u8>, Failure> {
        let gpu = world.gpu();
        let mut rec = gpu.recorder(QueueKind::Main).other()?;
        self.record(&mut rec, world, colour)?;
        let picture = self.renderer.read_back(&mut rec).other()?;
        gpu.submit(rec).and_then(|ticket| ticket.wait()).other()?;
        picture.side_by_side().other()
    }

    /// Records the picture of the world as it is after what was recorded
    /// before on that queue.
    ///
    /// # Errors
    /// An error of the device.
    pub fn record(&self, rec: &mut Recorder, world: &World, colour: Colour) -> Result<(), Failure> {
        self.with_frame(world, colour, |frame| self.renderer.record(rec, frame))
    }

    /// Records the two parts of a picture of liquid for two queues, as [`Renderer::record_shapes`] describes.
    ///
    /// # Errors
    /// An error of the device.
    pub fn record_apart(
        &self,
        shapes: &mut Recorder,
        picture: &mut Recorder,
        world: &World,
        slot: usize,
    ) -> Result<(), Failure> {
        self.with_frame(world, Colour::Liquid, |frame| {
            self.renderer.record_shapes(shapes, frame, slot)?;
            self.renderer.record_picture(picture, frame, slot)
        })
    }

    /// What each pass of a picture of the liquid leaves behind, of the world as it
    /// is now. Waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn passes(&self, world: &World) -> Result<Vec<PassPicture>, Failure> {
        let gpu = world.gpu();
        let mut rec = gpu.recorder(QueueKind::Main).other()?;
        let passes = self.with_frame(world, Colour::Liquid, |frame| {
            self.renderer.record(&mut rec, frame)?;
            self.renderer.read_back_passes(&mut rec, frame)
        })?;
        gpu.submit(rec).and_then(|ticket| ticket.wait()).other()?;
        passes.pictures().other()
    }

    fn with_frame<T>(
        &self,
        world: &World,
        colour: Colour,
        f: impl FnOnce(&FrameDesc<'_>) -> Result<T, RenderError>,
    ) -> Result<T, Failure> {
        let scale = &world.scene().scale;
        let vessels: Vec<Affine3A> = world.poses().iter().map(affine).collect();
        let solver = world.solver();
        let colour_by = self.colour_by(world, colour);
        let attributes = match (colour_by, solver.heat()) {
            (ColourBy::Temperature(..) | ColourBy::Acid, Some(heat)) => heat,
            _ => solver.velocities(),
        };
        let particles = ParticleSource {
            positions: solver.positions(),
            attributes,
            count: solver.count(),
            radius: (DRAWN_RADIUS * scale.spacing) as f32,
        };
        let liquid = (colour == Colour::Liquid).then(|| liquid_of(world));
        let bones = self.gloves.worn(world, &self.hands, &[None; 2]);
        let resting = self.marks.drawn(Carriers::of(world, &bones));
        let tools = tools(world, self.celsius);
        let frame = FrameDesc {
            extent: None,
            views: &self.views(),
            vessels: &vessels,
            shards: &shards(world),
            particles: liquid.is_none().then_some(particles),
            hands: bones.each_ref().map(Vec::as_slice),
            tools: &tools,
            resting: &resting,
            liquid,
            steam: solver
                .puffs()
                .filter(|_| liquid.is_some())
                .map(|puffs| SteamSource {
                    puffs,
                    count: vitriol_sim::solver::PUFFS,
                    dew: solver.dew(),
                }),
            panel: None,
            sign: None,
            pane: pane(world),
            shown: 1.0,
            goggles: match self.is_head && liquid.is_some() {
                true => self.marks.goggles(),
                false => 0.0,
            },
            part_of: None,
            foveation: self.foveation,
            colour_by,
            length_scale: scale.length_scale as f32,
        };
        f(&frame).other()
    }

    /// What particles' colours stand for: speed where the world has not what is
    /// asked for.
    fn colour_by(&self, world: &World, colour: Colour) -> ColourBy {
        match (colour, world.solver().heat()) {
            (Colour::Temperature, Some(_)) => self.temperatures,
            (Colour::Acid, Some(_)) => ColourBy::Acid,
            _ => speeds(world.scene()),
        }
    }

    /// The camera's view, or that of the eyes to its left and right.
    fn views(&self) -> Vec<View> {
        let eye = |index: u32| {
            let aside = (index as f32 - 0.5 * (self.eyes - 1) as f32) * EYES_APART;
            View {
                stage_from_eye: self.view.stage_from_eye
                    * Affine3A::from_translation(Vec3::X * aside),
                ..self.view
            }
        };
        (0..self.eyes).map(eye).collect()
    }
}

/// What a scene's particles are coloured by where they are exported, as in a film of temperature: their temperature, or their
/// speed (scene's unit per second) where no heat is modelled.
pub fn particle_colours(world: &World) -> ColourBy {
    match world.solver().heat() {
        Some(_) => temperatures(world.scene()),
        None => speeds(world.scene()),
    }
}

/// The range of a scene's speeds, scene's unit per second.
fn speeds(scene: &Scene) -> ColourBy {
    let scale = &scene.scale;
    let fall = COLOURED_FALL / scale.length_scale;
    ColourBy::Speed((2.0 * scale.gravity.abs() * fall).sqrt() as f32)
}

/// The range of a scene's temperatures: from the coldest that there is at the
/// start to half as much again as the paper's boiling point, or to the hottest
/// that its liquids can make of each other; whole tens.
fn temperatures(scene: &Scene) -> ColourBy {
    let liquids = || scene.liquids.iter();
    let ambient = [
        scene.paper.and_then(|paper| paper.T_a),
        scene.physical.and_then(|physical| physical.ambient),
    ];
    let starts = || liquids().map(|liquid| liquid.temperature);
    let coldest = starts()
        .chain(ambient.into_iter().flatten())
        .fold(f64::INFINITY, f64::min);
    let mut hottest = starts().fold(coldest + 60.0, f64::max);
    if let Some(boiling_point) = scene.paper.and_then(|paper| paper.T_B) {
        hottest = hottest.max(1.5 * boiling_point);
    } else if scene.physical.is_some() {
        let table = SolutionTable::new();
        for (a, b) in liquids().flat_map(|a| liquids().map(move |b| (a, b))) {
            for share in (1..20).map(|n| 0.05 * f64::from(n)) {
                let feed = |liquid: &Liquid, mass: f64| Feed {
                    mass,
                    acid: liquid.acid_fraction,
                    temperature: liquid.temperature,
                };
                let mixed = mix(&table, &[feed(a, share), feed(b, 1.0 - share)]);
                hottest = mixed.map_or(hottest, |mixed| hottest.max(mixed.temperature));
            }
        }
    }
    ColourBy::Temperature(
        (10.0 * (coldest / 10.0).floor()) as f32,
        (10.0 * (hottest / 10.0).ceil()) as f32,
    )
}

/// At real size the view of a bench before a standing user; else one that has
/// the vessels, and as much room above them for what is lifted, in its picture.
pub fn tripod(scene: &Scene, aspect: f32) -> View {
    let scale = scene.scale.length_scale as f32;
    if scale == 1.0 || scene.flasks.is_empty() {
        return View::bench(aspect);
    }
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for flask in &scene.flasks {
        let foot = flask.stage_from_flask.position * scale;
        let reach = Vec3::new(1.0, 0.0, 1.0) * (flask.profile.outer_radius() as f32 * scale);
        low = low.min(foot - reach);
        high = high.max(foot + reach + Vec3::Y * (flask.profile.rim_height() as f32 * scale));
    }
    let lifted = 2.0 * (high.y - low.y);
    let middle = 0.5 * (low + high);
    let target = Vec3::new(middle.x, low.y + 0.4 * lifted, middle.z);
    let vertical = 20.5_f32.to_radians();
    let half = (0.6 * lifted).max(0.7 * (high.x - low.x) / aspect);
    let eye = target + Vec3::new(0.0, 0.25, 1.0).normalize() * (half / (0.5 * vertical).tan());
    View::look_at(eye, target, Fov::symmetric(vertical, aspect))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::DVec3;
    use vitriol_sim::scene::{Preset, Scene};

    use super::*;

    /// A scene that stands elsewhere in the stage is seen from the stage's place: its target is in the picture's middle, and
    /// half the field above that its upper edge.
    #[test]
    fn look_is_of_the_stage() {
        let text = crate::scenes::Scenes::default();
        let mut scene: Scene = text.get("tomato-soup").unwrap().with_preset(Preset::Fast);
        scene.origin = DVec3::new(2.0, 0.0, -4.0);
        let shift = (scene.origin * scene.scale.length_scale).as_vec3();
        let look = Look {
            eye: Vec3::new(0.1, 1.1, 0.0),
            target: Vec3::new(0.1, 0.8, -0.4),
            field: 30.0,
        };
        let view = look.view(&scene, 1.0);
        let clip = view.clip_from_scaled(1.0);
        let seen = |at: Vec3| clip.project_point3(at - shift);
        assert!(seen(look.target).truncate().length() < 1e-5);
        // Upright to the way from eye to target (0, −0.3, −0.4), whose length is 0.5 m.
        let edge = look.target + 0.5 * 15.0_f32.to_radians().tan() * Vec3::new(0.0, 0.8, -0.6);
        let edge = seen(edge);
        assert!(edge.x.abs() < 1e-5 && (edge.y + 1.0).abs() < 1e-4, "{edge}");
    }
}
