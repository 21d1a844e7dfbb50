//! Prints on vessels, as the shaders read them: `common/picture/printed.wgsl`.

/// Letters that can be printed, in the shaders' order; each digit also as an index under the line.
const LETTERS: &str = "0123456789mLHSO% ";

/// Indices under the line.
const INDICES: &str = "₀₁₂₃₄₅₆₇₈₉";

/// Offset of an index's code from its digit's code.
const LOWERED: u32 = 32;

/// Most letters of a line.
const MOST: usize = 8;

/// A paper label on a vessel's side, to the left of its marks.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// One or two lines, one over the other, of up to eight letters each: digits, indices under the line, `m`, `L`, `H`, `S`, `O`, `%` and
    /// spaces. Other letters are left blank.
    pub lines: Vec<String>,
    /// Height of its lower edge, in the scene's unit.
    pub bottom: f64,
    /// Height of its letters, likewise.
    pub letters: f64,
    /// The angle of its middle from +Z towards +X, and half of the angle that it covers, rad.
    pub angles: [f64; 2],
}

/// A letter's code.
fn code(letter: char) -> u32 {
    let place = |all: &str| all.chars().position(|it| it == letter).map(|at| at as u32);
    let blank = LETTERS.len() as u32 - 1;
    (place(LETTERS))
        .or_else(|| place(INDICES).map(|digit| digit + LOWERED))
        .unwrap_or(blank)
}

/// A line as two numbers, six bits a letter: below 2²⁴ they are exact in f32.
fn packed(line: &str) -> [f32; 2] {
    let codes = line.chars().chain(std::iter::repeat(' ')).take(MOST);
    let codes: Vec<u32> = codes.map(code).collect();
    let word = |codes: &[u32]| codes.iter().rev().fold(0, |word, code| word << 6 | code) as f32;
    let (first, last) = codes.split_at(MOST / 2);
    [word(first), word(last)]
}

impl Label {
    /// The label's two rows for the shader: its place, then its lines.
    pub(crate) fn rows(&self) -> Vec<[f32; 4]> {
        let line = |index: usize| self.lines.get(index).map_or([0.0; 2], |line| packed(line));
        let [[a, b], [c, d]] = [line(0), line(1)];
        let [middle, half] = self.angles.map(|angle| angle as f32);
        let shape = [self.bottom as f32, self.letters as f32, middle, half];
        vec![shape, [a, b, c, d]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_six_bits_a_letter() {
        // H, ₂, S, O; then ₄ and blanks.
        let [first, last] = packed("H₂SO₄");
        assert_eq!(first as u32, 12 | 34 << 6 | 13 << 12 | 14 << 18);
        assert_eq!(last as u32, 36 | 16 << 6 | 16 << 12 | 16 << 18);
        // A line that is too long is cut, and unknown letters are left blank.
        assert_eq!(packed("H₂SO₄ 98 %"), packed("H₂SO₄ 98"));
        assert_eq!(packed("x"), packed(""));
    }
}
