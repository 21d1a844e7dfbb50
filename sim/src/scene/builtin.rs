//! The scenes that come with the program.

/// Name and text of each.
pub(super) const BUILTIN: [(&str, &str); 18] = [
    ("beaker", include_str!("../../scenes/beaker.toml")),
    ("two-flasks", include_str!("../../scenes/two-flasks.toml")),
    (
        "moving-flask",
        include_str!("../../scenes/moving-flask.toml"),
    ),
    (
        "single-dilution",
        include_str!("../../scenes/single-dilution.toml"),
    ),
    (
        "triple-dilution",
        include_str!("../../scenes/triple-dilution.toml"),
    ),
    ("tomato-soup", include_str!("../../scenes/tomato-soup.toml")),
    (
        "three-flasks",
        include_str!("../../scenes/three-flasks.toml"),
    ),
    (
        "water-into-acid",
        include_str!("../../scenes/water-into-acid.toml"),
    ),
    (
        "acid-into-water",
        include_str!("../../scenes/acid-into-water.toml"),
    ),
    ("hot-acid", include_str!("../../scenes/hot-acid.toml")),
    ("hot-acid-85", include_str!("../../scenes/hot-acid-85.toml")),
    (
        "layer-and-swirl",
        include_str!("../../scenes/layer-and-swirl.toml"),
    ),
    (
        "layer-and-swirl-right",
        include_str!("../../scenes/layer-and-swirl-right.toml"),
    ),
    (
        "rinse-the-bottle",
        include_str!("../../scenes/rinse-the-bottle.toml"),
    ),
    (
        "boiling-water",
        include_str!("../../scenes/boiling-water.toml"),
    ),
    ("fume-hood", include_str!("../../scenes/fume-hood.toml")),
    (
        "acid-on-glove",
        include_str!("../../scenes/acid-on-glove.toml"),
    ),
    ("vr-dilution", include_str!("../../scenes/vr-dilution.toml")),
];
