//! A code for one browser, and the address that has it, for people and as a QR code.

use qrcode::render::unicode::Dense1x2;
use qrcode::{Color, EcLevel, QrCode};

/// A one-time code for a browser, with the address that has it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Invitation {
    /// The page's address with the code behind `#`, which browsers send nowhere.
    pub address: String,
    /// The code, to be typed.
    pub code: String,
}

impl Invitation {
    fn coded(&self) -> Option<QrCode> {
        QrCode::with_error_correction_level(&self.address, EcLevel::M).ok()
    }

    /// The address as a QR code for a terminal that writes light on dark, as most do: its blocks are the code's light modules, so that the
    /// code is dark on light, as all readers expect. Empty for an address that is too long.
    pub fn qr(&self) -> String {
        let coded = self.coded().map(|code| {
            let mut renderer = code.render::<Dense1x2>();
            renderer
                .dark_color(Dense1x2::Light)
                .light_color(Dense1x2::Dark)
                .build()
        });
        coded.unwrap_or_default()
    }

    /// The address as a QR code for a page: rows of `#` for dark and blanks for light, without the light margin.
    pub(crate) fn rows(&self) -> Vec<String> {
        let Some(code) = self.coded() else {
            return Vec::new();
        };
        let mark = |colour: &Color| if *colour == Color::Dark { '#' } else { ' ' };
        let colours = code.to_colors();
        let rows = colours.chunks(code.width());
        rows.map(|row| row.iter().map(mark).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ISO/IEC 18004, 6.3.3.1: seen from any side.
    const FINDER: [&str; 7] = [
        "#######", "#     #", "# ### #", "# ### #", "# ### #", "#     #", "#######",
    ];

    #[test]
    fn page_and_terminal_show_the_same_code() {
        let invitation = Invitation {
            address: "https://192.0.2.1:8443/#AAAAA-AAAAA".to_owned(),
            code: "AAAAA-AAAAA".to_owned(),
        };
        let rows = invitation.rows();
        let size = rows.len();
        for (y, finder) in FINDER.iter().enumerate() {
            assert_eq!(&rows[y][..7], *finder, "above, left");
            assert_eq!(&rows[y][size - 7..], *finder, "above, right");
            assert_eq!(&rows[size - 7 + y][..7], *finder, "below, left");
        }
        // Two rows a line, and a margin of four (9.1).
        let shown = invitation.qr();
        let lines: Vec<Vec<char>> = shown.lines().map(|line| line.chars().collect()).collect();
        let is_light = |x: usize, y: usize| match lines[y / 2][x] {
            '█' => true,
            '▀' => y.is_multiple_of(2),
            '▄' => !y.is_multiple_of(2),
            _ => false,
        };
        for y in 0..size + 8 {
            for x in 0..size + 8 {
                let row = y.checked_sub(4).and_then(|y| rows.get(y));
                let mark = row.and_then(|row| row.chars().nth(x.checked_sub(4)?));
                assert_eq!(is_light(x, y), mark != Some('#'), "{x}, {y}");
            }
        }
    }
}
