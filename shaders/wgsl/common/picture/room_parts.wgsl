//! Parts of the room, as bits: the picture's pipelines are specialised for those that the tiles of their class may see.

/// The top of the table.
const SEES_BENCH = 1u;
/// Walls, floor and ceiling, the bench along the back wall, and what the table stands on.
const SEES_WALLS = 2u;
/// All else: sink, tray and tap; hood and shelf; signs and a poster.
const SEES_DETAILS = 4u;

override SEES: u32 = 7u;

fn sees(part: u32) -> bool {
    return (SEES & part) != 0u;
}
