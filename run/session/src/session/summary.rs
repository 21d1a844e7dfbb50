//! The summary of the attempt, which the user asks for on the panel.

use vitriol_lesson::{Attempt, Event, Language, Rubric, Score, Sentence, Texts, Tone, sentences};
use vitriol_run::{Blame, Failure, Run};

use crate::info::Happened;
use vitriol_run::texts::SummaryTexts;

/// Lines of the panel that sentences have, and characters that a line has: as its font fits them at least.
const LINES: usize = 15;
const LINE: usize = 58;

/// The summary of the attempt, as the panel shows it when the user asks for it.
pub(super) struct Summary {
    texts: Texts,
    rubric: Rubric,
    /// Whether it was asked for.
    asked: bool,
    /// What is shown, and of how many events it is made.
    shown: Option<(usize, Happened)>,
    /// The number of events before the scene's start: with the first one after them the present attempt has begun.
    before: usize,
}

impl Summary {
    /// Not asked for yet, in that language, scored by `rubric`.
    ///
    /// # Errors
    /// [`Failure::Other`] where a text is missing, which a test rules out.
    pub fn new(language: Language, rubric: Rubric) -> Result<Self, Failure> {
        Ok(Self {
            texts: Texts::of(language).other()?,
            rubric,
            asked: false,
            shown: None,
            before: 0,
        })
    }

    /// The texts that it is made of.
    pub fn texts(&self) -> &Texts {
        &self.texts
    }

    /// Weights and limits of its points.
    pub fn rubric(&self) -> &Rubric {
        &self.rubric
    }

    /// Asks for the summary, or takes that back.
    pub fn toggle(&mut self) {
        self.asked = !self.asked;
        self.shown = None;
    }

    /// Hides the summary for another bench, at which the user needs the panel. There were `before` events before it.
    pub fn begin(&mut self, before: usize) {
        self.asked = false;
        self.shown = None;
        self.before = before;
    }

    /// The summary as the panel shows it, where it was asked for or the session `ends`. It covers the run's events so far and those that
    /// are still going on; it is made anew where there are more events.
    pub fn shown(&mut self, words: &SummaryTexts, run: &Run, ends: bool) -> Option<Happened> {
        if !self.asked && !ends {
            self.shown = None;
            return None;
        }
        let events = run.events();
        let old = |(count, _): &(usize, Happened)| *count != events.len();
        if self.shown.as_ref().is_none_or(old) {
            let happened = self.of(words, events, run.so_far());
            self.shown = Some((events.len(), happened));
        }
        self.shown.as_ref().map(|(_, happened)| happened.clone())
    }

    /// The summary of the last attempt in which something happened, by `events` and those of it that are still going on. Where that is not
    /// the present one, it is called so, with its scene.
    fn of(&self, words: &SummaryTexts, events: &[Event], so_far: Vec<Event>) -> Happened {
        let (title, back) = (words.title.clone(), words.back.clone());
        let attempts = Attempt::all(events.iter().cloned().chain(so_far));
        let happened = |it: &&Attempt| !it.pours.is_empty() || !it.incidents.is_empty();
        let Some(attempt) = attempts.iter().rev().find(happened) else {
            return Happened {
                title,
                said: vec![(Tone::Plain, words.nothing.clone())],
                back,
                ..Happened::default()
            };
        };
        let has_begun = events.len() > self.before;
        let is_present = has_begun && attempts.last().is_some_and(|last| happened(&last));
        let of = (!is_present).then(|| words.scene(self.texts.scene(&attempt.scene)));
        let scene_lines = of.as_ref().map_or(0, |it| columns(it).div_ceil(LINE));
        let room = LINES.saturating_sub(scene_lines);
        let score = Score::of(attempt, &self.rubric, &self.texts);
        let (said, more) = fitting(sentences(attempt, &score, &self.texts), room);
        let said = said.into_iter().map(|it| (it.tone, it.text));
        Happened {
            title: match is_present {
                true => title,
                false => words.before.clone(),
            },
            points: (score.of > 0).then(|| words.points(score.points, score.of)),
            said: (of.map(|scene| (Tone::Plain, scene)).into_iter())
                .chain(said)
                .collect(),
            more: words.more(more),
            back,
        }
    }
}

