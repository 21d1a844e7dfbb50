//! Data that a track's file may hold beside the track, for viewers: points, a film, measurements. A reader of tracks skips them, except
//! events and progress.

use std::collections::BTreeMap;

use mcap::McapError;
use mcap::records::MessageHeader;
use prost::Message;

use super::message::{
    CompressedVideo, FieldType, FrameTransforms, PackedElementField, PointCloud, Quaternion,
    Vector3,
};
use super::{TrackError, TrackWriter, descriptor, encode, limits, names};
use crate::Pose;

/// Bytes after which a chunk ends.
const LONGEST_CHUNK: usize = 8 << 20;

/// Data of one moment.
#[derive(Clone, Copy, Debug)]
pub enum Annex<'a> {
    /// Points in the stage, m, on `/particles`: rows of as many numbers as there are names, of which the first three are
    /// x, y and z. Viewers know a point's colour by the fields red, green, blue and alpha, which follow.
    Points {
        /// Names of the columns.
        fields: &'a [&'a str],
        /// The rows, one after the other.
        rows: &'a [f32],
        /// Each row's colour: red, green, blue and alpha, sRGB-encoded.
        colours: &'a [[u8; 4]],
    },
    /// `stage_from_flask` of each flask, on `/flasks`. A track's own `/tf` has the time at which a step began; these may have
    /// the time of the state that they belong to.
    Flasks(&'a [Pose]),
    /// A frame of H.264 (Annex B), on `/film`.
    Film(&'a [u8]),
    /// Numbers of one state, as a message with a field for each.
    Measurements {
        /// Their topic. All messages of a topic have the same names.
        topic: &'a str,
        /// Their names: letters of ASCII, digits and `_`, each once.
        names: &'a [String],
        /// As many values; NaN where there is none.
        values: &'a [f64],
    },
    /// An event of the session, on `/events`: see [`Track::events`](super::Track::events).
    Event {
        /// An object, as JSON.
        json: &'a str,
        /// Its JSON schema.
        schema: &'a str,
    },
    /// A change in the session's lesson, on `/lesson`: see [`Track::progress`](super::Track::progress).
    Progress {
        /// An object, as JSON.
        json: &'a str,
        /// Its JSON schema.
        schema: &'a str,
    },
}

/// A topic's name, schema and encoding.
struct Topic<'a> {
    name: &'a str,
    schema: &'static str,
    encodings: [&'static str; 2],
    schema_bytes: std::borrow::Cow<'a, [u8]>,
}

impl Annex<'_> {
    fn topic(&self) -> Topic<'_> {
        match self {
            Self::Points { .. } => Topic {
                name: names::PARTICLES,
                schema: descriptor::POINT_CLOUD,
                encodings: ["protobuf"; 2],
                schema_bytes: descriptor::point_cloud().into(),
            },
            Self::Film(_) => Topic {
                name: names::FILM,
                schema: descriptor::COMPRESSED_VIDEO,
                encodings: ["protobuf"; 2],
                schema_bytes: descriptor::compressed_video().into(),
            },
            Self::Flasks(_) => Topic {
                name: names::FLASKS,
                schema: descriptor::FRAME_TRANSFORMS,
                encodings: ["protobuf"; 2],
                schema_bytes: descriptor::frame_transforms().into(),
            },
            Self::Measurements { topic, names, .. } => Topic {
                name: topic,
                schema: descriptor::MEASUREMENTS,
                encodings: ["protobuf"; 2],
                schema_bytes: descriptor::measurements(names).into(),
            },
            Self::Event { schema, .. } => Topic {
                name: names::EVENTS,
                schema: names::EVENT,
                encodings: names::JSON,
                schema_bytes: schema.as_bytes().into(),
            },
            Self::Progress { schema, .. } => Topic {
                name: names::LESSON,
                schema: names::PROGRESS,
                encodings: names::JSON,
                schema_bytes: schema.as_bytes().into(),
            },
        }
    }

    fn encoded(&self, time_ns: i64) -> Vec<u8> {
        match self {
            Self::Points {
                fields,
                rows,
                colours,
            } => points(time_ns, fields, rows, colours).encode_to_vec(),
            Self::Flasks(stage_from_flasks) => FrameTransforms {
                transforms: encode::flasks(time_ns, stage_from_flasks),
            }
            .encode_to_vec(),
            Self::Measurements { values, .. } => numbers(values),
            Self::Film(bytes) => CompressedVideo {
                timestamp: Some(encode::timestamp(time_ns)),
                frame_id: names::CAMERA.into(),
                data: bytes.to_vec(),
                format: "h264".into(),
            }
            .encode_to_vec(),
            Self::Event { json, .. } | Self::Progress { json, .. } => json.as_bytes().to_vec(),
        }
    }
}

