//! `trade.html`: each error over a frame's time, with the front.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::boil::{Quartiles, Seeds};
use super::front::front;
use super::report::{Errors, Point, Trade};
use super::setting::Knob;
use crate::report::STYLE;
use crate::report::units::{grouped, percent, three_digits};

/// Size of a plot and room for its axes, pixels.
const SIZE: [f64; 2] = [640.0, 400.0];
const ROOM: [f64; 4] = [84.0, 14.0, 16.0, 44.0];

/// The page; every string in it is escaped.
pub fn page(trade: &Trade) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "Speed for accuracy · Vitriol" }
                style { (PreEscaped(STYLE)) (PreEscaped(OWN)) }
            }
            body {
                main {
                    header {
                        p.kicker { "Vitriol · speed for accuracy" }
                        h1 { "What a frame costs, and what it is off by" }
                        p.lead {
                            (trade.points.len()) " settings on " (trade.device.name)
                            ". Filled: on the front, where nothing is both cheaper and better. \
                             Ringed: the presets."
                        }
                    }
                    section.plots {
                        @for (name, error) in Errors::ALL { (scatter(trade, name, error)) }
                    }
                    section { h2 { "Presets" } (presets(trade)) }
                    @if !trade.boiling.is_empty() {
                        section { h2 { "Water poured into acid" } (boiling(trade)) }
                    }
                    section { h2 { "Settings" } (settings(trade)) }
                    section { h2 { "Convergence" } (orders(trade)) }
                }
            }
        }
    }
    .into_string()
}

const OWN: &str = "
.canvas svg .dot { fill: none; stroke: var(--soft); stroke-width: 1.2; }
.canvas svg .on { fill: var(--c0); stroke: var(--c0); }
.canvas svg .preset { fill: none; stroke: var(--c1); stroke-width: 2; }
.canvas svg .grid { stroke: var(--line); }
.canvas svg .line { fill: none; stroke: var(--c0); stroke-width: 1.5; }
.canvas svg .label { fill: var(--ink); font-size: 13px; }
.canvas svg text { font-size: 13px; }
.wide { overflow-x: auto; } .wide table { font-size: 14px; } .wide td, .wide th { padding-right: 14px; white-space: nowrap; }
";

