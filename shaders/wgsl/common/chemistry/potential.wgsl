// The potentials of a particle by what it holds: `chemistry/table.rs` in f32.
//!include common/chemistry/heat.wgsl
//!include common/chemistry/matter.wgsl
//!include common/chemistry/segregation.wgsl
//!include common/chemistry/solution.wgsl

fn potential_of(content: Content, variance: f32) -> Potential {
    let row = row_of_lamellae(liquid_acid(content.acid, content.vapour), variance);
    let temperature = temperature_with_steam(row, content.enthalpy, content.vapour);
    let steam = content.vapour * steam_enthalpy(temperature);
    return Potential(
        temperature, row.acid, content.mass * (1.0 - content.vapour), capacity_at(row, temperature),
        (content.enthalpy - steam) / (1.0 - content.vapour));
}
