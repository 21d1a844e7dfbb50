//! Writes a track.

use std::collections::BTreeMap;
use std::fs::OpenOptions;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Compression, McapError, WriteOptions, Writer};
use prost::Message;

use super::check::{self, at};
use super::metadata::{check_carried, scene_hash, short};
use super::stage::{Pending, StagedBytes};
use super::{TrackError, TrackMetadata, descriptor, encode, names};
use crate::{Pose, PoseFrame, Side};

/// Time between flushes: a crash loses the frames since the last one. Half a second keeps the loss below a second even where frames come
/// irregularly, and an lz4 chunk of 45 frames compresses nearly as well as one of 90.
const FLUSH_AFTER: Duration = Duration::from_millis(500);

/// Bytes of a message's record beside its data.
const MESSAGE_HEADER: u64 = 31;

/// What to do where the output file is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// Leave it and return [`TrackError::Exists`].
    Refuse,
    /// Replace it.
    Replace,
}

/// Summary of a finished track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// Frames written.
    pub frames: u64,
    /// Time of the last frame, ns.
    pub end_ns: i64,
}

/// Writes a track frame by frame, so that the file can be read up to the last flush whatever
/// happens to the program.
///
/// It writes under the track's final name from the start and not under a temporary one: the remains of a crash must be found. A disk that
/// is full for a moment loses nothing: unwritten chunks wait in memory, the file ends with a whole chunk, and the next flush goes on
/// there. Dropping it without [`finish`](Self::finish) ends the file properly too, but does not return errors.
pub struct TrackWriter {
    file: PathBuf,
    // NoSeek: a chunk reaches the stage whole, with its header, and not as a header of zeros
    // to be filled in later, which a crash would leave behind. `None` once it is finished.
    mcap: Option<Writer<NoSeek<StagedBytes>>>,
    pending: Pending,
    channels: Channels,
    /// Channels of annexes, by topic.
    pub(super) annexes: BTreeMap<String, u16>,
    /// Bytes of annexes since the last flush.
    pub(super) annexed: usize,
    /// Bytes of annexes in all.
    pub(super) annexed_in_all: u64,
    buffer: Vec<u8>,
    /// Frames and switches taken.
    frames: u64,
    switches: usize,
    /// Bytes of the messages of frames and switches, unpacked.
    pub(super) bytes: u64,
    last: Option<(u64, i64)>,
    concluded: bool,
    /// Whether [`finish`](TrackWriter::finish) was called: from then on it is not ended by being dropped.
    ending: bool,
    flushed_ns: i64,
    flushed_at: Instant,
}

struct Channels {
    tf: u16,
    tf_static: u16,
    frame: u16,
    input: [u16; 2],
    scenario: u16,
}

impl TrackWriter {
    /// Creates `file` and writes the records before the first frame.
    ///
    /// # Errors
    /// [`TrackError::Metadata`] where a reader would refuse `metadata`; [`TrackError::Exists`] where `file` exists and `existing` is
    /// [`Existing::Refuse`]; [`TrackError::Io`] where it cannot be created or written.
    pub fn create(
        file: &Path,
        metadata: &TrackMetadata,
        existing: Existing,
    ) -> Result<Self, TrackError> {
        short(&record(metadata).metadata, file)?;
        check_carried(&metadata.scenes, file)?;
        let mut options = OpenOptions::new();
        options.write(true);
        match existing {
            Existing::Refuse => options.create_new(true),
            Existing::Replace => options.create(true).truncate(true),
        };
        let handle = options.open(file).map_err(|source| {
            if source.kind() == ErrorKind::AlreadyExists {
                TrackError::Exists { file: file.into() }
            } else {
                TrackError::Io {
                    file: file.into(),
                    action: "create",
                    source,
                }
            }
        })?;
        let (pending, stage) = Pending::new(handle);
        let (mcap, channels) = begin(stage, metadata).map_err(|error| failed(file, error))?;
        Ok(Self {
            file: file.into(),
            mcap: Some(mcap),
            pending,
            channels,
            annexes: BTreeMap::new(),
            annexed: 0,
            annexed_in_all: 0,
            buffer: Vec::new(),
            frames: 0,
            switches: 0,
            bytes: 0,
            last: None,
            concluded: false,
            ending: false,
            flushed_ns: 0,
            flushed_at: Instant::now(),
        })
    }

