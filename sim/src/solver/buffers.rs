//! The particles' state and the solver's scratch memory: one table of all buffers. A particle's place in every array is the same; it
//! changes when the list is rebuilt. The table in `snapshot.rs` lists the buffers of which a state consists, and which of them are hashed.

use super::colour::{self, Colour};
use super::counters::Counters;
use super::dormant::{PLAN_WORDS, SIZE_WORDS};
use super::grid::Grid;
use super::sleep;
use super::spec::SolverSpec;
use super::vapour::{COUNTS, PUFFS, dew_places, dew_rows, with_steam};
use super::vessels::Vessels;
use super::wall_heat;
use crate::chemistry::Chemistry;
use crate::chemistry::dew::AROUND;
use crate::chemistry::segregation::Lamellae;
use crate::chemistry::table::SolutionTable;
use vitriol_gpu::{Buffer, Gpu, GpuError, Recorder};
use vitriol_shaders::layout::{Dew, Puff};

/// Threads of the load pass's workgroups.
pub(super) const LOAD_GROUP: u32 = 256;

/// Words of a bubble's record, and of the exchange of bubbles with a particle, as in `common/chemistry`.
pub(super) const BUBBLE_WORDS: usize = 28;
pub(super) const BUBBLED_WORDS: usize = 16;
/// Words of the drops of a bubble's jet or film, and of the exchange of drops with a particle, as in `common/chemistry`.
pub(super) const DROPS_WORDS: usize = 16;
pub(super) const SPRAYED_WORDS: usize = 4;

/// Bytes of the flasks' poses at a frame's start and at each substep's end.
pub(super) fn bytes_of_poses(substeps: u32, flasks: u64) -> u64 {
    4 * 8 * (u64::from(substeps) + 1) * flasks
}

/// (name in shaders, label of the buffer): scratch memory that is unused at that moment is bound under another name.
pub(super) const LENT: [(&str, &str); 6] = [
    // During a rebuild. `solved` and `new_velocity` are written only later; the particles of cells lie in `list` until it is made.
    ("cell_items", "list"),
    ("sorted_trial", "solved"),
    ("sorted_velocity", "new_velocity"),
    // While x* is sought.
    ("volumes", "mixing"),
    // Once the colour is filtered.
    ("unfiltered", "colour_solid"),
    // Outside of reports, which alone use `density`.
    ("wall_before", "density"),
];

