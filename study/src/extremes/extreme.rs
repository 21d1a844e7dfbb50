//! The extremes, one by one.

use vitriol_sim::surface_tension::WATER;

use super::motion::{Broken, Motion};
use super::recipe::{Base, Crowd, Recipe};

/// One extreme property of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extreme {
    /// Factor of k_v.
    Intensity(f64),
    /// T_B, °C, where the liquid has 20 °C.
    BoilingPoint(f64),
    /// Temperatures of the lower and the upper liquid, °C.
    Temperature([f64; 2]),
    /// D_T as a multiple of the limit of an explicit step, 0.086 h²/Δt_s.
    Diffusion(f64),
    /// Factor of Δt_f.
    FrameTime(f64),
    /// Frame time, s.
    Frame(f64),
    Substeps(u32),
    Iterations(u32),
    /// ω, and whether by Chebyshev's iteration; else by Jacobi's.
    Relaxation(f64, bool),
    /// h/d.
    Support(f64),
    Viscosity(f64),
    /// σ over water's, and the glass's contact angle, degrees.
    Tension(f64, f64),
    /// Rate at which multipliers are carried on, 1/s.
    Carry(f64),
    Gravity(f64),
    Density(f64),
    /// v_max over that of the scene.
    MaxSpeed(f64),
    /// d over that of the scene, with all of the flask.
    Scale(f64),
    Particles(u32),
    Crowded(Crowd),
    /// Boundary particles in place of maps.
    Solids,
    /// Inner radius over d, and particles.
    Radius(f64, u32),
    Brim,
    UpsideDown,
    Moved(Motion),
    /// Origin of the whole scene, m.
    Far([f64; 3]),
    /// Distance of all of its places from its origin, m.
    Strayed([f64; 3]),
}

use Extreme as E;

