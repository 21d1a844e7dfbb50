//! Per-particle state of a scene's chemistry, and its part of a substep.

use super::dilution::{self, Pairs, Weight};
use super::surroundings::WallSum;
use super::wall_heat::{GlassTouch, ReferenceRings};
use crate::chemistry::eddies::SCHMIDT;
use crate::chemistry::evaporation::{StillAir, evaporated};
use crate::chemistry::paper::{AntiViscosity, Boiling, Diffusion, Dilution};
use crate::chemistry::physical::{Content, Steam};
use crate::chemistry::segregation::{MIXED, decay_rate};
use crate::chemistry::table::SolutionTable;
use crate::chemistry::transport::{
    Diffusivities, Flux, Potential, flux, heat_from, kept, turnover,
};
use crate::chemistry::{OutOfRange, Physical as Law, check_content};
use crate::parameters::{Parameters, XSPH_MOMENT};

/// Properties of each particle that line 27 reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficients {
    /// μ_i ≥ 0 of one substep: how fast relative velocities go.
    pub viscosity: Vec<f64>,
    /// α_i ≥ 0 of one substep: how fast they grow.
    pub growth: Vec<f64>,
    /// m_i, kg.
    pub masses: Vec<f64>,
}

/// The chemistry of a reference solver: the paper's or the physical one.
#[derive(Clone, Debug)]
pub enum ReferenceChemistry {
    /// Sections 4.1 to 4.3.
    Paper(ReferencePaper),
    /// The physical chemistry: what section 8 names as missing.
    Physical(Box<ReferencePhysical>),
}

impl ReferenceChemistry {
    /// T (°C) and acid mass fraction of particle `i`'s liquid.
    pub(super) fn state(&self, i: usize) -> (f64, f64) {
        match self {
            Self::Paper(paper) => (paper.temperatures[i], paper.acid[i]),
            Self::Physical(physical) => {
                let content = &physical.contents[i];
                (content.temperature(&physical.table), content.liquid_acid())
            }
        }
    }

    /// Leaves out the particles that are not to `keep`.
    pub(super) fn retain(&mut self, keep: &[bool]) {
        match self {
            Self::Paper(paper) => {
                retain(&mut paper.temperatures, keep);
                retain(&mut paper.acid, keep);
                retain(&mut paper.agitation, keep);
            }
            Self::Physical(physical) => {
                retain(&mut physical.contents, keep);
                retain(&mut physical.viscosities, keep);
                retain(&mut physical.eddies, keep);
            }
        }
    }
}

/// Diffusion and heat of solution of the paper's chemistry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DilutionLaw {
    /// Eqs 6 to 13.
    pub heat: Dilution,
    /// D_T, m²/s.
    pub temperature_diffusivity: f64,
    /// D_c, m²/s.
    pub acid_diffusivity: f64,
    /// T_a of all that is solid, °C.
    pub ambient: f64,
    /// How Eq. 5 weights a pair.
    pub scheme: Diffusion,
}

/// The paper's chemistry.
#[derive(Clone, Debug)]
pub struct ReferencePaper {
    /// Line 26, if it is modelled.
    pub dilution: Option<DilutionLaw>,
    /// Line 27, if it is modelled.
    pub boiling: Option<(AntiViscosity, Boiling)>,
    /// T_i, °C.
    pub temperatures: Vec<f64>,
    /// c_i, mass fraction.
    pub acid: Vec<f64>,
    /// e_i of the substep before, J/kg.
    pub agitation: Vec<f64>,
}

impl ReferencePaper {
    /// Particles of `(temperature in °C, acid fraction)`, at rest.
    ///
    /// # Errors
    /// [`OutOfRange`] for a composition or temperature that no liquid has.
    pub fn new(
        dilution: Option<DilutionLaw>,
        boiling: Option<(AntiViscosity, Boiling)>,
        particles: &[(f64, f64)],
    ) -> Result<Self, OutOfRange> {
        for &(temperature, acid) in particles {
            check_content(acid, temperature)?;
        }
        Ok(Self {
            dilution,
            boiling,
            temperatures: particles.iter().map(|particle| particle.0).collect(),
            acid: particles.iter().map(|particle| particle.1).collect(),
            agitation: vec![0.0; particles.len()],
        })
    }

