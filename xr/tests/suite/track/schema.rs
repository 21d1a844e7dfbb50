//! The file describes itself: a viewer without this program's code decodes the written values with the schemas in the file.

use prost_reflect::{DescriptorPool, DynamicMessage, MessageDescriptor, ReflectMessage};
use vitriol_xr::{Pose, Side};

use super::{get, number};

struct Decoded {
    topic: String,
    sequence: u32,
    log_time: u64,
    message: DynamicMessage,
}

fn decoded() -> Vec<Decoded> {
    let bytes = super::bytes(&super::track(20));
    mcap::MessageStream::new(&bytes)
        .unwrap()
        .map(|message| {
            let message = message.unwrap();
            let schema = message.channel.schema.as_ref().unwrap();
            assert_eq!(schema.encoding, "protobuf");
            assert_eq!(message.channel.message_encoding, "protobuf");
            Decoded {
                topic: message.channel.topic.clone(),
                sequence: message.sequence,
                log_time: message.log_time,
                message: super::decoded(&message),
            }
        })
        .collect()
}

fn sub(message: &DynamicMessage, name: &str) -> DynamicMessage {
    let sub = get(message, name).as_message().unwrap().clone();
    assert_eq!(sub.unknown_fields().count(), 0);
    sub
}

/// Parent, child and pose of each transform of a `foxglove.FrameTransforms`.
fn transforms(message: &DynamicMessage, log_time: u64) -> Vec<(String, String, [f64; 7])> {
    let list = get(message, "transforms");
    let text = |m: &DynamicMessage, name: &str| get(m, name).as_str().unwrap().to_owned();
    list.as_list()
        .unwrap()
        .iter()
        .map(|transform| {
            let transform = transform.as_message().unwrap();
            let time = sub(transform, "timestamp");
            let seconds = get(&time, "seconds").as_i64().unwrap();
            let nanos = i64::from(get(&time, "nanos").as_i32().unwrap());
            assert_eq!((seconds * 1_000_000_000 + nanos) as u64, log_time);
            let (p, q) = (sub(transform, "translation"), sub(transform, "rotation"));
            let pose = ["x", "y", "z"].map(|name| number(&p, name));
            let turn = ["x", "y", "z", "w"].map(|name| number(&q, name));
            let mut all = [0.0; 7];
            all[..3].copy_from_slice(&pose);
            all[3..].copy_from_slice(&turn);
            let parent = text(transform, "parent_frame_id");
            (parent, text(transform, "child_frame_id"), all)
        })
        .collect()
}

fn flat(pose: &Pose) -> [f64; 7] {
    let (p, q) = (pose.position, pose.orientation);
    [p.x, p.y, p.z, q.x, q.y, q.z, q.w].map(f64::from)
}

#[test]
fn tf_is_what_viewers_expect() {
    let track = super::track(20);
    let all = decoded();
    let tf: Vec<_> = all.iter().filter(|d| d.topic == "/tf").collect();
    assert_eq!(tf.len(), 20);
    for (index, decoded) in tf.iter().enumerate() {
        let name = decoded.message.descriptor().full_name().to_owned();
        assert_eq!(name, "foxglove.FrameTransforms");
        let frame = &track.frames[index];
        assert_eq!(u64::from(decoded.sequence), frame.step);
        assert_eq!(decoded.log_time as i64, frame.time_ns);
        let (left, right) = (frame.hand(Side::Left), frame.hand(Side::Right));
        let flasks = &track.stage_from_flasks[index];
        let expected = [
            ("view", &frame.stage_from_view),
            ("left_grip", &left.stage_from_grip),
            ("left_aim", &left.stage_from_aim),
            ("right_grip", &right.stage_from_grip),
            ("right_aim", &right.stage_from_aim),
            ("flask_0", &flasks[0]),
            ("flask_1", &flasks[1]),
        ];
        let found = transforms(&decoded.message, decoded.log_time);
        let expected: Vec<_> = expected
            .map(|(child, pose)| ("stage".to_owned(), child.to_owned(), flat(pose)))
            .into();
        assert_eq!(found, expected);
    }
}

#[test]
fn the_static_root_turns_y_up_to_z_up() {
    let all = decoded();
    let root: Vec<_> = all.iter().filter(|d| d.topic == "/tf_static").collect();
    assert_eq!(root.len(), 1);
    let found = transforms(&root[0].message, root[0].log_time);
    let [(parent, child, pose)] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!((parent.as_str(), child.as_str()), ("world", "stage"));
    let turn = glam::DQuat::from_xyzw(pose[3], pose[4], pose[5], pose[6]);
    // f64 rounding.
    assert!((turn * glam::DVec3::Y - glam::DVec3::Z).length() < 1e-12);
    assert!((turn * glam::DVec3::X - glam::DVec3::X).length() < 1e-12);
}