impl Extreme {
    /// Its kind; two of a kind are not paired.
    pub fn kind(&self) -> &'static str {
        match self {
            E::Intensity(_) => "boiling intensity",
            E::BoilingPoint(_) => "boiling point near ambient",
            E::Temperature(_) => "temperature",
            E::Diffusion(_) => "diffusion",
            E::FrameTime(_) => "time step",
            E::Frame(_) => "frame time of seconds",
            E::Substeps(_) => "substeps",
            E::Iterations(_) => "iterations",
            E::Relaxation(..) => "relaxation",
            E::Support(_) => "h/d",
            E::Viscosity(_) => "viscosity",
            E::Tension(..) => "surface tension",
            E::Carry(_) => "carried multipliers",
            E::Gravity(_) => "gravity",
            E::Density(_) => "rest density",
            E::MaxSpeed(_) => "v_max",
            E::Scale(_) => "size of the world",
            E::Particles(_) => "few particles",
            E::Crowded(_) => "particles in one place",
            E::Solids => "boundary particles",
            E::Radius(..) => "flask's width",
            E::Brim => "brim-full",
            E::UpsideDown => "upside down",
            E::Moved(Motion::Shaken { .. }) => "shaken",
            E::Moved(Motion::Teleported(_)) => "teleported",
            E::Moved(Motion::Spun { .. }) => "spun",
            E::Moved(Motion::Stalled(_)) => "stalled",
            E::Moved(_) => "no pose",
            E::Far(_) => "10 km off",
            E::Strayed(_) => "10 km from its own origin",
        }
    }

    /// Whether both cannot be in one case: all motions are of one hand.
    pub fn excludes(&self, other: &Self) -> bool {
        let motion = |e: &Self| matches!(e, E::Moved(_) | E::UpsideDown);
        let filled =
            |e: &Self| matches!(e, E::Particles(_) | E::Radius(..) | E::Brim | E::Crowded(_));
        let time = |e: &Self| matches!(e, E::FrameTime(_) | E::Frame(_));
        self.kind() == other.kind()
            || [motion as fn(&Self) -> bool, filled, time]
                .iter()
                .any(|is| is(self) && is(other))
    }

    /// Whether it changes anything in `base`.
    pub fn applies_to(&self, base: Base) -> bool {
        match self {
            E::BoilingPoint(_) => base == Base::Paper,
            E::Intensity(_) | E::Diffusion(_) | E::Temperature(_) => base != Base::Water,
            E::Tension(..) => base != Base::Paper,
            _ => true,
        }
    }

    /// Applies it to the scene.
    pub fn apply(&self, r: &mut Recipe) {
        match *self {
            E::Intensity(times) => {
                r.k_v *= times;
                // It needs something that boils.
                r.temperatures[0] = r.temperatures[0].max(120.0);
            }
            E::BoilingPoint(point) => r.boiling_point = point,
            E::Temperature(temperatures) => r.temperatures = temperatures,
            E::Diffusion(times) => {
                let limit = 0.086 * r.support().powi(2) / r.substep();
                r.diffusion = match r.base {
                    Base::Paper => times * limit / 0.01,
                    // Eddies of 1 m/s: D = C_t·h·|v|.
                    _ => times * limit / (0.041 * r.support()),
                };
            }
            E::FrameTime(times) => r.frame_time *= times,
            E::Frame(seconds) => r.frame_time = seconds,
            E::Substeps(count) => r.substeps = count,
            E::Iterations(count) => r.iterations = count,
            E::Relaxation(omega, chebyshev) => (r.omega, r.chebyshev) = (omega, chebyshev),
            E::Support(ratio) => r.support_ratio = ratio,
            E::Viscosity(mu) => r.viscosity = mu,
            E::Tension(times, angle) => r.tension = Some([times * WATER, angle]),
            E::Carry(rate) => r.carry_rate = rate,
            E::Gravity(gravity) => r.gravity = gravity,
            E::Density(density) => r.rest_density = density,
            E::MaxSpeed(times) => r.v_max *= times,
            E::Scale(times) => r.spacing *= times,
            E::Particles(count) => r.particles = Some(count),
            E::Crowded(crowd) => r.crowd = crowd,
            E::Solids => r.boundary_particles = true,
            E::Radius(radius, count) => (r.radius, r.particles) = (radius, Some(count)),
            E::Brim => r.particles = None,
            E::UpsideDown => r.upside_down = true,
            E::Moved(motion) => r.motion = motion,
            E::Far(place) => r.origin = place,
            E::Strayed(place) => r.place = place,
        }
    }

    /// The extreme in words, for reports.
    pub fn label(&self) -> String {
        match *self {
            E::Intensity(times) => format!("k_v × {times:.3}"),
            E::BoilingPoint(point) => format!("T_B = {point:.3} °C"),
            E::Temperature([lower, upper]) => format!("{lower:.0} °C under {upper:.0} °C"),
            E::Diffusion(times) => format!("D = {times:.3} × the explicit limit"),
            E::FrameTime(times) => format!("Δt × {times:.3}"),
            E::Frame(seconds) => format!("Δt_f = {seconds:.3} s"),
            E::Substeps(count) => format!("{count} substeps"),
            E::Iterations(count) => format!("{count} iterations"),
            E::Relaxation(omega, chebyshev) => {
                let kind = if chebyshev { "Chebyshev" } else { "Jacobi" };
                format!("{kind}, ω = {omega:.3}")
            }
            E::Support(ratio) => format!("h/d = {ratio:.2}"),
            E::Viscosity(mu) => format!("viscosity {mu:.3}"),
            E::Tension(times, angle) => {
                format!("σ × {times:.3} and a contact angle of {angle:.0}°")
            }
            E::Carry(rate) => format!("carried at {rate:.2} 1/s"),
            E::Gravity(gravity) => format!("g = {gravity:.2} m/s²"),
            E::Density(density) => format!("ρ₀ = {density:.1} kg/m³"),
            E::MaxSpeed(times) => format!("v_max × {times:.3}"),
            E::Scale(times) => format!("d × {times:.4}"),
            E::Particles(count) => format!("{count} particles"),
            E::Crowded(Crowd::Filled) => "as filled".into(),
            E::Crowded(Crowd::OnePlace(share)) => {
                format!("{:.0} % of the particles in one place", 100.0 * share)
            }
            E::Crowded(Crowd::Ball(radius)) => format!("all within {radius:.2} h"),
            E::Solids => "boundary particles".into(),
            E::Radius(radius, count) => {
                format!("{count} particles in a glass {radius:.1} d in radius")
            }
            E::Brim => "brim-full".into(),
            E::UpsideDown => "upside down".into(),
            E::Moved(motion) => label_of(motion),
            E::Far([x, y, z]) => format!("{x:.0}, {y:.0}, {z:.0} m off"),
            E::Strayed([x, y, z]) => format!("{x:.0}, {y:.0}, {z:.0} m from its own origin"),
        }
    }
}

