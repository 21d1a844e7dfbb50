//! Keeps of the solver's drops what is drawn of them.

//!include common/chemistry/bubble_laws.wgsl
//!include common/chemistry/drops.wgsl
//!include common/picture/spray_drops.wgsl

struct FlightRun {
    /// Places of drops.
    count: u32,
    /// V0·ρ0, kg.
    mass: f32,
    /// Views that the flights are drawn in.
    views: u32,
}

var<immediate> run: FlightRun;

@group(0) @binding(0) var<storage, read> drops: array<Drops>;
@group(0) @binding(1) var<storage, read_write> flights: array<Flight>;
/// See `FLYING` of `common/picture/spray_drops.wgsl`; 0 before.
@group(0) @binding(2) var<storage, read_write> flying: array<atomic<u32>>;

fn list_flight(n: u32) {
    let place = atomicAdd(&flying[FLYING - 1u], 1u);
    atomicStore(&flying[FLYING + place], n);
    atomicMax(&flying[0], place * MOST_DROPS / FLIGHTS_GROUP + 1u);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let n = id.x;
    if (n == 0u) {
        atomicStore(&flying[1], run.views);
        atomicStore(&flying[2], 1u);
    }
    if (n >= run.count + RESTING) { return; }
    if (n >= run.count) {
        list_flight(n);
        return;
    }
    let from_ = drops[n];
    var flight = Flight(from_.position, from_.radius, vec3<f32>(0.0), 0u, from_.about, 0.0);
    if (from_.mass > 0.0 && from_.radius > 0.0 && from_.density > 0.0) {
        let number = from_.mass * run.mass / (from_.density * bubble_volume(from_.radius));
        flight.drops = u32(clamp(number + 0.5, 1.0, f32(MOST_DROPS)));
        flight.acid = from_.acid / from_.mass;
        let speed = length(from_.velocity);
        if (speed > 0.0) { flight.direction = from_.velocity / speed; }
    }
    flights[n] = flight;
    if (flight.drops > 0u) { list_flight(n); }
}
