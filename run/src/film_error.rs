//! What can go wrong with a film.

use std::path::{Path, PathBuf};

use shiguredo_mp4::mux::MuxError;
use vitriol_sound::OpusError;

use crate::h264::MOST_BITS;
use crate::subtitles::SubtitlesError;

/// What can go wrong with a film.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// The frame size is not one that 4:2:0 and the encoder can hold.
    #[error(
        "a film of {width}x{height} cannot be made: both sides must be even, from 16 to 3840 x 2160"
    )]
    Size {
        /// Width asked for, pixels.
        width: u32,
        /// Height asked for, pixels.
        height: u32,
    },
    /// The frame rate is zero or more than a film can use.
    #[error("a film at {fps} frames a second cannot be made: choose 1 to 120")]
    Rate {
        /// Frame rate asked for, Hz.
        fps: u32,
    },
    /// A frame's bytes do not match the film's size.
    #[error("a frame of {got} bytes was given where {expected} (RGBA, 4 bytes a pixel) are needed")]
    FrameLength {
        /// Bytes given.
        got: usize,
        /// Bytes that width × height × 4 asks for.
        expected: usize,
    },
    /// The film would have no frame at all, which no player opens.
    #[error("the film has no frame: run for at least one frame or give --no-video")]
    Empty,
    /// A frame was left out, which would shift all that follow.
    #[error(
        "frame {number} of the film has more detail than its {MOST_BITS} bits a second hold; make \
         a smaller film, or none with --no-video"
    )]
    TooRich {
        /// The frame, from 0.
        number: u32,
    },
    /// The H.264 encoder refused.
    #[error("the H.264 encoder failed")]
    Encode(#[from] openh264::Error),
    /// The MP4 writer refused.
    #[error("the film could not be put into its MP4 file")]
    Mux(#[from] MuxError),
    /// Sound could not be encoded.
    #[error("the film's sound could not be encoded")]
    Sound(#[from] OpusError),
    /// Subtitles could not be added.
    #[error("the film's subtitles could not be added")]
    Subtitles(#[from] SubtitlesError),
    /// Samples came for a film without a track for them.
    #[error("the film was begun without sound, and sound was given to it")]
    Mute,
    /// The file could not be made, written or put in its place.
    #[error("the film {path} could not be written; is there room and permission?")]
    Write {
        /// The film's path.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// The encoder thread ended early without saying why.
    #[error("the film's encoder stopped unexpectedly; run again with --no-video to do without it")]
    Stopped,
}

/// Makes an error of the file system one of the film at `path`.
pub(crate) fn unwritten(path: &Path) -> impl FnOnce(std::io::Error) -> FilmError {
    let path = path.to_owned();
    move |source| FilmError::Write { path, source }
}
