//! Writes a session's steps to a pose track, on a thread of its own so that no frame waits for a disk.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::track::BROKEN_OFF;
use crate::units::count;
use serde::Serialize;
use vitriol_lesson::Event;
use vitriol_lesson::procedure::Progress;
use vitriol_xr::track::{Annex, Existing, TrackError, TrackMetadata, TrackWriter};
use vitriol_xr::{Pose, PoseFrame, Switch};

/// Steps that may wait for the disk: those of some five seconds, which is how long a disk that sleeps takes to wake.
pub const QUEUE: usize = 512;

/// Times that the end is tried where the disk refuses it, and the time between two of them: ten seconds in all.
const TRIES_AT_END: u32 = 20;
const BETWEEN_TRIES: Duration = Duration::from_millis(500);

const BROKE_DOWN: &str = "the recorder broke down; report it";

/// An entry that waits to be written.
enum Entry {
    /// A step: what it consumed, and stage_from_flask of each flask after it (real m). `None` for the frame that marks the
    /// end, which is no step.
    Step(Box<PoseFrame>, Option<Vec<Pose>>),
    /// An event or the lesson's progress, and the track's time, ns.
    Note(i64, Note),
}

/// An entry beside the steps: an object as JSON.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Note {
    /// An event.
    Event(String),
    /// Progress of the lesson.
    Progress(String),
}

/// Where steps are written to.
pub trait Sink: Send {
    /// Takes a step.
    ///
    /// # Errors
    /// As for [`TrackWriter::write`]: after [`TrackError::Io`] it waits for the disk, else it was not taken.
    fn write(&mut self, frame: &PoseFrame, flasks: &[Pose]) -> Result<(), TrackError>;

    /// Takes a note at that time of the track, ns.
    ///
    /// # Errors
    /// As for [`Sink::write`].
    fn add(&mut self, time_ns: i64, note: &Note) -> Result<(), TrackError>;

    /// Frames that are in the file.
    fn written(&self) -> u64;

    /// Ends the file, and writes `outcome` to it.
    ///
    /// # Errors
    /// As for [`TrackWriter::finish`].
    fn finish(&mut self, outcome: &Said) -> Result<(), TrackError>;
}

/// Values that a recording holds on its end, by name.
pub type Said = BTreeMap<String, String>;

impl Sink for TrackWriter {
    fn write(&mut self, frame: &PoseFrame, flasks: &[Pose]) -> Result<(), TrackError> {
        Self::write(self, frame, flasks)
    }

    fn add(&mut self, time_ns: i64, note: &Note) -> Result<(), TrackError> {
        static EVENT: LazyLock<String> = LazyLock::new(Event::schema);
        static PROGRESS: LazyLock<String> = LazyLock::new(Progress::schema);
        let annex = match note {
            Note::Event(json) => Annex::Event {
                json,
                schema: &EVENT,
            },
            Note::Progress(json) => Annex::Progress {
                json,
                schema: &PROGRESS,
            },
        };
        Self::add(self, time_ns, &annex)
    }

    fn written(&self) -> u64 {
        Self::written(self)
    }

    fn finish(&mut self, outcome: &Said) -> Result<(), TrackError> {
        self.conclude(outcome)?;
        Self::finish(self).map(drop)
    }
}

/// How a recording stands, or ended.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct RecordingStatus {
    /// Steps that are in the file.
    pub steps: u64,
    /// Steps that wait for the disk.
    pub waiting: u64,
    /// Steps that are lost. A replay differs from the session from the first of them on.
    pub unwritten: u64,
    /// Why the first of these is lost, or why some wait for long.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cause: Option<String>,
    /// Whether the disk refuses what waits.
    #[serde(skip)]
    pub refused: bool,
}

impl RecordingStatus {
    fn lose(&mut self, cause: String) {
        if self.unwritten == 0 {
            self.cause = Some(cause);
        }
        self.unwritten += 1;
    }
}

