// The record `drops`: what one bubble threw up in one way, two records for each of the bubbles' places. And what drops do to
// particles, by identity, in whole quanta: four words a particle, [mass, acid, enthalpy, none].
//!include common/chemistry/slots.wgsl

struct Drops {
    /// Stage frame, m.
    position: vec3<f32>,
    /// Of all of them, over V0·ρ0; 0 where there are none.
    mass: f32,
    /// m/s.
    velocity: vec3<f32>,
    /// Acid in them, V0·ρ0.
    acid: f32,
    /// J per V0·ρ0.
    enthalpy: f32,
    /// Of one of them, m, and its density, kg/m³.
    radius: f32,
    density: f32,
    /// Membership of the liquid that they came from, and, from bit 16 on, of the flask in which they are.
    memberships: u32,
    /// What stayed on glass, table and floor since the start: mass, acid and enthalpy.
    fallen: vec3<f32>,
    /// How far about their place they lie, m; 0 of a jet's, which lie behind one another.
    about: f32,
}

/// Which of a bubble's two records: drops of its jet, and of its film.
const OF_JET: u32 = 0u;
const OF_FILM: u32 = 1u;

const SPRAYED_WORDS: u32 = 4u;
/// V0·ρ0; J per V0·ρ0; and of what left a flask, V0·ρ0.
const SPRAYED_QUANTUM: f32 = 1.0 / 16777216.0;
const SPRAYED_ENTHALPY_QUANTUM: f32 = 1.0 / 16.0;
const LEFT_QUANTUM: f32 = 1.0 / 65536.0;
/// Most quanta of the drops of a record.
const MOST_SPRAYED: f32 = 536870912.0;

fn quanta_of_drops(amount: f32, quantum: f32) -> i32 {
    return i32(clamp(round(amount / quantum), -MOST_SPRAYED, MOST_SPRAYED));
}
