//! The panel's layout.

use egui::{
    Align, Align2, Button, CentralPanel, Color32, Context, CornerRadius, FontId, Frame, Layout,
    Margin, Painter, Pos2, Rect, RichText, Sense, Shape, Stroke, TextStyle, Ui, Vec2, pos2, vec2,
};
use std::f32::consts::TAU;
use vitriol_render::tints;

use crate::vr::decision::Decision;
use crate::vr::info::{FlaskLine, Info};
use crate::vr::menu::{self, CHOICES};

/// Least height of text on the panel, pixels: 13 mm, which at 0.8 m are 0.9°, twice what print at arm's length has.
const TEXT: f32 = 23.0;
const HEADING: f32 = 30.0;

const WHITE: Color32 = Color32::from_gray(235);
const FAINT: Color32 = Color32::from_gray(165);
const WARNING: Color32 = Color32::from_rgb(255, 176, 60);
const RECORDING: Color32 = Color32::from_rgb(240, 70, 60);
const COLD: Color32 = Color32::from_rgb(80, 150, 230);
const HOT: Color32 = Color32::from_rgb(235, 90, 40);

/// Where a thermometer's column ends, °C.
const RANGE: [f32; 2] = [0.0, 180.0];

/// Sets sizes and colours of a context.
pub fn style(context: &Context) {
    context.all_styles_mut(|style| {
        for text in [TextStyle::Body, TextStyle::Button] {
            style.text_styles.insert(text, FontId::proportional(TEXT));
        }
        style
            .text_styles
            .insert(TextStyle::Heading, FontId::proportional(HEADING));
        style.visuals.override_text_color = Some(WHITE);
        style.spacing.item_spacing = vec2(12.0, 9.0);
        // No animations: the panel is drawn anew for each of their frames.
        style.animation_time = 0.0;
    });
}

/// What a hand does on the panel.
#[derive(Debug, Default)]
pub struct Seen {
    /// What was pressed.
    pub clicked: Option<Decision>,
    /// What is being held that takes a hold.
    pub held: Option<Decision>,
}

/// Lays the panel out; `ring` is how far a button that is held has come, 0 to 1.
pub fn show(context: &Context, info: &Info, pointer: Option<Pos2>, ring: Option<f32>) -> Seen {
    let mut seen = Seen::default();
    let frame = Frame::new().inner_margin(Margin::same(22));
    CentralPanel::default().frame(frame).show(context, |ui| {
        ui.columns(2, |columns| {
            readings(&mut columns[0], info);
            buttons(&mut columns[1], info, &mut seen);
        });
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
            painter.circle_filled(middle, 130.0, ground);
            filling(painter, middle, 112.0, per_cent as f32 / 100.0);
            let font = FontId::proportional(HEADING);
            painter.text(middle, Align2::CENTER_CENTER, "from the start", font, WHITE);
        }
    });
    seen
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

fn readings(ui: &mut Ui, info: &Info) {
    ui.heading(&info.scene);
    ui.add_space(6.0);
    for flask in &info.flasks {
        thermometer(ui, flask);
    }
    ui.add_space(8.0);
    if info.acid {
        legend(ui);
    }
    ui.add_space(8.0);
    if let Some(per_cent) = info.slow {
        let text = format!("slow motion: {per_cent} % of real time");
        ui.label(RichText::new(text).color(WARNING));
    }
    if let Some(effort) = &info.effort {
        // It may have two lines, and a column would justify the first.
        ui.with_layout(Layout::top_down(Align::Min), |ui| {
            ui.label(RichText::new(effort.text()).color(WARNING));
        });
    }
    if let Some(seconds) = info.recording {
        let text = format!("recording, {} min {:02} s", seconds / 60, seconds % 60);
        ui.label(RichText::new(text).color(RECORDING));
    }
    if info.waits_for_disk {
        let text = "the recording waits: make room on the disk";
        ui.label(RichText::new(text).color(WARNING));
    }
    if info.unwritten > 0 {
        let text = format!("{} steps not recorded", info.unwritten);
        ui.label(RichText::new(text).color(WARNING));
    }
    if info.ends {
        let text = format!("{} again ends the session", menu::END);
        ui.label(RichText::new(text).color(WARNING));
    }
    if info.missed > 0 {
        let text = format!("{} pictures missed", info.missed);
        ui.label(RichText::new(text).color(FAINT));
    }
}

fn thermometer(ui: &mut Ui, flask: &FlaskLine) {
    ui.label(RichText::new(&flask.name).color(FAINT));
    let wide = ui.available_width();
    let (rect, _) = ui.allocate_exact_size(vec2(wide, 34.0), Sense::hover());
    let painter = ui.painter();
    let tube = Rect::from_min_size(rect.min, vec2(0.52 * wide, 22.0));
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
    let text = celsius.map_or("–".to_owned(), |celsius| format!("{celsius} °C"));
    let at = pos2(tube.max.x + 14.0, tube.center().y);
    let font = FontId::proportional(TEXT + 3.0);
    painter.text(at, Align2::LEFT_CENTER, text, font, WHITE);
    if let Some(acid) = flask.acid {
        let at = pos2(rect.max.x, tube.center().y);
        let (text, font) = (format!("{acid} % acid"), FontId::proportional(TEXT));
        painter.text(at, Align2::RIGHT_CENTER, text, font, FAINT);
    }
}

/// The tints, and that they are artificial.
fn legend(ui: &mut Ui) {
    ui.horizontal(|ui| {
        for (tint, name) in [(tints::WATER, "water"), (tints::ACID, "sulfuric acid")] {
            let channels = tints::seen_through(tint);
            let [r, g, b] = channels.map(|share| (255.0 * share).round() as u8);
            let (rect, _) = ui.allocate_exact_size(Vec2::splat(24.0), Sense::hover());
            let painter = ui.painter();
            painter.rect_filled(rect, CornerRadius::same(4), Color32::from_rgb(r, g, b));
            ui.label(name);
        }
    });
    ui.label(RichText::new("the tints are artificial").color(FAINT));
}

fn buttons(ui: &mut Ui, info: &Info, seen: &mut Seen) {
    let size = vec2(ui.available_width(), 46.0);
    let mut button = |ui: &mut Ui, text: String, chosen: bool, decision: Decision| {
        let button = Button::new(text).min_size(size).selected(chosen);
        let answer = ui.add(button);
        if decision.loses_work() {
            if answer.is_pointer_button_down_on() && answer.contains_pointer() {
                seen.held = Some(decision);
            }
        } else if answer.clicked() {
            seen.clicked = Some(decision);
        }
    };
    ui.label(RichText::new("hold for a second").color(FAINT));
    for choice in CHOICES {
        let text = format!("{}   {}", choice.key, choice.title);
        let decision = Decision::Scene(choice.scene.into());
        button(ui, text, info.scene == choice.scene, decision);
    }
    let key = |key: char| key.to_ascii_uppercase();
    let start = format!("{}   From the start", key(menu::START));
    button(ui, start, false, Decision::Start);
    ui.add_space(10.0);
    let recentre = format!("{}   Bench before me", key(menu::RECENTRE));
    button(ui, recentre, false, Decision::Recentre);
    if let Some(coming) = &info.coming {
        ui.label(RichText::new(format!("setting up {coming} …")).color(WARNING));
    }
}