/// Sentences that fit in so many lines, in their order, and how many do not: what went wrong before what went well, and that before the
/// rest.
fn fitting(all: Vec<Sentence>, mut left: usize) -> (Vec<Sentence>, usize) {
    let lines = |it: &Sentence| columns(&it.text).div_ceil(LINE);
    let mut chosen = vec![false; all.len()];
    for tone in [Tone::Bad, Tone::Good, Tone::Plain] {
        for (sentence, chosen) in all.iter().zip(&mut chosen) {
            if sentence.tone == tone && lines(sentence) <= left {
                left -= lines(sentence);
                *chosen = true;
            }
        }
    }
    let count = all.len();
    let said: Vec<_> = (all.into_iter().zip(chosen))
        .filter_map(|(sentence, chosen)| chosen.then_some(sentence))
        .collect();
    let more = count - said.len();
    (said, more)
}

/// Width of a text in Latin characters: a Chinese one, and its full stop, are twice as wide.
fn columns(text: &str) -> usize {
    text.chars()
        .map(|it| if it >= '\u{2e80}' { 2 } else { 1 })
        .sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_chinese_character_is_twice_as_wide() {
        let long = |count| Sentence {
            text: "酸".repeat(count),
            ..sentence(Tone::Bad, 0)
        };
        assert_eq!(fitting(vec![long(LINES * LINE / 2)], LINES).1, 0);
        assert_eq!(fitting(vec![long(LINES * LINE / 2 + 1)], LINES).1, 1);
    }

    fn sentence(tone: Tone, length: usize) -> Sentence {
        Sentence {
            t_s: None,
            tone,
            text: "x".repeat(length),
            more: None,
        }
    }

    /// Of ten that take two lines, what went wrong stays, however late it came; nothing is left out without being counted.
    #[test]
    fn what_went_wrong_is_left_out_last() {
        let mut all: Vec<_> = (0..9).map(|_| sentence(Tone::Plain, LINE + 1)).collect();
        all.push(sentence(Tone::Bad, 2 * LINE));
        let (said, more) = fitting(all, LINES);
        assert_eq!((said.len(), more), (LINES / 2, 10 - LINES / 2));
        assert_eq!(said.last().unwrap().tone, Tone::Bad);
        assert_eq!(fitting(Vec::new(), LINES), (Vec::new(), 0));
    }

    /// Under another scene, or after a new start, the points of the attempt before are not taken for those of this one.
    #[test]
    fn an_earlier_attempt_is_called_so() {
        use vitriol_lesson::{Cause, Incident, What};
        use vitriol_run::texts::Texts as Words;

        let begun = |t_s, scene: &str| Event::Begun {
            t_s,
            scene: scene.to_owned(),
            contents: Default::default(),
            glass: Default::default(),
        };
        let dropped = Event::Incident(Incident {
            t_s: 1.0,
            until_s: 1.0,
            what: What::Dropped {
                flask: "source".to_owned(),
                speed_m_s: 2.0,
                broke: false,
            },
            cause: Cause::LettingGo {
                flask: "source".to_owned(),
            },
            place_m: [0.0; 3],
        });
        let mut summary = Summary::new(Language::En, Rubric::default()).unwrap();
        let words = Words::of(Language::En).unwrap().summary;
        let mut events = vec![begun(0.0, "acid-into-water"), dropped];
        let present = summary.of(&words, &events, Vec::new());
        assert_eq!(present.title, "What happened");
        // After a new start, before its first observation and with it.
        summary.begin(events.len());
        let unseen = summary.of(&words, &events, Vec::new());
        events.push(begun(5.0, "water-into-acid"));
        let seen = summary.of(&words, &events, Vec::new());
        for before in [unseen, seen] {
            assert_eq!(before.title, "What happened before");
            assert_eq!(before.points, present.points);
            let scene = (Tone::Plain, "Scene: Acid into water".to_owned());
            assert_eq!(before.said[0], scene);
            assert_eq!(before.said[1..], present.said);
        }
    }
}
