//! `grades.html`: the class in a browser, to be sorted and printed. It needs no other file but the pages that it links.

use maud::{Markup, PreEscaped, html};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use vitriol_lesson::Evidence;
use vitriol_run::page::page_in;

use super::table::{Class, Line};
use super::wrong::Words;

const STYLE: &str = include_str!("grades.css");
const SCRIPT: &str = include_str!("grades.js");

/// What a link needs no escape for. A student's name may hold anything.
const ESCAPED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_');

/// The page. Every string in it is escaped.
pub fn html(class: &Class, words: &Words) -> String {
    let texts = &words.grades;
    let shown = Shown {
        words,
        scenes: class.scenes.len() > 1,
        lessons: !class.lessons.is_empty(),
        points: class.lines.iter().any(|it| it.of.is_some_and(|of| of > 0)),
        caps: class.lines.iter().any(|it| !it.caps.is_empty()),
        verified: class.is_verified(),
    };
    let body = html! {
        main {
            header {
                p.kicker { "Vitriol" }
                h1 { (texts.title) }
                p.lead { (texts.counted(class.graded, class.otherwise, class.failed)) }
                p.note.sort { (texts.sort) }
            }
            section.wide {
                table.grades {
                    thead { (shown.heads()) }
                    tbody { @for line in &class.lines { (shown.row(line)) } }
                }
            }
        }
        script { (PreEscaped(SCRIPT)) }
    };
    page_in(words.texts.language().code(), &texts.title, STYLE, &body)
}

/// Which columns are shown: one without any entry takes room from the others.
struct Shown<'a> {
    words: &'a Words,
    scenes: bool,
    lessons: bool,
    points: bool,
    caps: bool,
    verified: bool,
}

impl Shown<'_> {
    fn heads(&self) -> Markup {
        let texts = &self.words.grades;
        html! {
            tr {
                (head(&texts.student, false))
                @if self.scenes { (head(&texts.scene, false)) }
                @if self.lessons { (head(&texts.lesson, true)) }
                @if self.points { (head(&texts.points, true)) }
                (head(&texts.first_wrong, true))
                @if self.caps { (head(&texts.cap, false)) }
                @if self.verified { (head(&texts.verified.head, false)) }
            }
        }
    }

    fn row(&self, line: &Line) -> Markup {
        let (lesson, texts) = (line.lesson.as_ref(), &self.words.grades);
        html! {
            tr {
                th scope="row" {
                    @if let Some(report) = &line.report {
                        a href=(utf8_percent_encode(report, ESCAPED).to_string()) { (line.student) }
                    } @else {
                        (line.student)
                    }
                }
                @if self.scenes { td data-head=(texts.scene) { (self.words.texts.scene(&line.scene)) } }
                @if self.lessons {
                    (points(&texts.lesson, lesson.map(|it| (it.points, it.of))))
                }
                @if self.points { (points(&texts.points, line.points.zip(line.of))) }
                (self.first_wrong(line))
                @if self.caps { td data-head=(texts.cap) { @for cap in &line.caps { p { (cap) } } } }
                @if self.verified { td data-head=(texts.verified.head) { (line.verified.map_or("–", |it| it.said(&texts.verified))) } }
            }
        }
    }

    /// What went wrong first, sorted by its moment; what is not graded comes first, and where nothing went wrong last.
    fn first_wrong(&self, line: &Line) -> Markup {
        let texts = &self.words.grades;
        let wrong = line.first_wrong.as_ref();
        let moment = match wrong {
            Some(Evidence { t_s: Some(t_s), .. }) => format!("{t_s:.3}"),
            None if line.attempt.is_none() => "-1".to_owned(),
            _ => "Infinity".to_owned(),
        };
        html! {
            td.wrong data-head=(texts.first_wrong) data-sort=(moment) {
                @if let Some(wrong) = wrong {
                    p { (self.words.texts.told(wrong)) }
                } @else if line.attempt.is_some() {
                    p { (texts.nothing) }
                }
                @if line.finished == Some(false) { p.note { (texts.broken_off) } }
                @if !line.note.is_empty() { p.note { (line.note) } }
            }
        }
    }
}

/// A column's head, which sorts by it. `number`: its cells are sorted as numbers.
fn head(text: &str, number: bool) -> Markup {
    html! {
        th scope="col" aria-sort="none" data-number[number] {
            button type="button" { (text) }
        }
    }
}

/// Points, of how many, in the column of that head.
fn points(head: &str, points: Option<(u32, u32)>) -> Markup {
    html! {
        @if let Some((points, of)) = points.filter(|(_, of)| *of > 0) {
            td.points-of data-head=(head) data-sort=(points) { (points) " / " (of) }
        } @else {
            td.points-of data-head=(head) data-sort="-1" { "–" }
        }
    }
}
