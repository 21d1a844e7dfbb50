//! Triangle meshes, and how one is cut along a surface.

use std::collections::HashMap;

use glam::DVec3;

/// Halvings of an edge until the place where it is cut is known to a thousandth of it.
const HALVINGS: usize = 10;

/// Triangles, counter-clockwise as seen from where their normals point.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Places of the vertices.
    pub positions: Vec<DVec3>,
    /// Unit normals, as many.
    pub normals: Vec<DVec3>,
    /// Vertices of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Adds a vertex and gives back its number.
    pub fn add(&mut self, position: DVec3, normal: DVec3) -> u32 {
        self.positions.push(position);
        self.normals.push(normal);
        self.positions.len() as u32 - 1
    }

    /// Adds another one.
    pub fn append(&mut self, other: &Self) {
        let first = self.positions.len() as u32;
        self.positions.extend(&other.positions);
        self.normals.extend(&other.normals);
        let triangles = other.triangles.iter();
        self.triangles
            .extend(triangles.map(|corners| corners.map(|corner| first + corner)));
    }

    /// Each vertex elsewhere; `place` keeps angles.
    #[must_use]
    pub fn moved(mut self, place: impl Fn(DVec3) -> DVec3, turn: impl Fn(DVec3) -> DVec3) -> Self {
        for position in &mut self.positions {
            *position = place(*position);
        }
        for normal in &mut self.normals {
            *normal = turn(*normal);
        }
        self
    }

    /// The other side of it.
    #[must_use]
    pub fn turned(mut self) -> Self {
        for normal in &mut self.normals {
            *normal = -*normal;
        }
        for [_, b, c] in &mut self.triangles {
            std::mem::swap(b, c);
        }
        self
    }

    /// Corners of a triangle.
    pub fn corners(&self, triangle: [u32; 3]) -> [DVec3; 3] {
        triangle.map(|corner| self.positions[corner as usize])
    }

    /// Its area, square of the unit.
    pub fn area(&self) -> f64 {
        let twice = |&triangle: &[u32; 3]| {
            let [a, b, c] = self.corners(triangle);
            (b - a).cross(c - a).length()
        };
        0.5 * self.triangles.iter().map(twice).sum::<f64>()
    }

    /// ⅓ ∮ x·n dA: the volume within, if it is closed, and its share of that of a surface which it is a part of. The
    /// unit cubed.
    pub fn flux(&self) -> f64 {
        let six = |&triangle: &[u32; 3]| {
            let [a, b, c] = self.corners(triangle);
            a.dot(b.cross(c))
        };
        self.triangles.iter().map(six).sum::<f64>() / 6.0
    }

    /// The part of it where `side` is not negative. Where an edge is cut is found on the edge itself, since `side` may
    /// have steps, which no line through two values finds.
    #[must_use]
    pub fn where_positive(&self, side: impl Fn(DVec3) -> f64) -> Self {
        let kept: Vec<bool> = self.positions.iter().map(|&at| side(at) >= 0.0).collect();
        let mut cutting = Cutting {
            from: self,
            kept: &kept,
            side: &side,
            numbers: vec![None; self.positions.len()],
            cuts: HashMap::new(),
            to: Self::default(),
        };
        for &triangle in &self.triangles {
            cutting.take(triangle);
        }
        cutting.to
    }
}

struct Cutting<'a, F> {
    from: &'a Mesh,
    kept: &'a [bool],
    side: &'a F,
    /// New numbers of old vertices.
    numbers: Vec<Option<u32>>,
    /// New vertices by the ends of the edges that they cut.
    cuts: HashMap<[u32; 2], u32>,
    to: Mesh,
}

impl<F: Fn(DVec3) -> f64> Cutting<'_, F> {
    fn take(&mut self, triangle: [u32; 3]) {
        let mut corners = Vec::with_capacity(4);
        for (index, &a) in triangle.iter().enumerate() {
            let b = triangle[(index + 1) % 3];
            if self.kept[a as usize] {
                corners.push(self.vertex(a));
            }
            if self.kept[a as usize] != self.kept[b as usize] {
                corners.push(self.cut(a, b));
            }
        }
        for index in 1..corners.len().saturating_sub(1) {
            let fan = [corners[0], corners[index], corners[index + 1]];
            self.to.triangles.push(fan);
        }
    }

    fn vertex(&mut self, old: u32) -> u32 {
        let (from, index) = (self.from, old as usize);
        *self.numbers[index]
            .get_or_insert_with(|| self.to.add(from.positions[index], from.normals[index]))
    }

    fn cut(&mut self, a: u32, b: u32) -> u32 {
        let key = [a.min(b), a.max(b)];
        if let Some(&number) = self.cuts.get(&key) {
            return number;
        }
        let [a, b] = key.map(|end| end as usize);
        let at = |share: f64| self.from.positions[a].lerp(self.from.positions[b], share);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if ((self.side)(at(middle)) >= 0.0) == self.kept[a] {
                low = middle;
            } else {
                high = middle;
            }
        }
        let share = 0.5 * (low + high);
        let normal = self.from.normals[a].lerp(self.from.normals[b], share);
        let (place, normal) = (at(share), normal.normalize_or(self.from.normals[a]));
        let number = self.to.add(place, normal);
        self.cuts.insert(key, number);
        number
    }
}

#[cfg(test)]
#[path = "tests/mesh.rs"]
mod tests;
