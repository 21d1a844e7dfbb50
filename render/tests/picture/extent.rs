//! A picture smaller than the renderer's images, as the headset draws it when time is short.

use crate::liquid::{Liquid, SPACING, frame, lattice, rig};
use crate::rig::{LEFT_QUARTER, Picture, Rig, cylinder};
use glam::{Affine3A, Vec3};
use vitriol_render::{
    FrameDesc, ParticleSource, RenderDesc, RenderError, Renderer, SceneDesc, SteamSource,
    SurfaceFilter, VesselDesc, View,
};
use vitriol_shaders::Library;
use vitriol_shaders::layout::Puff;
use vitriol_tests::gpu;

const SMALL: [u32; 2] = [200, 150];
/// Twice as large, so that a mask's pixels fall together; and larger by no whole factor, nor of whole tiles.
const LARGE: [u32; 2] = [400, 300];
const ODD: [u32; 2] = [333, 251];

const FOOT: Vec3 = Vec3::new(0.0, 0.75, -0.4);

/// The left quarter of one eye, a corner of the other.
const HIDDEN: [&[[f32; 2]]; 2] = [
    &LEFT_QUARTER,
    &[
        [0.5, 0.5],
        [1.0, 0.5],
        [1.0, 1.0],
        [0.5, 0.5],
        [1.0, 1.0],
        [0.5, 1.0],
    ],
];

/// Glass, liquid, coloured spheres and steam for two eyes, drawn with `extent` by a renderer of `held`,
/// after another picture that filled its images.
fn pictures(held: [u32; 2], extent: [u32; 2], masked: bool) -> Picture {
    with_frame(held, masked, |rig, whole| {
        rig.draw(&whole);
        rig.draw(&FrameDesc {
            extent: Some(extent),
            ..whole
        })
    })
}

/// What is made of that frame, which fills the images of a renderer of `held`.
fn with_frame<T>(held: [u32; 2], masked: bool, then: impl FnOnce(&Rig, FrameDesc<'_>) -> T) -> T {
    let mut rig: Rig = rig(held, 2, SurfaceFilter::NarrowRange);
    let glass = VesselDesc {
        marks: vec![0.012, 0.022],
        ..cylinder([0.02, 0.022], 0.002, 0.05)
    };
    rig.set_scene(&SceneDesc::laboratory(vec![glass], 0.75, 1.0));
    if masked {
        rig.renderer.set_visibility_mask(&HIDDEN).unwrap();
    }
    let places = lattice(7, 0.3, |x| x.length() < 6.0);
    let middle = FOOT + Vec3::new(0.0, 0.02, 0.0);
    let places: Vec<_> = places.iter().map(|place| middle + *place).collect();
    let liquid = Liquid::new(&rig, &places, |x| if x.y < middle.y { 0.9 } else { 0.0 });
    let balls: Vec<_> = (0..5)
        .map(|n| [0.03 * n as f32 - 0.06, 0.8, -0.38, 1.0])
        .collect();
    let attributes: Vec<_> = (0..5).map(|n| [0.2 * n as f32, 0.0, 0.0, 0.0]).collect();
    let balls = (
        rig.buffer("balls", &balls),
        rig.buffer("attributes", &attributes),
    );
    let puff = Puff {
        position: (middle + Vec3::Y * 0.03).to_array(),
        radius: 0.02,
        depth: 1.0,
        ..Puff::default()
    };
    let puffs = rig.filled("puffs", &[puff]);
    let look = |x: f32| {
        let eye = FOOT + Vec3::new(x, 0.1, 0.2);
        View::look_at(eye, FOOT + Vec3::Y * 0.02, View::bench(4.0 / 3.0).fov)
    };
    let views = [look(0.02), look(0.09)];
    let vessels = [Affine3A::from_translation(FOOT)];
    let whole = FrameDesc {
        particles: Some(ParticleSource {
            positions: &balls.0,
            attributes: &balls.1,
            count: 5,
            radius: 2.0 * SPACING,
        }),
        steam: Some(SteamSource {
            puffs: &puffs,
            count: 1,
            dew: None,
        }),
        ..frame(&views, &vessels, &liquid)
    };
    then(&rig, whole)
}

/// A frame of one view draws the first of two pictures, to the bit, and leaves the other one as it was.
#[test]
fn one_view_is_one_picture() {
    let both = pictures(SMALL, SMALL, false);
    let [before, one] = with_frame(SMALL, false, |rig, whole| {
        let &[left, right] = whole.views else {
            unreachable!("it is of two eyes")
        };
        let exchanged = [right, left];
        let before = rig.draw(&FrameDesc {
            views: &exchanged,
            ..whole
        });
        let one = rig.draw(&FrameDesc {
            views: &whole.views[..1],
            ..whole
        });
        [before, one]
    });
    assert!(one.colour[0] == both.colour[0] && one.depth[0] == both.depth[0]);
    assert!(one.colour[1] == before.colour[1] && one.depth[1] == before.depth[1]);
    for eye in [0, 1] {
        assert!(before.colour[eye] != both.colour[eye], "{eye}");
    }
}

/// How much a smoothed edge may differ, levels of 255: a sampler takes places as shares of the image, and
/// rounds them to 1/256 of a pixel at best (`subTexelPrecisionBits`), which is another place in another image.
const SAMPLED: u8 = 2;

/// The upper left corner is what a renderer of its own size draws, depths to the last bit: no pass reads pixels beside it, and every pass
/// finds its own.
fn is_that_of_a_smaller_renderer(cases: &[([u32; 2], bool)]) {
    for &(held, masked) in cases {
        let alone = pictures(SMALL, SMALL, masked);
        let within = pictures(held, SMALL, masked);
        let of_row = |all: &[u8], y: u32, width: u32| -> Vec<u8> {
            let from = (4 * y * width) as usize;
            all[from..from + 4 * SMALL[0] as usize].to_vec()
        };
        for eye in 0..2 {
            let (small, large) = (&alone.colour[eye], &within.colour[eye]);
            assert!(small.chunks(4).any(|pixel| pixel != &small[..4]));
            for y in 0..SMALL[1] {
                let (a, b) = (of_row(small, y, SMALL[0]), of_row(large, y, held[0]));
                let most = a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b)).max();
                assert!(
                    most <= Some(SAMPLED),
                    "{held:?}, eye {eye}, row {y}: {most:?}"
                );
                let row = |all: &[f32], width: u32| {
                    let from = (y * width) as usize;
                    all[from..from + SMALL[0] as usize].to_vec()
                };
                let (a, b) = (&alone.depth[eye], &within.depth[eye]);
                assert!(
                    row(a, SMALL[0]) == row(b, held[0]),
                    "{held:?}, depth, row {y}"
                );
            }
        }
    }
}

