//! Contents of particles at the start, in the layout of the physical chemistry's buffers.

use super::spec::Particle;
use crate::chemistry::ABSOLUTE_ZERO;
use crate::chemistry::table::{Row, SolutionTable};
use half::f16;

/// Unit of the specific heat capacity in a potential, J/(kg K), as in
/// `common/chemistry/heat.wgsl`.
const CAPACITY_UNIT: f64 = 4000.0;

/// A particle's part of the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Start {
    /// T (°C), c, (mass, specific heat capacity) as two f16, h of the liquid (J/kg).
    pub heat: [f32; 4],
    /// c, h (J/kg), y, mass over V0·ρ0.
    pub matter: [f32; 4],
    /// Volume over V0, ρ0 over density, vapour over V0·ρ0, rounding remainders of c and h.
    pub bulk: [f32; 4],
}

impl Start {
    /// A particle of volume V0 of its liquid; `rest_density` is ρ0, kg/m³.
    pub fn of(table: &SolutionTable, particle: &Particle, rest_density: f64) -> Self {
        let row: Row = table.at(particle.acid);
        let temperature = particle.temperature.max(ABSOLUTE_ZERO);
        let enthalpy = row.enthalpy_at(temperature) as f32;
        let mass = row.density_at(temperature) / rest_density;
        let capacity = row.capacity_at(temperature) / CAPACITY_UNIT;
        let [low, high] = [mass, capacity].map(|value| u32::from(f16::from_f64(value).to_bits()));
        Self {
            heat: [
                temperature as f32,
                row.acid as f32,
                f32::from_bits(low | high << 16),
                enthalpy,
            ],
            matter: [row.acid as f32, enthalpy, 0.0, mass as f32],
            bulk: [1.0, (1.0 / mass) as f32, 0.0, 0.0],
        }
    }
}