    /// Appends the frame that one simulation step consumed, with the `stage_from_flask` of
    /// each flask after that step (empty where there are none to record). Flushes where half
    /// a second, of the track or of the clock, has passed since the last flush.
    ///
    /// # Errors
    /// [`TrackError::Message`] where a reader would refuse the frame: a pose that is not
    /// valid, a value out of its range, a step or a time not above the last frame's. Nothing
    /// is written then, and the next frame may follow. [`TrackError::Full`] where so much waits
    /// for the disk that this frame is not taken. [`TrackError::Io`] where the file cannot be
    /// written now: the frame is taken, and waits.
    pub fn write(
        &mut self,
        frame: &PoseFrame,
        stage_from_flasks: &[Pose],
    ) -> Result<(), TrackError> {
        check::frame(frame, stage_from_flasks, self.last)
            .map_err(|flaw| at(&self.file, flaw, frame.step, frame.time_ns))?;
        let switches = self.switches + frame.scenario.len();
        check::totals(switches, self.frames as usize + 1)
            .and_then(|()| check::unpacked(self.bytes))
            .map_err(|flaw| at(&self.file, flaw, frame.step, frame.time_ns))?;
        self.make_room()?;
        self.put_frame(frame, stage_from_flasks)
            .map_err(|error| failed(&self.file, error))?;
        if self.frames == 0 {
            self.flushed_ns = frame.time_ns;
        }
        self.frames += 1;
        self.switches = switches;
        self.last = Some((frame.step, frame.time_ns));
        let passed = Duration::from_nanos(frame.time_ns.abs_diff(self.flushed_ns));
        if passed >= FLUSH_AFTER || self.flushed_at.elapsed() >= FLUSH_AFTER {
            self.flush()?;
        }
        Ok(())
    }

    /// Tries to write waiting chunks, where there are many.
    pub(super) fn make_room(&mut self) -> Result<(), TrackError> {
        if self.pending.is_full() && self.flush().is_err() {
            return Err(TrackError::Full {
                file: self.file.clone(),
            });
        }
        Ok(())
    }

    /// The file's writer, until its end.
    pub(super) fn mcap(&mut self) -> Result<&mut Writer<NoSeek<StagedBytes>>, McapError> {
        self.mcap.as_mut().ok_or_else(finished)
    }

    /// Bytes that the file holds.
    pub(super) fn file_bytes(&self) -> u64 {
        self.pending.bytes()
    }

    /// Step of the last frame.
    pub(super) fn last_step(&self) -> u32 {
        self.last.map_or(0, |(step, _)| step as u32)
    }

    pub(super) fn failed(&self, error: McapError) -> TrackError {
        failed(&self.file, error)
    }

    /// Hands all frames to the operating system, so that they outlive the program.
    ///
    /// # Errors
    /// [`TrackError::Io`] where the file cannot be written now: all of them wait.
    pub fn flush(&mut self) -> Result<(), TrackError> {
        // Also after a failure: the next try comes half a second later.
        self.flushed_ns = self.last.map_or(0, |(_, time_ns)| time_ns);
        self.flushed_at = Instant::now();
        self.annexed = 0;
        if let Some(mcap) = &mut self.mcap {
            mcap.flush().map_err(|error| failed(&self.file, error))?;
        }
        self.write_out()
    }

    /// Frames that the file holds: those that the operating system has taken.
    pub fn written(&self) -> u64 {
        self.pending.frames()
    }

    /// Writes the outcome, once (see [`Track::outcome`](super::Track::outcome)).
    ///
    /// # Errors
    /// [`TrackError::Metadata`] where a reader would refuse it; [`TrackError::Io`] after [`finish`](Self::finish).
    pub fn conclude(&mut self, outcome: &BTreeMap<String, String>) -> Result<(), TrackError> {
        short(outcome, &self.file)?;
        let said = Metadata {
            name: names::OUTCOME.into(),
            metadata: outcome.clone(),
        };
        if std::mem::replace(&mut self.concluded, true) {
            return Ok(());
        }
        let concluded = match &mut self.mcap {
            Some(mcap) if !outcome.is_empty() => mcap.write_metadata(&said),
            Some(_) => Ok(()),
            None => Err(finished()),
        };
        concluded.map_err(|error| failed(&self.file, error))
    }

    /// Writes the index and the end of the file, and waits until the disk has them.
    ///
    /// # Errors
    /// [`TrackError::Io`] where the file cannot be written: it holds [`written`](Self::written) frames and no end.
    /// It may be asked for again, and nothing else is written then.
    pub fn finish(&mut self) -> Result<Written, TrackError> {
        self.ending = true;
        self.flush()?;
        if let Some(mut mcap) = self.mcap.take() {
            let ended = mcap.finish();
            ended.map_err(|error| failed(&self.file, error))?;
        }
        self.write_out()?;
        let synced = self.pending.sync();
        synced.map_err(|source| self.refused(source))?;
        Ok(Written {
            frames: self.frames,
            end_ns: self.last.map_or(0, |(_, time_ns)| time_ns),
        })
    }

    fn write_out(&mut self) -> Result<(), TrackError> {
        let written = self.pending.write_out(self.frames);
        written.map_err(|source| self.refused(source))
    }

    fn refused(&self, source: std::io::Error) -> TrackError {
        TrackError::Io {
            file: self.file.clone(),
            action: "write",
            source,
        }
    }

