//! The instructor's end of a session: the orders that come from the console, and the state that is sent to it.
//!
//! Orders act with the next frame, the student reads of each on the panel, and a recording keeps what a replay is to do again.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use vitriol_console::{
    Coming, Command, Controls, Frames, List, Points, Said, State, Step, Student, Text,
};
use vitriol_gpu::Gpu;
use vitriol_lesson::{Event, Language, Rubric, Texts};
use vitriol_run::{Action, Blame, CloseUp, Failure};
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::{Census, Held};

use crate::decision::Decision;
use crate::info::Told;
use crate::session::spills::Spilt;
use crate::view::View;
use vitriol_live::{Console, Evaluation, readings};
use vitriol_run::choices::{self, CHOICES};
use vitriol_run::texts::InstructorTexts;

/// How long the panel shows what the instructor has done, ns of the display. Our choice: it is read twice in that.
const SAID: i64 = 6_000_000_000;
/// How long the hands feel a new announcement, ns.
const FELT: i64 = 250_000_000;
/// How strongly they feel it, 0 to 1.
const STRENGTH: f32 = 0.5;
/// Time over which frames' times are sent to the console.
const LATELY: Duration = Duration::from_secs(1);

/// The state in a frame that is sent to the console.
pub(super) struct Now<'a> {
    pub frame: u64,
    /// Simulated time, s.
    pub time: f64,
    /// The scene's name, and the scene.
    pub scene: (&'a str, &'a Scene),
    /// Names of its flasks.
    pub flasks: &'a [String],
    /// Name of the scene that is being prepared to follow it.
    pub coming: Option<&'a str>,
    /// Whether a hand holds something.
    pub holds: bool,
    pub intensity: Option<f64>,
    pub spilt: Spilt,
    /// All events so far.
    pub events: &'a [Event],
    /// Gives those that there would be beside them if the attempt ended now.
    pub so_far: &'a dyn Fn() -> Vec<Event>,
    /// The display's period, s.
    pub period: Option<f64>,
    pub missed: u64,
    /// The lesson's step and points, and the hints that were given.
    pub step: Option<Step>,
    pub points: Option<Points>,
    pub hints: List<Said, 16>,
    /// Of the program's own points.
    pub rubric: &'a Rubric,
    pub ended: bool,
}

/// The instructor's end of a session: takes orders from the console, announces them on the panel, and sends the console the session's
/// state.
pub(super) struct Instructor {
    console: Option<Console>,
    /// The pictures that pages show; `None` without a console.
    pub view: Option<View>,
    /// From where the glass is seen closely.
    pub close_up: CloseUp,
    texts: Texts,
    controls: Controls,
    /// The last order that was taken up.
    done: u64,
    /// The panel's text on the last order, and the display time of the first frame that showed it, ns.
    said: Option<(String, Option<i64>)>,
    /// Liquid in each flask at the last observation.
    flasks: Vec<Held>,
    /// Processor times of the last frames, s.
    took: VecDeque<(Instant, f64)>,
    evaluation: Evaluation,
    /// The number of events before the scene's start: with the first one after them its attempt has begun.
    before: usize,
    /// Whether a hand has held something since the scene's start.
    worked: bool,
    /// The file of the session's recording.
    recording: Option<String>,
}

impl Instructor {
    /// Of a session with that console, or with none, which is told in `language`, is recorded in `record` and has pictures of `eye` pixels.
    ///
    /// # Errors
    /// [`Failure::Other`] where a text is missing, which a test rules out.
    pub fn new(
        console: Option<Console>,
        (language, record): (Language, Option<&Path>),
        (gpu, library, eye): (&Gpu, &Library, [u32; 2]),
    ) -> Result<Self, Failure> {
        // Now, and not when somebody looks: a pipeline takes longer than a frame.
        let view = console.as_ref();
        let view = view.map(|it| View::new(gpu, library, eye, &it.port));
        Ok(Self {
            view: view.transpose()?,
            close_up: CloseUp::default(),
            console,
            texts: Texts::of(language).other()?,
            controls: Controls::default(),
            done: 0,
            said: None,
            flasks: Vec::new(),
            took: VecDeque::new(),
            evaluation: Evaluation::default(),
            before: 0,
            worked: false,
            recording: record.map(|file| whole(file).display().to_string()),
        })
    }

