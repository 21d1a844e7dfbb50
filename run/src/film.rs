//! The film of a run: H.264 in MP4, the one pair that every browser plays
//! without a plug-in, and where there is sound, Opus.
//!
//! Encoding runs on a thread of its own, fed through a short bounded channel,
//! so that the next frame is simulated and drawn while this one is encoded; a
//! slow encoder holds the producer back instead of filling the memory.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use crate::film_error::{FilmError, unwritten};
use crate::h264::H264;
use crate::mp4::{Mp4, Shape};
use crate::output::Staged;
use crate::soundtrack::Soundtrack;
use crate::subtitles::Subtitles;

/// Frames that may wait for the encoder: enough to even out a slow key frame,
/// few enough (2 MB each at 960×540) not to matter.
const QUEUED_FRAMES: usize = 4;

/// A film being written.
///
/// It appears under its name only when [`Film::finish`] has succeeded; dropped
/// before that, it leaves nothing behind. Where the program is killed, what was
/// written stays under a name with `unfinished` in it, and plays.
#[derive(Debug)]
pub struct Film {
    frame_bytes: usize,
    sounds: bool,
    parts: Option<SyncSender<Part>>,
    spent: Receiver<Vec<u8>>,
    encoder: Option<JoinHandle<Result<Mp4, FilmError>>>,
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
        Self::begin(path, [width, height], fps, false)
    }

    /// Begins a film of `size` (width and height, pixels) as [`Film::create`] does, with a track of sound at 48 kHz.
    ///
    /// # Errors
    /// As [`Film::create`].
    pub fn with_sound(path: &Path, size: [u32; 2], fps: u32) -> Result<Self, FilmError> {
        Self::begin(path, size, fps, true)
    }

    fn begin(
        path: &Path,
        [width, height]: [u32; 2],
        fps: u32,
        sounds: bool,
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
        let staged = Staged::unfinished(path).map_err(unwritten(path))?;
        // A frame may have its sound beside it.
        let (parts, queue) = sync_channel(QUEUED_FRAMES * if sounds { 2 } else { 1 });
        let (give_back, spent) = sync_channel(QUEUED_FRAMES + 1);
        let shape = Shape {
            size: [width, height],
            fps,
            sounds,
        };
        let encoder = std::thread::Builder::new()
            .name("film".into())
            .spawn(move || encode(shape, staged, &queue, &give_back))
            .map_err(unwritten(path))?;
        Ok(Self {
            frame_bytes: width as usize * height as usize * 4,
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
        let staged = self.end()?.finish(texts)?;
        let path = staged.path.clone();
        staged.keep().map_err(unwritten(&path))?;
        Ok(path)
    }

    /// Waits for the encoder, which has no more to come.
    fn end(&mut self) -> Result<Mp4, FilmError> {
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

/// Encodes what comes into a file.
fn encode(
    shape: Shape,
    staged: Staged,
    queue: &Receiver<Part>,
    give_back: &SyncSender<Vec<u8>>,
) -> Result<Mp4, FilmError> {
    let mut encoder = H264::new(shape.size, shape.fps)?;
    let mut sound = shape.sounds.then(Soundtrack::new).transpose()?;
    // The first picture begins the file, and describes those that follow.
    let mut film = Err(staged);
    let mut number = 0u32;
    for part in queue {
        let frame = match (part, &mut sound) {
            (Part::Picture(frame), _) => frame,
            (Part::Sound(samples), Some(sound)) => {
                sound.push(&samples)?;
                continue;
            }
            (Part::Sound(_), None) => return Err(FilmError::Mute),
        };
        let coded = encoder.encode(&frame)?;
        let coded = coded.ok_or(FilmError::TooRich { number })?;
        let mut begun = match film {
            Ok(begun) => begun,
            Err(staged) => Mp4::begin(staged, shape, coded)?,
        };
        begun.add_picture(coded)?;
        if let Some(sound) = &mut sound {
            sound.give(&mut begun);
        }
        film = Ok(begun);
        // A full basket only means that one buffer more is freed.
        let _ = give_back.try_send(frame);
        number += 1;
    }
    let mut film = film.map_err(|_| FilmError::Empty)?;
    if let Some(sound) = sound {
        sound.finish(&mut film, f64::from(number) / f64::from(shape.fps))?;
    }
    Ok(film)
}

#[cfg(all(test, target_os = "linux"))]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::failure::Failure;

    /// The system's error says that there is no space, and not for what.
    #[test]
    fn a_full_disk_is_said_with_the_films_name() {
        let folder = tempfile::tempdir().unwrap();
        let staged = Staged::on_full_disk(&folder.path().join("film.mp4")).unwrap();
        let shape = Shape {
            size: [320, 180],
            fps: 30,
            sounds: false,
        };
        let (parts, queue) = sync_channel(1);
        let (give_back, _spent) = sync_channel(1);
        parts.send(Part::Picture(vec![128; 320 * 180 * 4])).unwrap();
        drop(parts);
        let error = encode(shape, staged, &queue, &give_back).unwrap_err();
        let said = Failure::Other(error.into()).to_string();
        for part in ["film.mp4", "is there room", "No space left"] {
            assert!(said.contains(part), "{said}");
        }
    }
}
