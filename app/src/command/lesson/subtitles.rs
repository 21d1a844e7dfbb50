//! The subtitles of a lesson's film, and their times: the title at its beginning, each step while it is to be done, what went wrong, the
//! points.

use vitriol_lesson::procedure::{LessonTexts, Progress, Verdict, Why};
use vitriol_lesson::{Attempt, Texts};
use vitriol_run::Cue;

use vitriol_run::texts::SummaryTexts;

/// How long the title stands at the beginning, s. Our choice.
const TITLE: f64 = 4.0;
/// How long the points stand at the end at least, s.
const POINTS: f64 = 4.0;
/// How long a subtitle shows what went wrong, s: two lines are read in that.
const NOTE: f64 = 6.0;
/// And at least, where the next thing goes wrong meanwhile, s.
const SHORTEST: f64 = 3.0;

/// The results of a track.
pub struct JudgedTrack<'a> {
    /// Progress of the lesson.
    pub progress: &'a [Progress],
    /// Attempts that were found.
    pub attempts: &'a [Attempt],
    /// What it comes to.
    pub verdict: Option<&'a Verdict>,
    /// The film's length, s.
    pub seconds: f64,
}

/// One language's texts.
pub struct SubtitleWords<'a> {
    /// The lesson's own.
    pub lesson: &'a LessonTexts,
    /// The texts on what happens.
    pub texts: &'a Texts,
    /// Around them.
    pub summary: &'a SummaryTexts,
}

/// A line, from when until when, s.
type Line = (f64, f64, String);

/// The subtitles in the order of time. Lines that stand at one time are one subtitle: title or points, the step, what went wrong.
pub fn cues(words: &SubtitleWords<'_>, told: &JudgedTrack<'_>) -> Vec<Cue> {
    let lines = [framing(words, told), steps(words, told), notes(words, told)];
    let mut times: Vec<f64> = lines
        .iter()
        .flatten()
        .flat_map(|(from, until, _)| [*from, *until])
        .collect();
    times.sort_by(f64::total_cmp);
    let mut cues: Vec<Cue> = Vec::new();
    for pair in times.windows(2) {
        let (from_s, until_s) = (pair[0], pair[1]);
        let now = lines.iter().flatten();
        let now = now.filter(|(from, until, _)| *from <= from_s && until_s <= *until);
        let texts: Vec<&str> = now.map(|(.., text)| text.as_str()).collect();
        let text = texts.join("\n");
        if from_s >= until_s || text.is_empty() {
            continue;
        }
        match cues.last_mut() {
            // What begins or ends meanwhile is empty.
            Some(last) if last.text == text && last.until_s >= from_s => last.until_s = until_s,
            _ => cues.push(Cue {
                from_s,
                until_s,
                text,
            }),
        }
    }
    cues
}

/// When the points are shown first, s.
fn points_from(told: &JudgedTrack<'_>) -> f64 {
    let over = told.progress.iter().rev().find_map(|it| match it {
        Progress::Over { t_s } => Some(Some(*t_s)),
        Progress::Begun { .. } => Some(None),
        _ => None,
    });
    let latest = told.seconds - POINTS;
    over.flatten()
        .map_or(latest, |over| over.min(latest))
        .max(0.0)
}

/// The title each time that the lesson begins, and the points.
fn framing(words: &SubtitleWords<'_>, told: &JudgedTrack<'_>) -> Vec<Line> {
    let title = &words.lesson.title;
    let ends = points_from(told);
    let begins = told.progress.iter().filter_map(|it| match it {
        Progress::Begun { t_s, .. } => Some(*t_s),
        _ => None,
    });
    let titled = begins.map(|from| (from, (from + TITLE).min(ends), title.clone()));
    let mut lines: Vec<Line> = titled.filter(|(from, until, _)| from < until).collect();
    for at in 1..lines.len() {
        lines[at - 1].1 = lines[at - 1].1.min(lines[at].0);
    }
    lines.extend(told.verdict.map(|it| {
        let points = words.summary.points(it.points, it.of);
        (ends, told.seconds, format!("{title}: {points}"))
    }));
    lines
}

/// The step that is to be done.
fn steps(words: &SubtitleWords<'_>, told: &JudgedTrack<'_>) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut open: Option<(f64, &str)> = None;
    let ends = match told.verdict {
        Some(_) => points_from(told),
        None => told.seconds,
    };
    let mut close = |open: &mut Option<(f64, &str)>, until: f64| {
        if let Some((from, id)) = open.take()
            && let Some(step) = words.lesson.step.get(id)
            && from < until.min(ends)
        {
            lines.push((from, until.min(ends), step.text.clone()));
        }
    };
    for said in told.progress {
        match said {
            Progress::Begun { t_s, .. } => close(&mut open, *t_s),
            Progress::StepBegun { t_s, id } => {
                close(&mut open, *t_s);
                open = Some((*t_s, id));
            }
            Progress::StepDone { t_s, id, .. }
            | Progress::StepFailed {
                t_s,
                id,
                missed: true,
                ..
            } if open.is_some_and(|(_, shown)| shown == id) => close(&mut open, *t_s),
            _ => {}
        }
    }
    close(&mut open, told.seconds);
    lines
}

