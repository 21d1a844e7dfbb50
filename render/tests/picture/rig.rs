//! A device with the validation layer, and spheres drawn by plain ray casting
//! in f64 to compare with.

use std::path::Path;

use glam::{Affine3A, DVec3, EulerRot, Quat, Vec3};
use vitriol_gpu::{Buffer, Image, ImageDesc, NoUninit, QueueKind, vk};
use vitriol_render::camera::NEAR;
use vitriol_render::{
    Fov, FrameDesc, ParticleSource, RenderDesc, RenderError, Renderer, SceneDesc, VesselDesc, View,
};
use vitriol_shaders::Library;
use vitriol_tests::gpu::{self, Watched};

/// The pictures of a frame: a layer a view.
pub struct Picture {
    /// sRGB, four bytes a pixel.
    pub colour: Vec<Vec<u8>>,
    /// Reversed depth.
    pub depth: Vec<Vec<f32>>,
}

pub struct Rig {
    pub renderer: Renderer,
    /// Dropped last: a message of the validation layer fails the test then.
    pub gpu: Watched,
    pub extent: [u32; 2],
}

impl Rig {
    pub fn new(extent: [u32; 2], views: u32) -> Self {
        Self::of(&Library::watching(), extent, views)
    }

    /// A rig whose shaders are those of the folder, each changed by `edit`.
    pub fn edited(extent: [u32; 2], edit: impl Fn(&str, String) -> String) -> Self {
        let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shaders/wgsl"));
        let mut folders = vec![root.to_path_buf()];
        let mut sources = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                    continue;
                }
                let name = path.strip_prefix(root).unwrap().to_str().unwrap();
                let name = name.replace('\\', "/");
                let text = std::fs::read_to_string(&path).unwrap();
                sources.push((name.clone(), edit(&name, text)));
            }
        }
        Self::of(&Library::from_sources(sources), extent, 1)
    }

    fn of(library: &Library, extent: [u32; 2], views: u32) -> Self {
        let gpu = gpu::device();
        let desc = RenderDesc {
            views,
            ..RenderDesc::film(extent)
        };
        let renderer = Renderer::new(&gpu, library, &desc).unwrap();
        Self {
            gpu,
            renderer,
            extent,
        }
    }

    pub fn set_scene(&mut self, scene: &SceneDesc) {
        self.renderer.set_scene(scene).unwrap();
    }

    /// A scene of these vessels alone.
    pub fn set_vessels(&mut self, vessels: Vec<VesselDesc>) {
        self.set_scene(&SceneDesc {
            vessels,
            ..SceneDesc::default()
        });
    }

    pub fn buffer(&self, label: &str, data: &[[f32; 4]]) -> Buffer {
        self.filled(label, data)
    }

    /// A buffer of any data.
    pub fn filled<T: NoUninit>(&self, label: &str, data: &[T]) -> Buffer {
        let buffer = Buffer::storage(&self.gpu, label, size_of_val(data) as u64).unwrap();
        self.gpu.write(&buffer, data).unwrap();
        buffer
    }

    /// An image of these texels, RGBA from the lowest byte on, rows from the top.
    pub fn image(&self, extent: [u32; 2], texels: &[u32]) -> Image {
        let desc = ImageDesc {
            extent,
            layers: 1,
            format: vk::Format::R8G8B8A8_UNORM,
            usage: vk::ImageUsageFlags::SAMPLED,
        };
        let buffer = self.filled("texels", texels);
        let image = Image::new(&self.gpu, "panel", desc).unwrap();
        let mut rec = self.gpu.recorder(QueueKind::Main).unwrap();
        rec.copy_to_image(&buffer, &image).unwrap();
        self.gpu.submit(rec).unwrap().wait().unwrap();
        image
    }

    /// Draws a frame.
    pub fn draw(&self, frame: &FrameDesc<'_>) -> Picture {
        let mut rec = self.gpu.recorder(QueueKind::Main).unwrap();
        self.renderer.record(&mut rec, frame).unwrap();
        let first_view = self.renderer.read_back(&mut rec).unwrap();
        let colour = rec.read_back_image(self.renderer.image()).unwrap();
        let depth = rec.read_back(self.renderer.depth()).unwrap();
        self.gpu.submit(rec).unwrap().wait().unwrap();
        let pixels = (self.extent[0] * self.extent[1]) as usize;
        let layers = |bytes: Vec<u8>| bytes.chunks(4 * pixels).map(<[u8]>::to_vec).collect();
        let colour: Vec<_> = layers(colour.get().unwrap());
        assert_eq!(first_view.first_view().unwrap(), colour[0]);
        Picture {
            colour,
            depth: depth
                .get::<f32>()
                .unwrap()
                .chunks(pixels)
                .map(<[f32]>::to_vec)
                .collect(),
        }
    }

    /// The error for a frame that is refused.
    pub fn refusal(&self, frame: &FrameDesc<'_>) -> RenderError {
        let mut rec = self.gpu.recorder(QueueKind::Main).unwrap();
        self.renderer.record(&mut rec, frame).unwrap_err()
    }

    /// Draws particles at rest of one radius.
    pub fn draw_spheres(&self, views: &[View], positions: &[[f32; 4]], radius: f32) -> Picture {
        let velocities = vec![[0.0; 4]; positions.len()];
        let positions_buffer = self.buffer("positions", positions);
        let velocities_buffer = self.buffer("velocities", &velocities);
        self.draw(&FrameDesc {
            particles: Some(ParticleSource {
                positions: &positions_buffer,
                attributes: &velocities_buffer,
                count: positions.len() as u32,
                radius,
            }),
            ..FrameDesc::empty(views)
        })
    }

    /// Reference of one view of `draw_spheres`.
    pub fn reference(&self, view: &View, positions: &[[f32; 4]], radius: f32) -> Reference {
        let [width, height] = self.extent;
        let mut depth = Vec::new();
        let mut facing = Vec::new();
        let eye = view.stage_from_eye.translation.as_dvec3();
        let centres: Vec<DVec3> = positions
            .iter()
            .map(|p| Vec3::from_slice(p).as_dvec3() - eye)
            .collect();
        for y in 0..height {
            for x in 0..width {
                let ray = ray(view, self.extent, x, y);
                let axis = ray.dot(view.stage_from_eye.matrix3.z_axis.as_dvec3());
                let mut nearest = (0.0, 0.0);
                for centre in &centres {
                    if let Some((t, cosine)) = enter(*centre, f64::from(radius), ray) {
                        let depth = f64::from(NEAR) / (t * -axis);
                        if depth > nearest.0 {
                            nearest = (depth, cosine);
                        }
                    }
                }
                depth.push(nearest.0);
                facing.push(nearest.1);
            }
        }
        Reference { depth, facing }
    }
}

