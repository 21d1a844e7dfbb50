//! Marches rays to the surface, and collects the picture of an eye.

use glam::{DMat3, DVec3};

use super::field::{Field, SURFACE};
use super::parallel;
use crate::camera::{NEAR, View};

/// Step of the march, in the sharpest kernel's half-widths: what a ray enters
/// and leaves within one step is missed.
const STEP: f64 = 0.75;

/// φ less the surface's level above which a ray is deep in a liquid, and its
/// step there, particle spacings.
const DEEP: f64 = 0.5;
const STRIDE: f64 = 0.75;

/// Precision of a surface's place, particle spacings.
const PRECISION: f64 = 1e-4;

/// An eye's rays, one through each pixel's centre, in the scene's unit.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// Where the eye is.
    pub eye: DVec3,
    stage_from_eye: DMat3,
    eye_from_stage: DMat3,
    /// Tangents at the left, right, upper and lower plane.
    tangents: [f64; 4],
    /// Depth of the near plane.
    near: f64,
    size: [usize; 2],
}

impl Rays {
    /// Rays of `view` at `size` pixels, in a scene whose unit is
    /// `length_scale` metres of the stage.
    pub fn new(view: &View, size: [u32; 2], length_scale: f64) -> Self {
        let fov = view.fov;
        let stage_from_eye = view.stage_from_eye.matrix3.as_dmat3();
        Self {
            eye: view.stage_from_eye.translation.as_dvec3() / length_scale,
            stage_from_eye,
            // Not the transpose: a rotation of f32 is one to 7 digits only.
            eye_from_stage: stage_from_eye.inverse(),
            tangents: [fov.left, fov.right, fov.up, fov.down].map(|angle| f64::from(angle).tan()),
            near: f64::from(NEAR) / length_scale,
            size: size.map(|count| count as usize),
        }
    }

    /// Width and height, pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Ray through (x, y) in pixels, (0.5, 0.5) being the first one's centre:
    /// its length along the eye's axis is 1, so that a multiple of it is a view
    /// depth.
    pub fn direction(&self, x: f64, y: f64) -> DVec3 {
        let [left, right, up, down] = self.tangents;
        self.stage_from_eye
            * DVec3::new(
                left + (right - left) * x / self.size[0] as f64,
                up + (down - up) * y / self.size[1] as f64,
                -1.0,
            )
    }

    /// Ray through the centre of a pixel, counted by rows from the top.
    pub fn through(&self, pixel: usize) -> DVec3 {
        let (x, y) = (pixel % self.size[0], pixel / self.size[0]);
        self.direction(x as f64 + 0.5, y as f64 + 0.5)
    }

    /// Where a point of the stage is seen: pixels, and view depth; none behind
    /// the eye.
    pub fn project(&self, point: DVec3) -> Option<(f64, f64, f64)> {
        let [left, right, up, down] = self.tangents;
        let at = self.eye_from_stage * (point - self.eye);
        let depth = -at.z;
        (depth > 0.0).then(|| {
            (
                (at.x / depth - left) / (right - left) * self.size[0] as f64,
                (at.y / depth - up) / (down - up) * self.size[1] as f64,
                depth,
            )
        })
    }

    /// Area of a pixel at view depth 1.
    pub fn pixel_area(&self) -> f64 {
        let [left, right, up, down] = self.tangents;
        (right - left) * (up - down) / (self.size[0] * self.size[1]) as f64
    }
}

/// The picture that an eye has of a liquid.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Its rays.
    pub rays: Rays,
    /// View depth of the first surface of each pixel, by rows from the top;
    /// infinite where there is none. Scene's unit.
    pub depth: Vec<f64>,
    /// Unit normal there, stage's axes, towards the eye; 0 where there is none.
    pub normal: Vec<DVec3>,
    /// Way through the liquid along the ray, scene's unit.
    pub thickness: Vec<f64>,
    /// ∫ z² dz of that way in view depth: times a pixel's area at depth 1 the
    /// volume that the pixel sees.
    pub solid: Vec<f64>,
}

impl Picture {
    /// Marches each pixel's ray; through all of the liquid where `whole`, else
    /// to its first surface only, which leaves `thickness` and `solid` at 0.
    pub fn new(field: &Field<'_>, rays: &Rays, whole: bool) -> Self {
        let hits = parallel::map(rays.size[0] * rays.size[1], |pixel| {
            let ray = rays.through(pixel);
            let hit = march(field, rays, ray, whole)?;
            let normal = field.normal(rays.eye + ray * hit.depth, ray);
            Some((hit, normal))
        });
        let way = |pixel: usize| rays.through(pixel).length();
        let of = |value: &dyn Fn(usize, &Hit) -> f64, none: f64| {
            let each = hits.iter().enumerate();
            each.map(|(pixel, hit)| hit.as_ref().map_or(none, |(hit, _)| value(pixel, hit)))
                .collect()
        };
        Self {
            rays: *rays,
            depth: of(&|_, hit| hit.depth, f64::INFINITY),
            normal: hits
                .iter()
                .map(|hit| hit.as_ref().map_or(DVec3::ZERO, |(_, normal)| *normal))
                .collect(),
            thickness: of(&|pixel, hit| hit.inside * way(pixel), 0.0),
            solid: of(&|_, hit| hit.solid, 0.0),
        }
    }

