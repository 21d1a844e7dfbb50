//! What a frame waits for while another thread builds a scene.

use std::sync::mpsc::{Sender, channel};

use crate::vr::common::{Trouble, Worn, heard, options, pour, session_with};
use vitriol_run::Action;
use vitriol_session::decision::Decision;
use vitriol_session::session::WARM_UP;
use vitriol_session::stand_in::StandIn;
use vitriol_session::workbench::TAKEN_UP;
use vitriol_tests::gpu;
use vitriol_xr::Turn;

/// Frames that count before the scene is begun anew, and in all; those in which the new one is awaited come on top.
const ALONE: u64 = 20;
const ALL: u64 = 40;

/// Begins the scene anew.
struct Starts(Option<Sender<Decision>>);

impl Trouble for Starts {
    fn turn(&mut self, _: &mut StandIn, after: u64) -> Option<Turn> {
        if after == WARM_UP + ALONE
            && let Some(decisions) = self.0.take()
        {
            decisions.send(Decision::Act(Action::Start(None))).unwrap();
        }
        None
    }

    fn awaits(&self, after: u64) -> bool {
        after == WARM_UP + ALONE + 1 && heard(TAKEN_UP) == 0
    }
}

/// Frames beside a build are told from the others, and what each kind took and waited for is reported. How long that
/// was is no matter here: `vitriol vr` measures it.
#[test]
fn frames_beside_a_build_are_reported() {
    let gpu = gpu::device();
    let folder = tempfile::tempdir().unwrap();
    let (sender, decisions) = channel();
    let trouble = Starts(Some(sender));
    let mut headset = Worn::new(&gpu, pour().sample_track(), 90.0, WARM_UP + ALL, trouble);
    let mut options = options(folder.path());
    // More than come: the headset is taken off first.
    options.frames = Some(1_000_000);
    let (outcome, _) = session_with(&mut headset, options, decisions);
    let tally = &outcome.tally;
    let report = |frames: &vitriol_session::tally::Frames| {
        let report = frames.report().unwrap();
        serde_json::to_value(report).unwrap()
    };
    let (alone, building) = (report(&tally.alone), report(&tally.building));
    eprintln!("alone: {alone}\nwhile building: {building}");
    let frames = [&alone, &building].map(|report| report["frames"].as_u64().unwrap());
    // The frame in which it is asked for, those in which it is awaited, and the one that takes it up.
    let counted = outcome.frames - WARM_UP;
    assert_eq!(frames[0] + frames[1], counted);
    assert_eq!(tally.cpu_ms.len() as u64, counted);
    let built = counted - ALL + 2;
    assert!((2..=built).contains(&frames[1]), "{frames:?} of {counted}");
    assert!(frames[0] >= ALL - 2, "{frames:?} of {counted}");
    for report in [&alone, &building] {
        let of_each = report["cpu_ms"]["p99"].as_f64().unwrap();
        assert!(of_each > 0.0, "{report}");
        for lock in ["queue_lock", "memory_lock"] {
            let [waits, total, longest] =
                ["waits", "total_ms", "longest_ms"].map(|key| report[lock][key].as_f64().unwrap());
            // Of some waits the longest is between the mean and all of them; rounding aside.
            let mean = if waits > 0.0 { total / waits } else { 0.0 };
            assert!(longest <= total && longest >= mean - 1e-9, "{report}");
        }
    }
}
