//! Writes a session's steps to a pose track, on a thread of its own so that no frame waits for a disk.

use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use serde::Serialize;
use vitriol_xr::track::{Existing, TrackError, TrackMetadata, TrackWriter};
use vitriol_xr::{Pose, PoseFrame, Switch};

/// Steps that may wait for the disk: those of some five seconds, which is how long a disk that sleeps takes to wake.
pub const QUEUE: usize = 512;

/// A step: what it consumed, and stage_from_flask of each flask after it (real m). `None` for the frame that marks the
/// end, which is no step.
type Entry = (PoseFrame, Option<Vec<Pose>>);

/// Where steps are written to.
pub trait Sink: Send {
    /// Writes a step.
    ///
    /// # Errors
    /// As for [`TrackWriter::write`].
    fn write(&mut self, frame: &PoseFrame, flasks: &[Pose]) -> Result<(), TrackError>;

    /// Ends the file.
    ///
    /// # Errors
    /// As for [`TrackWriter::finish`].
    fn finish(self: Box<Self>) -> Result<(), TrackError>;
}

impl Sink for TrackWriter {
    fn write(&mut self, frame: &PoseFrame, flasks: &[Pose]) -> Result<(), TrackError> {
        Self::write(self, frame, flasks)
    }

    fn finish(self: Box<Self>) -> Result<(), TrackError> {
        (*self).finish().map(|_| ())
    }
}

/// How a recording stands, or ended.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct RecordingStatus {
    /// Steps written.
    pub steps: u64,
    /// Steps that could not be written. A replay differs from the session from the first of them on.
    pub unwritten: u64,
    /// Why the first of them could not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
}

impl RecordingStatus {
    fn fail(&mut self, cause: String) {
        self.unwritten += 1;
        self.cause.get_or_insert(cause);
    }
}

/// A recording to a track that goes on.
pub struct TrackRecording {
    queue: Option<SyncSender<Entry>>,
    thread: Option<JoinHandle<()>>,
    done: Arc<Mutex<RecordingStatus>>,
    /// Switches of steps for which the queue was full. They go with the next step that is queued.
    switches: Vec<Switch>,
    /// The last step, for the frame that marks the end.
    last: Option<PoseFrame>,
}

impl TrackRecording {
    /// Begins a new file.
    ///
    /// # Errors
    /// [`TrackError`] where it exists already or cannot be made.
    pub fn create(file: &Path, metadata: &TrackMetadata) -> Result<Self, TrackError> {
        let writer = TrackWriter::create(file, metadata, Existing::Refuse)?;
        Ok(Self::into_sink(Box::new(writer), QUEUE))
    }

    /// Writes to `sink`, through a queue of that many steps.
    pub fn into_sink(sink: Box<dyn Sink>, length: usize) -> Self {
        let (queue, entries) = sync_channel(length);
        let done = Arc::new(Mutex::new(RecordingStatus::default()));
        let said = Arc::clone(&done);
        Self {
            queue: Some(queue),
            thread: Some(std::thread::spawn(move || write(sink, &entries, &said))),
            done,
            switches: Vec::new(),
            last: None,
        }
    }

    /// Queues a step, or counts it as unwritten where the queue is full; does not wait.
    pub fn push(&mut self, frame: &PoseFrame, flasks: Vec<Pose>) {
        let mut frame = frame.clone();
        let mut switches = std::mem::take(&mut self.switches);
        switches.append(&mut frame.scenario);
        frame.scenario = switches;
        self.last = Some(frame.clone());
        let Some(queue) = &self.queue else {
            return;
        };
        if let Err(TrySendError::Full((frame, _)) | TrySendError::Disconnected((frame, _))) =
            queue.try_send((frame, Some(flasks)))
        {
            self.switches = frame.scenario;
            lock(&self.done).fail("the disk did not keep up".into());
        }
    }

    /// How it stands.
    pub fn state(&self) -> RecordingStatus {
        lock(&self.done).clone()
    }

    /// Marks the end and waits for the file. `step` and `time_ns` are those that the next step would have had: a
    /// track's length is the time of its last frame, so without this one a replay would leave out the last step.
    pub fn finish(mut self, step: u64, time_ns: i64) -> RecordingStatus {
        if let (Some(last), Some(queue)) = (self.last.take(), &self.queue) {
            let end = PoseFrame {
                step,
                time_ns,
                scenario: std::mem::take(&mut self.switches),
                ..last
            };
            // No frame is open any more, so it may wait. A thread that has ended has said why.
            let _ = queue.send((end, None));
        }
        self.close();
        lock(&self.done).clone()
    }

    fn close(&mut self) {
        self.queue = None;
        if let Some(thread) = self.thread.take()
            && thread.join().is_err()
        {
            let mut done = lock(&self.done);
            done.cause
                .get_or_insert("the recorder broke down; report it".into());
        }
    }
}

impl Drop for TrackRecording {
    fn drop(&mut self) {
        self.close();
    }
}

fn lock(done: &Mutex<RecordingStatus>) -> std::sync::MutexGuard<'_, RecordingStatus> {
    done.lock().unwrap_or_else(PoisonError::into_inner)
}

fn write(mut sink: Box<dyn Sink>, entries: &Receiver<Entry>, done: &Mutex<RecordingStatus>) {
    for (frame, flasks) in entries {
        let is_step = flasks.is_some();
        match sink.write(&frame, &flasks.unwrap_or_default()) {
            Ok(()) => lock(done).steps += u64::from(is_step),
            Err(error) => {
                say(done, &error);
                lock(done).unwritten += u64::from(is_step);
            }
        }
    }
    if let Err(error) = sink.finish() {
        say(done, &error);
    }
}

/// Keeps the first cause, and logs it.
fn say(done: &Mutex<RecordingStatus>, error: &TrackError) {
    let cause = match std::error::Error::source(error) {
        Some(source) => format!("{error}: {source}"),
        None => error.to_string(),
    };
    let mut done = lock(done);
    if done.cause.is_none() {
        tracing::warn!("the recording is not whole: {cause}");
    }
    done.cause.get_or_insert(cause);
}
