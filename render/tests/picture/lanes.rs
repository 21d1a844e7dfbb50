//! Any number of lanes that this device has draws the same liquid: so lanes that a GPU takes are tested on a software driver too, which by
//! itself takes others.

use crate::liquid::{Liquid, SPACING, draw, ellipsoids, frame, lattice, rig_of_lanes};
use crate::rig::Picture;
use glam::{Affine3A, EulerRot, Quat, Vec3};
use vitriol_gpu::Gpu;
use vitriol_render::{
    ColourBy, Fov, FrameDesc, Lanes, LiquidDesc, ParticleSource, RenderDesc, RenderError, Renderer,
    Surface, SurfaceFilter, View,
};
use vitriol_shaders::Library;
use vitriol_shaders::layout::Ellipsoid;
use vitriol_tests::gpu;

const EXTENT: [u32; 2] = [320, 240];
/// Lanes of pixels: those of a CPU, those of a GPU for ellipsoids, a whole workgroup, and those of a GPU for few spheres, which is many
/// workgroups.
const OF_PIXELS: [u32; 5] = [8, 16, 32, 64, 1024];

/// Lanes of neighbours that the device has, 1 first. It prints those that the device does not have.
pub fn of_neighbours(gpu: &Gpu) -> Vec<u32> {
    let info = gpu.info();
    let (has, lacks): (Vec<u32>, Vec<u32>) = [1, 2, 4, 8, 16, 32].into_iter().partition(|lanes| {
        *lanes == 1 || (info.features.subgroups && *lanes <= info.least_subgroup_size)
    });
    if !lacks.is_empty() {
        let least = info.least_subgroup_size;
        eprintln!("subgroups of {least}: not with {lacks:?} lanes");
    }
    has
}

fn view() -> View {
    let turn = Quat::from_euler(EulerRot::YXZ, 0.7, -0.4, 0.3);
    View {
        stage_from_eye: Affine3A::from_rotation_translation(turn, Vec3::new(0.3, 1.5, 0.2)),
        fov: Fov::symmetric(0.25, EXTENT[0] as f32 / EXTENT[1] as f32),
    }
}

/// A shaken ball, one half of it acid, with drops beside it, from near and far: silhouettes from
/// a few pixels to hundreds, and particles with any number of neighbours.
fn places() -> Vec<Vec3> {
    let at = |x: f32, y: f32, distance: f32| {
        view()
            .stage_from_eye
            .transform_point3(Vec3::new(x, y, -distance))
    };
    let ball = lattice(7, 0.3, |x| x.length() < 6.5);
    let mut places: Vec<Vec3> = ball.iter().map(|x| *x + at(0.0, 0.0, 0.25)).collect();
    places.extend([
        at(0.02, 0.01, 0.08),
        at(-0.03, 0.02, 0.2),
        at(0.2, -0.1, 1.0),
    ]);
    places
}

fn drawn(lanes: Lanes) -> (Picture, Surface, Vec<Ellipsoid>) {
    let rig = rig_of_lanes(EXTENT, 1, SurfaceFilter::NarrowRange, lanes);
    let places = places();
    let middle = places[0];
    let liquid = Liquid::new(&rig, &places, |x| if x.y > middle.y { 0.7 } else { 0.0 });
    let (picture, mut surfaces) = draw(&rig, &frame(&[view()], &[], &liquid));
    let ellipsoids = ellipsoids(&rig, places.len());
    (picture, surfaces.remove(0), ellipsoids)
}

fn pixels(lanes: u32) -> Lanes {
    Lanes {
        pixels: Some(lanes),
        ..Lanes::CHOSEN
    }
}

/// Depths are the greatest of numbers and thicknesses are sums of whole ones, so no order shows.
#[test]
fn lanes_of_pixels_change_no_bit() {
    let [(picture, surface, _), others @ ..] = OF_PIXELS.map(|lanes| drawn(pixels(lanes)));
    let seen = surface.depth.iter().filter(|depth| **depth > 0.0).count();
    assert!(seen > 5000, "{seen} pixels");
    for ((other, layers, _), lanes) in others.iter().zip(&OF_PIXELS[1..]) {
        assert!(layers.depth == surface.depth, "{lanes}: depth");
        assert!(layers.thickness == surface.thickness, "{lanes}: thickness");
        assert!(layers.acid == surface.acid, "{lanes}: acid");
        assert!(other.depth == picture.depth, "{lanes}: picture's depth");
        assert!(other.colour == picture.colour, "{lanes}: colour");
    }
}

