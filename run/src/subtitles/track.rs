//! A track of text: its box in `moov`, and its samples.

use super::{Subtitles, SubtitlesError};

/// Units of time in a second.
pub const MILLISECONDS: u32 = 1000;

/// Share of the picture's height that text has, from its bottom: five lines.
const HEIGHT: f64 = 0.3;
/// Share of the picture's height that a line has.
const LINE: f64 = 0.05;
/// Tracks of one group are alternatives: a player shows one of them.
const GROUP: u16 = 2;
/// Of the one font, which players replace by one of their own that has the characters.
const FONT: (u16, &[u8]) = (1, b"Sans-Serif");

/// A sample: its text, and how long it is shown, ms. Without one nothing is shown.
struct Sample<'a> {
    text: &'a str,
    lasts: u32,
}

/// The cues one after another without a gap, from the film's begin to its end at `end`, ms.
fn in_turn(subtitles: &Subtitles, end: u32) -> Result<Vec<Sample<'_>>, SubtitlesError> {
    // A negative time is 0; what is behind the end is not shown.
    let ms = |s: f64| ((s * f64::from(MILLISECONDS)).round() as u32).min(end);
    let mut samples = Vec::new();
    let (mut before_s, mut at) = (0.0_f64, 0);
    for cue in &subtitles.cues {
        let (from_s, until_s) = (cue.from_s, cue.until_s);
        // Also where one of them is no number.
        if !(before_s <= from_s && from_s <= until_s) {
            return Err(SubtitlesError::Order {
                from_s,
                until_s,
                before_s,
            });
        }
        let (from, until) = (ms(from_s), ms(until_s));
        for (text, until) in [("", from), (cue.text.as_str(), until)] {
            if until > at {
                let lasts = until - at;
                samples.push(Sample { text, lasts });
                at = until;
            }
        }
        before_s = until_s;
    }
    if end > at || samples.is_empty() {
        let lasts = end - at;
        samples.push(Sample { text: "", lasts });
    }
    Ok(samples)
}

/// The samples' bytes: each 16 bits of length, and so many bytes of UTF-8.
///
/// # Errors
/// [`SubtitlesError::Order`], [`SubtitlesError::TooLong`].
pub fn samples(subtitles: &Subtitles, end: u32) -> Result<Vec<u8>, SubtitlesError> {
    let mut bytes = Vec::new();
    for sample in in_turn(subtitles, end)? {
        let length = sample.text.len();
        let counted = u16::try_from(length);
        let counted = counted.map_err(|_| SubtitlesError::TooLong { bytes: length })?;
        bytes.extend(counted.to_be_bytes());
        bytes.extend(sample.text.as_bytes());
    }
    Ok(bytes)
}

/// The track's box: number and length (ms), the picture's size, and where its samples begin.
///
/// # Errors
/// [`SubtitlesError::Language`], and as for [`samples`].
pub fn trak(
    subtitles: &Subtitles,
    (id, end): (u32, u32),
    size: [u32; 2],
    offset: u64,
) -> Result<Vec<u8>, SubtitlesError> {
    let [wide, high] = size.map(f64::from);
    let text = (HEIGHT * high).round();
    // Fixed point, 16 bits of fraction.
    let fixed = |pixels: f64| (65536.0 * pixels) as u32;
    let one = fixed(1.0);
    // Down to the picture's bottom; the last is 1 with 30 bits of fraction.
    let matrix = [one, 0, 0, 0, one, 0, 0, fixed(high - text), 0x4000_0000];
    let header = made(
        b"tkhd",
        &[
            // In the movie and, where it is shown unasked, enabled.
            &(if subtitles.shown { 3u32 } else { 2 }).to_be_bytes(),
            &words(&[0, 0, id, 0, end, 0, 0]),
            // Before the picture; no volume.
            &(-1i16).to_be_bytes(),
            &GROUP.to_be_bytes(),
            &words(&[0]),
            &words(&matrix),
            &words(&[fixed(wide), fixed(text)]),
        ],
    )?;
    let media = made(
        b"mdhd",
        &[
            &words(&[0, 0, 0, MILLISECONDS, end]),
            &language(&subtitles.language)?.to_be_bytes(),
            &[0; 2],
        ],
    )?;
    let handler = made(b"hdlr", &[&[0; 8], b"sbtl", &[0; 12], b"Subtitles\0"])?;
    let here = made(b"url ", &[&words(&[1])])?;
    let references = made(b"dref", &[&words(&[0, 1]), &here])?;
    let table = made(
        b"stbl",
        &[&table(subtitles, end, (wide, text, high), offset)?],
    )?;
    let information = made(
        b"minf",
        &[
            &made(b"nmhd", &[&words(&[0])])?,
            &made(b"dinf", &[&references])?,
            &table,
        ],
    )?;
    let media = made(b"mdia", &[&media, &handler, &information])?;
    made(b"trak", &[&header, &media])
}

