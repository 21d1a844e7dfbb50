//! The picture is dark where the world leaps: the head's place is lost and found, a scene follows another.

use std::sync::mpsc::{Receiver, channel};

use vitriol_gpu::Gpu;
use vitriol_session::decision::Decision;
use vitriol_tests::gpu;
use vitriol_xr::HeadsetFrame;
use vitriol_xr::track::Track;

use crate::vr::common::{StartsOver, Trouble, Worn, hash, nobody, pour, session};
use crate::vr::loss::replayed;
use crate::vr::seen::read;

/// What a session ended with: mean level of the last frame's picture, 0 to 255, whether the panel had its own layer then, the recording
/// and the state's hash.
struct Ended {
    level: f64,
    layer: bool,
    track: Track,
    hash: u64,
}

fn light<T: Trouble>(gpu: &Gpu, frames: u64, trouble: T, decisions: Receiver<Decision>) -> Ended {
    let folder = tempfile::tempdir().unwrap();
    let mut headset = Worn::new(gpu, pour().sample_track(), 90.0, frames, trouble);
    let (outcome, track) = session(&mut headset, folder.path(), decisions);
    let colour = read(gpu, &headset.inner.targets.colour);
    let levels = colour.iter().flat_map(|pixel| &pixel[..3]);
    let sum: f64 = levels.map(|level| f64::from(*level)).sum();
    Ended {
        level: sum / (3.0 * colour.len() as f64),
        layer: headset.shown.last().unwrap().panel.is_some(),
        hash: hash(&outcome),
        track,
    }
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

/// The frame that asks, and the one that the new bench comes in or the next.
const ASKS: u64 = 5;
const COMES: u64 = 6;

#[test]
fn a_scene_comes_in_the_dark() {
    let gpu = gpu::device();
    let after = |frames: u64| {
        let (sender, decisions) = channel();
        light(
            &gpu,
            frames,
            StartsOver {
                asks: ASKS,
                decisions: sender,
            },
            decisions,
        )
    };
    let whole = after(ASKS).level;
    // In the frame in which it is there.
    assert!(after(COMES).level < 1.0);
    let half = after(COMES + FADE / 2);
    let share = half.level / whole;
    assert!((0.25..0.8).contains(&share) && !half.layer, "{share}");
    let back = after(COMES + FADE + 2);
    let share = back.level / whole;
    assert!((share - 1.0).abs() < 0.05 && back.layer, "{share}");
    assert_eq!(replayed(&gpu, back.track), back.hash);
}

mod long {
    use super::*;

    #[test]
    fn it_fades_where_the_heads_place_is_lost() {
        let gpu = gpu::device();
        let after = |frames: u64| light(&gpu, frames, Lost, nobody());
        let whole = after(LOST.start);
        assert!(whole.level > 90.0 && whole.layer, "{}", whole.level);
        let half = after(LOST.start + FADE / 2);
        let share = half.level / whole.level;
        assert!((0.3..0.75).contains(&share) && !half.layer, "{share}");
        // What is left is dither.
        assert!(after(LOST.start + FADE + 2).level < 1.0);
        // Found again, it is dark in this frame, and then comes back.
        assert!(after(LOST.end + 1).level < 1.0);
        let back = after(LOST.end + FADE + 2);
        let share = back.level / whole.level;
        assert!((share - 1.0).abs() < 0.05 && back.layer, "{share}");
        // The dark is shown and not recorded as anything that a replay needs.
        assert_eq!(replayed(&gpu, back.track), back.hash);
    }
}
