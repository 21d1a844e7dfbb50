//! Hands, and the tools that they handle: round cones about their bones, joined smoothly.

use glam::Vec3;
use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::{Library, ShaderId, hands, layout};

use crate::RenderError;
use crate::compute::compute;
use crate::frame::FrameDesc;
use crate::solids::Solids;
use crate::tiles::{Class, Tiles};

/// Bones that a hand has at most, and tools in all, as in `common/picture/bones.wgsl`.
pub const MOST_BONES: usize = 32;

/// Distance over which the bones of a hand join smoothly, metres: they add up to a quarter of it where they meet, 1 mm. With
/// more, fingers that touch grow together.
pub const JOINED: f32 = 0.004;

/// Reflectance where acid has charred a glove. Ours: about the sRGB colour (62, 42, 28).
const CHARRED: Vec3 = Vec3::new(0.048, 0.023, 0.011);

/// What a bone is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finish {
    /// A glove.
    Glove,
    /// Its cuff, which is lighter.
    Cuff,
    /// A ray of light, that a hand points with.
    Ray,
    /// Something to hold on to, that is not of the hand.
    Handle,
    /// The same while a hand is at it.
    HandleAtHand,
    /// A hand without a glove.
    Skin,
    /// A glass rod.
    Rod,
    /// A thermometer's bulb.
    Column,
    /// A thermometer's stem, of which only tools have one.
    Scale(Scale),
    /// Frame and strap of goggles.
    Frame,
    /// Woven cotton.
    Cloth,
    /// A box of card.
    Card,
    /// Brushed steel.
    Steel,
}

impl Finish {
    /// Reflectance of red, green and blue, and how much it shines by itself instead. Ours: glove and cuff are in the room's light
    /// about the sRGB colours (70, 110, 170) and (120, 150, 190). The others are the panel's amber, which neither glass nor
    /// liquids have.
    fn tint(self) -> ([f32; 3], f32) {
        match self {
            Self::Glove => ([0.075, 0.130, 0.245], 0.0),
            Self::Cuff => ([0.180, 0.240, 0.330], 0.0),
            Self::Ray => ([0.90, 0.52, 0.11], 1.0),
            Self::Handle => ([0.55, 0.28, 0.05], 0.0),
            Self::HandleAtHand => ([0.90, 0.52, 0.11], 0.6),
            Self::Skin => ([0.420, 0.220, 0.140], 0.0),
            Self::Rod | Self::Scale(_) => ([0.550, 0.610, 0.620], 0.0),
            Self::Column => ([0.450, 0.020, 0.020], 0.0),
            Self::Frame => ([0.060, 0.075, 0.085], 0.0),
            Self::Cloth => ([0.620, 0.560, 0.300], 0.0),
            Self::Card => ([0.480, 0.480, 0.460], 0.0),
            Self::Steel => ([0.380, 0.390, 0.400], 0.0),
        }
    }
}

/// A thermometer's scale on its stem, which begins at the bone's first end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The lowest and the highest mark, whole °C.
    pub celsius: [f32; 2],
    /// How far they are from the middle of the bone's first end, metres.
    pub heights: [f32; 2],
    /// What it shows, °C: the column's end is there.
    pub reading: f32,
}

/// One bone of a glove, or what is drawn like one: the convex hull of two spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bone {
    /// The spheres' middles in the stage, metres.
    pub ends: [Vec3; 2],
    /// Their radii, metres.
    pub radii: [f32; 2],
    /// What it is of.
    pub finish: Finish,
    /// How black acid has made it, 0 to 1.
    pub stain: f32,
}

/// The passes that draw hands.
pub(crate) struct Hands {
    mark_pass: ComputePipeline,
    light_pass: ComputePipeline,
    /// The same in coarse tiles, where frames may be foveated.
    coarse_pass: Option<ComputePipeline>,
    bones: Buffer,
    views: u32,
}

impl Hands {
    pub(crate) fn new(
        gpu: &Gpu,
        library: &Library,
        views: u32,
        foveated: bool,
    ) -> Result<Self, RenderError> {
        let light = |class: Class, side: f64| {
            let constants = [("CLASS", f64::from(class as u32)), ("SIDE", side)];
            compute(gpu, library, hands::LIGHT, &constants)
        };
        let coarse = || light(Class::CoarseHands, 2.0);
        let bytes = bytes_of_elements::<layout::Bone>(GROUPS * MOST_BONES);
        Ok(Self {
            mark_pass: compute(gpu, library, hands::MARK, &[])?,
            light_pass: light(Class::Hands, 1.0)?,
            coarse_pass: foveated.then(coarse).transpose()?,
            bones: Buffer::storage(gpu, "bones", bytes)?,
            views,
        })
    }

