//! Passes, hazards, immediates and indirect dispatch.

use vitriol_gpu::{Buffer, ComputePipeline, QueueKind};

use crate::common::{DOUBLE, assert_silent, compile, dispatch, open};

const COUNT: u32 = 100_000;

#[test]
fn chained_passes_see_each_other() {
    let gpu = open();
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let bytes = 4 * u64::from(COUNT);
    let a = Buffer::storage(&gpu, "a", bytes).unwrap();
    let b = Buffer::storage(&gpu, "b", bytes).unwrap();
    let input: Vec<u32> = (0..COUNT).collect();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.upload(&a, &input).unwrap();
    rec.fill(&b, 7).unwrap();
    // Read after write, write after read and write after write, both ways.
    rec.group("there and back", |rec| {
        for _ in 0..3 {
            rec.pass(&double)
                .read("source", &a)
                .write("target_", &b)
                .invocations(COUNT)?;
            rec.pass(&double)
                .label("back")
                .read("source", &b)
                .write("target_", &a)
                .invocations(COUNT)?;
        }
        Ok(())
    })
    .unwrap();
    let result = rec.read_back(&a).unwrap();
    let ticket = gpu.submit(rec).unwrap();
    ticket.wait().unwrap();
    assert!(ticket.is_done().unwrap());
    // Six times x → 2x + 1 is 64x + 63.
    let expected: Vec<u32> = input.iter().map(|x| 64 * x + 63).collect();
    assert_eq!(result.get::<u32>().unwrap(), expected);
    assert_silent(&gpu);
}

#[test]
fn submissions_follow_each_other_and_recycle() {
    let gpu = open();
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let a = Buffer::storage(&gpu, "a", 4 * 64).unwrap();
    let b = Buffer::storage(&gpu, "b", 4 * 64).unwrap();
    gpu.write(&a, &[0_u32; 64]).unwrap();
    // Nothing waits on the host; more submissions than anyone keeps in flight.
    for _ in 0..5 {
        for (from, to) in [(&a, &b), (&b, &a)] {
            let mut rec = gpu.recorder(QueueKind::Main).unwrap();
            dispatch(&mut rec, &double, [from, to], 64);
            gpu.submit(rec).unwrap();
        }
    }
    assert_eq!(gpu.read::<u32>(&a).unwrap(), [1023; 64]);
    assert_silent(&gpu);
}

#[test]
fn immediates_and_indirect_sizes_arrive() {
    let gpu = open();
    let size = "
        @group(0) @binding(0) var<storage, read_write> arguments: array<u32>;
        var<immediate> groups: vec4<u32>;
        @compute @workgroup_size(1)
        fn main() { for (var i = 0u; i < 3u; i++) { arguments[i + 1u] = groups[i]; } }";
    let count = "
        @group(0) @binding(0) var<storage, read_write> counter: atomic<u32>;
        @compute @workgroup_size(32)
        fn main() { atomicAdd(&counter, 1u); }";
    let size = ComputePipeline::new(&gpu, &compile(size)).unwrap();
    let count = ComputePipeline::new(&gpu, &compile(count)).unwrap();
    let arguments = Buffer::storage(&gpu, "arguments", 16).unwrap();
    let counter = Buffer::storage(&gpu, "counter", 4).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.fill(&counter, 0).unwrap();
    rec.pass(&size)
        .write("arguments", &arguments)
        .constants(&[5_u32, 2, 1, 0])
        .workgroups([1, 1, 1])
        .unwrap();
    rec.pass(&count)
        .write("counter", &counter)
        .indirect(&arguments, 4)
        .unwrap();
    let result = rec.read_back(&counter).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(result.get::<u32>().unwrap()[0], 5 * 2 * 32);
    assert_silent(&gpu);
}

#[test]
fn nothing_to_do_is_no_mistake() {
    let gpu = open();
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let empty = Buffer::storage(&gpu, "empty", 0).unwrap();
    let other = Buffer::storage(&gpu, "other", 0).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.upload::<u32>(&empty, &[]).unwrap();
    dispatch(&mut rec, &double, [&empty, &other], 0);
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_silent(&gpu);
}

#[test]
fn a_uniform_written_between_passes_is_seen_in_order() {
    let gpu = open();
    let text = "
        struct Frame { value: vec4<u32> }
        @group(0) @binding(0) var<uniform> frame: Frame;
        @group(0) @binding(1) var<storage, read_write> sums: array<u32>;
        @compute @workgroup_size(64)
        fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            sums[id.x] = 10u * sums[id.x] + frame.value.y;
        }";
    let pass = ComputePipeline::new(&gpu, &compile(text)).unwrap();
    let frame = Buffer::uniform(&gpu, "frame", 16).unwrap();
    let sums = Buffer::storage(&gpu, "sums", 256).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.fill(&sums, 0).unwrap();
    for digit in [4_u32, 2, 7] {
        rec.upload(&frame, &[0, digit, 0, 0]).unwrap();
        rec.pass(&pass)
            .uniform("frame", &frame)
            .write("sums", &sums)
            .invocations(64)
            .unwrap();
    }
    let result = rec.read_back(&sums).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(result.get::<u32>().unwrap(), [427; 64]);
    // A uniform that is too small for the shader.
    let small = "
        @group(0) @binding(0) var<uniform> frame: array<vec4<u32>, 4>;
        @group(0) @binding(1) var<storage, read_write> sums: array<u32>;
        @compute @workgroup_size(1) fn main() { sums[0] = frame[3].x; }";
    let pass = ComputePipeline::new(&gpu, &compile(small)).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let error = rec
        .pass(&pass)
        .uniform("frame", &frame)
        .write("sums", &sums)
        .invocations(1)
        .unwrap_err();
    assert!(
        error
            .to_string()
            .contains("has 16 bytes, the shader reads 64"),
        "{error}"
    );
    assert_silent(&gpu);
}

