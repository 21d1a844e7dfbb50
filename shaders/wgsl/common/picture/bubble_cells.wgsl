// Cells in which rays look for bubbles: a grid over all of the stage, folded into a table. A bubble is in each cell that it
// reaches into, and cells that share a place of the table share its bubbles, which a ray then meets or does not. The side of a
// cell is given by the host (`BubbleRun`, `Frame`), so that who fills the cells and who looks into them have the same.

/// Places of the table; behind them is how many entries there are.
const BUBBLE_CELLS = 32768u;

/// A bubble in a cell.
struct BubbleEntry {
    /// In the stage, in the scene's unit.
    centre: vec3<f32>,
    radius: f32,
    /// The next entry of the cell's place, and one more; 0 for none.
    next: u32,
}

/// The table's place of a cell.
fn place_of_cell(cell: vec3<i32>) -> u32 {
    let parts = bitcast<vec3<u32>>(cell) * vec3<u32>(73856093u, 19349663u, 83492791u);
    return (parts.x ^ parts.y ^ parts.z) % BUBBLE_CELLS;
}
