//! The look of pages and of the plots in them.
//!
//! A plot carries plain colours, which the page's style sheet exchanges by
//! attribute selector, so that one picture serves light and dark.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use plotters::style::RGBColor;

const STYLE: &str = include_str!("page.css");

/// Colours of the curves as they stand in the SVG (Okabe and Ito's set, which
/// colour-blind readers tell apart). The style sheet maps each to a variable.
pub const CURVE_COLOURS: [RGBColor; 6] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x56, 0xb4, 0xe9),
];

/// Lines across a plot.
pub const GRID: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
/// A plot's axes.
pub const AXIS: RGBColor = RGBColor(0x99, 0x99, 0x99);

/// A page in English that needs no other file: `own` is what it adds to the style sheet.
/// Every string in it is escaped.
pub fn page(title: &str, own: &str, body: &Markup) -> String {
    page_in("en", title, own, body)
}

/// Likewise in the language of that code (ISO 639-1).
pub fn page_in(language: &str, title: &str, own: &str, body: &Markup) -> String {
    html! {
        (DOCTYPE)
        html lang=(language) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (title) " · Vitriol" }
                style { (PreEscaped(STYLE)) (PreEscaped(own)) }
            }
            body { (body) }
        }
    }
    .into_string()
}
