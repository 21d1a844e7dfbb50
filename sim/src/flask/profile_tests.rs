#![allow(clippy::unwrap_used)]
use super::*;
use crate::flask::glassware;
use glam::Quat;
use std::f64::consts::PI;

fn beaker() -> Profile {
    Profile::new(&[[0.0, 0.033], [0.093, 0.033]], 0.002).unwrap()
}

#[test]
fn volumes_are_those_of_solids_of_revolution() {
    let cylinder = PI * 0.033 * 0.033;
    assert!((beaker().capacity() / (cylinder * 0.093) - 1.0).abs() < 1e-12);
    assert!((beaker().volume_below(0.052) / (cylinder * 0.05) - 1.0).abs() < 1e-12);
    let level = beaker().level_for_volume(150e-6).unwrap();
    assert!((level - 0.002 - 150e-6 / cylinder).abs() < 1e-12);
    assert_eq!(beaker().level_for_volume(1.0), None);
    for (volume, area) in [(150e-6, cylinder), (1.0, cylinder), (0.0, 0.0)] {
        assert!((beaker().surface_for_volume(volume) - area).abs() < 1e-12);
    }

    let cone = Profile::new(&[[0.0, 0.0], [0.1, 0.05]], 0.002).unwrap();
    let exact = PI / 3.0 * 0.05f64.powi(2) * 0.1;
    assert!((cone.capacity() / exact - 1.0).abs() < 1e-12);
    assert!((cone.volume_below(0.052) / (exact / 8.0) - 1.0).abs() < 1e-12);
    let halfway = PI * 0.025f64.powi(2);
    assert!((cone.surface_for_volume(exact / 8.0) / halfway - 1.0).abs() < 1e-9);

    let sphere = glassware::find("round-bottom-250")
        .unwrap()
        .profile(1.0)
        .unwrap();
    let below = sphere.volume_below(0.002 + 0.0405);
    // Chords inside of the arc: 64 over the sphere, 256 over the height.
    assert!((below / (2.0 / 3.0 * PI * 0.0405f64.powi(3)) - 1.0).abs() < 4e-3);
}

#[test]
fn glass_is_one_wall_thick_everywhere() {
    let base_edge = PI * PI / 2.0 * 0.002f64.powi(2) * (0.033 + 4.0 * 0.002 / (3.0 * PI));
    let base = PI * 0.033f64.powi(2) * 0.002;
    let side = PI * (0.035f64.powi(2) - 0.033f64.powi(2)) * 0.093;
    // The edge's quarter circle has eight chords.
    assert!((beaker().glass_volume() / (base + base_edge + side) - 1.0).abs() < 2e-3);
    for glass in glassware::GLASSWARE {
        let profile = glass.profile(1.0).unwrap();
        let rim = profile.rim_height();
        for &[r, y] in profile
            .outer_outline()
            .iter()
            .filter(|p| p[1] < rim - 0.002)
        {
            let thickness = outline::distance(profile.inner_outline(), r, y);
            assert!(
                (thickness - 0.002).abs() < 2e-5,
                "{} {r} {y}: {thickness}",
                glass.name
            );
        }
    }
}

#[test]
fn distances_on_both_sides() {
    let beaker = beaker();
    let near = |own: f64, exact: f64| (own - exact).abs() < 1e-12;
    assert!(near(beaker.signed_distance_inner(0.0, 0.05), 0.033));
    assert!(near(beaker.signed_distance_inner(0.01, 0.012), 0.010));
    assert!(near(
        beaker.signed_distance_inner(0.0, 0.135),
        0.033f64.hypot(0.04)
    ));
    assert!(near(beaker.signed_distance_inner(0.034, 0.05), -0.001));
    assert!(near(beaker.signed_distance_inner(0.05, 0.05), -0.017));
    assert!(near(beaker.signed_distance_glass(0.034, 0.05), -0.001));
    assert!(near(beaker.signed_distance_glass(0.045, 0.05), 0.010));
    assert!(near(beaker.signed_distance_glass(0.03, 0.05), 0.003));
    assert!(near(beaker.signed_distance_glass(0.0, -0.01), 0.010));
    assert!(near(beaker.signed_distance_glass(0.034, 0.100), 0.005));
    assert!(near(beaker.signed_distance_glass(0.0, 0.0005), -0.0005));
}

