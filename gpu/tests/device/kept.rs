//! Pipelines that are kept from one run to the next.

use std::path::PathBuf;

use vitriol_gpu::{ComputePipeline, Gpu, Options, PlainLoader};
use vitriol_shaders::{Library, ShaderId};

use crate::common::assert_silent;

const ID: ShaderId = ShaderId::new("kept.wgsl");

/// Opens a device that keeps its pipelines in `folder`, and has it compile a shader.
fn compile(folder: &std::path::Path) {
    let options = Options {
        validation: true,
        pipelines: Some(folder.join("deep")),
        ..Options::default()
    };
    let gpu = Gpu::open(&mut PlainLoader::default(), &options).unwrap();
    let text = "@group(0) @binding(0) var<storage, read_write> data: array<u32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3<u32>) { data[id.x] *= 3u; }";
    let library = Library::from_sources([(ID.path(), text)]);
    let compiled = library.compile(&ID, "main", &[]).unwrap();
    ComputePipeline::new(&gpu, &compiled).unwrap();
    assert_silent(&gpu);
}

fn only_file(folder: &std::path::Path) -> PathBuf {
    let files: Vec<_> = std::fs::read_dir(folder.join("deep")).unwrap().collect();
    let [file] = &files[..] else {
        panic!("{files:?}");
    };
    file.as_ref().unwrap().path()
}

#[test]
fn what_was_compiled_is_kept_and_damage_is_no_harm() {
    let folder = tempfile::tempdir().unwrap();
    compile(folder.path());
    let file = only_file(folder.path());
    let first = std::fs::read(&file).unwrap();
    assert!(first.starts_with(b"vitriol1") && first.len() > 32);
    // A damaged file counts as none; Mesa's software driver stores only a header, so the contents are not checked.
    for damaged in [&first[..first.len() - 7], &[]] {
        std::fs::write(&file, damaged).unwrap();
        compile(folder.path());
        // A driver of a card does not write the same bytes twice.
        let again = std::fs::read(only_file(folder.path())).unwrap();
        assert!(again.starts_with(&first[..20]) && again.len() == first.len());
    }
}
