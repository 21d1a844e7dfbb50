//! Census of the liquid: against counts of a snapshot on the host, and against the arranged moves.

use crate::chemistry::bubbles::{beaker, of};
use crate::chemistry::setup::bubbly;
use crate::chemistry::spray::spraying;
use crate::common::*;
use glam::{DVec2, DVec3, Quat, Vec3};
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_shaders::layout::Drops;
use vitriol_sim::chemistry::table::SolutionTable;
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{
    Census, Ground, Held, LYING, Particle, Place, SCALDS, Skin, SkinPart, Solver, SolverState,
};
use vitriol_tests::gpu;

const FRAME: f64 = 1.0 / 90.0;

pub fn look(gpu: &Gpu, solver: &Solver, skin: &[SkinPart]) -> Census {
    let mut rec = gpu.recorder(QueueKind::Main).unwrap();
    let record = solver.record_census(&mut rec, skin, FRAME).unwrap();
    gpu.submit(rec).unwrap().wait().unwrap();
    record.get().unwrap()
}

/// A glass, and beside it a table's edge and the floor below.
fn over_all(setup: &mut Setup) {
    setup.ground = Ground {
        floor: -0.10,
        table: Some((-0.004, DVec2::new(0.0, 0.0), DVec2::new(0.12, 0.2))),
        scale: 1.0,
    };
}

/// A block of 5 × 5 × 5 drops about `middle` that fall at 1.5 m/s.
fn block(middle: DVec3, acid: f64, temperature: f64) -> Vec<Particle> {
    let steps = || (-2..=2).map(|n| f64::from(n) * D);
    let all =
        steps().flat_map(|x| steps().flat_map(move |y| steps().map(move |z| DVec3::new(x, y, z))));
    let drop = |offset: DVec3| Particle {
        acid,
        temperature,
        ..drop_at(middle + offset, DVec3::new(0.0, -1.5, 0.0))
    };
    all.map(drop).collect()
}

/// Place of each particle by identity: flask, then air, table and floor, written down anew.
fn places(state: &SolverState, setup: &Setup) -> Vec<usize> {
    let (flasks, lying) = (setup.flasks.len(), LYING * H);
    let (top, centre, size) = setup.ground.table.unwrap();
    let place = |found: &Found| {
        let x = found.position;
        let aside = (DVec2::new(x.x, x.z) - centre).abs();
        let over_table = aside.x <= 0.5 * size.x && aside.y <= 0.5 * size.y;
        match found.flask {
            Some(flask) => flask,
            None if over_table && (x.y - top).abs() < lying => flasks + 1,
            None if x.y < setup.ground.floor + lying => flasks + 2,
            None => flasks,
        }
    };
    particles(state).iter().map(place).collect()
}

fn seen(census: &Census) -> Vec<Held> {
    let mut all = census.flasks.clone();
    all.extend([census.air, census.table, census.floor]);
    all
}

