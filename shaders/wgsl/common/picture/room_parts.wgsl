//! Parts of the room, as bits: the picture's pipelines are specialised for those that the tiles of their class may see.

/// The top of the table.
const SEES_BENCH = 1u;
/// Walls, floor and ceiling, the bench along the back wall, and what the table stands on.
const SEES_WALLS = 2u;
/// Sink, tray and tap.
const SEES_FITTINGS = 4u;
/// What is at the wall: hood, shelf, signs and a poster.
const SEES_FURNITURE = 8u;

override SEES: u32 = 15u;

fn sees(part: u32) -> bool {
    return (SEES & part) != 0u;
}
