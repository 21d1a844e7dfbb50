//! Judges a lesson, one observation at a time.
//!
//! All times are simulated, and the judgement depends on observations and events alone, so a replay is judged as its session was. Events
//! come only when they are over, which has consequences:
//!
//! - A pour counts for the step that is open when its event comes, if its last drop arrived after that step began. The next step begins at
//!   the time of this one's evidence, not when the event comes: a student who pours on into the next flask loses nothing.
//! - An incident counts for the step in whose time it began, and is judged before pours: a pour that went wrong is no success. A step that
//!   is done still fails if its incident is known only later; it is missed then.
//! - Rules are judged after the last step as well, for incidents that began before its end.
//!
//! A step that fails in `guided` or `free` is tried again, with a pour that begins after the failure; a step that is done then has half
//! its points, our choice. In an `examination` it is missed. What is poured cannot be taken back, so a step may have become impossible:
//! starting the scene again begins the lesson again, and [`Procedure::skip`] leaves a step out. A step whose time is up is missed in each
//! mode.
//!
//! A question takes one answer, in each mode. Where no answer is right, each one completes the step. Where one is, the step is missed with
//! another one: it has no points, its reason names the right answer, and the lesson goes on.

use std::collections::BTreeSet;

use super::condition::{Answered, Condition};
use super::file::Lesson;
use super::keeping::Keeping;
use super::mode::Mode;
use super::progress::{Progress, State, Status, StepState, Verdict, Why};
use super::record::{RuleRecord, StepRecord};
use super::sight::Sight;
use super::watch::Watch;
use crate::event::{Event, Incident, Pour};

/// Judges a lesson: takes in [`Sight`]s and [`Event`]s, returns [`Progress`].
#[derive(Clone, Debug)]
pub struct Procedure {
    pub(super) lesson: Lesson,
    pub(super) mode: Mode,
    pub(super) steps: Vec<StepRecord>,
    pub(super) rules: Vec<RuleRecord>,
    /// Flasks that a hand has held.
    lifted: BTreeSet<String>,
    /// When the lesson began, s; `None` before.
    begun: Option<f64>,
    /// When the last step was decided, s; `None` before.
    over: Option<f64>,
    /// Whether the attempt is over: nothing is judged until it begins again.
    ended: bool,
    said: Vec<Progress>,
}

impl Procedure {
    /// A lesson from its beginning, even in a mode that it does not allow: an instructor may choose.
    pub fn new(lesson: Lesson, mode: Mode) -> Self {
        Self {
            steps: vec![StepRecord::default(); lesson.steps.len()],
            rules: vec![RuleRecord::default(); lesson.rules.len()],
            lesson,
            mode,
            lifted: BTreeSet::new(),
            begun: None,
            over: None,
            ended: false,
            said: Vec::new(),
        }
    }

    /// The lesson.
    pub fn lesson(&self) -> &Lesson {
        &self.lesson
    }

    /// Takes in an observation and the events since the one before, each once. Returns what changed. An [`Event::Begun`] begins the lesson
    /// again, an [`Event::Ended`] ends it.
    pub fn advance(&mut self, sight: &Sight, events: &[Event]) -> Vec<Progress> {
        let t = sight.t_s;
        let mut rest = events;
        let begun = |event: &Event| match event {
            Event::Begun { t_s, .. } => Some(*t_s),
            _ => None,
        };
        while let Some((at, t_s)) = rest
            .iter()
            .enumerate()
            .find_map(|(at, it)| Some((at, begun(it)?)))
        {
            self.hear(&rest[..at], t);
            self.begin(t_s);
            rest = &rest[at + 1..];
        }
        if self.begun.is_none() {
            self.begin(t);
        }
        self.hear_incidents(rest, t);
        // The state is judged before and after the pours: an `all` of a pour and a state is met only where both hold at one time.
        self.see(sight);
        self.hear_pours(rest, t);
        self.see(sight);
        self.hear_end(rest);
        self.mind_time(t);
        std::mem::take(&mut self.said)
    }

    /// Ends the lesson at `t_s`, s, on the user's word: open and waiting steps are missed, and nothing is judged any more.
    pub fn finish(&mut self, t_s: f64) -> Vec<Progress> {
        self.end(t_s);
        std::mem::take(&mut self.said)
    }