/// The left quarter of a picture, as a mesh of the part that a lens hides.
pub const LEFT_QUARTER: [[f32; 2]; 6] = [
    [0.0, 0.0],
    [0.25, 0.0],
    [0.25, 1.0],
    [0.0, 0.0],
    [0.25, 1.0],
    [0.0, 1.0],
];

/// A cylinder of glass with these radii of its inside and its outside, a floor so thick and a rim so high, m.
pub fn cylinder([inner, outer]: [f64; 2], floor: f64, height: f64) -> VesselDesc {
    VesselDesc {
        inner: vec![[0.0, floor], [inner, floor], [inner, height]],
        outer: vec![[0.0, 0.0], [outer, 0.0], [outer, height]],
        ..VesselDesc::default()
    }
}

/// Light as it is displayed: K. Narkowicz's fit of ACES.
pub fn displayed(light: f64) -> f64 {
    light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14)
}

/// Linear light of a level of sRGB (IEC 61966-2-1).
pub fn linear(level: u8) -> f64 {
    let share = f64::from(level) / 255.0;
    if share <= 0.040_45 {
        share / 12.92
    } else {
        ((share + 0.055) / 1.055).powf(2.4)
    }
}

/// A headset's left eye, wide to the left and down, in a turned head.
pub fn turned_eye() -> View {
    let turn = Quat::from_euler(EulerRot::YXZ, 0.7, -0.4, 0.3);
    View {
        stage_from_eye: Affine3A::from_rotation_translation(turn, Vec3::new(0.3, 1.5, 0.2)),
        fov: Fov {
            left: -0.94,
            right: 0.70,
            up: 0.73,
            down: -0.96,
        },
    }
}

