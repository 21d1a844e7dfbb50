//! Malformed tracks: one message that names file, topic, step, field and what would be right.
//!
//! The writer refuses to write such tracks, so that they are made here with mcap alone, from
//! the messages of a good one.

use std::collections::BTreeMap;
use std::path::Path;

use glam::{Quat, Vec3};
use mcap::records::MessageHeader;
use prost::Message;
use vitriol_xr::track::{Existing, Track, TrackError, TrackWriter};
use vitriol_xr::{Pose, PoseFrame};

/// A message of a good track of 20 frames.
struct Raw {
    topic: String,
    schema: String,
    sequence: u32,
    log_time: u64,
    data: Vec<u8>,
}

fn good() -> Vec<Raw> {
    let bytes = super::bytes(&super::track(20));
    mcap::MessageStream::new(&bytes)
        .unwrap()
        .map(|message| {
            let message = message.unwrap();
            Raw {
                topic: message.channel.topic.clone(),
                schema: message.channel.schema.as_ref().unwrap().name.clone(),
                sequence: message.sequence,
                log_time: message.log_time,
                data: message.data.to_vec(),
            }
        })
        .collect()
}

fn read(messages: &[Raw], with_metadata: bool) -> Result<Track, String> {
    let own = [super::OWN];
    let records = if with_metadata { &own[..] } else { &[] };
    let bytes = super::foreign_bytes(mcap::WriteOptions::new(), records, |writer| {
        for raw in messages {
            let schema = writer.add_schema(&raw.schema, "protobuf", b"").unwrap();
            let channel_id = writer
                .add_channel(schema, &raw.topic, "protobuf", &BTreeMap::new())
                .unwrap();
            let header = MessageHeader {
                channel_id,
                sequence: raw.sequence,
                log_time: raw.log_time,
                publish_time: raw.log_time,
            };
            writer.write_to_known_channel(&header, &raw.data).unwrap();
        }
    });
    Track::parse(&bytes, Path::new("bad.mcap")).map_err(|error| error.to_string())
}

/// The error of reading once `change` was applied to each message of step 7.
fn refusal(mut change: impl FnMut(&mut Raw)) -> String {
    let mut messages = good();
    for raw in messages.iter_mut().filter(|raw| raw.sequence == 7) {
        change(raw);
    }
    read(&messages, true).unwrap_err()
}

fn assert_says(message: &str, parts: &[&str]) {
    for part in parts.iter().chain(&["bad.mcap"]) {
        assert!(message.contains(part), "no `{part}` in: {message}");
    }
}

// The parts of foxglove.FrameTransforms that are changed here, with its published field
// numbers, so that this does not rest on the code under test.
#[derive(Clone, PartialEq, Message)]
struct Transforms {
    #[prost(message, repeated, tag = "1")]
    transforms: Vec<Transform>,
}
#[derive(Clone, PartialEq, Message)]
struct Transform {
    #[prost(string, tag = "2")]
    parent: String,
    #[prost(string, tag = "3")]
    child: String,
    #[prost(message, optional, tag = "4")]
    translation: Option<Numbers>,
    #[prost(message, optional, tag = "5")]
    rotation: Option<Numbers>,
}
#[derive(Clone, PartialEq, Message)]
struct Numbers {
    #[prost(double, tag = "1")]
    x: f64,
    #[prost(double, tag = "2")]
    y: f64,
    #[prost(double, tag = "3")]
    z: f64,
    #[prost(double, tag = "4")]
    w: f64,
}

fn refusal_of_tf(mut change: impl FnMut(&mut Vec<Transform>)) -> String {
    refusal(|raw| {
        if raw.topic == "/tf" {
            let mut message = Transforms::decode(&raw.data[..]).unwrap();
            change(&mut message.transforms);
            raw.data = message.encode_to_vec();
        }
    })
}

fn child<'a>(transforms: &'a mut [Transform], name: &str) -> &'a mut Transform {
    transforms.iter_mut().find(|t| t.child == name).unwrap()
}

#[test]
fn the_good_messages_are_good() {
    let track = read(&good(), true).unwrap();
    assert_eq!(track.frames, super::track(20).frames);
}

