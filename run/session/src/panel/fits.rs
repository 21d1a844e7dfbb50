//! Whether what the panel says in each language has room where it stands, and a picture for each of its characters.
#![allow(clippy::unwrap_used)]

use egui::{Context, FontId};
use vitriol_lesson::{Language, Lesson};

use super::PANEL;
use super::lesson::label;
use super::view::{BESIDE, scene_text};
use vitriol_run::choices::{CHOICES, on_panel};
use vitriol_run::texts::{PanelTexts, Texts};

/// Half of the panel without its margins: what buttons, notes and thermometers have, pixels.
const COLUMN: f32 = (PANEL[0] as f32 - 2.0 * 22.0 - 12.0) / 2.0;
/// What a text and its place have, pixels.
const SIZE: f32 = 30.0;
const HEADING: f32 = 34.0;
/// Across a ring that fills, within its line.
const RING: f32 = 2.0 * (134.0 - 3.0);
/// What egui leaves at each side of a button's text.
const PADDING: f32 = 4.0;

fn context() -> Context {
    let context = super::context();
    let _ = context.run(egui::RawInput::default(), |_| {});
    context
}

/// Width of a text in a line, pixels.
fn width(context: &Context, text: &str, size: f32) -> f32 {
    let font = FontId::proportional(size);
    context.fonts_mut(|fonts| {
        let laid = fonts.layout_no_wrap(text.to_owned(), font, egui::Color32::WHITE);
        laid.size().x
    })
}

/// Lines that a text takes where there is so much room.
fn lines(context: &Context, text: &str, room: f32) -> usize {
    let font = FontId::proportional(SIZE);
    context.fonts_mut(|fonts| {
        let laid = fonts.layout(text.to_owned(), font, egui::Color32::WHITE, room);
        laid.rows.len()
    })
}

/// What stands on buttons of the column's width, as [`super::view`] puts it there.
fn on_buttons(words: &PanelTexts) -> Vec<String> {
    let all = [
        &words.start,
        &words.other_order,
        &words.recentre,
        &words.happened,
    ];
    all.map(|text| format!("W   {text}")).to_vec()
}

#[test]
fn each_button_has_its_text_in_a_line() {
    let context = context();
    for language in Language::ALL {
        let words = Texts::of(language).unwrap().panel;
        for text in on_buttons(&words) {
            let wide = width(&context, &text, SIZE);
            let room = COLUMN - 2.0 * PADDING;
            assert!(wide <= room, "{language}: {text:?} {wide} of {room}");
        }
        let wide = width(&context, &words.starting, HEADING);
        assert!(
            wide <= RING,
            "{language}: {:?} {wide} of {RING}",
            words.starting
        );
    }
}

/// Scenes' buttons share the column. Each of their two lines fits as it is broken in the table.
#[test]
fn each_scenes_button_has_its_text_in_two_lines() {
    let context = context();
    let gaps = 12.0 * (BESIDE - 1) as f32;
    let room = (COLUMN - gaps) / BESIDE as f32 - 2.0 * PADDING;
    for language in Language::ALL {
        let words = Texts::of(language).unwrap().panel;
        for choice in on_panel() {
            let text = scene_text(choice, &words, false);
            assert_eq!(text.lines().count(), 2, "{language}: {text:?}");
            let wide = width(&context, &text, SIZE);
            assert!(wide <= room, "{language}: {text:?} {wide} of {room}");
        }
    }
}

/// The answers of each built-in lesson, on buttons of the panel's width.
#[test]
fn each_answer_has_a_line() {
    let context = context();
    let room = PANEL[0] as f32 - 2.0 * 22.0 - 2.0 * PADDING;
    for name in Lesson::builtin_names() {
        let lesson = Lesson::builtin(name).unwrap();
        for language in Language::ALL {
            let steps = lesson.texts(language).step.values();
            for answer in steps.flat_map(|step| &step.answers) {
                let wide = width(&context, &label('k', answer), SIZE);
                assert!(wide <= room, "{language}: {answer:?} {wide} of {room}");
            }
        }
    }
}