/// Lanes part a particle's neighbours: other sums, the same liquid. `ellipsoids` compares each
/// with double precision.
#[test]
fn lanes_of_neighbours_change_nothing_but_rounding() {
    let device = gpu::device();
    let all = of_neighbours(&device);
    let of = |lanes: u32| {
        drawn(Lanes {
            neighbours: Some(lanes),
            ..Lanes::CHOSEN
        })
    };
    let (picture, surface, ellipsoids) = of(all[0]);
    for lanes in &all[1..] {
        let (other, layers, others) = of(*lanes);
        let pairs = ellipsoids.iter().zip(&others);
        let off = pairs.map(|(a, b)| Vec3::from(a.centre).distance(Vec3::from(b.centre)));
        let off = off.fold(0.0, f32::max) / SPACING;
        let depths = surface.depth.iter().zip(&layers.depth);
        let farther = depths.filter(|(a, b)| (*a - *b).abs() > 4e-3 * SPACING);
        let levels = picture.colour[0].iter().zip(&other.colour[0]);
        let changed = levels.filter(|(a, b)| a.abs_diff(**b) > 1);
        let (farther, changed) = (farther.count(), changed.count());
        eprintln!("{lanes}: {off:e} d, {farther} depths, {changed} levels");
        // Twice what `ellipsoids` allows one of them beside double precision: centres of 1e-4 d, axes of 2e-3 d.
        assert!(off < 2e-4, "{lanes}: {off} d");
        // At a silhouette a pixel may be another particle's: here none is.
        assert!(farther <= surface.depth.len() / 1000, "{lanes}: {farther}");
        assert!(
            changed <= picture.colour[0].len() / 1000,
            "{lanes}: {changed}"
        );
    }
}

#[test]
fn lanes_beyond_shader_or_device_are_refused() {
    let device = gpu::device();
    let most = *of_neighbours(&device).last().unwrap();
    let made = |lanes: Lanes| {
        let desc = RenderDesc {
            liquid: Some(LiquidDesc::new(10)),
            lanes,
            ..RenderDesc::film([64, 36])
        };
        Renderer::new(&device, &Library::watching(), &desc).map(|_| ())
    };
    for asked in [0, 3, 2 * most] {
        let lanes = Lanes {
            neighbours: Some(asked),
            ..Lanes::CHOSEN
        };
        match made(lanes) {
            Err(error @ RenderError::Lanes { .. }) => {
                let said = error.to_string();
                assert!(said.contains(&format!("from 1 to {most}")), "{said}");
            }
            other => panic!("{asked}: {other:?}"),
        }
    }
    for asked in [0, 4, 24, 2048] {
        let refused = made(pixels(asked));
        assert!(
            matches!(refused, Err(RenderError::Lanes { .. })),
            "{asked}: {refused:?}"
        );
    }
    made(Lanes::CHOSEN).unwrap();
}

mod long {
    use super::*;

    #[test]
    fn lanes_of_spheres_change_no_bit() {
        let [first, others @ ..] = OF_PIXELS.map(|lanes| {
            let rig = rig_of_lanes(EXTENT, 1, SurfaceFilter::None, pixels(lanes));
            let places: Vec<_> = places().iter().map(|x| x.extend(1.0).to_array()).collect();
            let speeds: Vec<_> = (0..places.len())
                .map(|i| [0.01 * i as f32, 0.0, 0.0, 0.0])
                .collect();
            let (positions, attributes) =
                (rig.buffer("places", &places), rig.buffer("speeds", &speeds));
            rig.draw(&FrameDesc {
                particles: Some(ParticleSource {
                    positions: &positions,
                    attributes: &attributes,
                    count: places.len() as u32,
                    radius: 0.5 * SPACING,
                }),
                colour_by: ColourBy::Speed(10.0),
                ..FrameDesc::empty(&[view()])
            })
        });
        let seen = first.depth[0].iter().filter(|depth| **depth > 0.0);
        assert!(seen.count() > 5000);
        for (other, lanes) in others.iter().zip(&OF_PIXELS[1..]) {
            assert!(other.depth == first.depth, "{lanes}: depth");
            assert!(other.colour == first.colour, "{lanes}: colour");
        }
    }
}
