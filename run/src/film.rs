//! The film of a run: H.264 in MP4, the one pair that every browser plays
//! without a plug-in, and where there is sound, Opus.
//!
//! Encoding runs on a thread of its own, fed through a short bounded channel,
//! so that the next frame is simulated and drawn while this one is encoded; a
//! slow encoder holds the producer back instead of filling the memory.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use crate::film_error::FilmError;
use crate::h264::H264;
use crate::output::Staged;
use crate::soundtrack::Soundtrack;
use crate::subtitles::{self, Subtitles, SubtitlesError};
use muxide::api::{AudioCodec, Muxer, MuxerBuilder, MuxerError, VideoCodec};
use vitriol_sound::RATE;

/// Frames that may wait for the encoder: enough to even out a slow key frame,
/// few enough (2 MB each at 960×540) not to matter.
const QUEUED_FRAMES: usize = 4;

/// Most bytes of pictures and sound in a film. The muxer keeps all of them in memory and writes them at the end, and only there
/// refuses what 32 bits cannot count; its tables need a part.
const MOST_BYTES: u64 = u32::MAX as u64 / 8 * 7;

/// A film being written.
///
/// It appears under its name only when [`Film::finish`] has succeeded; dropped
/// before that, it leaves nothing behind.
#[derive(Debug)]
pub struct Film {
    frame_bytes: usize,
    size: [u32; 2],
    sounds: bool,
    parts: Option<SyncSender<Part>>,
    spent: Receiver<Vec<u8>>,
    encoder: Option<JoinHandle<Result<Staged, FilmError>>>,
}

/// What the encoder is given.
enum Part {
    Picture(Vec<u8>),
    Sound(Vec<[f32; 2]>),
}

impl Film {
    /// Begins a film of `width` × `height` pixels at `fps` frames a second,
    /// which will be found at `path`.
    ///
    /// # Errors
    /// [`FilmError::Size`], [`FilmError::Rate`], or [`FilmError::Write`] where
    /// the folder does not take a file.
    pub fn create(path: &Path, width: u32, height: u32, fps: u32) -> Result<Self, FilmError> {
        Self::begin(path, [width, height], fps, false, MOST_BYTES)
    }

    /// Begins a film of `size` (width and height, pixels) as [`Film::create`] does, with a track of sound at 48 kHz.
    ///
    /// # Errors
    /// As [`Film::create`].
    pub fn with_sound(path: &Path, size: [u32; 2], fps: u32) -> Result<Self, FilmError> {
        Self::begin(path, size, fps, true, MOST_BYTES)
    }

    fn begin(
        path: &Path,
        [width, height]: [u32; 2],
        fps: u32,
        sounds: bool,
        most_bytes: u64,
    ) -> Result<Self, FilmError> {
        let (long, short) = (width.max(height), width.min(height));
        if !width.is_multiple_of(2)
            || !height.is_multiple_of(2)
            || short < 16
            || long > 3840
            || short > 2160
        {
            return Err(FilmError::Size { width, height });
        }
        if !(1..=120).contains(&fps) {
            return Err(FilmError::Rate { fps });
        }
        let staged = Staged::create(path).map_err(unwritten(path))?;
        // A frame may have its sound beside it.
        let (parts, queue) = sync_channel(QUEUED_FRAMES * if sounds { 2 } else { 1 });
        let (give_back, spent) = sync_channel(QUEUED_FRAMES + 1);
        let shape = Shape {
            width,
            height,
            fps,
            sounds,
            most_bytes,
        };
        let encoder = std::thread::Builder::new()
            .name("film".into())
            .spawn(move || shape.film(staged, &queue, &give_back))
            .map_err(unwritten(path))?;
        Ok(Self {
            frame_bytes: width as usize * height as usize * 4,
            size: [width, height],
            sounds,
            parts: Some(parts),
            spent,
            encoder: Some(encoder),
        })
    }

