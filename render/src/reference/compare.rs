//! Differences between a picture and the truth, and between two pictures of one liquid. Distances are in particle radii, ½ d.

use glam::DVec3;

use super::march::Picture;

/// Cosine between ray and normal below which a surface counts to its silhouette: seen so flatly, a depth depends on the pixel more than on
/// the liquid.
const GRAZING: f64 = 0.25;

/// How far off the tangent plane of a pixel's surface its neighbour's may lie,
/// in depth, before it is another part that lies before or behind; particle
/// spacings.
const EDGE: f64 = 1.0;

/// |A ∩ B| / |A ∪ B| of the pixels with liquid; 1 where neither has any.
pub fn silhouette_iou(a: &Picture, b: &Picture) -> f64 {
    let (mut both, mut either) = (0_usize, 0_usize);
    for (a, b) in a.depth.iter().zip(&b.depth) {
        both += usize::from(a.is_finite() && b.is_finite());
        either += usize::from(a.is_finite() || b.is_finite());
    }
    if either == 0 {
        1.0
    } else {
        both as f64 / either as f64
    }
}

/// Pixels away from silhouettes.
#[derive(Clone, Debug)]
pub struct Interior {
    inside: Vec<bool>,
    /// Distance that was kept from silhouettes, pixels.
    pub margin: usize,
}

impl Interior {
    /// Interior of the true picture of particles of spacing `spacing` (scene's unit): pixels whose surface is seen from the front and is a
    /// spacing, at its nearest depth, away from any edge: of the liquid, of one part before another, and of the picture.
    pub fn new(truth: &Picture, spacing: f64) -> Self {
        let [width, height] = truth.rays.size();
        let nearest = truth.depth.iter().copied().fold(f64::INFINITY, f64::min);
        let pixel = nearest * truth.rays.pixel_area().sqrt();
        let margin = (spacing / pixel).ceil().max(1.0) as usize;
        let edge = |pixel: usize| {
            let (x, y) = (pixel % width, pixel / width);
            // Where one has liquid and the other not, the difference is infinite
            // or no number; where neither has, it is no edge.
            let off_plane = |from: usize, other: usize| {
                let normal = truth.normal[from];
                let through = |pixel: usize| truth.rays.through(pixel).dot(normal);
                let expected = truth.depth[from] * through(from) / through(other);
                (truth.depth[other] - expected).abs()
            };
            let jumps = |other: usize| {
                let seen = [pixel, other].map(|at| truth.depth[at].is_finite());
                let step = off_plane(pixel, other).min(off_plane(other, pixel));
                seen[0] != seen[1] || (seen[0] && step > EDGE * spacing)
            };
            let border = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
            border
                || jumps(pixel - 1)
                || jumps(pixel + 1)
                || jumps(pixel - width)
                || jumps(pixel + width)
        };
        let edges: Vec<bool> = (0..width * height).map(edge).collect();
        let by_row = dilate(&edges, width, 1, margin);
        let near_edge = dilate(&by_row, height, width, margin);
        let facing = |pixel: usize| {
            let towards = -truth.rays.through(pixel).normalize();
            truth.depth[pixel].is_finite() && truth.normal[pixel].dot(towards) > GRAZING
        };
        Self {
            inside: (0..width * height)
                .map(|pixel| !near_edge[pixel] && facing(pixel))
                .collect(),
            margin,
        }
    }

    fn pixels(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.inside.len()).filter(|&pixel| self.inside[pixel])
    }
}

/// Spreads the true pixels of `mask` by `margin` along lines of `length` pixels that lie `stride` apart.
fn dilate(mask: &[bool], length: usize, stride: usize, margin: usize) -> Vec<bool> {
    let mut spread = vec![false; mask.len()];
    for (pixel, _) in mask.iter().enumerate().filter(|(_, set)| **set) {
        let at = pixel / stride % length;
        let first = pixel - at * stride;
        for other in at.saturating_sub(margin)..=(at + margin).min(length - 1) {
            spread[first + other * stride] = true;
        }
    }
    spread
}

/// Means over pixels; NaN where there were none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Root mean square of the depths' differences, particle radii.
    pub depth_rms: f64,
    /// Their mean, particle radii: above 0 where the second lies behind.
    pub depth_mean: f64,
    /// Mean angle between the normals, rad.
    pub normal_angle: f64,
    /// Pixels that were compared.
    pub pixels: usize,
}

