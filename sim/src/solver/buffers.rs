//! The particles' state and the solver's scratch memory. A particle's place in
//! every array is the same; it changes when the list is rebuilt.

use super::colour::{self, Colour};
use super::counters::Counters;
use super::glass;
use super::grid::Grid;
use super::spec::SolverSpec;
use super::transfer::upload;
use super::vapour::dew_places;
use super::vessels::Vessels;
use crate::chemistry::Chemistry;
use crate::chemistry::dew::AROUND;
use crate::chemistry::segregation::Lamellae;
use crate::chemistry::table::SolutionTable;
use vitriol_gpu::{Buffer, Gpu, GpuError};

/// Threads of the load pass's workgroups.
pub(super) const LOAD_GROUP: u32 = 256;

/// How many of [`Buffers::all`] grow with the number of particles.
pub(super) const OF_PARTICLES: usize = 45;

/// Words of a bubble's record, and of what bubbles do to a particle, as in `common/chemistry`.
pub(super) const BUBBLE_WORDS: usize = 20;
pub(super) const BUBBLED_WORDS: usize = 8;
/// The same of drops.
pub(super) const DROPS_WORDS: usize = 16;
pub(super) const SPRAYED_WORDS: usize = 4;

/// Of the flasks' poses at a frame's start and at each substep's end.
pub(super) fn bytes_of_poses(substeps: u32, flasks: u64) -> u64 {
    4 * 8 * (u64::from(substeps) + 1) * flasks
}

/// Device memory, named and labelled as in the shaders.
pub(super) struct Buffers {
    // State: what a snapshot holds.
    pub(super) position: Buffer,
    /// w: the carried multiplier.
    pub(super) velocity: Buffer,
    /// (membership, identity).
    pub(super) tags: Buffer,
    pub(super) list_origin: Buffer,
    pub(super) list_counts: Buffer,
    pub(super) list: Buffer,
    /// Where in the list those are that are longer than a particle's place; a snapshot has them in the particles' order.
    pub(super) long_lists: Buffer,
    pub(super) counters: Buffer,
    // Scratch of one substep.
    pub(super) trial: Buffer,
    pub(super) solved: Buffer,
    pub(super) boundary: Buffer,
    pub(super) multiplier: Buffer,
    pub(super) new_velocity: Buffer,
    pub(super) vorticity: Buffer,
    // Scratch of a rebuild. The sorted copies of what is dead at that moment
    // share its memory: `solved` and `new_velocity` are written only later. The
    // particles of cells lie in `list` until it is made.
    pub(super) sorted_position: Buffer,
    pub(super) sorted_tags: Buffer,
    pub(super) sorted_push: Buffer,
    pub(super) cell_counts: Buffer,
    pub(super) cell_starts: Buffer,
    pub(super) block_counts: Buffer,
    pub(super) list_args: Buffer,
    // Chemistry; state, and scratch of one substep and of a rebuild.
    pub(super) heat: Buffer,
    pub(super) diffused: Buffer,
    pub(super) mixing: Buffer,
    pub(super) sorted_heat: Buffer,
    /// The physical chemistry's: what particles hold, and by identity what
    /// they took and gave.
    pub(super) matter: Buffer,
    pub(super) sorted_matter: Buffer,
    pub(super) ledger: Buffer,
    /// Volume, density and vapour.
    pub(super) bulk: Buffer,
    pub(super) sorted_bulk: Buffer,
    /// What the flow leaves unresolved.
    pub(super) eddies: Buffer,
    pub(super) sorted_eddies: Buffer,
    pub(super) solution: Buffer,
    pub(super) lamellae: Buffer,
    /// Bubbles: their records before and after a step, what they do to particles and what these have of it by identity, what
    /// particles are to them by slot, and by bubble where one is to be born and what joins it.
    pub(super) bubbles: Buffer,
    pub(super) bubbled: Buffer,
    pub(super) gas: Buffer,
    pub(super) boils: Buffer,
    pub(super) claims: Buffer,
    pub(super) merging: Buffer,
    /// Places that have a bubble or drops, and the sizes of the dispatches over them, by set of records.
    pub(super) live: Buffer,
    pub(super) live_args: Buffer,
    /// How particles fell, by identity.
    pub(super) falls: Buffer,
    /// Drops that bubbles threw up, what they do to particles by identity, and what of them left each flask.
    pub(super) drops: Buffer,
    pub(super) sprayed: Buffer,
    pub(super) spray_left: Buffer,
    /// By flask and ring: T and what it lacks, and heat taken from it in this frame.
    pub(super) glass: Buffer,
    pub(super) glass_taken: Buffer,
    /// By flask and row of its wall: places that liquid touched in this frame, a bit each.
    pub(super) wetted: Buffer,
    // Surface tension's nodes.
    pub(super) colour_keys: Buffer,
    pub(super) colour_used: Buffer,
    pub(super) colour_blocks: Buffer,
    pub(super) colour_args: Buffer,
    pub(super) colour_around: Buffer,
    pub(super) colour: Buffer,
    pub(super) colour_solid: Buffer,
    pub(super) interface_stress: Buffer,
    pub(super) smooth_colour: Buffer,
    pub(super) curvature: Buffer,
    /// What walls hold the surface's line with, by cell and by identity.
    pub(super) line_hold: Buffer,
    pub(super) held: Buffer,
    // Coupling with the rigid bodies.
    pub(super) poses: Buffer,
    pub(super) wall_push: Buffer,
    pub(super) loads: Buffer,
    // Reports.
    pub(super) density: Buffer,
}

