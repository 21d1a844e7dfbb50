//! The paper's boundary: solid particles on the glass (Akinci et al. 2012).

use super::profile::Profile;
use crate::kernel::Kernel;
use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// One solid particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryParticle {
    /// Position in the flask's frame, metres.
    pub position: DVec3,
    /// Volume 1/Σ_k W over the flask's solid particles, m³ (Akinci et al.
    /// 2012, Eq. 4). Its contribution to a fluid particle's density is
    /// ψ·W with ψ = ρ₀ times this.
    pub volume: f64,
}

/// Covers the whole surface of the glass (inside, rim and outside) with
/// particles about `spacing` apart, for a kernel of support radius `support`;
/// metres.
///
/// Rings around the axis, so that the count is the surface's area over
/// spacing².
pub fn sample(profile: &Profile, spacing: f64, support: f64) -> Vec<BoundaryParticle> {
    let mut points = Vec::new();
    let inner = profile.inner_outline();
    let outer = profile.outer_outline();
    for side in [inner, outer] {
        cover(side, spacing, true, &mut points);
    }
    // Both ends of the rim's top are on the rings of the sides already.
    let top = [inner[inner.len() - 1], outer[outer.len() - 1]];
    cover(&top, spacing, false, &mut points);
    let volumes = volumes(&points, support);
    points
        .into_iter()
        .zip(volumes)
        .map(|(position, volume)| BoundaryParticle { position, volume })
        .collect()
}

/// Rings at equal steps along the outline; with or without its two ends.
fn cover(outline: &[[f64; 2]], spacing: f64, ends: bool, points: &mut Vec<DVec3>) {
    let length: f64 = outline.windows(2).map(length_of).sum();
    let steps = (length / spacing).round().max(1.0) as usize;
    let rings = if ends { 0..steps + 1 } else { 1..steps };
    for ring in rings {
        let [r, y] = along(outline, length * ring as f64 / steps as f64);
        let count = (TAU * r / spacing).round().max(1.0) as usize;
        // Every other ring turned by half a step, towards a hexagonal cover.
        let turn = 0.5 * (ring % 2) as f64;
        points.extend((0..count).map(|i| {
            let angle = TAU * (i as f64 + turn) / count as f64;
            DVec3::new(r * angle.cos(), y, r * angle.sin())
        }));
    }
}

fn length_of(pair: &[[f64; 2]]) -> f64 {
    (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])
}

fn along(outline: &[[f64; 2]], mut arc: f64) -> [f64; 2] {
    for pair in outline.windows(2) {
        let length = length_of(pair);
        if arc <= length && length > 0.0 {
            let t = arc / length;
            return [0, 1].map(|k| pair[0][k] + t * (pair[1][k] - pair[0][k]));
        }
        arc -= length;
    }
    outline[outline.len() - 1]
}

fn volumes(points: &[DVec3], support: f64) -> Vec<f64> {
    let kernel = Kernel::new(support);
    let cell_of = |point: DVec3| (point / support).floor().as_i64vec3().to_array();
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for (index, &point) in points.iter().enumerate() {
        cells.entry(cell_of(point)).or_default().push(index);
    }
    let sum_in = |cell: [i64; 3], point: DVec3| -> f64 {
        cells.get(&cell).map_or(0.0, |members| {
            members
                .iter()
                .map(|&other| kernel.w(points[other].distance(point)))
                .sum()
        })
    };
    let sum_around = |point: DVec3| {
        let [x, y, z] = cell_of(point);
        let mut sum = 0.0;
        for (i, j, k) in
            (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| (i, j, k))))
        {
            sum += sum_in([x + i, y + j, z + k], point);
        }
        sum
    };
    points
        .iter()
        .map(|&point| 1.0 / sum_around(point))
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn covers_the_glass_evenly() {
        let profile = Profile::new(&[[0.0, 0.7], [1.4, 0.7]], 0.04).unwrap();
        let particles = sample(&profile, 0.05, 0.1);
        let area =
            TAU * 0.5 * 0.49 + TAU * 0.7 * 1.4 + TAU * 0.5 * 0.74f64.powi(2) + TAU * 0.74 * 1.44;
        let expected = area / 0.05f64.powi(2);
        // Rounded base edge and ring ends: a few rings of some 30.
        assert!((particles.len() as f64 / expected - 1.0).abs() < 0.03);
        for particle in &particles {
            let r = particle.position.x.hypot(particle.position.z);
            assert!(profile.signed_distance_glass(r, particle.position.y).abs() < 1e-9);
        }
    }

    #[test]
    fn volume_is_the_inverse_kernel_sum() {
        let profile = Profile::new(&[[0.0, 0.2], [0.3, 0.2]], 0.04).unwrap();
        let particles = sample(&profile, 0.03, 0.1);
        let kernel = Kernel::new(0.1);
        for particle in particles.iter().step_by(37) {
            let sum: f64 = particles
                .iter()
                .map(|other| kernel.w(other.position.distance(particle.position)))
                .sum();
            assert!((particle.volume * sum - 1.0).abs() < 1e-12);
        }
    }
}
