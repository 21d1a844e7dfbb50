//! A lesson on the panel: what is to be done, and what can be asked for.

use egui::{Align, Button, Color32, Label, Layout, RichText, Ui, vec2};
use vitriol_run::Action;

use super::aimed::Aimed;
use super::colours::{FAINT, GOOD, TEXT, WARNING, WHITE};
use super::view::{LOW, Seen};
use crate::decision::Decision;
use crate::info::{Mark, Shown};
use crate::menu;

/// What is to be done, its steps where they are listed, why something failed or else how to do it, and the answers to its question.
/// `seen` takes in which answer is pointed at and pressed.
pub fn told(ui: &mut Ui, shown: &Shown, seen: &mut Seen) {
    ui.label(RichText::new(&shown.step).color(WHITE));
    for (mark, text) in &shown.steps {
        ui.horizontal_top(|ui| step(ui, *mark, text));
    }
    let note = shown.note.iter().map(|line| (line, FAINT));
    let more = shown.failed.as_ref().or(shown.hint.as_ref());
    for (line, colour) in note.chain(more.map(|line| (line, WARNING))) {
        ui.label(RichText::new(line).color(colour));
    }
    for (answer, text, key) in answers(shown) {
        let size = vec2(ui.available_width(), LOW);
        let text = label(key, text);
        let button = ui.add(Button::new(text.as_str()).min_size(size));
        seen.aimed = Aimed::at(&button, &text, false).or(seen.aimed.take());
        if button.clicked() {
            seen.clicked = Some(Decision::Act(Action::Answer { step: None, answer }));
        }
    }
}

/// The answers that can be given: number, text and key.
fn answers(shown: &Shown) -> impl Iterator<Item = (u8, &str, char)> {
    let numbered = (1..).zip(&shown.answers).zip(menu::ANSWERS);
    numbered.map(|((answer, text), key)| (answer, text.as_str(), key))
}

/// A button's text: its key, and what it does.
pub fn label(key: char, text: &str) -> String {
    format!("{}   {text}", key.to_ascii_uppercase())
}

fn step(ui: &mut Ui, mark: Mark, text: &str) {
    let (sign, colour, of_text): (_, Color32, Color32) = match mark {
        Mark::Done => ("✔", GOOD, FAINT),
        Mark::Missed => ("✖", WARNING, FAINT),
        Mark::Open => ("▶", WHITE, WHITE),
        Mark::Waiting => ("•", FAINT, FAINT),
    };
    marked(ui, (sign, colour), (text, of_text));
}

/// A text behind a sign, each in its colour: the sign tells by its shape as well.
pub fn marked(ui: &mut Ui, sign: (&str, Color32), text: (&str, Color32)) {
    let coloured = |(text, colour): (&str, Color32)| Label::new(RichText::new(text).color(colour));
    let size = vec2(34.0, TEXT);
    let centred = Layout::top_down(Align::Center);
    ui.allocate_ui_with_layout(size, centred, |ui| ui.add(coloured(sign)));
    let rest = vec2(ui.available_width(), TEXT);
    let text = coloured(text).wrap();
    ui.allocate_ui_with_layout(rest, Layout::top_down(Align::Min), |ui| ui.add(text));
}

