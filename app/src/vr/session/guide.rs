//! The lesson that a session goes through: its steps are judged look by look, and panel and console show the same.

use vitriol_console::{Said, Step, Text};
use vitriol_experiment::{Blame, Failure, Looked};
use vitriol_lesson::procedure::{Progress, Status, Verdict};
use vitriol_lesson::{Event, Language, Lesson, Mode, Procedure, Sight, Texts};

use crate::vr::info::Shown;
use crate::vr::texts::LessonTexts;

/// How long the panel says why a step failed, simulated s. Our choice: it is read twice in that.
const SAID: f64 = 8.0;

/// A lesson, and how it is gone through.
#[derive(Clone, Debug)]
pub struct Course {
    /// The lesson.
    pub lesson: Lesson,
    /// How.
    pub mode: Mode,
    /// In which language its texts are.
    pub language: Language,
}

/// See the module. Without a lesson it says nothing.
pub(super) struct Guide {
    course: Option<(Course, Procedure)>,
    /// Its scene, by the session's name of it.
    scene: String,
    texts: Texts,
    /// The last look.
    sight: Sight,
    /// Hints that were given, each with its time, s.
    hints: Vec<(f64, String)>,
    /// Why a step failed last, and when that was said, s.
    failed: Option<(f64, String)>,
}

impl Guide {
    /// At the lesson's beginning, in the scene of that name.
    ///
    /// # Errors
    /// [`Failure::Other`] where a text is missing, which a test rules out.
    pub fn new(course: Option<Course>, scene: &str) -> Result<Self, Failure> {
        let language = course.as_ref().map_or(Language::En, |it| it.language);
        Ok(Self {
            course: course.map(|course| {
                let judge = Procedure::new(course.lesson.clone(), course.mode);
                (course, judge)
            }),
            scene: scene.to_owned(),
            texts: Texts::of(language).other()?,
            sight: Sight::default(),
            hints: Vec::new(),
            failed: None,
        })
    }

    /// Takes in a look at the scene of that name; of another one than the lesson's nothing is judged.
    pub fn looked(&mut self, scene: &str, looked: &Looked) {
        self.sight.clone_from(&looked.sight);
        self.judge(scene, &looked.events);
    }

    /// What was found last, when the attempt ended.
    pub fn ended(&mut self, scene: &str, events: &[Event]) {
        self.judge(scene, events);
    }

    fn judge(&mut self, scene: &str, events: &[Event]) {
        let Some((course, judge)) = &mut self.course else {
            return;
        };
        if self.scene != scene {
            return;
        }
        let texts = course.lesson.texts(course.language);
        for progress in judge.advance(&self.sight, events) {
            match progress {
                Progress::Begun { .. } => {
                    self.hints.clear();
                    self.failed = None;
                }
                Progress::HintDue { t_s, id, .. } => {
                    if let Some(step) = texts.step.get(&id) {
                        self.hints.push((t_s, step.hint.clone()));
                    }
                }
                Progress::StepFailed { t_s, why, .. } | Progress::RuleBroken { t_s, why, .. } => {
                    self.failed = Some((t_s, self.texts.why(&why)));
                }
                Progress::StepBegun { .. } | Progress::StepDone { .. } | Progress::Over { .. } => {}
            }
        }
    }

    /// The lesson, where the scene of that name is its own.
    fn of(&self, scene: &str) -> Option<&(Course, Procedure)> {
        self.course.as_ref().filter(|_| self.scene == scene)
    }

    /// The step that is to be done in that scene, as the console shows it.
    pub fn step(&self, scene: &str) -> Option<Step> {
        let (course, judge) = self.of(scene)?;
        let state = judge.state();
        let texts = course.lesson.texts(course.language);
        let id = state.number.and_then(|number| state.steps.get(number - 1));
        let title = id.and_then(|step| texts.step.get(&step.id));
        Some(Step {
            number: state.number.unwrap_or(state.steps.len() + 1) as u16,
            of: state.steps.len() as u16,
            title: Text::clipped(title.map_or(&texts.title, |step| &step.text)),
        })
    }

    /// Hints that were given, the last ones, as the console shows them.
    pub fn hints(&self) -> impl Iterator<Item = Said> {
        let last = self.hints.len().saturating_sub(16);
        self.hints[last..].iter().map(|(t_s, text)| Said {
            t_s: Some(*t_s),
            text: Text::clipped(text),
        })
    }

    /// What the panel shows of it in that scene.
    pub fn shown(&self, scene: &str, words: &LessonTexts) -> Option<Shown> {
        let (course, judge) = self.of(scene)?;
        let state = judge.state();
        let texts = course.lesson.texts(course.language);
        if state.over {
            let verdict = judge.verdict();
            let points = words.points(verdict.points, verdict.of);
            return Some(Shown {
                step: format!("{}: {points}", texts.title),
                ..Shown::default()
            });
        }
        if !state.mode.tells() {
            // Who is examined is told the task, and no step.
            return Some(Shown {
                step: format!("{}: {}", texts.title, texts.summary),
                ..Shown::default()
            });
        }
        let open = (state.steps.iter()).filter(|step| step.status == Status::Open);
        let mut all = open.filter_map(|step| Some((step, texts.step.get(&step.id)?)));
        let (step, text) = all.next()?;
        let number = state.number.unwrap_or(1);
        let lately = self.sight.t_s - SAID;
        let failed = self.failed.as_ref().filter(|(at, _)| *at >= lately);
        Some(Shown {
            step: words.step(number, state.steps.len(), &text.text),
            hint: step.hint.then(|| text.hint.clone()),
            failed: failed.map(|(_, why)| why.clone()),
        })
    }

    /// What it comes to; `None` without a lesson.
    pub fn verdict(&self) -> Option<Verdict> {
        self.course.as_ref().map(|(_, judge)| judge.verdict())
    }
}
