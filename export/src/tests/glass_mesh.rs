#![allow(clippy::unwrap_used)]
use vitriol_sim::flask::glassware::GLASSWARE;

use super::*;

/// Both sides of the glass enclose its volume, which the profile integrates by discs; and the inner one alone the capacity.
#[test]
fn both_sides_enclose_the_glass() {
    for glass in &GLASSWARE {
        let profile = glass.profile(1.0).unwrap();
        let (inner, outer) = (inner(&profile, 2e-3), outer(&profile, 2e-3));
        let volume = inner.flux() + outer.flux();
        let error = volume / profile.glass_volume() - 1.0;
        // The glass is the small difference of two bodies, of which 48 sectors or more leave out 0.3 % at most.
        assert!(error.abs() < 0.02, "{}: {error}", glass.name);
        // The mouth's disc closes it: ⅓ y·πr² is its share.
        let mouth =
            std::f64::consts::PI * profile.mouth_radius().powi(2) * profile.rim_height() / 3.0;
        let capacity = mouth - inner.flux();
        let error = capacity / profile.capacity() - 1.0;
        assert!(error.abs() < 0.005, "{}: {error}", glass.name);
        for mesh in [inner, outer] {
            let normals = mesh.triangles.iter().map(|&triangle| {
                let [a, b, c] = mesh.corners(triangle);
                let normal = (b - a).cross(c - a).normalize_or_zero();
                normal.dot(mesh.normals[triangle[0] as usize])
            });
            let worst = normals.fold(1.0, f64::min);
            assert!(worst > 0.9, "{}: {worst}", glass.name);
        }
    }
}
