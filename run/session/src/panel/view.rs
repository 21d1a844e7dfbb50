//! The panel's layout.

use egui::epaint::text::{FontInsert, FontPriority, InsertFontFamily};
use egui::{
    Align, Align2, Button, CentralPanel, Color32, Context, CornerRadius, FontData, FontFamily,
    FontId, Frame, Layout, Margin, Painter, Pos2, Rect, RichText, Sense, Shape, Stroke, TextStyle,
    TopBottomPanel, Ui, Vec2, pos2, vec2,
};
use std::f32::consts::TAU;
use vitriol_lesson::Tone;
use vitriol_render::tints;
use vitriol_run::Action;

use super::aimed::Aimed;
use super::colours::{CHOSEN, COLD, FAINT, GOOD, HOT, RECORDING, SAID, TEXT, WARNING, WHITE};
use super::lesson;
use crate::decision::Decision;
use crate::info::{FlaskLine, Happened, Info, burns_text};
use crate::menu;
use vitriol_run::choices::{self, Choice};
use vitriol_run::texts::PanelTexts;

const HEADING: f32 = 34.0;
/// Height of a button with one line of text, pixels.
pub(super) const LOW: f32 = 46.0;
/// Height of a button with two lines.
const TALL: f32 = 76.0;
/// Scenes' buttons beside each other: so nine of them have room where an instructor's longest message stands above them.
pub(super) const BESIDE: usize = 3;

/// Where a thermometer's column ends, °C.
const RANGE: [f32; 2] = [0.0, 180.0];

/// Chinese characters, which egui's own fonts lack: see `run/session/fonts`.
const HAN: &[u8] = include_bytes!("../../fonts/han.ttf");

/// A context with the panel's fonts, sizes and colours.
pub fn context() -> Context {
    let context = Context::default();
    let behind = InsertFontFamily {
        family: FontFamily::Proportional,
        priority: FontPriority::Lowest,
    };
    let han = FontInsert::new("han", FontData::from_static(HAN), vec![behind]);
    context.add_font(han);
    context.all_styles_mut(|style| {
        for text in [TextStyle::Body, TextStyle::Button] {
            style.text_styles.insert(text, FontId::proportional(TEXT));
        }
        style
            .text_styles
            .insert(TextStyle::Heading, FontId::proportional(HEADING));
        style.visuals.override_text_color = Some(WHITE);
        style.visuals.selection.bg_fill = CHOSEN;
        style.spacing.item_spacing = vec2(12.0, 9.0);
        // A trigger that is pulled on a text would mark it.
        style.interaction.selectable_labels = false;
        // No animations: the panel is drawn anew for each of their frames.
        style.animation_time = 0.0;
    });
    context
}

/// What a hand does on the panel.
#[derive(Debug, Default)]
pub struct Seen {
    /// What was pressed.
    pub clicked: Option<Decision>,
    /// What is being held that takes a hold.
    pub held: Option<Decision>,
    /// The button that it points at.
    pub aimed: Option<Aimed>,
}

/// Lays the panel out; `ring` is how far a button that is held has come, 0 to 1.
pub fn show(
    context: &Context,
    (info, words): (&Info, &PanelTexts),
    pointer: Option<Pos2>,
    ring: Option<f32>,
) -> Seen {
    let mut seen = Seen::default();
    told(context, info, &mut seen);
    if info.pointer {
        mouse(context, info, words);
    }
    let frame = Frame::new().inner_margin(Margin::same(22));
    CentralPanel::default().frame(frame).show(context, |ui| {
        match &info.happened {
            Some(happened) => summary(ui, (info, words), happened, &mut seen),
            None => ui.columns(2, |columns| {
                readings(&mut columns[0], info, words);
                buttons(&mut columns[1], (info, words), &mut seen);
            }),
        }
        let painter = ui.painter();
        if let Some(at) = pointer {
            painter.circle_filled(at, 9.0, Color32::from_rgba_premultiplied(120, 110, 40, 120));
            painter.circle_stroke(at, 9.0, Stroke::new(2.5, WHITE));
            if let Some(share) = ring {
                filling(painter, at, 24.0, share);
            }
        }
        if let Some(per_cent) = info.holding {
            let middle = ui.max_rect().center();
            let ground = Color32::from_rgba_unmultiplied(10, 12, 16, 225);
            painter.circle_filled(middle, 152.0, ground);
            filling(painter, middle, 134.0, per_cent as f32 / 100.0);
            let font = FontId::proportional(HEADING);
            painter.text(middle, Align2::CENTER_CENTER, &words.starting, font, WHITE);
        }
    });
    seen
}