/// Three blocks fall: into a glass, beside it on the table, and past the table on the floor.
#[test]
fn it_says_where_the_liquid_is_and_what_came_there() {
    let device = gpu::device();
    let profile = narrow_glass();
    let mut drops = water(&profile, 0, at(0.0, 0.0, 0.0), 300);
    drops.iter_mut().for_each(|it| it.temperature = 60.0);
    drops.extend(block(DVec3::new(0.0, 0.075, 0.0), 0.9, 30.0));
    drops.extend(block(DVec3::new(0.04, 0.05, 0.0), 0.5, 20.0));
    drops.extend(block(DVec3::new(0.09, 0.05, 0.0), 0.1, 20.0));
    let mut setup = Setup::new(of(bubbly(), parameters()), vec![profile], drops);
    over_all(&mut setup);
    let solver = setup.solver(&device);
    let mut before = places(&solver.snapshot().unwrap(), &setup);
    let first = seen(&look(&device, &solver, &[]));
    assert!(first.iter().all(|place| place.came.particles == 0));
    assert_eq!(
        first.iter().map(|it| it.particles).collect::<Vec<_>>(),
        [300, 375, 0, 0]
    );
    let table = SolutionTable::new();
    let mut came = [0; 4];
    for _ in 0..14 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        let state = solver.snapshot().unwrap();
        let now = places(&state, &setup);
        let found = particles(&state);
        let heat = heat_of(&state);
        let census = seen(&look(&device, &solver, &[]));
        for (place, held) in census.iter().enumerate() {
            let here: Vec<_> = (0..now.len()).filter(|&n| now[n] == place).collect();
            assert_eq!(held.particles as usize, here.len(), "place {place}");
            let mean = |of: &dyn Fn(usize) -> f64, from: &[usize]| {
                from.iter().map(|&n| of(n)).sum::<f64>() / from.len().max(1) as f64
            };
            let heat = |n: usize, word: usize| f64::from(heat[n][word]);
            // Shares are of 1/65,536: 6 mK, and 0.1 mm and 0.5 mm/s.
            let warm = mean(&|n| heat(n, 0), &here);
            let acid = mean(&|n| heat(n, 1), &here);
            if !here.is_empty() {
                assert!(
                    (f64::from(held.temperature.unwrap()) - warm).abs() < 0.01,
                    "{warm} {held:?}"
                );
                assert!(
                    (f64::from(held.acid) - acid).abs() < 2e-5,
                    "{acid} {held:?}"
                );
                let hottest = here.iter().map(|&n| heat(n, 0)).fold(f64::MIN, f64::max);
                let seen = f64::from(held.hottest.unwrap());
                assert!((seen - hottest).abs() < 0.01, "{hottest} {held:?}");
                let above = |n: usize| heat(n, 0) - table.at(heat(n, 1)).boiling_point;
                let superheat = here.iter().map(|&n| above(n)).fold(f64::MIN, f64::max);
                let seen = f64::from(held.superheat.unwrap());
                // A share is 8 mK; the device interpolates its table in f32.
                assert!((seen - superheat).abs() < 0.02, "{superheat} {held:?}");
            }
            let new: Vec<_> = here
                .iter()
                .copied()
                .filter(|&n| before[n] != place)
                .collect();
            came[place] += new.len();
            assert_eq!(held.came.particles as usize, new.len(), "to place {place}");
            if !new.is_empty() {
                let speed = mean(&|n| found[n].velocity.length(), &new);
                assert!((held.came.speed - speed).abs() < 5e-4, "{speed} {held:?}");
                let warm = mean(&|n| heat(n, 0), &new);
                let seen = held.came.temperature.unwrap();
                assert!((seen - warm).abs() < 0.01, "{warm} {held:?}");
                let middle =
                    new.iter().map(|&n| found[n].position).sum::<DVec3>() / new.len() as f64;
                assert!(
                    held.came.position.distance(middle) < 2e-4,
                    "{middle} {held:?}"
                );
            }
        }
        before = now;
    }
    // The arranged moves did happen: whole blocks came to their places.
    assert!(
        came[0] >= 100 && came[2] >= 100 && came[3] >= 100,
        "{came:?}"
    );
}

/// A glass is tipped out over a dish and the table beside it, on which it splashes: the liquid that came there is of that glass. A block
/// that
/// had never been in a flask is of none.
#[test]
fn it_says_from_which_flask_it_came() {
    let device = gpu::device();
    let dish = Profile::new(&[[0.0, 0.018], [0.02, 0.018]], 0.002).unwrap();
    let glass = narrow_glass();
    let tipped = |turns: f64| {
        Pose::new(
            Vec3::new(-0.03, 0.1, 0.0),
            Quat::from_rotation_z(-turns as f32),
        )
    };
    let mut drops = water(&glass, 1, tipped(0.0), 600);
    drops.iter_mut().for_each(|it| it.acid = 0.3);
    drops.extend(block(DVec3::new(-0.04, 0.03, 0.06), 0.5, 20.0));
    let mut setup = Setup::new(of(bubbly(), parameters()), vec![dish, glass], drops);
    over_all(&mut setup);
    let stands = at(0.035, 0.0, 0.0);
    let solver = setup.solver(&device);
    look(&device, &solver, &[]);
    let flasks = setup.flasks.len();
    let first = places(&solver.snapshot().unwrap(), &setup);
    let count = first.len();
    // By identity, written down anew: the place, the flask that it was in last, and whether it has lain since.
    let mut before = first.clone();
    let mut origin: Vec<_> = first
        .iter()
        .map(|&it| (it < flasks).then_some(it))
        .collect();
    let mut lain = vec![false; count];
    let (mut fell, mut went) = (0, 0);
    for number in 0..36 {
        let turn = |number: u32| tipped(2.4 * f64::from(number.min(18)) / 18.0);
        let [from, to] = [number, number + 1].map(|number| [stands, turn(number)]);
        frame(&device, &solver, &from, &to);
        let state = solver.snapshot().unwrap();
        let (now, heat) = (places(&state, &setup), heat_of(&state));
        let census = look(&device, &solver, &[]);
        let mut expected = vec![[(0, 0.0); 2]; flasks + 3];
        for n in 0..count {
            if now[n] != before[n] {
                let lay = now[n] > flasks && std::mem::replace(&mut lain[n], true);
                if let (Some(flask), false) = (origin[n], lay) {
                    expected[now[n]][flask].0 += 1;
                    expected[now[n]][flask].1 += f64::from(heat[n][1]);
                }
            }
            if now[n] < flasks {
                (origin[n], lain[n]) = (Some(now[n]), false);
            }
        }
        let all = [
            Place::Flask(0),
            Place::Flask(1),
            Place::Air,
            Place::Table,
            Place::Floor,
        ];
        for (place, expected) in all.into_iter().zip(&expected) {
            for (flask, (particles, acid)) in expected.iter().enumerate() {
                let moved = census.moved(place, flask);
                assert_eq!(
                    moved.particles, *particles,
                    "{number}: from {flask} to {place:?}"
                );
                let mean = acid / f64::from((*particles).max(1));
                // Mean over volumes, of which those of so close mixtures are within 2 %.
                assert!((moved.acid - mean).abs() < 0.005, "{moved:?} {mean}");
            }
        }
        fell += expected[flasks + 1][1].0;
        went += expected[0][1].0;
        before = now;
    }
    // The arranged moves did happen.
    assert!(fell > 100 && went > 100, "{fell} {went}");
}

