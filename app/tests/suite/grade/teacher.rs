//! A class as a teacher has it: a folder for each student, several scenes in one call, bad files, and a table that says in the
//! teacher's language what went wrong first.

use std::fs;
use std::path::Path;

use vitriol::command::grade::{Class, Status};
use vitriol_lesson::{Event, Language, Lesson, Texts};
use vitriol_sim::scene::Scene;
#[cfg(target_os = "linux")]
use vitriol_tests::browser::Look;
#[cfg(target_os = "linux")]
use vitriol_tests::devtools::Tab;
use vitriol_xr::track::Track;

use super::toy::graded_by;
use super::{VITRIOL, events, graded, line, nobody, put, read, recording};

/// A recording of another scene, in which the same was done.
fn of_scene(scene: &str, spilt_ml: f64) -> Track {
    let mut events = events(spilt_ml);
    for event in &mut events {
        if let Event::Begun { scene: begun, .. } = event {
            *begun = scene.to_owned();
        }
    }
    let mut track = recording(&events);
    let text = Scene::builtin_text(scene).unwrap();
    track.metadata.scene = scene.to_owned();
    track.metadata.scenes = [(scene.to_owned(), Scene::complete(text).into_owned())].into();
    track
}

/// What `grade` finds in the folder by its own means, with `out` beside it.
fn class_of(here: &Path, more: &[&str]) -> Class {
    let out = here.join("out");
    let all = [&["--out", out.to_str().unwrap()][..], more].concat();
    graded_by(&here.join("class"), &all, nobody).unwrap().0
}

/// Students' folders as a platform unpacks them: three scenes, two bad files, and what systems lay beside.
fn unpack(here: &Path) {
    let class = here.join("class");
    let student = |name: &str| {
        let folder = class.join(name);
        fs::create_dir_all(&folder).unwrap();
        folder
    };
    put(&student("Ada"), "pour.mcap", &recording(&events(0.0)));
    put(&student("Björn <b>"), "pour.mcap", &recording(&events(2.0)));
    let inner = student("李雷/submission");
    put(&inner, "pour.mcap", &of_scene("water-into-acid", 1.0));
    put(&student("Íñigo"), "pour.mcap", &of_scene("hot-acid", 4.0));
    fs::write(student("Cut").join("pour.mcap"), b"\x89MCAP0\r\n").unwrap();
    fs::write(student("Empty").join("pour.mcap"), b"").unwrap();
    let ada = student("Ada");
    for name in [
        "._pour.mcap",
        ".DS_Store",
        "Thumbs.db",
        "Desktop.ini",
        "~$essay.docx",
    ] {
        fs::write(ada.join(name), b"beside").unwrap();
    }
    let beside = student("__MACOSX/Ada");
    fs::write(beside.join("pour.mcap"), b"beside").unwrap();
    fs::write(ada.join("essay.docx"), b"an essay").unwrap();
}

/// Each student has a row with the name of the folder. Two bad files are rows and one warning, and no failure of the class.
#[test]
fn a_class_of_folders_and_scenes_is_graded_in_one_call() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    unpack(here);
    let class = class_of(here, &[]);
    assert_eq!((class.graded, class.otherwise, class.failed), (4, 0, 2));
    let scene = |student: &str| line(&class, student).scene.clone();
    assert_eq!(scene("Ada"), "acid-into-water");
    assert_eq!(scene("李雷"), "water-into-acid");
    assert_eq!(scene("Íñigo"), "hot-acid");
    for student in ["Cut", "Empty"] {
        let line = line(&class, student);
        assert_eq!((line.status, line.points), (Status::Failed, None));
        let told = line.note.starts_with("Could not be read: ");
        assert!(told && line.note.contains("pour.mcap"), "{}", line.note);
    }
    // What is no companion is named, once; the rest is not.
    let essay = here.join("class/Ada/essay.docx");
    assert_eq!(class.passed_over, [essay.display().to_string()]);
    // Pages and results of a first call are no part of the class, wherever they lie and wherever those of the next go.
    let line = "grade class --out class";
    for line in [line, line, "grade class --out elsewhere"] {
        let output = VITRIOL.run(here, line);
        let warned = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{warned}");
        for name in ["essay.docx", "Cut", "Empty"] {
            assert_eq!(warned.matches(name).count(), 1, "{warned}");
        }
        for name in ["grades.", "grade.json", "report.html"] {
            assert!(!warned.contains(name), "{warned}");
        }
    }
    let strict = VITRIOL.run(here, &format!("{line} --strict"));
    assert_eq!(strict.status.code(), Some(2));
    // Where nothing is graded, the class fails without it.
    let none = VITRIOL.run(here, "grade class/Cut class/Empty");
    assert_eq!(none.status.code(), Some(2));
    // A bad file beside recordings that are not graded is not the cause, unless it is asked for.
    let line = "grade class/Cut class/Ada --scene beaker";
    for (line, cause) in [
        (line.to_owned(), "nothing is graded"),
        (format!("{line} --strict"), "pour.mcap"),
    ] {
        let output = VITRIOL.run(here, &line);
        assert_eq!(output.status.code(), Some(2));
        let said = String::from_utf8(output.stderr).unwrap();
        let last = said.lines().last().unwrap();
        assert!(last.contains(cause), "{said}");
    }
}