/// A flask's line: a thermometer of 0.47 of the column, its value, and the acid at the column's end.
#[test]
fn a_thermometer_has_room_for_what_it_says() {
    let context = context();
    for language in Language::ALL {
        let words = Texts::of(language).unwrap().panel;
        // A flask that broke holds no acid.
        let said = [("159 °C", words.acid(98)), (&words.broken, String::new())];
        for (value, acid) in said {
            let value = width(&context, value, SIZE + 3.0);
            let wide = 0.47 * COLUMN + 14.0 + value + width(&context, &acid, SIZE);
            assert!(wide <= COLUMN, "{language}: {wide} of {COLUMN}");
        }
        // Two tints in a line, each with its square and three gaps.
        let tints = [&words.water, &words.sulfuric_acid];
        let named: f32 = tints.map(|text| width(&context, text, SIZE)).iter().sum();
        let wide = named + 2.0 * 24.0 + 3.0 * 12.0;
        assert!(wide <= COLUMN, "{language}: {wide} of {COLUMN}");
    }
}

/// Notes take two lines of their column at most, but for the two that name three places or parts.
#[test]
fn each_note_takes_two_lines_at_most() {
    let context = context();
    for language in Language::ALL {
        let words = Texts::of(language).unwrap().panel;
        let notes = [
            words.hold.clone(),
            words.coming("acid-into-water"),
            words.ends("Esc"),
            words.recording(3599),
            words.waits.clone(),
            words.unwritten(9999),
            words.device_lost.clone(),
            words.slow(50),
            words.missed(9999),
            words.tints.clone(),
            words.poured("150", "100"),
        ];
        for text in notes {
            let taken = lines(&context, &text, COLUMN);
            assert!(taken <= 2, "{language}: {text:?} takes {taken} lines");
        }
    }
}

/// What the instructor did, the summary's own words, and what mouse and keys do, over the panel's whole width.
#[test]
fn each_announcement_has_a_line() {
    let context = context();
    let room = PANEL[0] as f32 - 2.0 * 22.0;
    for language in Language::ALL {
        let texts = Texts::of(language).unwrap();
        let words = &texts.instructor;
        let scenes = CHOICES.iter();
        let titles = vitriol_lesson::Texts::of(language).unwrap();
        let scenes = scenes.map(|it| words.scene(titles.scene(it.scene)));
        let said = [
            words.start.clone(),
            words.held.clone(),
            words.end.clone(),
            texts.summary.nothing.clone(),
            texts.panel.mouse.clone(),
        ];
        let instructions = {
            use vitriol_run::Action as It;
            [
                It::Intensity(0.125),
                It::Pause(false),
                It::Speed(0.5),
                It::Speed(1.0),
                It::Mute(true),
                It::Mute(false),
                It::Message(String::new()),
            ]
        };
        let instructed = instructions.iter().map(|it| words.instruction(it));
        for text in scenes.chain(said).chain(instructed) {
            let wide = width(&context, &text, SIZE);
            assert!(wide <= room, "{language}: {text:?} {wide} of {room}");
        }
        let summary = &texts.summary;
        let heads =
            [&summary.title, &summary.points(100, 100)].map(|it| width(&context, it, HEADING));
        assert!(heads.iter().sum::<f32>() + 24.0 <= room, "{language}");
        let back = width(&context, &format!("S   {}", summary.back), SIZE);
        assert!(back <= 0.5 * room - 2.0 * PADDING, "{language}");
    }
}

/// Each character of each table has a picture of its own: the panel's and the lessons'.
#[test]
fn every_text_of_the_panel_can_be_shown() {
    let context = context();
    let font = FontId::proportional(SIZE);
    let folders = ["../texts", "../lesson/texts"].into_iter();
    for (folder, language) in folders.flat_map(|it| Language::ALL.map(|language| (it, language))) {
        let table = std::fs::read_to_string(format!("{folder}/{language}.toml")).unwrap();
        let missing: Vec<char> = context.fonts_mut(|fonts| {
            let texts = table.lines().filter(|line| !line.starts_with('#'));
            let all = texts.flat_map(str::chars).filter(|it| !it.is_whitespace());
            all.filter(|it| !fonts.has_glyph(&font, *it)).collect()
        });
        assert!(missing.is_empty(), "{folder}/{language}: {missing:?}");
    }
}
