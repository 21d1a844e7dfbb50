//! The table of a class: for people, for a spreadsheet, for other programs.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;
use vitriol_lesson::{Criterion, SPREADSHEET_MARK, What, spreadsheet_text};
use vitriol_run::{Blame, Failure, in_a_line};

use super::graded::{Found, Graded};
use super::lesson::{Columns, OfLesson};
use super::verify::Verdict;
use crate::command::capped;

/// What `vitriol grade` prints.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Class {
    /// The scene that they are graded by.
    pub scene: String,
    /// The lesson that they are graded by, if they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lesson: Option<Columns>,
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
    /// The table for a spreadsheet, where one is kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table: Option<String>,
}

/// A line of the table: an attempt, or a track that is not graded.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Line {
    /// Pseudonym, or name of the track's file.
    pub student: String,
    /// The track's file.
    pub track: String,
    /// Whether it is graded.
    pub status: Status,
    /// The attempt, counted from 1.
    pub attempt: Option<u32>,
    /// Points.
    pub points: Option<u32>,
    /// Points that could be had.
    pub of: Option<u32>,
    /// What caps the points, with its evidence; the lowest cap first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub caps: Vec<String>,
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
    fn name(self) -> &'static str {
        match self {
            Self::Graded => "graded",
            Self::Otherwise => "otherwise",
            Self::Failed => "failed",
        }
    }
}

impl Class {
    /// Adds the lines of a track.
    pub fn add(&mut self, (student, track): (String, String), ended: &Ended) {
        let line = |status, note: &str| Line {
            student: student.clone(),
            track: track.clone(),
            status,
            note: note.into(),
            ..Line::default()
        };
        let (graded, taken) = match ended {
            Ended::Failed(error) => {
                self.failed += 1;
                self.lines.push(line(Status::Failed, error));
                return;
            }
            Ended::Well { graded, taken } => (graded, *taken),
        };
        self.taken += usize::from(taken);
        let attempts = match &graded.found {
            Found::Otherwise(why) => {
                self.otherwise += 1;
                self.lines.push(line(Status::Otherwise, why));
                return;
            }
            Found::Attempts(attempts) => attempts,
        };
        self.graded += 1;
        let verified = graded.verified.as_ref();
        let lessons = graded
            .lesson
            .iter()
            .map(Some)
            .chain(std::iter::repeat(None));
        for ((number, scored), lesson) in (1..).zip(attempts).zip(lessons) {
            let (attempt, score) = (&scored.attempt, &scored.score);
            let mut incidents = BTreeMap::new();
            for incident in &attempt.incidents {
                *incidents.entry(incident.what.kind()).or_insert(0) += 1;
            }
            let lines = score.lines.iter();
            let said = verified.map(|it| it.text()).unwrap_or_default();
            self.lines.push(Line {
                attempt: Some(number),
                points: Some(score.points),
                of: Some(score.of),
                caps: score.caps.iter().map(capped::said).collect(),
                finished: Some(attempt.ending.is_some()),
                criteria: lines.map(|it| (it.criterion, [it.points, it.of])).collect(),
                incidents,
                lesson: lesson.map(OfLesson::of),
                verified: verified.map(|it| it.verdict()),
                ..line(Status::Graded, &said)
            });
        }
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
#[derive(Clone, Debug)]
pub enum Ended {
    /// It was read.
    Well {
        /// What is in it.
        graded: Box<Graded>,
        /// Whether an earlier call left that.
        taken: bool,
    },
    /// It could not be.
    Failed(String),
}

/// The table for people.
pub fn text(class: &Class) -> String {
    let mut rows = vec![["student", "points", "verified", "incidents and notes"].map(String::from)];
    let mut before = None;
    for line in &class.lines {
        let student = in_a_line(&line.student);
        // Attempts of one recording stand together.
        let again = before == Some(&line.track);
        before = Some(&line.track);
        let points = match (line.points, line.of) {
            (Some(_), Some(0)) => "-".into(),
            (Some(points), Some(of)) => format!("{points} of {of}"),
            _ => line.status.name().into(),
        };
        let mut notes = line.caps.clone();
        notes.extend(line.lesson.as_ref().map(OfLesson::text));
        notes.extend(line.incidents.iter().map(|(kind, count)| match count {
            1 => (*kind).to_owned(),
            _ => format!("{kind} ×{count}"),
        }));
        if line.finished == Some(false) {
            notes.push("broken off".into());
        }
        notes.extend((!line.note.is_empty()).then(|| in_a_line(&line.note)));
        rows.push([
            if again { String::new() } else { student },
            points,
            line.verified.map_or("", Verdict::name).to_owned(),
            notes.join(", "),
        ]);
    }
    let mut widths = [0; 3];
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = (*width).max(cell.chars().count());
        }
    }
    let mut text = String::new();
    for [student, points, verified, notes] in &rows {
        let [a, b, c] = widths;
        // Writing to a string cannot fail.
        if c == "verified".len() && class.lines.iter().all(|it| it.verified.is_none()) {
            let _ = writeln!(text, "{student:<a$}  {points:<b$}  {notes}");
        } else {
            let _ = writeln!(text, "{student:<a$}  {points:<b$}  {verified:<c$}  {notes}");
        }
    }
    let _ = writeln!(
        text,
        "\n{} graded by {}, {} made otherwise, {} failed; {} of them as an earlier call left them",
        class.graded,
        in_a_line(&class.scene),
        class.otherwise,
        class.failed,
        class.taken
    );
    let _ = match class.refuted() {
        0 => Ok(()),
        1 => writeln!(text, "1 attempt did not happen as its recording says"),
        refuted => writeln!(
            text,
            "{refuted} attempts did not happen as their recordings say"
        ),
    };
    if let Some(table) = &class.table {
        let _ = writeln!(text, "table   {table}");
    }
    text
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
        "student", "track", "status", "attempt", "points", "of", "caps", "finished",
    ];
    let tail = ["verified", "note"];
    let head = head.into_iter().chain(criteria.iter().map(String::as_str));
    let of_lesson = class.lesson.as_ref();
    let lesson = of_lesson.map(Columns::heads).unwrap_or_default();
    let head = head.chain(What::KINDS);
    let head = head.chain(lesson.iter().map(String::as_str)).chain(tail);
    writer.write_record(head).other()?;
    for line in &class.lines {
        let number = |value: Option<u32>| value.map_or_else(String::new, |it| it.to_string());
        let mut row = vec![
            spreadsheet_text(&line.student),
            spreadsheet_text(&line.track),
            line.status.name().to_owned(),
            number(line.attempt),
            number(line.points),
            number(line.of),
            spreadsheet_text(&line.caps.join(" ")),
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
        row.extend(
            of_lesson
                .iter()
                .flat_map(|it| it.cells(line.lesson.as_ref())),
        );
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