/// Why a file is passed over, not read or not graded is said in the teacher's language, also of a result that an earlier call left.
#[test]
fn what_is_not_graded_is_told_in_the_teachers_language() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    unpack(here);
    let short = here.join("class/Short");
    fs::create_dir_all(&short).unwrap();
    put(&short, "pour.mcap", &recording(&events(0.0)));
    let whole = fs::read(short.join("pour.mcap")).unwrap();
    fs::write(short.join("pour.mcap"), &whole[..whole.len() - 20]).unwrap();
    // Of each language what is said of the essay, of the bad files, of another scene and of the short recording.
    let sentences = [
        "en; passed over, since they are no recordings; not graded, for the causes; made with another scene: water-into-acid; breaks off after",
        "de; übergangen, da es keine Aufnahmen sind; nicht bewertet, Gründe siehe Tabelle; mit einer anderen Szene aufgenommen: water-into-acid; bricht nach",
        "es; omitidos, porque no son grabaciones; sin calificar, por las causas; hecha con otra escena: water-into-acid; se interrumpe después de",
        "zh; 已跳过，因为不是录制文件; 未评分，原因见表格; 录制时用的是另一个场景：water-into-acid; 之后中断",
    ]
    .map(|row| row.split_once("; ").unwrap());
    for (nth, (language, _)) in sentences.iter().enumerate() {
        let line = "grade class --scene acid-into-water --scene hot-acid --out out --json";
        let output = VITRIOL.run(here, &format!("{line} --language {language}"));
        let class: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(class["taken"], if nth == 0 { 0 } else { 4 });
        let warned = String::from_utf8(output.stderr).unwrap();
        let told = format!("{warned}{}", class["lines"]);
        for (of, parts) in &sentences {
            for part in parts.split("; ") {
                let is_own = of == language;
                assert_eq!(told.contains(part), is_own, "{language}: {part}: {told}");
            }
        }
    }
}

/// Thirty students, of whom each other one spilt something, in five scenes and with programs in three languages; the recordings of two
/// were cut.
fn thirty(here: &Path) {
    let folder = |n: usize| {
        let folder = here.join("class").join(format!("Student {n:02}"));
        fs::create_dir_all(&folder).unwrap();
        folder
    };
    for n in 0..28 {
        let mut track = of_scene(SCENES[n % 5], if n % 2 == 0 { 0.0 } else { 2.0 });
        let language = ["de", "es", "zh"][n % 3];
        let parameters = &mut track.metadata.parameters;
        parameters.insert("language".into(), language.into());
        put(&folder(n), "pour.mcap", &track);
    }
    fs::write(folder(28).join("pour.mcap"), b"\x89MCAP0\r\n").unwrap();
    fs::write(folder(29).join("pour.mcap"), b"").unwrap();
}

const SCENES: [&str; 5] = [
    "acid-into-water",
    "water-into-acid",
    "hot-acid",
    "fume-hood",
    "layer-and-swirl",
];

