//! Truncated and bit-flipped files: an error or a recovery, never a panic, never a wrong pose.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use mcap::records::op;
use mcap::{Compression, MAGIC, MessageStream, WriteOptions};
use proptest::prelude::*;
use vitriol_xr::track::{Track, TrackError};

/// 1.5 s: four chunks.
const FRAMES: u64 = 135;

fn parse(bytes: &[u8]) -> Result<Track, TrackError> {
    Track::parse(bytes, Path::new("damaged.mcap"))
}

/// The track that is read must be a beginning of the one that was written.
fn is_beginning(read: &Track, whole: &Track) {
    let kept = read.frames.len();
    assert!(kept <= whole.frames.len());
    assert_eq!(read.frames, whole.frames[..kept]);
    assert_eq!(read.stage_from_flasks, whole.stage_from_flasks[..kept]);
    assert_eq!(read.metadata, whole.metadata);
}

/// Numbers that look random and are the same each time (SplitMix64).
fn numbers(mut state: u64) -> impl Iterator<Item = u64> {
    std::iter::from_fn(move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        Some(z ^ (z >> 31))
    })
}

#[test]
fn cut_anywhere_it_is_recovered_up_to_the_cut_or_refused() {
    let whole = super::track(FRAMES);
    let bytes = super::bytes(&whole);
    let (mut recovered, mut last) = (0, 0);
    for cut in (0..bytes.len()).step_by(37) {
        match parse(&bytes[..cut]) {
            Ok(read) => {
                assert!(read.recovered);
                is_beginning(&read, &whole);
                assert!(read.frames.len() >= last, "a longer file holds no less");
                last = read.frames.len();
                recovered += 1;
            }
            Err(error) => assert!(error.to_string().contains("damaged.mcap"), "{error}"),
        }
    }
    assert!(recovered > 100, "{recovered}");
    assert_eq!(last, whole.frames.len(), "without its index it is whole");
}

/// Where each chunk ends: a record is its kind, its length in eight bytes, and its content (the MCAP specification, "Records").
fn ends_of_chunks(file: &[u8]) -> Vec<usize> {
    let (mut at, mut ends) = (MAGIC.len(), Vec::new());
    while at + 9 <= file.len() - MAGIC.len() {
        let length = u64::from_le_bytes(file[at + 1..at + 9].try_into().unwrap());
        let is_chunk = file[at] == op::CHUNK;
        at += 9 + length as usize;
        if is_chunk {
            ends.push(at);
        }
    }
    ends
}

/// The steps in the beginning of a file by the container's own library: how many have all that a step must have, and whether another has
/// less.
fn steps_in(cut: &[u8]) -> (usize, bool) {
    let options = mcap::read::Options::IgnoreEndMagic.into();
    let messages = MessageStream::new_with_options(cut, options).unwrap();
    let mut topics: BTreeMap<u32, BTreeSet<String>> = BTreeMap::new();
    for message in messages.map_while(Result::ok) {
        let of_step = topics.entry(message.sequence).or_default();
        of_step.insert(message.channel.topic.clone());
    }
    let all = ["/tf", "/xr/frame", "/xr/input/left", "/xr/input/right"];
    let whole = topics.values();
    let whole = whole.filter(|of_step| all.iter().all(|topic| of_step.contains(*topic)));
    let count = whole.count();
    (count, count < topics.len())
}

/// Other programs end a chunk where it is full, and a step may lie in two. What was cut off there was told to be sorted by time.
#[test]
fn cut_between_chunks_it_is_recovered_up_to_the_last_whole_step() {
    let whole = super::track(FRAMES);
    let ours = super::bytes(&whole);
    for compression in [Some(Compression::Lz4), None] {
        let small = WriteOptions::new().chunk_size(Some(2000));
        let bytes = super::copied(small.compression(compression), &[super::OWN], &ours);
        assert_eq!(parse(&bytes).unwrap().frames, whole.frames);
        let mut within_a_step = 0;
        for end in ends_of_chunks(&bytes) {
            let (steps, is_divided) = steps_in(&bytes[..end]);
            let read = match parse(&bytes[..end]) {
                Ok(read) => read,
                Err(error) => {
                    assert_eq!(steps, 0, "{error}");
                    continue;
                }
            };
            assert!(read.recovered);
            assert_eq!(read.frames.len(), steps);
            // The last step's switches may lie in the chunk that is missing.
            let before = steps - 1;
            assert_eq!(read.frames[..before], whole.frames[..before]);
            within_a_step += usize::from(is_divided);
        }
        assert!(within_a_step > 10, "{within_a_step}");
    }
}

#[test]
fn a_flipped_bit_is_noticed_wherever_it_is() {
    let whole = super::track(FRAMES);
    let bytes = super::bytes(&whole);
    for number in numbers(2).take(1500) {
        let mut flipped = bytes.clone();
        let bit = (number % (8 * bytes.len() as u64)) as usize;
        flipped[bit / 8] ^= 1 << (bit % 8);
        match parse(&flipped) {
            // A flip in the last eight bytes makes the file look cut off.
            Ok(read) => {
                assert!(
                    read.recovered && bit / 8 >= bytes.len() - 8,
                    "flip of bit {bit} of {} went unnoticed",
                    8 * bytes.len()
                );
                is_beginning(&read, &whole);
            }
            Err(error) => assert!(error.to_string().contains("damaged.mcap"), "{error}"),
        }
    }
}

/// It was said to be cut off, though it is whole and longer. Two files in one are no track either.
#[test]
fn bytes_after_the_end_are_told_from_a_file_that_was_cut() {
    let whole = super::bytes(&super::track(FRAMES));
    for (tail, told) in [
        (&b"x"[..], "has 1 byte after its end".to_owned()),
        (&b"\r\n"[..], "has 2 bytes after its end".to_owned()),
        (
            &whole[..],
            format!("has {} bytes after its end", whole.len()),
        ),
    ] {
        let error = parse(&[&whole[..], tail].concat()).unwrap_err();
        assert!(matches!(error, TrackError::Tail { .. }), "{error}");
        let message = error.to_string();
        let remedy = format!("head -c {}`", whole.len());
        for part in ["damaged.mcap: ", &told, &remedy] {
            assert!(message.contains(part), "{part:?} is not in: {message}");
        }
        assert!(!message.contains("broke"), "{message}");
    }
    let cut = parse(&whole[..whole.len() - 1]).unwrap();
    assert!(cut.recovered);
}

#[test]
fn a_flipped_bit_in_a_chunk_is_no_crash() {
    // Cut off as by a crash, and damaged besides: recovering would replay a wrong pose.
    let whole = super::track(FRAMES);
    let mut bytes = super::bytes(&whole);
    bytes.truncate(bytes.len() - 100);
    let middle = bytes.len() / 3;
    bytes[middle] ^= 0x10;
    let error = parse(&bytes).unwrap_err();
    assert!(matches!(error, TrackError::Container { .. }), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn scrambled_files_do_not_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..40),
        cut in any::<prop::sample::Index>(),
    ) {
        let mut bytes = super::bytes(&super::track(50));
        for (at, value) in edits {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        bytes.truncate(cut.index(bytes.len() + 1));
        let _ = parse(&bytes);
    }

    #[test]
    fn any_bytes_do_not_panic(tail in prop::collection::vec(any::<u8>(), 0..300)) {
        let _ = parse(&tail);
        let mut bytes = b"\x89MCAP0\r\n".to_vec();
        bytes.extend(&tail);
        let _ = parse(&bytes);
        bytes.extend(b"\x89MCAP0\r\n");
        let _ = parse(&bytes);
    }
}
