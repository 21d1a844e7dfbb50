//! The constants of boiling that shaders have as plain numbers: those that were chosen, those that bound what may happen, and the
//! published ones by which a law begins.
//!
//! Left out are numbers that cannot be doubled or halved: `WIDEST` and `STRONGEST` are shares that end below 1, `MOST_RADIUS`, `STRIDE`
//! and `MOST_LOOKS` keep what a pass can reach, and a quantum decides no more than rounding.

use vitriol_sim::scene::Feature::{self, Air, Bubbles, Evaporation, Spray};

/// Name, unit and source of a constant.
type Row = (&'static str, &'static str, &'static str);

/// The constants of a file under `shaders/wgsl` that scenes of one feature use.
pub(super) struct Group {
    /// The feature.
    pub feature: Feature,
    /// Path under `shaders/wgsl`.
    pub file: &'static str,
    /// Its constants.
    pub rows: &'static [Row],
}

/// All of them.
pub(super) const GROUPS: [Group; 19] = [
    Group {
        feature: Bubbles,
        file: "common/chemistry/boils.wgsl",
        rows: &[
            (
                "NUCLEUS_WAIT",
                "s",
                "Zuber 1963, of bubbles that leave with 4 mm, which is chosen",
            ),
            (
                "NUCLEATION",
                "K",
                "chosen: gas wider than 30 µm rises out of liquid",
            ),
        ],
    },
    Group {
        feature: Bubbles,
        file: "common/chemistry/bubble_exchange.wgsl",
        rows: &[
            ("MOST_EXCHANGED", "V0·ρ0", "bound: steam in a step"),
            (
                "MOST_OF_SUPERHEAT",
                "1",
                "bound: share of what superheat makes, in a step",
            ),
            ("MOST_GIVEN", "V0", "bound: gas that a bubble gives"),
        ],
    },
    Group {
        feature: Bubbles,
        file: "common/chemistry/bubble_laws.wgsl",
        rows: &[(
            "FILM",
            "1",
            "Prince and Blanch 1990: logarithm of 0.1 mm over 10 nm",
        )],
    },
    Group {
        feature: Bubbles,
        file: "common/chemistry/bubble_motion.wgsl",
        rows: &[
            (
                "LEAST_BESIDE_GLASS",
                "1",
                "bound: share of space that glass leaves",
            ),
            (
                "AT_GLASS",
                "1",
                "chosen: share of glass that holds a bubble back",
            ),
            ("MOST_ACCELERATION", "g", "bound: more is noise"),
            (
                "CAVITY_COVERED",
                "1",
                "chosen: with more, the inside of a swarm is a surface",
            ),
        ],
    },
    Group {
        feature: Bubbles,
        file: "common/chemistry/bubble_surroundings.wgsl",
        rows: &[
            (
                "CONTACT",
                "m",
                "chosen: what coarse particles resolve; at least LEAST_CONTACT",
            ),
            (
                "LEAST_CONTACT",
                "d",
                "bound: with less a bubble lies between particles",
            ),
            (
                "LEAST_LIQUID",
                "1",
                "bound: share of liquid that is divided by",
            ),
            (
                "HELD",
                "1",
                "chosen: gas over liquid that particles can hold",
            ),
            (
                "LEAST_BELOW",
                "1",
                "bound: what counts as liquid below a bubble",
            ),
            (
                "FOLLOWS",
                "1",
                "chosen: how fast a cavity follows the crowd, in a step",
            ),
            ("MOST_FOLLOWED", "1", "bound: the same, in a step"),
            (
                "STILL_FOLLOWS",
                "1",
                "chosen: so that whole cavities follow too",
            ),
        ],
    },
    Group {
        feature: Bubbles,
        file: "common/chemistry/bubbled.wgsl",
        rows: &[(
            "MOST_AT_ONCE",
            "V0·ρ0",
            "bound: steam that a particle takes at once",
        )],
    },
    Group {
        feature: Bubbles,
        file: "common/chemistry/cavity.wgsl",
        rows: &[
            (
                "CAVITY_FROM",
                "h",
                "chosen: what particles resolve; CAVITY_WHOLE goes with it",
            ),
            (
                "LEAST_SLOPE",
                "1/h",
                "bound: push on a particle deep within a cavity",
            ),
        ],
    },
    Group {
        feature: Bubbles,
        file: "common/chemistry/halves.wgsl",
        rows: &[("PARTS_BY", "R", "chosen: way of each half of a bubble")],
    },
    Group {
        feature: Bubbles,
        file: "common/chemistry/touching.wgsl",
        rows: &[
            ("PARTED", "1", "chosen: share of an overlap left in a step"),
            (
                "WIDEST_BUBBLE",
                "1",
                "chosen: share of the vessel's width; wider ones divide",
            ),
        ],
    },
    Group {
        feature: Bubbles,
        file: "sim/bubbles.wgsl",
        rows: &[
            ("NUCLEUS", "m", "chosen: radius at birth"),
            ("VANISHED", "m", "chosen: radius at which one is gone"),
            (
                "LEAST_FILLED",
                "1",
                "chosen: half of the liquid around one at the surface",
            ),
            ("STAYS", "m", "chosen: how well the surface is known"),
            (
                "MOST_SHIFT",
                "m/s",
                "bound: a cavity that leaps throws particles",
            ),
            (
                "TAKES_FLASK",
                "d",
                "chosen: how near the liquid of another flask is",
            ),
        ],
    },
    Group {
        feature: Bubbles,
        file: "sim/multiplier.wgsl",
        rows: &[(
            "MOST_ALONE",
            "1",
            "chosen by the rise of a bubble of 7 mm: a little less than a surface has",
        )],
    },
    Group {
        feature: Evaporation,
        file: "sim/exchange.wgsl",
        rows: &[
            (
                "MOST_EVAPORATED",
                "1",
                "bound: share of the water, in a substep",
            ),
            ("LEAST_MASS", "V0·ρ0", "bound: what a particle keeps"),
        ],
    },
    Group {
        feature: Spray,
        file: "common/chemistry/entrainment.wgsl",
        rows: &[
            (
                "CHURNS",
                "1",
                "Kataoka and Ishii 1987: below it bubbles burst one by one",
            ),
            ("THROWN_UP", "1", "Kataoka and Ishii 1984: near the surface"),
            ("HIGHEST", "1", "bound: height of a drop"),
            ("WIDEST_DROP", "a", "chosen by the fog of Kataoka and Ishii"),
            ("FINER", "1", "chosen by the fog of Kataoka and Ishii"),
            (
                "FAST_LOTS",
                "1",
                "chosen: how often rare drops are drawn, not their mass",
            ),
            (
                "SMALL_LOTS",
                "1",
                "chosen: how often rare drops are drawn, not their mass",
            ),
        ],
    },
    Group {
        feature: Spray,
        file: "common/chemistry/spray_laws.wgsl",
        rows: &[
            (
                "SMALLER",
                "1",
                "Aurégan et al. 2025; the interpolation is ours",
            ),
            (
                "CLOSEST",
                "1",
                "share of gas where bubbles touch; the interpolation is ours",
            ),
            ("JET_SIZE", "1", "fitted to Spiel 1994, to 8 %"),
            (
                "FILM_FROM",
                "m",
                "chosen: drops of smaller ones are micrometres wide",
            ),
            ("LEAST_DRAINED", "s", "bound: drainage of a film"),
            ("THICKEST", "R", "bound: thickness of a film"),
        ],
    },
    Group {
        feature: Spray,
        file: "common/chemistry/throwing.wgsl",
        rows: &[
            (
                "MOST_THROWN",
                "1",
                "bound: share of a particle that goes into drops",
            ),
            (
                "LEANS",
                "1",
                "chosen: tangent of 11°, from upwards or the level",
            ),
        ],
    },
    Group {
        feature: Spray,
        file: "common/chemistry/venting.wgsl",
        rows: &[("VENTED_OVER", "s", "chosen: bubbles burst one by one")],
    },
    Group {
        feature: Spray,
        file: "sim/spray.wgsl",
        rows: &[
            ("JOINS", "d", "chosen: how near drops are in liquid"),
            ("SPREADS", "d", "chosen: how far drops spread in liquid"),
        ],
    },
    Group {
        feature: Air,
        file: "sim/bubbles.wgsl",
        rows: &[(
            "BESIDE_GLASS",
            "1",
            "chosen: share of glass under a stream that takes no air",
        )],
    },
    Group {
        feature: Air,
        file: "common/chemistry/plunging.wgsl",
        rows: &[
            ("ONSET", "m/s", "Ervine, McKeogh and Elsawy 1980"),
            (
                "SLOWED",
                "1",
                "chosen: share of its speed that tells it has plunged",
            ),
            (
                "IMMERSED",
                "1",
                "chosen: share of a neighbourhood in liquid",
            ),
            ("RESTS", "m/s", "chosen: what is at rest"),
            (
                "MOST_THINNED",
                "1",
                "bound: how much a stream thins in a step",
            ),
        ],
    },
];