/// The table in the terminal and the page have all that is needed to read them, in the teacher's language whatever the students' is.
#[test]
fn the_table_of_a_whole_class_explains_itself() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    thirty(here);
    let mut taken = "0";
    for language in [Language::En, Language::De, Language::Zh] {
        let line = format!("grade class --out out --language {language}");
        let output = VITRIOL.run(here, &line);
        let warned = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{warned}");
        // One line of warning, which names both bad files.
        assert_eq!(warned.trim_end().lines().count(), 1, "{warned}");
        assert!(
            warned.contains("Student 28") && warned.contains("Student 29"),
            "{warned}"
        );

        let told = String::from_utf8(output.stdout).unwrap();
        let mut lines = told.lines();
        let words = vitriol_run::texts::Texts::of(language).unwrap().grades;
        let head: Vec<&str> = lines.next().unwrap().split("  ").collect();
        let head = head.into_iter().map(str::trim).filter(|it| !it.is_empty());
        let heads = [&words.student, &words.scene, &words.points, &words.notes];
        assert_eq!(head.collect::<Vec<_>>(), heads);
        let rows: Vec<&str> = lines.by_ref().take(30).collect();
        let unread = words.unread("");
        let texts = Texts::of(language).unwrap();
        // What stands between the numbers, such as "of".
        let part = texts.report.part.to_string();
        let part = part.split(['{', '}']).nth(2).unwrap();
        for (n, row) in rows.iter().enumerate() {
            let rest = row.strip_prefix(&format!("Student {n:02}  ")).unwrap();
            if n < 28 {
                assert!(rest.starts_with(SCENES[n % 5]), "{row}");
                assert!(rest.contains(part), "{row}");
                assert_eq!(rest.contains(words.kind("spilt")), n % 2 == 1, "{row}");
            } else {
                assert!(rest.trim_start().starts_with(&words.failed), "{row}");
                assert!(rest.contains(unread.trim()), "{row}");
            }
        }
        assert_eq!(lines.next(), Some(""));
        let summary = lines.next().unwrap();
        let counted = summary.strip_prefix(&words.counted(28, 0, 2)).unwrap();
        let said = words.taken.fill(&[("number", taken)]);
        assert_eq!(counted.trim_start(), said);
        let mut scenes = SCENES;
        scenes.sort_unstable();
        let scenes = format!("{}: {}", words.scene, scenes.join(", "));
        assert_eq!(lines.next(), Some(scenes.as_str()));
        taken = "28";

        let page = fs::read_to_string(here.join("out/grades.html")).unwrap();
        assert_eq!(page.matches("<th scope=\"row\">").count(), 30);
        for scene in SCENES {
            let title = format!("\">{}</td>", texts.scene(scene));
            assert!(page.contains(&title), "{title}");
        }
    }
}

/// Scenes that are named are those of the class; by a lesson are graded those that name it.
#[test]
fn scenes_and_lessons_are_those_that_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    unpack(here);
    let scenes = ["--scene", "acid-into-water", "--scene", "hot-acid"];
    let class = class_of(here, &scenes);
    assert_eq!((class.graded, class.otherwise), (3, 1));
    let other = line(&class, "李雷");
    assert!(
        other.note.contains("another scene: water-into-acid"),
        "{}",
        other.note
    );
    // A scene's own text is compared for each of them.
    let mut weak = of_scene("hot-acid", 0.0);
    let text = weak.metadata.scenes.get_mut("hot-acid").unwrap();
    text.push_str("\n# weaker");
    put(&here.join("class"), "weak.mcap", &weak);
    let weak = class_of(here, &scenes);
    assert!(line(&weak, "weak").note.contains("of another text"));

    let mut taught = of_scene("fume-hood", 0.0);
    let lesson = Lesson::builtin("examination").unwrap();
    let mode = lesson.default_mode();
    assert_eq!(lesson.scene, "fume-hood");
    let made = [
        ("lesson", "examination"),
        ("lesson_hash", lesson.hash()),
        ("mode", mode.name()),
    ];
    let made = made.map(|(key, value)| (key.to_owned(), value.to_owned()));
    taught.metadata.parameters.extend(made);
    put(&here.join("class"), "taught.mcap", &taught);
    let lessons = ["--lesson", "dilute", "--lesson", "examination"];
    let class = class_of(here, &lessons);
    assert_eq!(line(&class, "taught").status, Status::Graded);
    let names: Vec<&str> = class.lessons.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["dilute", "examination"]);
    // A step that both have is one column.
    let table = fs::read_to_string(here.join("out/grades.csv")).unwrap();
    let head = table.lines().next().unwrap();
    assert_eq!(head.matches(",step pour,").count(), 1, "{head}");
    assert!(
        head.contains(",step measure,") && head.contains(",step sash,"),
        "{head}"
    );
    assert!(line(&class, "Ada").note.contains("without a lesson"));
}