/// A logarithmic axis.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Whole decades' tenths around the values; `from` and `to` in pixels.
    fn around(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Option<Self> {
        let (low, high) = values
            .filter(|value| value.is_finite() && *value > 0.0)
            .fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
        (high > 0.0).then(|| Self {
            low: (0.8 * low).ln(),
            high: (1.25 * high).ln(),
            from,
            to,
        })
    }

    fn at(&self, value: f64) -> f64 {
        let share = (value.ln() - self.low) / (self.high - self.low);
        self.from + share.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// 1, 2 and 5 of each decade; decades alone where there are many.
    fn ticks(&self) -> Vec<f64> {
        let decades = (self.high - self.low) / 10f64.ln();
        let steps: &[f64] = if decades > 3.0 {
            &[1.0]
        } else {
            &[1.0, 2.0, 5.0]
        };
        (-9..6)
            .flat_map(|power| steps.iter().map(move |step| step * 10f64.powi(power)))
            .filter(|tick| (self.low..=self.high).contains(&tick.ln()))
            .collect()
    }
}

fn scatter(trade: &Trade, name: &str, error: fn(&Errors) -> f64) -> Markup {
    // What has no error that can be told is at the bottom.
    let least = 1e-6;
    let values: Vec<(f64, f64)> = trade
        .points
        .iter()
        .map(|point| (point.cost(), error(&point.errors).max(least)))
        .collect();
    let [left, right, top, bottom] = ROOM;
    let across = Axis::around(values.iter().map(|v| v.0), left, SIZE[0] - right);
    let up = Axis::around(values.iter().map(|v| v.1), SIZE[1] - bottom, top);
    let (Some(across), Some(up)) = (across, up) else {
        return html! {};
    };
    let best = front(&values);
    let line: Vec<String> = best
        .iter()
        .map(|&i| format!("{:.1},{:.1}", across.at(values[i].0), up.at(values[i].1)))
        .collect();
    html! {
        figure.plot {
            figcaption { strong { (name) } " " span.unit { "over the time of 1/90 s, 99th percentile" } }
            div.canvas {
                svg viewBox={ "0 0 " (SIZE[0]) " " (SIZE[1]) } role="img" aria-label=(name) {
                    @for tick in up.ticks() {
                        line.grid x1=(left) x2=(SIZE[0] - right) y1=(up.at(tick)) y2=(up.at(tick)) {}
                        text x=(left - 8.0) y=(up.at(tick) + 4.0) text-anchor="end" { (percent(tick)) }
                    }
                    @for tick in across.ticks() {
                        line.grid x1=(across.at(tick)) x2=(across.at(tick)) y1=(top) y2=(SIZE[1] - bottom) {}
                        text x=(across.at(tick)) y=(SIZE[1] - bottom + 18.0) text-anchor="middle" {
                            (three_digits(tick))
                        }
                    }
                    text x=(SIZE[0] - right) y=(SIZE[1] - 6.0) text-anchor="end" { "ms for 1/90 s" }
                    polyline.line points=(line.join(" ")) {}
                    @for (i, value) in values.iter().enumerate() {
                        circle.dot.on[best.contains(&i)] cx=(across.at(value.0)) cy=(up.at(value.1)) r="4" {
                            title { (describe(&trade.points[i])) }
                        }
                    }
                    @for (point, value) in trade.points.iter().zip(&values) {
                        @if point.knob == Knob::Preset {
                            circle.preset cx=(across.at(value.0)) cy=(up.at(value.1)) r="8" {}
                            text.label x=(across.at(value.0) + 11.0) y=(up.at(value.1) - 7.0) { (point.preset) }
                        }
                    }
                }
            }
        }
    }
}

fn describe(point: &Point) -> String {
    format!(
        "{} particles, {}; {} turned from {}",
        grouped(point.rest.particles.into()),
        point.setting.label(),
        point.knob.name(),
        point.preset
    )
}

fn head(names: &[&str]) -> Markup {
    html! { thead { tr { @for name in names { th scope="col" { (name) } } } } }
}

fn presets(trade: &Trade) -> Markup {
    let rows = trade
        .points
        .iter()
        .filter(|point| point.knob == Knob::Preset);
    html! { div.wide { table {
        (head(&["Preset", "Setting", "Frame's median; 1/90 s, 99th percentile", "At rest", "Pouring",
            "Poured volume", "Lost volume", "Calorimeter, worst"]))
        tbody { @for point in rows {
            tr {
                th scope="row" { (point.preset) }
                td { (point.setting.label()) }
                td { (three_digits(point.rest.cost.median_ms)) " and " (three_digits(point.cost())) " ms" }
                td { (percent(point.errors.rest_p99)) }
                td { (percent(point.errors.pour_p99)) }
                td { (percent(point.errors.poured)) }
                td { (percent(point.errors.lost_volume)) }
                td { (worst_heat(trade, point.preset)) }
            }
        } }
    } } }
}

fn worst_heat(trade: &Trade, preset: &str) -> String {
    let rows = trade.calorimetry.iter().filter(|row| row.preset == preset);
    let worst = rows.map(|row| (row.temperature[0] - row.temperature[1]).abs());
    worst
        .reduce(f64::max)
        .map_or("not tried".into(), |worst| format!("{worst:.2} K"))
}

fn boiling(trade: &Trade) -> Markup {
    let show =
        |Quartiles([low, middle, high]): &Quartiles| format!("{middle:.2} ({low:.2} to {high:.2})");
    let row = |seeds: &Seeds| {
        html! { tr {
            th scope="row" { (seeds.name) }
            td { (seeds.seeds.len()) }
            td { (show(&seeds.superheat)) }
            td { (show(&seeds.onset)) }
            td { (show(&seeds.thrown)) }
            td { (show(&seeds.steam)) }
            td { (show(&seeds.temperature)) }
        } }
    };
    html! {
        div.wide { table {
            (head(&["Run", "Seeds", "Peak superheat, K", "Onset, s", "Thrown, g", "Steam, g",
                "Mean at the end, °C"]))
            tbody { @for seeds in &trade.boiling { (row(seeds)) } }
        } }
        p.note { "Medians, quartiles in parentheses." }
    }
}

fn settings(trade: &Trade) -> Markup {
    html! { div.wide { table {
        (head(&["From", "Knob", "Setting", "Particles", "1/90 s, ms", "At rest", "Pouring",
            "Poured volume", "Lost volume", "Δt over its limit"]))
        tbody { @for point in &trade.points {
            tr {
                th scope="row" { (point.preset) }
                td { (point.knob.name()) }
                td { (point.setting.label()) }
                td { (grouped(point.rest.particles.into())) }
                td { (three_digits(point.cost())) }
                td { (percent(point.errors.rest_p99)) }
                td { (percent(point.errors.pour_p99)) }
                td { (percent(point.errors.poured)) }
                td { (percent(point.errors.lost_volume)) }
                td { (three_digits(point.stiffness)) }
            }
        } }
    } } }
}

fn orders(trade: &Trade) -> Markup {
    html! { div.wide { table {
        (head(&["Error", "Over", "Errors", "Order"]))
        tbody { @for order in &trade.orders {
            tr {
                th scope="row" { (order.name) }
                td { (order.by) }
                td { @for [step, error] in &order.errors {
                    (three_digits(*step)) ": " (format!("{error:.2e}")) "  "
                } }
                td { (format!("{:.2}", order.order)) }
            }
        } }
    } } }
}
