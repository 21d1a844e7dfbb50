//! The table of a class: for people, for a spreadsheet, for other programs.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use vitriol_lesson::{Criterion, Evidence, SPREADSHEET_MARK, What, spreadsheet_text};
use vitriol_run::texts::FilesTexts;
use vitriol_run::{Blame, Failure, in_a_line};

use super::graded::{Found, Graded};
use super::lesson::{self, Columns, OfLesson};
use super::tracks;
use super::verify::Verdict;
use super::wrong::Words;

/// What `vitriol grade` prints.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Class {
    /// The scenes of those that are graded.
    pub scenes: BTreeSet<String>,
    /// The lessons that they are graded by.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lessons: Vec<Columns>,
    /// Tracks that are graded.
    pub graded: usize,
    /// Tracks that were made otherwise.
    pub otherwise: usize,
    /// Tracks that cannot be graded.
    pub failed: usize,
    /// Of the first two, those whose result an earlier call left.
    pub taken: usize,
    /// A line an attempt, in the order of the tracks.
    pub lines: Vec<Line>,
    /// Files and folders that hold no recording.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub passed_over: Vec<String>,
    /// The table for a spreadsheet, where one is kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<String>,
    /// The table for a browser, likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub page: Option<String>,
}

/// A line of the table: an attempt, or a track that is not graded.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Line {
    /// Pseudonym, or name of the student's folder, or the one that the student gave, or of the track's file.
    pub student: String,
    /// The track's file.
    pub track: String,
    /// Whether it is graded.
    pub status: Status,
    /// The scene of an attempt.
    pub scene: String,
    /// The attempt, counted from 1.
    pub attempt: Option<u32>,
    /// Points.
    pub points: Option<u32>,
    /// Points that could be had.
    pub of: Option<u32>,
    /// What caps the points, with its evidence; the lowest cap first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub caps: Vec<String>,
    /// What went wrong first, in a sentence; `None` where nothing did.
    pub first_wrong: Option<Evidence>,
    /// Name of the page on the track, beside the table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub report: Option<String>,
    /// Whether it came to its end.
    pub finished: Option<bool>,
    /// Points by criterion, and of how many; of those that could be judged.
    pub criteria: BTreeMap<Criterion, [u32; 2]>,
    /// How often what went wrong, by kind.
    pub incidents: BTreeMap<&'static str, u32>,
    /// The lesson's result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lesson: Option<OfLesson>,
    /// Whether a simulation found the same; `None` where none was asked for.
    pub verified: Option<Verdict>,
    /// Remarks on the line.
    pub note: String,
}

/// What a line is of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// An attempt.
    #[default]
    Graded,
    /// A track that was made otherwise.
    Otherwise,
    /// A track that cannot be graded.
    Failed,
}

impl Status {
    /// As in JSON.
    fn name(self) -> &'static str {
        match self {
            Self::Graded => "graded",
            Self::Otherwise => "otherwise",
            Self::Failed => "failed",
        }
    }
}

impl Class {
    /// Whether simulations were asked for.
    pub fn is_verified(&self) -> bool {
        self.lines.iter().any(|it| it.verified.is_some())
    }

    /// Adds the lines of a track, whose page has that name.
    pub fn add(
        &mut self,
        (student, track, report): (String, String, Option<String>),
        ended: &Ended<'_>,
        words: &Words,
    ) {
        let line = |status, note: String| Line {
            student: student.clone(),
            track: track.clone(),
            report: report.clone(),
            status,
            note,
            ..Line::default()
        };
        let (graded, taken) = match ended {
            Ended::Failed(error) => {
                self.failed += 1;
                let why = words.grades.unread(error);
                self.lines.push(line(Status::Failed, why));
                return;
            }
            Ended::Well { graded, taken } => (graded, *taken),
        };
        self.taken += usize::from(taken);
        let attempts = match &graded.found {
            Found::Otherwise(why) => {
                self.otherwise += 1;
                let why = words.grades.otherwise(why);
                self.lines.push(line(Status::Otherwise, why));
                return;
            }
            Found::Attempts(attempts) => attempts,
        };
        self.graded += 1;
        let verified = graded.verified.as_ref();
        let verdicts = graded.lesson.iter().map(Some);
        let verdicts = verdicts.chain(std::iter::repeat(None));
        for ((number, scored), verdict) in (1..).zip(attempts).zip(verdicts) {
            let (attempt, score) = (&scored.attempt, &scored.score);
            let mut incidents = BTreeMap::new();
            for incident in &attempt.incidents {
                *incidents.entry(incident.what.kind()).or_insert(0) += 1;
            }
            let caps = score.caps.iter().map(|it| words.texts.capped(it));
            let lines = score.lines.iter();
            let said = verified.map(|it| it.text(words)).unwrap_or_default();
            self.scenes.insert(attempt.scene.clone());
            self.lines.push(Line {
                scene: attempt.scene.clone(),
                attempt: Some(number),
                points: Some(score.points),
                of: Some(score.of),
                caps: caps.map(|it| in_a_line(&it)).collect(),
                first_wrong: words.first_wrong(scored, verdict),
                finished: Some(attempt.ending.is_some()),
                criteria: lines.map(|it| (it.criterion, [it.points, it.of])).collect(),
                incidents,
                lesson: verdict.map(OfLesson::of),
                verified: verified.map(|it| it.verdict()),
                ..line(Status::Graded, said)
            });
        }
    }

