//! The constants of boiling that shaders have as plain numbers: those that were chosen, those that bound what may happen, and the
//! published ones by which a law begins.
//!
//! Left out are numbers that cannot be doubled or halved: `WIDEST` and `STRONGEST` are shares that end below 1, `MOST_RADIUS`, `STRIDE`
//! and `MOST_LOOKS` keep what a pass can reach, and a quantum decides no more than rounding.

use vitriol_sim::scene::Feature;

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

/// Makes `GROUPS` of a table: feature and file, and in braces name, unit and source of each constant.
macro_rules! groups {
    ($($feature:ident $file:literal { $($name:ident $unit:literal $source:literal,)* })*) => {
        /// All of them.
        pub(super) const GROUPS: &[Group] = &[$(Group {
            feature: Feature::$feature,
            file: $file,
            rows: &[$((stringify!($name), $unit, $source)),*],
        }),*];
    };
}

groups! {
    Bubbles "common/chemistry/boils.wgsl" {
        NUCLEUS_WAIT "s" "Zuber 1963, of bubbles that leave with 4 mm, which is chosen",
        NUCLEATION "K" "chosen: gas wider than 30 µm rises out of liquid",
    }
    Bubbles "common/chemistry/bubble_exchange.wgsl" {
        MOST_GROWTH "m/s" "chosen: a bound of growth that does not follow d",
        MOST_EXCHANGED "V0·ρ0" "bound: steam in a step",
        MOST_OF_SUPERHEAT "1" "bound: share of what superheat makes, in a step",
        MOST_GIVEN "V0" "bound: gas that a bubble gives",
    }
    Bubbles "common/chemistry/bubble_laws.wgsl" {
        FILM "1" "Prince and Blanch 1990: logarithm of 0.1 mm over 10 nm",
    }
    Bubbles "common/chemistry/bubble_motion.wgsl" {
        LEAST_BESIDE_GLASS "1" "bound: share of space that glass leaves",
        AT_GLASS "1" "chosen: share of glass that holds a bubble back",
        MOST_ACCELERATION "g" "bound: more is noise",
        CAVITY_COVERED "1" "chosen: with more, the inside of a swarm is a surface",
    }
    Bubbles "common/chemistry/bubble_surroundings.wgsl" {
        CONTACT "m" "chosen: what coarse particles resolve; at least LEAST_CONTACT",
        LEAST_CONTACT "d" "bound: with less a bubble lies between particles",
        LEAST_LIQUID "1" "bound: share of liquid that is divided by",
        HELD "1" "chosen: gas over liquid that particles can hold",
        LEAST_BELOW "1" "bound: what counts as liquid below a bubble",
        FOLLOWS "1" "chosen: how fast a cavity follows the crowd, in a step",
        MOST_FOLLOWED "1" "bound: the same, in a step",
        STILL_FOLLOWS "1" "chosen: so that whole cavities follow too",
    }
    Bubbles "common/chemistry/bubbled.wgsl" {
        MOST_AT_ONCE "V0·ρ0" "bound: steam that a particle takes at once",
    }
    Bubbles "common/chemistry/cavity.wgsl" {
        CAVITY_FROM "h" "chosen: what particles resolve; CAVITY_WHOLE goes with it",
        LEAST_SLOPE "1/h" "bound: push on a particle deep within a cavity",
    }
    Bubbles "common/chemistry/halves.wgsl" {
        PARTS_BY "R" "chosen: way of each half of a bubble",
    }
    Bubbles "common/chemistry/touching.wgsl" {
        PARTED "1" "chosen: share of an overlap left in a step",
        WIDEST_BUBBLE "1" "chosen: share of the vessel's width; wider ones divide",
    }
    Bubbles "sim/bubbles.wgsl" {
        NUCLEUS "m" "chosen: radius at birth",
        VANISHED "m" "chosen: radius at which one is gone",
        LEAST_FILLED "1" "chosen: half of the liquid around one at the surface",
        STAYS "m" "chosen: how well the surface is known",
        MOST_SHIFT "m/s" "bound: a cavity that leaps throws particles",
        TAKES_FLASK "d" "chosen: how near the liquid of another flask is",
    }
    Bubbles "sim/displacement.wgsl" {
        MOST_PUSHED "m/s" "chosen: what appears over a particle does not throw it",
    }
    Bubbles "sim/multiplier.wgsl" {
        MOST_ALONE "1" "chosen by the rise of a bubble of 7 mm: a little less than a surface has",
    }
    Evaporation "sim/exchange.wgsl" {
        MOST_EVAPORATED "1" "bound: share of the water, in a substep",
        LEAST_MASS "V0·ρ0" "bound: what a particle keeps",
    }
    Spray "common/chemistry/entrainment.wgsl" {
        CHURNS "1" "Kataoka and Ishii 1987: below it bubbles burst one by one",
        THROWN_UP "1" "Kataoka and Ishii 1984: near the surface",
        HIGHEST "1" "bound: height of a drop",
        WIDEST_DROP "a" "chosen by the fog of Kataoka and Ishii",
        FINER "1" "chosen by the fog of Kataoka and Ishii",
        FAST_LOTS "1" "chosen: how often rare drops are drawn, not their mass",
        SMALL_LOTS "1" "chosen: how often rare drops are drawn, not their mass",
    }
    Spray "common/chemistry/spray_laws.wgsl" {
        SMALLER "1" "Aurégan et al. 2025; the interpolation is ours",
        CLOSEST "1" "share of gas where bubbles touch; the interpolation is ours",
        JET_SIZE "1" "fitted to Spiel 1994, to 8 %",
        FILM_FROM "m" "chosen: drops of smaller ones are micrometres wide",
        LEAST_DRAINED "s" "bound: drainage of a film",
        THICKEST "R" "bound: thickness of a film",
    }
    Spray "common/chemistry/throwing.wgsl" {
        MOST_THROWN "1" "bound: share of a particle that goes into drops",
        LEANS "1" "chosen: tangent of 11°, from upwards or the level",
    }
    Spray "common/chemistry/venting.wgsl" {
        VENTED_OVER "s" "chosen: bubbles burst one by one",
    }
    Spray "sim/spray.wgsl" {
        JOINS "d" "chosen: how near drops are in liquid",
        SPREADS "d" "chosen: how far drops spread in liquid",
    }
    Air "sim/bubbles.wgsl" {
        BESIDE_GLASS "1" "chosen: share of glass under a stream that takes no air",
    }
    Air "common/chemistry/plunging.wgsl" {
        ONSET "m/s" "Ervine, McKeogh and Elsawy 1980",
        SLOWED "1" "chosen: share of its speed that tells it has plunged",
        IMMERSED "1" "chosen: share of a neighbourhood in liquid",
        RESTS "m/s" "chosen: what is at rest",
        MOST_THINNED "1" "bound: how much a stream thins in a step",
    }
}
