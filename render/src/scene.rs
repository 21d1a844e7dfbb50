//! Vessels and furniture of a picture, and their outlines on the device.

use glam::{Affine3A, Vec3};
use vitriol_gpu::{Buffer, Gpu, Ticket};
use vitriol_shaders::layout;

use crate::RenderError;
use crate::light::RoomLight;
use crate::outline::segments;
use crate::print::Label;

/// Most vessels and shards of a picture: a tile has a bit for each.
pub(crate) const MOST_VESSELS: usize = 8;
pub(crate) const MOST_SHARDS: usize = 16;

/// Heights at which the shaders have a vessel's inner radius.
const INNER_RADII: usize = 16;

/// A vessel's glass, in the vessel's frame (+Y along its axis).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VesselDesc {
    /// The surface that the liquid touches: points (r, y), metres, from the
    /// axis up to the rim.
    pub inner: Vec<[f64; 2]>,
    /// The outer surface: points (r, y), metres, from the axis up to the rim.
    pub outer: Vec<[f64; 2]>,
    /// Heights of its graduation marks, from the lowest up; every second one
    /// is longer.
    pub marks: Vec<f64>,
    /// Volumes up to the marks, mL, in the same order; printed beside every second mark, the longer ones. Empty for none.
    pub volumes: Vec<u32>,
    /// Its label; `None` for none.
    pub label: Option<Label>,
}

/// Length of a short and of a long mark over the outer radius.
const MARK_LENGTHS: [f32; 2] = [0.22, 0.4];

/// Width of a mark's line over the outer radius: 0.7 mm on a beaker of 250 mL.
const MARK_WIDTH: f32 = 0.02;

impl VesselDesc {
    /// Its marks for `common/picture/glass_light.wgsl`: height, half the angle, half the strip's width, which is twice the line's, and the
    /// number.
    fn marks(&self) -> Vec<[f32; 4]> {
        // The uppermost number has the unit beside it.
        let last = (self.volumes.len() / 2 * 2).checked_sub(1);
        let mark = |(index, (&height, length)): (usize, (&f64, &f32))| {
            let radius = radius_at(&self.outer, height) as f32;
            let volume = self.volumes.get(index).filter(|_| index % 2 == 1);
            let unit = if last == Some(index) { 0.5 } else { 0.0 };
            let number = volume.map_or(0.0, |volume| *volume as f32 + unit);
            [height as f32, 0.5 * length, MARK_WIDTH * radius, number]
        };
        let lengths = MARK_LENGTHS.iter().cycle();
        let marks = self.marks.iter().zip(lengths).enumerate();
        marks.map(mark).collect()
    }

    /// The inner surface as rays meet it, without its pose.
    fn inner(&self) -> layout::Vessel {
        let ends = (self.inner.first(), self.inner.last());
        let (low, high) = (ends.0.map_or(0.0, |p| p[1]), ends.1.map_or(0.0, |p| p[1]));
        let radius = |index: usize| {
            // The floor's own disc has the radius that the wall begins with.
            let share = (index as f64).max(0.05) / (INNER_RADII - 1) as f64;
            radius_at(&self.inner, low + share * (high - low)) as f32
        };
        // Half-way up, where neither base nor rim is.
        let middle = 0.5 * (low + high);
        layout::Vessel {
            radii: std::array::from_fn(|row| std::array::from_fn(|n| radius(4 * row + n))),
            inner_floor: low as f32,
            rim: high as f32,
            outer: self.bounds().radius,
            wall: (radius_at(&self.outer, middle) - radius_at(&self.inner, middle)).max(0.0) as f32,
            ..layout::Vessel::default()
        }
    }

    /// Largest radius, lowest and highest point.
    fn bounds(&self) -> Bounds {
        let mut bounds = Bounds {
            radius: 0.0,
            bottom: f32::INFINITY,
            top: f32::NEG_INFINITY,
        };
        for &[r, y] in &self.outer {
            bounds.radius = bounds.radius.max(r as f32);
            bounds.bottom = bounds.bottom.min(y as f32);
            bounds.top = bounds.top.max(y as f32);
        }
        bounds
    }
}

/// Radius of an outline at a height.
fn radius_at(outline: &[[f64; 2]], y: f64) -> f64 {
    let above = outline.partition_point(|p| p[1] < y);
    let below = above.checked_sub(1).and_then(|below| outline.get(below));
    match (below, outline.get(above)) {
        (Some(a), Some(b)) => a[0] + (y - a[1]) / (b[1] - a[1]).max(1e-12) * (b[0] - a[0]),
        (Some(end), None) | (None, Some(end)) => end[0],
        (None, None) => 0.0,
    }
}

/// The cylinder that a vessel fits in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub(crate) radius: f32,
    pub(crate) bottom: f32,
    pub(crate) top: f32,
}