#[test]
fn radius_table_follows_the_points() {
    let flask = glassware::find("erlenmeyer-250").unwrap();
    let profile = flask.profile(1.0).unwrap();
    for [height, radius] in flask.points() {
        // A kink between rows is cut off by half a row at most.
        assert!((profile.inner_radius(0.002 + height) - radius).abs() < 6e-4);
    }
    assert_eq!(profile.inner_radius(0.001), 0.0);
    assert!((profile.inner_radius(1.0) - 0.015).abs() < 1e-12);
    assert_eq!(profile.radius_table().len(), INTERVALS + 1);
}

#[test]
fn refuses_what_is_no_vessel() {
    let of = |points: &[[f64; 2]], wall| Profile::new(points, wall).unwrap_err();
    let ok = [[0.0, 0.03], [0.1, 0.03]];
    assert_eq!(of(&ok[..1], 0.002), ProfileError::TooFewPoints(1));
    assert!(matches!(
        of(&[[0.0, f64::NAN], ok[1]], 0.002),
        ProfileError::NotFinite(_)
    ));
    assert!(matches!(of(&ok, f64::INFINITY), ProfileError::NotFinite(_)));
    assert!(matches!(of(&ok, 0.0), ProfileError::WallNotPositive(_)));
    assert!(matches!(
        of(&[[0.0, -0.01], ok[1]], 0.002),
        ProfileError::NegativeRadius { index: 0, .. }
    ));
    assert!(matches!(
        of(&[[0.01, 0.03], ok[1]], 0.002),
        ProfileError::FloorNotZero(_)
    ));
    assert!(matches!(
        of(&[ok[0], ok[1], [0.1, 0.04]], 0.002),
        ProfileError::NotAscending { index: 2, .. }
    ));
    assert!(matches!(
        of(&[ok[0], [0.1, 0.0]], 0.002),
        ProfileError::ClosedMouth(_)
    ));
    let cone = [
        [0.0, 0.0],
        [0.141_727_903_259_302_8, 0.059_368_246_144_941_045],
    ];
    let wall = 1.336_033_685_366_937_3e209;
    let vast = Profile::new(&cone, wall).unwrap();
    assert_eq!(vast.glass_volume(), f64::INFINITY);
    let neck = Profile::new(&[ok[0], [0.1, 0.001]], 0.002).unwrap();
    assert!(neck.check_particle(0.0019).is_ok());
    assert!(neck.check_particle(0.0025).is_err());
    let round = glassware::find("round-bottom-250")
        .unwrap()
        .profile(1.0)
        .unwrap();
    assert!(round.check_particle(0.005).is_ok());
}

/// Half a turn across its axis about its middle takes rim and base round by π times half its diagonal; a push is a push.
#[test]
fn no_glass_goes_further_than_the_furthest() {
    let profile = beaker();
    let push = Pose::from_position(Vec3::new(0.03, -0.04, 0.0));
    assert!((profile.furthest(Pose::IDENTITY, push) - 0.05).abs() < 1e-4);
    let turn = Quat::from_rotation_z(0.5);
    let after = Pose::new(Vec3::new(0.01, 0.0, 0.0), turn);
    let most = profile.furthest(Pose::IDENTITY, after);
    for &[r, y] in profile.outer_outline() {
        for side in [-r, r] {
            let point = Vec3::new(side as f32, y as f32, 0.0);
            let moved = after.transform_point(point) - point;
            assert!(f64::from(moved.length()) <= most, "{r} {y}");
        }
    }
}
