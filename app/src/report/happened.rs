//! The first screen: what happened, in words and points, each with its moment of the film.

use maud::{Markup, PreEscaped, html};
use vitriol_lesson::procedure::{Became, Verdict, VerdictLine};
use vitriol_lesson::{
    Attempt, Cap, Evidence, Score, ScoreLine, Sentence, Template, Texts, Tone, sentences,
};
#[cfg(feature = "class")]
use vitriol_run::page::page_in;

#[cfg(feature = "class")]
use super::html::STYLE;
use super::model::Report;

impl Report {
    /// Words and points of each attempt, beside the film.
    pub(super) fn happened(&self, texts: &Texts) -> Markup {
        let film = self.film.is_some();
        let attempts: Vec<_> = self.attempts.iter().zip(&self.score).collect();
        html! {
            section.happened.beside[film] {
                @if film { div.films { (self.films(texts)) } }
                div {
                    (words(&attempts, &self.lesson, texts, film))
                    (self.instructed(texts, film))
                }
            }
            (results(&attempts, &self.lesson, texts, film))
        }
    }
}

/// A page on a recording that nobody replayed: words, points and lesson of its attempts, without a film; or why
/// it is not graded.
#[cfg(feature = "class")]
pub fn told_page(
    title: &str,
    attempts: &[(&Attempt, &Score)],
    not_graded: Option<&str>,
    lesson: &[Verdict],
    texts: &Texts,
) -> String {
    let body = html! {
        main {
            header {
                p.kicker { (texts.report.kicker_told) }
                h1 { (title) }
            }
            section.happened {
                (words(attempts, lesson, texts, false))
                @if let Some(why) = not_graded { p { (why) } }
            }
            (results(attempts, lesson, texts, false))
        }
    };
    page_in(texts.language().code(), title, STYLE, &body)
}

/// What was done in each attempt. The points of the lesson, which are its mark, come before the program's own.
fn words(attempts: &[(&Attempt, &Score)], lesson: &[Verdict], texts: &Texts, film: bool) -> Markup {
    let (several, taught) = (attempts.len() > 1, !lesson.is_empty());
    html! {
        h2 { (texts.report.happened) }
        @for (number, (attempt, score)) in (1..).zip(attempts) {
            @let (contact, said) = contact(attempt, sentences(attempt, score, texts), texts, film);
            article.attempt {
                (contact)
                @if number == 1 { (marks(lesson, texts)) }
                (heading((number, several), taught, attempt, score, texts))
                (told(&said, texts, film))
            }
        }
    }
}

/// Points of the lesson each time that it was begun.
fn marks(lesson: &[Verdict], texts: &Texts) -> Markup {
    html! {
        @for (number, verdict) in (1_usize..).zip(lesson) {
            header {
                h3 { (begun(verdict, (lesson.len() > 1).then_some(number), texts)) }
                p.total {
                    a href=(format!("#lesson-{number}")) { (total(verdict.points, verdict.of, texts)) }
                    (bar(verdict.points, verdict.of))
                }
            }
        }
    }
}

/// Results of the lesson, and points of each attempt.
fn results(
    attempts: &[(&Attempt, &Score)],
    lesson: &[Verdict],
    texts: &Texts,
    film: bool,
) -> Markup {
    let several = attempts.len() > 1;
    // One that nothing can be judged of has said so among the words.
    let judged_of = (1_usize..)
        .zip(attempts)
        .filter(|(_, (_, score))| score.of > 0);
    html! {
        @for (number, verdict) in (1_usize..).zip(lesson) {
            section id=(format!("lesson-{number}")) {
                h2 { (begun(verdict, (lesson.len() > 1).then_some(number), texts)) }
                (judged(verdict, texts, film))
            }
        }
        @for (number, (attempt, score)) in judged_of {
            section id=(format!("score-{number}")) {
                h2 {
                    @if several { (numbered(&texts.report.score_of, number, attempt, texts)) }
                    @else { (texts.report.score) }
                }
                (points(score, texts, film))
            }
        }
    }
}

