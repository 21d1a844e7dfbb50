//! Reads a track.
//!
//! One pass over the records, with every checksum verified, rather than the summary first and the messages by index: the summary is
//! written last, so that a recording that crashed has none, and a pass that must work without it works with it too. The magic number at
//! the file's end distinguishes a crash from damage. Where it is, the file was finished, and any record that is short or fails its
//! checksum is damage. Where it is not, the recording was cut off, and all whole steps of whole chunks before the cut count; unless it
//! has an end further ahead, behind which there are other bytes.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::Arc;

use mcap::records::{Record, op};
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{MAGIC, McapError};

use super::check::{self, Flaw, at};
use super::decode::Partial;
use super::metadata::{carried, check_scenes, metadata, short};
use super::zstd::Zstd;
use super::{Track, TrackError, TrackMetadata, descriptor, lengths, limits, names, seconds};
use crate::files;

/// Encodings of a schema and of messages.
const PROTOBUF: [&str; 2] = ["protobuf"; 2];

/// Longest record and longest chunk accepted, B. Half a second of track is some 50 kB; a
/// length with a flipped bit must not become an allocation of exabytes.
const RECORD_LIMIT: usize = 64 << 20;

/// Characters of a compression's name that a message repeats. Our choice.
const NAME: usize = 40;

impl Track {
    /// Reads a whole track from an MCAP file and checks every frame of it.
    ///
    /// A file without an end, as a crash leaves it, is read up to the last whole step of its whole chunks and
    /// marked [`recovered`](Track::recovered).
    ///
    /// # Errors
    /// [`TrackError`], which names file, topic, step, time and field, and what would be right.
    pub fn open(file: &Path) -> Result<Self, TrackError> {
        Self::parse(&files::read(file, "track", limits::FILE)?, file)
    }

    /// Like [`open`](Self::open), of bytes in memory; `file` is the name for messages.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn parse(bytes: &[u8], file: &Path) -> Result<Self, TrackError> {
        if let Some(end) = lengths::end(bytes).filter(|end| *end < bytes.len()) {
            return Err(TrackError::Tail {
                file: file.into(),
                bytes: bytes.len() - end,
                end,
            });
        }
        let finished = bytes.len() > MAGIC.len() && bytes.ends_with(MAGIC);
        let mut reading = Reading::new(file);
        reading.records(bytes, finished)?;
        reading.finish(!finished)
    }
}

struct Reading<'a> {
    file: &'a Path,
    /// Bytes of records read so far.
    read: u64,
    /// Name and encoding of each schema, by number.
    schemas: HashMap<u16, (String, String)>,
    /// Topic of each channel, by number.
    channels: HashMap<u16, &'static str>,
    metadata: Option<TrackMetadata>,
    scenes: BTreeMap<String, String>,
    switches: usize,
    /// Profiles of the frame before.
    profiles: [Arc<str>; 2],
    partial: Option<(u64, i64, Partial)>,
    track: Track,
}

impl<'a> Reading<'a> {
    fn new(file: &'a Path) -> Self {
        Self {
            file,
            read: 0,
            schemas: HashMap::new(),
            channels: HashMap::new(),
            metadata: None,
            scenes: BTreeMap::new(),
            switches: 0,
            profiles: [Arc::from(""), Arc::from("")],
            partial: None,
            track: Track {
                metadata: TrackMetadata::default(),
                frames: Vec::new(),
                stage_from_flasks: Vec::new(),
                recovered: false,
                outcome: BTreeMap::new(),
                events: Vec::new(),
                progress: Vec::new(),
            },
        }
    }

    fn records(&mut self, bytes: &[u8], finished: bool) -> Result<(), TrackError> {
        let end = lengths::end_of_whole_chunks(bytes)
            .filter(|&end| end == bytes.len() || !finished)
            .ok_or_else(|| self.damaged("a record in it is longer than its chunk"))?;
        let bytes = &bytes[..end];
        let mut reader = LinearReader::new_with_options(
            LinearReaderOptions::default()
                .with_skip_end_magic(!finished)
                .with_check_finishes_after_end_magic(true)
                // A chunk is checked before any of its messages is used.
                .with_prevalidate_chunk_crcs(true)
                .with_validate_data_section_crc(true)
                .with_validate_summary_section_crc(true)
                .with_record_length_limit(RECORD_LIMIT),
        );
        reader
            .add_decompressor(Zstd::new(RECORD_LIMIT))
            .map_err(|error| self.damaged(error))?;
        let mut rest = bytes;
        // Behind the data come copies of schemas and channels and the index.
        let mut in_data = true;
        while let Some(event) = reader.next_event() {
            match event {
                Ok(LinearReadEvent::ReadRequest(wanted)) => {
                    let (now, later) = rest.split_at(wanted.min(rest.len()));
                    reader.insert(now.len()).copy_from_slice(now);
                    reader.notify_read(now.len());
                    rest = later;
                }
                Ok(LinearReadEvent::Record { data, opcode }) => {
                    // With the header, so that records without content count too.
                    self.read += data.len() as u64 + 9;
                    if self.read > limits::RECORDS {
                        let most = limits::RECORDS;
                        return Err(self.damaged(format!("it unpacks to more than {most} bytes")));
                    }
                    in_data &= opcode != op::DATA_END;
                    if in_data {
                        self.record(opcode, data)?;
                    }
                }
                Err(McapError::UnexpectedEof) if !finished => return Ok(()),
                Err(McapError::UnsupportedCompression(name)) => {
                    return Err(TrackError::Compression {
                        file: self.file.into(),
                        // The name may be as long as the file.
                        found: name.chars().take(NAME).collect(),
                    });
                }
                Err(error) => return Err(self.damaged(error)),
            }
        }
        Ok(())
    }