#[test]
fn poses() {
    let place = ["/tf", "step 7", "0.0777"];
    let nan = refusal_of_tf(|t| child(t, "right_grip").translation.as_mut().unwrap().y = f64::NAN);
    assert_says(&nan, &place);
    assert_says(&nan, &["right_grip.translation", "NaN", "finite"]);

    let infinite = refusal_of_tf(|t| child(t, "view").rotation.as_mut().unwrap().w = f64::INFINITY);
    assert_says(&infinite, &place);
    assert_says(&infinite, &["view.rotation", "inf", "unit quaternion"]);

    let huge = refusal_of_tf(|t| child(t, "view").translation.as_mut().unwrap().x = 1e300);
    assert_says(&huge, &["view.translation", "finite in 32 bits"]);

    let long = refusal_of_tf(|t| {
        let rotation = child(t, "left_aim").rotation.as_mut().unwrap();
        *rotation = Numbers {
            x: 0.0,
            y: 0.0,
            z: 0.0,
            w: 1.01,
        };
    });
    assert_says(&long, &place);
    assert_says(&long, &["left_aim.rotation", "1.01", "length 1"]);

    let none = refusal_of_tf(|t| child(t, "flask_1").rotation = None);
    assert_says(&none, &["flask_1.rotation", "length 0"]);
}

#[test]
fn frames() {
    let gone = refusal_of_tf(|t| t.retain(|t| t.child != "left_grip"));
    assert_says(&gone, &["left_grip is missing", "step 7"]);
    let twice = refusal_of_tf(|t| t.push(t[0].clone()));
    assert_says(&twice, &["view is there twice"]);
    let hole = refusal_of_tf(|t| child(t, "flask_0").child = "flask_2".into());
    assert_says(&hole, &["flask_0 is missing", "without gap"]);
    let other = refusal_of_tf(|t| child(t, "view").parent = "world".into());
    assert_says(&other, &["view.parent_frame_id is `world`", "`stage`"]);
}

/// Time is linear in the number of a frame's transforms: each is looked up once, and no frame has more than 256.
#[test]
fn many_transforms() {
    let flask = |t: &[Transform], n: usize| {
        let mut flask = t.iter().find(|t| t.child == "flask_0").unwrap().clone();
        flask.child = format!("flask_{n}");
        flask
    };
    let mut messages = good();
    for raw in messages.iter_mut().filter(|raw| raw.topic == "/tf") {
        let mut message = Transforms::decode(&raw.data[..]).unwrap();
        for n in (2..64).rev() {
            message.transforms.push(flask(&message.transforms, n));
        }
        raw.data = message.encode_to_vec();
    }
    let track = read(&messages, true).unwrap();
    assert!(
        track
            .stage_from_flasks
            .iter()
            .all(|flasks| flasks.len() == 64)
    );
    let more = refusal_of_tf(|t| (2..65).for_each(|n| t.push(flask(t, n))));
    assert_says(&more, &["flask_ has 65", "at most 64"]);
    let others = refusal_of_tf(|t| {
        for n in 0..260 {
            t.push(Transform {
                child: format!("remark_{n}"),
                ..flask(t, 0)
            });
        }
    });
    assert_says(&others, &["transforms has 26", "at most 256"]);
    let long = refusal(|raw| {
        if raw.topic == "/xr/frame" {
            raw.data = vec![0; 70_000];
        }
    });
    assert_says(&long, &["length of message has 70000"]);
}

#[test]
fn order() {
    // Step 7 has the time of step 5.
    let back = refusal(|raw| raw.log_time = super::time_ns(5) as u64);
    assert_says(&back, &["step 7", "log_time", "goes backwards", "later"]);
    let same = refusal(|raw| raw.log_time = super::time_ns(6) as u64);
    assert_says(
        &same,
        &["step 7", "log_time", "in two frames, of steps 6 and 7"],
    );
    assert!(!same.contains("backwards"), "{same}");
    let beyond = refusal(|raw| raw.log_time = u64::MAX);
    assert_says(&beyond, &["log_time", "negative or beyond"]);
    let apart = refusal(|raw| raw.log_time += u64::from(raw.topic == "/xr/input/left"));
    assert_says(&apart, &["/xr/input/left", "one time"]);

    let mut messages = good();
    for raw in messages.iter_mut().filter(|raw| raw.sequence == 19) {
        raw.sequence = 18 - 10;
    }
    let step = read(&messages, true).unwrap_err();
    let parts = [
        "sequence",
        "from 18 to 8",
        "higher step",
        "sort the file by log time",
    ];
    assert_says(&step, &parts);
}

/// All times were shifted, as by a program that joins files. A track of which the beginning was cut off has later steps, and is read.
#[test]
fn a_whole_track_begins_at_zero() {
    let mut messages = good();
    for raw in &mut messages {
        raw.log_time += 5_000_000_000;
    }
    let late = read(&messages, true).unwrap_err();
    let parts = ["step 0 at 5 s", "log_time", "subtract 5000000000 ns"];
    assert_says(&late, &parts);
    messages.retain(|raw| raw.sequence > 0);
    assert_eq!(read(&messages, true).unwrap().missing_first(), 1);

    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("bad.mcap");
    let mut writer = TrackWriter::create(&file, &super::metadata(), Existing::Refuse).unwrap();
    let mut frame = super::frame(0);
    frame.time_ns = 1;
    let refused = writer.write(&frame, &[]).unwrap_err().to_string();
    assert_says(&refused, &["log_time", "subtract 1 ns"]);
}

