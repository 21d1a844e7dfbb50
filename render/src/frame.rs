//! Description of one frame, and its uniforms.

use glam::{Affine3A, Mat4, Vec3};
use vitriol_shaders::layout;

use crate::RenderError;
use crate::bone::{Bone, MOST_BONES};
use crate::camera::{Fov, NEAR, View};
use crate::colour_map::ColourMap;
use crate::desc::RenderDesc;
use crate::fovea::Foveation;
use crate::panel::{Pane, Panel, pane_from_stage, panel_from_stage};
use crate::resting::RestingDrop;
use crate::scene::{MOST_SHARDS, Scene, ShardDesc};
use crate::source::{LiquidSource, ParticleSource, SteamSource, check_count};
use crate::tiles::{MOST_PUFFS, tiles_of};
use crate::tints::Tint;

/// Side of a cell of bubbles, metres as drawn: wider than most bubbles are, and a tenth of a beaker. In metres, since the cost of a ray is
/// bounded by the number of cells that it goes through (`MOST_CELLS` in `common/picture/bubble_light.wgsl`), and a vessel is as large as
/// it is drawn.
const BUBBLE_CELL: f32 = 0.006;

/// Side of a cell of bubbles in a scene's unit, which is drawn as `length_scale` metres.
pub(crate) fn bubble_cell(length_scale: f32) -> f32 {
    BUBBLE_CELL / length_scale
}

/// Share of the window's light that a vessel with liquid in it keeps away:
/// the liquid bends most of it elsewhere, and the glass reflects some.
const VESSEL_OPACITY: f32 = 0.5;

/// The attribute that a particle's colour shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColourBy {
    /// Its speed: the map runs from rest to this speed (scene's unit per
    /// second) and stays at its end beyond.
    Speed(f32),
    /// Its temperature: the map runs from the first to the second, °C.
    Temperature(f32, f32),
    /// Its acid mass fraction: the map runs from 0 to 1.
    Acid,
}

impl ColourBy {
    /// The attribute's map.
    pub fn map(self) -> ColourMap {
        match self {
            Self::Speed(_) => ColourMap::Lapaz,
            Self::Temperature(..) => ColourMap::Plasma,
            Self::Acid => ColourMap::Viridis,
        }
    }

    /// The attribute's values at the map's ends.
    pub fn range(self) -> [f32; 2] {
        match self {
            Self::Speed(fastest) => [0.0, fastest],
            Self::Temperature(coldest, hottest) => [coldest, hottest],
            Self::Acid => [0.0, 1.0],
        }
    }

    /// Number of the attribute in the shader.
    pub(crate) fn attribute(self) -> u32 {
        match self {
            Self::Speed(_) => 0,
            Self::Temperature(..) => 1,
            Self::Acid => 2,
        }
    }
}

/// Description of one frame.
#[derive(Clone, Copy)]
pub struct FrameDesc<'a> {
    /// Width and height of each view as drawn, pixels, if that is less than the renderer's: the picture is then in the upper left corner
    /// of its images, and the pixels beside it are undefined.
    pub extent: Option<[u32; 2]>,
    /// The eyes: as many as the renderer has views, or fewer, of which it draws the first. What its images have of the others stays then.
    pub views: &'a [View],
    /// `stage_from_vessel` of each vessel of the scene, rigid, in the scene's
    /// unit.
    pub vessels: &'a [Affine3A],
    /// Shards of broken vessels, which themselves are far away then; of more than 16 the first.
    pub shards: &'a [ShardDesc],
    /// Particles to be coloured by an attribute; `None` for none.
    pub particles: Option<ParticleSource<'a>>,
    /// The bones of the user's left and right hand, at most [`MOST_BONES`] each, in any order; none of a hand that
    /// is not seen.
    pub hands: [&'a [Bone]; 2],
    /// Bones of the tools, together at most [`MOST_BONES`].
    pub tools: &'a [Bone],
    /// Drops that lie where they came to rest, of more than [`MOST_RESTING`](crate::MOST_RESTING) the first. They are drawn as drops of
    /// spray are, where the liquid has spray.
    pub resting: &'a [RestingDrop],
    /// Liquid that looks like liquid, where the renderer was made for it;
    /// `None` for none.
    pub liquid: Option<LiquidSource<'a>>,
    /// Steam over all of the picture; `None` for none.
    pub steam: Option<SteamSource<'a>>,
    /// A panel in the scene; `None` for none.
    pub panel: Option<Panel<'a>>,
    /// A sign in the scene: it shows the disc of its image that touches the sides; `None` for none.
    pub sign: Option<Panel<'a>>,
    /// A pane of glass in the scene, seen from both sides; `None` for none.
    pub pane: Option<Pane>,
    /// Share of the light that is shown, 0 to 1: less than 1 where the picture fades.
    pub shown: f32,
    /// How much acid is on the user's goggles, 0 to 1.
    pub goggles: f32,
    /// The eyes' own views, where `views` are parts of them, such as an inset: splashes on the goggles are where the eyes see them, and no
    /// lens hides anything ([`Renderer::set_visibility_mask`](crate::Renderer::set_visibility_mask)). `None` where `views` are the eyes'
    /// own.
    pub part_of: Option<&'a [View]>,
    /// Region in which the picture is sharp; `None` for everywhere.
    pub foveation: Option<Foveation>,
    /// The attribute that the particles' colours show.
    pub colour_by: ColourBy,
    /// Metres of the stage that a unit of the scene is drawn as: 1 at real
    /// size. Views stay in metres.
    pub length_scale: f32,
}