/// Heading of what a lesson came to; `number` counts how often it was begun.
fn begun(verdict: &Verdict, number: Option<usize>, texts: &Texts) -> String {
    let (lesson, mode) = (texts.lesson(&verdict.lesson), texts.mode(verdict.mode));
    let holes = [("lesson", lesson), ("mode", mode.as_str())];
    match number {
        Some(number) => {
            let [lesson, mode] = holes;
            let number = number.to_string();
            texts
                .report
                .lesson_again
                .fill(&[lesson, mode, ("number", &number)])
        }
        None => texts.report.lesson.fill(&holes),
    }
}

/// A heading with an attempt's number and scene.
fn numbered(heading: &Template, number: usize, attempt: &Attempt, texts: &Texts) -> String {
    let scene = texts.scene(&attempt.scene);
    heading.fill(&[("number", &number.to_string()), ("scene", scene)])
}

/// Points, of how many.
fn part(sentence: &Template, points: &str, of: u32) -> String {
    sentence.fill(&[("points", points), ("of", &of.to_string())])
}

/// Outcome of a step or a rule, in a word.
pub fn outcome(became: Became, texts: &Texts) -> &Template {
    let report = &texts.report;
    match became {
        Became::Done => &report.done,
        Became::Failed => &report.failed,
        Became::Missed => &report.missed,
        Became::Kept => &report.kept,
        Became::Broken => &report.broken,
    }
}

/// Outcome of a step or a rule, in words, and why it has less than full points all the same.
fn became(verdict: &Verdict, line: &VerdictLine, texts: &Texts) -> String {
    let report = &texts.report;
    let word = outcome(line.became(), texts);
    let fewer = (line.met && line.points < line.of).then(|| match line.rule {
        true => {
            let steps = || verdict.lines.iter().filter(|it| !it.rule);
            let earned: u32 = steps().map(|it| it.points).sum();
            let of: u32 = steps().map(|it| it.of).sum();
            part(&report.share_of_steps, &earned.to_string(), of)
        }
        false => report.after_failure.to_string(),
    });
    let why = line.why.as_ref().map(|why| texts.why(why));
    let sentences: Vec<String> = why.into_iter().chain(fewer).collect();
    match sentences.is_empty() {
        true => word.to_string(),
        false => format!("{word}. {}", sentences.join(" ")),
    }
}

/// A lesson's steps and rules, each with its result.
fn judged(verdict: &Verdict, texts: &Texts, film: bool) -> Markup {
    let report = &texts.report;
    let row = |line: &VerdictLine| {
        html! {
            tr {
                th scope="row" { (texts.asked(&verdict.lesson, &line.id)) p.note { @if line.rule { (report.rule) } @else { (report.step) } } }
                td { (part(&report.part, &line.points.to_string(), line.of)) (bar(line.points, line.of)) }
                td {
                    ul.said {
                        li {
                            (moment(line.evidence_s, texts, film))
                            p { (became(verdict, line, texts)) }
                        }
                    }
                }
            }
        }
    };
    html! {
        table.score {
            (heads(texts))
            tbody { @for line in &verdict.lines { (row(line)) } }
            tfoot {
                tr {
                    th scope="row" { (report.in_all) }
                    td { (part(&report.part, &verdict.points.to_string(), verdict.of)) }
                    td {}
                }
            }
        }
    }
}

/// Heads of a table of points.
fn heads(texts: &Texts) -> Markup {
    let report = &texts.report;
    html! {
        thead { tr { th { (report.criterion) } th { (report.points) } th { (report.evidence) } } }
    }
}

impl Report {
    /// What an instructor did meanwhile; nothing where nobody did.
    fn instructed(&self, texts: &Texts, film: bool) -> Markup {
        html! {
            @if !self.instructor.is_empty() {
                h4.plain { span.sign aria-hidden="true" { "·" } (texts.report.instructor) }
                ul.said {
                    @for said in &self.instructor {
                        li { (moment(Some(said.t_s), texts, film)) p { (said.text) } }
                    }
                }
            }
        }
    }
}