/// Temperature and acid by identity.
fn heat_of(state: &SolverState) -> Vec<[f32; 4]> {
    let mut all: Vec<_> = state.tags.iter().zip(&state.heat).collect();
    all.sort_by_key(|(tag, _)| tag[1]);
    all.into_iter().map(|(_, heat)| *heat).collect()
}

/// Volumes are those of the liquid: 96 % acid has 1835.5 kg/m³ at 20 °C (Perry). And they are what the picture draws with, also where
/// mixing and its heat have changed them.
#[test]
fn volumes_are_of_the_liquid() {
    let device = gpu::device();
    let profile = narrow_glass();
    let mut acid = water(&profile, 0, at(0.0, 0.0, 0.0), 800);
    acid.iter_mut().for_each(|it| it.acid = 0.96);
    let volume = |setup: &Setup, mixes: usize| {
        let solver = setup.solver(&device);
        frames(&device, &solver, &[Pose::IDENTITY], mixes);
        let volume = look(&device, &solver, &[]).flasks[0].volume;
        let state = solver.snapshot().unwrap();
        let mass: f64 = (0..800).map(|slot| state.mass_of(slot)).sum();
        // What the picture draws with.
        let volumes = device.read::<[f32; 4]>(solver.volumes().unwrap()).unwrap();
        let drawn: f64 = volumes
            .iter()
            .take(800)
            .map(|words| f64::from(words[0]))
            .sum();
        let v0 = setup.parameters.particle_volume();
        assert!(
            (volume / (drawn * v0) - 1.0).abs() < 1e-5,
            "{volume} {drawn}"
        );
        (mass * setup.parameters.particle_mass() / volume, volume)
    };
    let mut setup = Setup::new(of(bubbly(), parameters()), vec![profile], acid);
    let (density, _) = volume(&setup, 0);
    // The program's fit of the table is within 0.5 %.
    assert!((density / 1835.5 - 1.0).abs() < 0.005, "{density}");
    for (n, particle) in setup.particles.iter_mut().enumerate() {
        particle.acid = 0.96 * f64::from(n as u32 % 2);
    }
    let [before, after] = [0, 9].map(|mixes| volume(&setup, mixes).1);
    // Otherwise the comparison above would be of one with one.
    assert!((after / before - 1.0).abs() > 1e-3, "{before} {after}");
}

fn hand(whose: Skin, from: Vec3, to: Vec3) -> SkinPart {
    SkinPart {
        whose,
        ends: [from, to],
        radii: [0.012, 0.012],
    }
}