/// A row says what went wrong first, when, and where to read more, in the language of the call and of no earlier one.
#[test]
fn a_row_says_what_went_wrong_first() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    unpack(here);
    for (language, moment, nothing, taken) in [
        ("en", "At 0.2\u{a0}s: Spilt", "Nothing went wrong.", 0),
        ("de", "Bei 0,2\u{a0}s: ", "Nichts ging schief.", 4),
        ("es", "A los 0,2\u{a0}s: ", "Nada salió mal.", 4),
        ("zh", "在 0.2\u{a0}s：", "没有出现错误。", 4),
    ] {
        let class = class_of(here, &["--language", language]);
        assert_eq!(class.taken, taken);
        let bjorn = line(&class, "Björn <b>");
        let first = bjorn.first_wrong.as_ref().unwrap();
        assert_eq!(first.t_s, Some(0.2));
        // The texts themselves are those of the lesson's table, whose own tests read them.
        let texts = Texts::of(language.parse().unwrap()).unwrap();
        let attempt = vitriol_lesson::Attempt::all(events(2.0)).remove(0);
        assert_eq!(first.text, texts.wrong(&attempt, &attempt.incidents[0]));
        let report = bjorn.report.as_deref().unwrap();
        let told = fs::read_to_string(here.join("out").join(report)).unwrap();
        let plain = first.text.replace('&', "&amp;");
        assert!(told.contains(&plain), "{language}: {told}");
        assert!(told.contains("Björn &lt;b&gt;") && !told.contains("Björn <b>"));
        // Its headings too.
        assert!(told.contains(&format!("<h2>{}</h2>", texts.report.happened)));
        assert!(told.contains(&format!("<th>{}</th>", texts.report.evidence)));
        assert_eq!(told.contains("What happened"), language == "en");
        let page = fs::read_to_string(here.join("out/grades.html")).unwrap();
        assert!(page.contains(&format!("lang=\"{language}\"")), "{language}");
        assert!(
            page.contains(moment) && page.contains(nothing),
            "{language}: {page}"
        );
        // Scenes are called by their titles.
        let title = format!("\">{}</td>", texts.scene("hot-acid"));
        assert!(page.contains(&title) && !page.contains(">hot-acid</td>"));
        // A column that no row has anything for is left out.
        let caps = class.lines.iter().any(|it| !it.caps.is_empty());
        let heads = vitriol_run::texts::Texts::of(texts.language()).unwrap();
        assert_eq!(page.contains(&heads.grades.cap), caps, "{language}");
        // It loads nothing, and its links are escaped.
        assert!(!page.contains("src=") && !page.contains("http"), "{page}");
        assert!(
            page.contains("href=\"Bj%C3%B6rn%20%3Cb%3E%20-%20pour.report.html\""),
            "{page}"
        );
        assert!(page.contains("@media print"));
        let table = fs::read(here.join("out/grades.csv")).unwrap();
        // Excel and LibreOffice take the bytes after this mark for UTF-8.
        assert_eq!(table[..3], [0xef, 0xbb, 0xbf]);
        let table = String::from_utf8(table).unwrap();
        let row = table
            .lines()
            .find(|it| it.starts_with("Björn <b>,"))
            .unwrap();
        assert!(row.contains(",0.2,Björn <b> - pour.report.html,"), "{row}");
    }
}

