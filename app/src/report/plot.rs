//! Plots over time, as inline SVG.

use plotters::prelude::*;
use vitriol_lesson::Texts;
use vitriol_run::page::{AXIS, CURVE_COLOURS, GRID};

const WIDTH: u32 = 640;
const HEIGHT: u32 = 270;
/// Room for the numbers beside and below the axes, pixels.
const LEFT: u32 = 58;
const BOTTOM: u32 = 34;
const MARGIN: u32 = 10;

/// One curve: its name in the legend and its points (time in s, value in the
/// plot's unit).
pub struct Curve {
    /// Name in the legend.
    pub label: String,
    /// (s, value); non-finite points are left out.
    pub points: Vec<(f64, f64)>,
}

/// A finished plot.
pub struct Plot {
    /// The SVG element.
    pub svg: String,
    /// Horizontal pixels of the plotting area, first and last.
    pub span: (i32, i32),
    /// Simulated time at those, s.
    pub time: (f64, f64),
}

/// Draws curves over time, zero included, with numbers as these texts write
/// them; `None` where there is nothing to draw.
pub fn over_time(curves: &[Curve], texts: &Texts) -> Option<Plot> {
    let finite = |curve: &Curve| -> Vec<(f64, f64)> {
        let points = curve.points.iter().copied();
        points
            .filter(|(t, value)| t.is_finite() && value.is_finite())
            .collect()
    };
    let curves: Vec<_> = curves.iter().map(finite).collect();
    let all = || curves.iter().flatten();
    let end = all().map(|point| point.0).fold(0.0, f64::max);
    let top = all().map(|point| point.1).fold(0.0, f64::max);
    if end <= 0.0 {
        return None;
    }
    let bottom = all().map(|point| point.1).fold(0.0, f64::min);
    let top = if top > 0.0 || bottom < 0.0 { top } else { 1.0 };
    let room = 0.06 * (top - bottom);
    let bottom = if bottom < 0.0 { bottom - room } else { 0.0 };

    let mut svg = String::new();
    let span = draw(&mut svg, &curves, end, [bottom, top + room], texts).ok()?;
    Some(Plot {
        svg,
        span,
        time: (0.0, end),
    })
}

type DrawError = DrawingAreaErrorKind<std::io::Error>;

fn draw(
    svg: &mut String,
    curves: &[Vec<(f64, f64)>],
    end: f64,
    [bottom, top]: [f64; 2],
    texts: &Texts,
) -> Result<(i32, i32), DrawError> {
    let area = SVGBackend::with_string(svg, (WIDTH, HEIGHT)).into_drawing_area();
    let mut chart = ChartBuilder::on(&area)
        .margin(MARGIN)
        .x_label_area_size(BOTTOM)
        .y_label_area_size(LEFT)
        .build_cartesian_2d(0.0..end, bottom..top)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(AXIS)
        .label_style(("sans-serif", 18))
        .x_labels(7)
        .y_labels(5)
        .x_label_formatter(&|t| format!("{} s", texts.with_decimal(&trimmed(*t))))
        .y_label_formatter(&|value| texts.with_decimal(&trimmed(*value)))
        .draw()?;
    for (index, points) in curves.iter().enumerate() {
        let colour = CURVE_COLOURS[index % CURVE_COLOURS.len()];
        chart.draw_series(LineSeries::new(
            points.iter().copied(),
            colour.stroke_width(2),
        ))?;
    }
    let (span, _) = chart.plotting_area().get_pixel_range();
    drop(chart);
    area.present()?;
    Ok((span.start, span.end))
}

/// An axis label: up to three decimals, without trailing zeros.
fn trimmed(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
mod tests {
    use vitriol_lesson::Language;

    use super::*;

    fn curve(points: &[(f64, f64)]) -> Curve {
        Curve {
            label: "x".into(),
            points: points.to_vec(),
        }
    }

    #[test]
    fn points_land_where_their_values_say() {
        let curves = [curve(&[(0.0, 0.0), (1.0, f64::NAN), (2.0, 5.0)])];
        let plot = over_time(&curves, &Texts::english().unwrap()).unwrap();
        let line = plot
            .svg
            .split("<polyline")
            .find(|part| part.contains("#0072B2"))
            .unwrap();
        let points = line.split("points=\"").nth(1).unwrap();
        let points: Vec<(f64, f64)> = points
            .split('"')
            .next()
            .unwrap()
            .split_whitespace()
            .map(|pair| {
                let (x, y) = pair.split_once(',').unwrap();
                (x.parse().unwrap(), y.parse().unwrap())
            })
            .collect();
        assert_eq!(points.len(), 2, "the NaN is left out");
        let (left, right) = plot.span;
        // A pixel of rounding at either end.
        assert!((points[0].0 - f64::from(left)).abs() <= 1.0);
        assert!((points[1].0 - f64::from(right)).abs() <= 1.0);
        assert!(points[1].1 < points[0].1, "larger values are higher up");
    }

    #[test]
    fn nothing_to_draw_is_no_plot() {
        let texts = Texts::english().unwrap();
        let none = |curves: &[Curve]| over_time(curves, &texts).is_none();
        assert!(none(&[]));
        assert!(none(&[curve(&[])]));
        assert!(none(&[curve(&[(f64::NAN, 1.0)])]));
    }

    /// Labels are lines of their own in the SVG; points of curves, which have commas too, are not.
    #[test]
    fn labels_have_the_decimal_mark_of_the_language() {
        let curves = [curve(&[(0.0, 0.0), (1.0, 0.5)])];
        for (language, mark, other) in [(Language::En, '.', ','), (Language::De, ',', '.')] {
            let texts = Texts::of(language).unwrap();
            let svg = over_time(&curves, &texts).unwrap().svg;
            let lines = svg.lines().map(str::trim);
            let labels: Vec<_> = lines.filter(|it| it.starts_with('0')).collect();
            let has = |mark: char| labels.iter().any(|it| it.contains(mark));
            assert!(has(mark) && !has(other), "{language}: {labels:?}");
        }
    }

    #[test]
    fn labels_have_no_trailing_zeros() {
        assert_eq!(trimmed(2.0), "2");
        assert_eq!(trimmed(0.125), "0.125");
        assert_eq!(trimmed(-0.0), "0");
        assert_eq!(trimmed(100.0), "100");
    }
}
