//! The lesson that a session goes through: its steps are judged look by look, and panel and console show the same.

use vitriol_console::{Said, Step, Text};
use vitriol_experiment::{Blame, Failure, Judging, Looked, Wish};
use vitriol_lesson::procedure::{Progress, Verdict};
use vitriol_lesson::{Event, Language, Lesson, Mode, Texts};

use crate::texts::LessonTexts;
use crate::vr::decision::Act;
use crate::vr::info::Shown;
use crate::vr::listing::{self, Words};

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
    course: Option<(Course, Judging)>,
    texts: Texts,
    /// Hints that were given, each with its time, s.
    hints: Vec<(f64, String)>,
    /// The step whose hint was given last.
    hinted: Option<String>,
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
                let judging = Judging::new(course.lesson.clone(), course.mode, scene);
                (course, judging)
            }),
            texts: Texts::of(language).other()?,
            hints: Vec::new(),
            hinted: None,
            failed: None,
        })
    }

    /// What the user asks for in the scene of that name, as a track keeps it; `None` where the mode has no such thing, or there is no step
    /// that it is of.
    pub fn wish(&self, scene: &str, act: Act) -> Option<Wish> {
        let (course, judging) = self.of(scene)?;
        let state = judging.procedure().state();
        if state.over || !listing::can_ask(course.mode).contains(&act) {
            return None;
        }
        let step = |id: &str| id.to_owned();
        match act {
            Act::Hint => {
                let id = listing::to_hint(&state, self.hinted.as_deref());
                id.map(step).map(Wish::Hint)
            }
            Act::Skip => {
                let open = state.steps.get(state.number? - 1);
                open.map(|it| Wish::Skip(step(&it.id)))
            }
            Act::Finish => Some(Wish::Finish),
        }
    }

    /// These were asked for, each at its simulated time before a step that was taken, s.
    pub fn asked(&mut self, asked: Vec<(f64, Wish)>) {
        if let Some((_, judging)) = &mut self.course {
            for (t_s, wish) in asked {
                judging.ask(t_s, wish);
            }
        }
    }

    /// Takes in a look at the scene of that name; of another one than the lesson's nothing is judged. `so_far` says what the attempt would
    /// end with now. What was said of it.
    pub fn looked(
        &mut self,
        scene: &str,
        looked: &Looked,
        so_far: impl Fn() -> Vec<Event>,
    ) -> Vec<Progress> {
        let judging = self.course.as_mut().map(|(_, judging)| judging);
        let said = judging.map(|it| it.looked(scene, looked, so_far));
        self.hear(said.unwrap_or_default())
    }

    /// What was found last, when the attempt ended. What was said of that.
    pub fn ended(&mut self, scene: &str, events: &[Event]) -> Vec<Progress> {
        let judging = self.course.as_mut().map(|(_, judging)| judging);
        let said = judging.map(|it| it.ended(scene, events));
        self.hear(said.unwrap_or_default())
    }

    /// Remembers what panel and console show of it.
    fn hear(&mut self, said: Vec<Progress>) -> Vec<Progress> {
        let Some((course, _)) = &self.course else {
            return said;
        };
        let texts = course.lesson.texts(course.language);
        for progress in &said {
            match progress {
                Progress::Begun { .. } => {
                    self.hints.clear();
                    (self.hinted, self.failed) = (None, None);
                }
                Progress::HintDue { t_s, id, .. } => {
                    if let Some(step) = texts.step.get(id) {
                        self.hints.push((*t_s, step.hint.clone()));
                    }
                    self.hinted = Some(id.clone());
                }
                Progress::StepFailed { t_s, why, .. } | Progress::RuleBroken { t_s, why, .. } => {
                    self.failed = Some((*t_s, self.texts.why(why)));
                }
                Progress::StepBegun { .. } | Progress::StepDone { .. } | Progress::Over { .. } => {}
            }
        }
        said
    }

    /// The lesson, where the scene of that name is its own.
    fn of(&self, scene: &str) -> Option<&(Course, Judging)> {
        let course = self.course.as_ref();
        course.filter(|(_, judging)| judging.is_of(scene))
    }

    /// Whether a user in that scene is told what was done and what went wrong: not who is examined, before the end.
    pub fn tells(&self, scene: &str) -> bool {
        let course = self.of(scene);
        course
            .is_none_or(|(course, judging)| course.mode.tells() || judging.procedure().state().over)
    }

    /// The step that is to be done in that scene, as the console shows it.
    pub fn step(&self, scene: &str) -> Option<Step> {
        let (course, judging) = self.of(scene)?;
        let state = judging.procedure().state();
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
    pub fn shown(&self, scene: &str, around: &LessonTexts) -> Option<Shown> {
        let (course, judging) = self.of(scene)?;
        let words = Words {
            around,
            texts: &self.texts,
            language: course.language,
        };
        let lately = judging.time() - SAID;
        let failed = self.failed.as_ref().filter(|(at, _)| *at >= lately);
        let failed = failed.map(|(_, why)| why.as_str());
        let hinted = self.hinted.as_deref();
        Some(listing::shown(judging.procedure(), words, hinted, failed))
    }

    /// What it comes to; `None` without a lesson.
    pub fn verdict(&self) -> Option<Verdict> {
        let judging = self.course.as_ref().map(|(_, judging)| judging);
        judging.map(|it| it.procedure().verdict())
    }
}