/// The instructor's message and actions, or else the lesson, over all else: both together would leave no room for the buttons.
fn told(context: &Context, info: &Info, seen: &mut Seen) {
    let told = &info.told;
    let shown = info.lesson.as_ref().filter(|_| told.message.is_none());
    let said: Vec<&String> = (told.message.iter())
        .chain(&told.paused)
        .chain(&told.done)
        .collect();
    if shown.is_none() && said.is_empty() {
        return;
    }
    let margin = Margin::symmetric(22, 10);
    let frame = Frame::new().inner_margin(margin).fill(SAID);
    let strip = TopBottomPanel::top("told").frame(frame);
    strip.show_separator_line(false).show(context, |ui| {
        if let Some(shown) = shown {
            lesson::told(ui, shown, seen);
        }
        for line in said {
            ui.label(RichText::new(line).color(WHITE));
        }
    });
}

/// What mouse and keys do, under all else. A summary and an instructor's longest message need its room.
fn mouse(context: &Context, info: &Info, words: &PanelTexts) {
    if info.happened.is_some() || info.told.message.is_some() {
        return;
    }
    let frame = Frame::new().inner_margin(Margin::symmetric(22, 6));
    let strip = TopBottomPanel::bottom("mouse").frame(frame.fill(SAID));
    strip.show_separator_line(false).show(context, |ui| {
        ui.label(RichText::new(&words.mouse).color(WHITE));
    });
}

/// The key that ends the session, as a note names it.
fn end_key(info: &Info) -> String {
    match info.pointer {
        true => "Esc".to_owned(),
        false => menu::END.to_string(),
    }
}

/// A ring that fills from its top, clockwise.
fn filling(painter: &Painter, middle: Pos2, radius: f32, share: f32) {
    painter.circle_stroke(middle, radius, Stroke::new(6.0, Color32::from_gray(70)));
    let steps = (64.0 * share).ceil() as u32;
    let at = |step: u32| {
        let angle = TAU * share * step as f32 / steps as f32;
        middle + radius * vec2(angle.sin(), -angle.cos())
    };
    if steps > 0 {
        let points = (0..=steps).map(at).collect();
        painter.add(Shape::line(points, Stroke::new(6.0, WARNING)));
    }
}

/// The summary, over the whole panel.
fn summary(ui: &mut Ui, (info, words): (&Info, &PanelTexts), happened: &Happened, seen: &mut Seen) {
    ui.horizontal(|ui| {
        ui.heading(&happened.title);
        if let Some(points) = &happened.points {
            ui.add_space(24.0);
            ui.heading(RichText::new(points).strong());
        }
    });
    ui.add_space(6.0);
    for (tone, text) in &happened.said {
        let sign = match tone {
            Tone::Good => ("✔", GOOD),
            Tone::Bad => ("⚠", WARNING),
            Tone::Plain => ("•", FAINT),
        };
        ui.horizontal_top(|ui| lesson::marked(ui, sign, (text, WHITE)));
    }
    lines(ui, [happened.more.clone()], FAINT);
    ui.add_space(8.0);
    let ends = (info.ends).then(|| words.ends(&end_key(info)));
    lines(ui, [ends], WARNING);
    let size = vec2(0.5 * ui.available_width(), LOW);
    let text = lesson::label(menu::SUMMARY, &happened.back);
    let button = ui.add(Button::new(text.as_str()).min_size(size));
    seen.aimed = Aimed::at(&button, &text, false).or(seen.aimed.take());
    if button.clicked() {
        seen.clicked = Some(Decision::Summary);
    }
}

