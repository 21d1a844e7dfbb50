//! Pose tracks from outside: files written, damaged, killed, converted and replayed.

mod annex;
mod builtin;
mod compression;
mod damage;
mod foreign;
mod keyframes;
mod kill;
mod refuse;
mod round_trip;
mod schema;
mod source;

use std::path::Path;
use std::sync::Arc;

use glam::{Quat, Vec3};
use prost_reflect::{DescriptorPool, DynamicMessage, Value};
use vitriol_xr::track::{
    Existing, Track, TrackError, TrackMetadata, TrackWriter, Written, load, save,
};
use vitriol_xr::{Fov, FrameInfo, Hand, Pose, PoseFrame, SessionState, Side, Switch};

/// Frame `step` of a movement in which every field differs from every other and from its
/// default, at 90 Hz.
pub fn frame(step: u64) -> PoseFrame {
    let n = step as f32;
    let pose = |k: f32| {
        Pose::new(
            Vec3::new(0.01 * n + k, 1.0 + 0.1 * k, -0.4 - 0.001 * n),
            Quat::from_rotation_y(0.02 * n + k) * Quat::from_rotation_x(0.3 * k),
        )
    };
    let share = |k: f32| (0.5 + 0.4 * (0.1 * n + k).sin()).clamp(0.0, 1.0);
    let hand = |k: f32| Hand {
        active: step.is_multiple_of(2),
        valid: true,
        tracked: step.is_multiple_of(3),
        stage_from_grip: pose(k),
        stage_from_aim: pose(k + 0.1),
        squeeze: share(k),
        trigger: share(k + 1.0),
        thumbstick: [share(k + 2.0), -share(k + 3.0)],
        button_a: step.is_multiple_of(5),
        button_b: step.is_multiple_of(7),
        profile: Arc::from(format!("/interaction_profiles/test/{k}")),
    };
    PoseFrame {
        step,
        time_ns: time_ns(step),
        stage_from_view: pose(0.5),
        hands: [hand(0.1), hand(0.3)],
        scenario: if step % 10 == 3 {
            let switch = |k: &str| Switch {
                key: k.into(),
                value: step.to_string(),
            };
            vec![switch("scenario"), switch("light")]
        } else {
            Vec::new()
        },
        info: FrameInfo {
            xr_time: 7_000_000_000_123 + step as i64,
            period_ns: 11_111_111,
            fov: [0.1, 0.2].map(|k| Fov {
                left: -0.9 - k,
                right: 0.8 + k,
                up: 0.7 + k,
                down: -0.6 - k,
            }),
            session_state: if step.is_multiple_of(2) {
                SessionState::Focused
            } else {
                SessionState::Visible
            },
        },
    }
}

/// Time of frame `step`, ns.
pub fn time_ns(step: u64) -> i64 {
    (step as f64 / 90.0 * 1e9).round() as i64
}

/// Metadata with something in each field.
pub fn metadata() -> TrackMetadata {
    TrackMetadata {
        scene: "two-flasks".into(),
        seed: u64::MAX,
        parameters: [
            ("preset".to_owned(), "fast".to_owned()),
            // A parameter may be called as a fixed field of the record is.
            ("seed".to_owned(), "none".to_owned()),
        ]
        .into(),
        program_version: "0.1.0".into(),
        scenes: [("mine.toml".to_owned(), "name = \"mine\"\n".to_owned())].into(),
    }
}

/// A track of the first `frames` frames with two flasks, in memory.
pub fn track(frames: u64) -> Track {
    let frames: Vec<_> = (0..frames).map(frame).collect();
    let flask = |frame: &PoseFrame, k: f32| {
        let mut pose = frame.hand(Side::Right).stage_from_grip;
        pose.position.x += k;
        pose
    };
    Track {
        events: Vec::new(),
        progress: Vec::new(),
        metadata: metadata(),
        stage_from_flasks: frames
            .iter()
            .map(|f| vec![flask(f, 0.2), flask(f, 0.7)])
            .collect(),
        frames,
        recovered: false,
        outcome: [("state_hash".to_owned(), "0123456789abcdef".to_owned())].into(),
    }
}

