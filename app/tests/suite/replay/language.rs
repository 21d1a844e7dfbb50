//! The report in the language that is asked for.

use std::fs;

use vitriol::command::replay::run;
use vitriol::report::{InstructorStatement, Report};
use vitriol_lesson::procedure::{Verdict, VerdictLine, Why};
use vitriol_lesson::{Language, Mode, Rubric, Texts};
use vitriol_run::{Experiment, Format, Setup};

use super::told;
use super::toy::{Toy, asked, replay, report_of};

/// Title, scenes, flasks and sentences are in the language that is asked for, and the command line asks for it again.
#[test]
fn a_report_speaks_the_language_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let german = ["--seconds", "0.1", "--no-video", "--language", "de"];
    replay(folder.path(), &german, u64::MAX).unwrap();
    let report = report_of(folder.path());
    assert!(report.command.contains(" --language de"));
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("<h1>Wasser und zwei Bechergläser</h1>"));
    let page = told(report).0.to_html(&Texts::of(Language::De).unwrap());
    for part in [
        "<h1>Wasser wurde in konzentrierte Säure gegossen</h1>",
        "Das Becherglas mit 98-prozentiger Säure kochte über",
    ] {
        assert!(page.contains(part), "{part}");
    }
}

/// The report of a run with heat, of two attempts at a lesson, with an instructor.
fn full() -> Report {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let arguments = "vitriol replay two-flasks --scene water-into-acid --seconds 1 --out";
    let arguments = arguments.split(' ').chain([out.to_str().unwrap()]);
    let hot = |_: &Setup<'_>| {
        let toy = Toy {
            hot: true,
            ..Toy::new(u64::MAX)
        };
        Ok(Box::new(toy) as Box<dyn Experiment>)
    };
    run(&asked(arguments), Format::Json, hot).unwrap();
    let (mut report, _) = told(report_of(&out));
    let line = |rule, met, why: Option<Why>| VerdictLine {
        id: "own".into(),
        rule,
        met,
        evidence_s: Some(0.5),
        why,
        failures: 1,
        hints: 0,
        points: 5,
        of: 10,
    };
    let open = Why::SashOpen {
        height_m: 0.3,
        limit_m: 0.2,
    };
    let lines = vec![
        line(false, true, None),
        line(false, false, Some(Why::NotDone)),
        line(false, false, Some(open.clone())),
        line(true, true, None),
        line(true, false, Some(open)),
    ];
    let verdict = Verdict {
        lesson: "dilute".into(),
        mode: Mode::Free,
        points: 5,
        of: 10,
        lines,
    };
    report.lesson = vec![verdict.clone(), verdict];
    report.recording = None;
    report.instructor = vec![InstructorStatement {
        t_s: 0.5,
        text: "…".into(),
    }];
    report
}

/// Sentences that a page shows, and attributes that are read out. The solver's tables are for who knows it, and English.
fn shown(page: &str) -> Vec<String> {
    let body = &page[page.find("<body>").unwrap()..page.find("<script>").unwrap()];
    let (before, tables) = body.split_once("<section class=\"statements\"").unwrap();
    let (_, after) = tables.split_once("</section>").unwrap();
    let mut found = Vec::new();
    for piece in [before, after].into_iter().flat_map(|it| it.split('<')) {
        let (tag, text) = piece.split_once('>').unwrap_or(("", piece));
        found.extend(text.split(". ").map(str::to_owned));
        for attribute in ["aria-label=\"", "title=\""] {
            let value = tag.split(attribute).nth(1);
            found.extend(value.map(|it| it.split('"').next().unwrap().to_owned()));
        }
    }
    let trimmed = found.iter().map(|it| it.trim().trim_end_matches('.'));
    trimmed.map(str::to_owned).collect()
}

/// Whether that text of the table is among what is shown; of one with holes, all of its longer parts.
fn is_shown(text: &str, shown: &[String]) -> bool {
    if !text.contains('{') {
        return shown.iter().any(|it| it == text.trim_end_matches('.'));
    }
    let parts = text.split('{').enumerate().map(|(index, it)| match index {
        0 => it,
        _ => it.split_once('}').unwrap().1,
    });
    let letters = |it: &str| it.chars().filter(|c| c.is_alphabetic()).count();
    let parts = parts.map(|it| it.trim().trim_end_matches('.'));
    let parts: Vec<&str> = parts.filter(|it| letters(it) > 5).collect();
    !parts.is_empty()
        && shown
            .iter()
            .any(|it| parts.iter().all(|part| it.contains(*part)))
}

/// Keys that the page of [`full`] shows. The others are of other runs.
const KEYS: &str = "kicker happened wrong instructor score_of attempt lesson_again criterion points evidence step rule done failed \
                    missed kept broken in_all judged total at_most show frames click_words liquid temperature solver figures ran \
                    whereabouts shares place mass share all table floor air over_time made_by hash numbers incidents \
                    density_error_mean_note wall_s_note enthalpy by_mass times p99 foam";

/// Nothing fixed on the page is English where another language is asked for: headings, points, captions, plots with their legends,
/// and figures. The same look finds these in English.
#[test]
fn no_heading_stays_english() {
    let mut report = full();
    let table = include_str!("../../../../run/lesson/texts/report/en.toml");
    let lines = table.lines().filter_map(|line| line.split_once(" = \""));
    let english: Vec<(&'static str, &'static str)> = lines
        .map(|(key, text)| (key, text.strip_suffix('"').unwrap()))
        .collect();
    let mut page = |language: Language| {
        let texts = Texts::of(language).unwrap();
        report.judge(&Rubric::default(), &texts);
        let page = report.to_html(&texts);
        assert!(page.contains(&format!("<html lang=\"{language}\"")));
        shown(&page)
    };
    let is_in = |page: &[String]| -> Vec<&'static str> {
        let found = english.iter().filter(|(_, text)| is_shown(text, page));
        found.map(|(key, _)| *key).collect()
    };
    let found = is_in(&page(Language::En));
    for key in KEYS.split_whitespace() {
        assert!(found.contains(&key), "{key} is not found in English");
    }
    for language in [Language::De, Language::Es, Language::Zh] {
        let page = page(language);
        assert!(is_in(&page).is_empty(), "{language}: {:?}", is_in(&page));
        // Points of how many.
        let of = page.iter().find(|it| it.contains(" of "));
        assert_eq!(of, None, "{language}");
    }
}
