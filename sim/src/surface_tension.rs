//! Surface tension and wetting after Akinci et al. 2013 (line 28): the two
//! kernels, and the strengths that make a stated tension of them. Both solvers
//! take them from here.

use std::f64::consts::PI;

/// ∫₀¹ q⁴·c(q) dq = 21/28160 for the cohesion kernel C = 32/(πh³)·c(r/h).
const COHESION_MOMENT: f64 = 21.0 / 28160.0;

/// ∫₀¹ q⁴·a(q) dq for the adhesion kernel A = 0.007/h³·a(r/h), by quadrature.
const ADHESION_MOMENT: f64 = 0.116_585;

/// Intervals of [`HalfSpacePull`]'s table over the support radius.
pub const PULL_SAMPLES: usize = 64;

/// C(r) of Akinci et al. 2013, Eq. 2, 1/m³: attracts beyond h/2, repels
/// nearby.
pub fn cohesion_kernel(r: f64, support: f64) -> f64 {
    let scale = 32.0 / (PI * support.powi(3));
    let q = r / support;
    let shape = ((1.0 - q) * q).powi(3);
    if q >= 1.0 {
        0.0
    } else if q > 0.5 {
        scale * shape
    } else {
        scale * (2.0 * shape - 1.0 / 64.0)
    }
}

/// A(r) of Akinci et al. 2013, Eq. 7, 1/m³: attracts between h/2 and h.
pub fn adhesion_kernel(r: f64, support: f64) -> f64 {
    let q = r / support;
    if (0.5..1.0).contains(&q) {
        0.007 / support.powi(3) * (q * (6.0 - 4.0 * q) - 2.0).max(0.0).powf(0.25)
    } else {
        0.0
    }
}

/// γ of Akinci et al. 2013 for a surface tension (N/m), m⁴/(kg·s²).
///
/// A liquid of number density n whose particles attract by f(r) has the
/// surface tension (π/8)·n²·∫ r⁴ f dr (Fowler 1937, with particles spread
/// evenly); with f = γm²C and nm = ρ₀ this is γ.
pub fn cohesion_strength(tension: f64, rest_density: f64, support: f64) -> f64 {
    tension / (4.0 * COHESION_MOMENT * (rest_density * support).powi(2))
}

/// β of Akinci et al. 2013, likewise: glass with as much adhesion as the
/// liquid has surface tension attracts the liquid as it attracts itself.
pub fn adhesion_strength(tension: f64, rest_density: f64, support: f64) -> f64 {
    8.0 * tension / (PI * 0.007 * ADHESION_MOMENT * (rest_density * support).powi(2))
}

/// G(s) = ∫ A(r)·cos dV over a half space at distance s: what a flat wall of
/// solid particles would attract with, since a volume map has none.
#[derive(Clone, Debug)]
pub struct HalfSpacePull {
    support: f64,
    samples: Vec<f64>,
}

impl HalfSpacePull {
    /// Table for support radius `support`, metres.
    pub fn new(support: f64) -> Self {
        // The part of the sphere of radius r beyond the plane has
        // ∫ cos dΩ = π(1 − s²/r²).
        let value = |s: f64| {
            let steps = 2000;
            let dr = 0.5 * support / f64::from(steps);
            (0..steps)
                .map(|i| 0.5 * support + (f64::from(i) + 0.5) * dr)
                .filter(|&r| r > s)
                .map(|r| PI * adhesion_kernel(r, support) * (r * r - s * s) * dr)
                .sum()
        };
        let step = support / PULL_SAMPLES as f64;
        Self {
            support,
            samples: (0..=PULL_SAMPLES).map(|i| value(i as f64 * step)).collect(),
        }
    }

    /// G at distance `distance` (metres) from the wall, that at the wall
    /// within it; dimensionless.
    pub fn at(&self, distance: f64) -> f64 {
        let position = (distance / self.support).clamp(0.0, 1.0) * PULL_SAMPLES as f64;
        let i = (position as usize).min(PULL_SAMPLES - 1);
        let t = position - i as f64;
        (1.0 - t) * self.samples[i] + t * self.samples[i + 1]
    }

    /// A(r), 1/m³.
    pub fn kernel(&self, r: f64) -> f64 {
        adhesion_kernel(r, self.support)
    }

