//! Raster scopes: views, blending, depth, sampling, imported images.

use vitriol_gpu::{
    Blend, Buffer, ColourFormat, ColourTarget, ComputePipeline, DepthFormat, DepthTarget, Gpu,
    Image, ImageDesc, Load, QueueKind, RasterDesc, RasterPipeline, RasterTarget, Readback, Sampler,
    SamplerDesc, vk,
};

use crate::common::{assert_silent, compile, compile_entry, open};

const SIZE: u32 = 16;
const COLOUR: vk::Format = vk::Format::R8G8B8A8_UNORM;
const DEPTH: vk::Format = vk::Format::D32_SFLOAT;

/// A quad from corner 0 to corner 1 of `corners`, at depth and in colour.
const QUAD: &str = "
struct Quad { corners: vec4<f32>, colour: vec4<f32>, depth: f32, shift: f32, pad0: f32, pad1: f32 }
@group(0) @binding(0) var<storage, read> quads: array<Quad>;
struct Out { @builtin(position) position: vec4<f32>, @location(0) colour: vec4<f32> }
fn place(vertex: u32, instance: u32, view: u32) -> Out {
    let q = quads[instance];
    let x = select(q.corners.x, q.corners.z, vertex == 1u || vertex == 2u || vertex == 4u) + f32(view) * q.shift;
    let y = select(q.corners.y, q.corners.w, vertex == 2u || vertex == 4u || vertex == 5u);
    return Out(vec4<f32>(x, y, q.depth, 1.0), q.colour);
}
@vertex fn stereo(@builtin(vertex_index) v: u32, @builtin(instance_index) i: u32,
                  @builtin(view_index) view: u32) -> Out { return place(v, i, view); }
@vertex fn mono(@builtin(vertex_index) v: u32, @builtin(instance_index) i: u32) -> Out {
    return place(v, i, 0);
}
@fragment fn paint(in: Out) -> @location(0) vec4<f32> { return in.colour; }";

fn image(
    gpu: &Gpu,
    label: &str,
    layers: u32,
    format: vk::Format,
    usage: vk::ImageUsageFlags,
) -> Image {
    let desc = ImageDesc {
        extent: [SIZE, SIZE],
        layers,
        format,
        usage,
    };
    Image::new(gpu, label, desc).unwrap()
}

fn pipeline(gpu: &Gpu, vertex: &str, view_mask: u32, blend: Blend, depth: bool) -> RasterPipeline {
    let (vertex, fragment) = (compile_entry(QUAD, vertex), compile_entry(QUAD, "paint"));
    let desc = RasterDesc {
        vertex: &vertex,
        fragment: Some(&fragment),
        colours: &[ColourFormat {
            format: COLOUR,
            blend,
        }],
        depth: depth.then_some(DepthFormat {
            format: DEPTH,
            compare: vk::CompareOp::LESS,
            write: true,
        }),
        view_mask,
    };
    RasterPipeline::new(gpu, &desc).unwrap()
}

/// Corners x0 y0 x1 y1 in clip space, colour, depth, shift per view.
fn quads(gpu: &Gpu, list: &[([f32; 4], [f32; 4], f32, f32)]) -> Buffer {
    let data: Vec<[f32; 12]> = list
        .iter()
        .map(|(c, k, depth, shift)| {
            [
                c[0], c[1], c[2], c[3], k[0], k[1], k[2], k[3], *depth, *shift, 0.0, 0.0,
            ]
        })
        .collect();
    let buffer = Buffer::storage(gpu, "quads", 48 * list.len() as u64).unwrap();
    gpu.write(&buffer, &data).unwrap();
    buffer
}

fn texel(picture: &Readback, layer: u32, x: u32, y: u32) -> [u8; 4] {
    let all = picture.get::<[u8; 4]>().unwrap();
    assert_eq!(all.len() as u32 % (SIZE * SIZE), 0);
    all[((layer * SIZE + y) * SIZE + x) as usize]
}

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 1.0];
const BLACK: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

#[test]
fn each_view_gets_its_own_layer() {
    let gpu = open();
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT;
    let target = image(&gpu, "eyes", 2, COLOUR, usage);
    // Upper left quarter in view 0 (clip y points down); view 1 one half to the right.
    let list = quads(&gpu, &[([-1.0, -1.0, 0.0, 0.0], RED, 0.5, 1.0)]);
    let stereo = pipeline(&gpu, "stereo", 0b11, Blend::Replace, false);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let colours = [ColourTarget {
        image: &target,
        load: Load::Clear(BLACK),
    }];
    let scope = RasterTarget {
        label: "eyes",
        colours: &colours,
        depth: None,
        view_mask: 0b11,
    };
    rec.raster(&scope, |r| {
        r.draw(&stereo).read("quads", &list).instances(6, 1)
    })
    .unwrap();
    let picture = rec.read_back_image(&target).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let (red, black) = ([255, 0, 0, 255], [0, 0, 0, 255]);
    for (layer, left, right) in [(0, red, black), (1, black, red)] {
        assert_eq!(texel(&picture, layer, 4, 4), left, "layer {layer}");
        assert_eq!(texel(&picture, layer, 12, 4), right, "layer {layer}");
        assert_eq!(texel(&picture, layer, 4, 12), black, "layer {layer}");
    }
    assert_silent(&gpu);
}