/// The right eye of such a head, 64 mm beside the left one, with a mirrored frustum.
pub fn right_of(left: &View) -> View {
    let mut right = *left;
    right.stage_from_eye =
        left.stage_from_eye * Affine3A::from_translation(Vec3::new(0.064, 0.0, 0.0));
    (right.fov.left, right.fov.right) = (-left.fov.right, -left.fov.left);
    right
}

/// Unit vector from the eye through a pixel's centre, in the stage.
pub fn ray(view: &View, extent: [u32; 2], x: u32, y: u32) -> DVec3 {
    let slope = |from: f32, to: f32, pixel: u32, count: u32| {
        let (from, to) = (f64::from(from).tan(), f64::from(to).tan());
        from + (to - from) * (f64::from(pixel) + 0.5) / f64::from(count)
    };
    let fov = view.fov;
    let in_eye = DVec3::new(
        slope(fov.left, fov.right, x, extent[0]),
        slope(fov.up, fov.down, y, extent[1]),
        -1.0,
    );
    (view.stage_from_eye.matrix3.as_dmat3() * in_eye).normalize()
}

/// Where a ray from the origin enters a sphere, as distance, and the cosine
/// between ray and normal there. None from within.
fn enter(centre: DVec3, radius: f64, ray: DVec3) -> Option<(f64, f64)> {
    let along = centre.dot(ray);
    let miss_squared = centre.length_squared() - along * along;
    let inside = radius * radius - miss_squared;
    if inside < 0.0 || along < 0.0 || centre.length_squared() <= radius * radius {
        return None;
    }
    Some((along - inside.sqrt(), inside.sqrt() / radius))
}

pub struct Reference {
    /// Reversed depth, 0 where there is nothing.
    pub depth: Vec<f64>,
    /// Cosine between view ray and normal of the sphere that is seen.
    pub facing: Vec<f64>,
}

impl Reference {
    /// Compares a view with this: silhouettes to a pixel, and depth where the surface faces the eye by more than 0.2, to `tolerance`
    /// (relative) and its change in a 256th of a pixel: corners of triangles are snapped to that grid (Vulkan asks for a 16th at least;
    /// every driver here has eight bits). Returns the number of pixels whose depth was compared.
    pub fn compare(&self, drawn: &[f32], extent: [u32; 2], tolerance: f64) -> usize {
        let [width, height] = extent.map(|size| size as i32);
        let mut compared = 0;
        for y in 0..height {
            for x in 0..width {
                let index = (y * width + x) as usize;
                let (wanted, got) = (self.depth[index], f64::from(drawn[index]));
                let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
                let neighbours: Vec<usize> = around
                    .filter(|(x, y)| (0..width).contains(x) && (0..height).contains(y))
                    .map(|(x, y)| (y * width + x) as usize)
                    .collect();
                if (wanted > 0.0) != (got > 0.0) {
                    assert!(
                        neighbours
                            .iter()
                            .any(|&other| (self.depth[other] > 0.0) != (wanted > 0.0)),
                        "({x}, {y}): depth {got}, expected {wanted}, not at a silhouette"
                    );
                } else if neighbours.iter().all(|&other| self.facing[other] > 0.2) {
                    let steepness = neighbours
                        .iter()
                        .map(|&other| (self.depth[other] - wanted).abs())
                        .fold(0.0, f64::max);
                    assert!(
                        (got - wanted).abs() < tolerance * wanted + steepness / 256.0,
                        "({x}, {y}): depth {got}, expected {wanted}"
                    );
                    compared += 1;
                }
            }
        }
        compared
    }
}