/// `live_args` where no place of a bubble has anything: of each set of records two dispatches of no workgroups, and padding.
pub(super) const NO_PLACES: [u32; 16] = [0, 1, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0];

impl Buffers {
    pub(super) fn new(
        gpu: &Gpu,
        spec: &SolverSpec<'_>,
        count: u32,
        grid: &Grid,
    ) -> Result<Self, GpuError> {
        let n = u64::from(count);
        let flasks = spec.flasks.len() as u64;
        let words = |label, number: u64| Buffer::storage(gpu, label, 4 * number);
        let where_asked = |asked: bool, number: u64| if asked { number } else { 0 };
        let pushed = where_asked(spec.loads, n);
        let groups = u64::from(count.div_ceil(LOAD_GROUP));
        let chemistry = spec.parameters.chemistry.as_ref();
        let heated = where_asked(chemistry.is_some(), n);
        let physical = matches!(chemistry, Some(Chemistry::Physical(_)));
        let held = where_asked(physical, n);
        let diffused = where_asked(matches!(chemistry, Some(Chemistry::Paper(_))), n);
        let table = if physical {
            SolutionTable::new().rows()
        } else {
            Vec::new()
        };
        let lamellae = match chemistry {
            Some(Chemistry::Physical(physical)) if physical.lamella.is_some() => {
                Lamellae::get().rows()
            }
            _ => Vec::new(),
        };
        let rings = glass::ring_count(spec.parameters.chemistry.as_ref(), spec.flasks.len()) as u64;
        let dew_rows = (dew_places(&spec.parameters, spec.flasks.len()) / AROUND) as u64;
        let bubbles = spec.parameters.bubbles();
        let slots_of_bubbles = bubbles.map_or(0, |bubbles| u64::from(bubbles.slots()));
        let bubbly = where_asked(bubbles.is_some(), n);
        let falling = where_asked(bubbles.is_some_and(|bubbles| bubbles.air), n);
        let places_of_drops = bubbles.map_or(0, |bubbles| u64::from(bubbles.places_of_drops()));
        let sprayed = where_asked(places_of_drops > 0, n);
        let confined = spec.parameters.vorticity > 0.0;
        let colour = Colour::new(&spec.parameters, count);
        let slots = where_asked(spec.parameters.surface.is_some(), colour.slots.into());
        let nodes = colour::BLOCK_NODES * slots;
        let sticks = spec.parameters.sticks();
        Ok(Self {
            position: words("position", 4 * n)?,
            velocity: words("velocity", 4 * n)?,
            tags: words("tags", 2 * n)?,
            list_origin: words("list_origin", 4 * n)?,
            list_counts: words("list_counts", n)?,
            list: words("list", grid.places(count) + grid.long(count))?,
            long_lists: words("long_lists", n + 1)?,
            counters: words("counters", size_of::<Counters>() as u64 / 4)?,
            trial: words("trial", 4 * n)?,
            solved: words("solved", 4 * n)?,
            boundary: words("boundary", 4 * n)?,
            multiplier: words("multiplier", n)?,
            new_velocity: words("new_velocity", 4 * n)?,
            vorticity: words("vorticity", where_asked(confined, 4 * n))?,
            sorted_position: words("sorted_position", 4 * n)?,
            sorted_tags: words("sorted_tags", 2 * n)?,
            sorted_push: words("sorted_push", 4 * pushed)?,
            cell_counts: words("cell_counts", u64::from(grid.cells()))?,
            cell_starts: words("cell_starts", u64::from(grid.cells()))?,
            block_counts: words("block_counts", u64::from(grid.blocks()))?,
            list_args: words("list_args", 12)?,
            heat: words("heat", 4 * heated)?,
            diffused: words("diffused", 2 * diffused)?,
            mixing: words("mixing", 4 * heated)?,
            sorted_heat: words("sorted_heat", 4 * heated)?,
            matter: words("matter", 4 * held)?,
            sorted_matter: words("sorted_matter", 4 * held)?,
            ledger: words("ledger", 4 * held)?,
            bulk: words("bulk", 4 * held)?,
            sorted_bulk: words("sorted_bulk", 4 * held)?,
            eddies: words("eddies", 2 * held)?,
            sorted_eddies: words("sorted_eddies", 2 * held)?,
            solution: upload(gpu, "solution", &table)?,
            lamellae: upload(gpu, "lamellae", &lamellae)?,
            bubbles: words("bubbles", 2 * BUBBLE_WORDS as u64 * slots_of_bubbles)?,
            bubbled: words("bubbled", BUBBLED_WORDS as u64 * bubbly)?,
            gas: words("gas", 4 * bubbly)?,
            boils: words("boils", 4 * bubbly)?,
            claims: words("claims", slots_of_bubbles)?,
            merging: words("merging", 6 * slots_of_bubbles)?,
            live: words("live", where_asked(bubbles.is_some(), slots_of_bubbles + 2))?,
            live_args: words("live_args", 16)?,
            falls: words("falls", 2 * falling)?,
            drops: words("drops", DROPS_WORDS as u64 * places_of_drops)?,
            sprayed: words("sprayed", SPRAYED_WORDS as u64 * sprayed)?,
            spray_left: words("spray_left", where_asked(places_of_drops > 0, flasks))?,
            glass: words("glass", 2 * rings)?,
            glass_taken: words("glass_taken", rings)?,
            wetted: words("wetted", dew_rows)?,
            colour_keys: words("colour_keys", 2 * slots)?,
            colour_used: words("colour_used", slots)?,
            colour_blocks: words("colour_blocks", 4 * slots)?,
            colour_around: words("colour_around", colour::AROUND * slots)?,
            colour_args: words("colour_args", 8)?,
            colour: words("colour", nodes)?,
            colour_solid: words("colour_solid", 2 * nodes)?,
            interface_stress: words("interface_stress", 4 * nodes)?,
            smooth_colour: words("smooth_colour", 4 * nodes)?,
            curvature: words("curvature", nodes)?,
            line_hold: words("line_hold", where_asked(sticks, 4 * nodes))?,
            held: words("held", where_asked(sticks, 4 * n))?,
            poses: Buffer::storage(
                gpu,
                "poses",
                bytes_of_poses(spec.parameters.substeps, flasks),
            )?,
            wall_push: words("wall_push", 4 * pushed)?,
            loads: words("loads", where_asked(spec.loads, 12 * groups * flasks))?,
            density: words("density", n)?,
        })
    }