    /// Orders since the last call, each with its number and the decision that it asks for; `None` where this program cannot carry it out,
    /// which the instructor sees as not done.
    pub fn orders(&self) -> Vec<(u64, Option<Decision>)> {
        let Some(Console { port, student, .. }) = &self.console else {
            return Vec::new();
        };
        let orders = port.commands().into_iter();
        orders
            .map(|order| (order.number, asked(order.command, student)))
            .collect()
    }

    /// An order was taken up, or cannot be: the next frame is the first in which it counts.
    pub fn taken_up(&mut self, order: u64) {
        self.done = self.done.max(order);
    }

    /// Shows on the panel what was done, from the next frame on.
    pub fn announce(&mut self, text: String) {
        self.said = Some((text, None));
    }

    /// An instruction counts from now on.
    pub fn follow(&mut self, instruction: &Action) {
        let controls = &mut self.controls;
        match instruction {
            Action::Pause(on) => controls.paused = *on,
            Action::Speed(rate) => controls.rate = *rate,
            Action::Mute(on) => controls.spared = *on,
            Action::Message(text) => controls.message = Text::clipped(text),
            // The console is sent the world's own k_v.
            _ => {}
        }
    }

    /// Whether simulated time is held.
    pub fn holds_time(&self) -> bool {
        self.controls.paused
    }

    /// Whether the boiling is muted.
    pub fn mutes_boiling(&self) -> bool {
        self.controls.spared
    }

    /// How strongly both hands feel a new announcement at `now` (ns), 0 to 1.
    pub fn felt(&self, now: i64) -> f32 {
        let at = self.said.as_ref().and_then(|(_, at)| *at);
        match at {
            Some(at) if (0..FELT).contains(&(now - at)) => STRENGTH,
            _ => 0.0,
        }
    }

    /// The panel's texts from the instructor in the frame that is shown at `now` (ns).
    pub fn told(&mut self, words: &InstructorTexts, now: i64) -> Told {
        if let Some((_, at)) = &mut self.said {
            at.get_or_insert(now);
        }
        let lately =
            |(_, at): &&(String, Option<i64>)| at.is_none_or(|at| (0..SAID).contains(&(now - at)));
        let lately = self.said.as_ref().filter(lately).map(|(text, _)| text);
        let held = self.controls.paused.then_some(&words.held);
        let message = &self.controls.message;
        // A message is shown as such.
        let shown = words.message(message);
        let lately = lately.filter(|text| Some(*text) != held && **text != shown);
        Told {
            paused: held.cloned(),
            done: lately.cloned(),
            message: (!message.is_empty()).then_some(shown),
        }
    }

    /// Takes in an observation.
    pub fn looked(&mut self, census: &Census) {
        if self.console.is_some() {
            self.flasks.clone_from(&census.flasks);
        }
    }

    /// Takes in that another bench is in use, `before` events after the run's start.
    pub fn begin(&mut self, before: usize) {
        self.before = before;
        self.close_up = CloseUp::default();
        self.flasks.clear();
        self.worked = false;
    }

    /// Takes in the time of a frame on the processor, s.
    pub fn took(&mut self, seconds: f64) {
        let now = Instant::now();
        self.took.push_back((now, seconds));
        let old = |it: &&(Instant, f64)| now.duration_since(it.0) > LATELY;
        while self.took.front().filter(old).is_some() {
            self.took.pop_front();
        }
    }

