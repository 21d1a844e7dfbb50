//! Copies between images: colour from a linear to an sRGB format, depth, an imported target.

use vitriol_gpu::{Buffer, Gpu, GpuError, Image, ImageDesc, QueueKind, vk};

use crate::common::{assert_silent, open};

fn image(gpu: &Gpu, label: &str, format: vk::Format, layers: u32, width: u32) -> Image {
    let depth = format == vk::Format::D32_SFLOAT;
    let desc = ImageDesc {
        extent: [width, 4],
        layers,
        format,
        usage: if depth {
            vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT
        } else {
            vk::ImageUsageFlags::COLOR_ATTACHMENT
        },
    };
    Image::new(gpu, label, desc).unwrap()
}

#[test]
fn both_layers_arrive_bit_by_bit_in_a_swapchain_image() {
    let gpu = open();
    let (linear, srgb) = (vk::Format::R8G8B8A8_UNORM, vk::Format::R8G8B8A8_SRGB);
    let d32 = vk::Format::D32_SFLOAT;
    let picture = image(&gpu, "picture", linear, 2, 8);
    let depth = image(&gpu, "depth", d32, 2, 8);
    // As an XR runtime's: made by another owner, found and left as an attachment.
    let owners = [
        image(&gpu, "owner", srgb, 2, 8),
        image(&gpu, "owner of depth", d32, 2, 8),
    ];
    let [shown, shown_depth] = [
        (&owners[0], vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL),
        (
            &owners[1],
            vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        ),
    ]
    .map(|(owner, layout)| {
        // SAFETY: the owner outlives the import, and has that description.
        unsafe { Image::import(&gpu, "imported", owner.handle(), *owner.desc(), layout) }.unwrap()
    });

    let texels = Buffer::storage(&gpu, "texels", 2 * 8 * 4 * 4).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let colour = [64, 128, 191, 255];
    for (image, word) in [
        (&picture, u32::from_le_bytes(colour)),
        (&depth, 0.375_f32.to_bits()),
    ] {
        rec.fill(&texels, word).unwrap();
        rec.copy_to_image(&texels, image).unwrap();
    }
    rec.copy_image(&picture, &shown).unwrap();
    rec.copy_image(&depth, &shown_depth).unwrap();
    let colours = rec.read_back_image(&shown).unwrap();
    let depths = rec.read_back_image(&shown_depth).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    // A copy that converted would store the sRGB codes, 137, 188 and 225.
    assert_eq!(colours.get::<[u8; 4]>().unwrap(), [colour; 2 * 8 * 4]);
    assert_eq!(depths.get::<f32>().unwrap(), [0.375; 2 * 8 * 4]);
    assert_silent(&gpu);
}

/// A layer goes to an image of its own, as to a swapchain of each eye.
#[test]
fn each_layer_arrives_alone() {
    let gpu = open();
    let linear = vk::Format::R8G8B8A8_UNORM;
    let picture = image(&gpu, "picture", linear, 2, 8);
    let eyes = ["left", "right"].map(|eye| image(&gpu, eye, vk::Format::R8G8B8A8_SRGB, 1, 8));
    let texels = Buffer::storage(&gpu, "texels", 2 * 8 * 4 * 4).unwrap();
    // Each layer has its own number.
    let words: Vec<u32> = (0..2 * 8 * 4).map(|texel| 1 + texel / (8 * 4)).collect();
    gpu.write(&texels, &words).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.copy_to_image(&texels, &picture).unwrap();
    let read = [0, 1].map(|layer: u32| {
        let eye = &eyes[layer as usize];
        rec.copy_layer(&picture, layer, eye).unwrap();
        rec.read_back_image(eye).unwrap()
    });
    assert!(rec.copy_layer(&picture, 2, &eyes[0]).is_err());
    assert!(rec.copy_layer(&picture, 0, &picture).is_err());
    gpu.submit(rec).unwrap().wait().unwrap();
    for (layer, read) in (1..).zip(read) {
        assert_eq!(read.get::<u32>().unwrap(), [layer; 8 * 4]);
    }
    assert_silent(&gpu);
}

/// The corner of a larger image goes to a smaller one, each layer's own; the rest of it does not.
#[test]
fn a_corner_arrives() {
    let gpu = open();
    let linear = vk::Format::R8G8B8A8_UNORM;
    let picture = image(&gpu, "picture", linear, 2, 8);
    let [smaller, larger] = [5, 9].map(|width| image(&gpu, "other", linear, 2, width));
    let texels = Buffer::storage(&gpu, "texels", 2 * 8 * 4 * 4).unwrap();
    let words: Vec<u32> = (0..2 * 8 * 4).collect();
    gpu.write(&texels, &words).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.copy_to_image(&texels, &picture).unwrap();
    rec.copy_corner(&picture, &smaller).unwrap();
    let read = rec.read_back_image(&smaller).unwrap();
    assert!(rec.copy_corner(&picture, &larger).is_err());
    let desc = ImageDesc {
        extent: [5, 5],
        ..*picture.desc()
    };
    let higher = Image::new(&gpu, "higher", desc).unwrap();
    assert!(rec.copy_corner(&picture, &higher).is_err());
    gpu.submit(rec).unwrap().wait().unwrap();
    let wanted: Vec<u32> = words.into_iter().filter(|texel| texel % 8 < 5).collect();
    assert_eq!(read.get::<u32>().unwrap(), wanted);
    assert_silent(&gpu);
}

#[test]
fn what_does_not_fit_is_refused() {
    let gpu = open();
    let (linear, d32) = (vk::Format::R8G8B8A8_UNORM, vk::Format::D32_SFLOAT);
    let picture = image(&gpu, "picture", linear, 2, 8);
    let others = [
        image(&gpu, "narrower", linear, 2, 7),
        image(&gpu, "one layer", linear, 1, 8),
        image(&gpu, "depth", d32, 2, 8),
        image(&gpu, "wider texels", vk::Format::R16G16B16A16_SFLOAT, 2, 8),
        picture.clone(),
    ];
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    for other in &others {
        let refused = rec.copy_image(&picture, other);
        assert!(
            matches!(&refused, Err(GpuError::ImageUnsupported { .. })),
            "{}",
            other.label()
        );
    }
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_silent(&gpu);
}

#[test]
fn a_buffers_texels_arrive_in_rows_and_layers() {
    let gpu = open();
    let image = image(&gpu, "depth", vk::Format::D32_SFLOAT, 2, 8);
    // One more than there are.
    let depths: Vec<f32> = (0..=64).map(|n| n as f32 / 64.0).collect();
    let buffer = Buffer::storage(&gpu, "depths", 65 * 4).unwrap();
    let short = Buffer::storage(&gpu, "short", 60 * 4).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.upload(&buffer, &depths).unwrap();
    rec.copy_to_image(&buffer, &image).unwrap();
    let refused = rec.copy_to_image(&short, &image);
    assert!(matches!(refused, Err(GpuError::OutOfRange { .. })));
    let copied = rec.read_back_image(&image).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(copied.get::<f32>().unwrap(), depths[..64]);
    assert_silent(&gpu);
}
