#![allow(clippy::unwrap_used)]
use super::*;
use vitriol_tests::random::Random;

const H: f64 = 0.005;

fn beaker() -> Profile {
    Profile::new(&[[0.0, 0.033], [0.093, 0.033]], 0.002).unwrap()
}

/// V by random points in the ball, with the solid written down anew.
fn monte_carlo(solid: impl Fn(f64, f64) -> bool, r: f64, y: f64) -> f64 {
    let kernel = Kernel::new(H);
    let n = 200_000;
    let mut random = Random(7);
    let mut sum = 0.0;
    for _ in 0..n {
        let [dx, dy, dz] = random.point(2.0 * H).to_array();
        let distance = (dx * dx + dy * dy + dz * dz).sqrt();
        if solid((r + dx).hypot(dz), y + dy) {
            sum += kernel.w(distance);
        }
    }
    sum * (2.0 * H).powi(3) / n as f64
}

#[test]
fn agrees_with_random_points() {
    // An Erlenmeyer's slope, neck, floor corner and rim, from both sides.
    let profile = Profile::new(&[[0.0, 0.04], [0.1, 0.015], [0.13, 0.015]], 0.002).unwrap();
    let wall_at = |y: f64| profile.inner_radius(y);
    let inside = Integral::new(&profile, Side::Inside, H);
    let outside = Integral::new(&profile, Side::Outside, H);
    let around = |r: f64, y: f64| y < 0.132 && !(y > 0.002 && r < wall_at(y));
    let glass = |r: f64, y: f64| profile.signed_distance_glass(r, y) < 0.0;
    for (r, y) in [
        (0.039, 0.003),
        (0.026, 0.05),
        (0.013, 0.12),
        (0.014, 0.131),
        (0.0, 0.003),
    ] {
        let (table, random) = (inside.sample(r, y).volume, monte_carlo(around, r, y));
        // Standard error of 200,000 points: 0.004 at most.
        assert!(
            (table - random).abs() < 0.012,
            "in {r} {y}: {table} {random}"
        );
    }
    for (r, y) in [
        (0.0435, 0.001),
        (0.0305, 0.05),
        (0.0175, 0.12),
        (0.016, 0.1325),
        (0.0, -0.001),
    ] {
        let (table, random) = (outside.sample(r, y).volume, monte_carlo(glass, r, y));
        assert!(
            (table - random).abs() < 0.012,
            "out {r} {y}: {table} {random}"
        );
    }
}

#[test]
fn wide_wall_is_a_plane() {
    let wide = Profile::new(&[[0.0, 3.0], [0.1, 3.0]], 0.003).unwrap();
    let integral = Integral::new(&wide, Side::Inside, H);
    let plane = PlaneMap::new(H);
    for i in 0..=20 {
        let distance = H * i as f64 / 20.0;
        // Radius 600 h: curvature adds less than h/R.
        let wall = integral.sample(3.0 - distance, 0.05);
        assert!(
            (wall.volume - plane.volume(distance)).abs() < 1e-3,
            "{distance}"
        );
        assert!((wall.volume_dr + plane.slope(distance)).abs() * H < 2e-3);
        let floor = integral.sample(0.5, 0.003 + distance);
        assert!(
            (floor.volume - plane.volume(distance)).abs() < 1e-4,
            "{distance}"
        );
        assert!((floor.volume_dy - plane.slope(distance)).abs() * H < 1e-3);
    }
}

#[test]
fn plane_is_the_integral_of_the_kernel() {
    let plane = PlaneMap::new(H);
    assert!((plane.volume(0.0) - 0.5).abs() < 1e-14);
    assert!((plane.volume(-0.3 * H) + plane.volume(0.3 * H) - 1.0).abs() < 1e-14);
    assert_eq!(plane.volume(H), 0.0);
    for distance in [0.0, 0.2, 0.5, 0.7, 0.95].map(|q| q * H) {
        // Spheres of radius r, of which the cap beyond the plane counts.
        let (n, kernel) = (10_000, Kernel::new(H));
        let dr = (H - distance) / f64::from(n);
        let radii = (0..n).map(|i| distance + (f64::from(i) + 0.5) * dr);
        let caps = radii.map(|r| 2.0 * PI * r * (r - distance) * kernel.w(r) * dr);
        let exact: f64 = caps.sum();
        assert!((plane.volume(distance) - exact).abs() < 1e-7);
        let eps = 1e-4 * H;
        let slope = (plane.volume(distance + eps) - plane.volume(distance - eps)) / (2.0 * eps);
        assert!(
            (plane.slope(distance) - slope).abs() * H < 1e-3,
            "{distance}"
        );
    }
}

