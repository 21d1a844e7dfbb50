//! Errors over frame times, both logarithmic, as inline SVG.

use maud::html;
use plotters::prelude::*;
use vitriol_run::page::{AXIS, CURVE_COLOURS, GRID};
use vitriol_run::units::{percent, three_digits};

use super::front::front;

/// A setting in the plot.
pub struct Dot<'a> {
    /// Time, ms.
    pub cost: f64,
    /// Error, relative.
    pub error: f64,
    /// Text that is shown where the mouse rests on it.
    pub title: String,
    /// The preset's name, where it is one.
    pub preset: Option<&'a str>,
}

/// Least error that is drawn: smaller ones are at the bottom.
const LEAST: f64 = 1e-6;

const SIZE: (u32, u32) = (640, 400);
/// Colour of the presets' names; the page's style sheet replaces it.
const INK: RGBColor = RGBColor(0x1d, 0x23, 0x26);
const TEXT: (&str, u32) = ("sans-serif", 16);

/// Draws the settings, and a line along their front; `None` where there is
/// nothing to draw.
pub fn scatter(dots: &[Dot<'_>]) -> Option<String> {
    let values: Vec<(f64, f64)> = dots.iter().map(|d| (d.cost, d.error.max(LEAST))).collect();
    let across = span(values.iter().map(|value| value.0))?;
    let up = span(values.iter().map(|value| value.1))?;
    let mut svg = String::new();
    let places = draw(&mut svg, dots, &values, [across, up]).ok()?;
    // Plotters has no titles: they are on invisible circles.
    let titles = html! {
        @for (dot, (x, y)) in dots.iter().zip(places) {
            circle cx=(x) cy=(y) r="7" fill="none" pointer-events="all" { title { (dot.title) } }
        }
    };
    let end = svg.rfind("</svg>")?;
    svg.insert_str(end, &titles.into_string());
    Some(svg)
}

type DrawError = DrawingAreaErrorKind<std::io::Error>;

/// Position of each dot, pixels.
fn draw(
    svg: &mut String,
    dots: &[Dot<'_>],
    values: &[(f64, f64)],
    [across, up]: [[f64; 2]; 2],
) -> Result<Vec<(i32, i32)>, DrawError> {
    let area = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    let axis = |[low, high]: [f64; 2]| {
        let range = (low..high).log_scale();
        range.with_key_points(ticks([low, high]))
    };
    let mut chart = ChartBuilder::on(&area)
        .margin(12)
        .margin_right(60)
        .x_label_area_size(52)
        .y_label_area_size(74)
        .build_cartesian_2d(axis(across), axis(up))?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(AXIS)
        .label_style(TEXT)
        .x_desc("ms for 1/90 s")
        .x_label_formatter(&|ms| three_digits(*ms))
        .y_label_formatter(&|error| percent(*error))
        .draw()?;
    let [colour, of_preset, ..] = CURVE_COLOURS;
    let best = front(values);
    let line = best.iter().map(|&index| values[index]);
    chart.draw_series(LineSeries::new(line, colour.stroke_width(2)))?;
    chart.draw_series(values.iter().enumerate().map(|(index, &at)| {
        let style = if best.contains(&index) {
            colour.filled()
        } else {
            AXIS.stroke_width(1)
        };
        Circle::new(at, 4, style)
    }))?;
    let presets = || {
        let presets = dots.iter().zip(values);
        presets.filter_map(|(dot, &at)| Some((dot.preset?.to_owned(), at)))
    };
    chart.draw_series(presets().map(|(_, at)| Circle::new(at, 8, of_preset.stroke_width(2))))?;
    chart.draw_series(presets().map(|(name, at)| {
        EmptyElement::at(at) + Text::new(name, (11, -18), TEXT.into_font().color(&INK))
    }))?;
    let places = values.iter().map(|at| chart.backend_coord(at)).collect();
    drop(chart);
    area.present()?;
    Ok(places)
}

/// Ends of an axis that holds all values that can be drawn.
pub(crate) fn span(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let (low, high) = values
        .filter(|value| value.is_finite() && *value > 0.0)
        .fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
    (high > 0.0).then_some([0.8 * low, 1.25 * high])
}

/// 1, 2 and 5 of each decade; decades alone where there are many.
pub(crate) fn ticks([low, high]: [f64; 2]) -> Vec<f64> {
    let steps: &[f64] = if (high / low).log10() > 3.0 {
        &[1.0]
    } else {
        &[1.0, 2.0, 5.0]
    };
    (-9..9)
        .flat_map(|power| steps.iter().map(move |step| step * 10f64.powi(power)))
        .filter(|tick| (low..=high).contains(tick))
        .collect()
}