    /// Gives a step's hint at `t_s`, s, at the user's request. `None` where the step is not open or the mode gives no hints.
    pub fn ask_hint(&mut self, id: &str, t_s: f64) -> Option<Progress> {
        let at = self.open(id)?;
        if !self.mode.hints_are_given() {
            return None;
        }
        self.give_hint(at, t_s, true);
        self.said.pop()
    }

    /// Leaves out an open step at `t_s`, s: it is missed. Returns nothing where the step is not open.
    pub fn skip(&mut self, id: &str, t_s: f64) -> Vec<Progress> {
        if let Some(at) = self.open(id) {
            self.fail(at, t_s, (t_s, Why::Skipped), true);
            self.settle(t_s);
        }
        std::mem::take(&mut self.said)
    }

    /// Takes in an answer, counted from 1, to the question of an open step at `t_s`, s: the step is done, or missed where another answer is
    /// right. Returns nothing where the step is not open, or has no such answer.
    pub fn answer(&mut self, id: &str, answer: u8, t_s: f64) -> Vec<Progress> {
        let question = |at: usize| Some((at, self.lesson.steps[at].condition.question()?));
        let asked = self.open(id).and_then(question);
        let Some((at, question)) = asked.filter(|(_, it)| it.has(answer)) else {
            return Vec::new();
        };
        match question.right {
            Some(right) if right != answer => {
                let why = Why::WrongAnswer { answer, right };
                self.fail(at, t_s, (t_s, why), true);
            }
            _ => self.steps[at].watch.answer(t_s),
        }
        self.settle(t_s);
        std::mem::take(&mut self.said)
    }

    /// The first open step that asks a question, by its id, and its question.
    pub fn question(&self) -> Option<(&str, Answered)> {
        let pairs = self.lesson.steps.iter().zip(&self.steps);
        let mut open = pairs.filter(|(_, tried)| tried.status == Status::Open);
        open.find_map(|(step, _)| Some((step.id.as_str(), step.condition.question()?)))
    }

    /// What is still to be met of the first open step, in the order of the file: no `all` or `any`, but their parts. Of an `any` that is
    /// not met each part is given.
    pub fn left(&self) -> Vec<&Condition> {
        let pairs = self.lesson.steps.iter().zip(&self.steps);
        let mut open = pairs.filter(|(_, tried)| tried.status == Status::Open);
        open.next()
            .map(|(step, tried)| tried.watch.left(&step.condition))
            .unwrap_or_default()
    }

    /// Status of the lesson and of each step.
    pub fn state(&self) -> State {
        let open = |it: &StepRecord| it.status == Status::Open;
        let pairs = self.lesson.steps.iter().zip(&self.steps);
        let steps = pairs.map(|(step, tried)| StepState {
            id: step.id.clone(),
            status: tried.status,
            hint: tried.hint,
            hints: tried.hints,
            failures: tried.failures,
        });
        State {
            lesson: self.lesson.name.clone(),
            mode: self.mode,
            number: self.steps.iter().position(open).map(|at| at + 1),
            over: self.over.is_some(),
            steps: steps.collect(),
        }
    }

    /// Points by now; call it after the finder's last events for the final ones.
    pub fn verdict(&self) -> Verdict {
        super::verdict::of(&self.lesson, self.mode, &self.steps, &self.rules)
    }

    fn open(&self, id: &str) -> Option<usize> {
        let at = self.lesson.steps.iter().position(|step| step.id == id)?;
        (self.steps.get(at)?.status == Status::Open).then_some(at)
    }

    fn begin(&mut self, t: f64) {
        self.steps = vec![StepRecord::default(); self.lesson.steps.len()];
        self.rules = vec![RuleRecord::default(); self.lesson.rules.len()];
        self.lifted.clear();
        (self.begun, self.over, self.ended) = (Some(t), None, false);
        self.said.push(Progress::Begun {
            t_s: t,
            lesson: self.lesson.name.clone(),
            mode: self.mode,
        });
        self.settle(t);
    }

    /// Judges events that were emitted before a new beginning.
    fn hear(&mut self, events: &[Event], t: f64) {
        self.hear_incidents(events, t);
        self.hear_pours(events, t);
        self.hear_end(events);
    }

    fn hear_incidents(&mut self, events: &[Event], t: f64) {
        for event in events {
            if let Event::Incident(incident) = event
                && !self.ended
            {
                self.hear_incident(incident, t);
            }
        }
    }

    fn hear_pours(&mut self, events: &[Event], t: f64) {
        for event in events {
            if let Event::Poured(pour) = event
                && !self.ended
            {
                self.hear_pour(pour, t);
                self.settle(t);
            }
        }
    }

