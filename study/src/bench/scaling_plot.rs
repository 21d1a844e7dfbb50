//! A frame's time over the number of particles, both logarithmic, as SVG.

use plotters::prelude::*;
use vitriol_run::page::{AXIS, CURVE_COLOURS, GRID};
use vitriol_run::units::{grouped, three_digits};

use super::report::ScalingRow;
use crate::trade::plot::{span, ticks};

const TEXT: (&str, u32) = ("sans-serif", 16);

/// A program's name and its (particles, ms).
type Curve = (String, Vec<(f64, f64)>);

/// Draws ours and each peer.
pub(super) fn draw(
    svg: &mut String,
    rows: &[ScalingRow],
) -> Result<(), DrawingAreaErrorKind<std::io::Error>> {
    let curves = curves(rows);
    let all = || curves.iter().flat_map(|(_, points)| points);
    let across = span(all().map(|point| point.0)).unwrap_or([1e3, 1e6]);
    let up = span(all().map(|point| point.1)).unwrap_or([0.1, 10.0]);
    let axis = |[low, high]: [f64; 2]| {
        let range = (low..high).log_scale();
        range.with_key_points(ticks([low, high]))
    };
    let area = SVGBackend::with_string(svg, (720, 460)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .margin(12)
        .margin_right(40)
        .x_label_area_size(46)
        .y_label_area_size(70)
        .build_cartesian_2d(axis(across), axis(up))?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(AXIS)
        .label_style(TEXT)
        .axis_desc_style(("sans-serif", 17))
        .x_desc("particles")
        .y_desc("ms a frame")
        .x_label_formatter(&|count| grouped(count.round() as u64))
        .y_label_formatter(&|ms| three_digits(*ms))
        .draw()?;
    for (index, (name, points)) in curves.into_iter().enumerate() {
        let colour = CURVE_COLOURS[index % CURVE_COLOURS.len()];
        chart
            .draw_series(LineSeries::new(points.clone(), colour.stroke_width(2)))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(2)));
        let dots = points.into_iter();
        chart.draw_series(dots.map(|at| Circle::new(at, 4, colour.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .label_font(TEXT)
        .border_style(AXIS)
        .background_style(WHITE)
        .draw()?;
    drop(chart);
    area.present()
}

fn curves(rows: &[ScalingRow]) -> Vec<Curve> {
    let ours = rows.iter().map(|row| (row, row.total.median_ms));
    let ours = ours.map(|(row, ms)| (row.fluid_particles as f64, ms));
    let mut curves = vec![("Vitriol".to_owned(), ours.collect())];
    // Each row has the same peers in the same order.
    for (index, peer) in rows.iter().flat_map(|row| row.peers.iter().enumerate()) {
        if curves.len() == index + 1 {
            let of = rows.iter().filter_map(|row| {
                let ms = row.peers.get(index)?.total.median_ms;
                Some((row.fluid_particles as f64, ms))
            });
            curves.push((peer.name.clone(), of.collect()));
        }
    }
    curves
}
