//! The compressions that the container permits, as other programs write them, and those that nobody reads.

use std::path::Path;

use mcap::{Compression, WriteOptions};
use vitriol_xr::track::{Track, TrackError};

/// The frames of `SHORT`, written again by Python's writer (mcap 1.6.0, zstandard 0.25.0) with its default compression, zstd, in chunks of
/// 2,000 bytes and without schemas' contents, index and statistics.
const BY_PYTHON: &[u8] = include_bytes!("zstd.mcap");

/// A track of ten frames in lz4.
const SHORT: &str = "../fuzz/corpus/track/short.mcap";

fn parse(bytes: &[u8]) -> Result<Track, TrackError> {
    Track::parse(bytes, Path::new("other.mcap"))
}

fn short() -> Track {
    Track::open(&Path::new(env!("CARGO_MANIFEST_DIR")).join(SHORT)).unwrap()
}

/// A file of one chunk in zstd, which claims to unpack to `size` bytes.
fn chunk(size: u64, frame: &[u8]) -> Vec<u8> {
    let content = [
        // Times of its messages; then a checksum that fits nothing.
        &[0; 16][..],
        &size.to_le_bytes(),
        &1_u32.to_le_bytes(),
        &4_u32.to_le_bytes(),
        b"zstd",
        &(frame.len() as u64).to_le_bytes(),
        frame,
    ]
    .concat();
    let length = (content.len() as u64).to_le_bytes();
    let kind = [mcap::records::op::CHUNK];
    [mcap::MAGIC, &kind, &length, &content, mcap::MAGIC].concat()
}

#[test]
fn zstd_by_another_writer_is_the_same_track() {
    let (read, whole) = (parse(BY_PYTHON).unwrap(), short());
    assert_eq!(read.frames, whole.frames);
    assert_eq!(read.stage_from_flasks, whole.stage_from_flasks);
    assert_eq!(read.metadata, whole.metadata);
    assert!(!read.recovered);
}

#[test]
fn lz4_and_none_are_the_same_track() {
    let whole = super::track(20);
    let bytes = super::bytes(&whole);
    let plain = || WriteOptions::new().compression(None);
    for options in [
        WriteOptions::new().compression(Some(Compression::Lz4)),
        plain(),
        plain().use_chunks(false),
    ] {
        let written = super::copied(options, &[super::OWN], &bytes);
        assert_eq!(parse(&written).unwrap().frames, whole.frames);
    }
}

/// Such a file may be intact, so that a new copy of it would help nobody.
#[test]
fn a_compression_that_nobody_knows_is_no_damage() {
    let mut bytes = BY_PYTHON.to_vec();
    for at in 0..bytes.len() - 4 {
        if &bytes[at..at + 4] == b"zstd" {
            bytes[at..at + 4].copy_from_slice(b"lzma");
        }
    }
    let error = parse(&bytes).unwrap_err();
    assert!(matches!(error, TrackError::Compression { .. }), "{error}");
    let said = error.to_string();
    for part in ["other.mcap", "\"lzma\"", "mcap compress"] {
        assert!(said.contains(part), "{said}");
    }
    assert!(!said.contains("intact"), "{said}");
}

/// RFC 8878, 3.1.1: a frame's magic number, no flags, a window; then one last block that repeats a byte ten times.
#[test]
fn a_frame_that_promises_too_much_is_damage() {
    let frame = |window: u8| {
        let block = 1_u32 | (1 << 1) | (10 << 3);
        let [a, b, c, _] = block.to_le_bytes();
        [0x28, 0xb5, 0x2f, 0xfd, 0, window, a, b, c, 0]
    };
    // 2 GiB of window, ten bytes of a thousand, a chunk of 1 TiB, and a frame that is cut off.
    let two_gib = 21 << 3;
    for (bytes, says) in [
        (chunk(10, &frame(two_gib)), "window"),
        (chunk(1000, &frame(0)), "decompression"),
        (chunk(1 << 40, &frame(0)), "other.mcap"),
        (chunk(10, &frame(0)[..8]), "decompression"),
    ] {
        let error = parse(&bytes).unwrap_err();
        assert!(matches!(error, TrackError::Container { .. }), "{error}");
        assert!(error.to_string().contains(says), "{error}");
    }
}

#[test]
fn a_flipped_bit_in_zstd_makes_no_other_pose() {
    let whole = short();
    for at in 0..BY_PYTHON.len() {
        let mut bytes = BY_PYTHON.to_vec();
        bytes[at] ^= 1 << (at % 8);
        if let Ok(read) = parse(&bytes) {
            let known = |frame| whole.frames.contains(frame);
            assert!(read.frames.iter().all(known), "byte {at}");
        }
    }
}
