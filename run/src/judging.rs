//! A lesson that is judged observation by observation, in a session and in its replay alike.
//!
//! An action that a student asks for counts behind the observation of the first step after it: a track keeps it with that step, and session
//! and replay come to it at the same observation.

use std::collections::VecDeque;

use vitriol_lesson::procedure::Progress;
use vitriol_lesson::{Event, Lesson, Mode, Procedure, Sight};

use crate::action::Action;
use crate::looks::Looked;

/// Judges a lesson in a run, from the observations of the lesson's scene.
#[derive(Clone, Debug)]
pub struct Judging {
    procedure: Procedure,
    /// The lesson's scene, by the run's name of it.
    scene: String,
    /// The last observation.
    sight: Sight,
    /// Actions that were asked for and whose observation has not come yet, each with the run's time, s.
    asked: VecDeque<(f64, Action)>,
}

impl Judging {
    /// A lesson at its beginning; the run calls its scene by that name.
    pub fn new(lesson: Lesson, mode: Mode, scene: &str) -> Self {
        Self {
            procedure: Procedure::new(lesson, mode),
            scene: scene.to_owned(),
            sight: Sight::default(),
            asked: VecDeque::new(),
        }
    }

    /// The procedure, which holds the lesson's state.
    pub fn procedure(&self) -> &Procedure {
        &self.procedure
    }

    /// Whether the scene of that name is the lesson's.
    pub fn is_of(&self, scene: &str) -> bool {
        self.scene == scene
    }

    /// Time of the last observation of its scene, s.
    pub fn time(&self) -> f64 {
        self.sight.t_s
    }

    /// Takes in an action that was asked for at the run's time `t_s`, before the step that comes next.
    pub fn ask(&mut self, t_s: f64, action: Action) {
        self.asked.push_back((t_s, action));
    }

    /// A scene is brought up before the next step: actions that were asked for since the last step were of the scene before.
    pub fn bring_up(&mut self) {
        self.asked.clear();
    }

    /// Takes in an observation of the scene of that name; in another scene than the lesson's nothing is judged. `so_far` gives the events
    /// that the attempt would end with now: where the student says that all is done, those under way count too.
    pub fn looked(
        &mut self,
        scene: &str,
        looked: &Looked,
        so_far: impl Fn() -> Vec<Event>,
    ) -> Vec<Progress> {
        let mut said = Vec::new();
        if self.is_of(scene) {
            self.sight.clone_from(&looked.sight);
            said = self.procedure.advance(&self.sight, &looked.events);
        }
        while let Some((t_s, _)) = self.asked.front()
            && *t_s < looked.t
            && let Some((_, action)) = self.asked.pop_front()
        {
            if self.is_of(scene) {
                said.extend(self.grant(&action, looked.t, &so_far));
            }
        }
        said
    }

    fn grant(
        &mut self,
        action: &Action,
        t_s: f64,
        so_far: impl Fn() -> Vec<Event>,
    ) -> Vec<Progress> {
        let judge = &mut self.procedure;
        match action {
            Action::Hint(Some(step)) => judge.ask_hint(step, t_s).into_iter().collect(),
            Action::Skip(Some(step)) => judge.skip(step, t_s),
            Action::Answer {
                step: Some(step),
                answer,
            } => {
                let said = judge.answer(step, *answer, t_s);
                if said.is_empty() {
                    tracing::warn!("answer {answer} to {step:?} is left out: no such step is open");
                }
                said
            }
            Action::Finish => {
                let mut said = judge.advance(&self.sight, &so_far());
                said.extend(judge.finish(t_s));
                said
            }
            _ => Vec::new(),
        }
    }

    /// What was found last in the scene of that name, when the attempt ended.
    pub fn ended(&mut self, scene: &str, events: &[Event]) -> Vec<Progress> {
        match self.is_of(scene) {
            true => self.procedure.advance(&self.sight, events),
            false => Vec::new(),
        }
    }
}
