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

/// Makes [`Buffers`] of a table: label, and words by the [`Sizes`] `$s`. Those of particles come first.
macro_rules! buffers {
    (
        |$s:ident|
        of particles { $($(#[$doc:meta])* $name:ident: $words:expr,)* }
        others { $($(#[$other_doc:meta])* $other:ident: $other_words:expr,)* }
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
            fn sized(gpu: &Gpu, $s: &Sizes) -> Result<Self, GpuError> {
                Ok(Self {
                    $($name: Buffer::storage(gpu, stringify!($name), 4 * ($words))?,)*
                    $($other: Buffer::storage(gpu, stringify!($other), 4 * ($other_words))?,)*
                })
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
    |s|
    of particles {
        position: 4 * s.n,
        /// w: the carried multiplier.
        velocity: 4 * s.n,
        /// (membership, identity).
        tags: 2 * s.n,
        list_origin: 4 * s.n,
        list_counts: s.n,
        list: s.listed,
        /// Where in the list those are that are longer than a particle's place; a snapshot has them in the particles' order.
        long_lists: s.n + 1,
        // Scratch of one substep.
        trial: 4 * s.n,
        solved: 4 * s.n,
        boundary: 4 * s.n,
        multiplier: s.n,
        new_velocity: 4 * s.n,
        vorticity: 4 * s.confined,
        // Scratch of a rebuild.
        sorted_position: 4 * s.n,
        sorted_tags: 2 * s.n,
        sorted_push: 4 * s.pushed,
        // Chemistry: state, and scratch of one substep and of a rebuild.
        heat: 4 * s.heated,
        diffused: 2 * s.diffused,
        mixing: 4 * s.heated,
        sorted_heat: 4 * s.heated,
        /// (c, h in J/kg, y, mass over V0·ρ0) of each particle.
        matter: 4 * s.physical,
        sorted_matter: 4 * s.physical,
        /// Heat and steam that particles exchanged with their surroundings, by identity ([`SolverState::ledger`](super::SolverState)).
        ledger: 4 * s.physical,
        /// Volume, density and vapour.
        bulk: 4 * s.physical,
        sorted_bulk: 4 * s.physical,
        /// Diffusivity of the unresolved eddies (m²/s) and variance of the acid fraction.
        eddies: 2 * s.physical,
        sorted_eddies: 2 * s.physical,
        /// What of its exchange a particle may keep, by slot.
        kept: s.physical,
        // Coupling with the rigid bodies.
        wall_push: 4 * s.pushed,
        // Reports.
        density: s.n,
        // Surface tension's nodes.
        colour_keys: 2 * s.slots,
        colour_used: s.slots,
        colour_blocks: 4 * s.slots,
        colour_around: colour::AROUND * s.slots,
        colour: s.nodes,
        colour_solid: 2 * s.nodes,
        interface_stress: 4 * s.nodes,
        smooth_colour: 4 * s.nodes,
        curvature: s.nodes,
        /// Force per volume with which walls hold the surface's line, by cell.
        line_hold: 4 * s.held_nodes,
        /// Acceleration with which walls hold particles at the surface's line (m/s²), and as w whose wall it is, by identity.
        held: 4 * s.held,
        /// Sums of the exchange of bubbles with particles (mass, enthalpy, gas and more) in whole quanta, by identity.
        bubbled: BUBBLED_WORDS as u64 * s.bubbly,
        /// What of the density at each particle is cavities', in whole quanta; 0 between substeps.
        cavities: 4 * s.bubbly,
        /// Share of a particle's neighbourhood that cavities take, by slot.
        hollow: s.bubbly,
        /// Gas volume of particles, the one that it goes to (V0), conductance of the bubbles around, and nucleation delay (s), by identity.
        gas: 4 * s.bubbly,
        /// Boiling state of particles, which bubbles read, by slot.
        boils: 4 * s.bubbly,
        /// Mass, acid and enthalpy that drops exchange with particles, in whole quanta, by identity.
        sprayed: SPRAYED_WORDS as u64 * s.sprayed,
        /// Greatest speed of a particle's fall (m/s; negative after it plunged) and width of its stream (m), by identity.
        falls: 2 * s.falling,
        /// Mass and enthalpy of the steam of each particle of which puffs were made, by identity.
        vented: 2 * s.steaming,
    }
    others {
        colour_args: 8,
        counters: size_of::<Counters>() as u64 / 4,
        cell_counts: s.cells,
        cell_starts: s.cells,
        block_counts: s.blocks,
        list_args: 12,
        /// Particles of cells during a rebuild, where the list keeps those of liquid that sleeps.
        cell_items: s.own_items,
        /// Number of particles that are awake, of those that rebuilds sort, and by flask whether its liquid sleeps.
        sleep: s.sleep,
        /// Sizes of the dispatches over particles that do not sleep.
        awake_args: s.awake_args,
        /// What was noted of each flask to tell.
        flask_sleeps: s.flask_sleeps,
        /// The table of the solution, and that of its lamellae behind it.
        solution: words_of(&s.solution),
        /// Records of bubbles before and after a step.
        bubbles: 2 * BUBBLE_WORDS as u64 * s.bubbles,
        /// By bubble's place, the particle at which a bubble is to be born, plus one; behind them the size of the dispatch that lists places.
        claims: s.claims,
        /// By step and bubble: quanta of steam, enthalpy and air of the bubbles that join it.
        merging: 6 * s.bubbles,
        /// By set of records and bubble, the place that takes its half if it divides, plus one.
        splits: 2 * s.bubbles,
        /// Places that have a bubble or drops, by set of records.
        live: s.live,
        /// Sizes of the dispatches over them.
        live_args: 16,
        /// Drops that bubbles threw up.
        drops: DROPS_WORDS as u64 * s.drops,
        /// By flask: quanta of gas that its bubbles let go since the last step, and the flow of it (m³/s, bits of an f32).
        venting: 2 * s.vented_flasks,
        /// By flask: quanta of drops of its liquid that came to rest elsewhere.
        spray_left: s.sprayed_flasks,
        /// By flask and ring: T (°C) and its rounding remainder.
        glass: 2 * s.rings,
        /// By flask and ring: quanta of heat that the liquid took from the glass in this frame.
        glass_taken: s.rings,
        /// By flask and row of its wall: places that liquid touched in this frame, a bit each.
        wetted: s.dew / AROUND as u64,
        /// Water on the flasks' inner walls.
        dew: s.dew * size_of::<Dew>() as u64 / 4,
        dew_rows: words_of(&s.dew_rows),
        puffs: s.puffs * size_of::<Puff>() as u64 / 4,
        /// By puff: quanta of water that condensed on walls in this frame.
        taken: s.puffs,
        /// Counts of puffs made, and of water that was washed off glass.
        made: s.made,
        /// Size of the dispatch of turnovers, and what it follows from.
        turnover_plan: PLAN_WORDS,
        poses: bytes_of_poses(s.substeps, s.flasks) / 4,
        loads: s.loads,
    }
}

/// Numbers of elements from which the buffers' sizes follow; 0 where a scene has no use for a buffer.
struct Sizes {
    /// Particles, and those of them that have heat, contents, and so on.
    n: u64,
    pushed: u64,
    heated: u64,
    physical: u64,
    diffused: u64,
    bubbly: u64,
    falling: u64,
    sprayed: u64,
    steaming: u64,
    confined: u64,
    held: u64,
    listed: u64,
    cells: u64,
    blocks: u64,
    own_items: u64,
    sleep: u64,
    awake_args: u64,
    flask_sleeps: u64,
    /// Blocks of surface tension's nodes, and the nodes.
    slots: u64,
    nodes: u64,
    held_nodes: u64,
    bubbles: u64,
    claims: u64,
    live: u64,
    drops: u64,
    vented_flasks: u64,
    sprayed_flasks: u64,
    rings: u64,
    dew: u64,
    puffs: u64,
    made: u64,
    flasks: u64,
    substeps: u32,
    loads: u64,
    solution: Vec<u8>,
    dew_rows: Vec<u8>,
}

fn words_of(bytes: &[u8]) -> u64 {
    bytes.len() as u64 / 4
}

impl Sizes {
    fn new(spec: &SolverSpec<'_>, count: u32, grid: &Grid) -> Self {
        let parameters = &spec.parameters;
        let n = u64::from(count);
        let flasks = spec.flasks.len() as u64;
        let where_asked = |asked: bool, number: u64| if asked { number } else { 0 };
        let groups = u64::from(count.div_ceil(LOAD_GROUP));
        let chemistry = parameters.chemistry.as_ref();
        let physical = matches!(chemistry, Some(Chemistry::Physical(_)));
        let feed = match chemistry {
            Some(Chemistry::Physical(physical)) => physical.lamella.map(|_| physical.feed),
            _ => None,
        };
        let bubbles = parameters.bubbles();
        let places = bubbles.map_or(0, |bubbles| u64::from(bubbles.slots()));
        let drops = bubbles.map_or(0, |bubbles| u64::from(bubbles.places_of_drops()));
        let slots = where_asked(
            parameters.surface.is_some(),
            Colour::new(parameters, count).slots.into(),
        );
        let nodes = colour::BLOCK_NODES * slots;
        let sticks = parameters.sticks();
        let steams = with_steam(parameters).is_some();
        let dew = dew_places(parameters, spec.flasks.len());
        let mut solution = bytes_of(physical.then(|| SolutionTable::new().rows()));
        solution.extend(bytes_of(feed.map(|feed| Lamellae::of(feed).rows())));
        let [sleep, awake_args, flask_sleeps] = sleep::words(parameters, spec.flasks.len());
        let dew_rows = (dew > 0).then(|| dew_rows(spec.flasks));
        Self {
            n,
            pushed: where_asked(spec.loads, n),
            heated: where_asked(chemistry.is_some(), n),
            physical: where_asked(physical, n),
            diffused: where_asked(matches!(chemistry, Some(Chemistry::Paper(_))), n),
            bubbly: where_asked(bubbles.is_some(), n),
            falling: where_asked(bubbles.is_some_and(|bubbles| bubbles.air), n),
            sprayed: where_asked(drops > 0, n),
            steaming: where_asked(steams, n),
            confined: where_asked(parameters.vorticity > 0.0, n),
            held: where_asked(sticks, n),
            listed: grid.places(count) + grid.long(count),
            cells: grid.cells().into(),
            blocks: grid.blocks().into(),
            own_items: grid.own_items(count),
            sleep,
            awake_args,
            flask_sleeps,
            slots,
            nodes,
            held_nodes: where_asked(sticks, nodes),
            bubbles: places,
            claims: where_asked(bubbles.is_some(), places + SIZE_WORDS),
            live: where_asked(bubbles.is_some(), places + 2),
            drops,
            vented_flasks: where_asked(bubbles.is_some(), flasks),
            sprayed_flasks: where_asked(drops > 0, flasks),
            rings: wall_heat::ring_count(chemistry, spec.flasks.len()) as u64,
            dew: dew as u64,
            puffs: where_asked(steams, PUFFS.into()),
            made: where_asked(steams, COUNTS as u64),
            flasks,
            substeps: parameters.substeps,
            loads: where_asked(spec.loads, 12 * groups * flasks),
            solution,
            dew_rows: bytes_of(dew_rows),
        }
    }
}

fn bytes_of<T: bytemuck::NoUninit>(rows: Option<Vec<T>>) -> Vec<u8> {
    rows.map_or(Vec::new(), |rows| bytemuck::cast_slice(&rows).to_vec())
}

impl Buffers {
    /// The buffers of a scene; records the upload of its tables.
    pub(super) fn new(
        gpu: &Gpu,
        rec: &mut Recorder,
        spec: &SolverSpec<'_>,
        count: u32,
        grid: &Grid,
    ) -> Result<Self, GpuError> {
        let sizes = Sizes::new(spec, count, grid);
        let buffers = Self::sized(gpu, &sizes)?;
        rec.upload(&buffers.solution, &sizes.solution)?;
        rec.upload(&buffers.dew_rows, &sizes.dew_rows)?;
        Ok(buffers)
    }
}
