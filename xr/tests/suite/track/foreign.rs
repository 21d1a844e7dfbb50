//! Tracks from other people: what they may hold, and how much.

use std::collections::BTreeMap;
use std::path::Path;

use vitriol_tests::wait::own_time;
use vitriol_xr::track::{Existing, Track, TrackMetadata, TrackWriter, limits, save};
use vitriol_xr::{Pose, Switch};

use super::{OWN, Record};

/// The result of reading a file with `metadata` records before the frames of a good track.
fn with_records(records: &[Record<'_>]) -> Result<Track, String> {
    let good = super::bytes(&super::track(3));
    let all = [&[OWN][..], records].concat();
    let bytes = super::copied(mcap::WriteOptions::new(), &all, &good);
    Track::parse(&bytes, Path::new("bad.mcap")).map_err(|error| error.to_string())
}

#[test]
fn a_carried_scene_is_the_recorded_one() {
    let text = "name = \"mine\"\n";
    let hash = format!("{:032x}", xxhash_rust::xxh3::xxh3_128(text.as_bytes()));
    let scene = |hash| {
        (
            "vitriol.scene",
            [("name", "mine.toml"), ("toml", text), ("xxh3_128", hash)],
        )
    };
    let read = |record: (&'static str, [(&str, &str); 3])| with_records(&[(record.0, &record.1)]);
    let track = read(scene(&hash)).unwrap();
    assert_eq!(track.metadata.scenes["mine.toml"], text);
    let other = read(scene("0123")).unwrap_err();
    assert!(other.contains("not that of its text"), "{other}");
    let less = with_records(&[("vitriol.scene", &[("name", "x"), ("toml", text)])]).unwrap_err();
    assert!(less.contains("xxh3_128 is missing"), "{less}");

    let long = "#".repeat(limits::SCENE + 1);
    let long = with_records(&[(
        "vitriol.scene",
        &[("name", "x"), ("toml", &long), ("xxh3_128", "0")],
    )]);
    assert!(long.unwrap_err().contains("at most"));
    let names: Vec<_> = (0..=limits::SCENES).map(|n| n.to_string()).collect();
    let scenes: Vec<_> = names
        .iter()
        .map(|name| [("name", name.as_str()), ("toml", text), ("xxh3_128", &hash)])
        .collect();
    let many: Vec<(&str, &[(&str, &str)])> = scenes
        .iter()
        .map(|map| ("vitriol.scene", &map[..]))
        .collect();
    let many = with_records(&many).unwrap_err();
    assert!(many.contains("more than 64"), "{many}");
}

#[test]
fn texts_and_parameters_have_an_end() {
    let long = "x".repeat(5000);
    let outcome = with_records(&[("vitriol.outcome", &[("state_hash", &long)])]).unwrap_err();
    assert!(outcome.contains("longest text is 5000"), "{outcome}");
    let names: Vec<_> = (0..300).map(|n| n.to_string()).collect();
    let many: Vec<_> = names.iter().map(|name| (name.as_str(), "")).collect();
    let many = with_records(&[("vitriol.outcome", &many)]).unwrap_err();
    assert!(many.contains("number of entries is 300"), "{many}");
}

/// The writer keeps the reader's limits, so that every recording can be read.
#[test]
fn what_is_recorded_is_within_the_limits() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("x.mcap");
    let mut writer = TrackWriter::create(&file, &super::metadata(), Existing::Refuse).unwrap();
    let flasks = |count| vec![Pose::IDENTITY; count];
    writer
        .write(&super::frame(0), &flasks(limits::FLASKS))
        .unwrap();
    let mut refused = |step: u64, says: &str, change: &dyn Fn(&mut vitriol_xr::PoseFrame)| {
        let mut frame = super::frame(step);
        change(&mut frame);
        let count = if says.contains("flask") {
            limits::FLASKS + 1
        } else {
            0
        };
        let message = writer
            .write(&frame, &flasks(count))
            .unwrap_err()
            .to_string();
        assert!(message.contains(says), "{says}: {message}");
    };
    let switch = || Switch {
        key: "k".into(),
        value: "v".into(),
    };
    refused(1, "flask_ has 65", &|_| {});
    refused(1, "switches has 10001", &|frame| {
        frame.scenario = vec![switch(); limits::SWITCHES + 1];
    });
    refused(1, "length of value has 5000", &|frame| {
        frame.scenario = vec![Switch {
            value: "v".repeat(5000),
            ..switch()
        }];
    });
    refused(1, "length of profile has 5000", &|frame| {
        frame.hands[0].profile = "p".repeat(5000).into();
    });
    refused(1, "ends after 10800 s", &|frame| {
        frame.time_ns = (limits::SECONDS + 1) * 1_000_000_000
    });
    writer.write(&super::frame(1), &[]).unwrap();
    writer.finish().unwrap();
    let track = Track::open(&file).unwrap();
    assert_eq!(track.stage_from_flasks[0].len(), limits::FLASKS);
}

/// The writer keeps the limits of metadata, to the last entry.
#[test]
fn what_is_said_is_within_the_limits() {
    let dir = tempfile::tempdir().unwrap();
    let entries = |count: usize| -> BTreeMap<String, String> {
        (0..count).map(|n| (n.to_string(), String::new())).collect()
    };
    // Scene, seed and version are entries too.
    for (parameters, said, fits) in [(253, 256, true), (254, 1, false), (1, 257, false)] {
        let file = dir.path().join(format!("{parameters}-{said}.mcap"));
        let track = Track {
            events: Vec::new(),
            progress: Vec::new(),
            metadata: TrackMetadata {
                parameters: entries(parameters),
                ..super::metadata()
            },
            outcome: entries(said),
            ..super::track(3)
        };
        let saved = save(&track, &file, Existing::Refuse);
        assert_eq!(saved.is_ok(), fits, "{parameters} {said}: {saved:?}");
        assert_eq!(file.exists(), fits);
        if fits {
            assert_eq!(Track::open(&file).unwrap(), track);
        }
    }
}

/// A file that unpacks to more than any track is not unpacked to its end.
#[test]
fn a_file_that_unpacks_without_end_is_left() {
    let options = mcap::WriteOptions::new().compression(Some(mcap::Compression::Lz4));
    let bytes = super::foreign_bytes(options, &[], |writer| {
        let schema = writer.add_schema("foxglove.Log", "protobuf", b"").unwrap();
        let channel_id = writer
            .add_channel(schema, "/remark", "protobuf", &BTreeMap::new())
            .unwrap();
        let zeros = vec![0; 32 << 20];
        for sequence in 0..140 {
            let header = mcap::records::MessageHeader {
                channel_id,
                sequence,
                log_time: 0,
                publish_time: 0,
            };
            writer.write_to_known_channel(&header, &zeros).unwrap();
        }
    });
    assert!(bytes.len() < 32 << 20);
    let message = Track::parse(&bytes, Path::new("bomb.mcap")).unwrap_err();
    assert!(message.to_string().contains("unpacks to more"), "{message}");
}

/// Switches of a step are counted as they come, and not when the step ends.
#[test]
fn a_step_has_few_switches() {
    let good = super::bytes(&super::track(4));
    let bytes = super::foreign_bytes(mcap::WriteOptions::new(), &[], |writer| {
        let mut scenario = None;
        for message in mcap::MessageStream::new(&good).unwrap() {
            let message = message.unwrap();
            writer.write(&message).unwrap();
            if message.channel.topic == "/scenario" {
                scenario = Some(message);
            }
        }
        let scenario = scenario.unwrap();
        for _ in 0..limits::SWITCHES {
            writer.write(&scenario).unwrap();
        }
    });
    let message = Track::parse(&bytes, Path::new("bad.mcap")).unwrap_err();
    assert!(
        message.to_string().contains("switches has 10001"),
        "{message}"
    );
}

/// The time to read is proportional to the file: four times the frames, by the processor's time of this thread, take four times as long. A
/// search of all before each would take sixteen.
#[test]
fn reading_takes_time_in_proportion() {
    let of = |frames: u64| {
        let mut track = super::track(frames);
        for flasks in &mut track.stage_from_flasks {
            *flasks = vec![Pose::IDENTITY; limits::FLASKS];
        }
        let bytes = super::bytes(&track);
        let (read, took) = own_time(|| Track::parse(&bytes, Path::new("x.mcap")).unwrap());
        assert_eq!(read.frames.len() as u64, frames);
        took.as_secs_f64()
    };
    let (one, four) = (of(1_000), of(4_000));
    assert!(four < 9.0 * one, "{one} {four}");
}

#[test]
fn a_file_that_is_too_long_is_not_read() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("long.mcap");
    std::fs::File::create(&file)
        .unwrap()
        .set_len(limits::FILE + 1)
        .unwrap();
    let message = Track::open(&file).unwrap_err().to_string();
    assert!(message.contains("longer than"), "{message}");
}

