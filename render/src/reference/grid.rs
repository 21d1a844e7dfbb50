//! Points sorted into cubic cells, for those that are near a place.

use std::ops::Range;

use glam::{DVec3, IVec3};

/// Uniform grid over the bounds of its points.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    low: DVec3,
    cell: f64,
    size: IVec3,
    /// Where each cell's points begin in `points`, and their end.
    first: Vec<u32>,
    points: Vec<u32>,
}

impl Grid {
    /// Grid with cells of edge `cell` around finite `positions`. Far-flung
    /// points make it coarser, so that it takes no more than a few cells each.
    pub(super) fn new(positions: &[DVec3], cell: f64) -> Self {
        let low = positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = positions
            .iter()
            .copied()
            .fold(DVec3::NEG_INFINITY, DVec3::max);
        let extent = (high - low).max(DVec3::ZERO);
        let affordable = 64.0 * positions.len() as f64 + 4096.0;
        let mut cell = cell;
        while (extent / cell + 1.0).element_product() > affordable {
            cell *= 1.25;
        }
        let size = (extent / cell).floor().as_ivec3() + 1;
        let mut grid = Self {
            low,
            cell,
            size,
            first: vec![0; (size.x * size.y * size.z) as usize + 1],
            points: vec![0; positions.len()],
        };
        let cells: Vec<usize> = positions
            .iter()
            .map(|&at| grid.index(grid.coordinates(at)))
            .collect();
        for &cell in &cells {
            grid.first[cell + 1] += 1;
        }
        for cell in 1..grid.first.len() {
            grid.first[cell] += grid.first[cell - 1];
        }
        let mut next = grid.first.clone();
        for (point, &cell) in (0..).zip(&cells) {
            grid.points[next[cell] as usize] = point;
            next[cell] += 1;
        }
        grid
    }

    /// Calls `visit` with the index of each point that may lie within `reach`
    /// of `at`; some lie farther away.
    pub(super) fn near(&self, at: DVec3, reach: f64, mut visit: impl FnMut(usize)) {
        let from = self.coordinates(at - reach).max(IVec3::ZERO);
        let to = self.coordinates(at + reach).min(self.size - 1);
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                if from.x > to.x {
                    continue;
                }
                // A row of cells is one stretch of points.
                let row = self.index(IVec3::new(from.x, y, z));
                let end = self.index(IVec3::new(to.x, y, z)) + 1;
                let stretch: Range<usize> = self.first[row] as usize..self.first[end] as usize;
                for &point in &self.points[stretch] {
                    visit(point as usize);
                }
            }
        }
    }

    fn coordinates(&self, at: DVec3) -> IVec3 {
        ((at - self.low) / self.cell).floor().as_ivec3()
    }

    fn index(&self, cell: IVec3) -> usize {
        ((cell.z * self.size.y + cell.y) * self.size.x + cell.x) as usize
    }
}