/// A software driver reads them as texels.
#[test]
fn structures_are_read_whole_and_by_their_members() {
    let gpu = open();
    let text = "
        struct Place { at: vec3<f32>, number: u32, turned: vec4<f32>, pair: vec2<f32>, sign: i32, last: f32 }
        struct Size { width: f32, height: f32, depth: f32 }
        @group(0) @binding(0) var<storage, read> places: array<Place>;
        @group(0) @binding(1) var<storage, read> sizes: array<Size>;
        @group(0) @binding(2) var<storage, read_write> found: array<f32>;
        @compute @workgroup_size(64)
        fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            let i = id.x;
            if (i >= 5u) { return; }
            let place = places[i];
            let first = 16u * i;
            found[first] = place.at.x;
            found[first + 1u] = place.at.y;
            found[first + 2u] = places[i].at.z;
            found[first + 3u] = f32(places[i].number);
            for (var k = 0u; k < 4u; k++) { found[first + 4u + k] = places[i].turned[k]; }
            found[first + 8u] = place.pair.x;
            found[first + 9u] = places[i].pair.y;
            found[first + 10u] = f32(place.sign);
            found[first + 11u] = places[i].last;
            let size = sizes[i];
            found[first + 12u] = size.width;
            found[first + 13u] = sizes[i].height;
            found[first + 14u] = sizes[i].depth;
            found[first + 15u] = size.depth;
        }";
    let read = ComputePipeline::new(&gpu, &compile(text)).unwrap();
    let number = |i: u32, k: u32| (100 * i + k) as f32;
    let place = |i: u32| {
        (0..12).map(move |k| match k {
            3 => 100 * i + 3,
            10 => (-(number(i, 10) as i32)) as u32,
            k => number(i, k).to_bits(),
        })
    };
    let places: Vec<u32> = (0..5).flat_map(place).collect();
    let size = |i: u32| (12..15).map(move |k| number(i, k));
    let sizes: Vec<f32> = (0..5).flat_map(size).collect();
    let buffer = |label, bytes| Buffer::storage(&gpu, label, bytes).unwrap();
    let [places_there, sizes_there] =
        [("places", 5 * 48), ("sizes", 5 * 12)].map(|(l, b)| buffer(l, b));
    gpu.write(&places_there, &places).unwrap();
    gpu.write(&sizes_there, &sizes).unwrap();
    let found = buffer("found", 5 * 64);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.pass(&read)
        .read("places", &places_there)
        .read("sizes", &sizes_there)
        .write("found", &found)
        .invocations(5)
        .unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let expected = (0..5).flat_map(|i| {
        (0..16).map(move |k| match k {
            10 => -number(i, 10),
            15 => number(i, 14),
            k => number(i, k),
        })
    });
    assert_eq!(
        gpu.read::<f32>(&found).unwrap(),
        expected.collect::<Vec<_>>()
    );
    assert_silent(&gpu);
}

/// A shader has one pipeline as long as it is held. Names are part of the shader: one with the same words and other names is bound by its
/// own.
#[test]
fn a_shader_has_one_pipeline_on_a_device() {
    let (gpu, another) = (open(), open());
    let double = |gpu, text: &str| ComputePipeline::new(gpu, &compile(text)).unwrap();
    let first = double(&gpu, DOUBLE);
    assert!(first == double(&gpu, DOUBLE));
    assert!(first != double(&another, DOUBLE));
    let renamed = double(&gpu, &DOUBLE.replace("source", "origin"));
    assert!(first != renamed);
    let names = |pipeline: &ComputePipeline| -> Vec<String> {
        pipeline.bindings().map(str::to_owned).collect()
    };
    assert!(names(&first).contains(&"source".to_owned()));
    assert!(names(&renamed).contains(&"origin".to_owned()));
    // The other pipelines have been dropped.
    drop(first);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let [from, to] = ["from", "to"].map(|label| Buffer::storage(&gpu, label, 4 * 64).unwrap());
    rec.upload(&from, &[3_u32; 64]).unwrap();
    let again = double(&gpu, DOUBLE);
    dispatch(&mut rec, &again, [&from, &to], 64);
    drop(again);
    let result = rec.read_back(&to).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(result.get::<u32>().unwrap(), [7; 64]);
    assert_silent(&gpu);
}
