//! Motions that nothing survives unless the flask constraint holds, looked at
//! after every substep with the flask's geometry in f64.

use crate::common::*;
use glam::{DVec3, Quat, Vec3};
use vitriol_gpu::Gpu;
use vitriol_sim::flask::{Profile, Region, glassware};
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::placement::Placement;
use vitriol_sim::solver::Particle;
use vitriol_tests::gpu;

/// Places are floats of the stage: within 10 m of its origin off by 1e-6 m at
/// most; the margin that the constraint keeps is 5e-6 m.
const TOLERANCE: f64 = 1e-5;

/// How deep in the liquid space a place of the flask's frame is, metres;
/// below zero, how far from it.
fn depth_inside(profile: &Profile, local: DVec3) -> f64 {
    let r = local.x.hypot(local.z);
    let below_rim = profile.rim_height() - local.y;
    let from_glass = profile.signed_distance_inner(r, local.y.min(profile.rim_height() - 1e-9));
    below_rim.min(from_glass)
}

/// Where a particle is to one flask, with its membership beside it.
#[derive(Clone, Copy)]
struct Place {
    local: DVec3,
    member: bool,
}

/// Events on the way, which show that a test exercised something.
#[derive(Debug, Default)]
struct Events {
    left: usize,
    entered: usize,
    struck: u32,
    inside: usize,
}

struct Drive<'a> {
    profile: &'a Profile,
    setup: Setup,
}

impl<'a> Drive<'a> {
    /// A vessel of `count` particles at `pose`, and `around` in the stage.
    fn new(profile: &'a Profile, pose: Pose, count: usize, around: Vec<Particle>) -> Self {
        let mut particles = water(profile, 0, pose, count);
        particles.extend(around);
        let setup = Setup::new(single_substeps(), vec![profile.clone()], particles);
        Self { profile, setup }
    }

    /// Every substep: members are inside, all others are not, and between
    /// the two leads no way but the mouth.
    fn along(&self, gpu: &Gpu, substeps: u32, pose_at: impl Fn(f64) -> Pose) -> Events {
        let solver = self.setup.solver(gpu);
        let mut events = Events::default();
        let mut before: Vec<Place> = Vec::new();
        for n in 0..=substeps {
            let time = |n: u32| f64::from(n) * SUBSTEP;
            if n > 0 {
                frame(gpu, &solver, &[pose_at(time(n - 1))], &[pose_at(time(n))]);
            }
            let now = self.places(&solver.snapshot().unwrap(), pose_at(time(n)));
            for (i, (was, is)) in before.iter().zip(&now).enumerate() {
                self.passed_the_mouth_alone(was, is, &format!("{i} in substep {n}"));
                events.left += usize::from(was.member && !is.member);
                events.entered += usize::from(!was.member && is.member);
            }
            before = now;
        }
        events.struck = solver.counters().unwrap().flask_constraints;
        events.inside = before.iter().filter(|place| place.member).count();
        events
    }

    fn places(&self, state: &vitriol_sim::solver::SolverState, pose: Pose) -> Vec<Place> {
        let placement = Placement::from(pose);
        let found = particles(state);
        assert_eq!(found.len(), self.setup.particles.len());
        let place = |(i, p): (usize, &Found)| {
            assert!(
                p.present && p.position.is_finite() && p.velocity.is_finite(),
                "{i}: {p:?}"
            );
            let local = placement.to_flask(p.position);
            let depth = depth_inside(self.profile, local);
            let member = p.flask.is_some();
            if member {
                assert!(
                    depth > -TOLERANCE,
                    "{i}, a member, is {depth} m out at {local}"
                );
            } else {
                assert!(
                    depth < TOLERANCE,
                    "{i}, nobody's, is {depth} m inside at {local}"
                );
            }
            Place { local, member }
        };
        found.iter().enumerate().map(place).collect()
    }