/// A name that a student gave is shown in place of the file's, and is text in each table; the folder of a platform comes before it.
#[test]
fn a_student_has_the_name_that_was_given() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let class = here.join("class");
    let named = |folder: &Path, file: &str, name: &str| {
        fs::create_dir_all(folder).unwrap();
        let mut track = recording(&events(0.0));
        let parameters = &mut track.metadata.parameters;
        parameters.insert("student".into(), name.into());
        put(folder, file, &track);
    };
    named(&class, "a.mcap", "Ada Lovelace");
    named(&class, "b.mcap", "=1+1");
    named(&class.join("Grace"), "c.mcap", "Somebody else");
    let read = class_of(here, &[]);
    for student in ["Ada Lovelace", "=1+1", "Grace"] {
        line(&read, student);
    }
    let table = fs::read_to_string(here.join("out/grades.csv")).unwrap();
    assert!(table.contains("\r\n'=1+1,"), "{table}");
    // A result names nobody, so the name is read again in what an earlier call left.
    let result = fs::read_to_string(here.join("out/a.grade.json")).unwrap();
    assert!(!result.contains("Ada"));
    let again = class_of(here, &[]);
    assert_eq!(again.taken, 3);
    line(&again, "Ada Lovelace");
}

/// A danger may have no incident of its own: its cap names it then, with its moment.
#[test]
fn a_danger_before_any_incident_went_wrong_first() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let mut bare = events(2.0);
    for event in &mut bare {
        if let Event::Poured(pour) = event {
            pour.bare_face = true;
        }
    }
    put(here, "ada.mcap", &recording(&bare));
    let class = read(here, &["--language", "de"]);
    let ada = line(&class, "ada");
    let first = ada.first_wrong.as_ref().unwrap();
    // The pour without goggles began at 0.1 s, the spill at 0.2 s.
    assert_eq!(first.t_s, Some(0.1));
    assert!(ada.caps[0].starts_with(&first.text), "{:?}", ada.caps);
    assert!(ada.caps[0].contains("Bei 0,1\u{a0}s: "), "{:?}", ada.caps);
    let (english, _) = graded(here, &[], nobody).unwrap();
    assert!(line(&english, "ada").caps[0].starts_with("At most "));
}

/// A click on a head sorts the rows by it in a browser, a second click the other way round; links lead to pages that are there.
#[test]
#[cfg(target_os = "linux")]
fn the_page_sorts_in_a_browser() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    unpack(here);
    class_of(here, &[]);
    let Some(mut tab) = Tab::new() else { return };
    tab.open(&here.join("out/grades.html"));
    tab.until("document.readyState === 'complete' && !!document.querySelector('table.grades')");
    let mut sorted = |column: usize| {
        tab.eval(&format!(
            "document.querySelectorAll('thead button')[{column}].click()"
        ));
        let names = "[...document.querySelectorAll('tbody th')].map(it => it.textContent.trim())";
        serde_json::from_value::<Vec<String>>(tab.eval(names)).unwrap()
    };
    let by_name = sorted(0);
    let mut back = sorted(0);
    back.reverse();
    assert_eq!(by_name, back);
    assert_eq!(by_name[..3], ["Ada", "Björn <b>", "Cut"]);
    // Student, scene, points: what has none comes first, in the order that it had.
    let by_points = sorted(2);
    assert_eq!(by_points.len(), 6);
    let mut none = by_points[..2].to_vec();
    none.sort();
    assert_eq!(none, ["Cut", "Empty"]);
    // What went wrong first: all at 0.2 s, but for whom nothing went wrong.
    assert_eq!(sorted(3).last().unwrap(), "Ada");
    let head = "document.querySelectorAll('thead th')[3].getAttribute('aria-sort')";
    assert_eq!(tab.eval(head), "ascending");
    let links = "[...document.querySelectorAll('tbody a')].map(it => decodeURIComponent(it.getAttribute('href')))";
    let links: Vec<String> = serde_json::from_value(tab.eval(links)).unwrap();
    assert_eq!(links.len(), 4);
    for link in links {
        assert!(here.join("out").join(&link).is_file(), "{link}");
    }
    // On a telephone and in a narrow window nothing is wider than the page, and a name of a word is one line.
    for width in [390, 740, 1366] {
        tab.look([width, 844], Look::Light);
        let wide = "document.documentElement.scrollWidth";
        assert!(
            tab.eval(wide).as_u64().unwrap() <= u64::from(width),
            "{width}"
        );
        let lines = "[...document.querySelectorAll('tbody th a')].filter(it => !it.textContent.includes(' ') \
                     && it.getClientRects().length > 1).length";
        assert_eq!(tab.eval(lines), 0, "{width}");
    }
    assert_eq!(tab.complaints(), Vec::<String>::new());
}
