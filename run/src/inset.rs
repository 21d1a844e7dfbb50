//! An inset of the film: the first second of boiling, at a quarter of its speed.

use glam::{Quat, Vec3};
use vitriol_render::{Fov, View};
use vitriol_shaders::Library;
use vitriol_sim::world::World;

use crate::camera::{Camera, Colour, Shot};
use crate::canvas::Canvas;
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
/// Its picture's width over the glass's.
const WIDER: f32 = 1.25;
/// From the liquid's surface to the eye, m: that of the film, a little higher, so that the surface is seen from above.
const EYE: Vec3 = Vec3::new(0.0, 0.40, 0.62);

/// Pictures of a glass in which it boils.
pub struct Inset {
    camera: Camera,
    flask: usize,
    /// Depth of its liquid at the start, m of the scene.
    depth: f32,
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
        let radius = scene.flasks[flask].profile.outer_radius();
        Ok(Self {
            camera: Camera::new(world.gpu(), library, scene, &shot)?,
            flask,
            depth: (volume / (std::f64::consts::PI * radius * radius)) as f32,
            field: 2.0 * (WIDER * radius as f32 / EYE.length()).atan(),
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
            let surface = world.poses()[self.flask].position + self.depth * Vec3::Y;
            self.camera.view = View::look_at(
                surface + Quat::from_rotation_y(turn) * EYE,
                surface,
                Fov::symmetric(self.field, 1.0),
            );
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
