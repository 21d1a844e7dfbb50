//! The picture is dark where the world leaps: the head's place is lost and found, a scene follows another.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::mpsc::{Receiver, Sender, channel};

use vitriol::vr::decision::Decision;
use vitriol::vr::stand_in::StandIn;
use vitriol::vr::workbench::TAKEN_UP;
use vitriol_gpu::{Gpu, Image, QueueKind};
use vitriol_tests::gpu;
use vitriol_xr::{Headset, HeadsetFrame, Turn};

use crate::vr::common::{Trouble, Worn, hash, heard, nobody, pour, session};
use crate::vr::loss::replayed;

/// Mean level of the picture after each of so many frames, 0 to 255, and whether the panel had its own layer then; also that the
/// recording replays.
fn light<T: Trouble, const N: usize>(
    gpu: &Gpu,
    after: [u64; N],
    trouble: T,
    decisions: Receiver<Decision>,
) -> [(f64, bool); N] {
    let folder = tempfile::tempdir().unwrap();
    let looks = Looks {
        trouble,
        levels: Rc::default(),
    };
    let levels = Rc::clone(&looks.levels);
    let frames = after.into_iter().max().unwrap();
    let mut headset = Worn::new(gpu, pour().sample_track(), 90.0, frames, looks);
    let (outcome, track) = session(&mut headset, folder.path(), decisions);
    assert_eq!(replayed(gpu, track), hash(&outcome));
    let levels = levels.borrow();
    after.map(|frames| {
        let shown = &headset.shown[frames as usize - 1];
        (levels[&frames], shown.panel.is_some())
    })
}

/// Takes the mean level of each picture.
struct Looks<T> {
    trouble: T,
    /// After so many frames.
    levels: Rc<RefCell<BTreeMap<u64, f64>>>,
}

impl<T: Trouble> Trouble for Looks<T> {
    fn turn(&mut self, headset: &mut StandIn, after: u64) -> Option<Turn> {
        if after > 0 {
            let level = level(Headset::gpu(headset), &headset.targets.colour);
            self.levels.borrow_mut().insert(after, level);
        }
        self.trouble.turn(headset, after)
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        self.trouble.frame(frame, after);
    }

    fn awaits(&self, after: u64) -> bool {
        self.trouble.awaits(after)
    }
}

fn level(gpu: &Gpu, colour: &Image) -> f64 {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let colour = rec.read_back_image(colour).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let colour: Vec<u8> = colour.get().unwrap();
    let levels = colour.chunks_exact(4).flat_map(|pixel| &pixel[..3]);
    let sum: f64 = levels.map(|level| f64::from(*level)).sum();
    sum / (0.75 * colour.len() as f64)
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
    let after = [
        LOST.start,
        LOST.start + FADE / 2,
        LOST.start + FADE + 2,
        LOST.end + 1,
        LOST.end + FADE + 2,
    ];
    let [begins, fades, over, found, comes_back] = light(&gpu, after, Lost, nobody());
    let (whole, layer) = begins;
    assert!(whole > 90.0 && layer, "{whole}");
    let (half, layer) = fades;
    assert!(
        (0.3..0.75).contains(&(half / whole)) && !layer,
        "{half} of {whole}"
    );
    // What is left is dither.
    assert!(over.0 < 1.0);
    // Found again, it is dark in this frame, and then comes back.
    assert!(found.0 < 1.0);
    let (back, layer) = comes_back;
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
    let (sender, decisions) = channel();
    let after = [ASKS, COMES, COMES + FADE / 2, COMES + FADE + 2];
    let [(whole, _), comes, (half, layer), comes_back] =
        light(&gpu, after, StartsOver(sender), decisions);
    // In the frame in which it is there.
    assert!(comes.0 < 1.0);
    assert!(
        (0.25..0.8).contains(&(half / whole)) && !layer,
        "{half} of {whole}"
    );
    let (back, layer) = comes_back;
    assert!(
        (back / whole - 1.0).abs() < 0.05 && layer,
        "{back} of {whole}"
    );
}
