//! The halved depth for a runtime: the nearest of each two by two pixels.

use glam::Vec3;
use vitriol_gpu::QueueKind;
use vitriol_render::{Fov, FrameDesc, HalfDepth, SceneDesc, View};
use vitriol_shaders::Library;

use crate::rig::Rig;

const EXTENT: [u32; 2] = [94, 71];

/// For a bench that two eyes look at, whole and smaller, with even and odd sides, and for the pixels that the lenses do not hide.
#[test]
fn it_is_the_nearest_of_each_two_by_two() {
    let mut rig = Rig::new(EXTENT, 2);
    rig.set_scene(&SceneDesc::laboratory(Vec::new(), 0.75, 1.0));
    let masks: [&[[f32; 2]]; 2] = [&[], &[[0.0, 0.0], [0.6, 0.0], [0.0, 0.7]]];
    rig.renderer.set_visibility_mask(&masks).unwrap();
    let half = HalfDepth::new(&rig.gpu, &Library::watching(), EXTENT, 2).unwrap();
    let look = |x: f32| {
        let fov = Fov::symmetric(1.4, 94.0 / 71.0);
        View::look_at(Vec3::new(x, 1.1, 0.1), Vec3::new(0.0, 0.75, -0.4), fov)
    };
    let views = [look(-0.03), look(0.04)];
    // The last is for an image of a smaller picture.
    for (drawn, whole) in [
        (EXTENT, EXTENT),
        ([60, 44], EXTENT),
        ([33, 21], EXTENT),
        ([60, 44], [67, 47]),
    ] {
        let frame = FrameDesc {
            extent: Some(drawn),
            ..FrameDesc::empty(&views)
        };
        let full = rig.draw(&frame).depth;
        let mut rec = rig.gpu.recorder(QueueKind::Main).unwrap();
        half.record(&mut rec, &rig.renderer, drawn, whole).unwrap();
        let halved = rec.read_back(half.depth()).unwrap();
        rig.gpu.submit(rec).unwrap().wait().unwrap();
        let halved = halved.get::<f32>().unwrap();
        let [across, down] = whole.map(|side| side.div_ceil(2));
        assert!(halved.len() as u32 >= 2 * across * down);
        let (mut steps, mut all_hidden) = (0, 0);
        for (eye, full) in (0..2).zip(&full) {
            let [width, height] = drawn.map(|side| side.div_ceil(2));
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                // Every pixel of the picture that overlaps it at all, by its share of the field of view.
                let within = |at: u32, side: usize, pixel: u32| {
                    let count = f64::from(drawn[side].div_ceil(2));
                    let scale = f64::from(drawn[side]) / count;
                    let (low, high) = (f64::from(at) * scale, f64::from(at + 1) * scale);
                    let pixel = f64::from(pixel);
                    pixel + 1.0 > low + 1e-9 && pixel < high - 1e-9
                };
                let rows = (0..drawn[1]).filter(|pixel| within(y, 1, *pixel));
                let pixels = rows.flat_map(|row| {
                    let columns = (0..drawn[0]).filter(move |pixel| within(x, 0, *pixel));
                    columns.map(move |column| full[(row * EXTENT[0] + column) as usize])
                });
                let pixels: Vec<f32> = pixels.collect();
                let seen = pixels.iter().copied().filter(|depth| *depth < 1.0);
                let nearest = seen.reduce(f32::max).unwrap_or(1.0);
                all_hidden += u32::from(nearest == 1.0);
                let found = halved[((eye * down + y) * across + x) as usize];
                assert_eq!(found, nearest, "{drawn:?}, eye {eye}, ({x}, {y})");
                steps += u32::from(pixels.iter().any(|depth| *depth != nearest));
            }
        }
        // The depth is not even where it matters.
        assert!(steps > 200, "{steps}");
        assert!(all_hidden > 20, "{all_hidden}");
    }
}