/// A message of doubles, whose fields are numbered from 1.
fn numbers(values: &[f64]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (number, value) in (1..).zip(values) {
        prost::encoding::double::encode(number, value, &mut bytes);
    }
    bytes
}

fn points(time_ns: i64, fields: &[&str], rows: &[f32], colours: &[[u8; 4]]) -> PointCloud {
    let field = |name: &str, offset: u32, kind: FieldType| PackedElementField {
        name: name.into(),
        offset,
        kind: kind as i32,
    };
    let floats = (0..).zip(fields);
    let floats = floats.map(|(number, name)| field(name, 4 * number, FieldType::Float32));
    let row_bytes = 4 * fields.len() as u32;
    let components = (row_bytes..).zip(["red", "green", "blue", "alpha"]);
    let components = components.map(|(offset, name)| field(name, offset, FieldType::Uint8));
    let mut data = Vec::with_capacity(4 * (rows.len() + colours.len()));
    for (row, colour) in rows.chunks(fields.len().max(1)).zip(colours) {
        data.extend(row.iter().flat_map(|value| value.to_le_bytes()));
        data.extend(colour);
    }
    PointCloud {
        timestamp: Some(encode::timestamp(time_ns)),
        frame_id: names::STAGE.into(),
        pose: Some(super::message::PoseMessage {
            position: Some(Vector3 {
                x: Some(0.0),
                y: Some(0.0),
                z: Some(0.0),
            }),
            orientation: Some(Quaternion {
                x: Some(0.0),
                y: Some(0.0),
                z: Some(0.0),
                w: Some(1.0),
            }),
        }),
        point_stride: row_bytes + 4,
        fields: floats.chain(components).collect(),
        data,
    }
}

impl TrackWriter {
    /// Adds `annex` at a time of the track. It does not count towards the limits of a reader: a file that holds much of it may be too long
    /// for one.
    ///
    /// # Errors
    /// [`TrackError::Full`] where too much waits for the disk, so that it is not taken; [`TrackError::Io`] after the end.
    pub fn add(&mut self, time_ns: i64, annex: &Annex<'_>) -> Result<(), TrackError> {
        // Rerun 0.41 loses the other messages of a topic in which one has no transforms.
        if matches!(annex, Annex::Flasks([])) {
            return Ok(());
        }
        self.make_room()?;
        let added = self.put_annex(time_ns, annex);
        let bytes = added.map_err(|error| self.failed(error))?;
        self.annexed += bytes;
        self.annexed_in_all += bytes as u64;
        // Readers accept chunks up to a length.
        if self.annexed > LONGEST_CHUNK {
            self.flush()?;
        }
        Ok(())
    }

    /// Whether the file is short enough for a reader of tracks.
    pub fn fits_a_reader(&self) -> bool {
        let unpacked = self.bytes + self.annexed_in_all;
        self.file_bytes() <= limits::FILE && unpacked <= limits::RECORDS / 2
    }

    fn put_annex(&mut self, time_ns: i64, annex: &Annex<'_>) -> Result<usize, McapError> {
        let topic = annex.topic();
        let sequence = self.last_step();
        let known = self.annexes.get(topic.name).copied();
        let mcap = self.mcap()?;
        let channel_id = match known {
            Some(channel) => channel,
            None => {
                let [of_schema, of_messages] = topic.encodings;
                let schema = mcap.add_schema(topic.schema, of_schema, &topic.schema_bytes)?;
                mcap.add_channel(schema, topic.name, of_messages, &BTreeMap::new())?
            }
        };
        let header = MessageHeader {
            channel_id,
            sequence,
            log_time: time_ns as u64,
            publish_time: time_ns as u64,
        };
        let message = annex.encoded(time_ns);
        mcap.write_to_known_channel(&header, &message)?;
        self.annexes.insert(topic.name.to_owned(), channel_id);
        Ok(message.len())
    }
}