    /// All that passes bind, those first that grow with the number of particles; a buffer's label
    /// is the name that shaders give it.
    pub(super) fn all<'a>(&'a self, vessels: &'a Vessels) -> [&'a Buffer; OF_PARTICLES + 29] {
        [
            &self.position,
            &self.velocity,
            &self.tags,
            &self.list_origin,
            &self.list_counts,
            &self.list,
            &self.long_lists,
            &self.trial,
            &self.solved,
            &self.boundary,
            &self.multiplier,
            &self.new_velocity,
            &self.vorticity,
            &self.sorted_position,
            &self.sorted_tags,
            &self.sorted_push,
            &self.heat,
            &self.diffused,
            &self.mixing,
            &self.sorted_heat,
            &self.matter,
            &self.sorted_matter,
            &self.ledger,
            &self.bulk,
            &self.sorted_bulk,
            &self.eddies,
            &self.sorted_eddies,
            &self.wall_push,
            &self.density,
            &self.colour_keys,
            &self.colour_used,
            &self.colour_blocks,
            &self.colour_around,
            &self.colour,
            &self.colour_solid,
            &self.interface_stress,
            &self.smooth_colour,
            &self.curvature,
            &self.line_hold,
            &self.held,
            &self.bubbled,
            &self.gas,
            &self.boils,
            &self.sprayed,
            &self.falls,
            &self.colour_args,
            &self.counters,
            &self.cell_counts,
            &self.cell_starts,
            &self.block_counts,
            &self.list_args,
            &self.solution,
            &self.lamellae,
            &self.bubbles,
            &self.claims,
            &self.merging,
            &self.live,
            &self.live_args,
            &self.drops,
            &self.spray_left,
            &self.glass,
            &self.glass_taken,
            &self.wetted,
            &self.poses,
            &self.loads,
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
