//! Markers are written in order and disturb nothing.

use vitriol_gpu::{Buffer, ComputePipeline, QueueKind};

use crate::common::{DOUBLE, assert_silent, compile, open_with};

#[test]
fn markers_name_the_last_pass_reached() {
    let gpu = open_with(|options| options.markers = true);
    let double = ComputePipeline::new(&gpu, &compile(DOUBLE)).unwrap();
    let [a, b] = ["a", "b"].map(|l| Buffer::storage(&gpu, l, 256).unwrap());
    assert_eq!(gpu.last_pass(), None);
    // The second recorder is a recycled one: its markers were cleared.
    for last in ["second", "another second"] {
        let mut rec = gpu.recorder(QueueKind::Main).unwrap();
        rec.pass(&double)
            .label("first")
            .read("source", &a)
            .write("target_", &b)
            .invocations(64)
            .unwrap();
        rec.pass(&double)
            .label(last)
            .read("source", &b)
            .write("target_", &a)
            .invocations(64)
            .unwrap();
        let ticket = gpu.submit(rec).unwrap();
        while !ticket.is_done().unwrap() {
            std::thread::yield_now();
        }
        // Finished, but not yet collected: what a lost device would leave.
        assert_eq!(gpu.last_pass().as_deref(), Some(last));
        ticket.wait().unwrap();
        assert_eq!(gpu.last_pass(), None);
    }
    assert_silent(&gpu);
}
