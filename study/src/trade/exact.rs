//! Exact results, without the solver.

use std::f64::consts::PI;

use vitriol_sim::flask::Profile;

/// Rows of the quadrature over a vessel: its error is below 1e-4
/// of the volume (the test has a cylinder).
const ROWS: usize = 2000;

/// Volume (m³) that stays in a vessel which is tilted by `angle` (radians, up to a right angle) from upright and was filled to the rim
/// before: the volume below the level of the rim's lowest point.
pub fn retained(profile: &Profile, angle: f64) -> f64 {
    let (low, high) = (profile.floor_height(), profile.rim_height());
    let (sine, cosine) = angle.sin_cos();
    // Upwards is (−sin, cos) over (side, y) when the vessel leans to its +side; the
    // lip is at the mouth's radius there.
    let lip = -sine * profile.mouth_radius() + cosine * high;
    let step = (high - low) / ROWS as f64;
    let rows = (0..ROWS).map(|row| {
        let y = low + (row as f64 + 0.5) * step;
        let radius = profile.inner_radius(y);
        // Liquid is where −side·sin + y·cos < lip: side > this.
        let from = (y * cosine - lip) / sine.max(1e-12);
        step * segment(radius, from)
    });
    rows.sum()
}

/// Area of a disc of `radius` beyond a chord at `from` from its centre.
fn segment(radius: f64, from: f64) -> f64 {
    if from >= radius {
        return 0.0;
    }
    if from <= -radius {
        return PI * radius * radius;
    }
    radius * radius * (from / radius).acos() - from * (radius * radius - from * from).sqrt()
}

/// Height (flask's frame, m) of the centre of mass of `volume` m³ at rest.
pub fn centre_of_mass(profile: &Profile, volume: f64) -> Option<f64> {
    let level = profile.level_for_volume(volume)?;
    let low = profile.floor_height();
    let step = (level - low) / ROWS as f64;
    let moments = (0..ROWS).map(|row| {
        let y = low + (row as f64 + 0.5) * step;
        PI * profile.inner_radius(y).powi(2) * step * y
    });
    Some(moments.sum::<f64>() / volume)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn cylinder() -> Profile {
        Profile::new(&[[0.0, 0.03], [0.1, 0.03]], 0.002).unwrap()
    }

    #[test]
    fn a_tilted_cylinder_keeps_what_its_geometry_says() {
        let profile = cylinder();
        let area = PI * 0.03 * 0.03;
        // While the floor is covered: the lip's side loses 2R·tan, half of it on average.
        for angle in [0.2f64, 0.6, 1.0] {
            let exact = area * (0.1 - 0.03 * angle.tan());
            assert!(
                (retained(&profile, angle) / exact - 1.0).abs() < 1e-3,
                "{angle}"
            );
        }
        assert!(retained(&profile, PI / 2.0) < 1e-9);
    }

    #[test]
    fn the_centre_of_a_cylinders_liquid_is_half_its_depth() {
        let profile = cylinder();
        let volume = PI * 0.03 * 0.03 * 0.05;
        let centre = centre_of_mass(&profile, volume).unwrap();
        assert!((centre - 0.002 - 0.025).abs() < 1e-6, "{centre}");
    }
}
