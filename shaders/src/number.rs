//! The constants of a file that are plain numbers: lines `const NAME: f32 = NUMBER;`.

use std::ops::Range;

use crate::error::ShaderError;

/// Where in the text of the file at `path` the number of the constant `name` is, and its value.
///
/// # Errors
/// [`ShaderError::UnknownShader`] without a text; [`ShaderError::NoNumber`] unless exactly one line has that form and name.
pub fn number_in(
    path: &str,
    text: Option<&str>,
    name: &str,
) -> Result<(Range<usize>, f64), ShaderError> {
    let Some(text) = text else {
        return Err(ShaderError::UnknownShader {
            path: path.to_owned(),
        });
    };
    find(text, name).ok_or_else(|| ShaderError::NoNumber {
        file: path.to_owned(),
        name: name.to_owned(),
    })
}

fn find(text: &str, name: &str) -> Option<(Range<usize>, f64)> {
    let head = format!("const {name}: f32 = ");
    let starts_line = |at: &usize| *at == 0 || text[..*at].ends_with('\n');
    let mut places = text.match_indices(&head).map(|found| found.0);
    let first = places.find(starts_line)? + head.len();
    if places.any(|at| starts_line(&at)) {
        return None;
    }
    let place = first..first + text[first..].find(';')?;
    let value = text[place.clone()].parse().ok()?;
    Some((place, value))
}

#[cfg(test)]
mod tests {
    use super::find;

    #[test]
    fn one_line_with_a_plain_number_is_found() {
        let text = "// const A: f32 = 9.0;\nconst A: f32 = 3.5e-3; // m\nconst B: f32 = 2.0 * A;\n";
        let found = find(text, "A").map(|(place, value)| (&text[place], value));
        assert_eq!(found, Some(("3.5e-3", 3.5e-3)));
        // No number, no such name, and twice.
        assert_eq!(find(text, "B"), None);
        assert_eq!(find(text, "C"), None);
        assert_eq!(find(&text.repeat(2), "A"), None);
    }
}
