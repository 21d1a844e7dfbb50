//! Subtitles in an MP4 file: a track of timed text (3GPP TS 26.245, `tx3g`) for each language.
//!
//! The muxer of pictures and sound writes no text. So its finished file is opened once more: the texts are put behind its samples, and
//! their tracks into its `moov`, which grows and moves the samples on.

mod boxes;
mod track;

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use boxes::{Boxes, find, shift_chunks, size_of, u32_at};

/// A text, from when and until when, s of the film.
#[derive(Clone, Debug, PartialEq)]
pub struct Cue {
    /// From when on, s.
    pub from_s: f64,
    /// Until when, s.
    pub until_s: f64,
    /// The text; a line break is one.
    pub text: String,
}

/// The texts of one language.
#[derive(Clone, Debug, PartialEq)]
pub struct Subtitles {
    /// ISO 639-2/T: three small letters, such as `deu`.
    pub language: [u8; 3],
    /// Whether a player shows them unasked; those of one language at most.
    pub shown: bool,
    /// In the order of their times, each at most until the next begins.
    pub cues: Vec<Cue>,
}

/// What can be wrong with subtitles.
#[derive(Debug, thiserror::Error)]
pub enum SubtitlesError {
    /// No code of a language.
    #[error("a subtitle's language {0:?} is none of three small letters, such as deu (ISO 639-2)")]
    Language(String),
    /// Times that are not in order.
    #[error(
        "a subtitle from {from_s} s to {until_s} s follows one until {before_s} s: give them in order"
    )]
    Order {
        /// Its begin, s.
        from_s: f64,
        /// Its end, s.
        until_s: f64,
        /// End of the one before, s.
        before_s: f64,
    },
    /// A text is longer than a sample's 16 bits count.
    #[error("a subtitle of {bytes} bytes is longer than 65535; say it shorter")]
    TooLong {
        /// Its length as UTF-8.
        bytes: usize,
    },
    /// The film is not as the muxer makes it.
    #[error("the film has no whole {0:?} box, so subtitles cannot be added; report it")]
    NoBox(&'static str),
    /// Offsets of a film have 32 bits.
    #[error("with its subtitles the film has more than 4 GiB; make a shorter one")]
    TooLarge,
    /// The file could not be read or written.
    #[error("the film's file could not be read or written; is there room?")]
    File(#[from] io::Error),
}

/// Adds tracks of text to a film's file, which is an MP4 with its `moov` before its samples.
///
/// # Errors
/// See [`SubtitlesError`]; the file is spoiled only where writing fails.
pub(crate) fn add(
    file: &mut File,
    size: [u32; 2],
    subtitles: &[Subtitles],
) -> Result<(), SubtitlesError> {
    if subtitles.is_empty() {
        return Ok(());
    }
    let mut film = Vec::new();
    file.seek(SeekFrom::Start(0))?;
    file.read_to_end(&mut film)?;
    let film = with_subtitles(&film, size, subtitles)?;
    file.seek(SeekFrom::Start(0))?;
    file.write_all(&film)?;
    file.set_len(film.len() as u64)?;
    Ok(())
}

/// The film's bytes with those tracks.
fn with_subtitles(
    film: &[u8],
    size: [u32; 2],
    subtitles: &[Subtitles],
) -> Result<Vec<u8>, SubtitlesError> {
    let at = find(film, b"moov").ok_or(SubtitlesError::NoBox("moov"))?;
    let moov = film.get(at.clone()).ok_or(SubtitlesError::NoBox("moov"))?;
    let header = Boxes::new(moov).find(|(name, _)| name == b"mvhd");
    let header = header.map(|(_, body)| body);
    let (milliseconds, next_id) = header
        .and_then(movie_header)
        .ok_or(SubtitlesError::NoBox("mvhd"))?;

    // Offsets have a fixed size, so tracks are as long before they are known.
    let tracks = |offsets: &[u32]| -> Result<Vec<u8>, SubtitlesError> {
        let mut made = Vec::new();
        for ((number, one), offset) in (0..).zip(subtitles).zip(offsets) {
            let id = next_id + number;
            made.extend(track::trak(one, (id, milliseconds), size, *offset)?);
        }
        Ok(made)
    };
    let samples: Vec<Vec<u8>> = subtitles
        .iter()
        .map(|one| track::samples(one, milliseconds))
        .collect::<Result<_, _>>()?;
    let grown = tracks(&vec![0; subtitles.len()])?.len();
    let mut end = film.len() + grown + 8;
    let mut offsets = Vec::with_capacity(samples.len());
    for sample in &samples {
        offsets.push(size_of(end)?);
        end += sample.len();
    }
    size_of(end)?;

    let mut longer = moov.to_vec();
    shift_chunks(&mut longer, size_of(grown)?).ok_or(SubtitlesError::NoBox("stco"))?;
    next_track(&mut longer, next_id + size_of(subtitles.len())?)
        .ok_or(SubtitlesError::NoBox("mvhd"))?;
    longer.extend(tracks(&offsets)?);

    let mut out = film[..at.start - 8].to_vec();
    out.extend(boxes::made(b"moov", &[&longer])?);
    out.extend_from_slice(&film[at.end..]);
    let samples: Vec<&[u8]> = samples.iter().map(Vec::as_slice).collect();
    out.extend(boxes::made(b"mdat", &samples)?);
    Ok(out)
}

/// Length (ms) and the next track's number of an `mvhd` of version 0 that counts milliseconds, as the muxer writes it.
fn movie_header(body: &[u8]) -> Option<(u32, u32)> {
    let counts = (u32_at(body, 0)? >> 24 == 0) && u32_at(body, 12)? == track::MILLISECONDS;
    counts.then_some((u32_at(body, 16)?, u32_at(body, body.len().checked_sub(4)?)?))
}

/// Sets the next track's number in a `moov`'s `mvhd`.
fn next_track(moov: &mut [u8], id: u32) -> Option<()> {
    let end = find(moov, b"mvhd")?.end;
    moov.get_mut(end - 4..end)?
        .copy_from_slice(&id.to_be_bytes());
    Some(())
}
