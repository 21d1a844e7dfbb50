//! A replay on the console: as fast as it was at most, held, slowed and ended from there.

use std::time::{Duration, Instant};

use vitriol_console::{Command, Controls, Frames, List, Order, State, Text};
use vitriol_lesson::Texts;
use vitriol_render::PassPicture;
use vitriol_run::{
    Action, Blame, Experiment, FILM_SIZE, Failure, Glimpse, Heard, Judging, Outcome, Sample,
    SimulatedTime, Taken, Worth, interrupt,
};
use vitriol_xr::PoseFrame;

use super::coder::{Coder, RawPicture};
use super::serve::Console;
use super::told::{Attempts, attempts, readings};

/// Time between two looks for orders while time is held.
const PATIENCE: Duration = Duration::from_millis(20);

/// An experiment that the console shows. What it does is what the inner one does.
pub struct Live {
    inner: Box<dyn Experiment>,
    console: Console,
    coder: Coder,
    texts: Texts,
    /// The scene that the track begins with.
    scene: String,
    time: SimulatedTime,
    controls: Controls,
    done: u64,
    /// When the next step may begin, if it is slower than the machine.
    due: Option<Instant>,
    /// How long the last step took, s.
    took: f64,
    /// The number of events that were evaluated, and the attempts in them.
    attempts: (usize, Attempts),
}

impl Live {
    /// One of a scene of that name.
    ///
    /// # Errors
    /// Where no thread can be started.
    pub fn new(
        inner: Box<dyn Experiment>,
        console: &Console,
        scene: &str,
    ) -> Result<Self, Failure> {
        Ok(Self {
            inner,
            coder: Coder::new(&console.port)?,
            console: console.clone(),
            texts: Texts::of(console.language).other()?,
            scene: scene.to_owned(),
            time: SimulatedTime::default(),
            controls: Controls::default(),
            done: 0,
            due: None,
            took: 0.0,
            attempts: (0, Attempts::default()),
        })
    }

    /// Does what was asked for, and waits for as long as time is held; then for the step's own time.
    fn obey(&mut self) -> Result<(), Failure> {
        loop {
            for Order { number, command } in self.console.port.commands() {
                match command {
                    Command::Pause { on } => self.controls.paused = on,
                    Command::SlowMotion { rate }
                        if command.check(&self.console.student).is_ok() =>
                    {
                        self.controls.rate = rate;
                    }
                    Command::End {} => {
                        interrupt::ask();
                    }
                    // A replay does again what was done.
                    _ => {}
                }
                self.done = self.done.max(number);
            }
            if self.controls.paused {
                // What was missed meanwhile is not made up for.
                self.due = None;
            }
            let left = self
                .due
                .map(|due| due.saturating_duration_since(Instant::now()));
            let waits = self.controls.paused || left.is_some_and(|left| !left.is_zero());
            if !waits {
                return Ok(());
            }
            interrupt::check()?;
            self.tell();
            std::thread::sleep(left.unwrap_or(PATIENCE).min(PATIENCE));
        }
    }

    fn tell(&mut self) {
        let Some(glimpse) = self.inner.glimpse() else {
            return;
        };
        if self.attempts.0 != glimpse.events.len() {
            self.attempts = (glimpse.events.len(), attempts(glimpse.events, &self.texts));
        }
        let state = self.state(&glimpse);
        self.console.port.publish(state);
    }

    fn state(&self, glimpse: &Glimpse<'_>) -> State {
        let (scene, switched) = glimpse.scene;
        let name = switched.unwrap_or(&self.scene);
        let mut controls = Controls {
            k_v: glimpse.intensity,
            ..self.controls.clone()
        };
        for (_, instruction) in glimpse.instructions {
            match instruction {
                Action::Mute(on) => controls.spared = *on,
                Action::Message(text) => controls.message = Text::clipped(text),
                // A recording has no time in which it was held, and its steps are as long as ever.
                _ => {}
            }
        }
        let attempts = &self.attempts.1;
        State {
            frame: self.time.steps(),
            time_s: Some(self.time.seconds()),
            scene: Text::clipped(self.texts.scene(name)),
            choice: None,
            coming: None,
            attempt: attempts.present,
            // A recording keeps what was done.
            worked: false,
            done: self.done,
            controls,
            step: None,
            hints: List::default(),
            readings: readings(scene, &self.texts, glimpse.flasks, glimpse.spilt),
            incidents: attempts.incidents.clone(),
            incidents_of_attempt: attempts.of_present,
            incidents_so_far: attempts.so_far,
            grave_so_far: attempts.grave_so_far,
            recording: None,
            frames: Frames {
                mean_s: Some(self.took),
                worst_s: None,
                period_s: Some(scene.scale.frame_time),
                missed: 0,
            },
        }
    }
}

impl Experiment for Live {
    fn step(&mut self, frame: &PoseFrame) -> Result<Taken, Failure> {
        self.obey()?;
        let begun = Instant::now();
        let taken = self.inner.step(frame)?;
        self.time.advance(taken.frame_time);
        self.took = begun.elapsed().as_secs_f64();
        let length = Duration::from_secs_f64(taken.frame_time / self.controls.rate);
        // A machine that is too slow makes up for nothing.
        let due = self.due.map_or(begun, |due| due.max(begun));
        self.due = Some(due + length);
        self.tell();
        Ok(taken)
    }

    fn sample(&mut self, t: f64) -> Result<Sample, Failure> {
        self.inner.sample(t)
    }

    fn picture(&mut self, film: usize) -> Result<&[u8], Failure> {
        let wanted = film == 0 && self.coder.is_wanted();
        let time_us = (1e6 * self.time.seconds()).round() as u64;
        let picture = self.inner.picture(film)?;
        if wanted {
            let [width, height] = FILM_SIZE;
            let whole = RawPicture::Rgba(picture.to_vec(), [width, height]);
            self.coder.give(whole, time_us);
        }
        Ok(picture)
    }

    fn worth(&self) -> Worth {
        self.inner.worth()
    }

    fn heard(&mut self) -> Result<Heard, Failure> {
        self.inner.heard()
    }

    fn passes(&mut self) -> Result<Vec<PassPicture>, Failure> {
        self.inner.passes()
    }

    fn judge(&mut self, lesson: Judging) {
        self.inner.judge(lesson);
    }

    fn glimpse(&self) -> Option<Glimpse<'_>> {
        self.inner.glimpse()
    }

    fn outcome(&mut self) -> Result<Outcome, Failure> {
        let outcome = self.inner.outcome()?;
        self.controls.ended = true;
        self.tell();
        Ok(outcome)
    }
}
