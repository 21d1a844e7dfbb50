//! What is kept of a run while it goes on: film, samples and progress.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::clock::{SimulatedTime, Span};
use crate::cutting::{Cut, Cutting, FilmFrame};
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
    /// Frames whose time has come.
    film_frames: u64,
    /// The films' sound, as far as their last frame.
    mixer: Mixer,
    /// The last frames, whose sound has yet to come.
    newest: VecDeque<FilmFrame>,
    cutting: Cutting,
    /// The last picture of each film.
    last: Vec<Vec<u8>>,
    posters: Option<(f64, Vec<Vec<u8>>)>,
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
    /// Where they go on at another simulated time; the first one is their begin. Empty without films.
    pub cuts: Vec<Cut>,
    /// Each film's picture of the moment that is most [worth](crate::Worth) it, of size [`FILM_SIZE`].
    pub posters: Vec<Vec<u8>>,
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
            newest: VecDeque::new(),
            cutting: Cutting::default(),
            last: Vec::new(),
            posters: None,
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
        if !self.films.is_empty() {
            self.sound();
            let mut shots: Vec<FilmFrame> = Vec::new();
            for shot in std::mem::take(&mut self.newest) {
                shots.extend(self.cutting.push(shot, FILM_FPS));
            }
            shots.extend(self.cutting.rest(FILM_FPS));
            self.show(shots)?;
        }
        let films = self.films.into_iter().map(|film| film.finish_with(texts));
        let films: Result<_, _> = films.collect();
        Ok(Observations {
            films: films.other()?,
            film_frames: self.cutting.shown(),
            cuts: self.cutting.cuts(),
            posters: self.posters.map_or_else(Vec::new, |(_, pictures)| pictures),
            samples: self.samples,
            scenes_before: self.scenes_before,
            time: self.time,
            wall: self.begin.elapsed(),
        })
    }

    /// Gives the frames that have none their sound.
    fn sound(&mut self) {
        for shot in &mut self.newest {
            shot.sound.resize((RATE / FILM_FPS) as usize, [0.0; 2]);
            self.mixer.render(&mut shot.sound);
        }
    }

    /// Takes frames up to number `due` of the state now.
    fn take<E: Experiment + ?Sized>(
        &mut self,
        due: u64,
        experiment: &mut E,
    ) -> Result<(), Failure> {
        let worth = experiment.worth();
        let mut pictures = Vec::with_capacity(self.films.len());
        for index in 0..self.films.len() {
            pictures.push(experiment.picture(index)?.to_vec());
        }
        // The newest frame shows what happened up to now: what happened since the one before it sounds between the two.
        let Heard { listener, events } = experiment.heard()?;
        self.mixer.listen(listener);
        events.into_iter().for_each(|event| self.mixer.push(event));
        let frames = self.film_frames..due;
        let repeated = frames.clone().count() - 1;
        let mut shots = frames.map(|number| FilmFrame {
            number,
            pictures: std::mem::take(&mut pictures),
            shown: worth.shown,
            sound: Vec::new(),
        });
        // All but the newest sound now: a step that is longer than a film frame has several, and the film keeps real time.
        self.newest.extend(shots.by_ref().take(repeated));
        self.sound();
        let sounded = std::mem::take(&mut self.newest);
        self.newest.extend(shots);
        self.film_frames = due;
        for shot in sounded {
            let shots = self.cutting.push(shot, FILM_FPS);
            self.show(shots)?;
        }
        let most = self.posters.as_ref().map(|(interest, _)| *interest);
        let newest = self.newest.iter().find(|it| !it.pictures.is_empty());
        if let Some(newest) = newest.filter(|_| most.is_none_or(|most| worth.interest >= most)) {
            self.posters = Some((worth.interest, newest.pictures.clone()));
        }
        Ok(())
    }

    /// Gives the films these frames.
    fn show(&mut self, shots: Vec<FilmFrame>) -> Result<(), Failure> {
        for shot in shots {
            if !shot.pictures.is_empty() {
                self.last = shot.pictures;
            }
            for (film, picture) in self.films.iter_mut().zip(&self.last) {
                film.push_rgba(picture).other()?;
                film.push_sound(&shot.sound).other()?;
            }
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
        if due > self.film_frames && !self.films.is_empty() {
            self.take(due, experiment)?;
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
