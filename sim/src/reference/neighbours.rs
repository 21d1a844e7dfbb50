//! Neighbour search (line 10).

use glam::DVec3;
use std::collections::HashMap;

/// Points sorted into cubic cells.
#[derive(Clone, Debug)]
pub struct Cells {
    size: f64,
    members: HashMap<[i64; 3], Vec<u32>>,
}

impl Cells {
    /// Cells of edge `size` (metres, above zero) with all of `points`.
    pub fn new(points: &[DVec3], size: f64) -> Self {
        let mut members: HashMap<_, Vec<u32>> = HashMap::new();
        for (index, &point) in (0..).zip(points) {
            members.entry(cell(point, size)).or_default().push(index);
        }
        Self { size, members }
    }

    /// Calls `visit` with the index of every point that may be within one
    /// cell's edge of `point`.
    pub fn near(&self, point: DVec3, mut visit: impl FnMut(u32)) {
        let [x, y, z] = cell(point, self.size);
        for dx in -1..=1 {
            for dy in -1..=1 {
                for dz in -1..=1 {
                    let members = self.members.get(&[x + dx, y + dy, z + dz]);
                    members.into_iter().flatten().copied().for_each(&mut visit);
                }
            }
        }
    }
}

/// Rounded down: truncation would fold the cells on either side of zero into
/// one of double width. The bound keeps the cells around it countable.
fn cell(point: DVec3, size: f64) -> [i64; 3] {
    let countable = 1e15;
    (point / size)
        .floor()
        .to_array()
        .map(|x| x.clamp(-countable, countable) as i64)
}

/// N_i of every particle, without the particle itself, ascending.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Neighbours {
    offsets: Vec<usize>,
    indices: Vec<u32>,
}

impl Neighbours {
    /// Indices of the neighbours of particle `i`.
    pub fn of(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        let list = &self.indices[self.offsets[i]..self.offsets[i + 1]];
        list.iter().map(|&j| j as usize)
    }

    fn collect(count: usize, mut candidates: impl FnMut(usize) -> Vec<u32>) -> Self {
        let mut neighbours = Self {
            offsets: vec![0],
            indices: Vec::new(),
        };
        for i in 0..count {
            let mut list = candidates(i);
            list.sort_unstable();
            neighbours.indices.append(&mut list);
            neighbours.offsets.push(neighbours.indices.len());
        }
        neighbours
    }
}

/// All pairs of `points` (metres) closer than `radius` for which
/// `visible(i, j)` holds, from cells.
pub fn find(points: &[DVec3], radius: f64, visible: impl Fn(usize, usize) -> bool) -> Neighbours {
    let cells = Cells::new(points, radius);
    Neighbours::collect(points.len(), |i| {
        let mut list = Vec::new();
        cells.near(points[i], |j| {
            if is_pair(points, i, j as usize, radius) && visible(i, j as usize) {
                list.push(j);
            }
        });
        list
    })
}

/// [`find`] without cells, in quadratic time: its truth.
pub fn find_by_brute_force(
    points: &[DVec3],
    radius: f64,
    visible: impl Fn(usize, usize) -> bool,
) -> Neighbours {
    Neighbours::collect(points.len(), |i| {
        (0..points.len() as u32)
            .filter(|&j| is_pair(points, i, j as usize, radius) && visible(i, j as usize))
            .collect()
    })
}

/// A position that is not a number has no neighbours.
fn is_pair(points: &[DVec3], i: usize, j: usize, radius: f64) -> bool {
    i != j && points[i].distance(points[j]) < radius
}
