//! Goggles and gloves are put on and taken off; tools are held, and meet no glass.

use super::*;
use crate::bodies::{Role, ToolSpec, Worn};

/// A cylinder that stands or lies so.
fn cylinder(radius: f32, height: f32, pose: Pose) -> BodySpec {
    BodySpec {
        outline: vec![[0.0, 0.0], [radius, 0.0], [radius, height]],
        glass_mass: 0.05,
        stage_from_flask: pose,
        fixed: false,
    }
}

const GOGGLES: usize = 0;
const GLOVES: usize = 1;
const ROD: usize = 2;
const EYES: Vec3 = Vec3::new(0.0, 1.2, 0.1);

/// A beaker, and on the bench beside it goggles, a box of gloves and a rod that lies along x.
fn laboratory() -> Bodies {
    let at = |x: f32, lift: f32| Vec3::new(x, TABLE_TOP + lift, 0.0);
    let goggles = cylinder(0.075, 0.06, Pose::from_position(at(-0.4, 0.0)));
    let mut gloves = cylinder(0.08, 0.09, Pose::from_position(at(-0.7, 0.0)));
    gloves.fixed = true;
    let lying = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
    let rod = cylinder(0.0035, 0.25, Pose::new(at(0.6, 0.0035), lying));
    let tool = |body, role| ToolSpec { body, role };
    Bodies::new(&BodiesSpec {
        tools: vec![
            tool(goggles, Role::Goggles),
            tool(gloves, Role::Gloves),
            tool(rod, Role::Tool),
        ],
        worn: Worn {
            goggles: Some(false),
            gloves: Some([false; 2]),
        },
        ..on_table(vec![beaker(Pose::from_position(at(0.0, 0.0)))])
    })
    .unwrap()
}

fn left(at: Vec3, squeeze: f32) -> Hand {
    hand(Pose::from_position(at), squeeze)
}

/// The right hand closes at `from` and goes to `to` in 20 steps, closed.
fn take(bodies: &mut Bodies, from: Vec3, to: Vec3) {
    bodies.step(&[Hand::ABSENT, left(from, 0.0)], &[]);
    for step in 0..=20 {
        let at = from.lerp(to, step as f32 / 20.0);
        bodies.step(&gripping(Pose::from_position(at)), &[]);
    }
}

#[test]
fn tools_lie_where_they_are() {
    let mut bodies = laboratory();
    let before = bodies.tools().to_vec();
    run(&mut bodies, 60.0, Load::default());
    for (before, after) in before.iter().zip(bodies.tools()) {
        let moved = before.position.distance(after.position);
        assert!(moved < 1e-3, "{moved} m");
    }
    assert_eq!((bodies.poses().len(), bodies.tools().len()), (1, 3));
}

/// A beaker is solid to other glass; a rod that it pushed away, or that pushed it, could not stir.
#[test]
fn a_rod_goes_into_a_beaker() {
    let mut bodies = laboratory();
    let stood = bodies.poses()[0];
    let end = bodies.tools()[ROD].position;
    take(&mut bodies, end, Vec3::new(0.0, TABLE_TOP + 0.05, 0.0));
    assert_eq!(bodies.tool_holder(ROD), Some(1));
    assert_eq!(
        (bodies.holder(0), bodies.tool_holder(GOGGLES)),
        (None, None)
    );
    let tip = bodies.tools()[ROD].position;
    assert!(
        (tip - Vec3::new(0.0, TABLE_TOP + 0.05, 0.0)).length() < 1e-5,
        "{tip}"
    );
    assert!(bodies.poses()[0].position.distance(stood.position) < 1e-4);
    assert_eq!(bodies.strikes(), []);
    // Let go it falls, on the table and not through it.
    run(&mut bodies, 1.0, Load::default());
    let height = bodies.tools()[ROD].position.y - TABLE_TOP;
    assert!((0.0..0.26).contains(&height), "{height} m");
}