    /// Sends the console the session's present state.
    pub fn tell(&mut self, now: &Now<'_>) {
        let Some(port) = self.console.as_ref().map(|console| console.port.clone()) else {
            return;
        };
        let of = (&self.texts, now.rubric);
        self.evaluation.follow(now.events, now.so_far, of);
        self.worked |= now.holds;
        port.publish(self.state(now));
    }

    fn state(&self, now: &Now<'_>) -> State {
        let (name, scene) = now.scene;
        let attempts = self.evaluation.attempts();
        // While time is held from its start on, an attempt has no event.
        let is_new = now.events.len() == self.before;
        let coming = now.coming.map(|name| Coming {
            scene: Text::clipped(self.texts.scene(name)),
            choice: choices::index(name),
        });
        State {
            frame: now.frame,
            time_s: Some(now.time),
            scene: Text::clipped(self.texts.scene(name)),
            choice: choices::index(name),
            coming,
            attempt: attempts.present + u32::from(is_new),
            worked: self.worked,
            done: self.done,
            controls: Controls {
                k_v: now.intensity,
                ended: now.ended,
                ..self.controls.clone()
            },
            step: now.step.clone(),
            points: now.points.or(attempts.points.filter(|_| !is_new)),
            hints: now.hints.clone(),
            readings: readings(
                scene,
                now.flasks,
                &self.flasks,
                [now.spilt.bench, now.spilt.floor].map(|ml| 1e-6 * ml),
            ),
            incidents: attempts.incidents.clone(),
            incidents_of_attempt: if is_new { 0 } else { attempts.of_present },
            incidents_so_far: attempts.so_far,
            grave_so_far: attempts.grave_so_far,
            recording: self.recording.as_deref().map(Text::clipped),
            frames: self.frames(now),
        }
    }

    fn frames(&self, now: &Now<'_>) -> Frames {
        let count = self.took.len();
        let seconds = || self.took.iter().map(|(_, seconds)| *seconds);
        Frames {
            mean_s: (count > 0).then(|| seconds().sum::<f64>() / count as f64),
            worst_s: (count > 0).then(|| seconds().fold(0.0, f64::max)),
            period_s: now.period,
            missed: now.missed,
        }
    }
}

/// A file's path from the root: the instructor is told where it is, and the program's folder is unknown to the page.
fn whole(file: &Path) -> PathBuf {
    std::path::absolute(file).unwrap_or_else(|_| file.to_owned())
}

/// The decision that a command asks for; `None` where this program cannot carry it out.
fn asked(command: Command, student: &Student) -> Option<Decision> {
    command.check(student).ok()?;
    Some(Decision::Act(match command {
        Command::End {} => return Some(Decision::End),
        Command::Toggle {} => return Some(Decision::Toggle),
        Command::Scene { choice } => {
            let choice = CHOICES.get(usize::from(choice))?;
            Action::Scene(choice.scene.into())
        }
        Command::Reset {} => Action::Start(None),
        Command::KV { value } => Action::Intensity(value),
        Command::Pause { on } => Action::Pause(on),
        Command::SlowMotion { rate } => Action::Speed(rate),
        Command::Spare { on } => Action::Mute(on),
        Command::Message { text } => Action::Message(text.to_string()),
    }))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_live::student;

    /// In a session the console can ask for the other order, and is told which scenes have one; in a replay none can be asked for.
    #[test]
    fn the_other_order_can_be_asked_for() {
        let texts = Texts::english().unwrap();
        let session = student((None, &texts), true);
        let toggle = Command::Toggle {};
        assert_eq!(asked(toggle.clone(), &session), Some(Decision::Toggle));
        assert_eq!(asked(toggle, &student((None, &texts), false)), None);
        for (choice, told) in CHOICES.iter().zip(session.choices.iter()) {
            let other = told.counterpart.and_then(|at| CHOICES.get(usize::from(at)));
            let other = other.map(|other| other.scene);
            assert_eq!(other, choice.counterpart, "{}", choice.scene);
        }
        assert_eq!(session.choices.len(), CHOICES.len());
    }
}