    fn hear_end(&mut self, events: &[Event]) {
        for event in events {
            if let Event::Ended(ending) = event {
                self.end(ending.t_s);
            }
        }
    }

    fn hear_incident(&mut self, incident: &Incident, t: f64) {
        let (at_s, over) = (incident.t_s, self.over);
        let during = over.is_none_or(|over| at_s <= over);
        if during && self.begun.is_some_and(|begun| at_s >= begun) {
            for at in 0..self.rules.len() {
                let keep = &self.lesson.rules[at].keep;
                if let Some(why) = self.rules[at].keeping.hear(keep, incident) {
                    self.break_rule(at, t, (at_s, why));
                }
            }
        }
        for at in 0..self.steps.len() {
            let (step, tried) = (&self.lesson.steps[at], &mut self.steps[at]);
            let its = match tried.status {
                Status::Open => at_s >= tried.again.unwrap_or(tried.began),
                Status::Done => {
                    let until = tried.evidence.unwrap_or(tried.began);
                    (tried.again.unwrap_or(tried.began)..=until).contains(&at_s)
                }
                Status::Waiting | Status::Missed => false,
            };
            if !its {
                continue;
            }
            let keeps = step.keep.iter().zip(&mut tried.keeping);
            let failed = keeps.filter_map(|(keep, it)| it.hear(keep, incident));
            // Each requirement takes in the incident, though one failure is reported.
            if let Some(why) = failed.reduce(|first, _| first) {
                self.fail(at, t, (at_s, why), false);
            }
        }
    }

    fn hear_pour(&mut self, pour: &Pour, t: f64) {
        for at in 0..self.steps.len() {
            let (step, tried) = (&self.lesson.steps[at], &mut self.steps[at]);
            let early = tried.again.is_some_and(|again| pour.t_s < again);
            if tried.status != Status::Open || early || pour.until_s <= tried.began {
                continue;
            }
            if let Some(why) = tried.watch.pour(&step.condition, pour) {
                self.fail(at, t, (pour.t_s, why), false);
            }
        }
    }

    fn see(&mut self, sight: &Sight) {
        if self.ended {
            return;
        }
        let t = sight.t_s;
        let held = sight.flasks.iter().filter(|flask| flask.held);
        for flask in held {
            if !self.lifted.contains(&flask.name) {
                self.lifted.insert(flask.name.clone());
            }
        }
        if self.over.is_none() {
            for at in 0..self.rules.len() {
                let keep = &self.lesson.rules[at].keep;
                if let Some(why) = self.rules[at].keeping.see(keep, sight) {
                    self.break_rule(at, t, (t, why));
                }
            }
        }
        // An observation may complete a step and open the next, which takes in the same observation.
        loop {
            for at in 0..self.steps.len() {
                self.see_step(at, sight);
            }
            if !self.settle(t) {
                return;
            }
        }
    }

    fn see_step(&mut self, at: usize, sight: &Sight) {
        let (step, tried) = (&self.lesson.steps[at], &mut self.steps[at]);
        if tried.status != Status::Open {
            return;
        }
        let keeps = step.keep.iter().zip(&mut tried.keeping);
        let failed = keeps.filter_map(|(keep, it)| it.see(keep, sight));
        if let Some(why) = failed.reduce(|first, _| first) {
            self.fail(at, sight.t_s, (sight.t_s, why), false);
        } else if tried.keeps() {
            tried.watch.see(&step.condition, sight, &self.lifted);
        } else {
            // A new try begins once all requirements hold again.
            tried.again = Some(sight.t_s);
        }
    }

    /// Reports steps that are done, opens the next ones, and ends the lesson where none is left. Returns whether it opened any.
    fn settle(&mut self, t: f64) -> bool {
        for (step, tried) in self.lesson.steps.iter().zip(&mut self.steps) {
            if tried.status != Status::Open {
                continue;
            }
            if let Some(evidence_s) = tried.watch.met(&step.condition) {
                (tried.status, tried.evidence) = (Status::Done, Some(evidence_s));
                tried.hint = false;
                self.said.push(Progress::StepDone {
                    t_s: t,
                    id: step.id.clone(),
                    evidence_s,
                });
            }
        }
        let next: Vec<(usize, f64)> = (0..self.steps.len())
            .filter(|&at| self.steps[at].status == Status::Waiting)
            .filter_map(|at| Some((at, self.opens(at)?)))
            .collect();
        for &(at, began) in &next {
            let step = &self.lesson.steps[at];
            self.steps[at] = StepRecord {
                status: Status::Open,
                began,
                shown: t,
                waits: t,
                keeping: vec![Keeping::default(); step.keep.len()],
                ..StepRecord::default()
            };
            self.said.push(Progress::StepBegun {
                t_s: t,
                id: step.id.clone(),
            });
        }
        let left = |it: &StepRecord| matches!(it.status, Status::Waiting | Status::Open);
        if self.over.is_none() && !self.steps.iter().any(left) {
            self.over = Some(t);
            self.said.push(Progress::Over { t_s: t });
        }
        !next.is_empty()
    }

