//! A free flask and liquid whose reaction comes two steps later.

use super::*;

const LIQUID: f32 = 0.25;
const LIQUID_CENTRE: Vec3 = Vec3::new(0.0, 0.035, 0.0);

/// Liquid as a rigid slug in a vessel that it fits with a millimetre of play: it moves freely
/// between the walls and takes on their velocity where it meets one.
struct Slug {
    position: Vec3,
    velocity: Vec3,
}

impl Slug {
    const PLAY: f32 = 1e-3;

    fn new(flask: Pose) -> Self {
        Self {
            position: flask.position,
            velocity: Vec3::ZERO,
        }
    }

    /// Moves with the flask's new pose; the impulse on the flask. Open at the top.
    fn advance(&mut self, flask: Pose) -> Vec3 {
        let free = self.velocity - Vec3::Y * G * STEP;
        let target = self.position + free * STEP - flask.position;
        let kept = Vec3::new(
            target.x.clamp(-Self::PLAY, Self::PLAY),
            target.y.max(0.0),
            target.z.clamp(-Self::PLAY, Self::PLAY),
        );
        let position = flask.position + kept;
        self.velocity = (position - self.position) / STEP;
        self.position = position;
        (free - self.velocity) * LIQUID
    }
}

/// Steps flask 0 with a slug in it whose loads arrive two steps later.
struct Coupled {
    bodies: Bodies,
    slug: Slug,
    delayed: [Vec3; 2],
}

impl Coupled {
    fn new(bodies: Bodies) -> Self {
        let slug = Slug::new(bodies.poses()[0]);
        let weight = Vec3::Y * (-LIQUID * G * STEP);
        Self {
            bodies,
            slug,
            delayed: [weight; 2],
        }
    }

    fn step(&mut self, hands: &[Hand; 2]) -> f32 {
        let load = Load {
            impulse: self.delayed[1],
            angular_impulse: LIQUID_CENTRE.cross(self.delayed[1]),
            liquid_mass: LIQUID,
            liquid_centre: LIQUID_CENTRE,
        };
        self.bodies.step(hands, &[load]);
        let impulse = self.slug.advance(self.bodies.poses()[0]);
        self.delayed = [impulse, self.delayed[0]];
        self.slug.position.distance(self.bodies.poses()[0].position)
    }
}

/// Let go in the air, flask and liquid fall together: neither is thrown away from the other.
#[test]
fn a_full_flask_falls_with_its_liquid() {
    let start = above_table(0.5);
    let mut coupled = Coupled::new(world(vec![beaker(start)]));
    for _ in 0..20 {
        coupled.step(&gripping(start));
    }
    let open = [Hand::ABSENT, hand(start, 0.0)];
    for step in 1..=25 {
        let apart = coupled.step(&open);
        assert!(apart < 2e-3, "step {step}: {apart} m apart");
    }
    let t = 25.0 * STEP;
    let fallen = start.position.y - coupled.bodies.poses()[0].position.y;
    assert!((fallen - 0.5 * G * t * t).abs() < 3e-3, "fell {fallen} m");
}

/// Set down in motion, the flask slides to rest with the deceleration μg that
/// it has with any load in it.
#[test]
fn a_full_flask_slides_to_rest() {
    let start = Pose::from_position(Vec3::new(-0.5, TABLE_TOP, 0.0));
    let mut coupled = Coupled::new(world(vec![beaker(start)]));
    let speed = 0.5;
    for step in 0..20 {
        let x = speed * STEP * step as f32;
        coupled.step(&gripping(Pose::from_position(start.position + Vec3::X * x)));
    }
    let released = coupled.bodies.poses()[0].position;
    let open = [Hand::ABSENT, hand(start, 0.0)];
    let mut fastest: f32 = 0.0;
    for _ in 0..90 {
        coupled.step(&open);
        fastest = fastest.max(coupled.bodies.velocity(0).unwrap().linear.length());
    }
    let slid = coupled.bodies.poses()[0].position - released;
    let expected = speed * speed / (2.0 * 0.4 * G);
    // Play of 1 mm and two steps of delay (11 mm at this speed) are what a slug may differ by.
    assert!(
        (slid.x - expected).abs() < 8e-3,
        "slid {slid}, not {expected}"
    );
    assert!(fastest < speed * 1.3, "driven to {fastest} m/s");
    let end = coupled.bodies.poses()[0].position;
    for _ in 0..180 {
        coupled.step(&open);
    }
    assert!((coupled.bodies.poses()[0].position - end).length() < 1e-3);
}

/// A load that is not finite is no load: the flask goes on falling.
#[test]
fn a_broken_load_is_ignored() {
    let start = above_table(0.5);
    let mut bodies = world(vec![beaker(start)]);
    let broken = Load {
        impulse: Vec3::splat(f32::NAN),
        ..Load::default()
    };
    let negative = Load {
        liquid_mass: -1.0,
        ..Load::default()
    };
    run(&mut bodies, 0.1, broken);
    run(&mut bodies, 0.1, negative);
    let fallen = start.position - bodies.poses()[0].position;
    // Less the steps' rounding of 0.2 s.
    assert!((fallen.y - 0.5 * G * 0.2 * 0.2).abs() < 2e-3);
    assert!(fallen.x == 0.0 && fallen.z == 0.0);
}

/// An impulse through the centre of mass, given with its moment about the
/// flask's origin as [`Load`] has it, moves the flask by J/m and does not turn it.
#[test]
fn an_impulse_through_the_centre_of_mass_does_not_turn() {
    let pose = tilted(above_table(0.5), 0.5);
    let mut bodies = world(vec![beaker(pose)]);
    let (side, base) = (2.0 * HEIGHT, RADIUS);
    let centre = axis(pose) * (0.5 * HEIGHT * side / (side + base));
    let impulse = Vec3::new(0.02, 0.0, 0.05);
    let load = Load {
        impulse,
        angular_impulse: centre.cross(impulse),
        ..Load::default()
    };
    bodies.step(&NO_HANDS, &[load]);
    let found = bodies.velocity(0).unwrap();
    let expected = impulse / GLASS - Vec3::Y * G * STEP;
    assert!((found.linear - expected).length() < 1e-5, "{found:?}");
    assert!(found.angular.length() < 1e-4, "{found:?}");
}
