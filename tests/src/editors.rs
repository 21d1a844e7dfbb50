//! Texts as editors write them.

/// `text` in UTF-8, first without and then with a byte order mark as Windows' editors write it, and in UTF-16 with one, in both orders of
/// bytes, of which PowerShell writes the first (The Unicode Standard, 23.8).
#[must_use]
pub fn encodings(text: &str) -> [Vec<u8>; 4] {
    let marked = format!("\u{feff}{text}");
    let units: Vec<u16> = marked.encode_utf16().collect();
    [
        text.as_bytes().to_vec(),
        marked.into_bytes(),
        units.iter().flat_map(|unit| unit.to_le_bytes()).collect(),
        units.iter().flat_map(|unit| unit.to_be_bytes()).collect(),
    ]
}