    /// Time from which on events count for a waiting step, s; `None` while a step before it is undecided.
    fn opens(&self, at: usize) -> Option<f64> {
        let begun = self.begun?;
        let before = match self.mode.one_at_a_time() {
            true => (0..at).collect(),
            false => self.lesson.before(at),
        };
        let mut decided = before.into_iter().map(|it| {
            let tried = &self.steps[it];
            match tried.status {
                Status::Done | Status::Missed => tried.evidence,
                Status::Waiting | Status::Open => None,
            }
        });
        decided.try_fold(begun, |latest, evidence| Some(latest.max(evidence?)))
    }

    /// Fails a step: it is tried again, or missed. A step that was done is not tried again.
    fn fail(&mut self, at: usize, t: f64, (evidence_s, why): (f64, Why), finally: bool) {
        let tried = &mut self.steps[at];
        let missed = finally || tried.status == Status::Done || !self.mode.tries_again();
        tried.failures += 1;
        tried.why = Some(why.clone());
        tried.hint = false;
        if missed {
            (tried.status, tried.evidence) = (Status::Missed, Some(evidence_s));
        } else {
            tried.watch = Watch::default();
            tried.again = Some(t);
            tried.waits = t;
            tried.keeping.iter_mut().for_each(Keeping::forget);
        }
        self.said.push(Progress::StepFailed {
            t_s: t,
            id: self.lesson.steps[at].id.clone(),
            evidence_s,
            why,
            missed,
        });
    }

    fn break_rule(&mut self, at: usize, t: f64, (evidence_s, why): (f64, Why)) {
        let rule = &mut self.rules[at];
        if rule.broken.is_some() {
            return;
        }
        rule.broken = Some((evidence_s, why.clone()));
        self.said.push(Progress::RuleBroken {
            t_s: t,
            id: self.lesson.rules[at].id.clone(),
            evidence_s,
            why,
        });
    }

    /// Gives hints that are due, and misses steps whose time is up.
    fn mind_time(&mut self, t: f64) {
        for at in 0..self.steps.len() {
            let (step, tried) = (&self.lesson.steps[at], &self.steps[at]);
            if tried.status != Status::Open {
                continue;
            }
            let is_up = |limit: &f64| t - tried.shown > *limit;
            let due = |after: f64| t - tried.waits >= after;
            let hint = self.mode.hints_come() && !tried.hint && step.hint_after_s.is_some_and(due);
            if let Some(limit_s) = step.time_limit_s.filter(is_up) {
                self.fail(at, t, (t, Why::TimeUp { limit_s }), true);
            } else if hint {
                self.give_hint(at, t, false);
            }
        }
        self.settle(t);
    }

    fn give_hint(&mut self, at: usize, t_s: f64, asked: bool) {
        self.steps[at].hints += 1;
        self.steps[at].hint = true;
        let id = self.lesson.steps[at].id.clone();
        self.said.push(Progress::HintDue { t_s, id, asked });
    }

    fn end(&mut self, t: f64) {
        if self.begun.is_none() || std::mem::replace(&mut self.ended, true) {
            return;
        }
        for at in 0..self.steps.len() {
            if matches!(self.steps[at].status, Status::Waiting | Status::Open) {
                self.fail(at, t, (t, Why::NotDone), true);
            }
        }
        self.settle(t);
    }
}

impl Lesson {
    /// Indices of the steps that must be decided before step `at` begins, where several are open.
    fn before(&self, at: usize) -> Vec<usize> {
        let of = |id: &String| self.steps.iter().position(|step| step.id == *id);
        let after = self.steps.get(at).map(|step| step.after.as_slice());
        after.unwrap_or_default().iter().filter_map(of).collect()
    }
}
