// What bubbles do to particles, by identity, in whole quanta, as sums of integers do not depend on order:
// sixteen words a particle, [mass, enthalpy, gas, conductance], [largest bubble nearest to it, the same of the step before,
// gas times diameter times speed, the same of the step before], [acceleration by cavities, 0], and [the same of the step before, 0].

const BUBBLED_WORDS: u32 = 16u;
const BUBBLED_MASS: u32 = 0u;
const BUBBLED_ENTHALPY: u32 = 1u;
const BUBBLED_GAS: u32 = 2u;
const BUBBLED_CONDUCTANCE: u32 = 3u;
const BUBBLED_NEXT: u32 = 4u;
const BUBBLED_OWNER: u32 = 5u;
const BUBBLED_STIRRING: u32 = 6u;
const BUBBLED_LIFT: u32 = 8u;
/// Vectors of four words a particle, and which of them has the acceleration of the step before.
const BUBBLED_VECTORS: u32 = 4u;
const BUBBLED_LIFTED: u32 = 3u;

/// V0·ρ0; J per V0·ρ0; V0; V0·ρ0/(s K); V0 m²/s; m/s².
const MASS_QUANTUM: f32 = 1.0 / 2147483648.0;
const ENTHALPY_QUANTUM: f32 = 1.0 / 512.0;
const GAS_QUANTUM: f32 = 1.0 / 1048576.0;
const CONDUCTANCE_QUANTUM: f32 = 1.0 / 1048576.0;
const STIRRING_QUANTUM: f32 = 1.0 / 16777216.0;
const LIFT_QUANTUM: f32 = 1.0 / 4096.0;
/// Of bubbles that join others: these are whole bubbles.
const JOINED_MASS_QUANTUM: f32 = 1.0 / 16777216.0;
const JOINED_ENTHALPY_QUANTUM: f32 = 1.0 / 16.0;
/// Most quanta of one addition, of which a word holds 16.
const MOST_ADDED: f32 = 134217728.0;
/// Most steam that a particle takes at once, V0·ρ0: so much of it has no more quanta of mass or of enthalpy than that.
const MOST_AT_ONCE: f32 = 0.015;

fn quanta(amount: f32, quantum: f32) -> i32 {
    return i32(clamp(round(amount / quantum), -MOST_ADDED, MOST_ADDED));
}
