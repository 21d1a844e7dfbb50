//! The built-in lessons, against the built-in scenes.

use std::collections::BTreeSet;

use vitriol_sim::scene::{Scene, ToolKind};

use super::*;
use crate::{Language, Texts};

fn facts(scene: &str) -> SceneFacts {
    SceneFacts::of(scene, &Scene::builtin(scene).unwrap())
}

#[test]
fn each_is_of_its_name_fits_its_scene_and_is_in_each_language() {
    assert_eq!(
        Lesson::builtin_names(),
        [
            "dilute",
            "wrong-order",
            "wrong-order-layered",
            "wrong-order-hot",
            "examination",
            "emergency"
        ]
    );
    for name in Lesson::builtin_names() {
        let lesson = Lesson::builtin(name).unwrap();
        assert_eq!(lesson.name, name);
        assert_eq!(lesson.languages(), Language::ALL);
        let points = lesson.steps.iter().map(|it| it.points);
        let all = points.chain(lesson.rules.iter().map(|it| it.points));
        // So points are a percentage.
        assert_eq!(all.sum::<u32>(), 100, "{name}");
        assert_eq!(lesson.default_mode(), lesson.modes[0]);
        // It fits its scene; a copy in another file keeps its texts.
        let text = Lesson::builtin_text(name).unwrap();
        let facts = |scene: &str| Ok(Some(facts(scene)));
        let copy = Lesson::parse_for(text, ("copy.toml", Language::En), facts).unwrap();
        assert_eq!(copy, lesson);
    }
    // No texts belong to a lesson that does not exist.
    for language in Language::ALL {
        let texts = Texts::of(language).unwrap();
        let named: Vec<&str> = texts.lesson.keys().map(String::as_str).collect();
        let mut names = Lesson::builtin_names();
        names.sort_unstable();
        assert_eq!(named, names);
    }
    let error = Lesson::builtin("bake").unwrap_err().to_string();
    assert!(
        error.contains("dilute, wrong-order, wrong-order-layered, wrong-order-hot, examination"),
        "{error}"
    );
    let template = Lesson::template("own-1", "bake", Language::De);
    assert_eq!(template.unwrap_err().to_string(), error);
}

/// What is written of a lesson of one's own has its title and sentences, in the language of the texts or the only one that it has.
#[test]
fn a_lesson_of_ones_own_is_told_in_its_words() {
    let text = Lesson::template("own-1", "dilute", Language::De).unwrap();
    let own = Lesson::parse(&text, "own-1.toml").unwrap();
    let words = own.texts(Language::De);
    for language in [Language::De, Language::Es] {
        let mut texts = Texts::of(language).unwrap();
        assert_eq!(texts.lesson("own-1"), "own-1");
        texts.learn(&own);
        assert_eq!(texts.lesson("own-1"), words.title);
        assert_eq!(texts.asked("own-1", "pour"), words.step["pour"].text);
        assert_eq!(texts.asked("own-1", "cool"), words.rule["cool"]);
    }
}