    /// Line 26. `densities` are ρ/ρ₀ at the committed positions, for the
    /// literal scheme.
    pub fn dilute(&mut self, pairs: &Pairs, walls: &[WallSum], densities: &[f64]) {
        let Some(law) = &self.dilution else { return };
        let of_acid = Weight::of(law.scheme, law.acid_diffusivity, densities);
        let of_heat = Weight::of(law.scheme, law.temperature_diffusivity, densities);
        let acid = dilution::diffuse(pairs, &of_acid, &self.acid);
        self.temperatures = dilution::diffuse(pairs, &of_heat, &self.temperatures);
        // Solids keep their temperature (section 6).
        for (temperature, wall) in self.temperatures.iter_mut().zip(walls) {
            let diffusivity = law.temperature_diffusivity;
            let share = pairs.exchange.wall_share(diffusivity, wall.volume);
            *temperature += share * (law.ambient - *temperature);
        }
        let warming = dilution::heat_of_solution(pairs, &of_acid, &law.heat, &self.acid, &acid);
        for (temperature, warming) in self.temperatures.iter_mut().zip(warming) {
            *temperature += warming;
        }
        self.acid = acid;
    }

    /// μ_i and α_i of line 27.
    ///
    /// Eq. 17 as printed is a coefficient per substep, and so is its μ₀.
    pub fn coefficients(&self, parameters: &Parameters) -> Coefficients {
        let time = parameters.substep_time();
        let usual = parameters.substep_viscosity();
        let of = |(&temperature, &agitation): (&f64, &f64)| match &self.boiling {
            None => (usual, 0.0),
            Some((law, Boiling::Literal)) => {
                let mu = law.literal(temperature, parameters.viscosity);
                (mu.max(0.0), (-mu).max(0.0))
            }
            Some((law, Boiling::Power)) if law.boils(temperature) => {
                (0.0, law.growth(temperature, agitation, time))
            }
            Some((_, Boiling::Power)) => (usual, 0.0),
        };
        let particles = self.temperatures.iter().zip(&self.agitation);
        let (viscosity, growth) = particles.map(of).unzip();
        Coefficients {
            viscosity,
            growth,
            masses: vec![parameters.particle_mass(); self.temperatures.len()],
        }
    }
}

/// Balance of enthalpy (J) and mass (kg) since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReferenceLedger {
    /// Enthalpy taken up from around the liquid.
    pub exchanged: f64,
    /// Steam that has left, and its enthalpy.
    pub steam: Steam,
}

/// The physical chemistry.
#[derive(Clone, Debug)]
pub struct ReferencePhysical {
    /// Its constants.
    pub law: Law,
    /// Properties of the liquid.
    pub table: SolutionTable,
    /// Content of each particle.
    pub contents: Vec<Content>,
    /// ν at the substep's start, m²/s; 0 where it does not follow composition.
    pub viscosities: Vec<f64>,
    /// K of the eddies that the flow of the frame before leaves unresolved, m²/s.
    pub eddies: Vec<f64>,
    /// Balance since the start.
    pub ledger: ReferenceLedger,
    /// The flasks' glass, from the first substep on, where heat is lost to it.
    pub glass: Option<ReferenceRings>,
}