/// What a sample is like, how long each lasts, how large it is and where.
fn table(
    subtitles: &Subtitles,
    end: u32,
    (wide, text, high): (f64, f64, f64),
    offset: u64,
) -> Result<Vec<u8>, SubtitlesError> {
    let samples = in_turn(subtitles, end)?;
    let count = size_of(samples.len())?;
    let (font, name) = FONT;
    let fonts = made(
        b"ftab",
        &[
            &1u16.to_be_bytes(),
            &font.to_be_bytes(),
            &[name.len() as u8],
            name,
        ],
    )?;
    let halves = |values: [f64; 4]| values.map(|it| (it as i16).to_be_bytes()).concat();
    let entry = made(
        b"tx3g",
        &[
            // Its data are in this file.
            &[0, 0, 0, 0, 0, 0, 0, 1],
            &words(&[0]),
            // Centred, at the bottom, on a ground that lets a third of the picture through.
            &[1, 0xFF],
            &[0, 0, 0, 0xAA],
            &halves([0.0, 0.0, text, wide]),
            // All characters: the font, plain, its size, white.
            &[0; 4],
            &font.to_be_bytes(),
            &[0, (LINE * high).round().clamp(8.0, 255.0) as u8],
            &[0xFF; 4],
            &fonts,
        ],
    )?;
    let mut durations = words(&[0, count]);
    let mut sizes = words(&[0, 0, count]);
    for sample in &samples {
        durations.extend(words(&[1, sample.lasts]));
        sizes.extend(words(&[size_of(2 + sample.text.len())?]));
    }
    let boxes = [
        made(b"stsd", &[&words(&[0, 1]), &entry])?,
        made(b"stts", &[&durations])?,
        made(b"stsc", &[&words(&[0, 1, 1, count, 1])])?,
        made(b"stsz", &[&sizes])?,
        // Behind pictures and sound, which may be more than 4 GiB.
        made(b"co64", &[&words(&[0, 1]), &offset.to_be_bytes()])?,
    ];
    Ok(boxes.concat())
}

/// A box of these parts: four bytes of size, four of name, and what is in it (ISO/IEC 14496-12, 4.2).
fn made(name: &[u8; 4], parts: &[&[u8]]) -> Result<Vec<u8>, SubtitlesError> {
    let length = 8 + parts.iter().map(|part| part.len()).sum::<usize>();
    let mut bytes = Vec::with_capacity(length);
    bytes.extend(size_of(length)?.to_be_bytes());
    bytes.extend(name);
    bytes.extend(parts.concat());
    Ok(bytes)
}

fn size_of(bytes: usize) -> Result<u32, SubtitlesError> {
    u32::try_from(bytes).map_err(|_| SubtitlesError::TooLarge)
}

fn words(values: &[u32]) -> Vec<u8> {
    values.iter().flat_map(|it| it.to_be_bytes()).collect()
}

/// Five bits a letter.
fn language(code: &[u8; 3]) -> Result<u16, SubtitlesError> {
    let mut packed = 0;
    for letter in code {
        if !letter.is_ascii_lowercase() {
            let code = String::from_utf8_lossy(code).into_owned();
            return Err(SubtitlesError::Language(code));
        }
        packed = packed << 5 | u16::from(letter - 0x60);
    }
    Ok(packed)
}