    fn passed_the_mouth_alone(&self, was: &Place, is: &Place, who: &str) {
        let outer = match (was.member, is.member) {
            (true, false) => is,
            (false, true) => was,
            _ => return,
        };
        let inner = if was.member { was } else { is };
        // The end that is outside is above the rim, and the way to it passes
        // the rim's plane within the mouth.
        let rim = self.profile.rim_height();
        assert!(
            outer.local.y > rim - TOLERANCE,
            "{who}: {} to {}",
            was.local,
            is.local
        );
        let share = (outer.local.y - rim) / (outer.local.y - inner.local.y).max(1e-12);
        let crossing = outer.local.lerp(inner.local, share.clamp(0.0, 1.0));
        let r = crossing.x.hypot(crossing.z);
        // Inside, a way to beyond the glass is put back to it: the crossing
        // is of the way before that, so only leaving is a straight line.
        if was.member {
            assert!(
                r < self.profile.mouth_radius() + TOLERANCE,
                "{who}: crossed at {r} m"
            );
        }
    }
}

/// Drops in the air around the narrow glass, clear of it and of each other.
fn drops_around(profile: &Profile, pose: Pose, count: usize) -> Vec<Particle> {
    let placement = Placement::from(pose);
    let mut random = Random(3);
    let mut drops: Vec<DVec3> = Vec::new();
    while drops.len() < count {
        let local = random.point(1.0) * DVec3::new(0.12, 0.12, 0.06) + DVec3::Y * 0.04;
        let r = local.x.hypot(local.z);
        let clear = Region::of(profile, local) != Region::Inside
            && profile.signed_distance_glass(r, local.y) > 0.5 * D;
        if clear && drops.iter().all(|drop| drop.distance(local) > D) {
            drops.push(local);
        }
    }
    let still = |local| drop_at(placement.to_stage(local), DVec3::ZERO);
    drops.into_iter().map(still).collect()
}

fn narrow(count: usize, pose: Pose, profile: &Profile) -> Drive<'_> {
    Drive::new(profile, pose, count, drops_around(profile, pose, 200))
}

#[test]
fn shaken_at_50_metres_a_second() {
    let device = gpu::device();
    let profile = narrow_glass();
    // 20 cm to and fro: 46 mm a substep, more than the glass is wide.
    let pose_at = |t: f64| {
        let phase = (t * 50.0 / 0.2).rem_euclid(2.0);
        at((0.2 * (1.0 - (phase - 1.0).abs())) as f32, 0.0, 0.0)
    };
    let events = narrow(400, pose_at(0.0), &profile).along(&device, 150, pose_at);
    assert!(events.inside > 200 && events.struck > 3000, "{events:?}");
}

#[test]
fn shaken_up_and_down() {
    let device = gpu::device();
    let profile = narrow_glass();
    // The floor pushes, the mouth catches what it meets.
    let pose_at = |t: f64| {
        let phase = (t * 5.0 / 0.05).rem_euclid(2.0);
        at(0.0, (0.05 * (1.0 - (phase - 1.0).abs())) as f32, 0.0)
    };
    let events = narrow(400, pose_at(0.0), &profile).along(&device, 150, pose_at);
    assert!(events.left > 20 && events.entered > 5, "{events:?}");
}

#[test]
fn teleported_10_metres() {
    let device = gpu::device();
    let profile = narrow_glass();
    let sideways = Vec3::new(10.0, 0.0, 0.0);
    let (up, down) = (Vec3::new(-6.0, 5.0, 6.0), Vec3::new(0.0, -10.0, 0.0));
    for (to, lean, kept) in [
        (sideways, 0.3, 200..500),
        (up, 0.3, 0..500),
        (down, 0.0, 0..1),
    ] {
        let pose_at = |t: f64| {
            let jumped = if t > 5.5 * SUBSTEP { to } else { Vec3::ZERO };
            Pose::new(jumped, Quat::from_rotation_z(lean))
        };
        let events = narrow(400, pose_at(0.0), &profile).along(&device, 40, pose_at);
        // It takes what it held along, in a heap on its wall or floor from
        // which some spurts out by the mouth; downwards it leaves it behind.
        assert!(kept.contains(&events.inside), "{to}: {events:?}");
        assert_eq!(events.struck > 400, to != down, "{to}: {events:?}");
    }
}