/// What went wrong, one after the other.
fn notes(words: &SubtitleWords<'_>, told: &JudgedTrack<'_>) -> Vec<Line> {
    let texts = words.texts;
    let wrong = told.attempts.iter().flat_map(|attempt| {
        let all = attempt.incidents.iter();
        all.map(|it| (it.t_s, texts.wrong(attempt, it)))
    });
    let failed = told.progress.iter().filter_map(|it| match it {
        // Of what the film's end leaves undone the points say enough.
        Progress::StepFailed {
            why: Why::NotDone, ..
        } => None,
        Progress::StepFailed { t_s, id, why, .. } => {
            Some((*t_s, texts.why_of(words.lesson, id, why)))
        }
        _ => None,
    });
    let mut all: Vec<(f64, String)> = wrong.chain(failed).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut lines: Vec<Line> = Vec::new();
    for (at, text) in all {
        let mut from = at;
        if let Some((before, until, _)) = lines.last_mut() {
            from = from.max(*before + SHORTEST);
            *until = until.min(from);
        }
        lines.push((from, from + NOTE, text));
    }
    lines.retain(|(from, ..)| *from < told.seconds);
    if let Some((_, until, _)) = lines.last_mut() {
        *until = until.min(told.seconds);
    }
    lines
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::procedure::Procedure;
    use vitriol_lesson::{Language, Lesson, Mode};
    use vitriol_run::texts::Texts as Around;

    fn said(lesson: &Lesson, seconds: f64, over: Option<f64>, language: Language) -> Vec<Cue> {
        let (texts, around) = (Texts::of(language).unwrap(), Around::of(language).unwrap());
        let words = SubtitleWords {
            lesson: lesson.texts(language),
            texts: &texts,
            summary: &around.summary,
        };
        let begun = |t_s, id: &str| Progress::StepBegun { t_s, id: id.into() };
        let done = |t_s, id: &str| Progress::StepDone {
            t_s,
            id: id.into(),
            evidence_s: t_s - 1.0,
        };
        let mut progress = vec![
            Progress::Begun {
                t_s: 0.0,
                lesson: lesson.name.clone(),
                mode: Mode::Guided,
            },
            begun(0.0, "lift"),
            done(2.0, "lift"),
            begun(2.0, "pour"),
            Progress::StepFailed {
                t_s: 9.0,
                id: "pour".into(),
                evidence_s: 7.0,
                why: Why::TooFast {
                    rate_m3_s: 36e-6,
                    limit_m3_s: 5e-6,
                },
                missed: false,
            },
            Progress::StepFailed {
                t_s: 10.0,
                id: "pour".into(),
                evidence_s: 7.0,
                why: Why::Skipped,
                missed: true,
            },
        ];
        progress.extend(over.map(|t_s| Progress::Over { t_s }));
        let verdict = Procedure::new(lesson.clone(), Mode::Guided).verdict();
        let told = JudgedTrack {
            progress: &progress,
            attempts: &[],
            verdict: Some(&verdict),
            seconds,
        };
        cues(&words, &told)
    }

    /// Title, step, what went wrong and the points, each at its time, in each language its own.
    #[test]
    fn each_text_stands_at_its_time() {
        let lesson = Lesson::builtin("dilute").unwrap();
        for language in Language::ALL {
            let (words, texts) = (lesson.texts(language), Texts::of(language).unwrap());
            let step = |id: &str| words.step[id].text.clone();
            let too_fast = texts.why(&Why::TooFast {
                rate_m3_s: 36e-6,
                limit_m3_s: 5e-6,
            });
            let left_out = texts.why(&Why::Skipped);
            let points = Around::of(language).unwrap().summary.points(0, 100);
            let points = format!("{}: {points}", words.title);
            let expected = [
                (0.0, 2.0, format!("{}\n{}", words.title, step("lift"))),
                (2.0, 4.0, format!("{}\n{}", words.title, step("pour"))),
                (4.0, 9.0, step("pour")),
                (9.0, 10.0, format!("{}\n{too_fast}", step("pour"))),
                (10.0, 12.0, too_fast),
                (12.0, 16.0, left_out.clone()),
                (16.0, 18.0, format!("{points}\n{left_out}")),
                (18.0, 20.0, points),
            ];
            let cues = said(&lesson, 20.0, None, language);
            let found = cues.iter();
            let found: Vec<_> = found
                .map(|it| (it.from_s, it.until_s, it.text.clone()))
                .collect();
            assert_eq!(found, expected, "{language}");
        }
    }

    /// Points stand from the lesson's end on, or the last seconds, and in a film that is shorter than they stand all the time.
    #[test]
    fn points_stand_at_the_end() {
        let lesson = Lesson::builtin("dilute").unwrap();
        for (seconds, over, from) in [
            (30.0, Some(14.0), 14.0),
            (30.0, Some(29.0), 26.0),
            (30.0, None, 26.0),
            (2.0, None, 0.0),
        ] {
            let cues = said(&lesson, seconds, over, Language::En);
            let points = |it: &&Cue| it.text.contains("points");
            assert_eq!(cues.iter().find(points).unwrap().from_s, from);
            assert_eq!(cues.last().unwrap().until_s, seconds);
            let in_order = |pair: &[Cue]| pair[0].until_s <= pair[1].from_s;
            assert!(cues.windows(2).all(in_order), "{cues:?}");
        }
    }
}