    /// Adds one frame: rows from the top, sRGB-encoded R, G, B, A bytes; alpha
    /// is ignored. Returns as soon as the frame is queued.
    ///
    /// # Errors
    /// [`FilmError::FrameLength`], or what stopped the encoder.
    pub fn push_rgba(&mut self, rgba: &[u8]) -> Result<(), FilmError> {
        if rgba.len() != self.frame_bytes {
            return Err(FilmError::FrameLength {
                got: rgba.len(),
                expected: self.frame_bytes,
            });
        }
        let mut frame = self.spent.try_recv().unwrap_or_default();
        frame.clear();
        frame.extend_from_slice(rgba);
        self.give(Part::Picture(frame))
    }

    /// Adds the next samples at 48 kHz, left and right; the first belongs to the
    /// film's begin. They should come with the frames that are shown meanwhile.
    ///
    /// # Errors
    /// [`FilmError::Mute`], or what stopped the encoder.
    pub fn push_sound(&mut self, samples: &[[f32; 2]]) -> Result<(), FilmError> {
        if !self.sounds {
            return Err(FilmError::Mute);
        }
        self.give(Part::Sound(samples.to_vec()))
    }

    fn give(&mut self, part: Part) -> Result<(), FilmError> {
        match &self.parts {
            Some(parts) if parts.send(part).is_ok() => Ok(()),
            _ => Err(self.end().err().unwrap_or(FilmError::Stopped)),
        }
    }

    /// Encodes what is queued and puts the film in its place.
    ///
    /// # Errors
    /// [`FilmError::Empty`] without a frame, else an error of the encoder, the muxer or the file system; also where a film of that name has
    /// appeared meanwhile, which is kept.
    pub fn finish(self) -> Result<PathBuf, FilmError> {
        self.finish_with(&[])
    }

    /// Ends the film as [`Film::finish`] does, with a track of subtitles for each of these languages.
    ///
    /// # Errors
    /// As [`Film::finish`], and [`FilmError::Subtitles`].
    pub fn finish_with(mut self, texts: &[Subtitles]) -> Result<PathBuf, FilmError> {
        let staged = self.end()?;
        let path = staged.path.clone();
        let mut file = staged.try_clone().map_err(unwritten(&path))?;
        subtitles::add(&mut file, self.size, texts).map_err(|error| match error {
            SubtitlesError::File(source) => unwritten(&path)(source),
            error => error.into(),
        })?;
        staged.keep().map_err(unwritten(&path))?;
        Ok(path)
    }

    /// Waits for the encoder, which has no more to come.
    fn end(&mut self) -> Result<Staged, FilmError> {
        self.parts = None;
        let ended = self.encoder.take().map(JoinHandle::join);
        ended
            .and_then(Result::ok)
            .unwrap_or(Err(FilmError::Stopped))
    }
}

impl Drop for Film {
    fn drop(&mut self) {
        // So that the encoder's temporary file is gone when the film is; a panic there
        // has nothing left to tell.
        let _ = self.end();
    }
}

/// Makes an error of the file system one of the film at `path`.
fn unwritten(path: &Path) -> impl FnOnce(std::io::Error) -> FilmError {
    let path = path.to_owned();
    move |source| FilmError::Write { path, source }
}

/// The film's frame size in pixels, its rate in Hz, and how long it may become.
#[derive(Clone, Copy)]
struct Shape {
    width: u32,
    height: u32,
    fps: u32,
    sounds: bool,
    most_bytes: u64,
}

impl Shape {
    /// Encodes what comes. The muxer's errors of the file system name no file, and these do.
    fn film(
        self,
        staged: Staged,
        queue: &Receiver<Part>,
        give_back: &SyncSender<Vec<u8>>,
    ) -> Result<Staged, FilmError> {
        let path = staged.path.clone();
        let encoded = self.encode(staged, queue, give_back);
        encoded.map_err(|error| match error {
            FilmError::Mux(MuxerError::Io(source)) => unwritten(&path)(source),
            error => error,
        })
    }