/// In one frame of twelve substeps, whose poses are interpolated.
#[test]
fn teleported_within_a_frame() {
    let device = gpu::device();
    let profile = narrow_glass();
    let setup = Setup::new(
        parameters(),
        vec![profile.clone()],
        water(&profile, 0, Pose::IDENTITY, 400),
    );
    let drive = Drive {
        profile: &profile,
        setup,
    };
    let solver = drive.setup.solver(&device);
    let far = Pose::new(Vec3::new(6.0, 0.0, -8.0), Quat::from_rotation_y(2.0));
    for (before, after) in [(Pose::IDENTITY, far), (far, far), (far, Pose::IDENTITY)] {
        frame(&device, &solver, &[before], &[after]);
        let places = drive.places(&solver.snapshot().unwrap(), after);
        let inside = places.iter().filter(|place| place.member).count();
        assert_eq!(inside, 400);
    }
}

#[test]
fn spun_at_100_radians_a_second() {
    let device = gpu::device();
    let profile = narrow_glass();
    let about = |axis: Vec3| {
        move |t: f64| {
            let turn = Quat::from_axis_angle(axis, (100.0 * t) as f32);
            // Not about its own origin: the rim goes at 10 m/s.
            Pose::new(Vec3::new(0.0, 0.1, 0.0) - turn * Vec3::Y * 0.03, turn)
        }
    };
    let upright = about(Vec3::Y);
    let events = narrow(400, upright(0.0), &profile).along(&device, 240, upright);
    assert!(events.inside > 350 && events.struck > 100, "{events:?}");
    let (mut left, mut struck) = (0, 0);
    for axis in [
        [0.6, 0.0, 0.8],
        [1.0, 0.0, 0.0],
        [0.6, 0.8, 0.0],
        [0.0, 0.6, 0.8],
    ] {
        let over_head = about(Vec3::from_array(axis));
        let events = narrow(400, over_head(0.0), &profile).along(&device, 240, over_head);
        (left, struck) = (left + events.left, struck + events.struck);
    }
    assert!(left > 5 && struck > 2000, "{left} {struck}");
}

#[test]
fn turned_over() {
    let device = gpu::device();
    // A vessel with a neck and a round belly: the lookup table's curved part.
    let profile = glassware::find("round-bottom-250")
        .unwrap()
        .profile(0.4)
        .unwrap();
    let pose_at = |t: f64| {
        let angle = (t / 0.2).min(1.0) * std::f64::consts::PI;
        Pose::new(
            Vec3::new(0.0, 0.3, 0.0),
            Quat::from_rotation_z(angle as f32),
        )
    };
    let drive = Drive::new(
        &profile,
        pose_at(0.0),
        500,
        drops_around(&profile, pose_at(0.0), 100),
    );
    let events = drive.along(&device, 400, pose_at);
    assert!(events.left > 30, "{events:?}");
}

/// A stream beside a glass that moves through it, to and fro at 3 m/s, and
/// under it.
#[test]
fn a_stream_never_passes_into_the_glass_it_meets() {
    let device = gpu::device();
    let profile = narrow_glass();
    let mut stream = Vec::new();
    for i in 0..1000 {
        let site = DVec3::new((i % 4).into(), (i / 16).into(), (i / 4 % 4).into());
        let position = DVec3::new(0.018, 0.015, -0.004) + site * D;
        stream.push(drop_at(position, DVec3::NEG_Y));
    }
    let drive = Drive::new(&profile, Pose::IDENTITY, 0, stream);
    let pose_at = |t: f64| {
        let x = 0.03 * (3.0 * t / 0.03).sin();
        Pose::new(
            Vec3::new(x as f32, 0.0, 0.0),
            Quat::from_rotation_z((4.0 * t) as f32),
        )
    };
    let events = drive.along(&device, 250, pose_at);
    // Particles that enter do so by the mouth: `along` has seen to that.
    assert!(events.struck > 200, "{events:?}");
}
