//! Mistakes in a pass are refused with a message that names pass and binding.

use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Pass, QueueKind};

use vitriol_shaders::{Library, ShaderId};

use crate::common::{DOUBLE, assert_silent, compile, dispatch, open};

struct Fixture {
    gpu: Gpu,
    double: ComputePipeline,
    a: Buffer,
    b: Buffer,
    uniform: Buffer,
}

impl Fixture {
    fn new() -> Self {
        let gpu = open();
        Self {
            double: ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap(),
            a: Buffer::storage(&gpu, "a", 256).unwrap(),
            b: Buffer::storage(&gpu, "b", 256).unwrap(),
            uniform: Buffer::uniform(&gpu, "u", 256).unwrap(),
            gpu,
        }
    }

    fn message(&self, fill: impl FnOnce(Pass<'_>) -> Pass<'_>) -> String {
        let mut rec = self.gpu.recorder(QueueKind::Main).unwrap();
        let error = fill(rec.pass(&self.double)).invocations(64).unwrap_err();
        error.to_string()
    }
}

#[test]
fn wrong_names_and_kinds_are_refused() {
    let f = Fixture::new();
    let (a, b) = (&f.a, &f.b);
    let cases = [
        (
            f.message(|p| p.read("source", a).write("target_", b).read("extra", a)),
            "\"extra\": the shader",
        ),
        (f.message(|p| p.read("source", a)), "\"target_\": not given"),
        (
            f.message(|p| p.read("source", a).read("target_", b)),
            "declares it read_write",
        ),
        (
            f.message(|p| p.write("source", a).write("target_", b)),
            "declares it read-only",
        ),
        (
            f.message(|p| p.read("source", a).read("source", a)),
            "given twice",
        ),
        (
            f.message(|p| p.uniform("source", &f.uniform)),
            "read-only storage buffer; give it with .read",
        ),
        (
            f.message(|p| p.read("source", &f.uniform).write("target_", b)),
            "make it with Buffer::storage",
        ),
        (
            f.message(|p| p.read("source", a).write("target_", b).constants(&1_u32)),
            "declares 0 bytes",
        ),
        (
            f.message(|p| p.label("density 1").read("source", a)),
            "pass \"density 1\"",
        ),
        (f.message(|p| p.read("source", a)), "pass \"test:main\""),
    ];
    for (message, part) in cases {
        assert!(message.contains(part), "{message:?} lacks {part:?}");
    }
    assert_silent(&f.gpu);
}

#[test]
fn a_refused_pass_leaves_the_recorder_whole() {
    let f = Fixture::new();
    f.gpu.write(&f.a, &[4_u32; 64]).unwrap();
    let mut rec = f.gpu.recorder(QueueKind::Main).unwrap();
    assert!(
        rec.pass(&f.double)
            .read("source", &f.a)
            .invocations(64)
            .is_err()
    );
    dispatch(&mut rec, &f.double, [&f.a, &f.b], 64);
    let refused = rec
        .pass(&f.double)
        .read("source", &f.a)
        .write("target_", &f.b);
    let limit = f.gpu.info().limits.workgroups;
    if limit[1] < u32::MAX {
        let error = refused.workgroups([1, limit[1] + 1, 1]).unwrap_err();
        assert!(
            matches!(error, GpuError::TooManyWorkgroups { .. }),
            "{error}"
        );
    }
    let result = rec.read_back(&f.b).unwrap();
    f.gpu.submit(rec).unwrap().wait().unwrap();
    assert_eq!(result.get::<u32>().unwrap(), [9; 64]);
    assert_silent(&f.gpu);
}

#[test]
fn shaders_that_cannot_be_bound_are_refused() {
    let gpu = open();
    let group = "
        @group(1) @binding(0) var<storage, read_write> x: array<u32>;
        @compute @workgroup_size(1) fn main() { x[0] = 1u; }";
    let Err(error) = ComputePipeline::new(&gpu, &compile(group)) else {
        panic!("group 1 was taken")
    };
    assert!(error.to_string().contains("group 1"), "{error}");
    let fragment = "@fragment fn main() -> @location(0) vec4<f32> { return vec4<f32>(); }";
    let Err(error) = ComputePipeline::new(&gpu, &compile(fragment)) else {
        panic!("a fragment shader was taken")
    };
    assert!(error.to_string().contains("Fragment"), "{error}");
    assert_silent(&gpu);
}

#[test]
fn a_name_that_specialisation_ruled_out_may_be_given() {
    let gpu = open();
    let text = "
        override HEAT: bool = true;
        @group(0) @binding(0) var<storage, read_write> x: array<u32>;
        @group(0) @binding(1) var<storage, read> heat: array<u32>;
        @compute @workgroup_size(1) fn main() {
            if HEAT { x[0] = heat[0]; } else { x[0] = 5u; }
        }";
    let library = Library::from_sources([("test.wgsl", text)]);
    let id = ShaderId::new("test.wgsl");
    let [x, heat] = ["x", "heat"].map(|l| Buffer::storage(&gpu, l, 16).unwrap());
    gpu.write(&heat, &[7_u32; 4]).unwrap();
    for (value, expected) in [(1.0, 7), (0.0, 5)] {
        let compiled = library.compile(&id, "main", &[("HEAT", value)]).unwrap();
        let pass = ComputePipeline::new(&gpu, &compiled).unwrap();
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        rec.pass(&pass)
            .write("x", &x)
            .read("heat", &heat)
            .invocations(1)
            .unwrap();
        // A name that the file does not have is still a mistake.
        let wrong = rec
            .pass(&pass)
            .write("x", &x)
            .read("heat", &heat)
            .read("cold", &heat);
        assert!(wrong.invocations(1).is_err());
        gpu.submit(rec).unwrap();
        assert_eq!(gpu.read::<u32>(&x).unwrap()[0], expected);
    }
    assert_silent(&gpu);
}
