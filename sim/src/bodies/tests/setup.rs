//! Worlds of another scale, and worlds that are refused.

use super::*;
use crate::bodies::BodiesError;

fn spec(flasks: Vec<BodySpec>) -> BodiesSpec {
    BodiesSpec {
        table: None,
        ..on_table(flasks)
    }
}

/// Twenty times the size: a flask stands as it does at real size, and reach grows along.
#[test]
fn lengths_grow_with_the_scale() {
    let scale = 20.0;
    let mut large = beaker(Pose::IDENTITY);
    for point in &mut large.outline {
        *point = point.map(|length| length * scale);
    }
    let spec = BodiesSpec {
        length_scale: scale,
        ..spec(vec![large])
    };
    for (gap, expected) in [(1.05, None), (0.95, Some(1))] {
        let mut bodies = Bodies::new(&spec).unwrap();
        run(&mut bodies, 2.0, Load::default());
        assert!(bodies.poses()[0].position.length() < 1e-4 * scale);
        let beside = Vec3::new(RADIUS * scale + gap, 1.0, 0.0);
        bodies.step(&gripping(Pose::from_position(beside)), &[]);
        assert_eq!(bodies.holder(0), expected);
    }
}

#[test]
fn refuses_what_is_no_flask() {
    let outlines: [&[[f32; 2]]; 5] = [
        &[[0.0, 0.0], [0.03, 0.0]],
        &[[0.01, 0.0], [0.03, 0.0], [0.03, 0.1]],
        &[[0.0, 0.0], [0.03, 0.1], [0.03, 0.05]],
        &[[0.0, 0.0], [f32::NAN, 0.0], [0.03, 0.1]],
        &[[0.0, 0.0], [0.03, 0.0], [0.04, 0.0]],
    ];
    for outline in outlines {
        let bad = BodySpec {
            outline: outline.to_vec(),
            ..beaker(Pose::IDENTITY)
        };
        let error = Bodies::new(&spec(vec![beaker(Pose::IDENTITY), bad])).err();
        assert!(
            matches!(error, Some(BodiesError::Flask { flask: 1, .. })),
            "{outline:?}: {error:?}"
        );
    }
    let weightless = BodySpec {
        glass_mass: 0.0,
        ..beaker(Pose::IDENTITY)
    };
    assert!(Bodies::new(&spec(vec![weightless])).is_err());
    let still = BodiesSpec {
        step: 0.0,
        ..spec(vec![])
    };
    assert!(Bodies::new(&still).is_err());
}
