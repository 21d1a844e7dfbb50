//! The picture for both eyes or for a screen, drawn while the next steps are solved.

use glam::Affine3A;
use vitriol_gpu::{Buffer, CopyRegion, Gpu, Image, QueueKind, Recorder, Ticket};
use vitriol_render::{
    Bone, ColourBy, Fov, Foveation, FrameDesc, HalfDepth, LiquidDesc, Panel, RenderDesc,
    RenderError, Renderer, RestingDrop, SteamSource, View,
};
use vitriol_run::hands::{Gloves, Joints};
use vitriol_run::scenery::{affine, drawn_liquid, laboratory, liquid_of, shards};
use vitriol_run::{Blame, Failure};
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::PUFFS;
use vitriol_sim::world::World;
use vitriol_xr::{Headset, Pose, PoseFrame, Targets};

use super::foveating::{self, Foveating, may_foveate};
use super::panel::{SIZE, scene_from_panel};

/// Most pictures under way: one is shown and one is drawn. With more the processor would be farther ahead, and the
/// poses that it draws with older by then.
const UNDER_WAY: usize = 2;

/// What pictures are made for.
#[derive(Clone, Debug)]
pub struct Eyes {
    /// How many there are: two eyes, or one picture on a screen.
    pub views: u32,
    /// Width and height of each, pixels.
    pub extent: [u32; 2],
    /// Width and height of each picture of a second pair, the inset, pixels, where there is one.
    pub inset: Option<[u32; 2]>,
    /// By eye, corners of the triangles that the lens hides.
    pub hidden: [Vec<[f32; 2]>; 2],
    /// Where they are sharp; without it everywhere, for as long as frames fit.
    pub foveating: Option<Foveating>,
}

impl Eyes {
    /// The pictures of a headset.
    pub fn of(headset: &dyn Headset, foveating: Option<Foveating>) -> Self {
        Self {
            views: headset.eyes().clamp(1, 2),
            extent: headset.extent(),
            inset: headset.inset().map(|inset| inset.extent),
            hidden: headset.hidden_area(),
            foveating,
        }
    }

    /// Width and height of images that take any of the pictures, pixels: one pair after the other is drawn in them.
    fn largest(&self) -> [u32; 2] {
        let inset = self.inset.unwrap_or(self.extent);
        [0, 1].map(|side| self.extent[side].max(inset[side]))
    }

    /// What is done in a frame of them, of what the governor `gave_way`. The runtime's foveation leaves nothing to ours: the
    /// eyes' own pictures are coarse, and the inset is what is looked at.
    pub fn foveating(&self, gave_way: bool) -> Foveating {
        match self.inset {
            Some(_) => Foveating::Off,
            None => foveating::now(self.foveating, gave_way),
        }
    }
}

/// Draws a world for two eyes or for a screen, with the hands.
pub struct Picture {
    /// How many views it has.
    views: usize,
    renderer: Renderer,
    half_depth: HalfDepth,
    /// The steam as each slot's picture draws it: a copy, since the solver goes on meanwhile.
    puffs: Option<[Buffer; 2]>,
    /// The water that condensed on glass as each slot's picture draws it: a copy too.
    dew: Option<[Buffer; 2]>,
    gloves: Gloves,
    /// The last pictures, the oldest first; at most [`UNDER_WAY`].
    under_way: Vec<Ticket>,
    drawn: usize,
}

/// The parts of a world that a picture is made to draw.
#[derive(Clone, Copy, Debug)]
pub struct Subject {
    /// Its liquid.
    liquid: LiquidDesc,
    /// Bytes of the puffs of steam, where there are any.
    puffs: Option<u64>,
    /// Bytes of the water on glass, where there is any.
    dew: Option<u64>,
}

impl Subject {
    /// The parts of this world.
    pub fn of(world: &World) -> Self {
        Self {
            liquid: drawn_liquid(world),
            puffs: world.solver().puffs().map(Buffer::bytes),
            dew: world.solver().dew().map(Buffer::bytes),
        }
    }
}

