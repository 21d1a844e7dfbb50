//! What is printed on glass: numbers at graduation marks, "mL" and "°C", and a label's formula. Letters are five by seven points, between which they are
//! interpolated, so that their edges are round and as soft as a pixel.

/// Points of a letter, across and down, and from one letter to the next.
const LETTER: vec2<f32> = vec2<f32>(5.0, 7.0);
const LETTER_STEP = 6.0;
/// Codes, as `render/src/print.rs` has them: digits are 0 to 9, and the same as indices under the line from `LOWERED` on.
const LETTER_M = 10u;
const LETTER_L = 11u;
const LETTER_SPACE = 16u;
const LETTER_DEGREE = 17u;
const LETTER_C = 18u;
const LOWERED = 32u;
/// How much smaller an index is, and by how many points its top is lower.
const INDEX_SIZE = 0.7;
const INDEX_DROP = 3.4;

/// Each letter's rows, five bits each with the leftmost highest: the upper four rows, the topmost lowest, and then the lower three.
const LETTERS = array<vec2<u32>, 19>(
    vec2<u32>(0x8C62Eu, 0x3A31u), // 0
    vec2<u32>(0x21184u, 0x3884u), // 1
    vec2<u32>(0x3062Eu, 0x7E08u), // 2
    vec2<u32>(0x7043Eu, 0x3A21u), // 3
    vec2<u32>(0x928C2u, 0x085Fu), // 4
    vec2<u32>(0x0FA1Fu, 0x3A21u), // 5
    vec2<u32>(0xF4106u, 0x3A31u), // 6
    vec2<u32>(0x2083Fu, 0x2108u), // 7
    vec2<u32>(0x7462Eu, 0x3A31u), // 8
    vec2<u32>(0x7C62Eu, 0x3041u), // 9
    vec2<u32>(0xAE800u, 0x56B5u), // m
    vec2<u32>(0x84210u, 0x7E10u), // L
    vec2<u32>(0xFC631u, 0x4631u), // H
    vec2<u32>(0x7420Fu, 0x7821u), // S
    vec2<u32>(0x8C62Eu, 0x3A31u), // O
    vec2<u32>(0x20B38u, 0x0E68u), // %
    vec2<u32>(0u, 0u),
    vec2<u32>(0x64A4Cu, 0u), // °
    vec2<u32>(0x8422Eu, 0x3A30u), // C
);

/// A letter's rows. Drivers unroll the loop, so that each index is a constant: a software driver copies an array that is indexed otherwise, for every pixel.
fn letter_of(code: u32) -> vec2<u32> {
    var rows = vec2<u32>(0u);
    for (var n = 0u; n <= LETTER_C; n++) { rows = select(rows, LETTERS[n], n == code); }
    return rows;
}

/// A point of a letter, 0 or 1.
fn letter_point(letter: vec2<u32>, x: i32, y: i32) -> f32 {
    let within = x >= 0 && x < 5 && y >= 0 && y < 7;
    let word = select(letter.x, letter.y, y > 3);
    let bit = 5u * u32(select(y, y - 4, y > 3)) + u32(4 - x);
    return select(0.0, f32((word >> (bit & 31u)) & 1u), within);
}

/// How much of a pixel is a letter's ink, `at` points from its upper left corner; a pixel is as wide as `pixel` points.
fn letter_ink(code: u32, at: vec2<f32>, pixel: f32) -> f32 {
    let lowered = code >= LOWERED;
    let place = select(at, (at - vec2<f32>(0.0, INDEX_DROP)) / INDEX_SIZE, lowered);
    if (any(place < vec2<f32>(-1.0)) || any(place > LETTER + 1.0)) { return 0.0; }
    let letter = letter_of(code & 31u);
    let corner = floor(place - 0.5);
    let share = place - 0.5 - corner;
    let x = i32(corner.x);
    let y = i32(corner.y);
    let above = mix(letter_point(letter, x, y), letter_point(letter, x + 1, y), share.x);
    let below = mix(letter_point(letter, x, y + 1), letter_point(letter, x + 1, y + 1), share.x);
    // Where letters are large, their edge is where half of it is; where they are small, all of the slope.
    return saturate((mix(above, below, share.y) - 0.45) / clamp(pixel, 0.25, 1.0) + 0.5);
}

/// Digits of a number of four at most.
fn digits_of(number: u32) -> u32 {
    return 1u + select(0u, 1u, number > 9u) + select(0u, 1u, number > 99u) + select(0u, 1u, number > 999u);
}

/// A letter of a line: its code, and how far a place is from its upper left corner, points.
struct LineLetter {
    code: u32,
    at: vec2<f32>,
}

/// A place beside all letters.
const NO_LETTER = LineLetter(LETTER_SPACE, vec2<f32>(-9.0));

/// The letter of a number of four digits at most, and of " mL" after it if `unit`; `at` points from the upper left corner.
fn number_letter(number: u32, unit: bool, at: vec2<f32>) -> LineLetter {
    if (at.x < -1.0 || at.y < -1.0 || at.y > LETTER.y + 1.0) { return NO_LETTER; }
    let place = u32(max(at.x, 0.0) / LETTER_STEP);
    let count = digits_of(number);
    let after = max(count, place + 1u) - place - 1u;
    let ten = select(1u, 10u, (after & 1u) != 0u) * select(1u, 100u, (after & 2u) != 0u);
    var code = (number / ten) % 10u;
    if (place >= count) {
        let beyond = place - count;
        code = LETTER_SPACE;
        if (unit && beyond == 1u) { code = LETTER_M; }
        if (unit && beyond == 2u) { code = LETTER_L; }
    }
    return LineLetter(code, at - vec2<f32>(LETTER_STEP * f32(place), 0.0));
}

/// The same number's ink.
fn number_ink(number: u32, unit: bool, at: vec2<f32>, pixel: f32) -> f32 {
    let letter = number_letter(number, unit, at);
    return letter_ink(letter.code, letter.at, pixel);
}

/// The letter of a line of eight letters at most: codes of six bits, four a number, the first lowest.
fn line_letter(codes: vec2<f32>, at: vec2<f32>) -> LineLetter {
    if (at.x < -1.0 || at.y < -1.0 || at.x > 8.0 * LETTER_STEP) { return NO_LETTER; }
    let place = u32(max(at.x, 0.0) / LETTER_STEP);
    let word = u32(select(codes.x, codes.y, place > 3u));
    let code = (word >> (6u * (place & 3u))) & 63u;
    return LineLetter(code, at - vec2<f32>(LETTER_STEP * f32(place), 0.0));
}
