//! Passes that are recorded once and executed again.

use vitriol_gpu::{
    Buffer, Bundle, ComputePipeline, Gpu, GpuError, Image, ImageDesc, QueueKind, vk,
};

use crate::common::{DOUBLE, assert_silent, compile, dispatch, open, open_with};

const COUNT: u32 = 100_000;

/// Two buffers, and a bundle that goes from the first to the second by x → 3x + 1, and back likewise.
fn there_and_back(gpu: &Gpu, kind: QueueKind) -> (Bundle, [Buffer; 2]) {
    let treble = DOUBLE.replace("2u *", "3u *");
    let treble = ComputePipeline::new(gpu, &compile(&treble)).unwrap();
    let bytes = 4 * u64::from(COUNT);
    let [a, b] = ["a", "b"].map(|label| Buffer::storage(gpu, label, bytes).unwrap());
    let rec = gpu.recorder(kind).unwrap();
    let bundle = rec.bundle("there and back", |rec| {
        for (from, to) in [(&a, &b), (&b, &a)] {
            rec.pass(&treble)
                .read("source", from)
                .write("target_", to)
                .invocations(COUNT)?;
        }
        Ok::<_, GpuError>(())
    });
    (bundle.unwrap(), [a, b])
}

#[test]
fn a_bundle_is_ordered_as_a_pass() {
    let gpu = open();
    let (bundle, [a, _]) = there_and_back(&gpu, QueueKind::Main);
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let c = Buffer::storage(&gpu, "c", a.bytes()).unwrap();
    let input: Vec<u32> = (0..COUNT).collect();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.upload(&c, &input).unwrap();
    dispatch(&mut rec, &double, [&c, &a], COUNT);
    rec.execute(&bundle).unwrap();
    rec.execute(&bundle).unwrap();
    // The same pipeline as before the bundles, which have bound another.
    dispatch(&mut rec, &double, [&a, &c], COUNT);
    let result = rec.read_back(&c).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let expected = |x: &u32| 2 * (81 * (2 * x + 1) + 40) + 1;
    let expected: Vec<u32> = input.iter().map(expected).collect();
    assert_eq!(result.get::<u32>().unwrap(), expected);
    assert_silent(&gpu);
}

#[test]
fn submissions_execute_it_while_others_are_under_way() {
    let gpu = open();
    let (bundle, [a, _]) = there_and_back(&gpu, QueueKind::Async);
    gpu.write(&a, &vec![0_u32; COUNT as usize]).unwrap();
    let mut last = None;
    for _ in 0..8 {
        let mut rec = gpu.recorder(QueueKind::Async).unwrap();
        rec.execute(&bundle).unwrap();
        last = Some(gpu.submit(rec).unwrap());
    }
    // The submissions hold the resources of the bundle.
    drop(bundle);
    last.unwrap().wait().unwrap();
    // Sixteen times x → 3x + 1, from 0.
    let expected = (3_u32.pow(16) - 1) / 2;
    assert!(gpu.read::<u32>(&a).unwrap().iter().all(|x| *x == expected));
    assert_silent(&gpu);
}

#[test]
fn uploads_and_fills_of_a_bundle_repeat() {
    let gpu = open();
    let [a, b] = ["a", "b"].map(|label| Buffer::storage(&gpu, label, 64).unwrap());
    let bundle = {
        let rec = gpu.recorder(QueueKind::Main).unwrap();
        rec.bundle("start", |rec| {
            rec.fill(&a, 7)?;
            rec.upload(&b, &[1_u32, 2, 3])
        })
        .unwrap()
    };
    for _ in 0..3 {
        gpu.write(&a, &[0_u32; 16]).unwrap();
        gpu.write(&b, &[0_u32; 16]).unwrap();
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        rec.execute(&bundle).unwrap();
        let [a, b] = [&a, &b].map(|buffer| rec.read_back(buffer).unwrap());
        gpu.submit(rec).unwrap().wait().unwrap();
        assert_eq!(a.get::<u32>().unwrap(), [7; 16]);
        assert_eq!(b.get::<u32>().unwrap()[..4], [1, 2, 3, 0]);
    }
    assert_silent(&gpu);
}

#[test]
fn what_belongs_to_one_submission_is_refused() {
    let gpu = open();
    let a = Buffer::storage(&gpu, "a", 64).unwrap();
    let desc = ImageDesc {
        extent: [4, 4],
        layers: 1,
        format: vk::Format::R8G8B8A8_UNORM,
        usage: vk::ImageUsageFlags::TRANSFER_SRC,
    };
    let image = Image::new(&gpu, "picture", desc).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let (bundle, _) = there_and_back(&gpu, QueueKind::Main);
    type Refused<'a> = &'a dyn Fn(&mut vitriol_gpu::Recorder) -> Result<(), GpuError>;
    let refused: [Refused<'_>; 3] = [
        &|rec| rec.read_back(&a).map(|_| ()),
        &|rec| rec.read_back_image(&image).map(|_| ()),
        &|rec| rec.execute(&bundle),
    ];
    for record in refused {
        let error = rec.bundle("refused", |rec| record(rec)).err().unwrap();
        assert!(matches!(error, GpuError::Bundle(_)), "{error}");
    }
    let (of_other, _) = there_and_back(&gpu, QueueKind::Async);
    if !rec.takes(&of_other) {
        let error = rec.execute(&of_other).unwrap_err();
        assert!(matches!(error, GpuError::Bundle(_)), "{error}");
    }
    assert_silent(&gpu);
}

#[test]
fn it_counts_as_one_pass_where_passes_are_told() {
    let gpu = open_with(|options| {
        options.timestamps = vitriol_gpu::Timestamps::Passes;
        options.markers = true;
    });
    assert!(gpu.options().tells_passes());
    let (bundle, [a, _]) = there_and_back(&gpu, QueueKind::Main);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.fill(&a, 1).unwrap();
    rec.execute(&bundle).unwrap();
    let ticket = gpu.submit(rec).unwrap();
    ticket.wait().unwrap();
    let timings = ticket.timings().unwrap();
    let labels: Vec<_> = timings.iter().map(|pass| pass.label.as_str()).collect();
    assert_eq!(labels, ["fill", "there and back", "total"]);
    assert_silent(&gpu);
}
