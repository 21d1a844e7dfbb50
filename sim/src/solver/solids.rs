//! The paper's boundary particles (Akinci et al. 2012) as the shaders'
//! buffers, sorted once, in each flask's frame.

use super::transfer::upload;
use crate::flask::particles::BoundaryParticle;
use crate::kernel::Kernel;
use glam::{DVec3, U64Vec3};
use vitriol_gpu::{Buffer, Gpu, GpuError, Recorder};
use vitriol_shaders::layout::SolidCells;

/// The buffers that `common/glass/solids.wgsl` reads; empty where the boundary is of maps.
pub struct Solids {
    pub(super) cells: Buffer,
    pub(super) starts: Buffer,
    pub(super) solids: Buffer,
}

impl Solids {
    /// Sorts the solids of each flask for a kernel of support radius `support`, metres, and
    /// records their upload.
    pub fn new(
        gpu: &Gpu,
        rec: &mut Recorder,
        flasks: &[Vec<BoundaryParticle>],
        support: f64,
    ) -> Result<Self, GpuError> {
        let weight = Kernel::new(support).sigma();
        let mut cells = Vec::new();
        let mut starts = Vec::new();
        let mut all = Vec::new();
        for solids in flasks {
            let table = CellTable::new(solids, support);
            let [low_x, low_y, low_z] = table.low.as_vec3().to_array();
            let [count_x, count_y, count_z] = table.counts.as_uvec3().to_array();
            cells.push(SolidCells {
                low_x,
                low_y,
                low_z,
                count_x,
                count_y,
                count_z,
                first: starts.len() as u32,
            });
            let before = all.len() as u32;
            starts.extend(table.starts.iter().map(|start| before + start));
            all.extend(table.listed.iter().map(|&index| {
                let solid = &solids[index as usize];
                let place = solid.position.as_vec3();
                place.extend((solid.volume * weight) as f32).to_array()
            }));
        }
        Ok(Self {
            cells: upload(gpu, rec, "solid_cells", &cells)?,
            starts: upload(gpu, rec, "solid_starts", &starts)?,
            solids: upload(gpu, rec, "solids", &all)?,
        })
    }
}

/// Cells of edge h around a flask's solids; each lists those that are within
/// h of any of its points.
struct CellTable {
    low: DVec3,
    counts: U64Vec3,
    /// First entry of each cell in `listed`, and the end of the last.
    starts: Vec<u32>,
    /// Indices of solids, by cell and ascending.
    listed: Vec<u32>,
}

impl CellTable {
    fn new(solids: &[BoundaryParticle], support: f64) -> Self {
        let positions = || solids.iter().map(|solid| solid.position);
        let least = positions().fold(DVec3::INFINITY, DVec3::min);
        let most = positions().fold(DVec3::NEG_INFINITY, DVec3::max);
        // A hair more than h, so that rounding loses none at the edge.
        let reach = support * (1.0 + 1e-4);
        let low = least - reach;
        let extent = (most + reach - low) / support;
        let counts = extent.ceil().as_u64vec3().max(U64Vec3::ONE);
        let place = |cell: U64Vec3| (cell.x + counts.x * (cell.y + counts.y * cell.z)) as usize;
        let mut cells = vec![Vec::new(); (counts.x * counts.y * counts.z) as usize];
        for (index, position) in (0u32..).zip(positions()) {
            let first = ((position - reach - low) / support).floor().as_u64vec3();
            let last = ((position + reach - low) / support).floor().as_u64vec3();
            let last = last.min(counts - 1);
            for z in first.z..=last.z {
                for y in first.y..=last.y {
                    for x in first.x..=last.x {
                        let cell = U64Vec3::new(x, y, z);
                        let corner = low + cell.as_dvec3() * support;
                        let nearest = position.clamp(corner, corner + support);
                        if nearest.distance(position) < reach {
                            cells[place(cell)].push(index);
                        }
                    }
                }
            }
        }
        let mut starts = vec![0];
        let mut listed = Vec::new();
        for cell in cells {
            listed.extend(cell);
            starts.push(listed.len() as u32);
        }
        Self {
            low,
            counts,
            starts,
            listed,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::flask::{Profile, particles};
    use vitriol_tests::random::Random;

    /// Every solid within h of a point is in the list of the point's cell,
    /// once; where there is no cell, there is none.
    #[test]
    fn a_cell_lists_all_in_reach() {
        let support = 0.005;
        let profile = Profile::new(&[[0.0, 0.012], [0.03, 0.006]], 0.002).unwrap();
        let solids = particles::sample(&profile, 0.002, support);
        let table = CellTable::new(&solids, support);
        let mut random = Random(4);
        let (mut inside, mut pairs) = (0, 0);
        for _ in 0..3000 {
            let point = random.point(0.07);
            let near = |&index: &u32| solids[index as usize].position.distance(point) < support;
            let expected: Vec<u32> = (0..solids.len() as u32).filter(near).collect();
            let at = ((point - table.low) / support).floor();
            let bound = table.counts.as_dvec3();
            let mut listed = Vec::new();
            if at.cmpge(DVec3::ZERO).all() && at.cmplt(bound).all() {
                let cell = at.x + bound.x * (at.y + bound.y * at.z);
                let ends = [0, 1].map(|next| table.starts[cell as usize + next] as usize);
                listed.extend_from_slice(&table.listed[ends[0]..ends[1]]);
                inside += 1;
            }
            listed.retain(near);
            assert_eq!(listed, expected, "{point}");
            pairs += listed.len();
        }
        assert!(
            inside > 100 && inside < 2900 && pairs > 1000,
            "{inside} {pairs}"
        );
    }
}