#[test]
fn depth_and_blending_over_two_scopes() {
    let gpu = open();
    let target = image(
        &gpu,
        "colour",
        1,
        COLOUR,
        vk::ImageUsageFlags::COLOR_ATTACHMENT,
    );
    let depth = image(
        &gpu,
        "depth",
        1,
        DEPTH,
        vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
    );
    let all = [-1.0, -1.0, 1.0, 1.0];
    // Near red on the left half first, then green everywhere but further away.
    let opaque = quads(
        &gpu,
        &[
            ([-1.0, -1.0, 0.0, 1.0], RED, 0.2, 0.0),
            (all, GREEN, 0.6, 0.0),
        ],
    );
    // Between the two: adds blue where it is in front, on the right.
    let glow = quads(&gpu, &[(all, [0.0, 0.0, 0.4, 0.0], 0.4, 0.0)]);
    let solid = pipeline(&gpu, "mono", 0, Blend::Replace, true);
    let add = pipeline(&gpu, "mono", 0, Blend::Premultiplied, true);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let scope = |label, colour, near| {
        (
            label,
            [ColourTarget {
                image: &target,
                load: colour,
            }],
            Some(DepthTarget {
                image: &depth,
                load: near,
            }),
        )
    };
    for ((label, colours, depth), pipeline, list, count) in [
        (
            scope("solid", Load::Clear(BLACK), Load::Clear(1.0)),
            &solid,
            &opaque,
            2,
        ),
        (scope("glow", Load::Keep, Load::Keep), &add, &glow, 1),
    ] {
        let target = RasterTarget {
            label,
            colours: &colours,
            depth,
            view_mask: 0,
        };
        rec.raster(&target, |r| {
            r.draw(pipeline).read("quads", list).instances(6, count)
        })
        .unwrap();
    }
    let (picture, near) = (
        rec.read_back_image(&target).unwrap(),
        rec.read_back_image(&depth).unwrap(),
    );
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(texel(&picture, 0, 4, 8), [255, 0, 0, 255]);
    assert_eq!(texel(&picture, 0, 12, 8), [0, 255, 102, 255]);
    let near = near.get::<f32>().unwrap();
    assert_eq!((near[4], near[12]), (0.2, 0.4));
    assert_silent(&gpu);
}

#[test]
fn a_picture_is_sampled_and_stored_by_compute() {
    let gpu = open();
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
    let source = image(&gpu, "source", 1, COLOUR, usage);
    let stored = image(&gpu, "stored", 1, COLOUR, vk::ImageUsageFlags::STORAGE);
    let sampler = Sampler::new(&gpu, SamplerDesc::default()).unwrap();
    let flip = "
        @group(0) @binding(0) var source: texture_2d<f32>;
        @group(0) @binding(1) var nearest: sampler;
        @group(0) @binding(2) var stored: texture_storage_2d<rgba8unorm, write>;
        @compute @workgroup_size(8, 8)
        fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            let size = vec2<f32>(textureDimensions(source));
            let uv = (vec2<f32>(id.xy) + 0.5) / size;
            textureStore(stored, id.xy, textureSampleLevel(source, nearest, vec2(1.0 - uv.x, uv.y), 0.0));
        }";
    let flip = ComputePipeline::new(&gpu, &compile(flip)).unwrap();
    let list = quads(&gpu, &[([-1.0, -1.0, 0.0, 1.0], RED, 0.5, 0.0)]);
    let mono = pipeline(&gpu, "mono", 0, Blend::Replace, false);
    // Twice in one recorder, so that layouts go there and back; and again.
    for _ in 0..2 {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        for _ in 0..2 {
            let colours = [ColourTarget {
                image: &source,
                load: Load::Clear(BLACK),
            }];
            let scope = RasterTarget {
                label: "left",
                colours: &colours,
                depth: None,
                view_mask: 0,
            };
            rec.raster(&scope, |r| r.draw(&mono).read("quads", &list).vertices(6))
                .unwrap();
            rec.pass(&flip)
                .sampled("source", &source)
                .sampler("nearest", &sampler)
                .storage_image("stored", &stored)
                .invocations_2d([SIZE, SIZE])
                .unwrap();
        }
        let picture = rec.read_back_image(&stored).unwrap();
        gpu.submit(rec).unwrap().wait().unwrap();
        assert_eq!(texel(&picture, 0, 4, 8), [0, 0, 0, 255]);
        assert_eq!(texel(&picture, 0, 12, 8), [255, 0, 0, 255]);
    }
    assert_silent(&gpu);
}

