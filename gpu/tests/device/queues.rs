//! The second queue, or the main one in its place.

use std::sync::mpsc::channel;
use std::time::Duration;

use vitriol_gpu::{Buffer, ComputePipeline, Image, ImageDesc, LockWaits, QueueKind, vk};

use crate::common::{DOUBLE, assert_silent, compile, dispatch, open};

#[test]
fn a_ticket_orders_the_queues() {
    let gpu = open();
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let count = 200_000_u32;
    let [a, b] = ["a", "b"].map(|l| Buffer::storage(&gpu, l, 4 * u64::from(count)).unwrap());
    gpu.write(&a, &vec![0_u32; count as usize]).unwrap();
    let mut last = None;
    for _ in 0..4 {
        for (kind, from, to) in [(QueueKind::Async, &a, &b), (QueueKind::Main, &b, &a)] {
            let mut rec = gpu.recorder(kind).unwrap();
            dispatch(&mut rec, &double, [from, to], count);
            let after: Vec<_> = last.iter().collect();
            last = Some(gpu.submit_after(rec, &after).unwrap());
        }
    }
    last.unwrap().wait().unwrap();
    assert!(gpu.read::<u32>(&a).unwrap().iter().all(|x| *x == 255));
    assert_silent(&gpu);
}

#[test]
fn what_is_written_ahead_is_there_for_what_comes_next() {
    let gpu = open();
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let [a, b] = ["a", "b"].map(|l| Buffer::storage(&gpu, l, 256).unwrap());
    let written = gpu.write_ahead(&a, &[3_u32; 64]).unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    dispatch(&mut rec, &double, [&a, &b], 64);
    gpu.submit(rec).unwrap().wait().unwrap();
    assert!(written.is_done().unwrap());
    assert_eq!(gpu.read::<u32>(&b).unwrap(), [7; 64]);
    assert_silent(&gpu);
}

#[test]
fn the_async_queue_refuses_raster() {
    let gpu = open();
    let mut rec = gpu.recorder(QueueKind::Async).unwrap();
    let desc = ImageDesc {
        extent: [4, 4],
        layers: 1,
        format: vk::Format::R8G8B8A8_UNORM,
        usage: vk::ImageUsageFlags::COLOR_ATTACHMENT,
    };
    let target = Image::new(&gpu, "picture", desc).unwrap();
    let error = rec
        .raster("picture", &target, [0.0; 4], |_| Ok(()))
        .unwrap_err();
    assert!(error.to_string().contains("QueueKind::Main"), "{error}");
}

#[test]
fn recorders_of_several_threads() {
    let gpu = open();
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    std::thread::scope(|scope| {
        for start in 0..4_u32 {
            let (gpu, double) = (&gpu, &double);
            scope.spawn(move || {
                let [a, b] = ["a", "b"].map(|l| Buffer::storage(gpu, l, 256).unwrap());
                gpu.write(&a, &[start; 64]).unwrap();
                for _ in 0..8 {
                    let mut rec = gpu.recorder(QueueKind::Async).unwrap();
                    dispatch(&mut rec, double, [&a, &b], 64);
                    gpu.submit(rec).unwrap().wait().unwrap();
                    assert_eq!(gpu.read::<u32>(&b).unwrap(), [2 * start + 1; 64]);
                }
            });
        }
    });
    assert_silent(&gpu);
}

/// A thread's wait for another thread is counted on the waiting thread, by lock; a lock that nobody holds counts no wait.
#[test]
fn waits_for_other_threads_are_counted() {
    let gpu = open();
    let buffer = Buffer::storage(&gpu, "a", 256).unwrap();
    LockWaits::take();
    gpu.write(&buffer, &[1_u32; 64]).unwrap();
    gpu.wait_idle().unwrap();
    assert_eq!(LockWaits::take(), LockWaits::default());
    // The other thread holds the queue until a little after this one is about to submit. A busy machine may stop this
    // one in between, so it is tried until it had to wait.
    let pause = Duration::from_millis(20);
    let try_once = |_| {
        let (held, holds) = channel();
        let (let_go, may_go) = channel::<()>();
        std::thread::scope(|scope| {
            let gpu = &gpu;
            scope.spawn(move || {
                gpu.with_queue(QueueKind::Main, |_| {
                    held.send(()).unwrap();
                    may_go.recv().unwrap();
                    std::thread::sleep(pause);
                });
                // Nobody else held it.
                assert_eq!(LockWaits::take(), LockWaits::default());
            });
            holds.recv().unwrap();
            let_go.send(()).unwrap();
            gpu.submit(gpu.recorder(QueueKind::Main).unwrap()).unwrap();
        });
        let waited = LockWaits::take();
        (waited != LockWaits::default()).then_some(waited)
    };
    let waited = (0..1000).find_map(try_once).unwrap();
    assert_eq!(waited.queue.count, 1);
    assert_eq!(waited.queue.total, waited.queue.longest);
    assert!(!waited.queue.total.is_zero());
    assert_eq!(waited.memory.count, 0);
    assert_eq!(LockWaits::take(), LockWaits::default());
    assert_silent(&gpu);
}
