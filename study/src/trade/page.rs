//! `trade.html`: each error over a frame's time, with the front.

use maud::{Markup, PreEscaped, html};
use vitriol_run::page::page as whole_page;
use vitriol_run::units::{grouped, percent, three_digits};

use super::boil::{Quartiles, Seeds};
use super::plot::{self, Dot};
use super::report::{Errors, Point, Trade};
use super::setting::Knob;

/// The page; every string in it is escaped.
pub fn page(trade: &Trade) -> String {
    let body = html! {
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
    };
    whole_page("Speed for accuracy", OWN, &body)
}

/// Colours of a plot that the pages' own style sheet does not replace.
const OWN: &str = r##"
.canvas svg [fill="#0072B2"] { fill: var(--c0); }
.canvas svg [fill="#1D2326"] { fill: var(--ink); }
.wide { overflow-x: auto; } .wide table { font-size: 14px; } .wide td, .wide th { padding-right: 14px; white-space: nowrap; }
"##;

fn scatter(trade: &Trade, name: &str, error: fn(&Errors) -> f64) -> Markup {
    let dots = trade.points.iter().map(|point| Dot {
        cost: point.cost(),
        error: error(&point.errors),
        title: describe(point),
        preset: (point.knob == Knob::Preset).then_some(point.preset.as_ref()),
    });
    let Some(svg) = plot::scatter(&dots.collect::<Vec<_>>()) else {
        return html! {};
    };
    html! {
        figure.plot {
            figcaption { strong { (name) } " " span.unit { "over the time of 1/90 s, 99th percentile" } }
            div.canvas role="img" aria-label=(name) { (PreEscaped(svg)) }
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

/// A point's errors: the six columns that both tables have.
fn errors(point: &Point) -> Markup {
    html! {
        td { (percent(point.errors.rest_p99)) }
        td { (percent(point.rest.density_signed)) }
        td { (point.rest.pressure.map_or("not carried".into(), percent)) }
        td { (percent(point.errors.pour_p99)) }
        td { (percent(point.errors.poured)) }
        td { (percent(point.errors.lost_volume)) }
    }
}

fn presets(trade: &Trade) -> Markup {
    let rows = trade
        .points
        .iter()
        .filter(|point| point.knob == Knob::Preset);
    html! { div.wide { table {
        (head(&["Preset", "Setting", "Frame's median; 1/90 s, 99th percentile", "At rest", "Signed, below the surface",
            "Pressure off ρgy", "Pouring",
            "Poured volume", "Lost volume", "Calorimeter, worst"]))
        tbody { @for point in rows {
            tr {
                th scope="row" { (point.preset) }
                td { (point.setting.label()) }
                td { (three_digits(point.rest.cost.median_ms)) " and " (three_digits(point.cost())) " ms" }
                (errors(point))
                td { (worst_heat(trade, &point.preset)) }
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
        (head(&["From", "Knob", "Setting", "Particles", "1/90 s, ms", "At rest", "Signed, below the surface",
            "Pressure off ρgy", "Pouring",
            "Poured volume", "Lost volume", "Δt over its limit"]))
        tbody { @for point in &trade.points {
            tr {
                th scope="row" { (point.preset) }
                td { (point.knob.name()) }
                td { (point.setting.label()) }
                td { (grouped(point.rest.particles.into())) }
                td { (three_digits(point.cost())) }
                (errors(point))
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