/// The gravest contact with acid or hot liquid, if there was one, and the sentences without the one about it.
fn contact(
    attempt: &Attempt,
    mut said: Vec<Sentence>,
    texts: &Texts,
    film: bool,
) -> (Markup, Vec<Sentence>) {
    let gravest = attempt.gravest_contact();
    let Some((gravest, words)) = gravest.and_then(|it| Some((it, texts.contact(it)?))) else {
        return (html! {}, said);
    };
    let below = texts.wrong(attempt, gravest);
    let at = |it: &Sentence| it.t_s == Some(gravest.t_s) && it.text == below;
    let more = said.iter().position(at).map(|n| said.remove(n).more);
    let markup = html! {
        div.contact {
            (moment(Some(gravest.t_s), texts, film))
            div {
                p.gravest { (words.text) }
                p { (words.amount) }
                @if let Some(more) = more.flatten() { p.note { (more) } }
            }
        }
    };
    (markup, said)
}

/// An attempt's name and points, which are told from the lesson's where it was `taught`.
fn heading(
    (number, several): (usize, bool),
    taught: bool,
    attempt: &Attempt,
    score: &Score,
    texts: &Texts,
) -> Markup {
    html! {
        header {
            @if several {
                h3 { (numbered(&texts.report.attempt, number, attempt, texts)) }
            } @else if taught {
                h3 { (texts.report.score) }
            }
            @if score.of > 0 {
                p.total {
                    a href=(format!("#score-{number}")) { (total(score.points, score.of, texts)) }
                    (bar(score.points, score.of))
                }
            } @else {
                p.total { (texts.report.no_points) }
            }
        }
    }
}

/// Points, of how many; the first number is set off.
fn total(points: u32, of: u32, texts: &Texts) -> Markup {
    let points = format!("<strong>{points}</strong>");
    // The table is the program's own, and the holes have numbers.
    PreEscaped(part(&texts.report.total, &points, of))
}

