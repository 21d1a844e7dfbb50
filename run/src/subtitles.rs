//! Subtitles in an MP4 file: a track of timed text (3GPP TS 26.245, `tx3g`) for each language.
//!
//! The muxer of pictures and sound knows no text, so these tracks are made here.

pub(crate) mod track;

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
    /// Lengths and sizes have 32 bits.
    #[error(
        "a film with subtitles lasts 49 days at most, and its subtitles have 4 GiB at most; make a shorter one"
    )]
    TooLarge,
}
