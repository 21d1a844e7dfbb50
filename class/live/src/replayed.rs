//! A replay on the console: as fast as it was at most, held, slowed and ended from there.

use std::time::{Duration, Instant};

use vitriol_console::{Command, Controls, Frames, List, Order, State, Text};
use vitriol_lesson::{Event, Rubric, Texts};
use vitriol_render::PassPicture;
use vitriol_run::{
    Action, Blame, Experiment, FILM_SIZE, Failure, Glimpse, Heard, Judging, Outcome, Sample,
    SimulatedTime, Taken, Worth, interrupt,
};
use vitriol_xr::PoseFrame;

use super::coder::{CLOSE_UP_EVERY, Coder, RawPicture, Viewpoint};
use super::serve::Console;
use super::told::{Evaluation, readings};

/// Time between two looks for orders while time is held.
const PATIENCE: Duration = Duration::from_millis(20);

/// An experiment that the console shows. What it does is what the inner one does.
pub struct Live {
    inner: Box<dyn Experiment>,
    console: Console,
    coder: Coder,
    texts: Texts,
    /// The lesson's, where there is one.
    rubric: Rubric,
    /// The scene that the track begins with.
    scene: String,
    /// Names of the flasks on the bench.
    flasks: Vec<String>,
    time: SimulatedTime,
    controls: Controls,
    done: u64,
    /// When the next step may begin, if it is slower than the machine.
    due: Option<Instant>,
    /// How long the last step took, s.
    took: f64,
    /// When the glass was drawn from close by last.
    close_up: Option<Instant>,
    /// The film's last picture, and when it was shown last: while time is held none follows.
    film: Option<(Vec<u8>, Instant)>,
    evaluation: Evaluation,
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
        let mut live = Self {
            inner,
            coder: Coder::new(&console.port)?,
            console: console.clone(),
            texts: Texts::of(console.language).other()?,
            rubric: Rubric::default(),
            scene: scene.to_owned(),
            flasks: Vec::new(),
            time: SimulatedTime::default(),
            controls: Controls::default(),
            done: 0,
            due: None,
            took: 0.0,
            close_up: None,
            film: None,
            evaluation: Evaluation::default(),
        };
        live.name_flasks();
        Ok(live)
    }

    /// Names the flasks of the scene that is on the bench now.
    fn name_flasks(&mut self) {
        let glimpse = self.inner.glimpse();
        self.flasks = glimpse.map_or_else(Vec::new, |it| self.texts.flasks(it.scene.0));
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
            self.show_close_up()?;
            self.show_again();
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

    /// Draws the glass from close by, where a page shows it and the next picture is due. Before the first step no neighbours are known, of
    /// which a liquid's surface is made.
    fn show_close_up(&mut self) -> Result<(), Failure> {
        if self.time.steps() == 0 || !self.coder.is_wanted(Viewpoint::CloseUp) {
            return Ok(());
        }
        let passed = self.close_up.map(|last| last.elapsed());
        if passed.is_some_and(|passed| passed < CLOSE_UP_EVERY) {
            return Ok(());
        }
        self.close_up = Some(Instant::now());
        let elapsed = passed.map_or(f64::INFINITY, |passed| passed.as_secs_f64());
        if let Some(picture) = self.inner.close_up(elapsed)? {
            let picture = RawPicture::Rgba(picture, FILM_SIZE);
            self.coder.give(picture, Viewpoint::CloseUp, self.time_us());
        }
        Ok(())
    }

    /// Shows the film's last picture where it is held: a page that comes, or comes back from the glass, has none.
    fn show_again(&mut self) {
        if !self.controls.paused || !self.coder.is_wanted(Viewpoint::Student) {
            return;
        }
        let time_us = self.time_us();
        let Some((picture, shown)) = &mut self.film else {
            return;
        };
        if shown.elapsed() >= CLOSE_UP_EVERY {
            *shown = Instant::now();
            let picture = RawPicture::Rgba(picture.clone(), FILM_SIZE);
            self.coder.give(picture, Viewpoint::Student, time_us);
        }
    }

    /// Simulated time, µs.
    fn time_us(&self) -> u64 {
        (1e6 * self.time.seconds()).round() as u64
    }

    fn tell(&mut self) {
        let Some(glimpse) = self.inner.glimpse() else {
            return;
        };
        let of = (&self.texts, &self.rubric);
        self.evaluation
            .follow(glimpse.events, || self.inner.so_far(), of);
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
        let attempts = self.evaluation.attempts();
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
            points: attempts.points,
            hints: List::default(),
            readings: readings(scene, &self.flasks, glimpse.flasks, glimpse.spilt),
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
        if taken.anew {
            self.name_flasks();
        }
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
        let time_us = self.time_us();
        let picture = self.inner.picture(film)?;
        if film == 0 {
            if self.coder.is_wanted(Viewpoint::Student) {
                let whole = RawPicture::Rgba(picture.to_vec(), FILM_SIZE);
                self.coder.give(whole, Viewpoint::Student, time_us);
            }
            self.film = Some((picture.to_vec(), Instant::now()));
        }
        Ok(picture)
    }

    fn close_up(&mut self, elapsed: f64) -> Result<Option<Vec<u8>>, Failure> {
        self.inner.close_up(elapsed)
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
        self.rubric = lesson.procedure().lesson().rubric();
        self.inner.judge(lesson);
    }

    fn glimpse(&self) -> Option<Glimpse<'_>> {
        self.inner.glimpse()
    }

    fn so_far(&self) -> Vec<Event> {
        self.inner.so_far()
    }

    fn outcome(&mut self) -> Result<Outcome, Failure> {
        let outcome = self.inner.outcome()?;
        self.controls.ended = true;
        self.tell();
        Ok(outcome)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::serve::ada;
    use vitriol_console::{Codec, Hub, Watcher};
    use vitriol_sim::scene::Scene;
    use vitriol_sim::solver::Held;

    /// Brings up its second scene with its first step, and simulates nothing.
    struct Switching {
        scenes: [Scene; 2],
        at: usize,
        held: [Held; 2],
    }

    impl Experiment for Switching {
        fn step(&mut self, _: &PoseFrame) -> Result<Taken, Failure> {
            self.at = 1;
            Ok(Taken {
                frame_time: 0.01,
                anew: true,
            })
        }

        fn sample(&mut self, _: f64) -> Result<Sample, Failure> {
            Ok(Sample::default())
        }

        fn picture(&mut self, _: usize) -> Result<&[u8], Failure> {
            Ok(&[])
        }

        fn close_up(&mut self, _: f64) -> Result<Option<Vec<u8>>, Failure> {
            let [width, height] = FILM_SIZE.map(|side| side as usize);
            Ok(Some(vec![200; 4 * width * height]))
        }

        fn heard(&mut self) -> Result<Heard, Failure> {
            Ok(Heard::default())
        }

        fn passes(&mut self) -> Result<Vec<PassPicture>, Failure> {
            Ok(Vec::new())
        }

        fn judge(&mut self, _: Judging) {}

        fn glimpse(&self) -> Option<Glimpse<'_>> {
            Some(Glimpse {
                scene: (&self.scenes[self.at], None),
                flasks: &self.held,
                spilt: [0.0; 2],
                intensity: None,
                events: &[],
                instructions: &[],
            })
        }

        fn outcome(&mut self) -> Result<Outcome, Failure> {
            Err("it has none").other()
        }
    }

    const SCENES: [&str; 2] = ["acid-into-water", "acid-on-glove"];

    /// A replay of [`Switching`], and the hub that it is shown by.
    fn live() -> (Hub, Live) {
        let (hub, console) = ada(false);
        let switching = Switching {
            scenes: SCENES.map(|name| Scene::builtin(name).unwrap()),
            at: 0,
            held: [Held::default(); 2],
        };
        let live = Live::new(Box::new(switching), &console, SCENES[0]).unwrap();
        (hub, live)
    }

    /// A page that asks for the glass from close by gets it after the next step, though no film is taken.
    #[test]
    fn a_page_that_asks_gets_the_glass_from_close_by() {
        let (hub, mut live) = live();
        live.step(&PoseFrame::default()).unwrap();
        let mut page = Watcher::enter(&hub, Codec::CloseUp).unwrap();
        let begun = Instant::now();
        while !live.coder.is_wanted(Viewpoint::CloseUp) {
            // A machine that is busy takes long.
            assert!(begun.elapsed() < Duration::from_secs(300));
            std::thread::sleep(PATIENCE);
        }
        assert!(!live.console.port.wanted().h264);
        live.step(&PoseFrame::default()).unwrap();
        assert_eq!(page.see().unwrap()[0], 4);
    }

    /// Flasks are named from the start on, which may be held, and those of a scene that was switched to by their own names.
    #[test]
    fn flasks_have_the_names_of_the_scene_on_the_bench() {
        let (_hub, mut live) = live();
        let names = |live: &Live| {
            let state = live.state(&live.inner.glimpse().unwrap());
            let flasks = state.readings.flasks.iter();
            flasks.map(|it| it.name.to_string()).collect::<Vec<_>>()
        };
        let first = ["Beaker with 98\u{a0}% acid", "Beaker with water"];
        assert_eq!(names(&live), first);
        live.step(&PoseFrame::default()).unwrap();
        assert_eq!(names(&live), ["Tray", "Bottle with water"]);
    }
}
