// Where `list_args` has the sizes of a rebuild's dispatches, as `solver/search.rs` reads them: over particles
// and cells, and of the list pass.
const PARTICLE_ARGS = 0u;
const CELL_ARGS = 4u;
const LIST_ARGS = 8u;
