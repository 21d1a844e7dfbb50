//! The colours that stand for a particle's attribute.

/// Entries of a colour map; the shader interpolates linearly between them.
pub const ENTRIES: usize = 17;

/// "lapaz": deep blue over slate to a pale cream, perceptually even, its
/// lightness rising throughout, readable with any common colour blindness and
/// in grey. Still liquid is blue and fast liquid nearly white, as foam would be.
///
/// Source: F. Crameri, Scientific colour maps 8.0 (doi:10.5281/zenodo.1243862,
/// MIT licence), every sixteenth of its 256 sRGB entries.
const LAPAZ: [[f32; 3]; ENTRIES] = [
    [0.1035, 0.0478, 0.3935],
    [0.1236, 0.1265, 0.4447],
    [0.1398, 0.1950, 0.4937],
    [0.1555, 0.2606, 0.5382],
    [0.1746, 0.3242, 0.5764],
    [0.2011, 0.3857, 0.6069],
    [0.2393, 0.4447, 0.6286],
    [0.2924, 0.5002, 0.6402],
    [0.3608, 0.5499, 0.6402],
    [0.4353, 0.5885, 0.6295],
    [0.5199, 0.6197, 0.6099],
    [0.6073, 0.6445, 0.5902],
    [0.7035, 0.6749, 0.5875],
    [0.8146, 0.7288, 0.6294],
    [0.9166, 0.8067, 0.7252],
    [0.9747, 0.8834, 0.8401],
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

    /// A mistyped entry shows as a kink: "lapaz" rises in L* by 5 ± 3 a step.
    #[test]
    fn lightness_rises_evenly() {
        let map = linear_entries();
        for pair in map.windows(2) {
            let step = lightness(pair[1]) - lightness(pair[0]);
            assert!((2.0..8.5).contains(&step), "{step}");
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
