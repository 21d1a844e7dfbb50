//! The cap of a score, in a line.

use vitriol_lesson::{Cap, Evidence};
use vitriol_run::in_a_line;

/// The cap, and the first evidence for it with its moment in the film.
pub fn said(cap: &Cap) -> String {
    let text = match cap.evidence.first() {
        Some(Evidence {
            t_s: Some(t_s),
            text,
        }) => format!("{} At {t_s:.1} s: {text}", cap.text),
        _ => cap.text.clone(),
    };
    in_a_line(&text)
}
