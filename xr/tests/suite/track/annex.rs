//! What a file holds beside the track, decoded with the schemas in the file.

use prost_reflect::{DynamicMessage, Value};
use vitriol_xr::Pose;
use vitriol_xr::track::{Annex, Existing, TrackWriter};

use super::{get, number};

/// Times (ns) and messages of a topic.
fn messages(bytes: &[u8], topic: &str) -> Vec<(u64, DynamicMessage)> {
    mcap::MessageStream::new(bytes)
        .unwrap()
        .map(Result::unwrap)
        .filter(|message| message.channel.topic == topic)
        .map(|message| (message.log_time, super::decoded(&message)))
        .collect()
}

/// The bytes of a file of one frame with `annexes`, each with its time (ns).
fn bytes(annexes: &[(i64, Annex<'_>)]) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("track.mcap");
    let track = super::track(1);
    let mut writer = TrackWriter::create(&file, &track.metadata, Existing::Refuse).unwrap();
    writer.write(&track.frames[0], &[]).unwrap();
    for (time_ns, annex) in annexes {
        writer.add(*time_ns, annex).unwrap();
    }
    writer.finish().unwrap();
    std::fs::read(&file).unwrap()
}

/// Each number is a field of its own. Where there is none it is NaN, not the 0 that a decoder has for a field that is left out.
#[test]
fn measurements_are_fields() {
    let names = ["time_s", "mass_kg"].map(String::from);
    let measured = |values: &'static [f64]| Annex::Measurements {
        topic: "/measurements",
        names: &names,
        values,
    };
    let bytes = bytes(&[
        (0, measured(&[0.0, 0.25])),
        (500_000_000, measured(&[0.5, f64::NAN])),
    ]);
    let found = messages(&bytes, "/measurements");
    let times: Vec<u64> = found.iter().map(|(time, _)| *time).collect();
    assert_eq!(times, [0, 500_000_000]);
    assert_eq!(number(&found[0].1, "time_s"), 0.0);
    assert_eq!(number(&found[0].1, "mass_kg"), 0.25);
    assert_eq!(number(&found[1].1, "time_s"), 0.5);
    assert!(number(&found[1].1, "mass_kg").is_nan());
}

/// Behind a point's numbers come its four bytes of colour, under the names that viewers know.
#[test]
fn points_have_colours() {
    let rows = [1.0, 2.0, 3.0, 20.0, 4.0, 5.0, 6.0, 90.0];
    let bytes = bytes(&[(
        7,
        Annex::Points {
            fields: &["x", "y", "z", "temperature"],
            rows: &rows,
            colours: &[[1, 2, 3, 255], [4, 5, 6, 255]],
        },
    )]);
    let found = messages(&bytes, "/particles");
    let [(7, cloud)] = &found[..] else {
        panic!("{found:?}");
    };
    let fields = get(cloud, "fields");
    let fields: Vec<(String, u32, i32)> = fields
        .as_list()
        .unwrap()
        .iter()
        .map(|field| {
            let field = field.as_message().unwrap();
            (
                get(field, "name").as_str().unwrap().to_owned(),
                get(field, "offset").as_u32().unwrap(),
                get(field, "type").as_enum_number().unwrap(),
            )
        })
        .collect();
    // Foxglove's numbers of types: 7 is FLOAT32, 1 is UINT8.
    let expected = [
        ("x", 0, 7),
        ("y", 4, 7),
        ("z", 8, 7),
        ("temperature", 12, 7),
        ("red", 16, 1),
        ("green", 17, 1),
        ("blue", 18, 1),
        ("alpha", 19, 1),
    ];
    assert_eq!(
        fields,
        expected.map(|(name, offset, kind)| (name.to_owned(), offset, kind))
    );
    assert_eq!(get(cloud, "point_stride").as_u32(), Some(20));
    let data = get(cloud, "data");
    let data = data.as_bytes().unwrap();
    assert_eq!(data.len(), 40);
    assert_eq!(data[32..36], 90.0f32.to_le_bytes());
    assert_eq!(data[36..], [4, 5, 6, 255]);
}

/// A list without transforms makes Rerun lose the topic's others, so none is written.
#[test]
fn no_flasks_are_no_message() {
    let bytes = bytes(&[
        (0, Annex::Flasks(&[])),
        (7, Annex::Flasks(&[Pose::IDENTITY, Pose::IDENTITY])),
    ]);
    let found = messages(&bytes, "/flasks");
    let [(7, flasks)] = &found[..] else {
        panic!("{found:?}");
    };
    let transforms = get(flasks, "transforms");
    let children: Vec<Value> = transforms
        .as_list()
        .unwrap()
        .iter()
        .map(|transform| get(transform.as_message().unwrap(), "child_frame_id"))
        .collect();
    assert_eq!(
        children,
        ["flask_0", "flask_1"].map(|name| Value::String(name.into()))
    );
}
