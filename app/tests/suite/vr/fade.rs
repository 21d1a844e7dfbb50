//! The picture is dark where the world leaps: the head's place is lost and found, a scene follows another.

use std::sync::mpsc::{Receiver, Sender, channel};

use vitriol::vr::decision::Decision;
use vitriol::vr::workbench::TAKEN_UP;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_tests::gpu;
use vitriol_xr::HeadsetFrame;

use crate::vr::common::{Trouble, Worn, hash, heard, nobody, pour, session};
use crate::vr::loss::replayed;

/// Mean level of the last frame's picture, 0 to 255, and whether the panel had its own layer then; also that the recording replays.
fn light<T: Trouble>(
    gpu: &Gpu,
    frames: u64,
    trouble: T,
    decisions: Receiver<Decision>,
) -> (f64, bool) {
    let folder = tempfile::tempdir().unwrap();
    let mut headset = Worn::new(gpu, pour().sample_track(), 90.0, frames, trouble);
    let (outcome, track) = session(&mut headset, folder.path(), decisions);
    let expected = hash(&outcome);
    assert_eq!(replayed(gpu, track), expected);
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let colour = rec.read_back_image(&headset.inner.targets.colour).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let colour: Vec<u8> = colour.get().unwrap();
    let levels = colour.chunks_exact(4).flat_map(|pixel| &pixel[..3]);
    let sum: f64 = levels.map(|level| f64::from(*level)).sum();
    let has_panel = headset.shown.last().unwrap().panel.is_some();
    (sum / (0.75 * colour.len() as f64), has_panel)
}

/// At 90 Hz, 0.2 s are 18 frames.
const FADE: u64 = 18;
const LOST: std::ops::Range<u64> = 5..50;

struct Lost;

impl Trouble for Lost {
    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        frame.lost = LOST.contains(&after);
    }
}

#[test]
fn it_fades_where_the_heads_place_is_lost() {
    let gpu = gpu::device();
    let after = |frames: u64| light(&gpu, frames, Lost, nobody());
    let (whole, layer) = after(LOST.start);
    assert!(whole > 90.0 && layer, "{whole}");
    let (half, layer) = after(LOST.start + FADE / 2);
    assert!(
        (0.3..0.75).contains(&(half / whole)) && !layer,
        "{half} of {whole}"
    );
    // What is left is dither.
    assert!(after(LOST.start + FADE + 2).0 < 1.0);
    // Found again, it is dark in this frame, and then comes back.
    assert!(after(LOST.end + 1).0 < 1.0);
    let (back, layer) = after(LOST.end + FADE + 2);
    assert!(
        (back / whole - 1.0).abs() < 0.05 && layer,
        "{back} of {whole}"
    );
}

/// Starts the scene over.
struct StartsOver(Sender<Decision>);

/// The frame that asks, and the one that the new bench comes in or the next.
const ASKS: u64 = 5;
const COMES: u64 = 6;

impl Trouble for StartsOver {
    fn awaits(&self, after: u64) -> bool {
        after == COMES && heard(TAKEN_UP) == 0
    }

    fn frame(&mut self, _: &mut HeadsetFrame, after: u64) {
        if after == ASKS {
            self.0.send(Decision::Start).unwrap();
        }
    }
}

#[test]
fn a_scene_comes_in_the_dark() {
    let gpu = gpu::device();
    let after = |frames: u64| {
        let (sender, decisions) = channel();
        light(&gpu, frames, StartsOver(sender), decisions)
    };
    let (whole, _) = after(ASKS);
    // In the frame in which it is there.
    assert!(after(COMES).0 < 1.0);
    let (half, layer) = after(COMES + FADE / 2);
    assert!(
        (0.25..0.8).contains(&(half / whole)) && !layer,
        "{half} of {whole}"
    );
    let (back, layer) = after(COMES + FADE + 2);
    assert!(
        (back / whole - 1.0).abs() < 0.05 && layer,
        "{back} of {whole}"
    );
}