    /// Whether any of these shaders is one of these.
    pub(crate) fn uses(changed: &[ShaderId]) -> bool {
        changed
            .iter()
            .any(|id| id.path().starts_with("render/hands/"))
    }

    /// Records which tiles they are in; these are marked with everything else by then and not listed yet.
    pub(crate) fn record_marks(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        frame: &FrameDesc<'_>,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        let mut bones = [layout::Bone::default(); GROUPS * MOST_BONES];
        for (slots, hand) in bones.chunks_mut(MOST_BONES).zip(groups(frame)) {
            for (slot, bone) in slots.iter_mut().zip(drawn(hand)) {
                let [a, b] = bone.ends.map(|end| (end / frame.length_scale).to_array());
                let [radius_a, radius_b] = bone.radii.map(|radius| radius / frame.length_scale);
                let (tint, glow) = bone.finish.tint();
                let stain = bone.stain.clamp(0.0, 1.0);
                let tint = Vec3::from(tint).lerp(CHARRED, stain).to_array();
                *slot = layout::Bone {
                    a,
                    radius_a,
                    b,
                    radius_b,
                    tint,
                    glow,
                };
            }
        }
        rec.upload(&self.bones, &bones)?;
        rec.group("hands", |rec| {
            rec.pass(&self.mark_pass)
                .label("hands")
                .uniform("frame", uniforms)
                .read("bones", &self.bones)
                .write("tiles", tiles.marks())
                .constants(&run(frame))
                .workgroups([(GROUPS * MOST_BONES) as u32, self.views, 1])
        })
    }

    /// Records their depth and light over those of the spheres; the tiles are listed.
    pub(crate) fn record_light(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        frame: &FrameDesc<'_>,
        solids: &Solids,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        rec.group("hands", |rec| {
            let coarse = self.coarse_pass.as_ref();
            let coarse = coarse.filter(|_| frame.foveation.is_some());
            let passes = [
                (Class::Hands, Some(&self.light_pass)),
                (Class::CoarseHands, coarse),
            ];
            for (class, pipeline) in passes {
                let Some(pipeline) = pipeline else { continue };
                let pass = rec
                    .pass(pipeline)
                    .label("hands")
                    .uniform("frame", uniforms)
                    .read("bones", &self.bones)
                    .write("depths", &solids.depths)
                    .write("nearest", &solids.nearest)
                    .constants(&run(frame));
                tiles.over(class, pass)?;
            }
            Ok(())
        })
    }
}

/// The left hand, the right one, and tools, as in `common/picture/bones.wgsl`.
const GROUPS: usize = 3;

fn groups<'a>(frame: &FrameDesc<'a>) -> [&'a [Bone]; GROUPS] {
    let [left, right] = frame.hands;
    [left, right, frame.tools]
}

fn run(frame: &FrameDesc<'_>) -> layout::HandsRun {
    let bones = || groups(frame).into_iter().flat_map(drawn);
    let thinnest = bones().flat_map(|bone| bone.radii).fold(FARTHEST, f32::min);
    let scales = drawn(frame.tools).enumerate();
    let mut scales = scales.filter_map(|(index, bone)| match bone.finish {
        Finish::Scale(scale) => Some((index as u32, scale)),
        _ => None,
    });
    // All zeros, of which nothing is drawn.
    let nothing = Scale {
        celsius: [0.0; 2],
        heights: [0.0; 2],
        reading: 0.0,
    };
    let (scale_bone, scale) = scales.next().unwrap_or((MOST_BONES as u32, nothing));
    let [from, to] = scale.heights.map(|height| height / frame.length_scale);
    let [low, high] = scale.celsius;
    layout::HandsRun {
        scale_bone,
        scale_from: from,
        scale_degree: (to - from) / (high - low).max(1.0),
        scale_low: low,
        scale_high: high,
        reading: scale.reading.clamp(low, high.max(low)),
        counts: groups(frame).map(|hand| drawn(hand).count() as u32),
        joined: JOINED / frame.length_scale,
        over: frame.has_spheres().into(),
        thinnest: thinnest / frame.length_scale,
    }
}

/// Farthest that a bone may be from the stage's origin, metres. Beyond, or where it is no number, no tracker
/// knows the hand.
const FARTHEST: f32 = 100.0;

fn drawn(hand: &[Bone]) -> impl Iterator<Item = &Bone> {
    let is_drawn = |bone: &&Bone| {
        let near = bone.ends.iter().all(|end| end.length() < FARTHEST);
        near && bone
            .radii
            .iter()
            .all(|radius| *radius > 0.0 && *radius < FARTHEST)
    };
    hand.iter().filter(is_drawn)
}