impl<'a> FrameDesc<'a> {
    /// A frame of an empty scene at real size.
    pub fn empty(views: &'a [View]) -> Self {
        Self {
            extent: None,
            views,
            vessels: &[],
            shards: &[],
            particles: None,
            hands: [&[]; 2],
            tools: &[],
            resting: &[],
            liquid: None,
            steam: None,
            panel: None,
            sign: None,
            pane: None,
            shown: 1.0,
            goggles: 0.0,
            part_of: None,
            foveation: None,
            colour_by: ColourBy::Speed(1.0),
            length_scale: 1.0,
        }
    }

    /// Width and height of each view as drawn, in images of `held` pixels.
    pub(crate) fn extent(&self, held: [u32; 2]) -> [u32; 2] {
        self.extent.unwrap_or(held)
    }

    /// Whether it has coloured particles or spray.
    pub(crate) fn has_spheres(&self) -> bool {
        let bubbles = self.liquid.and_then(|liquid| liquid.bubbles);
        self.particles.is_some() || bubbles.is_some_and(|bubbles| bubbles.spray.is_some())
    }

    /// Checks that the frame fits the scene, the views and its own buffers.
    pub(crate) fn check(&self, scene: &Scene, desc: &RenderDesc) -> Result<(), RenderError> {
        let held = desc.extent;
        let extent = self.extent(held);
        if extent.contains(&0) || extent[0] > held[0] || extent[1] > held[1] {
            return Err(RenderError::Extent { extent, held });
        }
        if self.foveation.is_some() && !desc.foveated {
            return Err(RenderError::NotFoveated);
        }
        let whole = self.part_of.unwrap_or(self.views);
        let views = self.views.len().clamp(1, desc.views as usize);
        let counts = [
            ("views", self.views.len(), views),
            ("whole views", whole.len(), views),
            ("vessel poses", self.vessels.len(), scene.vessels.len()),
        ];
        for (what, given, wanted) in counts {
            if given != wanted {
                return Err(RenderError::Count {
                    what,
                    given,
                    wanted,
                });
            }
        }
        let groups = [self.hands[0], self.hands[1], self.tools];
        if let Some(hand) = groups.iter().find(|hand| hand.len() > MOST_BONES) {
            let (given, most) = (hand.len(), MOST_BONES);
            return Err(RenderError::TooManyBones { given, most });
        }
        if let Some(steam) = self.steam {
            let held = steam.puffs.bytes() / size_of::<layout::Puff>() as u64;
            let held = held.min(MOST_PUFFS.into());
            check_count(steam.count, steam.puffs.label(), held)?;
        }
        if let Some(particles) = self.particles {
            for buffer in [particles.positions, particles.attributes] {
                check_count(particles.count, buffer.label(), buffer.bytes() / 16)?;
            }
        }
        Ok(())
    }

