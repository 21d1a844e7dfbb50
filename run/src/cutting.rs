//! The film's cutting: moments in which nothing happens are left out, with their sound.

use std::collections::VecDeque;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Film frames that are shown before a moment that is worth it: half a second, in which one sees whose hand comes.
pub const LEAD: usize = 15;

/// Time over which sound that a cut has made leap comes back, s: below what is heard as a tone's change, above a click.
const SEAM: f64 = 0.003;

/// A place of the film from which on simulated time goes on as the film's does, up to the next one.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct Cut {
    /// Time of the film, s.
    pub film_s: f64,
    /// Simulated time of the run, s.
    pub t_s: f64,
}

/// A frame of the films that is to be shown, or not.
#[derive(Debug)]
pub struct FilmFrame {
    /// Its number, were nothing left out.
    pub number: u64,
    /// Its picture in each film; empty where it repeats the frame before.
    pub pictures: Vec<Vec<u8>>,
    /// Whether something happens in it.
    pub shown: bool,
    /// Its sound, left and right.
    pub sound: Vec<[f32; 2]>,
}

/// Leaves frames out.
#[derive(Debug, Default)]
pub struct Cutting {
    /// Frames of which it is open whether they are shown, without the newest, whose sound has yet to come.
    waiting: VecDeque<FilmFrame>,
    /// Number of the frame that would follow the last one that is shown, and how many are.
    next: u64,
    shown: u64,
    cuts: Vec<Cut>,
    last_sample: [f32; 2],
}

impl Cutting {
    /// Takes the next frame, and gives those that are now certain to be shown, in their order.
    pub fn push(&mut self, shot: FilmFrame, fps: u32) -> Vec<FilmFrame> {
        let shown = shot.shown;
        self.waiting.push_back(shot);
        if shown {
            return self.rest(fps);
        }
        while self.waiting.len() > LEAD {
            let dropped = self.waiting.pop_front();
            let follows = self.waiting.front_mut();
            // A frame that repeats one that is left out needs the picture.
            if let (Some(dropped), Some(follows)) = (dropped, follows)
                && follows.pictures.is_empty()
            {
                follows.pictures = dropped.pictures;
            }
        }
        Vec::new()
    }

    /// Gives the frames that wait: the film's end is shown.
    pub fn rest(&mut self, fps: u32) -> Vec<FilmFrame> {
        let mut shots: Vec<FilmFrame> = self.waiting.drain(..).collect();
        for shot in &mut shots {
            let leaps = self.shown > 0 && shot.number != self.next;
            if leaps {
                mend(&mut shot.sound, self.last_sample);
            }
            if leaps || self.shown == 0 {
                let at = |frames: u64| frames as f64 / f64::from(fps);
                self.cuts.push(Cut {
                    film_s: at(self.shown),
                    t_s: at(shot.number),
                });
            }
            self.shown += 1;
            self.next = shot.number + 1;
            self.last_sample = shot.sound.last().copied().unwrap_or_default();
        }
        shots
    }

    /// Frames that are shown so far.
    pub fn shown(&self) -> u64 {
        self.shown
    }

    /// Where the film goes on at another time; the first one is its begin.
    pub fn cuts(self) -> Vec<Cut> {
        self.cuts
    }
}

/// Lets sound begin at `before`, so that a cut does not click.
fn mend(sound: &mut [[f32; 2]], before: [f32; 2]) {
    let Some(&first) = sound.first() else { return };
    let per_sample = 1.0 / (SEAM * f64::from(vitriol_sound::RATE));
    for (index, sample) in sound.iter_mut().enumerate() {
        let left = (-(index as f64) * per_sample).exp() as f32;
        for ear in 0..2 {
            sample[ear] += left * (before[ear] - first[ear]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FPS: u32 = 30;

    fn shot(number: u64, shown: bool) -> FilmFrame {
        FilmFrame {
            number,
            pictures: vec![vec![number as u8]],
            shown,
            sound: vec![[number as f32; 2]; 1600],
        }
    }

    /// Frames that are shown of those for which `shown` holds, and the cuts.
    fn film(frames: u64, shown: impl Fn(u64) -> bool) -> (Vec<FilmFrame>, Vec<Cut>) {
        let mut cutting = Cutting::default();
        let mut film = Vec::new();
        for number in 0..frames {
            film.extend(cutting.push(shot(number, shown(number)), FPS));
        }
        film.extend(cutting.rest(FPS));
        assert_eq!(cutting.shown(), film.len() as u64);
        (film, cutting.cuts())
    }

    #[test]
    fn all_is_shown_where_something_happens() {
        let (film, cuts) = film(90, |_| true);
        assert!(film.iter().map(|shot| shot.number).eq(0..90));
        assert_eq!(
            cuts,
            [Cut {
                film_s: 0.0,
                t_s: 0.0
            }]
        );
    }

    /// Of ten idle seconds the first half and the last half are shown, and a second of the film is where the map has it.
    #[test]
    fn idle_seconds_are_left_out() {
        let (film, cuts) = film(360, |number| !(15..315).contains(&number));
        let numbers: Vec<u64> = film.iter().map(|shot| shot.number).collect();
        let expected: Vec<u64> = (0..15).chain(300..360).collect();
        assert_eq!(numbers, expected);
        assert_eq!(cuts.len(), 2);
        let cut = cuts[1];
        assert_eq!((cut.film_s, cut.t_s), (0.5, 10.0));
        assert!(
            film.iter()
                .all(|shot| shot.pictures[0][0] == shot.number as u8)
        );
    }

    /// Sound goes on from the last sample that was heard, and is its own again after some milliseconds.
    #[test]
    fn a_cut_does_not_click() {
        let (film, _) = film(360, |number| !(15..315).contains(&number));
        let after = &film[15].sound;
        assert_eq!(after[0], [14.0; 2]);
        assert!((after[1599][0] - 300.0).abs() < 0.01);
    }

    #[test]
    fn a_repeated_frame_keeps_its_picture() {
        let mut cutting = Cutting::default();
        for number in 0..100 {
            let mut shot = shot(number, false);
            if number % 3 > 0 {
                shot.pictures.clear();
            }
            assert!(cutting.push(shot, FPS).is_empty());
        }
        let rest = cutting.rest(FPS);
        assert_eq!(rest.len(), LEAD);
        assert_eq!(rest[0].pictures[0], [(100 - LEAD as u64) as u8 / 3 * 3]);
    }
}