    /// The first few of the tracks that cannot be graded, in a line.
    pub fn bad(&self, texts: &FilesTexts) -> String {
        let bad = self.lines.iter().filter(|it| it.status == Status::Failed);
        tracks::short(&bad.map(|it| it.track.clone()).collect::<Vec<_>>(), texts)
    }

    /// The number of tracks whose recording differs from its simulation.
    pub fn refuted(&self) -> usize {
        let lines = self.lines.iter();
        lines
            .filter(|it| it.verified == Some(Verdict::Differs))
            .count()
    }
}

/// How a track ended.
#[derive(Clone, Copy, Debug)]
pub enum Ended<'a> {
    /// It was read.
    Well {
        /// What is in it.
        graded: &'a Graded,
        /// Whether an earlier call left that.
        taken: bool,
    },
    /// It could not be.
    Failed(&'a str),
}

/// The table for people, in the teacher's language; steps and rules have their ids.
pub fn text(class: &Class, words: &Words) -> String {
    let (texts, report) = (&words.grades, &words.texts.report);
    let lessons = !class.lessons.is_empty();
    let part = |points: u32, of: u32| {
        let (points, of) = (points.to_string(), of.to_string());
        report.part.fill(&[("points", &points), ("of", &of)])
    };
    let mut rows = vec![[
        texts.student.clone(),
        texts.scene.clone(),
        texts.lesson.clone(),
        texts.points.clone(),
        texts.verified.head.clone(),
        texts.notes.clone(),
    ]];
    let mut before = None;
    for line in &class.lines {
        let student = in_a_line(&line.student);
        // Attempts of one recording stand together.
        let again = before == Some(&line.track);
        before = Some(&line.track);
        let points = match (line.status, line.points, line.of) {
            (Status::Failed, ..) => texts.failed.clone(),
            (Status::Otherwise, ..) => texts.not_graded.clone(),
            (Status::Graded, Some(points), Some(of @ 1..)) => part(points, of),
            (Status::Graded, ..) => "-".into(),
        };
        let mut notes = line.caps.clone();
        let lesson = line.lesson.as_ref();
        let unmet = lesson.map(|it| it.unmet(report));
        notes.extend(unmet.filter(|it| !it.is_empty()));
        notes.extend(line.incidents.iter().map(|(kind, count)| {
            let kind = texts.kind(kind);
            match count {
                1 => kind.to_owned(),
                _ => format!("{kind} ×{count}"),
            }
        }));
        if line.finished == Some(false) {
            notes.push(texts.broken_off.clone());
        }
        notes.extend((!line.note.is_empty()).then(|| in_a_line(&line.note)));
        rows.push([
            if again { String::new() } else { student },
            in_a_line(&line.scene),
            lesson.map_or_else(String::new, |it| part(it.points, it.of)),
            points,
            line.verified
                .map_or("", |it| it.said(&texts.verified))
                .to_owned(),
            in_one(&notes),
        ]);
    }
    let mut widths = [0; 5];
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = (*width).max(columns(cell));
        }
    }
    let mut text = String::new();
    let shown = [
        true,
        class.scenes.len() > 1,
        lessons,
        true,
        class.is_verified(),
    ];
    for [cells @ .., notes] in &rows {
        for ((cell, width), _) in cells.iter().zip(widths).zip(shown).filter(|it| it.1) {
            text += cell;
            text.extend(std::iter::repeat_n(' ', width - columns(cell) + 2));
        }
        text += notes;
        text.push('\n');
    }
    let counted = texts.counted(class.graded, class.otherwise, class.failed);
    let taken = texts.taken.fill(&[("number", &class.taken.to_string())]);
    text += &format!("\n{counted} {taken}\n");
    let scenes: Vec<String> = class.scenes.iter().map(|it| in_a_line(it)).collect();
    if !scenes.is_empty() {
        text += &format!("{}: {}\n", texts.scene, scenes.join(", "));
    }
    if class.refuted() > 0 {
        let number = class.refuted().to_string();
        text += &format!("{}\n", texts.refuted.fill(&[("number", &number)]));
    }
    for file in class.table.iter().chain(&class.page) {
        text += &format!("{file}\n");
    }
    text
}