/// What a recorder leaves that stopped before its first chunk was whole.
#[test]
fn a_file_that_breaks_off_at_its_beginning_is_told_so() {
    let whole = super::bytes(&super::track(10));
    for length in [0, 5, 8, 120] {
        let cut = Track::parse(&whole[..length], Path::new("bad.mcap")).unwrap_err();
        assert!(cut.to_string().contains("broke off"), "{length}: {cut}");
    }
}

#[test]
fn missing_steps_are_found() {
    let mut track = super::track(10);
    assert_eq!(track.holes().count(), 0);
    for at in [7, 4, 3] {
        track.frames.remove(at);
        track.stage_from_flasks.remove(at);
    }
    let read = Track::parse(&super::bytes(&track), Path::new("x.mcap")).unwrap();
    let holes: Vec<_> = read.holes().map(|hole| (hole.index, hole.steps)).collect();
    assert_eq!(holes, [(2, 2), (4, 1)]);
    let whole = read.up_to_the_first_hole();
    assert_eq!(whole.frames, super::track(3).frames);
    assert_eq!(whole.stage_from_flasks.len(), 3);
    assert!(whole.outcome.is_empty());
}

/// The container's library subtracts a record from the rest of its chunk without a check: found by fuzzing, and so are the bytes.
#[test]
fn a_record_longer_than_its_chunk_is_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus/track");
    let bytes = std::fs::read(folder.join("chunk-shorter-than-its-record")).unwrap();
    // As a recorder that stopped hard left it, it has no frame in a whole chunk; as a file with an end it is damaged.
    let cut = Track::parse(&bytes, Path::new("bad.mcap")).unwrap_err();
    assert!(cut.to_string().contains("broke off"), "{cut}");
    let ended = [&bytes[..], mcap::MAGIC].concat();
    let damaged = Track::parse(&ended, Path::new("bad.mcap")).unwrap_err();
    assert!(
        damaged.to_string().contains("longer than its chunk"),
        "{damaged}"
    );
    // A record of that length in a chunk that is whole.
    let mut chunk = [&[0; 28][..], &0_u32.to_le_bytes(), &12_u64.to_le_bytes()].concat();
    chunk.extend([&[5][..], &1000_u64.to_le_bytes(), &[0; 3]].concat());
    let mut whole = mcap::MAGIC.to_vec();
    whole.extend(
        [
            &[6][..],
            &(chunk.len() as u64).to_le_bytes(),
            &chunk,
            mcap::MAGIC,
        ]
        .concat(),
    );
    let damaged = Track::parse(&whole, Path::new("bad.mcap")).unwrap_err();
    assert!(
        damaged.to_string().contains("longer than its chunk"),
        "{damaged}"
    );
}
