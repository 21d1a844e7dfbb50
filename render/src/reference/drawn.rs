//! A picture of the renderer in the form of the reference's.

use glam::DVec3;

use super::march::{Picture, Rays};

impl Picture {
    /// A picture from its view depths (not finite or not above 0 where there is no liquid) and ways through the liquid in view depth, by
    /// rows from the top, scene's unit. Normals are those of the depth; the liquid is taken to lie in one piece behind its first surface.
    pub fn drawn(rays: &Rays, depth: &[f32], ways: &[f32]) -> Self {
        let depth: Vec<f64> = depth
            .iter()
            .map(|&depth| f64::from(depth))
            .map(|depth| if depth > 0.0 { depth } else { f64::INFINITY })
            .collect();
        let ways: Vec<f64> = depth
            .iter()
            .zip(ways)
            .map(|(depth, &way)| if depth.is_finite() { way.into() } else { 0.0 })
            .collect();
        let solid = (0..depth.len()).map(|pixel| {
            let (from, way) = (depth[pixel], ways[pixel]);
            let to = from + way;
            if way > 0.0 {
                (to.powi(3) - from.powi(3)) / 3.0
            } else {
                0.0
            }
        });
        Self {
            rays: *rays,
            solid: solid.collect(),
            normal: normals(rays, &depth),
            depth,
            thickness: (0..)
                .zip(&ways)
                .map(|(pixel, way)| way * rays.through(pixel).length())
                .collect(),
        }
    }
}

/// Normals of a depth image: of the differences to the right or left and up or
/// down, of each the one with the smaller step in depth, which is on the same
/// surface.
fn normals(rays: &Rays, depth: &[f64]) -> Vec<DVec3> {
    let [width, height] = rays.size();
    let place = |pixel: usize| rays.through(pixel) * depth[pixel];
    let along = |pixel: usize, before: Option<usize>, after: Option<usize>| {
        let step = |other: Option<usize>| {
            other.map_or(f64::INFINITY, |other| (depth[other] - depth[pixel]).abs())
        };
        let (back, ahead) = (step(before), step(after));
        match (before, after) {
            (Some(before), _) if back <= ahead && back.is_finite() => place(pixel) - place(before),
            (_, Some(after)) if ahead.is_finite() => place(after) - place(pixel),
            _ => DVec3::ZERO,
        }
    };
    let normal = |pixel: usize| {
        if !depth[pixel].is_finite() {
            return DVec3::ZERO;
        }
        let (x, y) = (pixel % width, pixel / width);
        let right = along(
            pixel,
            (x > 0).then(|| pixel - 1),
            (x + 1 < width).then(|| pixel + 1),
        );
        let down = along(
            pixel,
            (y > 0).then(|| pixel - width),
            (y + 1 < height).then(|| pixel + width),
        );
        down.cross(right).normalize_or_zero()
    };
    (0..depth.len()).map(normal).collect()
}