#[test]
fn goggles_are_worn_where_the_eyes_are() {
    let head = |x: f32| Pose::new(EYES + Vec3::X * x, Quat::from_rotation_y(0.4));
    for (gap, worn) in [(0.10, true), (0.25, false)] {
        let mut bodies = laboratory();
        bodies.set_head(Some(head(0.0)));
        let at = bodies.tools()[GOGGLES].position;
        // 3 cm of their 6 lie before the middle of their base.
        take(&mut bodies, at, EYES - Vec3::Y * (0.03 + gap));
        assert_eq!(bodies.worn().goggles, Some(false), "they are held");
        bodies.step(&NO_HANDS, &[]);
        // A hand that is away holds on.
        assert_eq!(bodies.tool_holder(GOGGLES), Some(1));
        bodies.step(&[Hand::ABSENT, left(EYES, 0.0)], &[]);
        assert_eq!(bodies.worn().goggles, Some(worn), "{gap} m");
        bodies.set_head(Some(head(0.3)));
        run(&mut bodies, 1.0, Load::default());
        let goggles = bodies.tools()[GOGGLES];
        if worn {
            assert!(goggles.position.distance(head(0.3).position) < 1e-5);
            // The lenses look where the head looks, along its −z.
            let lenses = goggles.transform_vector(Vec3::Y);
            let looks = head(0.3).transform_vector(-Vec3::Z);
            assert!(lenses.dot(looks) > 0.9999, "{lenses}");
            take(&mut bodies, head(0.3).position, Vec3::new(0.5, 1.0, 0.0));
            assert_eq!(bodies.worn().goggles, Some(false), "taken off");
        } else {
            assert!(goggles.position.y < TABLE_TOP + 0.01, "{goggles:?}");
        }
    }
}

#[test]
fn gloves_come_from_their_box_and_go_by_the_other_hand() {
    let mut bodies = laboratory();
    let at = bodies.tools()[GLOVES].position + Vec3::Y * 0.09;
    let far = at + Vec3::Y * 0.5;
    let gloves = |bodies: &Bodies| bodies.worn().gloves.unwrap();
    let mut both = |left_hand: Hand, right: Hand| {
        bodies.step(&[left_hand, right], &[]);
        gloves(&bodies)
    };
    assert_eq!(both(left(at, 0.0), left(far, 0.0)), [false, false]);
    assert_eq!(
        both(left(at, 1.0), left(far, 1.0)),
        [true, false],
        "reaches in"
    );
    assert_eq!(
        both(left(far, 1.0), left(at, 1.0)),
        [true, false],
        "closed before"
    );
    assert_eq!(both(left(far, 0.0), left(at, 0.0)), [true, false]);
    assert_eq!(both(left(far, 0.0), left(at, 1.0)), [true, true]);
    let away = far + Vec3::X * 0.13;
    both(left(far, 0.0), left(away, 0.0));
    assert_eq!(
        both(left(far, 1.0), left(away, 0.0)),
        [true, true],
        "too far"
    );
    both(left(far, 0.0), left(away, 0.0));
    let near = far + Vec3::X * 0.11;
    let by = |x: f32| far - Vec3::X * x;
    for (to, squeeze, expected) in [
        (by(0.10), 1.0, [true, true]),
        (by(0.13), 0.0, [true, true]),
        (by(0.13), 1.0, [true, false]),
    ] {
        both(left(far, 0.0), left(near, 0.0));
        assert_eq!(both(left(far, 1.0), left(near, 0.0)), [true, true]);
        // 0.21 and 0.24 m apart, the second time with an open hand.
        assert_eq!(both(left(to, squeeze), left(near, 0.0)), expected, "{to}");
    }
    // Nobody is at an absent hand.
    both(left(far, 0.0), Hand::ABSENT);
    assert_eq!(both(Hand::ABSENT, left(near, 1.0)), [true, false]);
}

#[test]
fn what_is_worn_is_in_the_snapshot() {
    let mut bodies = laboratory();
    bodies.set_head(Some(Pose::from_position(EYES)));
    let at = bodies.tools()[GOGGLES].position;
    take(&mut bodies, at, EYES);
    bodies.step(&[Hand::ABSENT, left(EYES, 0.0)], &[]);
    let snapshot = bodies.snapshot().unwrap();
    let mut again = laboratory();
    again.restore(&snapshot).unwrap();
    assert_eq!(again.worn().goggles, Some(true));
    for bodies in [&mut bodies, &mut again] {
        bodies.set_head(Some(Pose::from_position(EYES + Vec3::X)));
        bodies.step(&NO_HANDS, &[]);
    }
    assert_eq!(again.tools(), bodies.tools());
}