/// Acid falls through a hand, and is counted once however long it takes; water does not hurt, and acid in a glass is in a glass.
#[test]
fn acid_that_touches_skin_is_counted_once() {
    let device = gpu::device();
    let profile = narrow_glass();
    let mut drops = water(&profile, 0, at(0.0, 0.0, 0.0), 200);
    drops.iter_mut().for_each(|it| it.acid = 0.9);
    drops.extend(block(DVec3::new(0.06, 0.05, 0.0), 0.9, 20.0));
    drops.extend(block(DVec3::new(-0.06, 0.05, 0.0), 0.02, 20.0));
    let mut law = bubbly();
    law.mixing.turbulence = 0.0;
    let setup = Setup::new(of(law, parameters()), vec![profile], drops);
    let solver = setup.solver(&device);
    let across = |x: f32, y: f32| [Vec3::new(x, y, -0.03), Vec3::new(x, y, 0.03)];
    let ([a, b], [c, d], [e, f]) = (across(0.06, 0.02), across(-0.06, 0.02), across(0.0, 0.01));
    let skin = [
        hand(Skin::Left, a, b),
        hand(Skin::Right, c, d),
        hand(Skin::Face, e, f),
    ];
    let mut came = [0; 3];
    let mut in_touch = 0;
    let (mut speed, mut acid) = (0.0, 0.0);
    for _ in 0..8 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        let census = look(&device, &solver, &skin);
        for (sum, held) in came.iter_mut().zip(&census.skin) {
            *sum += held.came.particles;
        }
        in_touch += census.skin[0].particles;
        let left = &census.skin[0].came;
        if left.particles > 0 {
            (speed, acid) = (left.speed, left.acid);
        }
    }
    assert_eq!(came, [125, 0, 0]);
    assert_eq!(hot_water(&device, SCALDS as f32 - 1.0), 0);
    assert_eq!(hot_water(&device, SCALDS as f32 + 1.0), 125);
    // At 1.6 m/s through 26 mm: a frame and a half.
    assert!(in_touch > 150, "{in_touch}");
    // 1.5 m/s, and some more by falling up to 45 mm: v² = 1.5² + 2 g h.
    assert!(speed > 1.5 && speed < 1.78, "{speed}");
    assert!((acid - 0.9).abs() < 0.02, "{acid}");
}

/// Particles of hot water without acid that touch a hand.
fn hot_water(device: &Gpu, celsius: f32) -> u32 {
    let drops = block(DVec3::new(0.06, 0.03, 0.0), 0.0, f64::from(celsius));
    let setup = Setup::new(of(bubbly(), parameters()), vec![narrow_glass()], drops);
    let solver = setup.solver(device);
    let skin = [hand(
        Skin::Left,
        Vec3::new(0.06, 0.03, -0.03),
        Vec3::new(0.06, 0.03, 0.03),
    )];
    let census = look(device, &solver, &skin);
    assert_eq!(census.skin[0].came.particles, census.skin[0].particles);
    census.skin[0].came.particles
}

/// At 3 m/s a drop is through a finger between two looks, and is counted all the same; one that comes out of a glass is not taken to
/// have been outside of it.
#[test]
fn what_is_faster_than_looks_is_counted_too() {
    let device = gpu::device();
    let profile = narrow_glass();
    let mut drops = block(DVec3::new(0.06, 0.06, 0.0), 0.9, 20.0);
    drops.iter_mut().for_each(|it| it.velocity *= 2.0);
    let mut law = bubbly();
    law.mixing.turbulence = 0.0;
    let setup = Setup::new(of(law, parameters()), vec![profile], drops);
    let solver = setup.solver(&device);
    let ends = [Vec3::new(0.06, 0.03, -0.03), Vec3::new(0.06, 0.03, 0.03)];
    let mut skin = [hand(Skin::Left, ends[0], ends[1])];
    skin[0].radii = [0.008; 2];
    look(&device, &solver, &skin);
    let mut came = 0;
    for _ in 0..4 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        came += look(&device, &solver, &skin).skin[0].came.particles;
    }
    // A block 12.5 mm wide, of which all but the outermost pass a finger 16 mm wide.
    assert_eq!(came, 125);
}

/// A glass of water over table and floor, and a drop of 80 % acid in the air, of a hundredth of a particle's mass, at 1.5 times its density.
pub fn with_a_drop(device: &Gpu, position: [f32; 3], velocity: [f32; 3]) -> (Setup, Solver) {
    let profile = Profile::new(&[[0.0, 0.025], [0.06, 0.025]], 0.002).unwrap();
    let liquid = water(&profile, 0, at(0.0, 0.0, 0.0), 300);
    let mut setup = Setup::new(of(spraying(bubbly()), parameters()), vec![profile], liquid);
    over_all(&mut setup);
    let solver = setup.solver(device);
    let mut state = solver.snapshot().unwrap();
    state.drops_mut()[4] = Drops {
        position,
        velocity,
        mass: 0.01,
        acid: 0.008,
        radius: 1e-4,
        density: 1500.0,
        memberships: 1,
        ..Drops::default()
    };
    solver.restore(&state).unwrap();
    (setup, solver)
}