    fn encode(
        self,
        staged: Staged,
        queue: &Receiver<Part>,
        give_back: &SyncSender<Vec<u8>>,
    ) -> Result<Staged, FilmError> {
        let mut encoder = H264::new([self.width, self.height], self.fps)?;
        let file = staged.try_clone().map_err(unwritten(&staged.path))?;
        let mut builder = MuxerBuilder::new(BufWriter::new(file))
            .video(
                VideoCodec::H264,
                self.width,
                self.height,
                f64::from(self.fps),
            )
            .with_fast_start(true);
        let mut sound = None;
        if self.sounds {
            builder = builder.audio(AudioCodec::Opus, RATE, 2);
            sound = Some(Soundtrack::new()?);
        }
        let mut muxer: Muxer<BufWriter<File>> = builder.build()?;
        let (mut number, mut bytes) = (0u32, 0u64);
        for part in queue {
            let frame = match (part, &mut sound) {
                (Part::Picture(frame), _) => frame,
                (Part::Sound(samples), Some(sound)) => {
                    sound.push(&samples)?;
                    // The muxer wants a picture first.
                    if number > 0 {
                        bytes += sound.give(&mut muxer)?;
                    }
                    continue;
                }
                (Part::Sound(_), None) => return Err(FilmError::Mute),
            };
            let coded = encoder.encode(&frame)?;
            let coded = coded.ok_or(FilmError::TooRich { number })?;
            let seconds = f64::from(number) / f64::from(self.fps);
            bytes += coded.bytes.len() as u64;
            if bytes > self.most_bytes {
                return Err(FilmError::TooLong { seconds });
            }
            muxer.write_video(seconds, coded.bytes, coded.is_key)?;
            // A full basket only means that one buffer more is freed.
            let _ = give_back.try_send(frame);
            number += 1;
        }
        if number == 0 {
            return Err(FilmError::Empty);
        }
        if let Some(sound) = sound {
            sound.finish(&mut muxer, f64::from(number) / f64::from(self.fps))?;
        }
        muxer.finish_in_place()?;
        let flushed = muxer.into_writer().into_inner();
        let flushed = flushed.map_err(|error| error.into_error());
        flushed.map_err(unwritten(&staged.path))?;
        Ok(staged)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::failure::Failure;

    /// The muxer gives the system's error, which says that there is no space, and not for what.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_said_with_the_films_name() {
        let folder = tempfile::tempdir().unwrap();
        let staged = Staged::on_full_disk(&folder.path().join("film.mp4")).unwrap();
        let shape = Shape {
            width: 320,
            height: 180,
            fps: 30,
            sounds: false,
            most_bytes: MOST_BYTES,
        };
        // Noise, of which a second is more than a buffer holds: the disk is met before the last bytes are flushed.
        const FRAMES: u32 = 30;
        let noise = |frame: u32| {
            let bytes = (0..320 * 180 * 4_u32).map(|byte| {
                let mixed = (byte ^ (frame << 20)).wrapping_mul(0x9E37_79B9);
                ((mixed ^ (mixed >> 15)).wrapping_mul(0x85EB_CA6B) >> 26) as u8
            });
            Part::Picture(bytes.collect())
        };
        let (parts, queue) = sync_channel(FRAMES as usize);
        let (give_back, _spent) = sync_channel(1);
        for frame in 0..FRAMES {
            parts.send(noise(frame)).unwrap();
        }
        drop(parts);
        let error = shape.film(staged, &queue, &give_back).unwrap_err();
        let said = Failure::Other(error.into()).to_string();
        for part in ["film.mp4", "is there room", "No space left"] {
            assert!(said.contains(part), "{said}");
        }
    }

    /// The run that is filmed ends there, and not hours later; nothing is left behind.
    #[test]
    fn a_film_that_becomes_too_long_ends_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.mp4");
        let mut film = Film::begin(&path, [64, 64], 10, false, 2000).unwrap();
        // Noise, of which a picture takes more than a few bytes.
        let mut state = 1u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        let error = (0..1000)
            .find_map(|_| {
                let picture: Vec<u8> = (0..64 * 64 * 4).map(|_| noise()).collect();
                film.push_rgba(&picture).err()
            })
            .unwrap();
        assert!(
            matches!(error, FilmError::TooLong { seconds } if seconds < 10.0),
            "{error}"
        );
        drop(film);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
