#![allow(clippy::unwrap_used)]
use super::*;
use crate::flask::glassware;
use proptest::prelude::*;

/// 0.001 h at h = 5 mm.
const MARGIN: f64 = 5e-6;

fn beaker() -> Profile {
    glassware::find("beaker-250").unwrap().profile(1.0).unwrap()
}

fn at(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

#[test]
fn regions_are_those_of_eqs_21_to_23() {
    let profile = beaker();
    let of = |x: f64, y: f64| Region::of(&profile, DVec3::new(0.6 * x, y, 0.8 * x));
    assert_eq!(of(0.0, 0.05), Region::Inside);
    assert_eq!(of(0.0329, 0.05), Region::Inside);
    assert_eq!(of(0.0331, 0.05), Region::Outside);
    assert_eq!(of(0.0, 0.001), Region::Outside);
    assert_eq!(of(0.0, 0.095), Region::Above);
    assert_eq!(of(5.0, 0.095), Region::Above);
}

#[test]
fn figure_4_vertical_first_then_radial() {
    // A cone: the radius at the corrected height, not at the predicted one.
    let cone = Profile::new(&[[0.0, 0.01], [0.1, 0.06]], 0.002).unwrap();
    let p = project(&cone, at(0.0, 0.05), DVec3::new(0.06, -0.5, 0.08), MARGIN);
    assert!(p.constrained && p.inside);
    let radius_there = 0.01 + 0.5 * MARGIN;
    let expected = DVec3::new(0.6, 0.0, 0.8) * (radius_there - MARGIN);
    assert!((p.position - expected.with_y(0.002 + MARGIN)).length() < 1e-12);
}

#[test]
fn no_constraint_without_penetration() {
    let profile = beaker();
    for (a, b) in [
        (at(0.0, 0.05), at(0.032, 0.01)),
        (at(0.2, 0.05), at(0.04, 0.3)),
        (at(0.0, 0.5), at(-0.04, 0.2)),
    ] {
        let p = project(&profile, a, b, MARGIN);
        assert_eq!((p.position, p.constrained), (b, false));
    }
}

#[test]
fn the_mouth_is_open_both_ways() {
    let profile = beaker();
    let out = project(&profile, at(0.02, 0.09), at(0.025, 0.3), MARGIN);
    assert_eq!((out.constrained, out.inside), (false, false));
    let enters = project(&profile, at(0.02, 0.3), at(0.025, 0.05), MARGIN);
    assert_eq!((enters.constrained, enters.inside), (false, true));
    // Through the mouth, but past the floor: caught inside.
    let caught = project(&profile, at(0.01, 0.3), at(0.01, -10.0), MARGIN);
    assert!(caught.constrained && caught.inside);
    // Upwards through the side wall: not the mouth.
    let wall = project(&profile, at(0.03, 0.05), at(0.5, 0.2), MARGIN);
    assert!(wall.constrained && wall.inside);
}

#[test]
fn what_is_outside_stops_at_the_glass_and_slides() {
    let profile = beaker();
    let p = project(&profile, at(0.5, 0.05), at(-0.5, 0.05), MARGIN);
    assert!(p.constrained && !p.inside);
    assert!(
        (p.position - at(0.035, 0.05)).length() < 2.0 * MARGIN,
        "{}",
        p.position
    );
    // Onto the wall at a slant: the way along it is kept.
    let p = project(&profile, at(0.036, 0.05), at(0.0345, 0.04), MARGIN);
    assert!(
        (p.position - at(0.035, 0.04)).length() < 2.0 * MARGIN,
        "{}",
        p.position
    );
    // From below, through the base.
    let p = project(&profile, at(0.0, -0.1), at(0.0, 0.05), MARGIN);
    assert!(!p.inside && p.position.y < 0.0 && p.position.y > -2.0 * MARGIN);
}

#[test]
fn in_the_glass_goes_back_to_where_it_came_from() {
    let profile = beaker();
    let glass = at(0.034, 0.05);
    assert!(
        project_from(&profile, true, at(0.02, 0.05), glass, MARGIN)
            .position
            .x
            < 0.033
    );
    assert!(
        project_from(&profile, false, at(0.04, 0.05), glass, MARGIN)
            .position
            .x
            > 0.035
    );
    // Both ends in the glass: the nearer side counts.
    for (x, inside) in [(0.0332, true), (0.0348, false)] {
        let p = project(&profile, at(x, 0.05), at(x, 0.05), MARGIN);
        assert_eq!(p.inside, inside);
        assert!(profile.signed_distance_glass(p.position.x, p.position.y) > 0.0);
    }
}

/// Points and wall.
type Shape = (Vec<[f64; 2]>, f64);

/// Profiles from narrow tubes to bowls, necks and bulges.
fn profiles() -> impl Strategy<Value = Shape> {
    let steps = prop::collection::vec((0.004..0.05f64, 0.004..0.06f64), 1..6);
    (
        steps,
        prop_oneof![Just(0.0), 0.004..0.06f64],
        0.001..0.004f64,
    )
        .prop_map(|(steps, floor, wall)| {
            let mut points = vec![[0.0, floor]];
            for (rise, radius) in steps {
                points.push([points[points.len() - 1][0] + rise, radius]);
            }
            (points, wall)
        })
}

/// Share of the radius and of the height, angle.
type Place = (f64, f64, f64);

fn in_flask(profile: &Profile, (r, y, angle): Place) -> DVec3 {
    let (low, high) = (profile.floor_height(), profile.rim_height());
    let y = low + (high - low) * (0.0005 + 0.999 * y);
    let r = profile.inner_radius(y) * 0.9999 * r;
    DVec3::new(r * angle.cos(), y, r * angle.sin())
}

/// Anywhere within three vessels' size; none if that is in the flask.
fn around(profile: &Profile, (r, y, angle): Place) -> Option<DVec3> {
    let size = profile.outer_radius().max(profile.rim_height());
    let (r, y) = (3.0 * r * size, (6.0 * y - 2.5) * size);
    let free = !profile.is_inside(r, y) && profile.signed_distance_glass(r, y) > MARGIN;
    free.then(|| DVec3::new(r * angle.cos(), y, r * angle.sin()))
}

fn places() -> impl Strategy<Value = Place> {
    // On the axis and at the very rim as often as anywhere else.
    let r = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64];
    let y = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64];
    (r, y, 0.0..std::f64::consts::TAU)
}

