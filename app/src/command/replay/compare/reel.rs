//! A film and an animated picture of the same pictures, without the idle time before them.

use std::collections::VecDeque;

use vitriol_run::{AnimatedPicture, Blame, FILM_FPS, FILM_SIZE, Failure, Film, halved};

/// Film frames that are kept of what comes before liquid first leaves a flask: a second, to see how. Chosen.
const BEFORE: usize = FILM_FPS as usize;
/// Of so many film frames the animated picture has one: 10 a second, which is what pages show it at. Chosen.
const EVERY: u64 = 3;
/// For how long it is shown, hundredths of a second.
const SHOWN: u16 = (100 * EVERY / FILM_FPS as u64) as u16;

/// Both in the making.
pub(super) struct Reel {
    pub(super) film: Film,
    pub(super) animated: AnimatedPicture,
    /// Frames of the film so far.
    pub(super) frames: u64,
    /// Those that were left out before its first.
    pub(super) cut: u64,
    /// The newest ones, for which it is not known yet whether the film begins with them.
    waiting: VecDeque<Vec<u8>>,
}

impl Reel {
    /// Begins the picture beside the film.
    pub(super) fn new(film: Film) -> Result<Self, Failure> {
        Ok(Self {
            film,
            animated: AnimatedPicture::new(FILM_SIZE.map(|side| (side / 2) as u16))?,
            frames: 0,
            cut: 0,
            waiting: VecDeque::new(),
        })
    }

    /// Takes the next frame. Hands only lift and carry glass until it has `begun`, which is dull: of that the last second is kept. Nobody
    /// knows beforehand when that is, so that the newest frames wait.
    pub(super) fn take(&mut self, picture: Vec<u8>, begun: bool) -> Result<(), Failure> {
        self.waiting.push_back(picture);
        if begun {
            return self.let_go();
        }
        if self.waiting.len() > BEFORE {
            self.waiting.pop_front();
            self.cut += 1;
        }
        Ok(())
    }

    /// Films what waits: where nothing ever began, the last second is the film.
    pub(super) fn let_go(&mut self) -> Result<(), Failure> {
        while let Some(picture) = self.waiting.pop_front() {
            self.film.push_rgba(&picture).other()?;
            if self.frames.is_multiple_of(EVERY) {
                let half = halved(&picture, FILM_SIZE[0] as usize);
                self.animated.push(&half, SHOWN)?;
            }
            self.frames += 1;
        }
        Ok(())
    }
}