/// The sentences by tone: what went wrong first, since that is what one learns from.
fn told(sentences: &[Sentence], texts: &Texts, film: bool) -> Markup {
    let report = &texts.report;
    let groups = [
        (Tone::Bad, "bad", "✗", &report.wrong),
        (Tone::Good, "good", "✓", &report.well),
        (Tone::Plain, "plain", "·", &report.other),
    ];
    html! {
        @for (tone, class, sign, title) in groups {
            @let of_tone = || sentences.iter().filter(move |it| it.tone == tone);
            @if of_tone().next().is_some() {
                h4 class=(class) { span.sign aria-hidden="true" { (sign) } (title) }
                ul.said {
                    @for sentence in of_tone() {
                        li {
                            (moment(sentence.t_s, texts, film))
                            div {
                                p { (sentence.text) }
                                @if let Some(more) = &sentence.more { p.note { (more) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// A score's lines, each with what it was given or withheld for.
fn points(score: &Score, texts: &Texts, film: bool) -> Markup {
    let report = &texts.report;
    html! {
        table.score {
            (heads(texts))
            tbody {
                @for cap in &score.caps { (cap_row(cap, texts, film)) }
                @for line in &score.lines { (row(line, texts, film)) }
                @for left_out in &score.left_out {
                    tr {
                        th scope="row" { (left_out.criterion.name(texts)) }
                        td { (report.not_judged) }
                        td { (left_out.why) }
                    }
                }
            }
            tfoot {
                tr {
                    th scope="row" { (report.judged) }
                    td { (part(&report.part, &score.points.to_string(), score.of)) }
                    td {
                        @if score.uncapped() > score.points {
                            (report.uncapped.fill(&[("points", &score.uncapped().to_string())]))
                        }
                    }
                }
            }
        }
        p.note { (report.line) }
    }
}

fn row(line: &ScoreLine, texts: &Texts, film: bool) -> Markup {
    html! {
        tr {
            th scope="row" { (line.criterion.name(texts)) p.note { (line.rule) } }
            td { (part(&texts.report.part, &line.points.to_string(), line.of)) (bar(line.points, line.of)) }
            td { (proof(&line.evidence, texts, film)) }
        }
    }
}

/// A cap, with what it is for.
fn cap_row(cap: &Cap, texts: &Texts, film: bool) -> Markup {
    html! {
        tr {
            th scope="row" { (cap.text) }
            td { (texts.report.at_most.fill(&[("points", &cap.most.to_string())])) }
            td { (proof(&cap.evidence, texts, film)) }
        }
    }
}

fn proof(evidence: &[Evidence], texts: &Texts, film: bool) -> Markup {
    html! {
        ul.said {
            @for evidence in evidence {
                li { (moment(evidence.t_s, texts, film)) p { (evidence.text) } }
            }
        }
    }
}

/// A moment: a link into the film, where there is one.
fn moment(t_s: Option<f64>, texts: &Texts, film: bool) -> Markup {
    html! {
        @if let Some(t_s) = t_s {
            @let text = texts.with_decimal(&clock(t_s));
            @if film {
                a.moment href=(format!("#t={t_s:.3}")) title=(texts.report.show) { (text) }
            } @else {
                span.moment { (text) }
            }
        } @else {
            span {}
        }
    }
}

/// Seconds, or minutes and seconds as a film's player has them.
fn clock(t_s: f64) -> String {
    let tenths = (t_s * 10.0).round();
    if tenths < 600.0 {
        format!("{:.1}\u{a0}s", tenths / 10.0)
    } else {
        format!(
            "{}:{:04.1}",
            (tenths / 600.0).floor(),
            (tenths % 600.0) / 10.0
        )
    }
}

/// Points in a picture; the words beside it give them too.
fn bar(points: u32, of: u32) -> Markup {
    let share = 100.0 * f64::from(points) / f64::from(of.max(1));
    html! {
        span.points aria-hidden="true" { span style=(format!("width:{share:.1}%")) {} }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_lesson::{Cause, Incident, Rubric, Skin, What};

    /// Acid on a hand is said before the points and before all that went wrong, once.
    #[test]
    fn acid_on_skin_is_said_before_anything_else() {
        let texts = Texts::english().unwrap();
        let mut attempt = Attempt {
            scene: "water-into-acid".into(),
            ..Attempt::default()
        };
        let page = |attempt: &Attempt| {
            let score = Score::of(attempt, &Rubric::default(), &texts);
            let said = sentences(attempt, &score, &texts);
            let (first, said) = contact(attempt, said, &texts, true);
            let text = html! { (first) (told(&said, &texts, true)) }.into_string();
            text.replace('\u{a0}', " ")
        };
        assert!(!page(&attempt).contains("class=\"contact\""));
        let incident = |t_s: f64, what: What| Incident {
            t_s,
            until_s: t_s + 1.0,
            what,
            cause: Cause::Unknown,
            place_m: [0.0; 3],
        };
        let hot = What::Hot {
            flask: "target".into(),
            temperature_c: 150.0,
        };
        let on_hand = What::OnSkin {
            skin: Skin::RightHand,
            volume_m3: 0.12e-6,
            acid: 0.9,
            temperature_c: Some(148.0),
            protected: false,
        };
        attempt.incidents = vec![incident(1.0, hot), incident(2.0, on_hand)];
        let page = page(&attempt);
        let first = page.find("Acid at 148 °C on your hand.").unwrap();
        assert!(first < page.find("What went wrong").unwrap());
        assert!(page[..first].contains("#t=2.000"));
        assert!(!page.contains("On the skin of the right hand"));
        assert!(page.contains("Rinse at once"));
    }

    #[test]
    fn moments_are_as_a_player_says_them() {
        let said = [0.0, 1.94, 59.96, 61.0, 119.97, 754.3].map(clock);
        assert_eq!(
            said.map(|it| it.replace('\u{a0}', " ")),
            ["0.0 s", "1.9 s", "1:00.0", "1:01.0", "2:00.0", "12:34.3"]
        );
    }
}
