//! Raster scopes: blending, sampling of what was drawn, imported images.

use vitriol_gpu::{
    Buffer, ComputePipeline, Gpu, Image, ImageDesc, QueueKind, RasterPipeline, Readback, Sampler,
    vk,
};

use crate::common::{assert_silent, compile, compile_entry, open};

const SIZE: u32 = 16;
const COLOUR: vk::Format = vk::Format::R8G8B8A8_UNORM;
const ATTACHMENT: vk::ImageUsageFlags = vk::ImageUsageFlags::COLOR_ATTACHMENT;

/// Quads from corner 0 to corner 1 of `corners`, six vertices each.
const QUAD: &str = "
struct Quad { corners: vec4<f32>, colour: vec4<f32> }
@group(0) @binding(0) var<storage, read> quads: array<Quad>;
struct Out { @builtin(position) position: vec4<f32>, @location(0) colour: vec4<f32> }
@vertex fn place(@builtin(vertex_index) index: u32) -> Out {
    let q = quads[index / 6u];
    let v = index % 6u;
    let x = select(q.corners.x, q.corners.z, v == 1u || v == 2u || v == 4u);
    let y = select(q.corners.y, q.corners.w, v == 2u || v == 4u || v == 5u);
    return Out(vec4<f32>(x, y, 0.5, 1.0), q.colour);
}
@fragment fn paint(in: Out) -> @location(0) vec4<f32> { return in.colour; }";

fn image(gpu: &Gpu, label: &str, usage: vk::ImageUsageFlags) -> Image {
    let desc = ImageDesc {
        extent: [SIZE, SIZE],
        layers: 1,
        format: COLOUR,
        usage,
    };
    Image::new(gpu, label, desc).unwrap()
}

fn pipeline(gpu: &Gpu, format: vk::Format) -> RasterPipeline {
    let (vertex, fragment) = (compile_entry(QUAD, "place"), compile_entry(QUAD, "paint"));
    RasterPipeline::new(gpu, &vertex, &fragment, format).unwrap()
}

/// Quads (corners x0 y0 x1 y1 in clip space, colour) and their indices.
fn quads(gpu: &Gpu, list: &[([f32; 4], [f32; 4])]) -> (Buffer, Buffer) {
    let data: Vec<[f32; 8]> = list
        .iter()
        .map(|(c, k)| [c[0], c[1], c[2], c[3], k[0], k[1], k[2], k[3]])
        .collect();
    let buffer = Buffer::storage(gpu, "quads", 32 * list.len() as u64).unwrap();
    gpu.write(&buffer, &data).unwrap();
    let numbers: Vec<u32> = (0..6 * list.len() as u32).collect();
    let indices = Buffer::storage(gpu, "indices", 4 * numbers.len() as u64).unwrap();
    gpu.write(&indices, &numbers).unwrap();
    (buffer, indices)
}

fn texel(picture: &Readback, x: u32, y: u32) -> [u8; 4] {
    let all = picture.get::<[u8; 4]>().unwrap();
    assert_eq!(all.len() as u32, SIZE * SIZE);
    all[(y * SIZE + x) as usize]
}

const ALL: [f32; 4] = [-1.0, -1.0, 1.0, 1.0];
const LEFT: [f32; 4] = [-1.0, -1.0, 0.0, 1.0];
const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 1.0];
const BLACK: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

#[test]
fn later_draws_blend_over_earlier_ones() {
    let gpu = open();
    let target = image(&gpu, "colour", ATTACHMENT);
    // Red on the upper left quarter (clip y points down), blue added everywhere.
    let (list, indices) = quads(
        &gpu,
        &[([-1.0, -1.0, 0.0, 0.0], RED), (ALL, [0.0, 0.0, 0.4, 0.0])],
    );
    let paint = pipeline(&gpu, COLOUR);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.raster("glow", &target, BLACK, |r| {
        r.draw(&paint).read("quads", &list).indexed(&indices, 12)
    })
    .unwrap();
    let picture = rec.read_back_image(&target).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(texel(&picture, 4, 4), [255, 0, 102, 255]);
    assert_eq!(texel(&picture, 12, 4), [0, 0, 102, 255]);
    assert_eq!(texel(&picture, 4, 12), [0, 0, 102, 255]);
    assert_silent(&gpu);
}