/// Each lesson in each language is a file to begin with: it fits its scene as it is, has that language alone, and explains each of its keys.
#[test]
fn a_new_lesson_is_good_and_explained() {
    fn keys(value: &toml::Value, found: &mut BTreeSet<String>) {
        match value {
            toml::Value::Table(table) => {
                for (key, value) in table {
                    found.insert(key.clone());
                    keys(value, found);
                }
            }
            toml::Value::Array(values) => values.iter().for_each(|it| keys(it, found)),
            _ => {}
        }
    }
    for from in Lesson::builtin_names() {
        for language in Language::ALL {
            let text = Lesson::template("own-1", from, language).unwrap();
            let facts = |scene: &str| Ok(Some(facts(scene)));
            let own = Lesson::parse_for(&text, ("own-1.toml", Language::En), facts).unwrap();
            let builtin = Lesson::builtin(from).unwrap();
            assert_eq!(
                (own.name.as_str(), own.languages()),
                ("own-1", vec![language])
            );
            assert_eq!((&own.steps, &own.rules), (&builtin.steps, &builtin.rules));
            assert_eq!(own.texts(language), builtin.texts(language));
            let mut table: toml::Table = toml::from_str(&text).unwrap();
            // Those of texts are explained above them.
            table.remove("texts").unwrap();
            let mut found = BTreeSet::new();
            keys(&toml::Value::Table(table), &mut found);
            for key in found {
                let explained = format!("\n# {key}: ");
                assert_eq!(text.matches(&explained).count(), 1, "{from}: {key}");
            }
        }
    }
    // The file of such a name is a device on Windows.
    for device in ["con", "prn", "aux", "nul", "com1", "lpt9"] {
        for language in Language::ALL {
            let error = Lesson::template(device, "dilute", language).unwrap_err();
            assert!(error.to_string().contains("Windows"), "{error}");
        }
    }
    for free in ["console", "com", "com0", "lpt10"] {
        assert!(Lesson::template(free, "dilute", Language::En).is_ok());
    }
    for wrong in ["", "My lesson", "../own", "dilute"] {
        for (language, said) in [(Language::En, "a to z"), (Language::De, "a bis z")] {
            let error = Lesson::template(wrong, "dilute", language).unwrap_err();
            assert!(error.to_string().contains(said), "{error}");
        }
    }
}

/// By the scenes' files: 20 and 160 mL, and 13,000 particles of 2.5 mm at real size.
#[test]
fn facts_are_those_of_the_scene() {
    let dilution = facts("acid-into-water");
    assert!((dilution.liquid_m3 - 180e-6).abs() < 1e-12 && dilution.heat);
    let names: Vec<&str> = dilution.flasks.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["source", "target"]);
    assert!(dilution.flasks.iter().all(|it| it.lifted));
    let lacks: Vec<_> = (ToolKind::ALL.into_iter())
        .filter(|it| !dilution.has(*it))
        .collect();
    assert_eq!(lacks, [ToolKind::Sash]);
    assert_eq!(facts("vr-dilution").tools, []);
    let small = facts("vr-dilution").liquid_m3;
    assert!(
        (small / (13_000.0 * 0.0025_f64.powi(3)) - 1.0).abs() < 0.01,
        "{small}"
    );
    assert!(facts("triple-dilution").flasks.iter().all(|it| !it.lifted));
    assert!(!facts("two-flasks").heat);
}

/// An instructor's own texts come before those of the built-in lesson of that name.
#[test]
fn own_texts_come_first() {
    let texts = "[texts.en]\ntitle = \"Mine\"\nsummary = \"Mine.\"\nstep.lift = { text = \"a\", hint = \"b\" }\n";
    let step =
        "[[step]]\nid = \"lift\"\npoints = 1\ncondition = { lifted = { flask = \"source\" } }\n";
    let head = "version = 1\nname = \"dilute\"\nscene = \"acid-into-water\"\nmodes = [\"free\"]\n";
    let own = Lesson::parse(&format!("{head}{step}{texts}"), "own.toml").unwrap();
    assert_eq!(own.texts(Language::En).title, "Mine");
    // English stands in for a language that is not there.
    assert_eq!(
        (own.texts(Language::De).title.as_str(), own.languages()),
        ("Mine", vec![Language::En])
    );
    // With other steps than the built-in one, it needs its own.
    let error = Lesson::parse(&format!("{head}{step}"), "own.toml")
        .unwrap_err()
        .to_string();
    assert!(error.contains("texts.en.step."), "{error}");
}

