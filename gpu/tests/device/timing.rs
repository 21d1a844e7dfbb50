//! Timestamps, and the CPU's share of a frame.

use vitriol_gpu::{Buffer, ComputePipeline, QueueKind, Timestamps};

use crate::common::{DOUBLE, assert_silent, compile, dispatch, open, open_with};

#[test]
fn every_pass_is_timed_under_its_label() {
    let gpu = open_with(|options| options.timestamps = Timestamps::Passes);
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let count = 4_000_000_u32;
    let [a, b] = ["a", "b"].map(|l| Buffer::storage(&gpu, l, 4 * u64::from(count)).unwrap());
    let [c, d] = ["c", "d"].map(|l| Buffer::storage(&gpu, l, 256).unwrap());
    let [mut large, mut small, mut closing] = [f64::INFINITY; 3];
    // All recorders but the first are recycled ones.
    for _ in 0..8 {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        rec.fill(&a, 1).unwrap();
        rec.pass(&double)
            .label("large")
            .read("source", &a)
            .write("target_", &b)
            .invocations(count)
            .unwrap();
        rec.pass(&double)
            .label("small")
            .read("source", &c)
            .write("target_", &d)
            .invocations(64)
            .unwrap();
        // More than one pool of 512.
        for _ in 0..600 {
            dispatch(&mut rec, &double, [&c, &d], 64);
        }
        let ticket = gpu.submit(rec).unwrap();
        ticket.wait().unwrap();
        let timings = ticket.timings().unwrap();
        let labels: Vec<&str> = timings.iter().map(|timing| timing.label.as_str()).collect();
        assert_eq!(labels[..4], ["fill", "large", "small", "test:main"]);
        assert_eq!((labels.len(), labels[603]), (604, "total"));
        let time = |index: usize| timings[index].nanoseconds;
        let sum: f64 = (0..603).map(time).sum();
        // Stamps are whole ticks; their sum is exact but for the last digits.
        assert!(sum <= time(603) * (1.0 + 1e-9), "{sum} of {}", time(603));
        large = large.min(time(1));
        small = small.min(time(2));
        closing = closing.min(1.0 - sum / time(603));
    }
    // 62,500 times the work; on a large GPU 12 µs for a quarter of it against
    // 3 µs, which are a dispatch's fixed cost. The best of several, since other
    // tests share the processor.
    assert!(large > 4.0 * small, "{large} ns against {small} ns");
    // The stamps abut; only the work that closes the submission belongs to no pass.
    assert!(closing < 0.1, "{closing} of the total");
    assert_silent(&gpu);
}

/// The time of the whole submission is the sum of its passes' times when they are measured.
#[test]
fn a_submission_is_timed_as_a_whole() {
    let gpu = open_with(|options| {
        (options.timestamps, options.markers) = (Timestamps::Whole, true);
    });
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let count = 4_000_000_u32;
    let [a, b] = ["a", "b"].map(|l| Buffer::storage(&gpu, l, 4 * u64::from(count)).unwrap());
    let time = |passes: u32| {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        for _ in 0..passes {
            dispatch(&mut rec, &double, [&a, &b], count);
        }
        let ticket = gpu.submit(rec).unwrap();
        ticket.wait().unwrap();
        let timings = ticket.timings().unwrap();
        let [whole] = &timings[..] else {
            panic!("{timings:?}");
        };
        assert_eq!(whole.label, "total");
        whole.nanoseconds
    };
    // The best of several, taken in turns, since others share the processor; of more where it is busy.
    // Recorders are recycled.
    let (mut one, mut six) = (f64::INFINITY, f64::INFINITY);
    for round in 0..64 {
        one = one.min(time(1));
        six = six.min(time(6));
        if round >= 8 && six > 3.0 * one {
            break;
        }
    }
    assert!(one > 0.0 && six > 3.0 * one, "{one} ns and {six} ns");
    assert_silent(&gpu);
}

#[test]
fn no_times_unless_asked() {
    let gpu = open();
    let rec = gpu.recorder(QueueKind::Main).unwrap();
    let ticket = gpu.submit(rec).unwrap();
    ticket.wait().unwrap();
    assert_eq!(ticket.timings().unwrap(), []);
}

/// 60 passes of 8 bindings each, as a frame of the solver has them, in less
/// than 0.3 ms of the frame's 0.5 ms. The best of many, since other tests share the processor.
#[test]
fn recording_a_frame_is_cheap() {
    let gpu = open_with(|options| options.validation = false);
    let bindings: String = (0..8)
        .map(|i| format!("@group(0) @binding({i}) var<storage, read_write> b{i}: array<u32>;\n"))
        .collect();
    let sum: String = (0..8).map(|i| format!("b{i}[0] += k.x;\n")).collect();
    let text = format!(
        "{bindings}var<immediate> k: vec4<u32>;
        @compute @workgroup_size(1) fn main() {{ {sum} }}"
    );
    let pass = ComputePipeline::new(&gpu, &compile(&text)).unwrap();
    let names: Vec<String> = (0..8).map(|i| format!("b{i}")).collect();
    let buffers: Vec<Buffer> = (0..16)
        .map(|_| Buffer::storage(&gpu, "b", 16).unwrap())
        .collect();
    let mut best = f64::INFINITY;
    for _ in 0..50 {
        let start = std::time::Instant::now();
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        for step in 0..60 {
            let mut one = rec.pass(&pass).constants(&[1_u32; 4]);
            for (index, name) in names.iter().enumerate() {
                one = one.write(name, &buffers[(index + step) % 16]);
            }
            one.invocations(1).unwrap();
        }
        best = best.min(start.elapsed().as_secs_f64());
        gpu.submit(rec).unwrap().wait().unwrap();
    }
    assert!(best < 0.3e-3, "{best} s");
}

/// Whichever thread recycles the finished submission, each thread that asks gets its times.
#[test]
fn times_are_whole_while_another_thread_reads_them() {
    let gpu = open_with(|options| options.timestamps = Timestamps::Whole);
    if gpu.info().timestamp_period == 0.0 {
        eprintln!("this device has no timestamps");
        return;
    }
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let submit = |a: &Buffer, b: &Buffer| {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        let pass = rec.pass(&double).read("source", a).write("target_", b);
        pass.invocations(64).unwrap();
        gpu.submit(rec).unwrap()
    };
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let [a, b] = ["a", "b"].map(|l| Buffer::storage(&gpu, l, 256).unwrap());
                gpu.write(&a, &[1_u32; 64]).unwrap();
                for _ in 0..100 {
                    let ticket = submit(&a, &b);
                    ticket.wait().unwrap();
                    let timings = ticket.timings().unwrap();
                    assert_eq!(timings.len(), 1);
                    assert_eq!(timings[0].label, "total");
                }
            });
        }
    });
    assert_silent(&gpu);
}
