//! What is kept of a run while it goes on: film, samples and progress.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::clock::{SimulatedTime, Span};
use crate::experiment::{Experiment, Heard};
use crate::failure::{Blame, Failure};
use crate::film::Film;
use crate::moment::{Moment, Watch};
use crate::progress::Progress;
use crate::sample::Sample;
use crate::subtitles::Subtitles;
use vitriol_sound::{Mixer, RATE};

/// Frame rate of the film, Hz.
pub const FILM_FPS: u32 = 30;
/// Width and height of the film, pixels.
pub const FILM_SIZE: [u32; 2] = [960, 540];

/// Samples for each simulated second: enough to see a slosh (about 3 Hz in a
/// beaker), few enough that waiting for the device does not count.
const SAMPLES_PER_SECOND: f64 = 10.0;

/// Takes film frames and samples at their times.
#[derive(Debug)]
pub struct Observer {
    span: Span,
    films: Vec<Film>,
    film_frames: u64,
    /// The films' sound, as far as their last frame.
    mixer: Mixer,
    samples: Vec<Sample>,
    /// Number of the last sample's time.
    sampled: Option<u64>,
    scenes_before: u32,
    time: SimulatedTime,
    progress: Progress,
    begin: Instant,
}

/// What an observer kept.
#[derive(Debug)]
pub struct Observations {
    /// The films' paths, in the order in which they were asked for.
    pub films: Vec<PathBuf>,
    /// Frames in each.
    pub film_frames: u64,
    /// Samples over time; the first is of the start, or of the first step after
    /// the last switch to a scene; the last is of the end.
    pub samples: Vec<Sample>,
    /// Scenes that were brought up before the one that the samples are of.
    pub scenes_before: u32,
    /// Steps and simulated time.
    pub time: SimulatedTime,
    /// Wall-clock time of the run, its film's included.
    pub wall: Duration,
}

impl Observer {
    /// An observer of a run of that span, whose progress it shows; its clock starts now.
    pub fn new(span: Span, films: Vec<Film>, progress: Progress) -> Self {
        Self {
            span,
            films,
            film_frames: 0,
            mixer: Mixer::new(0),
            samples: Vec::new(),
            sampled: None,
            scenes_before: 0,
            time: SimulatedTime::default(),
            progress,
            begin: Instant::now(),
        }
    }

    /// Ends the films and hands over what was kept.
    ///
    /// # Errors
    /// An error of a film.
    pub fn finish(self) -> Result<Observations, Failure> {
        self.finish_with(&[])
    }

    /// Ends the films as [`Observer::finish`] does, each with these subtitles.
    ///
    /// # Errors
    /// An error of a film.
    pub fn finish_with(mut self, texts: &[Subtitles]) -> Result<Observations, Failure> {
        self.sound(self.film_frames)?;
        let films = self.films.into_iter().map(|film| film.finish_with(texts));
        let films: Result<_, _> = films.collect();
        Ok(Observations {
            films: films.other()?,
            film_frames: self.film_frames,
            samples: self.samples,
            scenes_before: self.scenes_before,
            time: self.time,
            wall: self.begin.elapsed(),
        })
    }

    /// Gives the films sound as long as so many frames.
    fn sound(&mut self, frames: u64) -> Result<(), Failure> {
        let until = frames * u64::from(RATE / FILM_FPS);
        let done = (self.mixer.time() * f64::from(RATE)).round() as u64;
        let mut samples = vec![[0.0; 2]; until.saturating_sub(done) as usize];
        self.mixer.render(&mut samples);
        for film in &mut self.films {
            film.push_sound(&samples).other()?;
        }
        Ok(())
    }

    /// Film frames whose time has come: frame n shows the
    /// first state at or after n / [`FILM_FPS`] s, and the film is as long as
    /// the run. The first frame waits for the first step, which finds the
    /// neighbours that a liquid's surface is made of.
    fn film_frames_due(&self, time: &SimulatedTime) -> u64 {
        if time.steps() == 0 {
            return 0;
        }
        let fps = f64::from(FILM_FPS);
        let all = (self.span.seconds() * fps - 1e-6).ceil() as u64;
        let now = (time.seconds() * fps + 1e-6).floor() as u64 + 1;
        now.min(all)
    }
}

impl<E: Experiment + ?Sized> Watch<E> for Observer {
    fn observe(&mut self, moment: &Moment<'_>, experiment: &mut E) -> Result<(), Failure> {
        let time = &moment.time;
        self.time = *time;
        let due = self.film_frames_due(time);
        if due > self.film_frames {
            for (index, film) in self.films.iter_mut().enumerate() {
                let picture = experiment.picture(index)?;
                // More than one where a step is longer than a film frame: the
                // film keeps real time.
                for _ in self.film_frames..due {
                    film.push_rgba(picture).other()?;
                }
            }
            self.film_frames = due;
            if !self.films.is_empty() {
                // The newest frame shows what happened up to now: what happened since the one before it sounds between the two.
                let Heard { listener, events } = experiment.heard()?;
                self.mixer.listen(listener);
                events.into_iter().for_each(|event| self.mixer.push(event));
                self.sound(due - 1)?;
            }
        }
        if sample_is_due(&mut self.sampled, time) || self.span.is_over(time) {
            self.samples.push(experiment.sample(time.seconds())?);
        }
        self.progress.at(time);
        Ok(())
    }

    /// Forgets the samples: curves over both would be of neither. Films go on.
    fn start_over(&mut self) -> Result<(), Failure> {
        self.samples.clear();
        self.sampled = None;
        self.scenes_before += 1;
        Ok(())
    }
}

/// Whether the time of a sample has come since the last one, whose number is `last`.
pub fn sample_is_due(last: &mut Option<u64>, time: &SimulatedTime) -> bool {
    let number = Some((time.seconds() * SAMPLES_PER_SECOND + 1e-6).floor() as u64);
    let due = *last < number;
    if due {
        *last = number;
    }
    due
}
