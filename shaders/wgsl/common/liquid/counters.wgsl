// Events that are counted and reported. Integer sums do not depend on order.

struct Counters {
    /// Times the neighbour list was rebuilt.
    rebuilds: atomic<u32>,
    /// Particles with more neighbours than places in the list.
    list_overflows: atomic<u32>,
    /// Corrections cut so that a particle stays within its list's reach.
    list_limited: atomic<u32>,
    /// Speeds cut to the maximum.
    speed_limited: atomic<u32>,
    /// Particles that a flask constraint moved after the density solve, summed over substeps.
    flask_constraints: atomic<u32>,
    /// Particles taken out because they turned non-finite.
    removed: atomic<u32>,
    /// Particles of whose exchange by diffusion some was cut short.
    diffusion_limited: atomic<u32>,
    /// Particles that boil whose anti-viscosity was cut to GROWTH_LIMIT.
    growth_limited: atomic<u32>,
    /// Particles hotter or colder than their properties' tables go.
    table_ends: atomic<u32>,
    /// Times that surface tension was left out, its table being full.
    tension_skipped: atomic<u32>,
    /// Nuclei that found no place among the bubbles.
    bubbles_refused: atomic<u32>,
    /// Jets and films whose drops were not thrown: those of the one before still fly.
    spray_refused: atomic<u32>,
    /// Particles that a cloth took up.
    wiped: atomic<u32>,
    /// Bubbles and steps in which the driver ended a loop over what is around one.
    bubbles_cut: atomic<u32>,
}