    fn put_frame(&mut self, frame: &PoseFrame, flasks: &[Pose]) -> Result<(), McapError> {
        if self.frames == 0 {
            let root = encode::world_from_stage(frame.time_ns);
            self.put(self.channels.tf_static, frame, &root)?;
        }
        self.put(self.channels.frame, frame, &encode::frame(frame))?;
        self.put(self.channels.tf, frame, &encode::transforms(frame, flasks))?;
        for side in Side::BOTH {
            let input = encode::input(frame.hand(side));
            self.put(self.channels.input[side as usize], frame, &input)?;
        }
        for switch in &frame.scenario {
            self.put(self.channels.scenario, frame, &encode::switch(switch))?;
        }
        Ok(())
    }

    fn put(
        &mut self,
        channel_id: u16,
        frame: &PoseFrame,
        message: &impl Message,
    ) -> Result<(), McapError> {
        self.buffer.clear();
        // A Vec always has room, so that the only error of encode cannot occur.
        let _ = message.encode(&mut self.buffer);
        self.bytes += self.buffer.len() as u64 + MESSAGE_HEADER;
        let header = MessageHeader {
            channel_id,
            // Both were checked to fit.
            sequence: frame.step as u32,
            log_time: frame.time_ns as u64,
            publish_time: frame.time_ns as u64,
        };
        match &mut self.mcap {
            Some(mcap) => mcap.write_to_known_channel(&header, &self.buffer),
            None => Err(finished()),
        }
    }
}

impl Drop for TrackWriter {
    fn drop(&mut self) {
        if self.ending {
            return;
        }
        if let Some(mut mcap) = self.mcap.take() {
            // The error is dropped, since there is no caller.
            let _ = mcap.finish();
            let _ = self.pending.write_out(self.frames);
        }
    }
}

type Begun = (Writer<NoSeek<StagedBytes>>, Channels);

fn begin(stage: StagedBytes, metadata: &TrackMetadata) -> Result<Begun, McapError> {
    let mut mcap = WriteOptions::new()
        .compression(Some(Compression::Lz4))
        // Only a flush ends a chunk, so that no frame is split between two.
        .chunk_size(None)
        .disable_seeking(true)
        .library(concat!("vitriol ", env!("CARGO_PKG_VERSION")))
        .create(NoSeek::new(stage))?;
    mcap.write_metadata(&record(metadata))?;
    for (name, text) in &metadata.scenes {
        mcap.write_metadata(&scene_record(name, text))?;
    }

    let transforms = mcap.add_schema(
        descriptor::FRAME_TRANSFORMS,
        "protobuf",
        &descriptor::frame_transforms(),
    )?;
    let xr = descriptor::xr();
    let input = mcap.add_schema(descriptor::INPUT, "protobuf", &xr)?;
    let frame = mcap.add_schema(descriptor::FRAME, "protobuf", &xr)?;
    let switch = mcap.add_schema(descriptor::SWITCH, "protobuf", &xr)?;
    let mut channel = |schema, topic| mcap.add_channel(schema, topic, "protobuf", &BTreeMap::new());
    let channels = Channels {
        tf: channel(transforms, names::TF)?,
        tf_static: channel(transforms, names::TF_STATIC)?,
        frame: channel(frame, names::FRAME)?,
        input: [
            channel(input, names::INPUT[0])?,
            channel(input, names::INPUT[1])?,
        ],
        scenario: channel(switch, names::SCENARIO)?,
    };
    Ok((mcap, channels))
}

fn record(metadata: &TrackMetadata) -> Metadata {
    let mut map: BTreeMap<String, String> = metadata
        .parameters
        .iter()
        .map(|(name, value)| (format!("{}{name}", names::PARAMETER), value.clone()))
        .collect();
    map.insert(names::SCENE.into(), metadata.scene.clone());
    map.insert(names::SEED.into(), metadata.seed.to_string());
    map.insert(
        names::PROGRAM_VERSION.into(),
        metadata.program_version.clone(),
    );
    Metadata {
        name: names::METADATA.into(),
        metadata: map,
    }
}

fn scene_record(name: &str, text: &str) -> Metadata {
    let map = [
        (names::NAME, name.to_owned()),
        (names::TOML, text.to_owned()),
        (names::HASH, scene_hash(text)),
    ];
    Metadata {
        name: names::SCENE_RECORD.into(),
        metadata: map.map(|(key, value)| (key.to_owned(), value)).into(),
    }
}

fn finished() -> McapError {
    std::io::Error::other("the track is finished").into()
}

fn failed(file: &Path, error: McapError) -> TrackError {
    TrackError::Io {
        file: file.into(),
        action: "write",
        source: match error {
            McapError::Io(source) => source,
            other => std::io::Error::other(other),
        },
    }
}