    /// G at uniform steps from distance 0 to h, both included, for the GPU.
    pub fn table(&self) -> Vec<f32> {
        self.samples.iter().map(|&value| value as f32).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const H: f64 = 0.005;
    const TENSION: f64 = 0.072;
    const DENSITY: f64 = 1000.0;

    #[test]
    fn kernels_are_as_printed() {
        for i in 0..=220 {
            let r = H * f64::from(i) / 200.0;
            // Akinci et al. 2013, Eqs 2 and 7, in their own form.
            let product = (H - r).powi(3) * r.powi(3);
            let far = 2.0 * r > H && r <= H;
            let cohesion = match (far, r <= H) {
                (true, _) => product,
                (false, true) => 2.0 * product - H.powi(6) / 64.0,
                (false, false) => 0.0,
            };
            let cohesion = 32.0 / (PI * H.powi(9)) * cohesion;
            let adhesion = if far {
                let root = -4.0 * r * r / H + 6.0 * r - 2.0 * H;
                0.007 / H.powf(3.25) * root.max(0.0).powf(0.25)
            } else {
                0.0
            };
            // The largest values are 1/(2πh³) and 0.005/h³. The fourth root
            // makes 1e-4 of a rounding of 1e-16 at its zero, r = h.
            let own = [cohesion_kernel(r, H), adhesion_kernel(r, H)];
            let off = (own[0] - cohesion).abs() * H.powi(3);
            assert!(off < 1e-12, "{r}: {own:?} {cohesion}");
            let off = (own[1] - adhesion).abs() * H.powi(3);
            assert!(off < 2e-6, "{r}: {own:?} {adhesion}");
        }
    }

    /// ∫ r⁴ f(r) dr over the support by the midpoint rule.
    fn fourth_moment(kernel: impl Fn(f64, f64) -> f64) -> f64 {
        let n = 200_000;
        let dr = H / f64::from(n);
        let radii = (0..n).map(|i| (f64::from(i) + 0.5) * dr);
        radii.map(|r| r.powi(4) * kernel(r, H) * dr).sum()
    }

    #[test]
    fn strengths_make_the_surface_tension_asked_for() {
        for (kernel, strength) in [
            (
                cohesion_kernel as fn(f64, f64) -> f64,
                cohesion_strength(TENSION, DENSITY, H),
            ),
            (adhesion_kernel, adhesion_strength(TENSION, DENSITY, H)),
        ] {
            // Fowler's formula with f = γm²C and n = ρ₀/m.
            let tension = PI / 8.0 * DENSITY.powi(2) * strength * fourth_moment(kernel);
            assert!((tension - TENSION).abs() < 1e-5, "{tension}");
        }
    }

    /// Fowler's factor π/8, by the work that it takes to part two half spaces:
    /// ∫ dL ∫ ρ₀·a(L + x) dx = ρ₀ ∫ s·a(s) ds with a = βρ₀G(s). It makes two
    /// surfaces.
    #[test]
    fn parting_liquid_from_glass_takes_the_work_of_two_surfaces() {
        let pull = HalfSpacePull::new(H);
        let n = 2000;
        let ds = H / f64::from(n);
        let distances = (0..n).map(|i| (f64::from(i) + 0.5) * ds);
        let moment: f64 = distances.map(|s| s * pull.at(s) * ds).sum();
        let work = adhesion_strength(TENSION, DENSITY, H) * DENSITY.powi(2) * moment;
        // The table is linear between 64 nodes.
        assert!((work / (2.0 * TENSION) - 1.0).abs() < 2e-3, "{work}");
    }

    #[test]
    fn half_space_pull_is_the_sum_over_a_wall() {
        let pull = HalfSpacePull::new(H);
        let step = H / 60.0;
        for distance in [0.0, 0.3, 0.6, 0.9].map(|q| q * H) {
            let mut sum = 0.0;
            for (i, j, k) in
                (-60..60).flat_map(|i| (-60..60).flat_map(move |j| (0..60).map(move |k| (i, j, k))))
            {
                let centre = [i, j, k].map(|n| (f64::from(n) + 0.5) * step);
                let depth = centre[2] + distance;
                let r = centre[0].hypot(centre[1]).hypot(depth);
                sum += adhesion_kernel(r, H) * depth / r * step.powi(3);
            }
            // The kernel's edges are as steep as a fourth root.
            assert!(
                (sum - pull.at(distance)).abs() < 0.02 * pull.at(0.0),
                "{distance}"
            );
        }
    }
}