#[test]
fn smaller_picture_is_that_of_a_smaller_renderer() {
    is_that_of_a_smaller_renderer(&[(LARGE, true)]);
}

#[test]
fn picture_larger_than_the_images_is_refused() {
    let rig = Rig::new(SMALL, 1);
    let views = [View::bench(4.0 / 3.0)];
    for extent in [[201, 150], [200, 151], [0, 10]] {
        let frame = FrameDesc {
            extent: Some(extent),
            ..FrameDesc::empty(&views)
        };
        let error = rig.refusal(&frame);
        assert!(matches!(error, RenderError::Extent { .. }), "{error}");
    }
}

/// It was said of a buffer of the liquid's, with the advice to use fewer particles.
#[test]
fn a_picture_of_more_pixels_than_a_buffer_has_numbers_is_refused() {
    let gpu = gpu::device();
    // The Vulkan specification: no storage buffer's range is longer than this.
    let limit = gpu.info().limits.storage_bytes;
    let width = 16_384_u32;
    let height = u32::try_from(limit / 4 / u64::from(width)).unwrap() + 1;
    for (views, rows) in [(1, height), (2, height / 2 + 1)] {
        let desc = RenderDesc {
            views,
            ..RenderDesc::film([width, rows])
        };
        let error = Renderer::new(&gpu, &Library::watching(), &desc)
            .err()
            .unwrap();
        let said = error.to_string();
        assert!(said.contains(&format!("{width}x{rows} pixels")), "{said}");
        assert!(said.contains("--size"), "{said}");
        let RenderError::TooManyPixels { largest, .. } = error else {
            unreachable!("{error}")
        };
        let bytes = |[width, height]: [u32; 2]| 4 * u64::from(views * width) * u64::from(height);
        assert!(bytes(largest) <= limit, "{largest:?}");
        let larger = largest.map(|side| side + 1);
        assert!(bytes(larger) > limit, "{larger:?}");
    }
}

mod long {
    use super::*;

    #[test]
    fn smaller_picture_of_any_images_is_that_of_a_smaller_renderer() {
        is_that_of_a_smaller_renderer(&[(LARGE, false), (ODD, false)]);
    }
}