/// Notes in one line: a space follows a sentence, a comma anything else.
fn in_one(notes: &[String]) -> String {
    let mut line = String::new();
    for note in notes {
        let between = match line.chars().next_back() {
            None => "",
            Some('.' | '。') => " ",
            Some(_) => ", ",
        };
        line += between;
        line += note;
    }
    line
}

/// Columns of a terminal that a text takes: Chinese letters and full-width marks have two.
fn columns(text: &str) -> usize {
    let wide = |it: char| matches!(it, '\u{2e80}'..='\u{9fff}' | '\u{ff00}'..='\u{ff60}');
    text.chars().map(|it| 1 + usize::from(wide(it))).sum()
}

/// The table for a spreadsheet: CSV (RFC 4180), a cell that is not known is empty.
///
/// # Errors
/// [`Failure::Other`] where there is no memory for it.
pub fn csv(class: &Class) -> Result<Vec<u8>, Failure> {
    let mut bytes = SPREADSHEET_MARK.as_bytes().to_vec();
    let mut writer = csv::WriterBuilder::new()
        .terminator(csv::Terminator::CRLF)
        .from_writer(&mut bytes);
    let criteria = Criterion::ALL.map(|it| format!("{} [points]", kebab(it)));
    let head = [
        "student",
        "track",
        "status",
        "scene",
        "attempt",
        "points",
        "of",
        "caps",
        "what went wrong first",
        "at [s]",
        "report",
        "finished",
    ];
    let tail = ["verified", "note"];
    let lesson = lesson::heads(&class.lessons);
    let head = head.into_iter().chain(criteria.iter().map(String::as_str));
    let head = head.chain(What::KINDS);
    let head = head.chain(lesson.iter().map(String::as_str)).chain(tail);
    writer.write_record(head).other()?;
    for line in &class.lines {
        let wrong = line.first_wrong.as_ref();
        let number = |value: Option<u32>| value.map_or_else(String::new, |it| it.to_string());
        let mut row = vec![
            spreadsheet_text(&line.student),
            spreadsheet_text(&line.track),
            line.status.name().to_owned(),
            spreadsheet_text(&line.scene),
            number(line.attempt),
            number(line.points),
            number(line.of),
            spreadsheet_text(&line.caps.join(" ")),
            spreadsheet_text(wrong.map_or("", |it| it.text.as_str())),
            wrong
                .and_then(|it| it.t_s)
                .map_or_else(String::new, |t_s| format!("{t_s:.1}")),
            spreadsheet_text(line.report.as_deref().unwrap_or_default()),
            line.finished
                .map_or("", |it| if it { "yes" } else { "no" })
                .to_owned(),
        ];
        let points = |it: &Criterion| number(line.criteria.get(it).map(|[points, _]| *points));
        row.extend(Criterion::ALL.iter().map(points));
        // Nothing went wrong, or nobody looked.
        let none = line.attempt.map(|_| 0);
        let count = |it: &str| number(line.incidents.get(it).copied().or(none));
        row.extend(What::KINDS.map(count));
        row.extend(lesson::cells(&lesson, line.lesson.as_ref()));
        row.push(line.verified.map_or("", Verdict::name).to_owned());
        row.push(spreadsheet_text(&line.note));
        writer.write_record(row).other()?;
    }
    writer.flush().other()?;
    drop(writer);
    Ok(bytes)
}

/// A criterion's name, as in JSON.
fn kebab(criterion: Criterion) -> String {
    let name = serde_json::to_value(criterion).unwrap_or_default();
    name.as_str().unwrap_or_default().to_owned()
}
