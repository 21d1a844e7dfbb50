//! Keeps a session as a pose track, on a thread of its own: no frame waits for a disk.

use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use serde::Serialize;
use vitriol_xr::track::{Existing, TrackError, TrackMetadata, TrackWriter};
use vitriol_xr::{Pose, PoseFrame, Switch};

/// Steps that may wait for the disk: some five seconds, as long as one sleeps.
pub const QUEUE: usize = 512;

/// A step: what it consumed, and stage_from_flask of each flask after it (real m); none marks the end.
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

/// What became of a recording.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Recorded {
    /// Steps written.
    pub steps: u64,
    /// Steps that could not be written; a replay differs from the first of them on.
    pub unwritten: u64,
    /// Why, the first time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
}

impl Recorded {
    fn fail(&mut self, cause: String) {
        self.unwritten += 1;
        self.cause.get_or_insert(cause);
    }
}

/// A recording that goes on.
pub struct Recording {
    queue: Option<SyncSender<Entry>>,
    thread: Option<JoinHandle<()>>,
    done: Arc<Mutex<Recorded>>,
    /// Switches of steps that found the queue full: they go with the next that does not.
    switches: Vec<Switch>,
    /// The last step's, for the frame that marks the end.
    last: Option<PoseFrame>,
}

impl Recording {
    /// Begins a new file.
    ///
    /// # Errors
    /// [`TrackError`] where it exists already or cannot be made.
    pub fn create(file: &Path, metadata: &TrackMetadata) -> Result<Self, TrackError> {
        let writer = TrackWriter::create(file, metadata, Existing::Refuse)?;
        Ok(Self::into_sink(Box::new(writer), QUEUE))
    }

    /// Writes to `sink` what a queue of that length takes.
    pub fn into_sink(sink: Box<dyn Sink>, length: usize) -> Self {
        let (queue, entries) = sync_channel(length);
        let done = Arc::new(Mutex::new(Recorded::default()));
        let said = Arc::clone(&done);
        Self {
            queue: Some(queue),
            thread: Some(std::thread::spawn(move || write(sink, &entries, &said))),
            done,
            switches: Vec::new(),
            last: None,
        }
    }

    /// Takes a step, or counts it where the queue is full; does not wait.
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
    pub fn state(&self) -> Recorded {
        lock(&self.done).clone()
    }

    /// Marks the end, `step` at `time_ns` being the first that is not taken any more, and waits for
    /// the file. A track's length is the time of its last frame; this one makes a replay take the
    /// last step, too.
    pub fn finish(mut self, step: u64, time_ns: i64) -> Recorded {
        if let (Some(last), Some(queue)) = (self.last.take(), &self.queue) {
            let end = PoseFrame {
                step,
                time_ns,
                scenario: std::mem::take(&mut self.switches),
                ..last
            };
            // Now there is time to wait; a thread that has ended has said why.
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

impl Drop for Recording {
    fn drop(&mut self) {
        self.close();
    }
}

fn lock(done: &Mutex<Recorded>) -> std::sync::MutexGuard<'_, Recorded> {
    done.lock().unwrap_or_else(PoisonError::into_inner)
}

fn write(mut sink: Box<dyn Sink>, entries: &Receiver<Entry>, done: &Mutex<Recorded>) {
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

/// Keeps the first cause, and says it.
fn say(done: &Mutex<Recorded>, error: &TrackError) {
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