/// Drops that bubbles threw are no particles: one that flies into a hand is counted in the frame in which it comes there.
#[test]
fn thrown_drops_touch_skin_too() {
    let device = gpu::device();
    let (setup, solver) = with_a_drop(&device, [0.1, 0.1, 0.0], [1.0, 0.0, 0.0]);
    let x = Vec3::new(0.14, 0.1, 0.0);
    let skin = [hand(Skin::Face, x, x + 0.05 * Vec3::Z)];
    let mut came = Vec::new();
    look(&device, &solver, &skin);
    for _ in 0..8 {
        frames(&device, &solver, &[Pose::IDENTITY], 1);
        let census = look(&device, &solver, &skin);
        let face = census.skin[2];
        came.push(face.came.particles);
        assert_eq!(census.landed.len(), face.came.particles as usize);
        let sour = census.landed.iter().all(|it| (it.acid - 0.8).abs() < 1e-4);
        assert!(sour, "{:?}", census.landed);
        if face.came.particles > 0 {
            assert!((face.came.acid - 0.8).abs() < 0.001, "{face:?}");
            // A share is of 1/65,536 of eight volumes.
            let volume = face.came.volume / setup.parameters.particle_volume();
            assert!((volume - 0.01 / 1.5).abs() < 1e-4, "{volume}");
        }
    }
    assert_eq!(came.iter().sum::<u32>(), 1, "{came:?}");
}

/// A bubble of steam in cold water collapses, and one in water at its boiling point comes up and bursts.
#[test]
fn bubbles_that_collapse_are_told_from_those_that_burst() {
    let device = gpu::device();
    for (temperature, expected) in [(97.0, [1, 0]), (100.0, [0, 1])] {
        let setup = beaker(temperature, bubbly());
        let solver = setup.solver(&device);
        let mut state = solver.snapshot().unwrap();
        let top = particles(&state)
            .iter()
            .map(|it| it.position.y)
            .fold(0.0, f64::max);
        let place = DVec3::new(0.0, top - 0.03, 0.0);
        state.put_bubble(
            &setup.parameters,
            7,
            1,
            [place, DVec3::ZERO],
            [1.5e-3, 100.0],
        );
        solver.restore(&state).unwrap();
        let bubbles = look(&device, &solver, &[]).flasks[0].bubbles;
        assert_eq!((bubbles.here.count, bubbles.born), (1, 0));
        assert!((bubbles.here.radius - 1.5e-3).abs() < 1e-6, "{bubbles:?}");
        let sphere = 4.0 / 3.0 * std::f64::consts::PI * 1.5e-3_f64.powi(3);
        // A share of eight particles in 65,536.
        assert!(
            (bubbles.volume - sphere).abs() < 1e-3 * sphere,
            "{bubbles:?}"
        );
        let (mut ends, mut radius, mut frames_of_it) = ([0, 0], 0.0, 0);
        for _ in 0..(0.6 / setup.parameters.frame_time) as u32 {
            frames(&device, &solver, &[Pose::IDENTITY], 1);
            frames_of_it += 1;
            let bubbles = look(&device, &solver, &[]).flasks[0].bubbles;
            ends[0] += bubbles.collapsed.count;
            ends[1] += bubbles.burst.count;
            radius = f64::max(radius, bubbles.collapsed.radius.max(bubbles.burst.radius));
            if ends[0] + ends[1] > 0 {
                break;
            }
        }
        assert_eq!(ends, expected, "at {temperature} °C");
        // Its largest radius, not the one at the last look.
        assert!(frames_of_it > 2, "{frames_of_it}");
        assert!(radius > 1.35e-3, "{radius}");
    }
}

/// A look is no part of the simulation.
#[test]
fn looking_changes_no_bit() {
    let device = gpu::device();
    let setup = beaker(100.0, spraying(bubbly()));
    let run = |looks: bool| {
        let solver = setup.solver(&device);
        for _ in 0..6 {
            frames(&device, &solver, &[Pose::IDENTITY], 1);
            if looks {
                look(&device, &solver, &[hand(Skin::Left, Vec3::ZERO, Vec3::Y)]);
            }
        }
        solver.snapshot().unwrap()
    };
    assert_eq!(run(false), run(true));
}