#[test]
fn an_imported_image_is_drawn_into_and_left_to_its_owner() {
    let gpu = open();
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT;
    let owner = image(&gpu, "swapchain", 2, COLOUR, usage);
    let desc = *owner.desc();
    // The owner's own layout is COLOR_ATTACHMENT_OPTIMAL, as OpenXR's is.
    let layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    // SAFETY: `owner` is such an image and lives to the end of the test.
    let imported =
        unsafe { Image::import(&gpu, "imported", owner.handle(), desc, layout) }.unwrap();
    let list = quads(&gpu, &[([-1.0, -1.0, 1.0, 1.0], GREEN, 0.5, 0.0)]);
    let stereo = pipeline(&gpu, "stereo", 0b11, Blend::Replace, false);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let colours = [ColourTarget {
        image: &imported,
        load: Load::Discard,
    }];
    let scope = RasterTarget {
        label: "eyes",
        colours: &colours,
        depth: None,
        view_mask: 0b11,
    };
    rec.raster(&scope, |r| r.draw(&stereo).read("quads", &list).vertices(6))
        .unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    drop(imported);
    // The owner's image is still there, in its layout, with the picture.
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let picture = rec.read_back_image(&owner).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(texel(&picture, 1, 8, 8), [0, 255, 0, 255]);
    assert_silent(&gpu);
}

#[test]
fn targets_and_pipelines_that_do_not_fit_are_refused() {
    let gpu = open();
    let target = image(
        &gpu,
        "one layer",
        1,
        COLOUR,
        vk::ImageUsageFlags::COLOR_ATTACHMENT,
    );
    let list = quads(&gpu, &[([-1.0, -1.0, 1.0, 1.0], RED, 0.5, 0.0)]);
    let with_depth = pipeline(&gpu, "mono", 0, Blend::Replace, true);
    let colours = [ColourTarget {
        image: &target,
        load: Load::Clear(RED),
    }];
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let scope = |view_mask| RasterTarget {
        label: "scope",
        colours: &colours,
        depth: None,
        view_mask,
    };
    let error = rec
        .raster(&scope(0b10), |_| Ok(()))
        .unwrap_err()
        .to_string();
    assert!(error.contains("needs 2"), "{error}");
    let error = rec
        .raster(&scope(0), |r| {
            r.draw(&with_depth).read("quads", &list).vertices(6)
        })
        .unwrap_err()
        .to_string();
    assert!(error.contains("other formats or views"), "{error}");
    let none = RasterTarget {
        colours: &[],
        ..scope(0)
    };
    let error = rec.raster(&none, |_| Ok(())).unwrap_err().to_string();
    assert!(error.contains("no target"), "{error}");
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_silent(&gpu);
}

#[test]
fn indexed_and_indirect_draws_follow_the_passes_that_wrote_them() {
    let gpu = open();
    let target = image(
        &gpu,
        "colour",
        1,
        COLOUR,
        vk::ImageUsageFlags::COLOR_ATTACHMENT,
    );
    // Instance 0: left half red; instance 1: right half green.
    let list = quads(
        &gpu,
        &[
            ([-1.0, -1.0, 0.0, 1.0], RED, 0.5, 0.0),
            ([0.0, -1.0, 1.0, 1.0], GREEN, 0.5, 0.0),
        ],
    );
    let mono = pipeline(&gpu, "mono", 0, Blend::Replace, false);
    let text = "
        @group(0) @binding(0) var<storage, read_write> indices: array<u32>;
        @group(0) @binding(1) var<storage, read_write> arguments: array<u32>;
        @compute @workgroup_size(1) fn main() {
            for (var i = 0u; i < 6u; i++) { indices[i] = 5u - i; }
            arguments[1] = 6u; arguments[2] = 1u; arguments[3] = 0u; arguments[4] = 1u;
        }";
    let write = ComputePipeline::new(&gpu, &compile(text)).unwrap();
    let [indices, arguments] =
        ["indices", "arguments"].map(|l| Buffer::storage(&gpu, l, 32).unwrap());
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.pass(&write)
        .write("indices", &indices)
        .write("arguments", &arguments)
        .invocations(1)
        .unwrap();
    let colours = [ColourTarget {
        image: &target,
        load: Load::Clear(BLACK),
    }];
    let scope = RasterTarget {
        label: "both",
        colours: &colours,
        depth: None,
        view_mask: 0,
    };
    rec.raster(&scope, |r| {
        r.draw(&mono).read("quads", &list).indexed(&indices, 6, 1)?;
        r.draw(&mono).read("quads", &list).indirect(&arguments, 4)
    })
    .unwrap();
    let picture = rec.read_back_image(&target).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(texel(&picture, 0, 4, 8), [255, 0, 0, 255]);
    assert_eq!(texel(&picture, 0, 12, 8), [0, 255, 0, 255]);
    assert_silent(&gpu);
}
