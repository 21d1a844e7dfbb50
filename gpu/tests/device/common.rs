//! Helpers of the tests.

use vitriol_gpu::{Buffer, ComputePipeline, Gpu, Options, PlainLoader, Recorder};
use vitriol_shaders::{Compiled, Library, ShaderId};

/// A device with the validation layer on.
pub fn open() -> Gpu {
    open_with(|_| {})
}

/// As [`open`], with other options.
pub fn open_with(change: impl FnOnce(&mut Options)) -> Gpu {
    let mut options = Options {
        validation: true,
        device: std::env::var("VITRIOL_DEVICE").ok(),
        ..Options::default()
    };
    change(&mut options);
    Gpu::open(&mut PlainLoader::default(), &options).expect("a Vulkan device")
}

/// Entry `main` of a shader.
pub fn compile(text: &str) -> Compiled {
    compile_entry(text, "main")
}

/// An entry of a shader.
pub fn compile_entry(text: &str, entry: &str) -> Compiled {
    let library = Library::from_sources([("test.wgsl", text)]);
    library
        .compile(&ShaderId::new("test.wgsl"), entry, &[])
        .expect("a valid shader")
}

/// Fails on any message of the validation layer.
pub fn assert_silent(gpu: &Gpu) {
    gpu.wait_idle().unwrap();
    let messages = gpu.take_validation_messages();
    assert!(
        messages.is_empty(),
        "the validation layer says: {messages:#?}"
    );
}

/// `output[i] = 2 · input[i] + 1`.
pub const DOUBLE: &str = "
@group(0) @binding(0) var<storage, read> source: array<u32>;
@group(0) @binding(1) var<storage, read_write> target_: array<u32>;
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&target_) { target_[id.x] = 2u * source[id.x] + 1u; }
}";

/// Records a pass of a shader with the bindings of [`DOUBLE`] over so many elements.
pub fn dispatch(
    rec: &mut Recorder,
    pipeline: &ComputePipeline,
    [from, to]: [&Buffer; 2],
    count: u32,
) {
    let pass = rec.pass(pipeline).read("source", from).write("target_", to);
    pass.invocations(count).unwrap();
}
