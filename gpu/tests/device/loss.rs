//! Markers follow the device from pass to pass and disturb nothing.

use vitriol_gpu::{Buffer, ComputePipeline, QueueKind};

use crate::common::{assert_silent, compile, open_with};

/// Each of 64 invocations counts to `rounds`: long enough to be looked at.
const COUNT: &str = "
@group(0) @binding(0) var<storage, read_write> counts: array<u32>;
var<immediate> rounds: u32;
@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) i: u32) {
    for (var k = 0u; k < rounds; k++) { counts[i] = counts[i] * 3u + k; }
}";

#[test]
fn markers_name_the_last_pass_reached() {
    let gpu = open_with(|options| options.markers = true);
    let count = ComputePipeline::new(&gpu, &compile(COUNT)).unwrap();
    let counts = Buffer::storage(&gpu, "counts", 256).unwrap();
    gpu.write(&counts, &[0_u32; 64]).unwrap();
    assert_eq!(gpu.last_pass(), None);
    // The second recorder is a recycled one, whose markers must be clear.
    for _ in 0..2 {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        for label in ["long", "short"] {
            let rounds: u32 = if label == "long" { 1 << 22 } else { 1 };
            rec.pass(&count)
                .label(label)
                .write("counts", &counts)
                .constants(&rounds)
                .invocations(64)
                .unwrap();
        }
        let ticket = gpu.submit(rec).unwrap();
        // Milliseconds before the end of the long pass.
        assert_ne!(gpu.last_pass().as_deref(), Some("short"));
        while !ticket.is_done().unwrap() {
            std::thread::yield_now();
        }
        // Finished, but not yet collected: what a lost device would leave.
        assert_eq!(gpu.last_pass().as_deref(), Some("short"));
        ticket.wait().unwrap();
        assert_eq!(gpu.last_pass(), None);
    }
    assert_silent(&gpu);
}