fn readings(ui: &mut Ui, info: &Info, words: &PanelTexts) {
    ui.heading(&info.title);
    ui.add_space(6.0);
    // A user who is examined is told nothing that the lesson is judged by.
    let quiet = info.lesson.as_ref().is_some_and(|it| it.quiet);
    for flask in &info.flasks {
        let acid = flask.acid.filter(|_| !quiet);
        let flask = FlaskLine {
            acid,
            ..flask.clone()
        };
        thermometer(ui, &flask, words);
    }
    ui.add_space(8.0);
    if info.acid {
        legend(ui, words);
    }
    ui.add_space(8.0);
    if let Some(text) = info.pouring_text(words) {
        lines(ui, [Some(text)], WHITE);
    }
    let slow = info.slow;
    let notes = [
        info.spilt.text(&words.spilt).filter(|_| !quiet),
        burns_text(info.burns, &words.acid_on).filter(|_| !quiet),
        (info.device_lost).then(|| words.device_lost.clone()),
        slow.map(|per_cent| words.slow(per_cent)),
        info.effort.as_ref().map(|it| it.text(&words.effort)),
    ];
    lines(ui, notes, WARNING);
    let missed = (info.missed > 0).then(|| words.missed(info.missed));
    lines(ui, [missed], FAINT);
}

/// Shows the texts that are there, each in as many lines as it takes; a column alone would justify all but the last.
fn lines<const N: usize>(ui: &mut Ui, texts: [Option<String>; N], colour: Color32) {
    ui.with_layout(Layout::top_down(Align::Min), |ui| {
        for text in texts.into_iter().flatten() {
            ui.label(RichText::new(text).color(colour));
        }
    });
}

/// What the session does beside the bench.
fn state(ui: &mut Ui, info: &Info, words: &PanelTexts) {
    let coming = info.coming.as_ref();
    let ends = info.ends;
    let before = [
        coming.map(|coming| words.coming(coming)),
        ends.then(|| words.ends(&end_key(info))),
    ];
    lines(ui, before, WARNING);
    lines(ui, [info.heard.clone()], WHITE);
    let seconds = info.recording;
    let recording = seconds.map(|seconds| words.recording(seconds));
    lines(ui, [recording], RECORDING);
    let unwritten = info.unwritten;
    let trouble = [
        (info.waits_for_disk).then(|| words.waits.clone()),
        (unwritten > 0).then(|| words.unwritten(unwritten)),
    ];
    lines(ui, trouble, WARNING);
}

fn thermometer(ui: &mut Ui, flask: &FlaskLine, words: &PanelTexts) {
    lines(ui, [Some(flask.name.clone())], FAINT);
    let wide = ui.available_width();
    let (rect, _) = ui.allocate_exact_size(vec2(wide, 34.0), Sense::hover());
    let painter = ui.painter();
    let tube = Rect::from_min_size(rect.min, vec2(0.47 * wide, 22.0));
    let round = CornerRadius::same(11);
    painter.rect_filled(tube, round, Color32::from_gray(48));
    let share = |celsius: f32| ((celsius - RANGE[0]) / (RANGE[1] - RANGE[0])).clamp(0.0, 1.0);
    if let Some(celsius) = flask.temperature {
        let share = share(celsius as f32);
        let column = Rect::from_min_size(
            tube.min,
            vec2(22.0 + share * (tube.width() - 22.0), tube.height()),
        );
        painter.rect_filled(column, round, COLD.lerp_to_gamma(HOT, share));
    }
    for celsius in [50.0, 100.0, 150.0] {
        let x = tube.min.x + 11.0 + share(celsius) * (tube.width() - 22.0);
        let ends = [pos2(x, tube.max.y + 2.0), pos2(x, tube.max.y + 8.0)];
        painter.line_segment(ends, Stroke::new(2.0, FAINT));
    }
    let celsius = flask.temperature;
    let text = match celsius {
        _ if flask.broken => words.broken.clone(),
        None => "–".to_owned(),
        Some(celsius) => format!("{celsius} °C"),
    };
    let at = pos2(tube.max.x + 14.0, tube.center().y);
    let font = FontId::proportional(TEXT + 3.0);
    painter.text(at, Align2::LEFT_CENTER, text, font, WHITE);
    if let Some(acid) = flask.acid {
        let at = pos2(rect.max.x, tube.center().y);
        let (text, font) = (words.acid(acid), FontId::proportional(TEXT));
        painter.text(at, Align2::RIGHT_CENTER, text, font, FAINT);
    }
}

