//! A film and an animated picture of the same pictures, without the moments in which nothing happens.

use vitriol_run::{
    AnimatedPicture, Blame, Cut, Cutting, FILM_FPS, FILM_SIZE, Failure, Film, FilmFrame, halved,
};

/// Of so many film frames the animated picture has one: 10 a second, which is what pages show it at. Chosen.
const EVERY: u64 = 3;
/// For how long it is shown, hundredths of a second.
const SHOWN: u16 = (100 * EVERY / FILM_FPS as u64) as u16;

/// Both in the making.
pub(super) struct Reel {
    film: Film,
    animated: AnimatedPicture,
    /// Frames of the film so far.
    frames: u64,
    cutting: Cutting,
}

/// Both when they are made.
pub(super) struct Reeled {
    pub(super) film: std::path::PathBuf,
    /// The animated picture's file.
    pub(super) animated: Vec<u8>,
    /// Frames of the film.
    pub(super) frames: u64,
    pub(super) cuts: Vec<Cut>,
}

impl Reel {
    /// Begins the picture beside the film.
    pub(super) fn new(film: Film) -> Result<Self, Failure> {
        Ok(Self {
            film,
            animated: AnimatedPicture::new(FILM_SIZE.map(|side| (side / 2) as u16))?,
            frames: 0,
            cutting: Cutting::default(),
        })
    }

    /// Takes the frame of that number, in which something happens or not.
    pub(super) fn take(
        &mut self,
        number: u64,
        picture: Vec<u8>,
        shown: bool,
    ) -> Result<(), Failure> {
        let frame = FilmFrame {
            number,
            pictures: vec![picture],
            shown,
            sound: Vec::new(),
        };
        let frames = self.cutting.push(frame, FILM_FPS);
        self.show(frames)
    }

    fn show(&mut self, frames: Vec<FilmFrame>) -> Result<(), Failure> {
        for picture in frames.iter().flat_map(|frame| &frame.pictures) {
            self.film.push_rgba(picture).other()?;
            if self.frames.is_multiple_of(EVERY) {
                let half = halved(picture, FILM_SIZE[0] as usize);
                self.animated.push(&half, SHOWN)?;
            }
            self.frames += 1;
        }
        Ok(())
    }

    /// Ends both.
    pub(super) fn finish(mut self) -> Result<Reeled, Failure> {
        let frames = self.cutting.rest(FILM_FPS);
        self.show(frames)?;
        Ok(Reeled {
            film: self.film.finish().other()?,
            animated: self.animated.finish()?,
            frames: self.frames,
            cuts: self.cutting.cuts(),
        })
    }
}
