//! Boxes sorted into the cubic cells that they reach into, for those that may
//! hold a place; and points, for those that are near one.

use glam::{DVec3, IVec3};

/// Cells at most; where boxes are far-flung the cells are larger.
const MOST_CELLS: f64 = 16e6;

/// Uniform grid over the bounds of its boxes.
#[derive(Clone, Debug)]
pub(super) struct Buckets {
    low: DVec3,
    cell: f64,
    size: IVec3,
    /// Where each cell's boxes begin in `boxes`, and their end.
    first: Vec<u32>,
    boxes: Vec<u32>,
}

impl Buckets {
    /// Cells of edge `cell` over boxes given by centre and half extent, finite.
    pub(super) fn new(boxes: &[(DVec3, DVec3)], cell: f64) -> Self {
        Self::sorted(boxes, cell, MOST_CELLS)
    }

    /// Cells of edge `cell` around finite points. Far-flung ones make it larger, so that there are no more than a few cells each.
    pub(super) fn of_points(points: &[DVec3], cell: f64) -> Self {
        let boxes: Vec<_> = points.iter().map(|&at| (at, DVec3::ZERO)).collect();
        Self::sorted(&boxes, cell, 64.0 * points.len() as f64 + 4096.0)
    }

    fn sorted(boxes: &[(DVec3, DVec3)], cell: f64, most: f64) -> Self {
        let low = boxes.iter().map(|(at, half)| at - half);
        let low = low.reduce(DVec3::min).unwrap_or_default();
        let high = boxes.iter().map(|(at, half)| at + half);
        let high = high.reduce(DVec3::max).unwrap_or_default();
        let mut cell = cell;
        while ((high - low) / cell + 1.0).element_product() > most {
            cell *= 1.25;
        }
        let size = ((high - low) / cell).floor().as_ivec3() + 1;
        let mut buckets = Self {
            low,
            cell,
            size,
            first: vec![0; size.element_product() as usize + 1],
            boxes: Vec::new(),
        };
        let mut counts = vec![0_u32; buckets.first.len()];
        for one in boxes {
            buckets.each_cell(*one, |cell| counts[cell + 1] += 1);
        }
        for cell in 1..counts.len() {
            counts[cell] += counts[cell - 1];
        }
        buckets.first.clone_from(&counts);
        buckets.boxes = vec![0; counts.last().map_or(0, |&last| last as usize)];
        let mut sorted = vec![0; buckets.boxes.len()];
        for (index, one) in (0..).zip(boxes) {
            buckets.each_cell(*one, |cell| {
                sorted[counts[cell] as usize] = index;
                counts[cell] += 1;
            });
        }
        buckets.boxes = sorted;
        buckets
    }

    /// Indices of the boxes that may hold `at`.
    pub(super) fn around(&self, at: DVec3) -> &[u32] {
        let cell = self.coordinates(at);
        if cell.cmplt(IVec3::ZERO).any() || cell.cmpge(self.size).any() {
            return &[];
        }
        let cell = self.index(cell);
        &self.boxes[self.first[cell] as usize..self.first[cell + 1] as usize]
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
                let stretch = self.first[row] as usize..self.first[end] as usize;
                for &point in &self.boxes[stretch] {
                    visit(point as usize);
                }
            }
        }
    }

    /// Lower and upper corner of the cell that `at` is in.
    pub(super) fn cell_of(&self, at: DVec3) -> [DVec3; 2] {
        let low = self.low + ((at - self.low) / self.cell).floor() * self.cell;
        [low, low + self.cell]
    }

    /// Bounds of all boxes.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        [self.low, self.low + self.size.as_dvec3() * self.cell]
    }

    fn each_cell(&self, (at, half): (DVec3, DVec3), mut visit: impl FnMut(usize)) {
        let from = self.coordinates(at - half);
        let to = self.coordinates(at + half).min(self.size - 1);
        for z in from.z..=to.z {
            for y in from.y..=to.y {
                for x in from.x..=to.x {
                    visit(self.index(IVec3::new(x, y, z)));
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
