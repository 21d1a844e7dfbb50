//! Liquid in buffers of the test's own, with its neighbour list by brute force.

use crate::rig::{Picture, Rig};
use glam::{Affine3A, Vec3};
use vitriol_gpu::{Buffer, QueueKind};
use vitriol_render::{
    BoxDesc, BubbleSource, FrameDesc, Lanes, LiquidDesc, LiquidSource, Neighbours, RenderDesc,
    Renderer, SpraySource, Surface, SurfaceFilter, Tint, View,
};
use vitriol_shaders::{Library, layout};
use vitriol_tests::{gpu, list};

/// Particle spacing d, metres.
pub const SPACING: f32 = 0.0025;
/// Support radius h.
pub const SUPPORT: f32 = 2.0 * SPACING;

/// Mass of a particle of water, kg.
pub const MASS: f32 = 1000.0 * SPACING * SPACING * SPACING;

/// Rows of the list that the buffers hold.
const CAPACITY: usize = 96;

/// Places of particles in so many layers over `foot`, within `radius` (m) of the axis.
pub fn upright_cylinder(foot: Vec3, radius: f32, layers: usize) -> Vec<Vec3> {
    let mut places = Vec::new();
    for n in 0..layers * 16 * 16 {
        let [x, y, z] = [n % 16, n / 256, n / 16 % 16];
        let at = SPACING * Vec3::new(x as f32 - 7.5, y as f32 + 0.5, z as f32 - 7.5);
        if at.with_y(0.0).length() < radius {
            places.push(foot + at);
        }
    }
    places
}

/// Particles on the device.
pub struct Liquid {
    positions: Buffer,
    heat: Buffer,
    counts: Buffer,
    list: Buffer,
    count: u32,
    /// Metres as which its unit is drawn.
    unit: f32,
    pub table: Option<BoxDesc>,
    pub volumes: Option<Buffer>,
    /// Bubbles and their number, and drops that they threw up.
    pub bubbles: Option<(Buffer, u32)>,
    pub drops: Option<Buffer>,
}

impl Liquid {
    pub fn new(rig: &Rig, positions: &[Vec3], acid: impl Fn(Vec3) -> f32) -> Self {
        Self::in_units(rig, positions, acid, 1.0)
    }

    /// Particles at `positions` (metres) with the acid fraction `acid`, in a scene whose unit is drawn as `unit` metres. [`Liquid::new`]
    /// has a unit of one metre.
    pub fn in_units(rig: &Rig, positions: &[Vec3], acid: impl Fn(Vec3) -> f32, unit: f32) -> Self {
        let n = positions.len();
        let mut counts = vec![0_u32; n.max(1)];
        let mut list = vec![0_u32; list::words(n.max(1), CAPACITY)];
        for (i, a) in positions.iter().enumerate() {
            // In fours, filled up with the particle itself.
            for k in 0..CAPACITY {
                list[list::place(i, k, CAPACITY)] = i as u32;
            }
            for (j, b) in positions.iter().enumerate() {
                if i != j && a.distance_squared(*b) < SUPPORT * SUPPORT {
                    let k = counts[i] as usize;
                    list[list::place(i, k, CAPACITY)] = j as u32;
                    counts[i] += 1;
                }
            }
        }
        let heat: Vec<_> = positions
            .iter()
            .map(|&x| [20.0, acid(x), 0.0, 0.0])
            .collect();
        let places = positions.iter().map(|&x| (x / unit).extend(1.0).to_array());
        let places: Vec<_> = places.collect();
        Self {
            positions: rig.buffer("positions", &places),
            heat: rig.buffer("heat", &heat),
            counts: rig.filled("list counts", &counts),
            list: rig.filled("list", &list),
            count: n as u32,
            unit,
            table: None,
            volumes: None,
            bubbles: None,
            drops: None,
        }
    }

