//! The recorder beside the frame loop.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use vitriol_run::run::{Note, Said, Sink, TrackRecording};
use vitriol_tests::wait::own_time;
use vitriol_xr::track::{Track, TrackError, TrackMetadata};
use vitriol_xr::{FrameInfo, Hand, Pose, PoseFrame, Switch};

/// A disk that writes a step when it is told to.
struct Disk {
    /// Told of each step that is to be written.
    asked: Sender<()>,
    allowed: Receiver<()>,
    written: Arc<Mutex<Vec<PoseFrame>>>,
    found: Arc<Mutex<Vec<(i64, Note)>>>,
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

    fn add(&mut self, time_ns: i64, note: &Note) -> Result<(), TrackError> {
        self.found.lock().unwrap().push((time_ns, note.clone()));
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
    let found = Arc::<Mutex<Vec<(i64, Note)>>>::default();
    let disk = Disk {
        asked: ask,
        allowed,
        written: Arc::clone(&written),
        found: Arc::clone(&found),
        full_after,
    };
    let hold = Hold {
        asked,
        allow,
        written,
        found,
    };
    (Box::new(disk), hold)
}

struct Hold {
    asked: Receiver<()>,
    allow: Sender<()>,
    written: Arc<Mutex<Vec<PoseFrame>>>,
    found: Arc<Mutex<Vec<(i64, Note)>>>,
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
            let json = format!("{{\"n\":{step}}}");
            let note = match step % 2 {
                0 => Note::Event(json),
                _ => Note::Progress(json),
            };
            recording.found(step as i64, note);
        }
    });
    assert!(took < Duration::from_secs(1), "it took {took:?}");
    let state = recording.state();
    // Two of the four places are taken by what was found.
    assert_eq!((state.steps, state.unwritten), (0, 17));
    assert!(state.cause.unwrap().contains("did not keep up"));
    drop(hold.allow);
    let state = recording.finish(20, 20, Said::new());
    assert_eq!((state.steps, state.unwritten), (3, 17));
    let written = hold.written.lock().unwrap();
    let steps: Vec<u64> = written.iter().map(|frame| frame.step).collect();
    assert_eq!(steps, [0, 1, 2, 20]);
    // What was switched in a step that is missing is not: a replay would be another scene's.
    assert_eq!(written[3].scenario[0].value, "x");
    // Nothing that was found is missing.
    let found: Vec<i64> = hold.found.lock().unwrap().iter().map(|it| it.0).collect();
    assert_eq!(found, (1..20).collect::<Vec<_>>());
}

/// What a recorder cannot take leaves a file that says so, without the hash of a state that it does not lead to; what
/// was switched then is in the next step that it takes.
#[test]
fn a_recording_that_lacks_steps_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("x.mcap");
    let mut recording = TrackRecording::create(&file, &TrackMetadata::default()).unwrap();
    recording.push(&frame(0, None), Vec::new());
    // More flasks than a track holds.
    recording.push(&frame(1, Some("x")), vec![Pose::IDENTITY; 65]);
    recording.push(&frame(2, None), Vec::new());
    let said = Said::from([("state_hash".to_owned(), "0123".to_owned())]);
    let state = recording.finish(3, 3, said);
    assert_eq!((state.steps, state.waiting, state.unwritten), (2, 0, 1));
    assert!(state.cause.unwrap().contains("flask_ has 65"));
    let track = Track::open(&file).unwrap();
    assert_eq!(track.holes().count(), 1);
    assert_eq!(track.outcome["broken_off"], "a step is not recorded");
    assert!(!track.outcome.contains_key("state_hash"));
    let switched: Vec<_> = track.frames.iter().map(|it| it.scenario.len()).collect();
    assert_eq!(switched, [0, 1, 0]);
}

/// A disk that refuses a file's end so many times.
struct FullAtTheEnd(u32);

impl Sink for FullAtTheEnd {
    fn write(&mut self, _: &PoseFrame, _: &[Pose]) -> Result<(), TrackError> {
        Ok(())
    }

    fn add(&mut self, _: i64, _: &Note) -> Result<(), TrackError> {
        Ok(())
    }

    fn written(&self) -> u64 {
        if self.0 > 0 { 0 } else { 2 }
    }

    fn finish(&mut self, _: &Said) -> Result<(), TrackError> {
        if self.0 == 0 {
            return Ok(());
        }
        self.0 -= 1;
        Err(TrackError::Io {
            file: "session.mcap".into(),
            action: "write",
            source: std::io::Error::from(std::io::ErrorKind::StorageFull),
        })
    }
}

#[test]
fn a_disk_that_is_full_at_the_end_is_given_time() {
    let mut recording = TrackRecording::into_sink(Box::new(FullAtTheEnd(2)), 4);
    recording.push(&frame(0, None), Vec::new());
    let state = recording.finish(1, 1, Said::new());
    assert_eq!((state.steps, state.waiting, state.unwritten), (1, 0, 0));
    assert!(state.cause.is_none(), "{state:?}");
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