/// A shard of a vessel of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShardDesc {
    /// Index of its vessel; a vessel that does not exist has no shards.
    pub vessel: usize,
    /// 0 its base, 1 to 3 its wall above that, a third of a turn each, from +X to +Z on.
    pub piece: u32,
    /// Height of the base's upper edge, in the scene's unit.
    pub base: f32,
    /// Pose that the vessel would have if it were whole with this shard, rigid, in the scene's unit.
    pub stage_from_vessel: Affine3A,
}

/// A box along the stage's axes, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxDesc {
    /// Corner of the least coordinates.
    pub min: Vec3,
    /// Corner of the greatest coordinates.
    pub max: Vec3,
}

/// A round hot plate that is let into the table's top, in the scene's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlateDesc {
    /// Its middle: x and z in the stage.
    pub middle: [f32; 2],
    /// Its radius.
    pub radius: f32,
}

/// The parts of a picture that do not change from frame to frame, in the scene's unit (metres, or as the frame's `length_scale` defines
/// it).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneDesc {
    /// Glass, in the order of the frame's poses.
    pub vessels: Vec<VesselDesc>,
    /// The bench.
    pub table: Option<BoxDesc>,
    /// Hot plates in its top; of more than 8 the first.
    pub plates: Vec<PlateDesc>,
    /// The room, seen from within: floor, walls and ceiling.
    pub room: Option<BoxDesc>,
    /// Brightness of the room.
    pub light: RoomLight,
    /// Whether the room has more than its window: benches, shelf, fume hood and signs, and a sink in the table.
    pub furnished: bool,
}

impl SceneDesc {
    /// A bench and a room about a user who stands at the origin and looks
    /// along −Z; the bench's top is at `table_top`, metres. For vessels drawn
    /// at `length_scale` metres per unit of the simulation, all is in that
    /// unit.
    pub fn laboratory(vessels: Vec<VesselDesc>, table_top: f32, length_scale: f32) -> Self {
        let box_of = |min: [f32; 3], max: [f32; 3]| {
            Some(BoxDesc {
                min: Vec3::from(min) / length_scale,
                max: Vec3::from(max) / length_scale,
            })
        };
        Self {
            vessels,
            table: box_of([-0.8, table_top - 0.04, -0.78], [0.8, table_top, -0.12]),
            plates: Vec::new(),
            room: box_of([-1.6, 0.0, -1.7], [2.4, 2.7, 2.4]),
            light: RoomLight::DAY,
            furnished: true,
        }
    }
}

/// A vessel on the device.
pub(crate) struct Vessel {
    pub(crate) bounds: Bounds,
    /// Its outline's uniforms, without the pose.
    pub(crate) shape: layout::Vessel,
}

/// The scene on the device.
pub(crate) struct Scene {
    pub(crate) vessels: Vec<Vessel>,
    /// Segments and marks of all vessels.
    pub(crate) outlines: Buffer,
    pub(crate) table: Option<BoxDesc>,
    pub(crate) plates: Vec<PlateDesc>,
    pub(crate) room: Option<BoxDesc>,
    pub(crate) light: RoomLight,
    pub(crate) furnished: bool,
}

impl Scene {
    /// Uploads the outlines, which are there with the ticket.
    pub(crate) fn new(gpu: &Gpu, desc: &SceneDesc) -> Result<(Self, Ticket), RenderError> {
        let (given, most) = (desc.vessels.len(), MOST_VESSELS);
        if given > most {
            return Err(RenderError::TooManyVessels { given, most });
        }
        let mut table: Vec<[f32; 4]> = Vec::new();
        let mut add = |rows: Vec<[f32; 4]>| {
            let first = table.len() as u32;
            table.extend(rows);
            [first, table.len() as u32]
        };
        let vessels = desc
            .vessels
            .iter()
            .map(|vessel| Vessel {
                bounds: vessel.bounds(),
                shape: layout::Vessel {
                    segments: add(segments(&vessel.outer, &vessel.inner)),
                    marks: add(vessel.marks()),
                    label: (vessel.label.as_ref()).map_or(0, |label| add(label.rows())[0]),
                    ..vessel.inner()
                },
            })
            .collect();
        // A buffer has at least one row.
        add(vec![[0.0; 4]]);
        let outlines = Buffer::storage(gpu, "outlines", size_of_val(&table[..]) as u64)?;
        let uploaded = gpu.write_ahead(&outlines, &table)?;
        let scene = Self {
            vessels,
            outlines,
            table: desc.table,
            plates: desc.plates.clone(),
            room: desc.room,
            light: desc.light,
            furnished: desc.furnished,
        };
        Ok((scene, uploaded))
    }
}
