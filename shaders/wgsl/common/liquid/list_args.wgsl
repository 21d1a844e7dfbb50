// Where `list_args` has the sizes of a rebuild's dispatches, as `solver/search.rs` reads them: over particles
// and cells, of the list pass, and of one workgroup.
const PARTICLE_ARGS = 0u;
const CELL_ARGS = 4u;
const LIST_ARGS = 8u;
const BLOCK_ARGS = 12u;