/// As a panel is drawn: one scope, and for each draw buffers and constants of its own.
#[test]
fn draws_of_a_scope_have_their_own_buffers_and_constants() {
    let gpu = open();
    let target = image(&gpu, "colour", ATTACHMENT);
    let shifted = QUAD
        .replace("struct Out", "var<immediate> shift: vec4<f32>;\nstruct Out")
        .replace(
            "vec4<f32>(x, y, 0.5, 1.0)",
            "vec4<f32>(x, y, 0.5, 1.0) + shift",
        );
    let [vertex, fragment] = ["place", "paint"].map(|entry| compile_entry(&shifted, entry));
    let paint = RasterPipeline::new(&gpu, &vertex, &fragment, COLOUR).unwrap();
    // Each covers the upper left quarter, from where its constants move it.
    let quarter = [-1.0, -1.0, 0.0, 0.0];
    let (red, of_red) = quads(&gpu, &[(quarter, RED)]);
    let (green, of_green) = quads(&gpu, &[(ALL, GREEN), (quarter, GREEN)]);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.raster("two", &target, BLACK, |r| {
        let right: [f32; 4] = [1.0, 0.0, 0.0, 0.0];
        let draw = r.draw(&paint).read("quads", &red).constants(&right);
        draw.indexed(&of_red, 6)?;
        let down: [f32; 4] = [-1.0, 1.0, 0.0, 0.0];
        let draw = r.draw(&paint).read("quads", &green).constants(&down);
        draw.indexed(&of_green, 6)
    })
    .unwrap();
    let picture = rec.read_back_image(&target).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let (red, green, black) = ([255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 0, 255]);
    let corners = [(4, 4), (12, 4), (4, 12), (12, 12)].map(|(x, y)| texel(&picture, x, y));
    // Green's first six indices are of the quad that covers all, which its constants move down and left.
    assert_eq!(corners, [black, red, green, black]);
    assert_silent(&gpu);
}

#[test]
fn a_picture_is_sampled_and_stored_by_compute() {
    let gpu = open();
    let source = image(&gpu, "source", ATTACHMENT | vk::ImageUsageFlags::SAMPLED);
    let stored = image(&gpu, "stored", vk::ImageUsageFlags::STORAGE);
    let sampler = Sampler::linear(&gpu).unwrap();
    let flip = "
        @group(0) @binding(0) var source: texture_2d<f32>;
        @group(0) @binding(1) var between: sampler;
        @group(0) @binding(2) var stored: texture_storage_2d<rgba8unorm, write>;
        @compute @workgroup_size(8, 8)
        fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            let size = vec2<f32>(textureDimensions(source));
            let uv = (vec2<f32>(id.xy) + 0.5) / size;
            textureStore(stored, id.xy, textureSampleLevel(source, between, vec2(1.0 - uv.x, uv.y), 0.0));
        }";
    let flip = ComputePipeline::new(&gpu, &compile(flip)).unwrap();
    let (list, indices) = quads(&gpu, &[(LEFT, RED)]);
    let paint = pipeline(&gpu, COLOUR);
    // Twice in one recorder, so that layouts go there and back; and again.
    for _ in 0..2 {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        for _ in 0..2 {
            rec.raster("left", &source, BLACK, |r| {
                r.draw(&paint).read("quads", &list).indexed(&indices, 6)
            })
            .unwrap();
            rec.pass(&flip)
                .sampled("source", &source)
                .sampler("between", &sampler)
                .storage_image("stored", &stored)
                .invocations_2d([SIZE, SIZE])
                .unwrap();
        }
        let picture = rec.read_back_image(&stored).unwrap();
        gpu.submit(rec).unwrap().wait().unwrap();
        assert_eq!(texel(&picture, 4, 8), [0, 0, 0, 255]);
        assert_eq!(texel(&picture, 12, 8), [255, 0, 0, 255]);
    }
    assert_silent(&gpu);
}