/// The layout as published with foxglove's schemas, field by field.
#[test]
fn foxglove_layout() {
    let bytes = super::bytes(&super::track(1));
    let schemas: Vec<_> = mcap::MessageStream::new(&bytes)
        .unwrap()
        .map(|m| m.unwrap().channel.schema.clone().unwrap())
        .collect();
    let schema = schemas
        .iter()
        .find(|s| s.name == "foxglove.FrameTransforms");
    let pool = DescriptorPool::decode(&schema.unwrap().data[..]).unwrap();
    let layout = |name: &str| -> Vec<(String, u32, String)> {
        let message: MessageDescriptor = pool.get_message_by_name(name).unwrap();
        let field = |f: prost_reflect::FieldDescriptor| {
            (
                f.name().to_owned(),
                f.number(),
                format!("{:?} {:?}", f.cardinality(), f.kind()),
            )
        };
        message.fields().map(field).collect()
    };
    let expect = |name: &str, fields: &[(&str, u32, &str)]| {
        let found = layout(name);
        assert_eq!(found.len(), fields.len(), "{name}");
        for (field, number, kind) in fields {
            let is = found
                .iter()
                .any(|(f, n, k)| f == field && n == number && k.contains(kind));
            assert!(is, "{name}.{field}: {found:?}");
        }
    };
    expect(
        "foxglove.FrameTransforms",
        &[("transforms", 1, "Repeated foxglove.FrameTransform")],
    );
    expect(
        "foxglove.FrameTransform",
        &[
            ("timestamp", 1, "google.protobuf.Timestamp"),
            ("parent_frame_id", 2, "string"),
            ("child_frame_id", 3, "string"),
            ("translation", 4, "foxglove.Vector3"),
            ("rotation", 5, "foxglove.Quaternion"),
        ],
    );
    let double = |name, number| (name, number, "double");
    let xyz = [double("x", 1), double("y", 2), double("z", 3)];
    expect("foxglove.Vector3", &xyz);
    expect(
        "foxglove.Quaternion",
        &[xyz[0], xyz[1], xyz[2], double("w", 4)],
    );
    expect(
        "google.protobuf.Timestamp",
        &[("seconds", 1, "int64"), ("nanos", 2, "int32")],
    );
}

#[test]
fn inputs_frames_and_switches_by_name() {
    let track = super::track(20);
    let mut switches = 0;
    for decoded in decoded() {
        let frame = &track.frames[decoded.sequence as usize];
        let m = &decoded.message;
        let side = match decoded.topic.as_str() {
            "/xr/input/left" => Side::Left,
            "/xr/input/right" => Side::Right,
            "/xr/frame" => {
                assert_eq!(get(m, "xr_time").as_i64(), Some(frame.info.xr_time));
                assert_eq!(get(m, "period_ns").as_i64(), Some(frame.info.period_ns));
                let state = get(m, "session_state").as_enum_number();
                assert_eq!(state, Some(frame.info.session_state as i32));
                let views = get(m, "fov");
                let views = views.as_list().unwrap();
                for (view, fov) in views.iter().zip(frame.info.fov) {
                    let view = view.as_message().unwrap();
                    let angles = ["left", "right", "up", "down"]
                        .map(|name| get(view, name).as_f32().unwrap());
                    assert_eq!(angles, [fov.left, fov.right, fov.up, fov.down]);
                }
                assert_eq!(views.len(), 2);
                continue;
            }
            "/scenario" => {
                let switch = &frame.scenario[switches % 2];
                assert_eq!(get(m, "key").as_str(), Some(switch.key.as_str()));
                assert_eq!(get(m, "value").as_str(), Some(switch.value.as_str()));
                switches += 1;
                continue;
            }
            _ => continue,
        };
        let hand = frame.hand(side);
        let flag = |name| get(m, name).as_bool().unwrap();
        let value = |name| get(m, name).as_f32().unwrap();
        assert_eq!(flag("active"), hand.active);
        assert_eq!(flag("valid"), hand.valid);
        assert_eq!(flag("tracked"), hand.tracked);
        assert_eq!(flag("button_a"), hand.button_a);
        assert_eq!(flag("button_b"), hand.button_b);
        assert_eq!(value("squeeze"), hand.squeeze);
        assert_eq!(value("trigger"), hand.trigger);
        assert_eq!(value("thumbstick_x"), hand.thumbstick[0]);
        assert_eq!(value("thumbstick_y"), hand.thumbstick[1]);
        assert_eq!(get(m, "profile").as_str(), Some(&*hand.profile));
    }
    assert_eq!(switches, 4);
}