fn label_of(motion: Motion) -> String {
    match motion {
        Motion::Still => "still".into(),
        Motion::Shaken { speed, vertical } => {
            let way = if vertical {
                "up and down"
            } else {
                "to and fro"
            };
            format!("shaken {way} at {speed:.1} m/s")
        }
        Motion::Teleported([x, y, z]) => format!("teleported by {x:.1}, {y:.1}, {z:.1} m"),
        Motion::Spun { rate, across } => {
            let axis = if across { "across" } else { "about" };
            format!("spun {axis} its axis at {rate:.0} rad/s")
        }
        Motion::Stalled(seconds) => format!("a stall of {seconds:.1} s"),
        Motion::NoPose(broken) => format!("pose broken: {broken:?}").to_lowercase(),
    }
}

/// Extremes that are tried one by one in every base that they apply to.
pub fn directed() -> Vec<Extreme> {
    let shaken = |speed, vertical| E::Moved(Motion::Shaken { speed, vertical });
    let spun = |rate, across| E::Moved(Motion::Spun { rate, across });
    let mut all = vec![
        E::Solids,
        E::Brim,
        E::UpsideDown,
        E::Frame(5.0),
        E::Radius(30.0, 1500),
    ];
    all.extend([0.0, 0.1, 10.0, 100.0].map(E::Intensity));
    all.extend([20.001, 20.1, 21.0, 1e6].map(E::BoilingPoint));
    let temperatures = [
        [-20.0, -20.0],
        [-20.0, 1e6],
        [1e6, -20.0],
        [1e6, 1e6],
        [300.0, 300.0],
        [1e4, 20.0],
        [20.0, 99.9],
    ];
    all.extend(temperatures.map(E::Temperature));
    all.extend([0.0, 0.5, 1.0, 10.0, 100.0].map(E::Diffusion));
    all.extend([0.1, 0.3, 2.0, 3.0, 10.0].map(E::FrameTime));
    all.extend([1, 2, 4, 16].map(E::Substeps));
    all.extend([1, 2, 8, 16].map(E::Iterations));
    for omega in [0.05, 0.2, 0.5, 0.7, 1.0] {
        all.extend([E::Relaxation(omega, false), E::Relaxation(omega, true)]);
    }
    all.extend([1.2, 1.5, 2.5, 3.0].map(E::Support));
    all.extend([0.0, 0.5, 1.0, 3.0, 10.0].map(E::Viscosity));
    all.extend([0.01, 3.0, 10.0].map(|times| E::Tension(times, 30.0)));
    all.extend([0.0, 90.0, 180.0].map(|angle| E::Tension(1.0, angle)));
    all.extend([0.0, 20.0, 90.0, 900.0].map(E::Carry));
    all.extend([0.0, 1.6, 100.0].map(E::Gravity));
    all.extend([1.0, 13_600.0].map(E::Density));
    all.extend([0.1, 10.0, 1e4].map(E::MaxSpeed));
    all.extend([0.01, 0.1, 10.0].map(E::Scale));
    all.extend([0, 1, 2, 3].map(E::Particles));
    all.extend(
        [
            Crowd::OnePlace(0.01),
            Crowd::OnePlace(0.1),
            Crowd::OnePlace(1.0),
        ]
        .map(E::Crowded),
    );
    all.extend([Crowd::Ball(0.1), Crowd::Ball(1.0)].map(E::Crowded));
    all.extend([(1.0, 20), (1.5, 40)].map(|(radius, count)| E::Radius(radius, count)));
    all.extend([(5.0, false), (50.0, false), (5.0, true), (50.0, true)].map(|(s, v)| shaken(s, v)));
    all.extend([(10.0, false), (100.0, false), (100.0, true)].map(|(r, a)| spun(r, a)));
    let places = [[10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [-6.0, 5.0, 6.0]];
    all.extend(places.map(|to| E::Moved(Motion::Teleported(to))));
    all.extend([0.5, 5.0].map(|s| E::Moved(Motion::Stalled(s))));
    let broken = [
        Broken::Position,
        Broken::Orientation,
        Broken::Infinite,
        Broken::Null,
        Broken::Squeeze,
    ];
    all.extend(broken.map(|b| E::Moved(Motion::NoPose(b))));
    let far = [[1e4, 0.0, 0.0], [0.0, -1e4, 0.0], [-1e4, 1e4, 1e4]];
    all.extend(far.map(E::Far));
    all.extend([[1e4, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, -3.0]].map(E::Strayed));
    all
}

/// An extreme of any kind at a random level; `draw` gives numbers in [0, 1).
pub fn random(draw: &mut impl FnMut() -> f64) -> Extreme {
    let pick = |share: f64, count: usize| ((share * count as f64) as usize).min(count - 1);
    let between = |share: f64, low: f64, high: f64| low + share * (high - low);
    let log = |share: f64, low: f64, high: f64| low * (high / low).powf(share);
    // Each kind is as likely as any other, however many levels it has.
    let all = directed();
    let mut kinds: Vec<&str> = all.iter().map(Extreme::kind).collect();
    kinds.dedup();
    let kind = kinds[pick(draw(), kinds.len())];
    let of_kind: Vec<&Extreme> = all.iter().filter(|e| e.kind() == kind).collect();
    let chosen = *of_kind[pick(draw(), of_kind.len())];
    let s = draw();
    match chosen {
        E::Intensity(_) => E::Intensity(log(s, 0.1, 100.0)),
        E::BoilingPoint(_) => E::BoilingPoint(20.0 + log(s, 1e-3, 10.0)),
        E::Temperature(_) => {
            let level = |s: f64| if s < 0.1 { -20.0 } else { log(s, 1.0, 1e6) };
            E::Temperature([level(s), level(draw())])
        }
        E::Diffusion(_) => E::Diffusion(log(s, 0.1, 100.0)),
        E::FrameTime(_) => E::FrameTime(log(s, 0.1, 10.0)),
        E::Frame(_) => E::Frame(log(s, 0.1, 10.0)),
        E::Substeps(_) => E::Substeps(1 + pick(s, 16) as u32),
        E::Iterations(_) => E::Iterations(1 + pick(s, 16) as u32),
        E::Relaxation(_, chebyshev) => E::Relaxation(between(s, 0.05, 1.0), chebyshev),
        E::Support(_) => E::Support(between(s, 1.2, 3.0)),
        E::Viscosity(_) => E::Viscosity(if s < 0.8 { s / 0.8 } else { 10.0 * s }),
        E::Tension(..) => E::Tension(log(s, 0.01, 10.0), 180.0 * draw()),
        E::Carry(_) => E::Carry(log(s, 0.9, 900.0)),
        E::Gravity(_) => E::Gravity(log(s, 0.1, 100.0)),
        E::Density(_) => E::Density(log(s, 1.0, 2e4)),
        E::MaxSpeed(_) => E::MaxSpeed(log(s, 0.1, 1e4)),
        E::Scale(_) => E::Scale(log(s, 0.01, 10.0)),
        E::Particles(_) => E::Particles(1 + pick(s, 10) as u32),
        E::Crowded(Crowd::OnePlace(_)) => E::Crowded(Crowd::OnePlace(log(s, 0.005, 1.0))),
        E::Crowded(_) => E::Crowded(Crowd::Ball(log(s, 0.01, 2.0))),
        E::Radius(..) => {
            let radius = log(s, 1.0, 20.0);
            E::Radius(radius, (10.0 * radius * radius) as u32)
        }
        E::Moved(Motion::Shaken { vertical, .. }) => E::Moved(Motion::Shaken {
            speed: log(s, 1.0, 50.0),
            vertical,
        }),
        E::Moved(Motion::Spun { across, .. }) => E::Moved(Motion::Spun {
            rate: log(s, 5.0, 100.0),
            across,
        }),
        E::Moved(Motion::Teleported(_)) => {
            let [x, y, z] = [s, draw(), draw()].map(|s| between(s, -1.0, 1.0));
            let length = (x * x + y * y + z * z).sqrt().max(0.1);
            // Not into the ground.
            E::Moved(Motion::Teleported(
                [x, y.abs(), z].map(|c| 10.0 * c / length),
            ))
        }
        E::Moved(Motion::Stalled(_)) => E::Moved(Motion::Stalled(log(s, 0.1, 5.0))),
        E::Far(_) => E::Far([s, draw(), draw()].map(|s| between(s, -1e4, 1e4).round())),
        E::Strayed(_) => E::Strayed([s, draw(), draw()].map(|s| between(s, -30.0, 30.0))),
        same => same,
    }
}
