//! The picture of the difference: for each state the true surface, the drawn
//! one, and what lies between.

use glam::DVec3;
use vitriol_render::reference::Picture;

use super::judge::Sample;
use crate::failure::{Blame, Failure};
use crate::output;

/// Depth difference of the full colour, particle radii.
const FULL: f64 = 1.0;
/// Where there is nothing.
const NOTHING: [f64; 3] = [0.10, 0.10, 0.11];
/// Liquid that was not drawn, and what was drawn where there is none.
const MISSING: [f64; 3] = [0.10, 0.75, 0.25];
const TOO_MUCH: [f64; 3] = [0.85, 0.75, 0.10];
/// Drawn before and behind the truth.
const BEFORE: [f64; 3] = [0.15, 0.35, 0.95];
const BEHIND: [f64; 3] = [0.95, 0.20, 0.15];

/// A PNG with a row a sample: truth, drawn, difference.
///
/// # Errors
/// What the encoder says.
pub fn png(samples: &[Sample]) -> Result<Vec<u8>, Failure> {
    let size = samples.first().map_or([1, 1], |one| one.truth.rays.size());
    let [width, height] = size;
    let sheet = [3 * width, samples.len().max(1) * height];
    let mut bytes = vec![0; 3 * sheet[0] * sheet[1]];
    for (row, sample) in samples.iter().enumerate() {
        for pixel in 0..width * height {
            let colours = [
                shaded(&sample.truth, pixel),
                shaded(&sample.drawn, pixel),
                difference(sample, pixel),
            ];
            let (x, y) = (pixel % width, pixel / width + row * height);
            for (column, colour) in colours.iter().enumerate() {
                let first = 3 * (y * sheet[0] + column * width + x);
                let encoded = colour.map(|c| (255.0 * c.clamp(0.0, 1.0)).round() as u8);
                bytes[first..first + 3].copy_from_slice(&encoded);
            }
        }
    }
    let size = sheet.map(|pixels| pixels as u32);
    output::png(&bytes, size, png::ColorType::Rgb).other()
}

/// A matt surface in light from above and the viewer's left.
fn shaded(picture: &Picture, pixel: usize) -> [f64; 3] {
    if !picture.depth[pixel].is_finite() {
        return NOTHING;
    }
    let towards = -picture.rays.through(pixel).normalize();
    let light = (DVec3::new(-0.4, 0.8, 0.0) + towards).normalize();
    let normal = picture.normal[pixel];
    // The square root stands for the display's encoding.
    let level = (0.12 + 0.8 * normal.dot(light).max(0.0)).sqrt();
    [0.80, 0.88, 0.95].map(|c| c * level)
}

fn difference(sample: &Sample, pixel: usize) -> [f64; 3] {
    let (truth, drawn) = (sample.truth.depth[pixel], sample.drawn.depth[pixel]);
    match (truth.is_finite(), drawn.is_finite()) {
        (false, false) => NOTHING,
        (true, false) => MISSING,
        (false, true) => TOO_MUCH,
        (true, true) => {
            let off = (drawn - truth) / (0.5 * sample.spacing * FULL);
            let share = off.abs().min(1.0);
            let colour = if off < 0.0 { BEFORE } else { BEHIND };
            colour.map(|c| 1.0 + share * (c - 1.0))
        }
    }
}
