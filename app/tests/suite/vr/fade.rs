//! The picture is dark where the world leaps: the head's place is lost and found, a scene follows another.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, channel};

use vitriol_session::decision::Decision;
use vitriol_session::stand_in::StandIn;
use vitriol_tests::gpu;
use vitriol_xr::{Headset, HeadsetFrame, Turn};

use crate::vr::common::{StartsOver, Trouble, Worn, hash, nobody, pour, session};
use crate::vr::loss::replayed;
use crate::vr::seen::read;

/// Measures how light the eyes' pictures are after so many frames.
struct Light<T> {
    trouble: T,
    at: Vec<u64>,
    /// By the number of frames, the mean level, 0 to 255. Where frames are awaited, that of the last of them.
    levels: BTreeMap<u64, f64>,
}

impl<T: Trouble> Trouble for Light<T> {
    fn turn(&mut self, headset: &mut StandIn, after: u64) -> Option<Turn> {
        if self.at.contains(&after) {
            let gpu = Headset::gpu(headset).clone();
            gpu.wait_idle().unwrap();
            let colour = read(&gpu, &headset.targets.colour);
            let levels = colour.iter().flat_map(|pixel| &pixel[..3]);
            let sum: f64 = levels.map(|level| f64::from(*level)).sum();
            self.levels.insert(after, sum / (3.0 * colour.len() as f64));
        }
        None
    }

    fn frame(&mut self, frame: &mut HeadsetFrame, after: u64) {
        self.trouble.frame(frame, after);
    }

    fn awaits(&self, after: u64) -> bool {
        self.trouble.awaits(after)
    }
}

/// After so many frames each, the last of which ends the session: the mean level, and whether the panel has its own layer in that frame.
/// A replay comes to the same bits: the dark is shown and not recorded as anything that it needs.
fn light<const N: usize>(
    at: [u64; N],
    trouble: impl Trouble,
    decisions: Receiver<Decision>,
) -> [(f64, bool); N] {
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let trouble = Light {
        trouble,
        at: at.to_vec(),
        levels: BTreeMap::new(),
    };
    let last = at[N - 1];
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, last, trouble);
    let (outcome, track) = session(&mut headset, folder.path(), decisions);
    assert_eq!(replayed(&gpu, track), hash(&outcome));
    // From the end, as frames that are awaited before do not count.
    let layers = headset.shown.iter().rev().map(|it| it.panel.is_some());
    let layers: Vec<bool> = layers.collect();
    let levels = &headset.trouble.levels;
    at.map(|after| (levels[&after], layers[(last - after) as usize]))
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
    let (sender, decisions) = channel();
    let trouble = StartsOver {
        asks: ASKS,
        decisions: sender,
    };
    let at = [ASKS, COMES, COMES + FADE / 2, COMES + FADE + 2];
    let [(whole, _), (there, _), half, back] = light(at, trouble, decisions);
    // In the frame in which it is there.
    assert!(there < 1.0, "{there}");
    let share = half.0 / whole;
    assert!((0.25..0.8).contains(&share) && !half.1, "{share}");
    let share = back.0 / whole;
    assert!((share - 1.0).abs() < 0.05 && back.1, "{share}");
}

mod long {
    use super::*;

    #[test]
    fn it_fades_where_the_heads_place_is_lost() {
        let (lost, found) = (LOST.start, LOST.end);
        let at = [
            lost,
            lost + FADE / 2,
            lost + FADE + 2,
            found + 1,
            found + FADE + 2,
        ];
        let [whole, half, (gone, _), (dark, _), back] = light(at, Lost, nobody());
        assert!(whole.0 > 90.0 && whole.1, "{}", whole.0);
        let share = half.0 / whole.0;
        assert!((0.3..0.75).contains(&share) && !half.1, "{share}");
        // What is left is dither.
        assert!(gone < 1.0, "{gone}");
        // Found again, it is dark in this frame, and then comes back.
        assert!(dark < 1.0, "{dark}");
        let share = back.0 / whole.0;
        assert!((share - 1.0).abs() < 0.05 && back.1, "{share}");
    }
}
