//! Hands, and the tools that they handle: round cones about their bones, joined smoothly.

use glam::Vec3;
use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::{Library, hands, layout};

use crate::RenderError;
use crate::bone::{Bone, CHARRED, Finish, JOINED, MOST_BONES, Scale};
use crate::compute::compute;
use crate::frame::FrameDesc;
use crate::solids::Solids;
use crate::tiles::{Class, Tiles};

/// The passes that draw hands and tools.
pub(crate) struct Hands {
    mark_pass: ComputePipeline,
    light_pass: ComputePipeline,
    /// Draws them in tiles of which blocks are shaded; only where frames may be foveated.
    coarse_pass: Option<ComputePipeline>,
    bones: Buffer,
}

impl Hands {
    pub(crate) fn new(gpu: &Gpu, library: &Library, foveated: bool) -> Result<Self, RenderError> {
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
        })
    }

    /// Records the pass that marks the tiles with hands or tools, after the other marks and before the lists.
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
        let views = frame.views.len() as u32;
        rec.group("hands", |rec| {
            rec.pass(&self.mark_pass)
                .label("hands")
                .uniform("frame", uniforms)
                .read("bones", &self.bones)
                .write("tiles", tiles.marks())
                .constants(&run(frame))
                .workgroups([(GROUPS * MOST_BONES) as u32, views, 1])
        })
    }

    /// Records their depth and light over those of the spheres, after the lists of tiles.
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
    // All zeros, which draws nothing.
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

/// Farthest that a bone may be from the stage's origin, metres. A bone beyond, or at no finite place, comes from a tracker that has lost
/// the hand.
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