/// Writes the track of that name to `file`.
pub fn convert(name: &str, file: &Path, existing: Existing) -> Result<Written, TrackError> {
    save(&load(name)?, file, existing)
}

/// Writes `track` to `file`.
pub fn write(file: &Path, track: &Track) {
    let mut writer = TrackWriter::create(file, &track.metadata, Existing::Refuse).unwrap();
    for (frame, flasks) in track.frames.iter().zip(&track.stage_from_flasks) {
        writer.write(frame, flasks).unwrap();
    }
    writer.conclude(&track.outcome).unwrap();
    let written = writer.finish().unwrap();
    assert_eq!(written.frames as usize, track.frames.len());
}

/// The bytes of a file that holds `track`.
pub fn bytes(track: &Track) -> Vec<u8> {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("track.mcap");
    write(&file, track);
    std::fs::read(&file).unwrap()
}

/// A metadata record: its name, and its keys with their values.
pub type Record<'a> = (&'a str, &'a [(&'a str, &'a str)]);

/// The one that each track has.
pub const OWN: Record<'static> = (
    "vitriol",
    &[("scene", "s"), ("seed", "1"), ("program_version", "v")],
);

/// The bytes of a file that the container's library alone writes: these records, and what `fill` adds.
pub fn foreign_bytes(
    options: mcap::WriteOptions,
    records: &[Record<'_>],
    fill: impl FnOnce(&mut mcap::Writer<std::io::Cursor<&mut Vec<u8>>>),
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = options.create(std::io::Cursor::new(&mut bytes)).unwrap();
    for (name, map) in records {
        let pairs = map.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned()));
        let metadata = mcap::records::Metadata {
            name: (*name).into(),
            metadata: pairs.collect(),
        };
        writer.write_metadata(&metadata).unwrap();
    }
    fill(&mut writer);
    writer.finish().unwrap();
    drop(writer);
    bytes
}

/// The same with the messages of a file of ours.
pub fn copied(options: mcap::WriteOptions, records: &[Record<'_>], ours: &[u8]) -> Vec<u8> {
    foreign_bytes(options, records, |writer| {
        for message in mcap::MessageStream::new(ours).unwrap() {
            writer.write(&message.unwrap()).unwrap();
        }
    })
}

/// A message, decoded with the schema in its file.
pub fn decoded(message: &mcap::Message<'_>) -> DynamicMessage {
    let schema = message.channel.schema.as_ref().unwrap();
    let pool = DescriptorPool::decode(&schema.data[..]).unwrap();
    let descriptor = pool.get_message_by_name(&schema.name).unwrap();
    let decoded = DynamicMessage::decode(descriptor, &message.data[..]).unwrap();
    assert_eq!(decoded.unknown_fields().count(), 0, "{decoded:?}");
    decoded
}

/// A field of it.
pub fn get(message: &DynamicMessage, name: &str) -> Value {
    message.get_field_by_name(name).unwrap().into_owned()
}

/// The same of a field that is a number.
pub fn number(message: &DynamicMessage, name: &str) -> f64 {
    get(message, name).as_f64().unwrap()
}

/// All numbers of a frame as bits, so that -0.0 differs from 0.0.
pub fn bits(frame: &PoseFrame) -> Vec<u32> {
    let pose = |p: &Pose| {
        let mut values = p.position.to_array().to_vec();
        values.extend(p.orientation.to_array());
        values
    };
    let mut values = pose(&frame.stage_from_view);
    for hand in &frame.hands {
        values.extend(pose(&hand.stage_from_grip));
        values.extend(pose(&hand.stage_from_aim));
        values.extend([hand.squeeze, hand.trigger]);
        values.extend(hand.thumbstick);
    }
    for fov in frame.info.fov {
        values.extend([fov.left, fov.right, fov.up, fov.down]);
    }
    values.into_iter().map(f32::to_bits).collect()
}