/// A line of the panel, and two or three; Chinese signs are twice as wide.
#[test]
fn each_text_fits_the_panel() {
    for name in Lesson::builtin_names() {
        for language in Language::ALL {
            let lesson = Lesson::builtin(name).unwrap();
            let texts = lesson.texts(language);
            let wide = if language == Language::Zh { 2 } else { 1 };
            let long = |text: &str| wide * text.chars().count();
            assert!(long(&texts.title) <= 60 && long(&texts.summary) <= 280);
            for step in texts.step.values() {
                assert!(
                    long(&step.text) <= 140 && long(&step.hint) <= 140,
                    "{step:?}"
                );
                let desk = step.hint_desk.iter();
                assert!(desk.map(|it| long(it)).all(|long| long <= 140), "{step:?}");
                let answers = step.answers.iter();
                assert!(answers.map(|it| long(it)).all(|long| long <= 50));
            }
            assert!(texts.rule.values().all(|it| long(it) <= 140));
        }
    }
}

/// With mouse and keyboard no hint asks for a gesture of a hand, and what is judged is the same lesson. A hint without a variant stays.
#[test]
fn hints_at_a_desk_ask_for_no_gesture() {
    let gestures = [
        "open the hand",
        "lose the hand",
        "lose a hand",
        "lose the other hand",
        "each hand, and close it",
        "your eyes",
        "your hands",
    ];
    let asks = |hint: &str| gestures.iter().any(|it| hint.contains(it));
    let mut changed = 0;
    for name in Lesson::builtin_names() {
        let lesson = Lesson::builtin(name).unwrap();
        let desk = lesson.clone().at_desk();
        assert_eq!(desk.hash(), lesson.hash());
        for (id, step) in &desk.texts(Language::En).step {
            assert!(!asks(&step.hint), "{name} {id}: {}", step.hint);
            let worn = &lesson.texts(Language::En).step[id].hint;
            changed += usize::from(asks(worn));
            let differs = Language::ALL.map(|language| {
                let hint = |of: &Lesson| of.texts(language).step[id].hint.clone();
                hint(&desk) != hint(&lesson)
            });
            assert!(differs.iter().all(|it| *it == differs[0]), "{name} {id}");
        }
    }
    assert!(changed > 0);
}

/// A text names the numbers that its file judges by.
#[test]
fn texts_say_what_is_judged() {
    let of = |name: &str| Lesson::builtin(name).unwrap();
    let dilute = of("dilute");
    let texts = dilute.texts(Language::En);
    let Condition::All(parts) = &dilute.steps[2].condition else {
        panic!()
    };
    let [Condition::Poured(first), Condition::Stirred(_)] = &parts[..] else {
        panic!()
    };
    let Condition::Poured(rest) = &dilute.steps[3].condition else {
        panic!()
    };
    let most = first.at_most_ml.unwrap();
    let portion = format!("{} to {most}\u{a0}mL", first.at_least_ml);
    assert!(texts.step["pour"].text.contains(&portion));
    // The greatest first portion leaves enough for the second one.
    assert!(most + rest.at_least_ml < 20.0);
    for (id, poured) in [("pour", first), ("rest", rest)] {
        let rate = poured.at_most_ml_s.unwrap();
        assert!(texts.step[id].text.contains(&format!("{rate}\u{a0}mL/s")));
        assert_eq!(rate / 1e6, crate::Limits::default().rate_m3_s);
    }
    let Condition::Holds(holds) = &dilute.steps[7].condition else {
        panic!()
    };
    let range = format!(
        "{} to {}\u{a0}%",
        holds.acid_from_percent, holds.acid_to_percent
    );
    assert!(texts.step["concentration"].text.contains(&range));
    // 17 mL of 98 % acid (1.836 g/mL) in 160 mL of water (0.998 g/mL), and all 20 mL: 16.1 and 18.4 %.
    for ml in [17.0, 20.0] {
        let acid = 1.836 * ml;
        let percent = 98.0 * acid / (acid + 0.998 * 160.0);
        assert!(
            (holds.acid_from_percent..holds.acid_to_percent).contains(&percent),
            "{percent}"
        );
        assert!(ml + 160.0 > holds.at_least_ml);
    }
    let wrong = of("wrong-order");
    let Condition::Poured(poured) = &wrong.steps[3].condition else {
        panic!()
    };
    let texts = wrong.texts(Language::En);
    assert!(
        texts.step["pour"]
            .text
            .contains(&format!("{}\u{a0}mL", poured.at_least_ml))
    );
    let layered = of("wrong-order-layered");
    let Condition::Temperature(swirled) = &layered.steps[3].condition else {
        panic!()
    };
    let least = format!("{}\u{a0}°C", swirled.at_least_c.unwrap());
    assert!(
        layered.texts(Language::En).step["swirl"]
            .text
            .contains(&least)
    );
}

