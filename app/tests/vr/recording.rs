//! The recorder beside the frame loop.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use vitriol::vr::record::{Said, Sink, TrackRecording};
use vitriol_tests::wait::own_time;
use vitriol_xr::track::TrackError;
use vitriol_xr::{FrameInfo, Hand, Pose, PoseFrame, Switch};

/// A disk that writes a step when it is told to.
struct Disk {
    /// Told of each step that is to be written.
    asked: Sender<()>,
    allowed: Receiver<()>,
    written: Arc<Mutex<Vec<PoseFrame>>>,
    full_after: usize,
}

impl Sink for Disk {
    fn write(&mut self, frame: &PoseFrame, _: &[Pose]) -> Result<(), TrackError> {
        let _ = self.asked.send(());
        // At the end, whose sender is gone, it writes what it has.
        let _ = self.allowed.recv();
        let mut written = self.written.lock().unwrap();
        if written.len() >= self.full_after {
            return Err(TrackError::Io {
                file: "session.mcap".into(),
                action: "write",
                source: std::io::Error::from(std::io::ErrorKind::StorageFull),
            });
        }
        written.push(frame.clone());
        Ok(())
    }

    fn written(&self) -> u64 {
        self.written.lock().unwrap().len() as u64
    }

    fn finish(&mut self, _: &Said) -> Result<(), TrackError> {
        Ok(())
    }
}

/// A disk, and the test's hold on it.
fn disk(full_after: usize) -> (Box<Disk>, Hold) {
    let ((ask, asked), (allow, allowed)) = (channel(), channel());
    let written = Arc::<Mutex<Vec<PoseFrame>>>::default();
    let disk = Disk {
        asked: ask,
        allowed,
        written: Arc::clone(&written),
        full_after,
    };
    let hold = Hold {
        asked,
        allow,
        written,
    };
    (Box::new(disk), hold)
}

struct Hold {
    asked: Receiver<()>,
    allow: Sender<()>,
    written: Arc<Mutex<Vec<PoseFrame>>>,
}

fn frame(step: u64, switched: Option<&str>) -> PoseFrame {
    PoseFrame {
        step,
        time_ns: step as i64,
        stage_from_view: Pose::IDENTITY,
        hands: [Hand::default(), Hand::default()],
        scenario: switched
            .map(|value| Switch {
                key: "scene".into(),
                value: value.into(),
            })
            .into_iter()
            .collect(),
        info: FrameInfo::default(),
    }
}

#[test]
fn a_full_queue_delays_nobody_and_is_counted() {
    let (disk, hold) = disk(usize::MAX);
    let mut recording = TrackRecording::into_sink(disk, 4);
    // The first is taken off the queue, and waits for the disk.
    recording.push(&frame(0, None), Vec::new());
    hold.asked.recv().unwrap();
    let ((), took) = own_time(|| {
        for step in 1..20 {
            recording.push(&frame(step, (step == 15).then_some("x")), Vec::new());
        }
    });
    assert!(took < Duration::from_secs(1), "it took {took:?}");
    let state = recording.state();
    assert_eq!((state.steps, state.unwritten), (0, 15));
    assert!(state.cause.unwrap().contains("did not keep up"));
    drop(hold.allow);
    let state = recording.finish(20, 20, Said::new());
    assert_eq!((state.steps, state.unwritten), (5, 15));
    let written = hold.written.lock().unwrap();
    let steps: Vec<u64> = written.iter().map(|frame| frame.step).collect();
    assert_eq!(steps, [0, 1, 2, 3, 4, 20]);
    // What was switched in a step that is missing is not: a replay would be another scene's.
    assert_eq!(written[5].scenario[0].value, "x");
}

#[test]
fn a_full_disk_is_counted_and_said() {
    let (disk, hold) = disk(3);
    drop(hold.allow);
    let mut recording = TrackRecording::into_sink(disk, 64);
    for step in 0..10 {
        recording.push(&frame(step, None), Vec::new());
    }
    let state = recording.finish(10, 10, Said::new());
    // Ten steps; the end, which was not written either, is none.
    assert_eq!((state.steps, state.unwritten), (3, 7));
    let cause = state.cause.unwrap();
    assert!(cause.contains("session.mcap"), "{cause}");
}