#[test]
fn topics_and_schemas() {
    for topic in ["/tf", "/xr/frame", "/xr/input/left", "/xr/input/right"] {
        let mut messages = good();
        messages.retain(|raw| raw.topic != topic);
        assert_says(
            &read(&messages, true).unwrap_err(),
            &[&format!("no topic {topic}")],
        );

        let mut messages = good();
        messages.retain(|raw| raw.topic != topic || raw.sequence != 7);
        let message = read(&messages, true).unwrap_err();
        assert_says(&message, &[topic, "step 7", "missing in this step"]);

        let mut messages = good();
        for raw in messages.iter_mut().filter(|raw| raw.topic == topic) {
            raw.schema = "foxglove.PoseInFrame".into();
        }
        let message = read(&messages, true).unwrap_err();
        let encoded = "(schema in protobuf, messages in protobuf)";
        assert_says(
            &message,
            &[topic, "foxglove.PoseInFrame", "it must hold", encoded],
        );
    }
    // The container permits topics one after another.
    let mut by_topic = good();
    by_topic.sort_by_key(|raw| (raw.sequence > 0, raw.topic.clone()));
    let message = read(&by_topic, true).unwrap_err();
    assert_says(&message, &["missing in this step", "lies apart", "sort"]);
    let message = read(&good(), false).unwrap_err();
    assert_says(&message, &["metadata record `vitriol`"]);
    let message = read(&[], true).unwrap_err();
    assert_says(&message, &["no topic /tf"]);
}

#[test]
fn messages() {
    let garbage = refusal(|raw| {
        if raw.topic == "/xr/frame" {
            raw.data = vec![0xff; 5];
        }
    });
    assert_says(
        &garbage,
        &["/xr/frame", "step 7", "does not decode", "protobuf"],
    );
    let empty = refusal(|raw| {
        if raw.topic == "/xr/frame" {
            raw.data.clear();
        }
    });
    assert_says(&empty, &["fov has 0 views", "two"]);
}

#[test]
fn other_topics_are_let_be() {
    let mut messages = good();
    messages.push(Raw {
        topic: "/remark".into(),
        schema: "foxglove.Log".into(),
        sequence: 3,
        log_time: 1,
        data: vec![1, 2, 3],
    });
    assert_eq!(read(&messages, true).unwrap().frames.len(), 20);
}

/// The writer refuses what the reader would refuse, writes nothing of it, and goes on.
#[test]
fn the_writer_refuses_too() {
    type Break = fn(&mut PoseFrame);
    let breaks: [(Break, &str); 7] = [
        (
            |f| f.stage_from_view.position.x = f32::NAN,
            "view.translation",
        ),
        (
            |f| f.hands[0].stage_from_aim.orientation = Quat::from_xyzw(0.0, 0.0, 0.0, 0.9),
            "left_aim.rotation",
        ),
        (|f| f.hands[1].squeeze = 1.5, "squeeze is 1.5"),
        (
            |f| f.hands[1].thumbstick[1] = f32::NAN,
            "thumbstick_y is NaN",
        ),
        (|f| f.info.fov[1].up = f32::INFINITY, "fov[1].up"),
        (
            |f| f.time_ns = super::time_ns(0),
            "in two frames, of steps 0 and 1",
        ),
        (|f| f.step = 0, "sequence"),
    ];
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("bad.mcap");
    let mut writer = TrackWriter::create(&file, &super::metadata(), Existing::Refuse).unwrap();
    writer.write(&super::frame(0), &[]).unwrap();
    for (break_it, says) in breaks {
        let mut frame = super::frame(1);
        break_it(&mut frame);
        let message = writer.write(&frame, &[]).unwrap_err().to_string();
        assert_says(&message, &[says]);
    }
    let flask = Pose::new(Vec3::splat(f32::INFINITY), Quat::IDENTITY);
    let message = writer.write(&super::frame(1), &[flask]).unwrap_err();
    assert!(matches!(message, TrackError::Message { .. }));
    assert_says(&message.to_string(), &["flask_0.translation"]);
    writer.write(&super::frame(1), &[]).unwrap();
    writer.finish().unwrap();
    let track = Track::open(&file).unwrap();
    assert_eq!(track.frames, [super::frame(0), super::frame(1)]);
}
