//! The scenes that come with the program.

/// Makes `BUILTIN` of the names of the files in `sim/scenes`.
macro_rules! builtin {
    ($($name:literal)*) => {
        /// Name and text of each.
        pub(super) const BUILTIN: &[(&str, &str)] =
            &[$(($name, include_str!(concat!("../../scenes/", $name, ".toml")))),*];
    };
}

builtin! {
    "beaker"
    "two-flasks"
    "moving-flask"
    "single-dilution"
    "triple-dilution"
    "tomato-soup"
    "three-flasks"
    "water-into-acid"
    "acid-into-water"
    "hot-acid"
    "hot-acid-85"
    "layer-and-swirl"
    "layer-and-swirl-right"
    "rinse-the-bottle"
    "boiling-water"
    "fume-hood"
    "acid-on-glove"
    "vr-dilution"
}
