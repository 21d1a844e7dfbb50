//! Flasks, table and floor as the shaders' buffers.

use super::solids::Solids;
use super::spec::SolverSpec;
use super::transfer::upload;
use super::wall_heat;
use crate::flask::{PlaneMap, Side, VolumeMap};
use crate::pose::Pose;
use vitriol_gpu::{Buffer, Gpu, GpuError, Recorder};
use vitriol_shaders::layout;

/// Entries of the half-space table over one support radius; its error is
/// then below 3e-5 of a density.
pub const PLANE_ENTRIES: usize = 257;

/// The buffers that `common/glass/vessel.wgsl` and `common/glass/ground.wgsl` read.
pub struct Vessels {
    pub(super) flasks: Buffer,
    pub(super) radii: Buffer,
    pub(super) maps: Buffer,
    pub(super) distances: Buffer,
    pub(super) glass_rings: Buffer,
    pub(super) plane: Buffer,
    pub(super) solids: Solids,
}

impl Vessels {
    /// Tabulates radii, volume maps and the tables that the scene's forces read, and
    /// records their upload.
    pub fn new(gpu: &Gpu, rec: &mut Recorder, spec: &SolverSpec<'_>) -> Result<Self, GpuError> {
        let support = spec.parameters.support_radius;
        let mut flasks = Vec::new();
        let mut radii: Vec<f32> = Vec::new();
        let mut maps: Vec<[f32; 4]> = Vec::new();
        let mut distances: Vec<f32> = Vec::new();
        let surface = spec.parameters.surface.as_ref();
        for (index, profile) in spec.flasks.iter().enumerate() {
            let outside = VolumeMap::new(profile, Side::Outside, support);
            let table = profile.radius_table();
            let height = profile.rim_height() - profile.floor_height();
            flasks.push(layout::Flask {
                floor: profile.floor_height() as f32,
                rim: profile.rim_height() as f32,
                mouth: profile.mouth_radius() as f32,
                outer: profile.outer_radius() as f32,
                wall: profile.wall() as f32,
                radius_scale: ((table.len() - 1) as f64 / height) as f32,
                radius_first: radii.len() as u32,
                radius_count: table.len() as u32,
                inside_first: maps.len() as u32,
                outside_first: (maps.len() + outside.nodes.len()) as u32,
                distance_first: distances.len() as u32,
                map_columns: outside.columns as u32,
                map_rows: outside.rows as u32,
                map_scale: (1.0 / outside.spacing) as f32,
                map_base: outside.base as f32,
                wetting: surface.map_or(0.0, |s| s.of_glass(index).cos()) as f32,
            });
            radii.extend(table);
            if spec.solids.is_none() {
                // Both sides' maps have one size.
                let inside = VolumeMap::new(profile, Side::Inside, support);
                maps.extend(inside.nodes);
                maps.extend_from_slice(&outside.nodes);
            }
            distances.extend(outside.nodes.iter().map(|node| node[0]));
        }
        let plane = PlaneMap::new(support).table(PLANE_ENTRIES);
        Ok(Self {
            flasks: upload(gpu, rec, "flasks", &flasks)?,
            radii: upload(gpu, rec, "radii", &radii)?,
            maps: upload(gpu, rec, "maps", &maps)?,
            distances: upload(gpu, rec, "distances", &distances)?,
            glass_rings: upload(gpu, rec, "glass_rings", &wall_heat::constants(spec))?,
            plane: upload(gpu, rec, "plane", &plane)?,
            solids: Solids::new(gpu, rec, spec.solids.unwrap_or_default(), support)?,
        })
    }
}

/// A pose in the shaders' layout.
pub(super) fn flask_pose(stage_from_flask: Pose) -> layout::FlaskPose {
    layout::FlaskPose {
        position: stage_from_flask.position.extend(0.0).to_array(),
        orientation: stage_from_flask.orientation.to_array(),
    }
}
