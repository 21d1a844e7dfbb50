//! The colours that stand for a particle's attribute.

/// Entries of a colour map; the shader interpolates linearly between them.
pub const ENTRIES: usize = 17;

/// Three quarters of "lapaz": blue over slate to a pale cream, perceptually
/// even, its lightness rising throughout, readable with any common colour
/// blindness and in grey. Still liquid is blue and fast liquid nearly white, as
/// foam would be.
///
/// Source: F. Crameri, Scientific colour maps 8.0 (doi:10.5281/zenodo.1243862,
/// MIT licence), sRGB, sampled evenly from its entry 64 of 256 to its last. The
/// first quarter is left out: it would make still liquid nearly black.
const LAPAZ: [[f32; 3]; ENTRIES] = [
    [0.1746, 0.3242, 0.5764],
    [0.1935, 0.3703, 0.5999],
    [0.2183, 0.4151, 0.6187],
    [0.2506, 0.4583, 0.6323],
    [0.2915, 0.4994, 0.6401],
    [0.3411, 0.5372, 0.6414],
    [0.3978, 0.5706, 0.6359],
    [0.4591, 0.5984, 0.6245],
    [0.5226, 0.6206, 0.6092],
    [0.5874, 0.6391, 0.5939],
    [0.6559, 0.6586, 0.5851],
    [0.7322, 0.6865, 0.5932],
    [0.8164, 0.7299, 0.6305],
    [0.8955, 0.7873, 0.6990],
    [0.9520, 0.8470, 0.7835],
    [0.9828, 0.9010, 0.8688],
    [0.9971, 0.9498, 0.9512],
];

/// The map in linear light, evenly spaced over the attribute's range.
pub fn linear_entries() -> [[f32; 4]; ENTRIES] {
    LAPAZ.map(|[red, green, blue]| [linear(red), linear(green), linear(blue), 1.0])
}

/// Decodes an sRGB component (IEC 61966-2-1).
fn linear(encoded: f32) -> f32 {
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        ((encoded + 0.055) / 1.055).powf(2.4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE lightness L* of linear sRGB (Rec. 709 luminance, D65).
    fn lightness([red, green, blue, _]: [f32; 4]) -> f32 {
        let luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
        116.0 * luminance.cbrt() - 16.0
    }

    /// A mistyped entry shows as a kink: "lapaz" rises in L* by about 4 a step.
    #[test]
    fn lightness_rises_evenly() {
        let map = linear_entries();
        for pair in map.windows(2) {
            let step = lightness(pair[1]) - lightness(pair[0]);
            assert!((1.0..7.0).contains(&step), "{step}");
        }
    }

    #[test]
    fn srgb_decoding_at_known_points() {
        // IEC 61966-2-1: 0.5 encodes 21.4 % linear light; ends map to ends.
        assert!((linear(0.5) - 0.214).abs() < 5e-4);
        assert_eq!(linear(0.0), 0.0);
        assert!((linear(1.0) - 1.0).abs() < 1e-6);
    }
}