    /// The frame's uniforms for a renderer's images, of which the lenses
    /// may hide a part.
    pub(crate) fn uniforms(&self, scene: &Scene, desc: &RenderDesc, hides: bool) -> layout::Frame {
        let held = desc.extent;
        let extent = self.extent(held);
        let tint = desc.liquid.map_or(Tint::default(), |liquid| liquid.tint);
        let [water, acid] = tint.absorptions();
        let [tile_columns, tile_rows] = tiles_of(extent);
        let corner = |corner: Option<Vec3>| corner.unwrap_or(Vec3::ZERO).to_array();
        let mut frame = layout::Frame {
            colour_map: self.colour_by.map().linear_entries(),
            metres_per_unit: self.length_scale,
            table_min: corner(scene.table.map(|table| table.min)),
            table_max: corner(scene.table.map(|table| table.max)),
            room_min: corner(scene.room.map(|room| room.min)),
            room_max: corner(scene.room.map(|room| room.max)),
            bubble_cell: bubble_cell(self.length_scale),
            spacing: self.liquid.map_or(0.0, |liquid| liquid.spacing),
            extent: extent.map(|side| side as f32),
            held: held.map(|side| side as f32),
            tile_columns,
            tile_rows,
            view_count: self.views.len() as u32,
            hides: hides.into(),
            water,
            acid,
            shown: self.shown,
            goggles: self.goggles,
            window_level: scene.light.window,
            sky_level: scene.light.sky,
            exposure: scene.light.exposure,
            furnished: scene.furnished.into(),
            panel_from_stage: panel_from_stage(self.panel.as_ref(), self.length_scale),
            sign_from_stage: panel_from_stage(self.sign.as_ref(), self.length_scale),
            pane_from_stage: pane_from_stage(self.pane, self.length_scale),
            ..layout::Frame::default()
        };
        for (slot, plate) in frame.plates.iter_mut().zip(&scene.plates) {
            let [x, z] = plate.middle;
            *slot = [x, z, plate.radius, 0.0];
        }
        let whole = self.part_of.unwrap_or(self.views);
        for ((slot, view), whole) in frame.views.iter_mut().zip(self.views).zip(whole) {
            *slot = eye(view, self.length_scale, extent);
            slot.in_picture = in_picture(&view.fov, &whole.fov);
        }
        let vessels = self.vessels.iter().zip(&scene.vessels);
        let slots = frame.blockers.iter_mut().zip(&mut frame.vessels);
        for ((blocker, slot), (stage_from_vessel, vessel)) in slots.zip(vessels) {
            let bounds = vessel.bounds;
            // The lower sphere hardly rises above the foot, so that the shadow
            // closes on it; the rim's light comes through above.
            let on_axis = |y: f32| stage_from_vessel.transform_point3(Vec3::Y * y);
            let foot = bounds.bottom + 0.5 * bounds.radius;
            blocker.foot = on_axis(foot).to_array();
            blocker.top = on_axis((bounds.top - bounds.radius).max(foot)).to_array();
            blocker.radius = bounds.radius;
            blocker.opacity = VESSEL_OPACITY;
            *slot = layout::Vessel {
                vessel_from_stage: Mat4::from(stage_from_vessel.inverse()).to_cols_array_2d(),
                ..vessel.shape
            };
            frame.blocker_count += 1;
        }
        frame.glass_count = frame.blocker_count;
        for shard in self.shards.iter().take(MOST_SHARDS) {
            let slot = frame.vessels.get_mut(frame.glass_count as usize);
            let (Some(slot), Some(vessel)) = (slot, scene.vessels.get(shard.vessel)) else {
                continue;
            };
            let vessel_from_stage = shard.stage_from_vessel.inverse();
            *slot = layout::Vessel {
                vessel_from_stage: Mat4::from(vessel_from_stage).to_cols_array_2d(),
                piece: shard.piece + 1,
                base: shard.base,
                ..vessel.shape
            };
            frame.glass_count += 1;
        }
        frame
    }

    /// Distance of each view's near plane, in the scene's unit.
    pub(crate) fn nears(&self) -> Vec<f32> {
        vec![NEAR / self.length_scale; self.views.len()]
    }
}

/// Upper left corner, width and height of the picture of `part` in units of the picture of `whole`: (0, 0, 1, 1) for the whole itself, to
/// the bit.
fn in_picture(part: &Fov, whole: &Fov) -> [f32; 4] {
    let [part, whole] =
        [part, whole].map(|fov| [fov.left, fov.right, fov.up, fov.down].map(f32::tan));
    let (width, height) = (whole[1] - whole[0], whole[3] - whole[2]);
    [
        (part[0] - whole[0]) / width,
        (part[2] - whole[2]) / height,
        (part[1] - part[0]) / width,
        (part[3] - part[2]) / height,
    ]
}

/// Uniforms of a view.
fn eye(view: &View, length_scale: f32, [width, height]: [u32; 2]) -> layout::View {
    let axes = view.stage_from_eye.matrix3;
    let fov = view.fov;
    let (left, right) = (fov.left.tan(), fov.right.tan());
    let (up, down) = (fov.up.tan(), fov.down.tan());
    layout::View {
        clip_from_stage: view.clip_from_scaled(length_scale).to_cols_array_2d(),
        eye: (Vec3::from(view.stage_from_eye.translation) / length_scale).to_array(),
        near: NEAR / length_scale,
        corner: (axes * Vec3::new(left, up, -1.0)).to_array(),
        focal: width as f32 / (right - left),
        across: (axes * Vec3::new((right - left) / width as f32, 0.0, 0.0)).to_array(),
        down: (axes * Vec3::new(0.0, (down - up) / height as f32, 0.0)).to_array(),
        ..layout::View::default()
    }
}
