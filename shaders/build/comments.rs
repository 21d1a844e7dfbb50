//! The `///` comments of a WGSL struct and its fields.
//!
//! naga can keep them, but naga 30.0.1 counts only the fields that have a comment, and so gives
//! one field's comment to another wherever a field before it has none.

use std::collections::BTreeMap;

/// Lines without their marks.
#[derive(Default)]
pub struct Comments {
    /// Lines above the struct.
    pub own: Vec<String>,
    /// Lines above each field that has a comment.
    pub fields: BTreeMap<String, Vec<String>>,
}

/// Finds the comments of the struct `name`, its fields one a line.
pub fn comments(text: &str, name: &str) -> Comments {
    let mut found = Comments::default();
    let mut pending = Vec::new();
    let mut inside = false;
    for line in text.lines().map(str::trim) {
        if let Some(comment) = line.strip_prefix("///") {
            pending.push(comment.to_owned());
            continue;
        }
        let above = std::mem::take(&mut pending);
        if !inside {
            let rest = line.strip_prefix("struct ").unwrap_or_default();
            if rest.split([' ', '{']).find(|word| !word.is_empty()) == Some(name) {
                inside = true;
                found.own = above;
            }
        } else if line.starts_with('}') {
            break;
        } else if let Some((head, _)) = line.split_once(':')
            && let Some(field) = head.split_whitespace().last()
            && !above.is_empty()
        {
            found.fields.insert(field.to_owned(), above);
        }
    }
    found
}