#[test]
fn gradient_is_the_derivative_of_v() {
    let profile = beaker();
    for side in [Side::Inside, Side::Outside] {
        let integral = Integral::new(&profile, side, H);
        for (r, y) in [
            (0.032, 0.003),
            (0.0365, 0.05),
            (0.030, 0.094),
            (0.001, 0.0025),
            (0.03, -0.002),
        ] {
            let at = integral.sample(r, y);
            let eps = 2e-3 * H;
            let dr = (integral.sample(r + eps, y).volume - integral.sample(r - eps, y).volume)
                / (2.0 * eps);
            let dy = (integral.sample(r, y + eps).volume - integral.sample(r, y - eps).volume)
                / (2.0 * eps);
            // In units of 1/h, where a plane's slope is 1.4 at most.
            assert!(
                (at.volume_dr - dr).abs() * H < 5e-3,
                "{side:?} {r} {y} {} {dr}",
                at.volume_dr
            );
            assert!(
                (at.volume_dy - dy).abs() * H < 5e-3,
                "{side:?} {r} {y} {} {dy}",
                at.volume_dy
            );
        }
    }
}

#[test]
fn nothing_acts_beyond_the_support_or_through_the_wall() {
    let profile = beaker();
    let inside = VolumeMap::new(&profile, Side::Inside, H);
    let outside = VolumeMap::new(&profile, Side::Outside, H);
    assert_eq!(inside.sample(0.01, 0.05).volume, 0.0);
    assert_eq!(outside.sample(0.041, 0.05).volume, 0.0);
    assert_eq!(outside.sample(1.0, 5.0).volume, 0.0);
    assert!(outside.sample(1.0, 5.0).distance > 0.9);
    // Against an infinitely thick wall half of the kernel is solid, and
    // 2 mm of glass do not let the rest through.
    assert!((inside.sample(0.033, 0.05).volume - 0.5).abs() < 0.05);
    let seen_from_outside = outside.sample(0.035, 0.05).volume;
    assert!(
        (0.2..0.5).contains(&seen_from_outside),
        "{seen_from_outside}"
    );
}

#[test]
fn table_interpolates_the_integral() {
    let profile = beaker();
    let map = VolumeMap::new(&profile, Side::Inside, H);
    let integral = Integral::new(&profile, Side::Inside, H);
    for i in 0..200 {
        let mut random = Random(i);
        let r = 0.033 * random.number();
        let y = 0.002 + 0.09 * random.number();
        let (table, exact) = (map.sample(r, y), integral.sample(r, y));
        // Bilinear over h/6: V'' (h/6)²/8 with V'' ≤ 4/h².
        assert!((table.volume - exact.volume).abs() < 0.015, "{r} {y}");
        assert!((table.distance - exact.distance).abs() < 0.1 * H);
        // V‴ (h/6)²/8 along r and y with V‴ ≤ 16/h³; a plane's slope is 1.4/h
        // at most.
        for (own, exact) in [
            (table.volume_dr, exact.volume_dr),
            (table.volume_dy, exact.volume_dy),
        ] {
            assert!((own - exact).abs() * H < 0.12, "{r} {y}: {own} {exact}");
        }
    }
}

/// A row of the map may lie on the rim's plane. Taken for glass there, it was a
/// membrane: particles that fell slowly came to rest on it.
#[test]
fn the_mouth_is_open() {
    let profile = beaker();
    let map = VolumeMap::new(&profile, Side::Outside, H);
    let rim = profile.rim_height();
    let to_wall = profile.mouth_radius() - 0.01;
    for above in [-0.5, 0.0, 0.5, 1.0] {
        let sample = map.sample(0.01, rim + above * map.spacing);
        // Linear interpolation between nodes is this good far from the glass.
        assert!(
            (sample.distance - to_wall).abs() < 0.05 * H,
            "{above}: {sample:?}"
        );
    }
}
