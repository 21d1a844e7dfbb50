//! Two experiments in one picture: side by side, with captions.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster_width};

use crate::canvas::{Canvas, MARGIN, PADDING};

/// Still read where the picture is shown at half its size, as a page does.
const SIZE: RasterHeight = RasterHeight::Size20;
/// Distance from line to line beside the text's height, pixels.
const LEADING: usize = 3;
/// Least letters of a line: room for four digits, so that no panel grows while numbers do.
const LETTERS: usize = 15;
/// Likewise of the time.
const LETTERS_OF_TIME: usize = 6;

/// What is said of one of two experiments.
#[derive(Clone, Debug, PartialEq)]
pub struct Caption {
    /// Which it is.
    pub title: String,
    /// Highest temperature now, °C, where heat is modelled.
    pub hottest_c: Option<f64>,
    /// Water that left as steam so far, kg, where that is modelled.
    pub steam_kg: Option<f64>,
    /// What was thrown out so far, kg.
    pub thrown_kg: f64,
}

impl Caption {
    /// Its lines.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![self.title.clone()];
        lines.extend(self.hottest_c.map(|it| format!("hottest {it:.0} °C")));
        let steam = self.steam_kg.map(weight);
        lines.extend(steam.map(|it| format!("steam {it}")));
        lines.push(format!("thrown {}", weight(self.thrown_kg)));
        lines
    }
}

/// Cold acid makes and throws milligrams, hot acid grams.
fn weight(kg: f64) -> String {
    match 1e6 * kg {
        mg if mg < 999.5 => format!("{mg:.0} mg"),
        mg => format!("{:.1} g", 1e-3 * mg),
    }
}

/// A scene's title up to its first comma, since captions are narrow; of one without a title, its name as one: `my-scene` is `My scene`.
pub fn title(title: &str) -> String {
    let shown = title.split(", ").next().unwrap_or(title);
    let words = shown.replace('-', " ");
    let mut letters = words.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => words,
    }
}

/// Two pictures with rows of `width` pixels, of the same size, left and right in one.
pub fn side_by_side([left, right]: [&[u8]; 2], width: usize) -> Vec<u8> {
    let row = 4 * width.max(1);
    let mut both = Vec::with_capacity(left.len() + right.len());
    for (left, right) in left.chunks_exact(row).zip(right.chunks_exact(row)) {
        both.extend_from_slice(left);
        both.extend_from_slice(right);
    }
    both
}

/// Draws the captions of the left and the right half into a picture with rows of `width` pixels, and below them the time, s.
pub fn draw(picture: &mut [u8], width: usize, captions: &[Caption; 2], seconds: f64) {
    let height = picture.len() / 4 / width.max(1);
    let mut canvas = Canvas::new(picture, width);
    let both = captions.each_ref().map(Caption::lines);
    let longest = both.iter().flatten().map(|line| line.chars().count()).max();
    let letters = longest.unwrap_or(0).max(LETTERS);
    for (half, lines) in both.iter().enumerate() {
        let size = panel(letters, lines.len());
        // To the right, since the legend of the tints is to the left.
        let right = (half + 1) * width / 2;
        let Some(left) = right.checked_sub(MARGIN + size[0]) else {
            continue;
        };
        write(&mut canvas, [left, MARGIN], size, lines);
    }
    let size = panel(LETTERS_OF_TIME, 1);
    let left = width.checked_sub(size[0]).map(|room| room / 2);
    let top = height.checked_sub(size[1] + MARGIN);
    if let (Some(left), Some(top)) = (left, top) {
        write(&mut canvas, [left, top], size, &[format!("{seconds:.1} s")]);
    }
}

/// Width and height of a panel with so many letters in each of so many lines, pixels.
fn panel(letters: usize, lines: usize) -> [usize; 2] {
    let wide = letters * get_raster_width(FontWeight::Regular, SIZE);
    let high = lines * (SIZE.val() + LEADING) - LEADING;
    [wide + 2 * PADDING, high + 2 * PADDING]
}

/// Writes lines on a panel, where it has room.
fn write(canvas: &mut Canvas<'_>, at: [usize; 2], size: [usize; 2], lines: &[String]) {
    if !canvas.panel(at, size) {
        return;
    }
    for (index, line) in lines.iter().enumerate() {
        let top = at[1] + PADDING + index * (SIZE.val() + LEADING);
        canvas.write(SIZE, [at[0] + PADDING, top], line);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn caption(hottest_c: Option<f64>, thrown_kg: f64) -> Caption {
        Caption {
            title: title("water-into-acid"),
            hottest_c,
            steam_kg: hottest_c.map(|_| 168e-6),
            thrown_kg,
        }
    }

    #[test]
    fn captions_say_what_was_measured() {
        let hot = caption(Some(103.4), 1.26e-3);
        assert_eq!(
            hot.lines(),
            [
                "Water into acid",
                "hottest 103 °C",
                "steam 168 mg",
                "thrown 1.3 g"
            ]
        );
        let spits = caption(Some(95.0), 68.7e-6);
        assert_eq!(spits.lines()[3], "thrown 69 mg");
        let cold = caption(None, 0.0);
        assert_eq!(cold.lines(), ["Water into acid", "thrown 0 mg"]);
        assert_eq!(title(""), "");
        assert_eq!(title("Water on acid, swirled"), "Water on acid");
    }

    #[test]
    fn the_first_is_to_the_left() {
        let (left, right) = (vec![1_u8; 4 * 3 * 2], vec![2_u8; 4 * 3 * 2]);
        let both = side_by_side([&left, &right], 3);
        assert_eq!(both.len(), 4 * 6 * 2);
        for row in both.chunks_exact(4 * 6) {
            assert!(row[..12].iter().all(|&byte| byte == 1), "{row:?}");
            assert!(row[12..].iter().all(|&byte| byte == 2), "{row:?}");
        }
    }

    /// Each caption is in its own half, of which it leaves the left to the tints' legend; the time is below.
    #[test]
    fn captions_are_where_nothing_else_is() {
        let mut picture = vec![128_u8; 4 * 960 * 540];
        let captions = [caption(Some(20.0), 0.0), caption(Some(1234.0), 0.123)];
        draw(&mut picture, 960, &captions, 12.3);
        let changed = |columns: std::ops::Range<usize>, rows: std::ops::Range<usize>| {
            let mut pixels = rows.flat_map(|y| columns.clone().map(move |x| 4 * (y * 960 + x)));
            pixels.any(|first| picture[first] != 128)
        };
        assert!(changed(240..464, 16..130) && changed(720..944, 16..130));
        assert!(!changed(0..200, 0..540) && !changed(464..680, 0..400));
        assert!(changed(420..540, 480..524) && !changed(0..960, 130..470));

        // None has room there.
        let mut small = vec![128_u8; 4 * 100 * 50];
        draw(&mut small, 100, &captions, 12.3);
        assert!(small.iter().all(|&byte| byte == 128));
    }
}
