//! The picture of the difference: for each state the true surface, the drawn one, and the difference.

use glam::DVec3;
use vitriol_render::reference::Picture;

use super::judge::Sample;

/// Depth difference of the full colour, particle radii.
const FULL: f64 = 1.0;
/// Colour where there is no liquid.
const NOTHING: [f64; 3] = [0.10, 0.10, 0.11];
/// Colours of liquid that was not drawn, and of drawn liquid where there is none.
const MISSING: [f64; 3] = [0.10, 0.75, 0.25];
const TOO_MUCH: [f64; 3] = [0.85, 0.75, 0.10];
/// Colours of a drawn surface before and behind the true one.
const BEFORE: [f64; 3] = [0.15, 0.35, 0.95];
const BEHIND: [f64; 3] = [0.95, 0.20, 0.15];

/// RGB bytes, and width and height: for each sample a row of the truth, the drawn picture and the difference.
pub fn picture(samples: &[Sample]) -> (Vec<u8>, [u32; 2]) {
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
    (bytes, sheet.map(|side| side as u32))
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