/// Makes [`Buffers`] of a table: label and words, by the numbers that are computed first. Those of particles come first.
macro_rules! buffers {
    (
        |$spec:ident, $count:ident, $grid:ident| { $($numbers:tt)* }
        of particles { $($(#[$doc:meta])* $name:ident: $words:expr,)* }
        others { $($(#[$other_doc:meta])* $other:ident: $other_words:expr,)* }
        uploads { $($table:ident: $bytes:ident,)* }
    ) => {
        /// Device memory, labelled as in the shaders.
        pub(super) struct Buffers {
            $($(#[$doc])* pub(super) $name: Buffer,)*
            $($(#[$other_doc])* pub(super) $other: Buffer,)*
        }

        /// How many of [`Buffers::all`] grow with the number of particles.
        pub(super) const OF_PARTICLES: usize = [$(stringify!($name)),*].len();
        const ALL: usize = OF_PARTICLES + [$(stringify!($other)),*].len() + 9;

        impl Buffers {
            /// The buffers of a scene; records the upload of its tables.
            pub(super) fn new(
                gpu: &Gpu,
                rec: &mut Recorder,
                $spec: &SolverSpec<'_>,
                $count: u32,
                $grid: &Grid,
            ) -> Result<Self, GpuError> {
                $($numbers)*
                let buffers = Self {
                    $($name: Buffer::storage(gpu, stringify!($name), 4 * ($words))?,)*
                    $($other: Buffer::storage(gpu, stringify!($other), 4 * ($other_words))?,)*
                };
                $(rec.upload(&buffers.$table, &$bytes)?;)*
                Ok(buffers)
            }

            /// All that passes bind, those first that grow with the number of particles.
            pub(super) fn all<'a>(&'a self, vessels: &'a Vessels) -> [&'a Buffer; ALL] {
                [
                    $(&self.$name,)*
                    $(&self.$other,)*
                    &vessels.flasks,
                    &vessels.radii,
                    &vessels.maps,
                    &vessels.distances,
                    &vessels.glass_rings,
                    &vessels.plane,
                    &vessels.solids.cells,
                    &vessels.solids.starts,
                    &vessels.solids.solids,
                ]
            }
        }
    };
}

buffers! {
    |spec, count, grid| {
        // Elements, and 0 where a scene has no use for a buffer: first particles, and those of them that have heat, contents, and so on.
        let parameters = &spec.parameters;
        let where_asked = |asked: bool, number: u64| if asked { number } else { 0 };
        let chemistry = parameters.chemistry.as_ref();
        let bubbles = parameters.bubbles();
        let places = bubbles.map_or(0, |bubbles| u64::from(bubbles.slots()));
        let drops = bubbles.map_or(0, |bubbles| u64::from(bubbles.places_of_drops()));
        let is_physical = matches!(chemistry, Some(Chemistry::Physical(_)));
        let n = u64::from(count);
        let pushed = where_asked(spec.loads, n);
        let heated = where_asked(chemistry.is_some(), n);
        let physical = where_asked(is_physical, n);
        let diffused = where_asked(matches!(chemistry, Some(Chemistry::Paper(_))), n);
        let bubbly = where_asked(bubbles.is_some(), n);
        let falling = where_asked(bubbles.is_some_and(|bubbles| bubbles.air), n);
        let sprayed = where_asked(drops > 0, n);
        let steams = with_steam(parameters).is_some();
        let confined = where_asked(parameters.vorticity > 0.0, n);
        // Blocks of surface tension's nodes, and the nodes.
        let blocks = u64::from(Colour::new(parameters, count).slots);
        let blocks = where_asked(parameters.surface.is_some(), blocks);
        let nodes = colour::BLOCK_NODES * blocks;
        let sticks = parameters.sticks();
        let flasks = spec.flasks.len() as u64;
        let [sleep, awake_args, flask_sleeps] = sleep::words(parameters, spec.flasks.len());
        let rings = wall_heat::ring_count(chemistry, spec.flasks.len()) as u64;
        let dew = dew_places(parameters, spec.flasks.len()) as u64;
        let puffs = where_asked(steams, PUFFS.into());
        let groups = u64::from(count.div_ceil(LOAD_GROUP));
        let feed = match chemistry {
            Some(Chemistry::Physical(physical)) => physical.lamella.map(|_| physical.feed),
            _ => None,
        };
        let mut solution = bytes_of(is_physical.then(|| SolutionTable::new().rows()));
        solution.extend(bytes_of(feed.map(|feed| Lamellae::of(feed).rows())));
        let dew_rows = bytes_of((dew > 0).then(|| dew_rows(spec.flasks)));
    }
    of particles {
        position: 4 * n,
        /// w: the carried multiplier.
        velocity: 4 * n,
        /// (membership, identity).
        tags: 2 * n,
        list_origin: 4 * n,
        list_counts: n,
        list: grid.places(count) + grid.long(count),
        /// Where in the list those are that are longer than a particle's place; a snapshot has them in the particles' order.
        long_lists: n + 1,
        // Scratch of one substep.
        trial: 4 * n,
        solved: 4 * n,
        boundary: 4 * n,
        multiplier: n,
        new_velocity: 4 * n,
        vorticity: 4 * confined,
        // Scratch of a rebuild.
        sorted_position: 4 * n,
        sorted_tags: 2 * n,
        sorted_push: 4 * pushed,
        // Chemistry: state, and scratch of one substep and of a rebuild.
        heat: 4 * heated,
        diffused: 2 * diffused,
        mixing: 4 * heated,
        sorted_heat: 4 * heated,
        /// (c, h in J/kg, y, mass over V0·ρ0) of each particle.
        matter: 4 * physical,
        sorted_matter: 4 * physical,
        /// Heat and steam that particles exchanged with their surroundings, by identity ([`SolverState::ledger`](super::SolverState)).
        ledger: 4 * physical,
        /// Volume, density and vapour.
        bulk: 4 * physical,
        sorted_bulk: 4 * physical,
        /// Diffusivity of the unresolved eddies (m²/s) and variance of the acid fraction.
        eddies: 2 * physical,
        sorted_eddies: 2 * physical,
        /// What of its exchange a particle may keep, by slot.
        kept: physical,
        // Coupling with the rigid bodies.
        wall_push: 4 * pushed,
        // Reports.
        density: n,
        // Surface tension's nodes.
        colour_keys: 2 * blocks,
        colour_used: blocks,
        colour_blocks: 4 * blocks,
        colour_around: colour::AROUND * blocks,
        colour: nodes,
        colour_solid: 2 * nodes,
        interface_stress: 4 * nodes,
        smooth_colour: 4 * nodes,
        curvature: nodes,
        /// Force per volume with which walls hold the surface's line, by cell.
        line_hold: 4 * where_asked(sticks, nodes),
        /// Acceleration with which walls hold particles at the surface's line (m/s²), and as w whose wall it is, by identity.
        held: 4 * where_asked(sticks, n),
        /// Sums of the exchange of bubbles with particles (mass, enthalpy, gas and more) in whole quanta, by identity.
        bubbled: BUBBLED_WORDS as u64 * bubbly,
        /// What of the density at each particle is cavities', in whole quanta; 0 between substeps.
        cavities: 4 * bubbly,
        /// Share of a particle's neighbourhood that cavities take, by slot.
        hollow: bubbly,
        /// Gas volume of particles, the one that it goes to (V0), conductance of the bubbles around, and nucleation delay (s), by identity.
        gas: 4 * bubbly,
        /// Boiling state of particles, which bubbles read, by slot.
        boils: 4 * bubbly,
        /// Mass, acid and enthalpy that drops exchange with particles, in whole quanta, by identity.
        sprayed: SPRAYED_WORDS as u64 * sprayed,
        /// Greatest speed of a particle's fall (m/s; negative after it plunged) and width of its stream (m), by identity.
        falls: 2 * falling,
        /// Mass and enthalpy of the steam of each particle of which puffs were made, by identity.
        vented: 2 * where_asked(steams, n),
    }
    others {
        colour_args: 8,
        counters: size_of::<Counters>() as u64 / 4,
        cell_counts: u64::from(grid.cells()),
        cell_starts: u64::from(grid.cells()),
        block_counts: u64::from(grid.blocks()),
        list_args: 12,
        /// Particles of cells during a rebuild, where the list keeps those of liquid that sleeps.
        cell_items: grid.own_items(count),
        /// Number of particles that are awake, of those that rebuilds sort, and by flask whether its liquid sleeps.
        sleep: sleep,
        /// Sizes of the dispatches over particles that do not sleep.
        awake_args: awake_args,
        /// What was noted of each flask to tell.
        flask_sleeps: flask_sleeps,
        /// The table of the solution, and that of its lamellae behind it.
        solution: words_of(&solution),
        /// Records of bubbles before and after a step.
        bubbles: 2 * BUBBLE_WORDS as u64 * places,
        /// By bubble's place, the particle at which a bubble is to be born, plus one; behind them the sizes of the dispatches that list places
        /// and look at them.
        claims: where_asked(bubbles.is_some(), places + 2 * SIZE_WORDS),
        /// By step and bubble: quanta of steam, enthalpy and air of the bubbles that join it.
        merging: 6 * places,
        /// By set of records and bubble, the place that takes its half if it divides, plus one.
        splits: 2 * places,
        /// Places that have a bubble or drops, by set of records.
        live: where_asked(bubbles.is_some(), places + 2),
        /// Sizes of the dispatches over them.
        live_args: 16,
        /// Drops that bubbles threw up.
        drops: DROPS_WORDS as u64 * drops,
        /// By flask: quanta of gas that its bubbles let go since the last step, and the flow of it (m³/s, bits of an f32).
        venting: 2 * where_asked(bubbles.is_some(), flasks),
        /// By flask: quanta of drops of its liquid that came to rest elsewhere.
        spray_left: where_asked(drops > 0, flasks),
        /// By flask and ring: T (°C) and its rounding remainder.
        glass: 2 * rings,
        /// By flask and ring: quanta of heat that the liquid took from the glass in this frame.
        glass_taken: rings,
        /// By flask and row of its wall: places that liquid touched in this frame, a bit each.
        wetted: dew / AROUND as u64,
        /// Water on the flasks' inner walls.
        dew: dew * size_of::<Dew>() as u64 / 4,
        dew_rows: words_of(&dew_rows),
        puffs: puffs * size_of::<Puff>() as u64 / 4,
        /// By puff: quanta of water that condensed on walls in this frame.
        taken: puffs,
        /// Counts of puffs made, and of water that was washed off glass.
        made: where_asked(steams, COUNTS as u64),
        /// Size of the dispatch of turnovers, and what it follows from.
        turnover_plan: PLAN_WORDS,
        poses: bytes_of_poses(parameters.substeps, flasks) / 4,
        loads: where_asked(spec.loads, 12 * groups * flasks),
    }
    uploads {
        solution: solution,
        dew_rows: dew_rows,
    }
}

fn words_of(bytes: &[u8]) -> u64 {
    bytes.len() as u64 / 4
}

fn bytes_of<T: bytemuck::NoUninit>(rows: Option<Vec<T>>) -> Vec<u8> {
    rows.map_or(Vec::new(), |rows| bytemuck::cast_slice(&rows).to_vec())
}
