//! The glass from close by on the console: a page that asks gets it, and the student's session is as without.

use std::net::{Ipv4Addr, SocketAddr};

use vitriol_console::{Codec, Watcher};
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_lesson::{Language, Texts};
use vitriol_live::{Console, start, student};
use vitriol_tests::{gpu, wait};

use crate::vr::common::{Settled, Worn, hash, nobody, options, pour, session_with};

const EXTENT: [u32; 2] = [320, 240];
/// Frames at 60 Hz: in half a second of the display three pictures from close by are due.
const FRAMES: u64 = 30;

/// How a session ended: hash of its particles, depth in the eyes' last picture, and a picture that the page got which shows the glass from
/// the start on, where one is to.
fn ended(gpu: &Gpu, asks: bool) -> (u64, Vec<f32>, Option<Vec<u8>>) {
    let folder = tempfile::tempdir().unwrap();
    let listen = SocketAddr::new(Ipv4Addr::LOCALHOST.into(), 0);
    let hub = start(listen, false, Language::En).unwrap();
    let told = student((Some("Ada"), &Texts::english().unwrap()), true);
    let port = hub.student(told.clone()).unwrap().unwrap();
    let page = asks.then(|| Watcher::enter(&hub, Codec::CloseUp).unwrap());
    if asks {
        wait::until("the glass is asked for", || {
            port.wanted().close_up.then_some(())
        });
    }
    let mut options = options(folder.path());
    options.console = Some(Console {
        port,
        student: told,
        language: Language::En,
    });
    let track = pour().sample_track();
    let mut headset = Worn::of_extent(gpu, track, EXTENT, (60.0, FRAMES), Settled(gpu.clone()));
    let (outcome, _) = session_with(&mut headset, options, nobody());
    let hash = hash(&outcome);
    let depth = headset.inner.targets.depth.as_ref().unwrap();
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let depth = rec.read_back_image(depth).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    let shown = page.map(|mut page| {
        loop {
            // While it showed no student yet, a card's picture may have been asked for.
            let picture = page.see().unwrap();
            if picture[0] == 4 {
                break picture;
            }
        }
    });
    (hash, depth.get().unwrap(), shown)
}

#[test]
fn a_page_sees_the_glass_and_the_student_sees_no_difference() {
    let gpu = gpu::device();
    let (without, depths, none) = ended(&gpu, false);
    assert_eq!(none, None);
    let (with, same, shown) = ended(&gpu, true);
    assert_eq!(with, without, "other particles");
    assert!(same == depths, "the eyes have another picture");
    // Width and height, little-endian: 320 × 240, which is all that the eyes' images hold.
    let shown = shown.unwrap();
    assert_eq!(shown[4..8], [64, 1, 240, 0]);
    // JPEG's first and last marker (ITU T.81, B.1.1.3), behind a head of 16 bytes.
    assert_eq!(shown[16..18], [0xff, 0xd8]);
    assert!(shown.ends_with(&[0xff, 0xd9]));
}
