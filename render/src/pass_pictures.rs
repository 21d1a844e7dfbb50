//! The result of each pass of the liquid's picture, as pictures for people.

use glam::Vec3;
use vitriol_gpu::Readback;

use crate::RenderError;
use crate::camera::View;
use crate::colour_map::ColourMap;
use crate::fluid::{Surface, SurfaceReadback};
use crate::readback::{PictureReadback, side_by_side};
use crate::tiles::{EDGE_MARK, LIQUID_MARK, STEAM_MARK, TILE, VESSEL_MARKS, tiles_of};

/// The result of one pass, all views side by side.
#[derive(Clone, Debug)]
pub struct PassPicture {
    /// The pass as timings name it; with " normals" where the normals of its depth are shown.
    pub name: &'static str,
    /// Width and height, pixels.
    pub extent: [u32; 2],
    /// Rows from the top, sRGB-encoded RGBA bytes.
    pub pixels: Vec<u8>,
}

/// The results of the passes, on their way to the host.
pub struct PassesReadback {
    pub(crate) tiles: Readback,
    pub(crate) splatted: SurfaceReadback,
    pub(crate) filtered: SurfaceReadback,
    pub(crate) drawn: PictureReadback,
    pub(crate) finished: PictureReadback,
    pub(crate) views: Vec<View>,
    /// Width and height of a view, pixels.
    pub(crate) extent: [u32; 2],
}

/// Colour where there is no liquid.
const NOTHING: [f32; 3] = [0.13; 3];

/// Share of the liquid's pixels beyond either end of a colour map: a few drops far from the rest would
/// leave all of that one colour.
const BEYOND: f32 = 0.01;

/// Colours of tiles that colour-blind readers can tell apart (M. Okabe and K. Ito, 2008).
const LIQUID: [f32; 3] = [0.0, 0.45, 0.70];
const GLASS: [f32; 3] = [0.34, 0.71, 0.91];
const EDGE: [f32; 3] = [0.90, 0.62, 0.0];
const STEAM: [f32; 3] = [0.80, 0.47, 0.65];

impl PassesReadback {
    /// The pictures in the order of the passes.
    ///
    /// - tiles: over the finished picture, blue where a tile has liquid, light blue where it has glass and
    ///   no liquid, orange where it has the table's edge alone, and pink in its lower half where it has steam;
    /// - liquid depth and liquid filter: from near (cream) to far (blue), over one range;
    /// - their normals in the eye's frame: right, up and towards the eye as red, green and blue;
    /// - liquid thickness: from none (violet) to most (yellow);
    /// - picture and finish: as they are.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] before the submission has finished.
    pub fn pictures(&self) -> Result<Vec<PassPicture>, RenderError> {
        let [width, height] = self.extent;
        let views = self.views.len();
        let shown = |name, pixels| PassPicture {
            name,
            extent: [width * views as u32, height],
            pixels,
        };
        let beside = |name, views_: Vec<Vec<[u8; 4]>>| {
            let row = 4 * width as usize;
            shown(name, side_by_side(views_.concat().concat(), views, row))
        };
        let (splatted, filtered) = (self.splatted.views()?, self.filtered.views()?);
        let depths = filtered.iter().flat_map(|surface| &surface.depth);
        let [near, far] = range(depths.copied().filter(|depth| *depth > 0.0));
        let depth = |surface: &Surface| {
            let place = |&depth: &f32| (depth > 0.0).then(|| (far - depth) / (far - near));
            let places = surface.depth.iter().map(place);
            places.map(|at| mapped(ColourMap::Lapaz, at)).collect()
        };
        let normal = |surfaces: &[Surface]| {
            let each = surfaces.iter().zip(&self.views);
            each.map(|(surface, view)| self.normals(surface, view))
                .collect()
        };
        let ways = filtered.iter().flat_map(|surface| &surface.thickness);
        let [_, most] = range(ways.copied().filter(|way| *way > 0.0));
        let thickness = |surface: &Surface| {
            let columns = surface.thickness_extent[0];
            let way = |pixel: u32| {
                let (x, y) = (pixel % width / 2, pixel / width / 2);
                surface.thickness[(y * columns + x) as usize]
            };
            let place = |way: f32| (way > 0.0).then_some(way / most);
            let places = (0..width * height).map(|pixel| place(way(pixel)));
            places.map(|at| mapped(ColourMap::Viridis, at)).collect()
        };
        let finished = self.finished.side_by_side()?;
        Ok(vec![
            shown("tiles", self.tiles(&finished)?),
            beside("liquid depth", splatted.iter().map(depth).collect()),
            beside("liquid depth normals", normal(&splatted)),
            beside("liquid thickness", filtered.iter().map(thickness).collect()),
            beside("liquid filter", filtered.iter().map(depth).collect()),
            beside("liquid filter normals", normal(&filtered)),
            shown("picture", self.drawn.side_by_side()?),
            shown("finish", finished),
        ])
    }

