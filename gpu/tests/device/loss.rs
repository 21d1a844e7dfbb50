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
    // Recorders but the first are recycled ones, whose markers must be clear. A pass that was over before it could be observed is made
    // longer.
    let (mut caught, mut long) = (0, 1 << 22);
    while caught < 2 {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        for label in ["long", "short"] {
            let rounds: u32 = if label == "long" { long } else { 1 };
            rec.pass(&count)
                .label(label)
                .write("counts", &counts)
                .constants(&rounds)
                .invocations(64)
                .unwrap();
        }
        let ticket = gpu.submit(rec).unwrap();
        let mut reached = vec![gpu.last_pass()];
        while !ticket.is_done().unwrap() {
            reached.push(gpu.last_pass());
            std::thread::yield_now();
        }
        reached.dedup();
        let order = [None, Some("long"), Some("short")];
        let mut order = order.iter();
        for pass in &reached {
            assert!(order.any(|next| *next == pass.as_deref()), "{reached:?}");
        }
        match reached.iter().any(|pass| pass.as_deref() == Some("long")) {
            true => caught += 1,
            false => long = long.checked_mul(2).expect("the long pass is seen"),
        }
        // Finished, but not yet collected: what a lost device would leave.
        assert_eq!(gpu.last_pass().as_deref(), Some("short"));
        ticket.wait().unwrap();
        assert_eq!(gpu.last_pass(), None);
    }
    assert_silent(&gpu);
}
