//! Passes, hazards, immediates and indirect dispatch.

use vitriol_gpu::{Buffer, ComputePipeline, QueueKind};

use crate::common::{DOUBLE, assert_silent, compile, open};

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
            rec.pass(&double)
                .read("source", from)
                .write("target_", to)
                .invocations(64)
                .unwrap();
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
    rec.pass(&double)
        .read("source", &empty)
        .write("target_", &other)
        .invocations(0)
        .unwrap();
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
