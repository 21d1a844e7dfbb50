//! The panel where the picture is coarser than the window: it is sampled from its own image.

use vitriol_gpu::{Buffer, Gpu, Image, ImageDesc, QueueKind, vk};
use vitriol_session::mirror::{Layer, Shrink};
use vitriol_shaders::Library;
use vitriol_tests::gpu;

/// Colours as 0x00RRGGBB: of the picture where the panel is seen, of the picture elsewhere, and of the panel's stripes.
const SEEN: u32 = 0xc8_00_00;
const ROOM: u32 = 0x00_5a_00;
const STRIPES: [u32; 2] = [0x00_00_ff, 0xff_ff_00];

/// Width and height of the picture and of the window, pixels, and of the panel.
const DRAWN: [u32; 2] = [4, 2];
const WINDOW: [u32; 2] = [16, 8];
const PANEL: [u32; 2] = [64, 64];

/// An image with a colour and an alpha at each place.
fn image(gpu: &Gpu, extent: [u32; 2], texel: impl Fn(u32, u32) -> (u32, u8)) -> Image {
    let desc = ImageDesc {
        extent,
        layers: 1,
        format: vk::Format::R8G8B8A8_UNORM,
        usage: vk::ImageUsageFlags::SAMPLED,
    };
    let image = Image::new(gpu, "test", desc).unwrap();
    let places = (0..extent[1]).flat_map(|y| (0..extent[0]).map(move |x| (x, y)));
    let texels: Vec<u32> = places
        .map(|(x, y)| {
            let (colour, alpha) = texel(x, y);
            let [_, red, green, blue] = colour.to_be_bytes();
            u32::from_le_bytes([red, green, blue, alpha])
        })
        .collect();
    let buffer = Buffer::storage(gpu, "texels", 4 * texels.len() as u64).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.upload(&buffer, &texels).unwrap();
    rec.copy_to_image(&buffer, &image).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    image
}

/// The left half of a coarse picture shows the panel: there each row of the window has its own stripe of the panel, which the picture could
/// not show. Elsewhere, without a layer, and in a window of the picture's size all is the picture's.
#[test]
fn a_coarse_pictures_panel_is_as_sharp_as_the_window() {
    let gpu = gpu::device();
    let picture = image(&gpu, DRAWN, |x, _| match x < 2 {
        true => (SEEN, 0),
        false => (ROOM, 255),
    });
    // A stripe for each row of the window; wider than what a pixel's samples filter over.
    let stripe = |row: u32| STRIPES[(row % 2) as usize];
    let panel = image(&gpu, PANEL, |_, y| (stripe(y * WINDOW[1] / PANEL[1]), 255));
    // The panel is as large as the picture: from 0 … 1 down to -1 … 1 up.
    let layer = Layer {
        image: &panel,
        panel_from_picture: [
            [2.0, 0.0, 0.0, 0.0],
            [0.0, -2.0, 0.0, 0.0],
            [-1.0, 1.0, 1.0, 0.0],
            [0.0; 4],
        ],
    };
    let mut shrink = Shrink::new(&gpu, &Library::embedded(), WINDOW, u32::MAX).unwrap();
    let mut shown = |layer: Option<Layer<'_>>, window: [u32; 2]| {
        shrink
            .begin((&picture, layer), DRAWN, window, (0, 0))
            .unwrap();
        gpu.wait_idle().unwrap();
        let shrunk = shrink.done().unwrap().unwrap();
        (shrunk.extent, shrunk.pixels().unwrap())
    };
    let of_picture = |x: u32| if x < 2 { SEEN } else { ROOM };
    for (layer, window) in [(None, WINDOW), (Some(layer), DRAWN)] {
        let (extent, pixels) = shown(layer, window);
        assert_eq!(extent, DRAWN);
        let expected = (0..DRAWN[1]).flat_map(|_| (0..DRAWN[0]).map(of_picture));
        assert!(pixels.iter().copied().eq(expected), "{pixels:x?}");
    }
    let (extent, pixels) = shown(Some(layer), WINDOW);
    assert_eq!(extent, WINDOW);
    for (row, line) in (0..).zip(pixels.chunks_exact(WINDOW[0] as usize)) {
        let (left, right) = line.split_at(line.len() / 2);
        assert!(left.iter().all(|it| *it == stripe(row)), "{row}: {left:x?}");
        assert!(right.iter().all(|it| *it == ROOM), "{row}: {right:x?}");
    }
}