    /// Removes liquid behind something opaque, whose view depth along a ray from the eye is `depth`.
    pub fn hide(&mut self, depth: impl Fn(DVec3, DVec3) -> f64) {
        for pixel in 0..self.depth.len() {
            if self.depth[pixel] > depth(self.rays.eye, self.rays.through(pixel)) {
                self.depth[pixel] = f64::INFINITY;
                self.normal[pixel] = DVec3::ZERO;
                self.thickness[pixel] = 0.0;
                self.solid[pixel] = 0.0;
            }
        }
    }
}

/// A ray's way through a liquid, in view depth.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Hit {
    depth: f64,
    /// Total length inside.
    inside: f64,
    /// ∫ z² dz inside.
    solid: f64,
}

/// The ray's first surface and, where `whole`, its way through the liquid. An
/// eye in the liquid sees it from its near plane on.
fn march(field: &Field<'_>, rays: &Rays, direction: DVec3, whole: bool) -> Option<Hit> {
    let eye = rays.eye;
    let (start, end) = enter(field.bounds(), eye, direction)?;
    let length = direction.length();
    let step = STEP * field.shortest() / length;
    // Deep in a liquid there is no surface to miss.
    let stride = STRIDE * field.spacing() / length;
    let level = |t: f64| field.value(eye + direction * t) - SURFACE;
    let start = start.max(rays.near);
    let mut hit: Option<Hit> = None;
    let (mut t, mut here) = (start, level(start));
    let mut entered = (here > 0.0).then_some(start);
    while t < end {
        if let Some(from) = entered
            && !whole
        {
            add(&mut hit, from, from);
            return hit;
        }
        if here == -SURFACE
            && let Some(empty) = field.empty_around(eye + direction * t)
        {
            // Beyond the cell's far side by what rounding may take.
            let (_, leave) = enter(empty, eye, direction).unwrap_or((t, t));
            t = leave.max(t) + 1e-3 * step;
            continue;
        }
        let next = t + if here > DEEP { stride } else { step };
        let there = level(next);
        if (there > 0.0) != (here > 0.0) {
            let at = surface(
                &level,
                (t, here),
                (next, there),
                PRECISION * field.spacing() / length,
            );
            match entered.take() {
                None => entered = Some(at),
                Some(from) => add(&mut hit, from, at),
            }
        }
        (t, here) = (next, there);
    }
    if let Some(from) = entered {
        add(&mut hit, from, end);
    }
    hit
}

/// Where `level` changes its sign between two places (t, level), to `precision`:
/// secants and bisections by turns, since φ is smooth but at walls.
fn surface(
    level: &dyn Fn(f64) -> f64,
    mut a: (f64, f64),
    mut b: (f64, f64),
    precision: f64,
) -> f64 {
    let mut halve = false;
    while b.0 - a.0 > precision {
        let secant = a.0 - a.1 * (b.0 - a.0) / (b.1 - a.1);
        // Not at an end itself: half a precision inside, so that both close in.
        let middle = if halve {
            0.5 * (a.0 + b.0)
        } else {
            secant.clamp(a.0 + 0.5 * precision, b.0 - 0.5 * precision)
        };
        halve = !halve;
        let found = (middle, level(middle));
        if (found.1 > 0.0) == (a.1 > 0.0) {
            a = found;
        } else {
            b = found;
        }
    }
    0.5 * (a.0 + b.0)
}

/// Adds the way from view depth `from` to `to`.
fn add(hit: &mut Option<Hit>, from: f64, to: f64) {
    let hit = hit.get_or_insert(Hit {
        depth: from,
        inside: 0.0,
        solid: 0.0,
    });
    hit.inside += to - from;
    hit.solid += (to.powi(3) - from.powi(3)) / 3.0;
}

/// Where a ray enters and leaves a box, if it does ahead.
fn enter([low, high]: [DVec3; 2], eye: DVec3, direction: DVec3) -> Option<(f64, f64)> {
    let (a, b) = ((low - eye) / direction, (high - eye) / direction);
    let first = a.min(b).max_element().max(0.0);
    let last = a.max(b).min_element();
    (first < last).then_some((first, last))
}

#[cfg(test)]
#[path = "tests/march.rs"]
mod tests;
