//! What a session holds of memory and of open files does not grow with its frames. `headset::hold` has longer ones, of the program.

use vitriol_session::session::WARM_UP;
use vitriol_session::tally::Holdings;
use vitriol_tests::gpu;
use vitriol_xr::HeadsetFrame;

use crate::vr::common::{Trouble, Worn, nobody, options_where, pour_at_once, session_with};

/// Frames between two looks.
const WINDOW: u64 = 20;

/// Looks at what the process holds.
struct Looks(Vec<Holdings>);

impl Trouble for Looks {
    fn frame(&mut self, _: &mut HeadsetFrame, after: u64) {
        if after >= WARM_UP && after.is_multiple_of(WINDOW) {
            self.0.extend(Holdings::now());
        }
    }
}

/// 33 kB a frame at most: a driver takes megabytes at once, now and then, and a recording that waits for a busy disk held 0.9 MB. The
/// long sessions find 500 bytes a frame. What is looked at is the process's: nextest gives each test its own.
#[test]
#[cfg(target_os = "linux")]
fn nothing_grows_in_a_session() {
    // The validation layer's own memory grows.
    let gpu = gpu::another_device(|options| options.validation = false);
    let folder = tempfile::tempdir().unwrap();
    let (keyframes, in_hand) = pour_at_once();
    let frames = WARM_UP + 12 * WINDOW;
    let mut headset = Worn::new(
        &gpu,
        keyframes.sample_track(),
        90.0,
        frames,
        Looks(Vec::new()),
    );
    // What a frame leaves behind does not depend on how many particles it has.
    let options = options_where(folder.path(), |scene| {
        in_hand(scene).replace("spacing = 0.005 ", "spacing = 0.007 ")
    });
    session_with(&mut headset, options, nobody());
    let Looks(looks) = headset.trouble;
    assert_eq!(looks.len(), 12);
    let [first, .., last] = &looks[..] else {
        unreachable!("there are twelve")
    };
    assert!(last.handles <= first.handles + 1, "{looks:?}");
    let grown = last.memory as f64 - first.memory as f64;
    assert!(grown < 8e6, "{looks:?}");
}