/// From where a pair of pictures is seen.
#[derive(Clone, Copy)]
pub struct Outlook {
    /// Width and height as drawn, pixels: at most those that pictures are made for.
    pub extent: [u32; 2],
    /// Both eyes in the scene's stage, real metres. Of a screen, and of what is [drawn again](Picture::draw_again), the first is drawn.
    pub views: [View; 2],
}

/// What one picture shows.
pub struct Sight<'a> {
    /// The views from the eyes.
    pub eyes: Outlook,
    /// The views of the inset, where there is one.
    pub inset: Option<Outlook>,
    /// The bones of the hands.
    pub hands: [&'a [Bone]; 2],
    /// The bones of the tools.
    pub tools: &'a [Bone],
    /// Drops that lie where they came to rest.
    pub resting: &'a [RestingDrop],
    /// The panel.
    pub panel: Option<Panel<'a>>,
    /// A sign.
    pub sign: Option<Panel<'a>>,
    /// How much acid is on the user's goggles, 0 to 1.
    pub goggles: f32,
    /// Share of the light that is shown, 0 to 1.
    pub shown: f32,
    /// Where it is sharp; `None` for everywhere.
    pub foveation: Option<Foveation>,
}

impl Picture {
    /// Leaves out of the pictures what the lenses hide; waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn hide(&mut self, hidden: &[Vec<[f32; 2]>; 2]) -> Result<(), Failure> {
        let [left, right] = hidden;
        let masks: [&[[f32; 2]]; 2] = [left, right];
        let masks = &masks[..self.views];
        self.renderer.set_visibility_mask(masks).other()
    }

    /// Pictures of a scene.
    ///
    /// # Errors
    /// An error of the device.
    pub fn new(
        gpu: &Gpu,
        library: &Library,
        scene: &Scene,
        subject: Subject,
        eyes: &Eyes,
    ) -> Result<Self, Failure> {
        let desc = RenderDesc {
            views: eyes.views,
            liquid: Some(subject.liquid),
            foveated: eyes.inset.is_none() && may_foveate(eyes.foveating, scene),
            ..RenderDesc::film(eyes.largest())
        };
        let mut renderer = Renderer::new(gpu, library, &desc).other()?;
        renderer.set_scene(&laboratory(scene)).other()?;
        let copies = |label, bytes: Option<u64>| {
            let copy = |bytes| Buffer::storage(gpu, label, bytes).other();
            let both = |bytes| -> Result<_, Failure> { Ok([copy(bytes)?, copy(bytes)?]) };
            bytes.map(both).transpose()
        };
        let mut picture = Self {
            views: desc.views as usize,
            half_depth: HalfDepth::new(gpu, library, desc.extent, desc.views).other()?,
            renderer,
            puffs: copies("puffs, drawn", subject.puffs)?,
            dew: copies("dew, drawn", subject.dew)?,
            gloves: Gloves::of(scene),
            under_way: Vec::new(),
            drawn: 0,
        };
        picture.hide(&eyes.hidden)?;
        Ok(picture)
    }

    /// Takes over from `before`, whose pictures may still be under way.
    pub fn follow(&mut self, before: Self) {
        self.under_way = before.under_way;
    }

    /// Submits the part of a picture that reads the particles as they are after the last step,
    /// behind it on its queue; `also` records what else reads them.
    ///
    /// # Errors
    /// An error of the device.
    pub fn shapes(
        &self,
        gpu: &Gpu,
        world: &World,
        also: impl FnOnce(&mut Recorder) -> Result<(), Failure>,
    ) -> Result<Ticket, Failure> {
        let slot = self.drawn % 2;
        let mut rec = gpu.recorder(QueueKind::Async).other()?;
        let record = |frame: &FrameDesc<'_>| self.renderer.record_shapes(&mut rec, frame, slot);
        self.with_frame((world, slot), None, record)?;
        let solver = world.solver();
        for (from, copies) in [(solver.puffs(), &self.puffs), (solver.dew(), &self.dew)] {
            if let (Some(from), Some(copies)) = (from, copies) {
                let whole = CopyRegion {
                    from: 0,
                    to: 0,
                    bytes: from.bytes(),
                };
                rec.copy(from, &copies[slot], &[whole]).other()?;
            }
        }
        also(&mut rec)?;
        // Wait on the device for the picture that used this slot before.
        let before = self.under_way.iter().rev().nth(1);
        gpu.submit_after(rec, before.as_slice()).other()
    }

    /// Submits the rest of the picture behind its `shapes`, and its copy to `targets`; `before` records what is to be done
    /// before it.
    ///
    /// # Errors
    /// An error of the device.
    pub fn draw(
        &mut self,
        world: &World,
        shapes: &Ticket,
        sight: &Sight<'_>,
        targets: &Targets,
        before: impl FnOnce(&mut Recorder) -> Result<(), Failure>,
    ) -> Result<Ticket, Failure> {
        let gpu = world.gpu();
        let mut rec = gpu.recorder(QueueKind::Main).other()?;
        before(&mut rec)?;
        // The inset first: what stays in the renderer's image is the eyes' picture, which others look at.
        if let (Some(outlook), Some(inset)) = (&sight.inset, &targets.inset) {
            let images = (&inset.colour, inset.depth.as_ref());
            let whole = Some(&sight.eyes.views[..self.views]);
            self.pair(&mut rec, world, sight, (outlook, whole), images)?;
        }
        let images = (&targets.colour, targets.depth.as_ref());
        self.pair(&mut rec, world, sight, (&sight.eyes, None), images)?;
        let picture = gpu.submit_after(rec, &[shapes]).other()?;
        self.drawn += 1;
        self.under_way.push(picture.clone());
        Ok(picture)
    }

    /// Submits one more picture of what was drawn last, seen from elsewhere, behind it, with the first view alone: the first layer of
    /// [`Self::image`] has it until the next is drawn. Lenses hide nothing of it.
    ///
    /// # Errors
    /// An error of the device.
    pub fn draw_again(&mut self, world: &World, sight: &Sight<'_>) -> Result<Ticket, Failure> {
        let mut rec = world.gpu().recorder(QueueKind::Main).other()?;
        let whole = Some(&sight.eyes.views[..1]);
        // The other one is of the next picture.
        let slot = (self.drawn + 1) % 2;
        self.record(&mut rec, (world, slot), sight, (&sight.eyes, whole))?;
        let again = world.gpu().submit(rec).other()?;
        // Its slot is in use until this one is done.
        if let Some(last) = self.under_way.last_mut() {
            *last = again.clone();
        }
        Ok(again)
    }

    /// Records one pair of pictures, which may be a part of those views; as many as there are of these.
    fn record(
        &self,
        rec: &mut Recorder,
        (world, slot): (&World, usize),
        sight: &Sight<'_>,
        (outlook, part_of): (&Outlook, Option<&[View]>),
    ) -> Result<(), Failure> {
        let views = part_of.map_or(self.views, <[View]>::len);
        let record = |frame: &FrameDesc<'_>| {
            let frame = FrameDesc {
                extent: Some(outlook.extent),
                views: &outlook.views[..views],
                part_of,
                ..*frame
            };
            self.renderer.record_picture(rec, &frame, slot)
        };
        self.with_frame((world, slot), Some(sight), record)
    }

    /// Records one pair of pictures, which may be a part of those views, and its copy to a headset's images of colour and depth.
    fn pair(
        &self,
        rec: &mut Recorder,
        world: &World,
        sight: &Sight<'_>,
        (outlook, part_of): (&Outlook, Option<&[View]>),
        (colour, depth): (&Image, Option<&Image>),
    ) -> Result<(), Failure> {
        let (renderer, half) = (&self.renderer, &self.half_depth);
        let slot = self.drawn % 2;
        self.record(rec, (world, slot), sight, (outlook, part_of))?;
        rec.copy_corner(renderer.image(), colour).other()?;
        if let Some(depth) = depth {
            let whole = colour.desc().extent;
            half.record(rec, renderer, outlook.extent, whole).other()?;
            rec.copy_to_image(half.depth(), depth).other()?;
        }
        Ok(())
    }

    /// Waits until at most two pictures are under way. Only while no frame is open.
    ///
    /// # Errors
    /// An error of the device.
    pub fn keep_up(&mut self) -> Result<(), Failure> {
        while self.under_way.len() > UNDER_WAY {
            self.under_way.remove(0).wait().other()?;
        }
        Ok(())
    }

    /// The bones of the hands as `seen` in the scene's stage, and as they are tracked there, where they are.
    pub fn gloves(
        &self,
        world: &World,
        seen: Option<&PoseFrame>,
        joints: &[Option<Joints>; 2],
    ) -> [Vec<Bone>; 2] {
        seen.map_or_else(Default::default, |seen| {
            self.gloves.worn(world, &seen.hands, joints)
        })
    }

    /// The colour image, a layer a view.
    pub fn image(&self) -> &Image {
        self.renderer.image()
    }

    fn with_frame(
        &self,
        (world, slot): (&World, usize),
        sight: Option<&Sight<'_>>,
        f: impl FnOnce(&FrameDesc<'_>) -> Result<(), RenderError>,
    ) -> Result<(), Failure> {
        let scale = world.scene().scale.length_scale as f32;
        let vessels: Vec<Affine3A> = world.poses().iter().map(affine).collect();
        let nowhere = View {
            stage_from_eye: Affine3A::IDENTITY,
            fov: Fov::symmetric(1.0, 1.0),
        };
        let nowhere = [nowhere; 2];
        let frame = FrameDesc {
            extent: None,
            views: &nowhere[..self.views],
            vessels: &vessels,
            shards: &shards(world),
            particles: None,
            hands: sight.map_or([&[]; 2], |sight| sight.hands),
            tools: sight.map_or(&[], |sight| sight.tools),
            resting: sight.map_or(&[], |sight| sight.resting),
            liquid: Some(liquid_of(world)),
            steam: self.puffs.as_ref().map(|puffs| SteamSource {
                puffs: &puffs[slot],
                count: PUFFS,
                dew: self.dew.as_ref().map(|dew| &dew[slot]),
            }),
            panel: sight.and_then(|sight| sight.panel),
            sign: sight.and_then(|sight| sight.sign),
            pane: vitriol_run::pane(world),
            shown: sight.map_or(1.0, |sight| sight.shown),
            goggles: sight.map_or(0.0, |sight| sight.goggles),
            part_of: None,
            foveation: sight.and_then(|sight| sight.foveation),
            colour_by: ColourBy::Acid,
            length_scale: scale,
        };
        f(&frame).other()
    }
}

/// A pose as the renderer takes it.
fn affine_of(pose: &Pose) -> Affine3A {
    Affine3A::from_rotation_translation(pose.orientation.normalize(), pose.position)
}

/// The panel as the renderer takes it, in the scene's stage.
pub fn panel(image: &Image) -> Panel<'_> {
    Panel {
        image,
        stage_from_panel: affine_of(&scene_from_panel()),
        size: SIZE,
    }
}

/// An eye as the renderer takes it, in the scene's stage.
pub fn eye(view: &vitriol_xr::View, stage_from_scene: &Pose) -> View {
    let scene_from_eye = stage_from_scene.inverse().compose(&view.stage_from_eye);
    View {
        stage_from_eye: affine_of(&scene_from_eye),
        fov: Fov {
            left: view.fov.left,
            right: view.fov.right,
            up: view.fov.up,
            down: view.fov.down,
        },
    }
}