/// Adds differences up.
#[derive(Default)]
struct Differences {
    squares: f64,
    sum: f64,
    angles: f64,
    pixels: usize,
}

impl Differences {
    fn add(&mut self, depth: f64, a: DVec3, b: DVec3) {
        self.squares += depth * depth;
        self.sum += depth;
        self.angles += a.cross(b).length().atan2(a.dot(b));
        self.pixels += 1;
    }

    fn over(&self, spacing: f64) -> Difference {
        let (count, radius) = (self.pixels as f64, 0.5 * spacing);
        Difference {
            depth_rms: (self.squares / count).sqrt() / radius,
            depth_mean: self.sum / count / radius,
            normal_angle: self.angles / count,
            pixels: self.pixels,
        }
    }
}

/// Difference of `drawn` less `truth` over the pixels of the interior that have liquid in both.
pub fn difference(
    truth: &Picture,
    drawn: &Picture,
    interior: &Interior,
    spacing: f64,
) -> Difference {
    let mut differences = Differences::default();
    for pixel in interior.pixels().filter(|&at| drawn.depth[at].is_finite()) {
        differences.add(
            drawn.depth[pixel] - truth.depth[pixel],
            truth.normal[pixel],
            drawn.normal[pixel],
        );
    }
    differences.over(spacing)
}

/// One eye's truth with its interior.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The true picture.
    pub truth: &'a Picture,
    /// Its pixels away from silhouettes.
    pub interior: &'a Interior,
}

/// Compares the surface in `from`, projected into the other eye, with the surface in `to`: over the pixels that by the truth both eyes
/// see, away from silhouettes. `from` and `to` are pictures of these two eyes.
///
/// With two places of a moving head in place of two eyes it measures the flicker of a liquid at rest.
pub fn reprojection(
    [from, to]: [&Picture; 2],
    [first, second]: [Seen<'_>; 2],
    spacing: f64,
) -> Difference {
    let mut differences = Differences::default();
    let place = |picture: &Picture, pixel: usize| {
        picture.rays.eye + picture.rays.through(pixel) * picture.depth[pixel]
    };
    for pixel in first
        .interior
        .pixels()
        .filter(|&at| from.depth[at].is_finite())
    {
        let seen_by_both = second
            .truth
            .rays
            .project(place(first.truth, pixel))
            .and_then(|at| Some((at, sample(second.truth, second.interior, at)?)))
            // Half a particle: less than any edge before another part.
            .is_some_and(|((_, _, depth), (found, _))| (found - depth).abs() < 0.5 * spacing);
        if !seen_by_both {
            continue;
        }
        let there = to.rays.project(place(from, pixel));
        let compared = there.and_then(|at| Some((at.2, sample(to, second.interior, at)?)));
        if let Some((depth, (found, normal))) = compared {
            differences.add(found - depth, from.normal[pixel], normal);
        }
    }
    differences.over(spacing)
}

/// Depth and normal between pixel centres; none where a pixel has no liquid or
/// is not of the interior.
fn sample(
    picture: &Picture,
    interior: &Interior,
    (x, y, _): (f64, f64, f64),
) -> Option<(f64, DVec3)> {
    let [width, height] = picture.rays.size();
    let (u, v) = (x - 0.5, y - 0.5);
    let (column, row) = (u.floor(), v.floor());
    let beyond =
        column < 0.0 || row < 0.0 || column + 1.0 >= width as f64 || row + 1.0 >= height as f64;
    if beyond {
        return None;
    }
    let first = row as usize * width + column as usize;
    let (s, t) = (u - column, v - row);
    let corners = [
        (first, (1.0 - s) * (1.0 - t)),
        (first + 1, s * (1.0 - t)),
        (first + width, (1.0 - s) * t),
        (first + width + 1, s * t),
    ];
    let (mut inverse, mut normal) = (0.0, DVec3::ZERO);
    for (pixel, weight) in corners {
        if !interior.inside[pixel] || !picture.depth[pixel].is_finite() {
            return None;
        }
        // In one over the depth a plane is linear in the picture.
        inverse += weight / picture.depth[pixel];
        normal += weight * picture.normal[pixel];
    }
    Some((1.0 / inverse, normal.normalize_or_zero()))
}

/// Volume that a picture sees, scene's unit cubed.
pub fn volume(picture: &Picture) -> f64 {
    picture.solid.iter().sum::<f64>() * picture.rays.pixel_area()
}

#[cfg(test)]
#[path = "tests/compare.rs"]
mod tests;