/// What can be asked for, each with its key and whether it can now.
pub fn asks(shown: &Shown) -> impl Iterator<Item = (String, bool, Decision)> {
    shown.acts.iter().map(|line| {
        let key = match &line.act {
            Action::Hint(_) => menu::HINT,
            Action::Skip(_) => menu::SKIP,
            _ => menu::FINISH,
        };
        (
            label(key, &line.text),
            line.on,
            Decision::Act(line.act.clone()),
        )
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic)]
mod tests {
    use super::super::{PANEL, input, view};
    use super::*;
    use crate::info::{ActLine, FlaskLine, Info};
    use egui::{Pos2, RawInput, Rect, Shape, Vec2};
    use vitriol_lesson::{Language, Texts};

    /// Pixels of the panel's edge that no text comes to.
    const MARGIN: f32 = 20.0;

    /// A session in a scene with acid, and with this lesson.
    fn with(lesson: Shown) -> Info {
        let flask = |name: &str| FlaskLine {
            broken: false,
            name: name.into(),
            temperature: Some(117),
            acid: Some(71),
        };
        Info {
            scene: "acid-into-water".into(),
            title: "Acid into water".into(),
            flasks: vec![flask("Beaker with 98 % acid"), flask("Beaker with water")],
            acid: true,
            burns: [true, false, false],
            lesson: Some(lesson),
            ..Info::default()
        }
    }

    /// Where each text is on a panel that shows this session.
    fn texts(info: &Info) -> Vec<(String, Rect)> {
        let words = vitriol_run::texts::Texts::english().unwrap().panel;
        let context = view::context();
        // The height of a strip is known from its second frame on.
        let mut shapes = Vec::new();
        for _ in 0..2 {
            let output = context.run(input(Vec::new()), |context| {
                view::show(context, (info, &words), None, None);
            });
            shapes = output.shapes;
        }
        let mut found = Vec::new();
        for clipped in shapes {
            if let Shape::Text(text) = &clipped.shape {
                found.push((
                    text.galley.text().to_owned(),
                    clipped.shape.visual_bounding_rect(),
                ));
            }
        }
        found
    }

    /// As much text as a lesson may have, in a language's longest words: fifty characters a line, and half of them of Chinese.
    fn longest(language: Language) -> Shown {
        let texts = Texts::of(language).unwrap();
        let (word, most) = match language {
            Language::Zh => ("硫酸倒入水中", 54 / 2),
            Language::De => ("Säure in das Wasser ", 54),
            Language::Es => ("el ácido en el agua ", 54),
            Language::En => ("the acid into water ", 54),
        };
        let lines = |count: usize| word.chars().cycle().take(most * count).collect::<String>();
        let act = |act, text| ActLine {
            act,
            text,
            on: true,
        };
        Shown {
            step: lines(1),
            // Nine lines, of which a hint has three.
            steps: [
                (Mark::Done, 1),
                (Mark::Missed, 1),
                (Mark::Open, 1),
                (Mark::Waiting, 1),
                (Mark::Waiting, 1),
            ]
            .map(|(mark, count)| (mark, lines(count)))
            .to_vec(),
            note: Some(texts.panel.more.fill(&[("number", "45")])),
            hint: Some(lines(3)),
            failed: None,
            acts: vec![
                act(Action::Hint(None), texts.panel.hint.to_string()),
                act(Action::Skip(None), texts.panel.skip.to_string()),
                act(Action::Finish, texts.panel.finish.to_string()),
            ],
            answers: Vec::new(),
            quiet: false,
        }
    }

    /// The longest question in a language: three lines with its number, three answers, and a hint, as a guided lesson shows it.
    fn asking(language: Language) -> Shown {
        let longest = longest(language);
        let hint = longest.hint.clone().unwrap();
        let answer = |at: usize| -> String {
            let most = if language == Language::Zh { 25 } else { 50 };
            hint.chars().skip(at).take(most).collect()
        };
        Shown {
            step: hint.chars().rev().collect(),
            steps: Vec::new(),
            note: None,
            answers: [0, 1, 2].map(answer).to_vec(),
            acts: longest.acts[..2].to_vec(),
            ..longest
        }
    }

    /// Texts, buttons and readings are on the panel, one beside the other, in each language.
    #[test]
    fn a_lesson_fits_the_panel_in_each_language() {
        let [width, height] = PANEL.map(|side| side as f32);
        let inside = Rect::from_min_size(Pos2::ZERO, Vec2::new(width, height)).shrink(MARGIN);
        let all = Language::ALL.into_iter();
        for (language, shown) in all.flat_map(|it| [(it, longest(it)), (it, asking(it))]) {
            let found = texts(&with(shown.clone()));
            let place = |part: &str| {
                let at = found.iter().find(|(text, _)| text.contains(part));
                at.unwrap_or_else(|| panic!("{language}: {part} is not shown"))
                    .1
            };
            for (text, rect) in &found {
                let within = rect.left() >= inside.left() && rect.right() <= inside.right();
                assert!(
                    within && rect.bottom() <= inside.bottom(),
                    "{language}: {text} {rect:?}"
                );
            }
            let mut lowest = place(shown.hint.as_ref().unwrap()).bottom();
            // Each answer is a line, one below the other.
            for (_, text, key) in answers(&shown) {
                let button = place(&label(key, text));
                assert!(button.top() > lowest, "{language}: {text}");
                assert!(button.height() < 46.0, "{language}: {text}");
                lowest = button.bottom();
            }
            for act in &shown.acts {
                let button = place(&act.text);
                assert!(button.top() > lowest, "{language}: {}", act.text);
                assert!(
                    button.height() < 46.0,
                    "{language}: {} has two lines",
                    act.text
                );
            }
            assert!(place("What happened").bottom() < inside.bottom());
            // A line of the list is one.
            for (_, text) in &shown.steps {
                assert!(place(text).height() < 46.0, "{language}: {text}");
            }
        }
    }

    #[test]
    fn each_sign_can_be_shown() {
        let context = view::context();
        let _ = context.run(RawInput::default(), |_| {});
        let font = egui::FontId::proportional(TEXT);
        for sign in ['✔', '✖', '▶', '•'] {
            assert!(
                context.fonts_mut(|fonts| fonts.has_glyph(&font, sign)),
                "{sign}"
            );
        }
    }

    /// In a lesson its own buttons stand in place of the scenes'; a user who is examined is told nothing of what happened.
    #[test]
    fn a_lesson_has_its_own_buttons() {
        let has = |shown: &Shown, part: &str| {
            let found = texts(&with(shown.clone()));
            found.iter().any(|(text, _)| text.contains(part))
        };
        let shown = longest(Language::En);
        assert!(has(&shown, "H   Hint") && has(&shown, "F   I am done"));
        assert!(has(&shown, "What happened") && !has(&shown, "1 acid"));
        let over = Shown {
            acts: Vec::new(),
            ..shown.clone()
        };
        // Nor does it tell which order is correct, where the next lesson asks.
        assert!(has(&over, "1 acid") && !has(&over, "H   Hint"));
        assert!(!has(&over, "2 ✖") && !has(&over, "1 ✔"));
        assert!(has(&shown, "71 % acid") && has(&shown, "acid on your left hand"));
        let quiet = Shown {
            quiet: true,
            ..shown
        };
        assert!(!has(&quiet, "What happened") && has(&quiet, "From the start"));
        // Nor what it is judged by; how warm it is anybody can feel.
        assert!(!has(&quiet, "71 % acid") && !has(&quiet, "acid on your"));
        assert!(has(&quiet, "117"));
    }

    /// Where a mouse moves the hands, its line stands under all buttons, and none recentres.
    #[test]
    fn a_mouse_has_a_line_under_the_buttons() {
        let words = vitriol_run::texts::Texts::english().unwrap().panel;
        let of = |pointer| {
            texts(&Info {
                pointer,
                ends: true,
                ..with(longest(Language::En))
            })
        };
        let (seen, worn) = (of(true), of(false));
        let has = |found: &[(String, Rect)], part: &str| found.iter().any(|it| it.0.contains(part));
        assert!(has(&worn, &words.recentre) && !has(&worn, &words.mouse));
        assert!(!has(&seen, &words.recentre) && has(&seen, &words.ends("Esc")));
        let (line, others): (Vec<_>, Vec<_>) = seen.into_iter().partition(|it| it.0 == words.mouse);
        let lowest = others.iter().map(|it| it.1.max.y).fold(0.0, f32::max);
        assert_eq!(line.len(), 1);
        assert!(line[0].1.min.y >= lowest, "{line:?} {lowest}");
    }

    /// A button changes to the other order, where scenes can be chosen. It keeps its place where the scene has no other order.
    #[test]
    fn scenes_have_a_button_for_the_other_order() {
        let place = |info: &Info| {
            let mut found = texts(info).into_iter();
            let other = found.find(|(text, _)| text == "T   The other order");
            other.map(|(_, place)| place)
        };
        let of = |scene: &str| Info {
            scene: scene.into(),
            ..Info::default()
        };
        let places = ["layer-and-swirl", "hot-acid", "two-flasks"].map(|scene| place(&of(scene)));
        assert!(places[0].is_some() && places[1..].iter().all(|it| *it == places[0]));
        assert!(place(&with(longest(Language::En))).is_none());
    }
}
