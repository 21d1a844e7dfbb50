//! The neighbour search's sizes: cells, their table, and the list (lines 9 to 12).

use crate::parameters::Parameters;

/// Cells that one workgroup scans, as in `common/liquid/cells.wgsl`.
const SCAN_BLOCK: u32 = 1024;

/// Particles whose neighbours lie side by side, as in `common/liquid/list_block.wgsl`.
const LIST_BLOCK: u32 = 32;

/// The neighbour search: cell size, table and list.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Edge of a cell, metres.
    pub cell: f64,
    /// Logarithms of the cells in x, y and z.
    pub bits: [u32; 3],
    /// Rows of the neighbour list.
    pub list_capacity: u32,
}

impl Grid {
    /// As many cells as particles: a cell of one support radius holds eight
    /// at h/d = 2, so most of the table is empty and distant cells rarely meet.
    pub fn new(parameters: &Parameters, count: u32) -> Self {
        let cell = parameters.support_radius * (1.0 + parameters.list_margin);
        let total = count.max(SCAN_BLOCK).next_power_of_two().ilog2();
        Self {
            cell,
            bits: [total.div_ceil(3), total / 3, (total + 1) / 3],
            list_capacity: parameters.list_capacity(),
        }
    }

    /// Words of the list of `count` particles, which fill blocks of it.
    pub fn listed(&self, count: u32) -> u64 {
        u64::from(count.next_multiple_of(LIST_BLOCK)) * u64::from(self.list_capacity)
    }

    /// Particles of each cell that are noted before they are sorted, where the list will be.
    pub fn cell_items(&self, count: u32) -> u32 {
        (self.listed(count) / u64::from(self.cells())).max(1) as u32
    }

    /// Puts 0 where the list has no neighbours, of which there are so many: what a rebuild noted there is in the order of chance.
    pub fn forget_unlisted(&self, counts: &[u32], list: &mut [u32]) {
        let fours = self.list_capacity as usize / 4;
        let block = LIST_BLOCK as usize;
        for (place, four) in list.chunks_exact_mut(4).enumerate() {
            let g = place / block % fours;
            let i = place / (block * fours) * block + place % block;
            if counts
                .get(i)
                .is_none_or(|&count| g >= count.div_ceil(4) as usize)
            {
                four.fill(0);
            }
        }
    }

    /// Cells in the table.
    pub fn cells(&self) -> u32 {
        1 << self.bits.iter().sum::<u32>()
    }

    /// Workgroups that scan them.
    pub fn blocks(&self) -> u32 {
        self.cells() / SCAN_BLOCK
    }
}