/// The tints, and that they are artificial.
fn legend(ui: &mut Ui, words: &PanelTexts) {
    ui.horizontal(|ui| {
        let tinted = [
            (tints::WATER, &words.water),
            (tints::ACID, &words.sulfuric_acid),
        ];
        for (tint, name) in tinted {
            let channels = tints::seen_through(tint);
            let [r, g, b] = channels.map(|share| (255.0 * share).round() as u8);
            let (rect, _) = ui.allocate_exact_size(Vec2::splat(24.0), Sense::hover());
            let painter = ui.painter();
            painter.rect_filled(rect, CornerRadius::same(4), Color32::from_rgb(r, g, b));
            ui.label(name);
        }
    });
    lines(ui, [Some(words.tints.clone())], FAINT);
}

/// What stands on a scene's button. A sign says the order, since its word has no room there.
pub(super) fn scene_text(choice: &Choice, words: &PanelTexts, in_lesson: bool) -> String {
    let sign = choice.sign(in_lesson);
    format!("{}{sign} {}", choice.key, words.button(choice.scene))
}

fn buttons(ui: &mut Ui, (info, words): (&Info, &PanelTexts), seen: &mut Seen) {
    let mut button = |ui: &mut Ui, line: (String, f32), chosen: bool, decision: Decision| {
        let (text, height) = line;
        let size = vec2(ui.available_width(), height);
        let button = Button::new(text.as_str());
        let answer = ui.add(button.min_size(size).selected(chosen));
        let aimed = Aimed::at(&answer, &text, decision.loses_work());
        seen.aimed = aimed.or(seen.aimed.take());
        if decision.loses_work() {
            if answer.is_pointer_button_down_on() && answer.contains_pointer() {
                seen.held = Some(decision);
            }
        } else if answer.clicked() {
            seen.clicked = Some(decision);
        }
    };
    lines(ui, [Some(words.hold.clone())], FAINT);
    let shown = info.lesson.as_ref();
    let asks = shown.into_iter().flat_map(lesson::asks);
    let asks: Vec<_> = asks.collect();
    // In a lesson its own buttons stand in place of the scenes'.
    let offers = asks.is_empty();
    for (text, on, decision) in asks {
        ui.add_enabled_ui(on, |ui| button(ui, (text, LOW), false, decision));
    }
    if offers {
        ui.columns(BESIDE, |columns| {
            for (at, choice) in choices::on_panel().enumerate() {
                let text = scene_text(choice, words, shown.is_some());
                let decision = Decision::Act(Action::Scene(choice.scene.into()));
                let chosen = info.scene == choice.scene;
                button(&mut columns[at % BESIDE], (text, TALL), chosen, decision);
            }
        });
    }
    let start = lesson::label(menu::START, &words.start);
    button(ui, (start, LOW), false, Decision::Act(Action::Start(None)));
    if offers {
        // Always in its place, so that the others stay in theirs.
        let other = lesson::label(menu::TOGGLE, &words.other_order);
        let on = choices::counterpart(&info.scene).is_some();
        ui.add_enabled_ui(on, |ui| button(ui, (other, LOW), false, Decision::Toggle));
    }
    ui.add_space(10.0);
    if !info.pointer {
        let recentre = lesson::label(menu::RECENTRE, &words.recentre);
        button(ui, (recentre, LOW), false, Decision::Recentre);
    }
    if !shown.is_some_and(|it| it.quiet) {
        let summary = lesson::label(menu::SUMMARY, &words.happened);
        button(ui, (summary, LOW), false, Decision::Summary);
    }
    state(ui, info, words);
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::painter::GROUND;
    use crate::panel::{PANEL, SIZE, WIDTH, scene_from_panel};
    use crate::placement::{SCENE_TABLE, SEATED, STANDING};
    use glam::Vec3;

    /// Degrees that a line of text has to have, from its ascenders to its descenders.
    const LINE: f32 = 1.2;
    /// WCAG 2.1, success criterion 1.4.6 (AAA).
    const CONTRAST: f32 = 7.0;

    /// As an eye over the scene's origin sees it, in each corner of the panel and in its middle.
    #[test]
    fn lines_are_seen_at_one_degree_and_a_fifth() {
        let context = context();
        let _ = context.run(egui::RawInput::default(), |_| {});
        let font = FontId::proportional(TEXT);
        let pixels = context.fonts_mut(|fonts| fonts.row_height(&font));
        let line = pixels * WIDTH / PANEL[0] as f32;
        let half = SIZE.map(|side| 0.5 * side);
        for drop in [SEATED, STANDING] {
            let eye = Vec3::Y * (SCENE_TABLE + drop);
            for x in [-1.0, 0.0, 1.0] {
                for y in [-1.0, 0.0, 1.0] {
                    let seen = |up: f32| {
                        let at = Vec3::new(half[0] * x, half[1] * y + up, 0.0);
                        scene_from_panel().transform_point(at) - eye
                    };
                    let ends = [-0.5, 0.5].map(|share| seen(share * line));
                    let angle = ends[0].angle_between(ends[1]).to_degrees();
                    assert!(
                        angle >= LINE,
                        "{angle}° at {x}, {y}, {drop} m over the table"
                    );
                }
            }
        }
    }

    /// Relative luminance, as WCAG 2.1 defines it.
    fn luminance(colour: Color32) -> f32 {
        let [r, g, b] = [colour.r(), colour.g(), colour.b()].map(|level| {
            let share = f32::from(level) / 255.0;
            match share <= 0.03928 {
                true => share / 12.92,
                false => ((share + 0.055) / 1.055).powf(2.4),
            }
        });
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    #[test]
    fn text_stands_out_from_its_ground() {
        let visuals = context().style().visuals.clone();
        let [r, g, b, _] = GROUND.map(|share| (255.0 * share).round() as u8);
        let ground = Color32::from_rgb(r, g, b);
        let mut pairs = [WHITE, FAINT, WARNING, RECORDING, GOOD]
            .map(|text| (text, ground))
            .to_vec();
        // What buttons are drawn on, at rest, pointed at, pressed and chosen.
        let widgets = &visuals.widgets;
        let faces = [
            &widgets.inactive,
            &widgets.hovered,
            &widgets.active,
            &widgets.open,
        ];
        pairs.extend(faces.map(|face| (WHITE, face.weak_bg_fill)));
        pairs.push((WHITE, visuals.selection.bg_fill));
        pairs.extend([(WHITE, SAID), (WARNING, SAID)]);
        for (text, ground) in pairs {
            let [bright, dark] = [text, ground].map(luminance);
            let contrast = (bright + 0.05) / (dark + 0.05);
            assert!(contrast >= CONTRAST, "{contrast} of {text:?} on {ground:?}");
        }
    }
}