    fn record(&mut self, opcode: u8, data: &[u8]) -> Result<(), TrackError> {
        // Only the kinds of record that a track has are parsed: others are skipped, and mcap 0.26 panics on an attachment record that is
        // too short.
        if ![op::SCHEMA, op::CHANNEL, op::MESSAGE, op::METADATA].contains(&opcode) {
            return Ok(());
        }
        if !lengths::fit(opcode, data) {
            return Err(self.damaged("a text in it is longer than its record"));
        }
        match mcap::parse_record(opcode, data).map_err(|error| self.damaged(error))? {
            Record::Schema { header, .. } => {
                let known = (header.name, header.encoding);
                self.schemas.insert(header.id, known);
                Ok(())
            }
            Record::Channel(channel) => self.channel(&channel),
            Record::Metadata(record) if record.name == names::METADATA => {
                self.metadata = Some(metadata(record.metadata, self.file)?);
                Ok(())
            }
            Record::Metadata(record) if record.name == names::SCENE_RECORD => {
                self.scene(record.metadata)
            }
            Record::Metadata(record) if record.name == names::OUTCOME => {
                short(&record.metadata, self.file)?;
                self.track.outcome = record.metadata;
                Ok(())
            }
            Record::Message { header, data } => match self.channels.get(&header.channel_id) {
                None | Some(&names::TF_STATIC) => Ok(()),
                Some(&topic @ (names::EVENTS | names::LESSON)) => {
                    self.said(topic, header.log_time, &data)
                }
                Some(&topic) => self.message(topic, header.sequence, header.log_time, &data),
            },
            _ => Ok(()),
        }
    }

    fn channel(&mut self, channel: &mcap::records::Channel) -> Result<(), TrackError> {
        let ours = [
            (names::TF, descriptor::FRAME_TRANSFORMS, PROTOBUF),
            (names::TF_STATIC, descriptor::FRAME_TRANSFORMS, PROTOBUF),
            (names::FRAME, descriptor::FRAME, PROTOBUF),
            (names::INPUT[0], descriptor::INPUT, PROTOBUF),
            (names::INPUT[1], descriptor::INPUT, PROTOBUF),
            (names::SCENARIO, descriptor::SWITCH, PROTOBUF),
            (names::EVENTS, names::EVENT, names::JSON),
            (names::LESSON, names::PROGRESS, names::JSON),
        ];
        let found = ours.iter().find(|(topic, ..)| *topic == channel.topic);
        let Some(&(topic, expected, encodings)) = found else {
            // Other programs may add topics of their own to a track.
            return Ok(());
        };
        let schema = self.schemas.get(&channel.schema_id);
        let fits = schema.is_some_and(|(name, encoding)| {
            name == expected && [encoding, channel.message_encoding.as_str()] == encodings
        });
        if !fits {
            let told = |name: &str, [schema, messages]: [&str; 2]| {
                format!("{name} (schema in {schema}, messages in {messages})")
            };
            let found = schema.map_or("no schema".into(), |(name, encoding)| {
                told(name, [encoding, &channel.message_encoding])
            });
            return Err(TrackError::Schema {
                file: self.file.into(),
                topic: topic.into(),
                found,
                expected: told(expected, encodings),
            });
        }
        self.channels.insert(channel.id, topic);
        Ok(())
    }

