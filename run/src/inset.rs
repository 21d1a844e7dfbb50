//! An inset of the film: the first second of boiling, at a quarter of its speed.

use glam::{Quat, Vec3};
use vitriol_render::{Fov, View};
use vitriol_shaders::Library;
use vitriol_sim::world::World;

use crate::camera::{Camera, Colour, Shot};
use crate::canvas::Canvas;
use crate::director::size;
use crate::failure::Failure;
use crate::legend::SIZE;
use crate::scenery::drawn_liquid;

/// Simulated time that it shows, s, and how many times slower than it was.
const SHOWS: f64 = 1.0;
const SLOWER: f64 = 4.0;
/// Its width and height, its frame, and its distance from the film's right and lower edge, pixels.
const EXTENT: [u32; 2] = [300, 300];
const FRAME: usize = 3;
const MARGIN: usize = 16;
/// Smallest film that has room for it beside the glass, pixels.
const LEAST_FILM: [u32; 2] = [960, 540];
/// Its picture's width over the glass's, at least.
const WIDER: f32 = 1.25;
/// What it shows below the liquid's surface and above the rim, in the glass's radii: drops that leave are seen over the rim.
const BEYOND: f32 = 0.5;
/// From the middle of surface and rim to the eye, m: that of the film, a little higher, so that the surface is seen from above.
const EYE: Vec3 = Vec3::new(0.0, 0.40, 0.62);

/// Pictures of a glass in which it boils.
pub struct Inset {
    camera: Camera,
    flask: usize,
    /// Height of what is looked at over the flask's foot, m of the scene: half-way from the liquid's surface at the start to the rim.
    middle: f32,
    field: f32,
    /// When it begins, s after the scene's start.
    from: f64,
    /// Each with its time, s after the scene's start.
    pictures: Vec<(f64, Vec<u8>)>,
}

impl Inset {
    /// Whether a film of that width and height (pixels) has room for it.
    pub fn fits(film: [u32; 2]) -> bool {
        film[0] >= LEAST_FILM[0] && film[1] >= LEAST_FILM[1]
    }

    /// Close to that flask, with so much liquid in it (m³ of the scene), from that time after the scene's start on (s).
    ///
    /// # Errors
    /// An error of the device.
    pub fn of(
        world: &World,
        library: &Library,
        shot: Shot,
        (flask, volume): (usize, f64),
        from: f64,
    ) -> Result<Self, Failure> {
        let scene = world.scene();
        let shot = Shot {
            extent: EXTENT,
            liquid: Some(drawn_liquid(world)),
            ..shot
        };
        let (middle, field) = framing(size(scene, flask), volume as f32);
        Ok(Self {
            camera: Camera::new(world.gpu(), library, scene, &shot)?,
            flask,
            middle,
            field,
            from,
            pictures: Vec::new(),
        })
    }

    /// Takes a picture of the state `now` (s after the scene's start), while it is one that is shown, with the hands and drops that the
    /// film's camera shows, and the eye turned as its. Waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn take(
        &mut self,
        world: &World,
        (film, turn): (&Camera, f32),
        now: f64,
    ) -> Result<(), Failure> {
        if now <= self.from + SHOWS {
            self.camera.show_like(film);
            // In a hand that swirls it stays in the picture's middle.
            let middle = world.poses()[self.flask].position + self.middle * Vec3::Y;
            self.camera.view = view(middle, turn, self.field);
            let picture = self.camera.shoot_bare(world, Colour::Liquid)?;
            self.pictures.push((now, picture));
        }
        Ok(())
    }

    /// Lays the picture that is shown `now` (s after the scene's start) into the lower right corner of a film's, whose rows have
    /// `width` pixels.
    pub fn lay(&self, film: &mut [u8], width: usize, now: f64) {
        let since = now - self.from;
        if !(0.0..=SLOWER * SHOWS).contains(&since) {
            return;
        }
        let shown = self.from + since / SLOWER;
        let taken = self.pictures.iter();
        let Some((_, picture)) = taken.take_while(|(time, _)| *time <= shown + 1e-9).last() else {
            return;
        };
        let height = film.len() / 4 / width;
        let extent = EXTENT.map(|pixels| pixels as usize);
        let outer = extent.map(|pixels| pixels + 2 * FRAME);
        let corner = [width - MARGIN - outer[0], height - MARGIN - outer[1]];
        let title = SIZE.val() + 6;
        let mut canvas = Canvas::new(film, width);
        for y in corner[1]..corner[1] + outer[1] {
            for x in corner[0]..corner[0] + outer[0] {
                canvas.blend(x, y, [255; 3], 255);
            }
        }
        canvas.panel([corner[0], corner[1] - title], [outer[0], title]);
        let caption = format!("first second, {SLOWER:.0} times slower");
        canvas.write(SIZE, [corner[0] + 8, corner[1] - title + 3], &caption);
        for (row, pixels) in picture.chunks_exact(4 * extent[0]).enumerate() {
            let first = 4 * ((corner[1] + FRAME + row) * width + corner[0] + FRAME);
            if let Some(place) = film.get_mut(first..first + pixels.len()) {
                place.copy_from_slice(pixels);
            }
        }
    }
}

/// Height of what is looked at over a glass's foot (m), and the field of view (radians), for a glass of that height and radius (m) with that
/// volume of liquid in it (m³).
fn framing([height, radius]: [f32; 2], volume: f32) -> (f32, f32) {
    let depth = volume / (std::f32::consts::PI * radius * radius);
    let middle = 0.5 * (depth + height);
    let half = (height - middle + BEYOND * radius).max(WIDER * radius);
    (middle, 2.0 * (half / EYE.length()).atan())
}

fn view(middle: Vec3, turn: f32, field: f32) -> View {
    View::look_at(
        middle + Quat::from_rotation_y(turn) * EYE,
        middle,
        Fov::symmetric(field, 1.0),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beakers of 250 and 400 mL (ISO 3819) with 120 and 180 mL in them: surface and rim are in the picture, and so are drops a quarter of
    /// the glass's width above the rim's middle. The glass fills half of its width or more.
    #[test]
    fn surface_rim_and_what_leaves_are_seen() {
        for ([height, radius], volume) in [([0.095, 0.035], 1.2e-4), ([0.110, 0.040], 1.8e-4)] {
            let (middle, field) = framing([height, radius], volume);
            let foot = Vec3::new(0.12, 0.75, -0.4);
            let clip = view(foot + middle * Vec3::Y, 0.6, field).clip_from_scaled(1.0);
            let seen = |x: f32, y: f32, z: f32| clip.project_point3(foot + Vec3::new(x, y, z));
            let depth = volume / (std::f32::consts::PI * radius * radius);
            let rings = [depth, height].map(|level| {
                (0..64).map(move |n| {
                    let (sin, cos) = (n as f32 * std::f32::consts::TAU / 64.0).sin_cos();
                    seen(radius * cos, level, radius * sin)
                })
            });
            let ring: Vec<Vec3> = rings.into_iter().flatten().collect();
            let all = ring.iter().copied();
            let drop = seen(0.0, height + 0.5 * radius, 0.0);
            for at in all.chain([drop]) {
                assert!(at.x.abs() < 1.0 && at.y.abs() < 1.0, "{at}");
            }
            let widest = ring.iter().map(|at| at.x).fold(f32::MIN, f32::max);
            assert!(widest > 0.5, "{widest}");
        }
    }
}