impl ReferencePhysical {
    /// Particles of volume `volume` (m³) and `(temperature in °C, acid
    /// fraction)`, at rest.
    ///
    /// # Errors
    /// [`OutOfRange`] for a composition or temperature that no liquid has.
    pub fn new(law: Law, volume: f64, particles: &[(f64, f64)]) -> Result<Self, OutOfRange> {
        let table = SolutionTable::fed_by(law.feed);
        let content = |&(temperature, acid): &(f64, f64)| {
            let mass = volume * table.at(acid).density_at(temperature);
            Content::liquid(&table, mass, acid, temperature)
        };
        let contents = particles
            .iter()
            .map(content)
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Self {
            law,
            viscosities: vec![0.0; contents.len()],
            eddies: vec![0.0; contents.len()],
            contents,
            table,
            ledger: ReferenceLedger::default(),
            glass: None,
        })
    }

    /// Line 26: acid and enthalpy between particles, heat to the surroundings, boiling.
    pub fn dilute(&mut self, pairs: &Pairs, parameters: &Parameters, touches: &[GlassTouch]) {
        let time = parameters.substep_time();
        let potentials: Vec<_> = self
            .contents
            .iter()
            .map(|content| Potential::of(&self.table, content))
            .collect();
        let between =
            |i: usize, j: usize| Diffusivities::with(0.5 * (self.eddies[i] + self.eddies[j]));
        let turnovers: Vec<f64> = pairs.sums(|i, j| {
            let distance = pairs.distance(i, j);
            let (own, other) = (&potentials[i], &potentials[j]);
            turnover(pairs.exchange, &between(i, j), distance, own, other)
        });
        let fluxes = pairs.sums(|i, j| {
            let distance = pairs.distance(i, j);
            let (own, other) = (&potentials[i], &potentials[j]);
            let kept = kept(turnovers[i], turnovers[j]);
            flux(pairs.exchange, &between(i, j), distance, own, other, kept)
        });
        let evaporates = self
            .law
            .losses
            .filter(|_| self.law.superheat_time.is_some());
        let air = evaporates.map(|losses| StillAir::at(&self.table, losses.ambient));
        for (i, flux) in fluxes.into_iter().enumerate() {
            let Flux { acid, enthalpy, .. } = flux;
            let gained = self.heat_from_around(&potentials[i], &touches[i], time);
            self.ledger.exchanged += gained;
            self.segregate(i, &potentials[i], &flux, time);
            let content = &mut self.contents[i];
            content.acid += acid / content.mass;
            content.enthalpy += (enthalpy + gained) / content.mass;
            if let Some(air) = &air {
                let gone = evaporated(&self.table, air, &potentials[i], touches[i].surface, time);
                content.take_out_water(&self.table, &gone);
                self.ledger.steam.mass += gone.mass;
                self.ledger.steam.enthalpy += gone.enthalpy;
            }
            if let Some(settling) = self.law.superheat_time {
                content.boil(&self.table, time, settling);
            }
            if self.law.viscosity {
                let row = self.table.at(potentials[i].acid);
                let temperature = potentials[i].temperature;
                self.viscosities[i] = row.viscosity_at(temperature) / row.density_at(temperature);
            }
        }
    }

    /// Line 26: liquid that eddies bring arrives unmixed, and eddies and molecules mix it.
    fn segregate(&mut self, i: usize, own: &Potential, flux: &Flux, time: f64) {
        let Some(lamella) = self.law.lamella else {
            return;
        };
        let row = self.table.at(own.acid);
        let dissipation = self.law.mixing.dissipation(self.eddies[i]);
        let rate = decay_rate(&row, own.temperature, dissipation, lamella);
        let brought = flux.variance / own.mass - (flux.acid / own.mass).powi(2);
        let variance = (own.variance + brought).clamp(0.0, own.acid * (1.0 - own.acid));
        let left = variance * (-rate * time).exp();
        self.contents[i].variance = if left > MIXED { left } else { 0.0 };
    }

    /// Heat that a particle takes through glass and surface in `time` seconds, J.
    fn heat_from_around(&mut self, own: &Potential, touch: &GlassTouch, time: f64) -> f64 {
        let Some(losses) = self.law.losses else {
            return 0.0;
        };
        let through_air = |transfer: f64| heat_from(own, losses.ambient, transfer, time);
        let of_glass = match (touch.ring, &mut self.glass) {
            (Some(ring), Some(glass)) => {
                let (temperature, transfer) = glass.ring(ring);
                let gained = heat_from(own, temperature, transfer * touch.glass, time);
                glass.taken[ring.0][ring.1] -= gained;
                gained
            }
            _ => through_air(losses.glass * touch.glass),
        };
        of_glass + through_air(losses.surface * touch.surface)
    }

    /// V_i, m³, and ρ₀/ρ_i of the liquid; V₀ and 1 where density does not
    /// follow composition.
    pub fn bulk_of(&self, parameters: &Parameters) -> (Vec<f64>, Vec<f64>) {
        let of = |content: &Content| {
            if !self.law.density {
                return (parameters.particle_volume(), 1.0);
            }
            let volume = content.liquid_volume(&self.table);
            (
                volume,
                parameters.rest_density * volume / content.liquid_mass(),
            )
        };
        self.contents.iter().map(of).unzip()
    }

    /// μ_i of line 27: the scene's viscosity and the liquid's one after the other. Nothing grows.
    pub fn coefficients(&self, parameters: &Parameters) -> Coefficients {
        let usual = parameters.substep_viscosity();
        let per_area =
            parameters.substep_time() / (XSPH_MOMENT * parameters.support_radius.powi(2));
        let viscosity = self.viscosities.iter().zip(&self.eddies);
        let viscosity = viscosity.map(|(nu, eddies)| {
            let nu = nu + SCHMIDT * eddies;
            1.0 - (1.0 - usual) * (-nu * per_area).exp()
        });
        Coefficients {
            viscosity: viscosity.collect(),
            growth: vec![0.0; self.contents.len()],
            masses: self.contents.iter().map(|content| content.mass).collect(),
        }
    }
}

/// Removes the `values` of particles that are not to `keep`.
pub(super) fn retain<T>(values: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    values.retain(|_| keep.next().copied().unwrap_or(true));
}
