//! The built-in tables, in each language.

#![allow(clippy::unwrap_used)]

use super::*;
use crate::Lesson;
use vitriol_sim::scene::Scene;

#[test]
fn a_table_lacks_nothing_and_has_nothing_else() {
    Texts::english().unwrap();
    let refused = |text: &str| Texts::parse(text).unwrap_err().to_string();
    assert!(refused(&ENGLISH.replace("\nslowly =", "\n# slowly =")).contains("slowly"));
    assert!(refused(&format!("{ENGLISH}\nbang = \"a bang\"\n")).contains("bang"));
}

/// A translator may order holes as the language needs, and lose none.
#[test]
fn a_translation_has_the_same_holes() {
    let english = "Spilt on the bench: {amount}.";
    assert!(ENGLISH.contains(english));
    let with = |german: &str| Texts::parse(&ENGLISH.replace(english, german));
    assert!(with("{amount} auf dem Tisch verschüttet.").is_ok());
    for wrong in ["Verschüttet.", "Verschüttet: {menge}.", "{amount}, {flask}"] {
        let error = with(wrong).unwrap_err().to_string();
        assert!(error.contains("wrong.spilt_bench") && error.contains("amount"));
    }
}

/// The built-in texts, in each language: no sentence is missing, empty or left in English.
#[test]
fn each_language_is_complete() {
    let english = sentences(ENGLISH).unwrap();
    // Units, names and the like are the same in several languages.
    let same = |key: &str| {
        ["unit.", "number.", "join."]
            .iter()
            .any(|it| key.starts_with(it))
    };
    for language in Language::ALL {
        Texts::of(language).unwrap();
        let translated = sentences(table(language)).unwrap();
        assert!(translated.keys().eq(english.keys()), "{language}");
        for (key, sentence) in &translated {
            assert!(!sentence.trim().is_empty(), "{language}: {key}");
            let is_english = *sentence == english[key];
            assert!(
                language == Language::En || same(key) || !is_english,
                "{language}: {key}"
            );
        }
    }
}

/// Each built-in scene has a title, and no other has one.
#[test]
fn each_scene_has_its_title() {
    let scenes: BTreeSet<&str> = Scene::builtin_names().into_iter().collect();
    for language in Language::ALL {
        let texts = Texts::of(language).unwrap();
        let titled: BTreeSet<&str> = texts.scene.keys().map(String::as_str).collect();
        assert_eq!(titled, scenes, "{language}");
        assert!(texts.scene.values().all(|it| it.chars().count() <= 35));
        let titles: BTreeSet<&String> = texts.scene.values().collect();
        assert_eq!(titles.len(), scenes.len(), "{language}");
        assert_eq!(texts.scene("own.toml"), "own.toml");
    }
}

/// No text for students has a flask's name from a scene's file, nor the name of a scene's or a lesson's file.
#[test]
fn no_text_has_a_name_of_a_file() {
    let lessons = Lesson::builtin_names();
    let files = lessons.into_iter().chain(Scene::builtin_names());
    let files: Vec<&str> = files.filter(|it| it.contains('-')).collect();
    for language in Language::ALL {
        for (key, sentence) in sentences(table(language)).unwrap() {
            let words = sentence.split(|c: char| !c.is_ascii_alphanumeric() && c != '-');
            for word in words {
                let is_file = ["source", "target"].contains(&word) || files.contains(&word);
                assert!(!is_file, "{language}: {key}: {sentence}");
            }
            let quoted = ["“dilute”", "„dilute“", "«dilute»"];
            assert!(!quoted.iter().any(|it| sentence.contains(it)), "{key}");
        }
    }
}

/// Numbers are the same in each language, and stand apart from their units by a space that no line breaks at.
#[test]
fn numbers_are_translated_as_they_are() {
    let numbers = |text: &str| -> Vec<String> {
        let mut found: Vec<String> = text
            .split(|c: char| !c.is_ascii_digit())
            .filter(|it| !it.is_empty())
            .map(str::to_owned)
            .collect();
        found.sort();
        found
    };
    let english = sentences(ENGLISH).unwrap();
    for language in Language::ALL {
        for (key, sentence) in sentences(table(language)).unwrap() {
            assert_eq!(
                numbers(&sentence),
                numbers(&english[&key]),
                "{language}: {key}"
            );
            for unit in [" mL", " %", " °C", " cm"] {
                for (at, _) in sentence.match_indices(unit) {
                    let breaks = sentence[..at].ends_with(|c: char| c.is_ascii_digit());
                    assert!(!breaks, "{language}: {key}");
                }
            }
        }
    }
}

/// Chinese is written without Latin words, and the others without Chinese signs.
#[test]
fn each_table_is_of_its_language() {
    let is_chinese = |c: char| ('\u{4e00}'..='\u{9fff}').contains(&c);
    // Traditional forms of the signs here, which simplified Chinese writes otherwise.
    let traditional = "傾實驗臺濃於後體氣熱時間燒灑濺單護鏡這樣應";
    for language in Language::ALL {
        for (key, sentence) in sentences(table(language)).unwrap() {
            let chinese = sentence.chars().any(is_chinese);
            let templates = ["unit.", "number.", "join."];
            if language != Language::Zh {
                assert!(!chinese, "{language}: {key}");
            } else if !templates.iter().any(|it| key.starts_with(it)) {
                assert!(chinese, "{key}");
                assert!(
                    !sentence.contains(|c| traditional.contains(c)),
                    "{key}: {sentence}"
                );
            }
        }
    }
}

/// 把手 reads as a handle, 没有得满分 as "did not get full points", and 强酸 is a strong acid, not a concentrated one.
#[test]
fn chinese_has_no_words_that_mislead() {
    for (key, sentence) in sentences(CHINESE).unwrap() {
        for wrong in ["把手", "没有得满分", "强酸"] {
            assert!(!sentence.contains(wrong), "{key}: {sentence}");
        }
    }
}