/// Each lesson of the wrong order names the next, in each language: the cold one, the layers, the hot one, the right order.
#[test]
fn the_lessons_of_the_wrong_order_name_the_next() {
    let course = [
        "wrong-order",
        "wrong-order-layered",
        "wrong-order-hot",
        "dilute",
    ];
    for pair in course.windows(2) {
        let lesson = Lesson::builtin(pair[0]).unwrap();
        let next = Lesson::builtin(pair[1]).unwrap();
        let last = &lesson.steps[lesson.steps.len() - 1].id;
        for language in Language::ALL {
            let text = &lesson.texts(language).step[last].text;
            let title = &next.texts(language).title;
            assert!(text.contains(title), "{language}: {text}");
        }
    }
}

#[test]
fn the_wrong_order_is_seen_to_warm() {
    let mut procedure = Procedure::new(Lesson::builtin("wrong-order").unwrap(), Mode::Guided);
    let at = |t_s: f64, held: bool, celsius: f64| {
        let mut sight = sight(t_s);
        sight.flasks[0].name = "source".to_owned();
        sight.flasks[1].name = "target".to_owned();
        (sight.flasks[0].held, sight.flasks[0].standing) = (held, !held);
        sight.flasks[1].temperature_c = Some(celsius);
        sight
    };
    procedure.advance(&at(0.0, false, 20.0), &[]);
    procedure.answer("predict", 1, 0.0);
    procedure.advance(&at(1.0, true, 20.0), &[]);
    let Event::Poured(pour) = pour([2.0, 8.0], 12.0, 4.5, 0.0) else {
        panic!()
    };
    let poured = Pour {
        from: "source".to_owned(),
        into: Some("target".to_owned()),
        ..pour
    };
    procedure.advance(&at(9.0, true, 45.0), &[Event::Poured(poured)]);
    procedure.advance(&at(10.0, false, 45.0), &[]);
    procedure.advance(&at(11.0, false, 45.0), &[]);
    // What was predicted costs nothing; the wrong explanation costs its 15 points, and the rule's 5 are a share of the steps'.
    let mut other = procedure.clone();
    for (judge, explained) in [(&mut procedure, 2), (&mut other, 1)] {
        judge.answer("explain", explained, 12.0);
        judge.answer("look", 3, 13.0);
        assert!(judge.state().over);
    }
    assert_eq!(procedure.verdict().points, 100);
    assert_eq!(other.verdict().points, 80 + 4);
}

