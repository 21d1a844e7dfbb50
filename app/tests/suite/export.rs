//! What `vitriol export` writes, and what it refuses.

mod formats;
mod refused;
mod runs;
mod times;

use serde_json::Value;

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}
