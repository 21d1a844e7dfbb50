//! What stands in the room, and its meshes on the device.

use glam::{Vec2, Vec3};
use vitriol_gpu::{Buffer, Gpu, Recorder, bytes_of_elements};
use vitriol_shaders::layout;

use crate::RenderError;
use crate::mesh::{Material, Mesh};

/// Heights at which the shaders have a vessel's inner radius.
const INNER_RADII: usize = 16;

/// A vessel's glass, in the vessel's frame (+Y along its axis).
#[derive(Clone, Debug, PartialEq)]
pub struct VesselDesc {
    /// The surface that the liquid touches: points (r, y), metres, from the
    /// axis up to the rim.
    pub inner: Vec<[f64; 2]>,
    /// The outer surface: points (r, y), metres, from the axis up to the rim.
    pub outer: Vec<[f64; 2]>,
    /// Heights of its graduation marks, from the lowest up; every second one
    /// is longer.
    pub marks: Vec<f64>,
}

/// Length of a long and of a short mark over the outer radius.
const MARK_LENGTHS: [f32; 2] = [0.22, 0.4];

/// Width of a mark's strip over the outer radius: 1.4 mm, a line of 0.7 mm, on
/// a beaker of 250 mL.
const MARK_WIDTH: f32 = 0.04;

/// How far enamel stands off the glass, over the outer radius.
const MARK_LIFT: f32 = 1.003;

impl VesselDesc {
    /// The wall as a closed surface of revolution, and its marks.
    fn mesh(&self) -> Mesh {
        let outline: Vec<Vec2> = self
            .outer
            .iter()
            .chain(self.inner.iter().rev())
            .map(|&[r, y]| Vec2::new(r as f32, y as f32))
            .collect();
        let mut mesh = Mesh::default();
        mesh.add_revolution(&outline, Material::Glass);
        for (&height, long) in self.marks.iter().zip([0, 1].into_iter().cycle()) {
            let radius = radius_at(&self.outer, height) as f32;
            let length = MARK_LENGTHS[long] * radius;
            mesh.add_mark(
                MARK_LIFT * radius,
                height as f32,
                length,
                MARK_WIDTH * radius,
            );
        }
        mesh
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
        let bounds = self.bounds();
        layout::Vessel {
            radii: std::array::from_fn(|row| std::array::from_fn(|n| radius(4 * row + n))),
            inner_floor: low as f32,
            rim: high as f32,
            outer: bounds.radius,
            wall: low as f32 - bounds.bottom,
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

/// A box along the stage's axes, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxDesc {
    /// Corner of the least coordinates.
    pub min: Vec3,
    /// Corner of the greatest coordinates.
    pub max: Vec3,
}

/// What does not change from frame to frame, in the scene's unit (metres, or
/// what the frame's `length_scale` makes of it).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneDesc {
    /// Glass, in the order of the frame's poses.
    pub vessels: Vec<VesselDesc>,
    /// The bench.
    pub table: Option<BoxDesc>,
    /// The room, seen from within: floor, walls and ceiling.
    pub room: Option<BoxDesc>,
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
            room: box_of([-2.4, 0.0, -1.7], [2.4, 2.7, 2.4]),
        }
    }
}

/// A mesh on the device.
pub(crate) struct DeviceMesh {
    pub(crate) vertices: Buffer,
    pub(crate) indices: Buffer,
    pub(crate) index_count: u32,
}

impl DeviceMesh {
    fn new(gpu: &Gpu, rec: &mut Recorder, label: &str, mesh: &Mesh) -> Result<Self, RenderError> {
        let buffer =
            |name: &str, bytes: u64| Buffer::storage(gpu, &format!("{label} {name}"), bytes);
        let uploaded = Self {
            vertices: buffer("vertices", size_of_val(&mesh.vertices[..]) as u64)?,
            indices: buffer("indices", bytes_of_elements::<u32>(mesh.indices.len()))?,
            index_count: mesh.indices.len() as u32,
        };
        rec.upload(&uploaded.vertices, &mesh.vertices)?;
        rec.upload(&uploaded.indices, &mesh.indices)?;
        Ok(uploaded)
    }
}

/// A vessel on the device.
pub(crate) struct Vessel {
    pub(crate) mesh: DeviceMesh,
    pub(crate) bounds: Bounds,
    /// Its inner surface, without the pose.
    pub(crate) inner: layout::Vessel,
}

/// The scene on the device.
pub(crate) struct Scene {
    pub(crate) vessels: Vec<Vessel>,
    pub(crate) table: Option<BoxDesc>,
    pub(crate) room: Option<BoxDesc>,
}

impl Scene {
    /// Uploads the meshes and waits for it; a scene is set once.
    pub(crate) fn new(gpu: &Gpu, desc: &SceneDesc) -> Result<Self, RenderError> {
        let mut rec = gpu.recorder(vitriol_gpu::QueueKind::Main)?;
        let scene = Self {
            vessels: desc
                .vessels
                .iter()
                .map(|vessel| {
                    Ok(Vessel {
                        mesh: DeviceMesh::new(gpu, &mut rec, "vessel", &vessel.mesh())?,
                        bounds: vessel.bounds(),
                        inner: vessel.inner(),
                    })
                })
                .collect::<Result<_, RenderError>>()?,
            table: desc.table,
            room: desc.room,
        };
        gpu.submit(rec)?.wait()?;
        Ok(scene)
    }
}