    /// Draws the marks of the tiles over the picture.
    fn tiles(&self, finished: &[u8]) -> Result<Vec<u8>, RenderError> {
        let width = self.extent[0];
        let [columns, rows] = tiles_of(self.extent);
        let marks = self.tiles.get::<u32>()?;
        let line = width * self.views.len() as u32;
        let over = |(pixel, seen): (u32, &[u8])| {
            let (x, y) = (pixel % line % width, pixel / line);
            let view = pixel % line / width;
            let bits = marks[((view * rows + y / TILE) * columns + x / TILE) as usize];
            let has = |mark: u32| bits & mark != 0;
            let kind = [
                (has(STEAM_MARK) && y % TILE >= TILE / 2, STEAM),
                (has(LIQUID_MARK), LIQUID),
                (has(VESSEL_MARKS), GLASS),
                (has(EDGE_MARK), EDGE),
            ];
            let colour = kind
                .into_iter()
                .find(|(is, _)| *is)
                .map(|(_, colour)| colour);
            let seen = [0, 1, 2].map(|i| f32::from(seen[i]) / 255.0);
            // The first row and column of a tile are a line between it and the next.
            let share = if x % TILE == 0 || y % TILE == 0 {
                0.0
            } else {
                0.6
            };
            rgba(match colour {
                Some(colour) => [0, 1, 2].map(|i| seen[i] + share * (colour[i] - seen[i])),
                None => seen,
            })
        };
        Ok((0..).zip(finished.chunks_exact(4)).flat_map(over).collect())
    }

    /// Normals of a view's depth, as `normal_at` of the shaders takes them.
    fn normals(&self, surface: &Surface, view: &View) -> Vec<[u8; 4]> {
        let [width, height] = self.extent.map(|side| side as i32);
        let fov = view.fov;
        let (left, right) = (fov.left.tan(), fov.right.tan());
        let (up, down) = (fov.up.tan(), fov.down.tan());
        let focal = width as f32 / (right - left);
        let spacing = self.filtered.spacing();
        // Position in the eye's frame with view depth; none where there is no liquid.
        let seen = |x: i32, y: i32| {
            let (x, y) = (x.clamp(0, width - 1), y.clamp(0, height - 1));
            let depth = surface.depth[(y * width + x) as usize];
            let across = left + (x as f32 + 0.5) / width as f32 * (right - left);
            let along = up + (y as f32 + 0.5) / height as f32 * (down - up);
            (depth > 0.0).then(|| Vec3::new(across, along, -1.0) * depth)
        };
        // The one of two neighbours that is nearer in depth counts, or both where they agree.
        let tangent = |before: Option<Vec3>, here: Vec3, after: Option<Vec3>| {
            let way = |there: Option<Vec3>| there.map_or(1e9, |there| (here.z - there.z).abs());
            let (back, forth) = (way(before), way(after));
            let (before, after) = (before.unwrap_or(here), after.unwrap_or(here));
            if back.max(forth) < 2.0 * back.min(forth) + 0.1 * spacing {
                after - before
            } else if back < forth {
                here - before
            } else {
                after - here
            }
        };
        let colour = |pixel: i32| {
            let (x, y) = (pixel % width, pixel / width);
            let Some(here) = seen(x, y) else {
                return rgba(NOTHING);
            };
            let step = ((0.2 * spacing * focal / -here.z) as i32).clamp(1, 4);
            let across = tangent(seen(x - step, y), here, seen(x + step, y));
            let along = tangent(seen(x, y - step), here, seen(x, y + step));
            let facing = -here.normalize();
            let normal = along.cross(across).normalize_or(facing);
            let towards = normal * normal.dot(facing).signum();
            rgba((0.5 + 0.5 * towards).to_array())
        };
        (0..width * height).map(colour).collect()
    }
}

/// Range of the values without the share `BEYOND` at either end.
fn range(values: impl Iterator<Item = f32>) -> [f32; 2] {
    let mut sorted: Vec<f32> = values.collect();
    sorted.sort_by(f32::total_cmp);
    let last = sorted.len().saturating_sub(1) as f32;
    let at = |share: f32| sorted.get((share * last) as usize).copied();
    let low = at(BEYOND).unwrap_or(0.0);
    // Never empty, so that a place in it is defined.
    [low, at(1.0 - BEYOND).unwrap_or(0.0).max(low + f32::EPSILON)]
}

fn mapped(map: ColourMap, place: Option<f32>) -> [u8; 4] {
    rgba(place.map_or(NOTHING, |place| map.at(place)))
}

fn rgba(colour: [f32; 3]) -> [u8; 4] {
    let [red, green, blue] = colour.map(|part| (255.0 * part).round() as u8);
    [red, green, blue, 255]
}