/// Acid is rinsed off the glove, then off the hand; water over a gloved hand does not count for the bare one.
#[test]
fn an_emergency_is_gone_through() {
    let lesson = Lesson::builtin("emergency").unwrap();
    let mut procedure = Procedure::new(lesson, Mode::Guided);
    let mut t = 0.0;
    let mut look = |held: bool, gloves: [bool; 2], rinsed_ml: f64, bench_ml: f64| {
        for _ in 0..10 {
            t += STEP;
            let mut sight = sight(t);
            sight.flasks[0].name = "water".to_owned();
            (sight.flasks[0].held, sight.flasks[0].standing) = (held, !held);
            sight.gloves = Some(gloves);
            sight.rinsed_m3 = Some([0.0, rinsed_ml * 1e-6]);
            sight.bench_m3 = bench_ml * 1e-6;
            procedure.advance(&sight, &[]);
        }
        let done = procedure.state().steps;
        done.iter().filter(|it| it.status == Status::Done).count()
    };
    assert_eq!(look(true, [true; 2], 0.0, 2.0), 0);
    assert_eq!(look(true, [true; 2], 39.0, 2.0), 0);
    assert_eq!(look(true, [true; 2], 41.0, 2.0), 1);
    assert_eq!(look(true, [false, true], 41.0, 2.0), 1, "the other glove");
    assert_eq!(look(true, [true, false], 41.0, 2.0), 2);
    assert_eq!(look(true, [true, false], 90.0, 2.0), 2);
    assert_eq!(look(true, [true, false], 92.0, 2.0), 3);
    assert_eq!(look(false, [true, false], 92.0, 2.0), 4);
    assert_eq!(look(false, [true, false], 92.0, 0.3), 5);
    let verdict = procedure.verdict();
    assert_eq!((verdict.points, verdict.of), (100, 100), "{verdict:?}");
}

/// Reasons as in a recording, and how each is said.
const WHYS: &str = r#"
{"why":"too-much","volume_m3":2.5e-6,"limit_m3":1e-6} => Too much was poured: 2.5 mL, where 1.0 mL is allowed.
{"why":"spilt","volume_m3":2.5e-6,"limit_m3":1e-6} => Spilt: 2.5 mL, where 1.0 mL is allowed.
{"why":"too-hot","flask":"b","temperature_c":71.6,"limit_c":60.0} => The liquid reached 72 °C; it was to stay below 60 °C.
{"why":"sash-open","height_m":0.45,"limit_m":0.3} => The fume hood was open 45 cm, where 30 cm is allowed.
{"why":"time-up","limit_s":60.0} => The time is up: 60 s.
{"why":"not-worn","gear":"gloves"} => No gloves were worn.
{"why":"not-worn","gear":"goggles"} => No goggles were worn.
"#;

#[test]
fn why_is_said_in_each_language() {
    let why = Why::TooFast {
        rate_m3_s: 7.3e-6,
        limit_m3_s: 5e-6,
    };
    let said = Language::ALL.map(|it| Texts::of(it).unwrap().why(&why).replace('\u{a0}', " "));
    assert_eq!(
        said,
        [
            "Poured too fast: 7.3 mL/s, where 5.0 mL/s is allowed.",
            "Zu schnell gegossen: 7,3 mL/s; erlaubt sind höchstens 5,0 mL/s.",
            "Vertido demasiado rápido: 7,3 mL/s; se permite hasta 5,0 mL/s.",
            "倒得太快：7.3 mL/s，最多允许5.0 mL/s。",
        ]
    );
    let texts = Texts::english().unwrap();
    let plain = |why: &Why| texts.why(why).replace('\u{a0}', " ");
    for line in WHYS.trim().lines() {
        let (why, said) = line.split_once(" => ").unwrap();
        assert_eq!(plain(&serde_json::from_str(why).unwrap()), said);
    }
    let kinds = [
        Kind::WaterIntoAcid,
        Kind::PouredTooFast,
        Kind::BoiledOver,
        Kind::Hot,
        Kind::OnSkin,
        Kind::Dropped,
    ];
    let mut said: Vec<String> = kinds
        .iter()
        .map(|&kind| plain(&Why::Incident { kind }))
        .collect();
    said.extend([Why::Skipped, Why::NotDone].iter().map(plain));
    let all = said.len();
    said.sort_unstable();
    said.dedup();
    assert_eq!(said.len(), all);
    assert_eq!(
        Mode::ALL.map(|it| Texts::of(Language::De).unwrap().mode(it)),
        ["angeleitet", "frei", "Prüfung"]
    );
}