    pub fn source(&self) -> LiquidSource<'_> {
        LiquidSource {
            bubbles: self.bubbles.as_ref().map(|(bubbles, count)| BubbleSource {
                bubbles,
                count: *count,
                spray: self
                    .drops
                    .as_ref()
                    .map(|drops| SpraySource { drops, mass: MASS }),
            }),
            positions: &self.positions,
            heat: Some(&self.heat),
            volumes: self.volumes.as_ref(),
            count: self.count,
            spacing: SPACING / self.unit,
            neighbours: Some(Neighbours {
                counts: &self.counts,
                list: &self.list,
                fours: CAPACITY as u32 / 4,
                support: SUPPORT / self.unit,
            }),
            vessels: None,
            table: self.table,
            floor: -10.0,
        }
    }
}

/// A rig with a renderer of liquid.
pub fn rig(extent: [u32; 2], views: u32, filter: SurfaceFilter) -> Rig {
    rig_of_lanes(extent, views, filter, Lanes::CHOSEN)
}

/// A rig as of [`rig`], whose passes share particles between `lanes` invocations.
pub fn rig_of_lanes(extent: [u32; 2], views: u32, filter: SurfaceFilter, lanes: Lanes) -> Rig {
    rig_of(&RenderDesc {
        views,
        liquid: Some(LiquidDesc {
            filter,
            bubbles: 1024,
            ..LiquidDesc::new(20_000)
        }),
        lanes,
        ..RenderDesc::film(extent)
    })
}

/// A rig with a renderer of liquid that has no tint.
pub fn clear_rig(extent: [u32; 2]) -> Rig {
    rig_of(&RenderDesc {
        liquid: Some(LiquidDesc {
            tint: Tint::None,
            bubbles: 1024,
            ..LiquidDesc::new(20_000)
        }),
        ..RenderDesc::film(extent)
    })
}

/// A rig with a renderer made for `desc`.
pub fn rig_of(desc: &RenderDesc) -> Rig {
    let gpu = gpu::device();
    let renderer = Renderer::new(&gpu, &Library::watching(), desc).unwrap();
    Rig {
        gpu,
        renderer,
        extent: desc.extent,
    }
}

/// A frame that shows `liquid`.
pub fn frame<'a>(views: &'a [View], vessels: &'a [Affine3A], liquid: &'a Liquid) -> FrameDesc<'a> {
    FrameDesc {
        vessels,
        liquid: Some(liquid.source()),
        ..FrameDesc::empty(views)
    }
}

/// Draws a frame; the picture and each view's surface.
pub fn draw(rig: &Rig, frame: &FrameDesc<'_>) -> (Picture, Vec<Surface>) {
    let picture = rig.draw(frame);
    let mut rec = rig.gpu.recorder(QueueKind::Main).unwrap();
    let surface = rig.renderer.read_back_surface(&mut rec, frame).unwrap();
    rig.gpu.submit(rec).unwrap().wait().unwrap();
    (picture, surface.views().unwrap())
}

/// The ellipsoids of the frame that was drawn last.
pub fn ellipsoids(rig: &Rig, count: usize) -> Vec<layout::Ellipsoid> {
    let mut all: Vec<layout::Ellipsoid> = rig.gpu.read(rig.renderer.ellipsoids().unwrap()).unwrap();
    all.truncate(count);
    all
}

/// Places of a cubic lattice within `reach` spacings, jittered by up to `jitter` of one, where `inside` (in spacings) is true.
pub fn lattice(reach: i32, jitter: f32, inside: impl Fn(Vec3) -> bool) -> Vec<Vec3> {
    let mut noise = 1_u32;
    let mut shake = || {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((noise >> 8) as f32 / 16_777_216.0 - 0.5) * 2.0 * jitter
    };
    let mut places = Vec::new();
    for x in -reach..=reach {
        for y in -reach..=reach {
            for z in -reach..=reach {
                let place = Vec3::new(x as f32, y as f32, z as f32) - 0.5;
                let shaken = Vec3::new(shake(), shake(), shake());
                if inside(place) {
                    places.push((place + shaken) * SPACING);
                }
            }
        }
    }
    places
}
