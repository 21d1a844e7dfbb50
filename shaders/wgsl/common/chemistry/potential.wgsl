// The potentials of a particle by what it holds: `chemistry/table.rs` in f32.
//!include common/chemistry/heat.wgsl
//!include common/chemistry/matter.wgsl
//!include common/chemistry/solution.wgsl

fn potential_of(content: Content) -> Potential {
    let row = row_at(liquid_acid(content.acid, content.vapour));
    let temperature = temperature_with_steam(row, content.enthalpy, content.vapour);
    let liquid = content.mass * (1.0 - content.vapour);
    let capacities = vec2<f32>(liquid, liquid * capacity_at(row, temperature));
    return Potential(temperature, row.acid, capacities, slope_at(row, temperature));
}