    /// Takes in an event of the session, or a change in its lesson.
    fn said(&mut self, topic: &str, log_time: u64, data: &[u8]) -> Result<(), TrackError> {
        let all = match topic {
            names::LESSON => &self.track.progress,
            _ => &self.track.events,
        };
        if data.len() > limits::MESSAGE || all.len() >= limits::EVENTS {
            let (most, longest) = (limits::EVENTS, limits::MESSAGE);
            return Err(self.damaged(format!(
                "{topic} holds more than {most} messages, or one longer than {longest} bytes"
            )));
        }
        let json = std::str::from_utf8(data).map_err(|error| self.damaged(error))?;
        let said = (log_time as i64, json.to_owned());
        match topic {
            names::LESSON => self.track.progress.push(said),
            _ => self.track.events.push(said),
        }
        Ok(())
    }

    /// Takes in a scene's text that the track carries.
    fn scene(&mut self, map: BTreeMap<String, String>) -> Result<(), TrackError> {
        let (name, toml) = carried(map, self.file)?;
        self.scenes.insert(name, toml);
        check_scenes(self.scenes.len(), self.file)
    }

    fn message(
        &mut self,
        topic: &'static str,
        sequence: u32,
        log_time: u64,
        data: &[u8],
    ) -> Result<(), TrackError> {
        let step = u64::from(sequence);
        // Beyond i64 becomes negative, which the frame's check refuses.
        let time_ns = log_time as i64;
        if self.partial.as_ref().is_some_and(|(s, ..)| *s != step) {
            self.end_frame()?;
        }
        let (_, frame_time, partial) = self
            .partial
            .get_or_insert_with(|| (step, time_ns, Partial::default()));
        if *frame_time != time_ns {
            let flaw = Flaw::new(
                topic,
                "log_time",
                format!("is {time_ns} ns, other messages of its step have {frame_time} ns"),
                "all messages of a step have one time",
            );
            return Err(at(self.file, flaw, step, time_ns));
        }
        partial
            .add(topic, data)
            .map_err(|flaw| at(self.file, flaw, step, time_ns))
    }

    fn end_frame(&mut self) -> Result<(), TrackError> {
        let Some((step, time_ns, partial)) = self.partial.take() else {
            return Ok(());
        };
        if self.track.frames.is_empty() {
            self.topics()?;
        }
        let before = self.track.frames.last().map(|f| (f.step, f.time_ns));
        let (frame, flasks) = partial
            .finish(step, time_ns, &mut self.profiles)
            .and_then(|(frame, flasks)| {
                check::frame(&frame, &flasks, before)?;
                Ok((frame, flasks))
            })
            .map_err(|flaw| at(self.file, flaw, step, time_ns))?;
        self.switches += frame.scenario.len();
        check::totals(self.switches, self.track.frames.len() + 1)
            .map_err(|flaw| at(self.file, flaw, step, time_ns))?;
        self.track.frames.push(frame);
        self.track.stage_from_flasks.push(flasks);
        Ok(())
    }

    /// Checks that all topics are there, once the first frame is complete, since a topic comes before its first message.
    fn topics(&self) -> Result<(), TrackError> {
        for topic in [names::TF, names::FRAME, names::INPUT[0], names::INPUT[1]] {
            if !self.channels.values().any(|known| *known == topic) {
                return Err(self.missing(
                    format!("topic {topic}"),
                    "a pose track has /tf, /xr/frame, /xr/input/left and /xr/input/right from its first step on",
                ));
            }
        }
        Ok(())
    }

    fn finish(mut self, recovered: bool) -> Result<Track, TrackError> {
        // Chunks of other programs end within a step, so that a file that was cut off there lacks its last step's other messages. Only
        // switches, which come last, may be lost of a step that is kept.
        let is_whole = |(_, _, partial): &(u64, i64, Partial)| partial.is_complete();
        self.partial = self.partial.take().filter(|it| !recovered || is_whole(it));
        self.end_frame()?;
        if recovered && self.track.frames.is_empty() {
            return Err(self.damaged("it is empty or broke off"));
        }
        self.topics()?;
        let Some(mut metadata) = self.metadata.take() else {
            return Err(self.missing(
                format!("metadata record `{}`", names::METADATA),
                "a pose track names its scene, seed and program version in one",
            ));
        };
        if self.track.frames.is_empty() {
            return Err(self.missing("frame".into(), "a pose track has at least one"));
        }
        metadata.scenes = self.scenes;
        Ok(Track {
            metadata,
            recovered,
            ..self.track
        })
    }

    fn missing(&self, what: String, expected: &str) -> TrackError {
        TrackError::Missing {
            file: self.file.into(),
            what,
            expected: expected.into(),
        }
    }

    fn damaged(&self, error: impl std::fmt::Display) -> TrackError {
        TrackError::Container {
            file: self.file.into(),
            problem: error.to_string(),
            place: match self.track.frames.last() {
                Some(frame) => format!("after step {} at {} s", frame.step, seconds(frame.time_ns)),
                None => "before the first frame".into(),
            },
        }
    }
}