/// Motions from micrometres to ten metres.
fn motions() -> impl Strategy<Value = DVec3> {
    let length = (-6.0..1.0f64).prop_map(|power| 10f64.powf(power));
    let axis = || -1.0..1.0f64;
    (length, axis(), axis(), axis())
        .prop_map(|(length, x, y, z)| DVec3::new(x, y, z).normalize_or(DVec3::NEG_Y) * length)
}

fn check_valid(profile: &Profile, p: &Projection) -> Result<(), TestCaseError> {
    let r = radius(p.position);
    prop_assert_eq!(p.inside, profile.is_inside(r, p.position.y));
    prop_assert!(profile.signed_distance_glass(r, p.position.y) > 0.0);
    // A particle may stay at the position that it is put at.
    let again = project(profile, p.position, p.position, MARGIN);
    prop_assert_eq!(again.inside, p.inside);
    prop_assert!(again.position.distance(p.position) < 1e-9);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400,
        failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn inside_stays_inside_but_for_the_mouth(
        shape in profiles(), from in places(), motion in motions(),
    ) {
        let profile = Profile::new(&shape.0, shape.1).unwrap();
        let from = in_flask(&profile, from);
        let to = from + motion;
        let p = project(&profile, from, to, MARGIN);
        check_valid(&profile, &p)?;
        if p.inside {
            let again = project(&profile, from, p.position, MARGIN);
            prop_assert!(again.position.distance(p.position) < 1e-12);
        } else {
            let t = (profile.rim_height() - from.y) / motion.y;
            let crossing = from + motion * t;
            prop_assert!((0.0..=1.0).contains(&t));
            prop_assert!(crossing.x.hypot(crossing.z) < profile.mouth_radius());
        }
    }

    #[test]
    fn outside_stays_outside_but_for_the_mouth(
        shape in profiles(), from in places(), motion in motions(), aim in places(), aimed: bool,
    ) {
        let profile = Profile::new(&shape.0, shape.1).unwrap();
        let Some(from) = around(&profile, from) else { return Ok(()) };
        // Half of the motions go through some point of the flask.
        let to = if aimed {
            let target = in_flask(&profile, aim);
            target + (target - from).normalize_or_zero() * motion.length()
        } else {
            from + motion
        };
        let p = project(&profile, from, to, MARGIN);
        check_valid(&profile, &p)?;
        if p.inside {
            prop_assert!(from.y >= profile.rim_height());
        } else {
            let again = project(&profile, from, p.position, MARGIN);
            prop_assert!(again.position.distance(p.position) < 1e-9);
            // Nothing lies between: no sample of the way is in the glass by
            // more than a step may cut off a corner, nor in the flask.
            let way = p.position - from;
            let count = (way.length() / 0.0003).ceil().min(4000.0);
            for i in 0..=(count as i32) {
                let point = from + way * (f64::from(i) / count.max(1.0));
                let r = radius(point);
                prop_assert!(!profile.is_inside(r, point.y) || p.position.y >= profile.rim_height());
                if r < 0.07 {
                    let depth = -profile.signed_distance_glass(r, point.y);
                    prop_assert!(depth < profile.wall() / 8.0, "{depth}");
                }
            }
        }
    }

    #[test]
    fn from_the_glass_to_a_valid_place(
        shape in profiles(), place in places(), through in 0.0..1.0f64, motion in motions(),
    ) {
        let profile = Profile::new(&shape.0, shape.1).unwrap();
        let inner = in_flask(&profile, place);
        let outward = DVec3::new(place.2.cos(), 0.0, place.2.sin());
        let wall = profile.outer_radius_at(inner.y) - profile.inner_radius(inner.y);
        let from = outward * (profile.inner_radius(inner.y) + through * wall) + DVec3::Y * inner.y;
        for was_inside in [false, true] {
            let p = project_from(&profile, was_inside, from, from + motion, MARGIN);
            check_valid(&profile, &p)?;
        }
    }
}