#[test]
fn an_imported_image_is_drawn_into_and_left_to_its_owner() {
    let gpu = open();
    let owner = image(&gpu, "swapchain", ATTACHMENT);
    let desc = *owner.desc();
    // The owner's own layout is COLOR_ATTACHMENT_OPTIMAL, as OpenXR's is.
    let layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    // SAFETY: `owner` is such an image and lives to the end of the test.
    let imported =
        unsafe { Image::import(&gpu, "imported", owner.handle(), desc, layout) }.unwrap();
    let (list, indices) = quads(&gpu, &[(ALL, GREEN)]);
    let paint = pipeline(&gpu, COLOUR);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.raster("eye", &imported, BLACK, |r| {
        r.draw(&paint).read("quads", &list).indexed(&indices, 6)
    })
    .unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    drop(imported);
    // The owner's image is still there, in its layout, with the picture.
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let picture = rec.read_back_image(&owner).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(texel(&picture, 8, 8), [0, 255, 0, 255]);
    assert_silent(&gpu);
}

#[test]
fn targets_and_pipelines_that_do_not_fit_are_refused() {
    let gpu = open();
    let target = image(&gpu, "target", ATTACHMENT);
    let stored = image(&gpu, "stored", vk::ImageUsageFlags::STORAGE);
    let (list, indices) = quads(&gpu, &[(ALL, RED)]);
    let half = pipeline(&gpu, vk::Format::R16G16B16A16_SFLOAT);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let error = rec
        .raster("scope", &stored, RED, |_| Ok(()))
        .unwrap_err()
        .to_string();
    assert!(error.contains("was not made for"), "{error}");
    let two = ImageDesc {
        layers: 2,
        ..*target.desc()
    };
    let two = Image::new(&gpu, "two", two).unwrap();
    let error = rec
        .raster("scope", &two, RED, |_| Ok(()))
        .unwrap_err()
        .to_string();
    assert!(error.contains("\"two\" has 2 layers"), "{error}");
    let error = rec
        .raster("scope", &target, RED, |r| {
            r.draw(&half).read("quads", &list).indexed(&indices, 6)
        })
        .unwrap_err()
        .to_string();
    assert!(error.contains("another format"), "{error}");
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_silent(&gpu);
}

#[test]
fn draws_follow_the_passes_that_wrote_their_indices() {
    let gpu = open();
    let target = image(&gpu, "colour", ATTACHMENT);
    // The right half is the second quad's, which no index names.
    let (list, _) = quads(&gpu, &[(LEFT, RED), ([0.0, -1.0, 1.0, 1.0], GREEN)]);
    let paint = pipeline(&gpu, COLOUR);
    let text = "
        @group(0) @binding(0) var<storage, read_write> indices: array<u32>;
        @compute @workgroup_size(1) fn main() {
            for (var i = 0u; i < 6u; i++) { indices[i] = 5u - i; }
        }";
    let write = ComputePipeline::new(&gpu, &compile(text)).unwrap();
    let indices = Buffer::storage(&gpu, "indices", 32).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.pass(&write)
        .write("indices", &indices)
        .invocations(1)
        .unwrap();
    rec.raster("left", &target, BLACK, |r| {
        r.draw(&paint).read("quads", &list).indexed(&indices, 6)
    })
    .unwrap();
    let picture = rec.read_back_image(&target).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(texel(&picture, 4, 8), [255, 0, 0, 255]);
    assert_eq!(texel(&picture, 12, 8), [0, 0, 0, 255]);
    assert_silent(&gpu);
}