/// A recording to a track that goes on.
pub struct TrackRecording {
    queue: Option<SyncSender<Entry>>,
    thread: Option<JoinHandle<()>>,
    done: Arc<Mutex<RecordingStatus>>,
    outcome: Arc<Mutex<Said>>,
    /// Switches of steps for which the queue was full. They go with the next step that is queued.
    switches: Vec<Switch>,
    /// Likewise the notes from meanwhile.
    notes: Vec<(i64, Note)>,
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
        let outcome = Arc::new(Mutex::new(Said::default()));
        let (said, of_end) = (Arc::clone(&done), Arc::clone(&outcome));
        Self {
            queue: Some(queue),
            thread: Some(std::thread::spawn(move || {
                Recorder::new(sink, &said).run(&entries, &of_end);
            })),
            done,
            outcome,
            switches: Vec::new(),
            notes: Vec::new(),
            last: None,
        }
    }

    /// Queues a step, or counts it as unwritten where the queue is full; does not wait.
    pub fn push(&mut self, frame: &PoseFrame, flasks: Vec<Pose>) {
        let mut frame = frame.clone();
        drop(frame.scenario.splice(..0, self.switches.drain(..)));
        self.last = Some(frame.clone());
        let Some(queue) = &self.queue else {
            return;
        };
        let (entry, cause) = match queue.try_send(Entry::Step(Box::new(frame), Some(flasks))) {
            Ok(()) => return self.queue_notes(),
            Err(TrySendError::Full(entry)) => (entry, "the disk did not keep up"),
            Err(TrySendError::Disconnected(entry)) => (entry, BROKE_DOWN),
        };
        if let Entry::Step(frame, _) = entry {
            self.switches = frame.scenario;
        }
        lock(&self.done).lose(cause.into());
    }

    /// Queues a note at that time of the track, ns; where the queue is full, it goes with the next step that
    /// is queued. Does not wait.
    pub fn found(&mut self, time_ns: i64, note: Note) {
        self.notes.push((time_ns, note));
        self.queue_notes();
    }

    fn queue_notes(&mut self) {
        let Some(queue) = &self.queue else {
            return;
        };
        let mut notes = std::mem::take(&mut self.notes).into_iter();
        for (time_ns, note) in notes.by_ref() {
            let sent = queue.try_send(Entry::Note(time_ns, note));
            if let Err(TrySendError::Full(Entry::Note(time_ns, note))) = sent {
                self.notes.push((time_ns, note));
                break;
            }
        }
        self.notes.extend(notes);
    }

    /// How it stands.
    pub fn state(&self) -> RecordingStatus {
        lock(&self.done).clone()
    }

    /// Marks the end, of which the file is to hold `outcome`, and waits for the file. `step` and `time_ns` are those
    /// that the next step would have had: a track's length is the time of its last frame, so without this one a
    /// replay would leave out the last step.
    pub fn finish(mut self, step: u64, time_ns: i64, outcome: Said) -> RecordingStatus {
        *self.outcome.lock().unwrap_or_else(PoisonError::into_inner) = outcome;
        if let (Some(last), Some(queue)) = (self.last.take(), &self.queue) {
            let end = PoseFrame {
                step,
                time_ns,
                scenario: std::mem::take(&mut self.switches),
                ..last
            };
            // No frame is open any more, so it may wait. A thread that has ended has reported why.
            let _ = queue.send(Entry::Step(Box::new(end), None));
            for (time_ns, note) in std::mem::take(&mut self.notes) {
                let _ = queue.send(Entry::Note(time_ns, note));
            }
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
            done.cause.get_or_insert(BROKE_DOWN.into());
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

/// The thread's part.
struct Recorder<'a> {
    sink: Box<dyn Sink>,
    done: &'a Mutex<RecordingStatus>,
    /// Steps that the sink took.
    taken: u64,
    /// Switches of steps that it did not take, for the next one that it does.
    switches: Vec<Switch>,
    /// Whether it did not take the frame that marks the end.
    without_end: bool,
    /// Frames that are to be in the file before the disk counts as well again; `None` while it is.
    recovers_at: Option<u64>,
}

impl<'a> Recorder<'a> {
    fn new(sink: Box<dyn Sink>, done: &'a Mutex<RecordingStatus>) -> Self {
        Self {
            sink,
            done,
            taken: 0,
            switches: Vec::new(),
            without_end: false,
            recovers_at: None,
        }
    }

    fn run(mut self, entries: &Receiver<Entry>, outcome: &Mutex<Said>) {
        for entry in entries {
            match entry {
                Entry::Step(frame, flasks) => self.take(*frame, flasks),
                Entry::Note(time_ns, note) => self.add(time_ns, &note),
            }
            self.count();
        }
        let mut outcome = outcome
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        let lost = lock(self.done).unwritten;
        if lost > 0 || self.without_end {
            // The state at its end is not the one that a replay of it comes to.
            outcome = [(
                BROKEN_OFF.to_owned(),
                match lost {
                    1 => "a step is not recorded".to_owned(),
                    _ => format!("{} are not recorded", count(lost, "step")),
                },
            )]
            .into();
        }
        let finished = self.finish(&outcome);
        self.count();
        let mut done = lock(self.done);
        done.unwritten += std::mem::take(&mut done.waiting);
        done.refused = false;
        match finished {
            Ok(()) if done.unwritten == 0 => done.cause = None,
            Ok(()) => {}
            Err(error) => {
                tracing::warn!("the recording is not whole: {}", chain(&error));
                done.cause.get_or_insert_with(|| chain(&error));
            }
        }
    }

    fn take(&mut self, mut frame: PoseFrame, flasks: Option<Vec<Pose>>) {
        let is_step = flasks.is_some();
        drop(frame.scenario.splice(..0, self.switches.drain(..)));
        match self.sink.write(&frame, &flasks.unwrap_or_default()) {
            Ok(()) => {
                self.taken += u64::from(is_step);
                self.recover();
            }
            Err(error @ TrackError::Io { .. }) => {
                self.taken += u64::from(is_step);
                self.wait(&error);
            }
            Err(error) => {
                self.switches = frame.scenario;
                self.without_end |= !is_step;
                let mut done = lock(self.done);
                if done.unwritten == 0 {
                    tracing::warn!("steps are not recorded from here on: {}", chain(&error));
                }
                if is_step {
                    done.lose(chain(&error));
                }
            }
        }
    }

    fn add(&mut self, time_ns: i64, note: &Note) {
        match self.sink.add(time_ns, note) {
            Ok(()) => {}
            Err(error @ TrackError::Io { .. }) => self.wait(&error),
            // A replay finds it again.
            Err(error) => tracing::warn!("not recorded: {note:?}: {}", chain(&error)),
        }
    }

    /// Ends the file; where the disk refuses that, some seconds are given to make room.
    fn finish(&mut self, outcome: &Said) -> Result<(), TrackError> {
        for _ in 0..TRIES_AT_END {
            match self.sink.finish(outcome) {
                Err(error @ TrackError::Io { .. }) => {
                    self.wait(&error);
                    std::thread::sleep(BETWEEN_TRIES);
                }
                ended => return ended,
            }
        }
        self.sink.finish(outcome)
    }

    /// The frame that marks the end is no step.
    fn count(&mut self) {
        let mut done = lock(self.done);
        done.steps = self.sink.written().min(self.taken);
        done.waiting = self.taken - done.steps;
    }

    fn wait(&mut self, error: &TrackError) {
        if self.recovers_at.is_none() {
            tracing::warn!("the recording waits for the disk: {}", chain(error));
        }
        self.recovers_at = Some(self.taken);
        let mut done = lock(self.done);
        done.refused = true;
        if done.unwritten == 0 {
            done.cause = Some(chain(error));
        }
    }

    fn recover(&mut self) {
        if self
            .recovers_at
            .is_some_and(|frames| self.sink.written() >= frames)
        {
            self.recovers_at = None;
            tracing::warn!("the disk takes the recording again");
            let mut done = lock(self.done);
            done.refused = false;
            if done.unwritten == 0 {
                done.cause = None;
            }
        }
    }
}

/// An error with its cause.
fn chain(error: &TrackError) -> String {
    match std::error::Error::source(error) {
        Some(source) => format!("{error}: {source}"),
        None => error.to_string(),
    }
}
