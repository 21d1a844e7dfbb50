//! The lesson that a session goes through, as panel and console show it.

use vitriol_console::{Points, Said, Step, Text};
use vitriol_lesson::procedure::Progress;
use vitriol_lesson::{Language, Lesson, Mode, Texts};
use vitriol_run::{Action, Blame, Failure, Judging, Run};

use crate::info::Shown;
use crate::listing::{self, Words};
use crate::sign::asked::Asked;
use vitriol_run::texts::LessonTexts;

/// How long the panel shows why a step failed, simulated s. Our choice: it is read twice in that.
const SAID: f64 = 8.0;

/// A lesson, and how it is gone through.
#[derive(Clone, Debug)]
pub struct Course {
    /// The lesson.
    pub lesson: Lesson,
    /// The mode in which it is gone through.
    pub mode: Mode,
    /// The language of its texts.
    pub language: Language,
}

impl Course {
    /// The same for a user whose hands are moved by mouse and keyboard.
    pub(super) fn at_desk(self) -> Self {
        Self {
            lesson: self.lesson.at_desk(),
            ..self
        }
    }
}

/// What panel and console show of a lesson that the run judges. Without a lesson it shows nothing.
pub(super) struct Guide {
    course: Option<Course>,
    texts: Texts,
    /// How much of the run's progress was taken in.
    taken: usize,
    /// Hints that were given, each with its time, s.
    hints: Vec<(f64, String)>,
    /// The step whose hint was given last.
    hinted: Option<String>,
    /// Why a step failed last, and when that was reported, s.
    failed: Option<(f64, String)>,
    /// The lesson's points so far; `None` before its beginning.
    points: Option<Points>,
}

impl Guide {
    /// At the lesson's beginning.
    ///
    /// # Errors
    /// [`Failure::Other`] where a text is missing, which a test rules out.
    pub fn new(course: Option<Course>) -> Result<Self, Failure> {
        let language = course.as_ref().map_or(Language::En, |it| it.language);
        Ok(Self {
            course,
            texts: Texts::of(language).other()?,
            taken: 0,
            hints: Vec::new(),
            hinted: None,
            failed: None,
            points: None,
        })
    }

    /// The action that the user asks for in the run's scene, with the id of the step whose hint is given, that is skipped or answered.
    /// `None` where there is no lesson in this scene, it is over, its mode does not offer that action, or it has no such step or answer.
    pub fn named(&self, run: &Run, action: Action) -> Option<Action> {
        let (course, judging) = self.of(run)?;
        let state = judging.procedure().state();
        let is_answer = matches!(action, Action::Answer { .. });
        let is_offered = is_answer || listing::can_ask(course.mode).contains(&action);
        if state.over || !is_offered {
            return None;
        }
        Some(match action {
            Action::Hint(_) => {
                let id = listing::to_hint(&state, self.hinted.as_deref())?;
                Action::Hint(Some(id.to_owned()))
            }
            Action::Skip(_) => {
                let open = state.steps.get(state.number? - 1)?;
                Action::Skip(Some(open.id.clone()))
            }
            Action::Answer { answer, .. } => {
                let (id, question) = judging.procedure().question()?;
                question.has(answer).then(|| Action::Answer {
                    step: Some(id.to_owned()),
                    answer,
                })?
            }
            action => action,
        })
    }

    /// Takes in the run's progress in the lesson since the last call.
    pub fn follow(&mut self, run: &Run) {
        let new = &run.progress()[self.taken..];
        self.taken = run.progress().len();
        let Some(course) = &self.course else {
            return;
        };
        // Whatever changes the points is progress.
        if !new.is_empty() {
            let verdict = run.judging().map(|it| it.procedure().verdict());
            self.points = verdict.map(|it| Points {
                earned: it.points,
                of: it.of,
            });
        }
        let texts = course.lesson.texts(course.language);
        for progress in new {
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
                Progress::StepFailed { t_s, id, why, .. }
                | Progress::RuleBroken { t_s, id, why, .. } => {
                    self.failed = Some((*t_s, self.texts.why_of(texts, id, why)));
                }
                Progress::StepBegun { .. } | Progress::StepDone { .. } | Progress::Over { .. } => {}
            }
        }
    }

    /// The lesson, where the run's scene is its own.
    fn of<'a>(&'a self, run: &'a Run) -> Option<(&'a Course, &'a Judging)> {
        let judging = run.judging().filter(|it| it.is_of(run.scene()))?;
        Some((self.course.as_ref()?, judging))
    }

    /// Whether a user in the run's scene is told what was done and what went wrong: in an examination not before the end.
    pub fn tells(&self, run: &Run) -> bool {
        let course = self.of(run);
        course
            .is_none_or(|(course, judging)| course.mode.tells() || judging.procedure().state().over)
    }

    /// The step that is to be done in the run's scene, as the console shows it.
    pub fn step(&self, run: &Run) -> Option<Step> {
        let (course, judging) = self.of(run)?;
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

    /// What a sign asks of a first user: by the lesson's step, and in a scene without a lesson by that. In an examination there is no sign,
    /// since it would tell the step.
    pub fn asked(&self, run: &Run) -> Asked {
        let scene = run.world.scene();
        let Some((course, judging)) = self.of(run) else {
            return Asked::by_scene(scene);
        };
        match course.mode.tells() {
            true => Asked::by_step(&judging.procedure().left(), scene, run.world.worn()),
            false => Asked::Nothing,
        }
    }

    /// The lesson's points so far in the run's scene.
    pub fn points(&self, run: &Run) -> Option<Points> {
        self.of(run)?;
        self.points
    }

    /// Hints that were given, the last ones, as the console shows them.
    pub fn hints(&self) -> impl Iterator<Item = Said> {
        let last = self.hints.len().saturating_sub(16);
        self.hints[last..].iter().map(|(t_s, text)| Said {
            t_s: Some(*t_s),
            text: Text::clipped(text),
        })
    }

    /// What the panel shows of it in the run's scene.
    pub fn shown(&self, run: &Run, around: &LessonTexts) -> Option<Shown> {
        let (course, judging) = self.of(run)?;
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
}
