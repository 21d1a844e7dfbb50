//! A reader of MP4 files (ISO/IEC 14496-12), finished and unfinished ones, that shares nothing with their writer.

use std::ops::Range;

/// A track as a finished file's index describes it.
#[derive(Debug, PartialEq)]
pub struct Track {
    pub id: u32,
    pub enabled: bool,
    /// ms.
    pub length: u32,
    pub handler: String,
    pub language: String,
    /// Each with when it is shown, in units of the track, and how long.
    pub samples: Vec<(u32, u32, Vec<u8>)>,
    pub units: u32,
    /// Numbers, from 1, of those that a player can begin with; without it, all.
    pub keys: Option<Vec<u32>>,
}

/// A sample of an unfinished file.
pub struct Fragment {
    pub track: u32,
    /// In units of the track.
    pub from: u32,
    pub bytes: Vec<u8>,
}

pub fn number(bytes: &[u8], at: usize) -> u32 {
    u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap())
}

fn long(bytes: &[u8], at: usize) -> usize {
    u64::from_be_bytes(bytes[at..at + 8].try_into().unwrap()) as usize
}

/// The boxes in these bytes, as far as they are whole: where each begins, its name, and where its body is.
fn boxes(bytes: &[u8]) -> Vec<(usize, &[u8], Range<usize>)> {
    let (mut at, mut found) = (0, Vec::new());
    while at + 8 <= bytes.len() {
        let (header, size) = match number(bytes, at) {
            1 => (16, long(bytes, at + 8)),
            size => (8, size as usize),
        };
        assert!(size >= header, "a box at {at} is smaller than its header");
        if at + size > bytes.len() {
            break;
        }
        found.push((at, &bytes[at + 4..at + 8], at + header..at + size));
        at += size;
    }
    found
}

/// The bodies of all boxes of that name, at that place in the tree.
pub fn bodies<'a>(bytes: &'a [u8], path: &[&str]) -> Vec<&'a [u8]> {
    let Some((name, rest)) = path.split_first() else {
        return vec![bytes];
    };
    let named = boxes(bytes).into_iter();
    let named = named.filter(|(_, found, _)| *found == name.as_bytes());
    named
        .flat_map(|(.., body)| bodies(&bytes[body], rest))
        .collect()
}

pub fn body<'a>(bytes: &'a [u8], path: &[&str]) -> &'a [u8] {
    let found = bodies(bytes, path);
    assert_eq!(found.len(), 1, "{path:?}");
    found[0]
}

/// Where the chunks of a track are.
fn chunks(track: &[u8]) -> Vec<usize> {
    let table = |name| bodies(track, &["mdia", "minf", "stbl", name]);
    match (&table("stco")[..], &table("co64")[..]) {
        ([short], []) => (0..number(short, 4) as usize)
            .map(|chunk| number(short, 8 + 4 * chunk) as usize)
            .collect(),
        ([], [wide]) => (0..number(wide, 4) as usize)
            .map(|chunk| long(wide, 8 + 8 * chunk))
            .collect(),
        _ => panic!("a track has one table of chunks"),
    }
}

/// The tracks of a finished file.
pub fn tracks(film: &[u8]) -> Vec<Track> {
    bodies(film, &["moov", "trak"])
        .into_iter()
        .map(|track| {
            let header = body(track, &["tkhd"]);
            let media = body(track, &["mdia", "mdhd"]);
            let packed = number(media, 20) >> 16;
            let letters = [10, 5, 0].map(|shift| (packed >> shift & 31) as u8 + 0x60);
            let table = |name| body(track, &["mdia", "minf", "stbl", name]);
            let (sizes, times, runs) = (table("stsz"), table("stts"), table("stsc"));
            let lasting = (0..number(times, 4) as usize).flat_map(|run| {
                let [count, lasts] = [8, 12].map(|at| number(times, at + 8 * run));
                std::iter::repeat_n(lasts, count as usize)
            });
            let runs: Vec<[u32; 2]> = (0..number(runs, 4) as usize)
                .map(|run| [8, 12].map(|at| number(runs, at + 12 * run)))
                .collect();
            let mut places = Vec::new();
            for (chunk, mut at) in (1..).zip(chunks(track)) {
                let run = runs.iter().rev().find(|[first, _]| *first <= chunk);
                for _ in 0..run.unwrap()[1] {
                    let size = match number(sizes, 4) {
                        0 => number(sizes, 12 + 4 * places.len()),
                        all => all,
                    };
                    places.push(at..at + size as usize);
                    at += size as usize;
                }
            }
            assert_eq!(places.len(), number(sizes, 8) as usize);
            let mut now = 0;
            let samples = lasting.zip(places).map(|(lasts, place)| {
                now += lasts;
                (now - lasts, lasts, film[place].to_vec())
            });
            let samples = samples.collect();
            let keys = bodies(track, &["mdia", "minf", "stbl", "stss"]);
            let keys = keys.first().map(|keys| {
                let each = 0..number(keys, 4) as usize;
                each.map(|key| number(keys, 8 + 4 * key)).collect()
            });
            Track {
                id: number(header, 12),
                enabled: number(header, 0) & 1 == 1,
                length: number(header, 20),
                handler: String::from_utf8(body(track, &["mdia", "hdlr"])[8..12].into()).unwrap(),
                language: String::from_utf8(letters.into()).unwrap(),
                samples,
                units: number(media, 12),
                keys,
            }
        })
        .collect()
}

/// The samples of an unfinished file, whose last fragment may not be whole.
pub fn fragments(film: &[u8]) -> Vec<Fragment> {
    let mut samples = Vec::new();
    for pair in boxes(film).windows(2) {
        let [(begin, first, moof), (_, second, _)] = pair else {
            continue;
        };
        if *first != b"moof" || *second != b"mdat" {
            continue;
        }
        for track in bodies(&film[moof.clone()], &["traf"]) {
            let (time, run) = (body(track, &["tfdt"]), body(track, &["trun"]));
            // Times of 32 bits; a place of the first, and for each a length of time, a size and flags.
            assert_eq!((time[0], number(run, 0) & 0xFF_FFFF), (0, 0x701));
            let (mut from, mut at) = (number(time, 4), begin + number(run, 8) as usize);
            for sample in 0..number(run, 4) as usize {
                let [lasts, size] = [12, 16].map(|entry| number(run, entry + 12 * sample));
                samples.push(Fragment {
                    track: number(body(track, &["tfhd"]), 4),
                    from,
                    bytes: film[at..at + size as usize].to_vec(),
                });
                from += lasts;
                at += size as usize;
            }
        }
    }
    samples
}

/// Pictures of H.264, whose units have 4-byte lengths before them, with start codes in place of these.
pub fn annex_b<'a>(pictures: impl IntoIterator<Item = &'a [u8]>) -> Vec<u8> {
    let mut out = Vec::new();
    for mut units in pictures {
        while !units.is_empty() {
            let (unit, rest) = units[4..].split_at(number(units, 0) as usize);
            out.extend([0, 0, 0, 1]);
            out.extend(unit);
            units = rest;
        }
    }
    out
}
