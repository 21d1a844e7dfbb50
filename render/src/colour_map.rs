//! The colours that stand for a particle's attribute: a map for each, so that no
//! film is taken for another.

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

/// "plasma": indigo over magenta to yellow, perceptually even and its lightness
/// rising throughout, so that colour-blind readers and grey prints have the same
/// order: cold is dark, hot is light.
///
/// Source: N. Smith and S. van der Walt, matplotlib 1.5 (CC0), sRGB, sampled
/// evenly from its 256 entries.
const PLASMA: [[f32; 3]; ENTRIES] = [
    [0.0504, 0.0298, 0.5280],
    [0.1929, 0.0184, 0.5901],
    [0.2991, 0.0096, 0.6314],
    [0.3983, 0.0009, 0.6560],
    [0.4934, 0.0115, 0.6580],
    [0.5827, 0.0672, 0.6335],
    [0.6633, 0.1369, 0.5869],
    [0.7342, 0.2075, 0.5295],
    [0.7964, 0.2780, 0.4713],
    [0.8515, 0.3490, 0.4157],
    [0.9000, 0.4222, 0.3618],
    [0.9410, 0.4992, 0.3081],
    [0.9722, 0.5817, 0.2541],
    [0.9908, 0.6706, 0.2010],
    [0.9934, 0.7663, 0.1566],
    [0.9762, 0.8684, 0.1434],
    [0.9400, 0.9752, 0.1313],
];

/// "viridis": violet over green to yellow; by the same authors, with the same
/// properties and terms.
const VIRIDIS: [[f32; 3]; ENTRIES] = [
    [0.2670, 0.0049, 0.3294],
    [0.2823, 0.0946, 0.4170],
    [0.2789, 0.1749, 0.4830],
    [0.2593, 0.2507, 0.5244],
    [0.2302, 0.3213, 0.5455],
    [0.2000, 0.3864, 0.5545],
    [0.1733, 0.4474, 0.5579],
    [0.1497, 0.5064, 0.5573],
    [0.1281, 0.5651, 0.5509],
    [0.1203, 0.6238, 0.5343],
    [0.1554, 0.6815, 0.5032],
    [0.2415, 0.7366, 0.4545],
    [0.3629, 0.7867, 0.3866],
    [0.5081, 0.8292, 0.2992],
    [0.6694, 0.8622, 0.1954],
    [0.8359, 0.8861, 0.1025],
    [0.9932, 0.9062, 0.1439],
];

/// A perceptually even map that colour-blind readers can follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColourMap {
    /// For speed: blue to cream.
    Lapaz,
    /// For temperature: indigo to yellow.
    Plasma,
    /// For acid: violet to yellow by way of green.
    Viridis,
}

impl ColourMap {
    /// The map's colours, sRGB-encoded, evenly spaced over the attribute's range.
    pub fn entries(self) -> &'static [[f32; 3]; ENTRIES] {
        match self {
            Self::Lapaz => &LAPAZ,
            Self::Plasma => &PLASMA,
            Self::Viridis => &VIRIDIS,
        }
    }

    /// [`ColourMap::entries`] decoded to linear light, with alpha 1.
    pub fn linear_entries(self) -> [[f32; 4]; ENTRIES] {
        self.entries()
            .map(|[red, green, blue]| [linear(red), linear(green), linear(blue), 1.0])
    }

    /// The sRGB-encoded colour at `place`, 0 to 1.
    pub fn at(self, place: f32) -> [f32; 3] {
        let place = place.clamp(0.0, 1.0) * (ENTRIES - 1) as f32;
        let low = (place as usize).min(ENTRIES - 2);
        let share = place - low as f32;
        let (a, b) = (self.entries()[low], self.entries()[low + 1]);
        std::array::from_fn(|i| a[i] + share * (b[i] - a[i]))
    }
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

    /// A mistyped entry shows as a kink: the maps rise in L* by about 4 a step.
    #[test]
    fn lightness_rises_evenly() {
        for map in [ColourMap::Lapaz, ColourMap::Plasma, ColourMap::Viridis] {
            for pair in map.linear_entries().windows(2) {
                let step = lightness(pair[1]) - lightness(pair[0]);
                assert!((1.0..7.0).contains(&step), "{map:?}: {step}");
            }
        }
    }

    #[test]
    fn between_entries_is_between_colours() {
        let map = ColourMap::Plasma;
        assert_eq!(map.at(-1.0), map.entries()[0]);
        assert_eq!(map.at(2.0), map.entries()[ENTRIES - 1]);
        let (middle, a, b) = (map.at(2.5 / 16.0), map.entries()[2], map.entries()[3]);
        for i in 0..3 {
            assert!((middle[i] - 0.5 * (a[i] + b[i])).abs() < 1e-6);
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
