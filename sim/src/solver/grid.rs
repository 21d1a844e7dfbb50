//! The neighbour search's sizes: cells, their table, and the list (lines 9 to 12).

use super::sleep;
use crate::parameters::Parameters;

/// Cells that one workgroup scans, as in `common/liquid/cells.wgsl`.
const SCAN_BLOCK: u32 = 1024;

/// Particles whose neighbours lie side by side, as in `common/liquid/list_block.wgsl`.
const LIST_BLOCK: u32 = 32;

/// Least number of words for lists that are longer than a place: those of 500 particles of which each has all others as neighbours.
const LEAST_LONG: u64 = 1 << 18;

/// The neighbour search: cell size, table and list.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Edge of a cell, metres.
    pub cell: f64,
    /// Logarithms of the cells in x, y and z.
    pub bits: [u32; 3],
    /// Tables of cells: a second one where liquid may sleep.
    tables: u32,
    /// Neighbours for which each particle has a place in the list.
    pub list_capacity: u32,
}

impl Grid {
    /// As many cells as particles: a cell of one support radius holds eight
    /// at h/d = 2, so most of the table is empty and distant cells rarely meet.
    pub fn new(parameters: &Parameters, count: u32, flasks: usize) -> Self {
        let cell = parameters.support_radius * (1.0 + parameters.list_margin);
        let total = count.max(SCAN_BLOCK).next_power_of_two().ilog2();
        Self {
            cell,
            bits: [total.div_ceil(3), total / 3, (total + 1) / 3],
            tables: 1 + u32::from(sleep::is_on(parameters, flasks)),
            list_capacity: parameters.list_capacity(),
        }
    }

    /// Words of the places of `count` particles, which fill blocks of the list.
    pub fn places(&self, count: u32) -> u64 {
        u64::from(count.next_multiple_of(LIST_BLOCK)) * u64::from(self.list_capacity)
    }

    /// Words behind the places, for lists that are longer than a place.
    pub fn long(&self, count: u32) -> u64 {
        (self.places(count) / 8).max(LEAST_LONG)
    }

    /// Particles of each cell that are noted before they are sorted, where the list will be.
    pub fn cell_items(&self, count: u32) -> u32 {
        (self.places(count) / u64::from(self.cells())).max(1) as u32
    }

    /// Words for these particles where lists of liquid that sleeps must be kept meanwhile; else 0.
    pub fn own_items(&self, count: u32) -> u64 {
        u64::from(self.cells()) * u64::from(self.cell_items(count)) * u64::from(self.tables - 1)
    }

    /// Number of fours in all lists that are longer than a place, and then the first four of each particle's, for long lists in the
    /// particles' order.
    pub fn long_lists(&self, counts: &[u32]) -> Vec<u32> {
        let mut all = vec![0u32; 1 + counts.len()];
        for (first, &count) in (1..).zip(counts) {
            if count > self.list_capacity {
                all[first] = all[0];
                all[0] = all[0].saturating_add(count.div_ceil(4));
            }
        }
        all
    }

    /// Whether `fours` fours fit the room for long lists; else no particle has a long list.
    pub fn fit(&self, fours: u32, count: u32) -> bool {
        4 * u64::from(fours) <= self.long(count)
    }

    /// Sorts a list that the device wrote in an order that varies from run to run into one that repeats: lists that are longer than a place
    /// follow the places in the particles' order, and words that a rebuild left elsewhere become 0. `found` is the device's `long_lists`.
    pub fn settle(&self, counts: &[u32], found: &[u32], list: &mut Vec<u32>) {
        let n = counts.len() as u32;
        let places = self.places(n) as usize;
        let mut long = Vec::new();
        if found.first().is_some_and(|&fours| self.fit(fours, n)) {
            for (&count, &first) in counts.iter().zip(&found[1..]) {
                if count > self.list_capacity {
                    let from = places + 4 * first as usize;
                    let words = from..from + 4 * count.div_ceil(4) as usize;
                    long.extend_from_slice(list.get(words).unwrap_or_default());
                }
            }
        }
        list.truncate(places);
        self.forget_unlisted(counts, list);
        list.extend(long);
    }

    fn forget_unlisted(&self, counts: &[u32], list: &mut [u32]) {
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

    /// Cells in the tables.
    pub fn cells(&self) -> u32 {
        self.tables << self.bits.iter().sum::<u32>()
    }

    /// Workgroups that scan them.
    pub fn blocks(&self) -> u32 {
        self.cells() / SCAN_BLOCK
    }
}
