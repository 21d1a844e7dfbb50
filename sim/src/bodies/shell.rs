//! Mass, centre and inertia of the empty glass.

use glam::Vec3;
use rapier3d::prelude::MassProperties;

/// Mass properties of the surface that `outline` ([radius, height], m) sweeps
/// about the y axis, as a shell of uniform thickness that weighs `mass` (kg).
///
/// The solid that collides would be the wrong source: a beaker is hollow, and
/// filled with glass it would be slower to tip and have its centre higher.
///
/// With `r` and `y` linear along a segment, the integrals over its area
/// 2πr ds of 1, y, r², and r²/2 + y² are of polynomials of degree 3 at most,
/// for which Simpson's rule is exact.
pub(super) fn mass_properties(outline: &[[f32; 2]], mass: f32) -> MassProperties {
    let mut area = 0.0;
    let mut height_moment = 0.0;
    let mut axial = 0.0;
    let mut transverse = 0.0;
    for pair in outline.windows(2) {
        let [r0, y0] = pair[0].map(f64::from);
        let [r1, y1] = pair[1].map(f64::from);
        let length = (r1 - r0).hypot(y1 - y0);
        let mean = |f: &dyn Fn(f64, f64) -> f64| {
            let middle = f(0.5 * (r0 + r1), 0.5 * (y0 + y1));
            length * (f(r0, y0) + 4.0 * middle + f(r1, y1)) / 6.0
        };
        area += mean(&|r, _| r);
        height_moment += mean(&|r, y| r * y);
        axial += mean(&|r, _| r * r * r);
        transverse += mean(&|r, y| r * (0.5 * r * r + y * y));
    }
    let mass_per_area = f64::from(mass) / area;
    let centre = height_moment / area;
    let axial = mass_per_area * axial;
    let transverse = mass_per_area * transverse - f64::from(mass) * centre * centre;
    MassProperties::new(
        Vec3::new(0.0, centre as f32, 0.0),
        mass,
        Vec3::new(transverse as f32, axial as f32, transverse as f32),
    )
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    /// The textbook's open cylinder with a base: side m(R²/2 + H²/12), disc mR²/4.
    #[test]
    fn cylinder_with_a_base() {
        let (radius, height, mass) = (0.035, 0.095, 0.1);
        let props = mass_properties(&[[0.0, 0.0], [radius, 0.0], [radius, height]], mass);
        let (r, h, m) = (f64::from(radius), f64::from(height), f64::from(mass));
        let (side_area, base_area) = (2.0 * PI * r * h, PI * r * r);
        let side = m * side_area / (side_area + base_area);
        let base = m - side;
        let centre = side * h / 2.0 / m;
        let axial = side * r * r + base * r * r / 2.0;
        let transverse = side * (r * r / 2.0 + h * h / 12.0 + (h / 2.0 - centre).powi(2))
            + base * (r * r / 4.0 + centre * centre);
        let found = props.principal_inertia();
        // f32 storage of values computed in f64.
        assert!((f64::from(props.local_com.y) / centre - 1.0).abs() < 1e-6);
        assert!((f64::from(found.y) / axial - 1.0).abs() < 1e-6);
        assert!((f64::from(found.x) / transverse - 1.0).abs() < 1e-6);
        assert!((props.mass() - mass).abs() < 1e-8);
    }

    /// A hemispherical shell: centre at R/2, ⅔mR² about the axis, and
    /// (⅔ − ¼)mR² across it through the centre of mass.
    #[test]
    fn hemisphere() {
        let (radius, mass) = (0.05_f64, 0.2_f64);
        let outline: Vec<[f32; 2]> = (0..=200)
            .map(|i| f64::from(i) / 200.0 * FRAC_PI_2)
            .map(|angle| {
                [
                    (radius * angle.sin()) as f32,
                    (radius * (1.0 - angle.cos())) as f32,
                ]
            })
            .collect();
        let props = mass_properties(&outline, mass as f32);
        let unit = mass * radius * radius;
        // 200 chords fall short of the arc by (π/400)²/6 ≈ 1e-5.
        assert!((f64::from(props.local_com.y) / (radius / 2.0) - 1.0).abs() < 1e-4);
        let found = props.principal_inertia();
        assert!((f64::from(found.y) / (unit * 2.0 / 3.0) - 1.0).abs() < 1e-4);
        assert!((f64::from(found.x) / (unit * 5.0 / 12.0) - 1.0).abs() < 1e-4);
    }
}
