// Steam that a bubble takes of the particles around it and gives them, and its volume that they hold. For passes that have
// `bubble_surroundings.wgsl`.
//!include common/chemistry/bubble_surroundings.wgsl
//!include common/chemistry/quanta_sum.wgsl

/// Most steam that all bubbles around a particle exchange with it in a step, V0·ρ0, and over what its superheat makes. How many bubbles
/// there are is known of the step before; since then they may be more by what a radius grows and by those that were born, and a word of
/// quanta holds 100 times that.
const MOST_EXCHANGED: f32 = 0.01;
const MOST_OF_SUPERHEAT: f32 = 0.5;
/// Most gas that a bubble gives a particle, V0: many times what it can hold, and a word of quanta holds it of 256 bubbles.
const MOST_GIVEN: f32 = 8.0;

/// Greatest speed with which a bubble's radius grows, m/s: 1.5 mm in a step of 1/360 s. With a bound by d steam would depend on d. Chosen.
const MOST_GROWTH: f32 = 0.54;

/// T of what a bubble holds, °C: the few quanta of steam that a bubble of air may have would have none by themselves.
fn temperature_of(bubble: Bubble) -> f32 {
    if (bubble.mass <= 0.0) { return bubble.air_temperature; }
    let steam = steam_temperature(bubble.enthalpy / bubble.mass);
    return (bubble.mass * steam + bubble.air * bubble.air_temperature) / (bubble.mass + bubble.air);
}

/// What a bubble would exchange in a step if no other did: steam that it takes per kelvin of superheat, and that it
/// gives per kelvin of subcooling, V0·ρ0/(s K).
struct Conductance {
    taken: f32,
    given: f32,
    /// Whether it collapses altogether.
    vanishes: bool,
}

fn conductance_of(bubble: Bubble, s: Surrounding, around: Around, time: f32) -> Conductance {
    let density = steam_density(temperature_of(bubble));
    let relative = length(bubble.velocity - s.velocity);
    let unit = 4.0 / 3.0 * BUBBLE_PI * density / MASS;
    let cube = bubble.radius * bubble.radius * bubble.radius;
    var c: Conductance;
    if (s.superheat > 0.0) {
        let law = grown(bubble.radius, s.superheat, s.growing, relative, density, around, time);
        let r = min(law, bubble.radius + MOST_GROWTH * time);
        c.taken = unit * (r * r * r - cube) / (time * s.superheat);
    }
    if (s.subcooling > 0.0) {
        let r = collapsed(bubble.radius, s.subcooling, s.shrinking, relative, density, around, time);
        c.given = unit * (cube - r * r * r) / (time * s.subcooling);
        c.vanishes = r < VANISHED && s.subcooling > s.superheat;
        // Of a bubble of air the last steam condenses whole: its few quanta would have no temperature.
        if (bubble.air > 0.0) { c.vanishes = bubble.mass > 0.0 && c.given * time * s.subcooling >= bubble.mass; }
        if (c.vanishes) { c.given = bubble.mass / (time * s.subcooling); }
        // No more than there is.
        c.given = min(c.given, bubble.mass / (time * s.subcooling));
    }
    return c;
}

/// Steam and enthalpy that a bubble gained, over V0·ρ0 and J per V0·ρ0.
struct Gained {
    mass: f32,
    enthalpy: f32,
    /// Whether the driver ended this loop over the particles around, or one before it.
    is_cut: bool,
}

/// Exchanges steam with the particles around and gives them its volume; all lanes must ask.
fn scatter(bubble: Bubble, s: Surrounding, c: Conductance, reach: f32, cells: i32, lane: u32, time: f32) -> Gained {
    var mass: QuantaSum;
    var enthalpy: QuantaSum;
    let count = select(0u, count_around(cells), is_there(bubble) && s.weight > 0.0);
    let own_specific = bubble.enthalpy / max(bubble.mass, 1e-20);
    let stirring = 2.0 * bubble.radius * length(bubble.velocity - s.velocity);
    let held = (1.0 - bubble.cavity) * bubble_volume(bubble.radius);
    let gas_share = held / (VOLUME * max(s.weight, 1e-12));
    var n = lane;
    for (; n < count; n += LANES) {
        let run = cell_within(bubble.position, reach, cells, n);
        for (var j = run.first; j < run.end; j++) {
            let offset = position[j].xyz - bubble.position;
            let square = dot(offset, offset);
            let tag = tags[j];
            if (square >= reach * reach || tag.x != bubble.membership) { continue; }
            let weight = share_at(square / (reach * reach));
            let boil = boils[j];
            let share = contact_at(square, bubble.radius) / max(s.contact, 1e-12);
            let words = tag.y * BUBBLED_WORDS;
            let given = min(weight * gas_share, MOST_GIVEN);
            atomicAdd(&bubbled[words + BUBBLED_GAS], quanta(given, GAS_QUANTUM));
            atomicAdd(&bubbled[words + BUBBLED_STIRRING], quanta(given * stirring, STIRRING_QUANTUM));
            let conductance = share * select(c.given, c.taken, boil.x > 0.0);
            if (conductance <= 0.0) { continue; }
            atomicAdd(&bubbled[words + BUBBLED_CONDUCTANCE], quanta(conductance, CONDUCTANCE_QUANTUM));
            // All bubbles around a particle draw on what its superheat can make.
            let all = max(gas[tag.y].z, conductance);
            let rate = all / max(boil.y, 1e-12) * time;
            var limit = 1.0;
            if (rate > 1e-4) { limit = (1.0 - exp(-rate)) / rate; }
            let most = min(MOST_EXCHANGED, MOST_OF_SUPERHEAT * boil.y * abs(boil.x));
            limit = min(limit, most / max(all * abs(boil.x) * time, 1e-12));
            if (c.vanishes) { limit = 1.0; }
            let taken = conductance * boil.x * time * limit;
            // Steam comes with the boiling point that the liquid around the bubble has.
            let specific = select(own_specific, steam_enthalpy(heat[j].x - boil.x), boil.x > 0.0);
            let steam = quanta(taken, MASS_QUANTUM);
            let heat_of_steam = quanta(f32(steam) * MASS_QUANTUM * specific, ENTHALPY_QUANTUM);
            atomicSub(&bubbled[words + BUBBLED_MASS], steam);
            atomicSub(&bubbled[words + BUBBLED_ENTHALPY], heat_of_steam);
            mass = added(mass, steam);
            enthalpy = added(enthalpy, heat_of_steam);
        }
    }
    return Gained(lane_sum_of_quanta(mass, MASS_QUANTUM), lane_sum_of_quanta(enthalpy, ENTHALPY_QUANTUM), n < count);
}
