//! Buffers: sizes, upload, copies, readback, lifetime.

use vitriol_gpu::{Buffer, ComputePipeline, CopyRegion, GpuError, QueueKind};

use crate::common::{DOUBLE, assert_silent, compile, dispatch, open};

#[test]
fn what_goes_up_comes_down() {
    let gpu = open();
    // Below, at and above the staging chunk of 1 MiB, and two in one recorder
    // that do not fit it together.
    for count in [1_usize, 1000, 262_144, 300_000] {
        let data: Vec<u32> = (0..count as u32)
            .map(|i| i.wrapping_mul(2_654_435_761))
            .collect();
        let [a, b] = ["a", "b"].map(|l| Buffer::storage(&gpu, l, 4 * count as u64).unwrap());
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        rec.upload(&a, &data).unwrap();
        let reversed: Vec<u32> = data.iter().rev().copied().collect();
        rec.upload(&b, &reversed).unwrap();
        let (up, down) = (rec.read_back(&a).unwrap(), rec.read_back(&b).unwrap());
        assert!(matches!(up.get::<u32>(), Err(GpuError::NotDone)));
        gpu.submit(rec).unwrap().wait().unwrap();
        assert_eq!(up.get::<u32>().unwrap()[..count], data);
        assert_eq!(down.get::<u32>().unwrap()[..count], reversed);
    }
    assert_silent(&gpu);
}

#[test]
fn regions_and_persistent_host_buffers() {
    let gpu = open();
    let staging = Buffer::staging(&gpu, "staging", 64).unwrap();
    let device = Buffer::storage(&gpu, "device", 64).unwrap();
    let host = Buffer::readback(&gpu, "host", 64).unwrap();
    let all = CopyRegion {
        from: 0,
        to: 0,
        bytes: 64,
    };
    for round in 0..3_u32 {
        staging
            .write_host(&(round..round + 16).collect::<Vec<u32>>())
            .unwrap();
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        rec.fill(&device, 99).unwrap();
        rec.copy(
            &staging,
            &device,
            &[CopyRegion {
                from: 8,
                to: 4,
                bytes: 12,
            }],
        )
        .unwrap();
        rec.copy(&device, &host, &[all]).unwrap();
        gpu.submit(rec).unwrap().wait().unwrap();
        let got = host.read_host::<u32>(6).unwrap();
        assert_eq!(got, [99, round + 2, round + 3, round + 4, 99, 99]);
    }
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    for bad in [
        CopyRegion {
            from: 0,
            to: 0,
            bytes: 68,
        },
        CopyRegion {
            from: 60,
            to: 0,
            bytes: 8,
        },
        CopyRegion {
            from: 2,
            to: 0,
            bytes: 8,
        },
        CopyRegion {
            from: u64::MAX - 3,
            to: 0,
            bytes: 8,
        },
    ] {
        let error = rec.copy(&device, &host, &[bad]).unwrap_err();
        assert!(matches!(error, GpuError::OutOfRange { .. }), "{error}");
    }
    assert!(matches!(
        rec.upload(&device, &[0_u32; 17]),
        Err(GpuError::OutOfRange { .. })
    ));
    assert!(matches!(
        device.read_host::<u32>(1),
        Err(GpuError::NotHostVisible { .. })
    ));
    assert!(matches!(
        host.read_host::<u32>(17),
        Err(GpuError::OutOfRange { .. })
    ));
    assert_silent(&gpu);
}

#[test]
fn a_buffer_over_the_limit_is_refused_before_the_driver_sees_it() {
    let gpu = open();
    let limit = gpu.info().limits.storage_bytes;
    let Err(error) = Buffer::storage(&gpu, "too large", limit + 4) else {
        panic!("{limit} + 4 bytes were taken")
    };
    let text = error.to_string();
    assert!(
        text.contains("too large") && text.contains(&limit.to_string()),
        "{text}"
    );
    assert!(text.contains("fewer particles"), "{text}");
    assert_silent(&gpu);
}

#[test]
fn what_is_in_use_outlives_its_handles() {
    let gpu = open();
    let count = 1_000_000_u32;
    let bytes = 4 * u64::from(count);
    let last = Buffer::storage(&gpu, "last", bytes).unwrap();
    let ticket = {
        let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
        let first = Buffer::storage(&gpu, "first", bytes).unwrap();
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        rec.fill(&first, 3).unwrap();
        dispatch(&mut rec, &double, [&first, &last], count);
        // Pipeline, buffer and the commands' own handles go while it runs.
        gpu.submit(rec).unwrap()
    };
    ticket.wait().unwrap();
    assert!(gpu.read::<u32>(&last).unwrap().iter().all(|x| *x == 7));
    // A recorder that is dropped has done nothing.
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    rec.fill(&last, 0).unwrap();
    drop(rec);
    assert_eq!(gpu.read::<u32>(&last).unwrap()[0], 7);
    assert_silent(&gpu);
}

/// The contents of one readback are not those of the next one of its size, which has its memory.
#[test]
fn readbacks_share_memory_and_not_what_is_in_it() {
    let gpu = open();
    let [one, two] = ["one", "two"].map(|label| Buffer::storage(&gpu, label, 4096).unwrap());
    gpu.write(&one, &[1_u32; 1024]).unwrap();
    gpu.write(&two, &[2_u32; 1024]).unwrap();
    for round in 0..20 {
        // Some at once, which are dropped in another order than they were made.
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        let mut copies: Vec<_> = (0..round % 4 + 1)
            .map(|n| if n % 2 == 0 { (&one, 1) } else { (&two, 2) })
            .map(|(buffer, value)| (rec.read_back(buffer).unwrap(), value))
            .collect();
        let ticket = gpu.submit(rec).unwrap();
        if round % 3 == 0 {
            // Before the device is done with it.
            copies.remove(0);
        }
        ticket.wait().unwrap();
        copies.rotate_left(round % 2);
        for (copy, value) in copies {
            assert_eq!(copy.get::<u32>().unwrap(), [value; 1024], "round {round}");
        }
    }
    assert_silent(&gpu);
}
