//! Water on cold glass: one place's law by formulas and integrations in f64 that share nothing with it, and where it goes.

use crate::common::at;
use bytemuck::cast_slice;
use glam::{Quat, Vec3};
use vitriol_gpu::{Buffer, ComputePipeline, QueueKind};
use vitriol_shaders::layout::{Dew, DewRow, Flask, FlaskPose, Puff, Step};
use vitriol_shaders::{Library, sim};
use vitriol_sim::chemistry::dew::{AROUND, Air, QUANTUM, UP, flux, rows, still, swept};
use vitriol_sim::chemistry::puff::dew_point;
use vitriol_sim::chemistry::wall_heat::RINGS;
use vitriol_sim::flask::Profile;
use vitriol_sim::pose::Pose;
use vitriol_tests::gpu::{self, Watched};

const RADIUS: f64 = 0.03;
const HEIGHT: f64 = 0.1;
const PLACES: usize = AROUND * UP;

/// Borosilicate glass 3.3: kg/m³ times J/(kg K).
const GLASS: f64 = 2230.0 * 830.0;
/// Latent heat of water at 20 °C (steam tables), J/kg.
const LATENT: f64 = 2.4535e6;
/// Heat transfer to still air, its density and heat capacity, and Lewis' number of vapour in air to the power of 2/3.
const STILL: f64 = 6.0 / (1.20 * 1006.0 * 0.8973);

/// Vapour's pressure over water, Pa: Buck (1981), within 0.1 % up to 60 °C.
fn saturated(t: f64) -> f64 {
    611.21 * ((18.678 - t / 234.5) * (t / (257.14 + t))).exp()
}

/// kg/(m² s) that condenses on a wall out of vapour of `pressure` in air of `warm` °C.
fn condenses(wall: f64, pressure: f64, warm: f64, transfer: f64) -> f64 {
    let all = 101_325.0;
    let density = all / (461.5 * (273.15 + 0.5 * (wall + warm)));
    transfer * density * ((all - saturated(wall)) / (all - pressure)).ln()
}

/// A cylinder's places, alone on a device, in a frame of `time` seconds.
struct Rig {
    pass: ComputePipeline,
    rise: ComputePipeline,
    /// puffs, dew, taken, wetted, glass, dew_rows, flasks, poses, made.
    buffers: [Buffer; 9],
    areas: Vec<f64>,
    gpu: Watched,
}

impl Rig {
    /// Flasks at `poses` whose walls are `wall` metres thick and give `loss` W/(m² K) to the air.
    fn new(poses: &[Pose], wall: f64, loss: f64, time: f64) -> Self {
        let gpu = gpu::device();
        let profile = Profile::new(&[[0.0, RADIUS], [HEIGHT, RADIUS]], wall).unwrap();
        let constants = [
            ("PUFFS", 2.0),
            ("FRAME_TIME", time),
            ("AMBIENT", 20.0),
            ("ROOM_VAPOUR", 0.5 * saturated(20.0)),
            ("STILL", still()),
            ("SWEPT", swept()),
            ("DEW_LOSS", loss),
            ("LATENT", LATENT),
        ];
        let library = Library::watching();
        let compiled = library.compile(&sim::DEW, "main", &constants).unwrap();
        // Puffs that neither rise nor grow.
        let still = [
            ("PUFFS", 2.0),
            ("DEW", 1.0),
            ("STEPS", 0.0),
            ("AMBIENT", 20.0),
        ];
        let risen = library.compile(&sim::RISE, "main", &still).unwrap();
        let flasks = poses.len();
        let rows = rows(&profile);
        let flask = Flask {
            floor: profile.floor_height() as f32,
            rim: profile.rim_height() as f32,
            outer: profile.outer_radius() as f32,
            ..Flask::default()
        };
        let of_rows = rows.iter().map(|row| DewRow {
            height: row.height as f32,
            radius: row.radius as f32,
            area: row.area as f32,
            capacity: row.capacity as f32,
        });
        let of_rows: Vec<DewRow> = of_rows.collect();
        let of_poses = poses.iter().map(|pose| FlaskPose {
            position: pose.position.extend(0.0).to_array(),
            orientation: pose.orientation.to_array(),
        });
        let of_poses: Vec<FlaskPose> = of_poses.collect();
        let buffer = |name, data: &[u8]| {
            let buffer = Buffer::storage(&gpu, name, data.len() as u64).unwrap();
            gpu.write(&buffer, data).unwrap();
            buffer
        };
        let buffers = [
            buffer("puffs", cast_slice(&[Puff::default(); 2])),
            buffer("dew", cast_slice(&vec![Dew::default(); PLACES * flasks])),
            buffer("taken", cast_slice(&[0_u32; 2])),
            buffer("wetted", cast_slice(&vec![0_u32; UP * flasks])),
            buffer("glass", cast_slice(&vec![[20.0_f32, 0.0]; RINGS * flasks])),
            buffer("dew_rows", cast_slice(&of_rows.repeat(flasks))),
            buffer("flasks", cast_slice(&vec![flask; flasks])),
            buffer("poses", cast_slice(&of_poses)),
            // The next quantum that is washed off carries.
            buffer("made", cast_slice(&[7, 7, 7, 7, u32::MAX, 0])),
        ];
        Self {
            pass: ComputePipeline::new(&gpu, &compiled).unwrap(),
            rise: ComputePipeline::new(&gpu, &risen).unwrap(),
            areas: rows.iter().map(|row| row.area).collect(),
            buffers,
            gpu,
        }
    }

    fn puffs(&self, puffs: [Puff; 2]) {
        self.gpu.write(&self.buffers[0], &puffs).unwrap();
    }

    fn wet(&self, rows: &[u32]) {
        self.gpu.write(&self.buffers[3], rows).unwrap();
    }

    /// A film of as many kg/m² everywhere.
    fn film(&self, mass: f64) {
        let mut dew: Vec<Dew> = self.gpu.read(&self.buffers[1]).unwrap();
        for (place, dew) in dew.iter_mut().enumerate() {
            dew.water = (mass * self.areas[place / AROUND % UP] / QUANTUM).round() as u32;
        }
        self.gpu.write(&self.buffers[1], &dew).unwrap();
    }

    fn run(&self, frames: usize, rises: bool) {
        let names = [
            "puffs", "dew", "taken", "wetted", "glass", "dew_rows", "flasks", "poses", "made",
        ];
        let places: Vec<Dew> = self.gpu.read(&self.buffers[1]).unwrap();
        for _ in 0..frames {
            let mut rec = self.gpu.recorder(QueueKind::Main).unwrap();
            let pass = rec.pass(&self.pass).constants(&Step::default());
            let pass = names
                .iter()
                .zip(&self.buffers)
                .fold(pass, |pass, (name, buffer)| {
                    if ["dew", "taken", "wetted", "made"].contains(name) {
                        pass.write(name, buffer)
                    } else {
                        pass.read(name, buffer)
                    }
                });
            pass.workgroups([(places.len() / 256) as u32, 1, 1])
                .unwrap();
            if rises {
                let rise = rec.pass(&self.rise).write("puffs", &self.buffers[0]);
                rise.write("taken", &self.buffers[2])
                    .invocations(2)
                    .unwrap();
            }
            self.gpu.submit(rec).unwrap().wait().unwrap();
        }
    }

    fn dew(&self) -> Vec<Dew> {
        self.gpu.read(&self.buffers[1]).unwrap()
    }

    fn mass(&self) -> f64 {
        let quanta = self
            .dew()
            .iter()
            .map(|place| u64::from(place.water))
            .sum::<u64>();
        quanta as f64 * QUANTUM
    }
}

/// A puff saturated at `warm` °C, so wide (m) and with so much air (kg) that moves up at `speed` (m/s).
fn saturated_puff(position: Vec3, warm: f64, [radius, air, speed]: [f64; 3]) -> Puff {
    let pressure = saturated(warm);
    let water = air * 287.05 / 461.5 * pressure / (101_325.0 - pressure);
    let displaced = 1.2 * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
    Puff {
        position: position.to_array(),
        radius: radius as f32,
        air: air as f32,
        water: water as f32,
        momentum: ((air + water + 0.5 * displaced) * speed) as f32,
        ..Puff::default()
    }
}

/// A wall of 2 mm at 20 °C in steam that is saturated at 60 and 80 °C, at rest and in flow: the water on it after one second and two, and
/// its temperature.
#[test]
fn steam_condenses_on_a_cold_wall_by_stefans_law_and_warms_it() {
    for (warm, speed) in [(60.0, 0.0), (80.0, 0.0), (60.0, 1.0)] {
        let (time, radius) = (1.0 / 90.0, 0.06);
        let rig = Rig::new(&[Pose::IDENTITY], 0.002, 12.0, time);
        let middle = Vec3::new(0.0, 0.05, 0.0);
        rig.puffs([
            Puff::default(),
            saturated_puff(middle, warm, [radius, 0.5, speed]),
        ]);
        // Pohlhausen's plate, as long as the puff is wide, in air of 47 °C: D = 2.90e-5 m²/s, ν = 1.76e-5 m²/s.
        let reynolds: f64 = speed * 2.0 * radius / 1.76e-5;
        let sherwood = 0.664 * reynolds.sqrt() * (1.76_f64 / 2.90).cbrt();
        let transfer = (sherwood * 2.90e-5 / (2.0 * radius)).max(STILL);
        let (mut mass, mut wall) = (0.0, 20.0);
        for second in 1..=2 {
            rig.run(90, false);
            for _ in 0..10_000 {
                let flux = condenses(wall, saturated(warm), warm, transfer);
                mass += 1e-4 * flux;
                wall += 1e-4 * (LATENT * flux - 12.0 * (wall - 20.0)) / (0.002 * GLASS);
            }
            let dew = rig.dew();
            for place in [0, 5 * AROUND + 7, PLACES - 1].map(|place| dew[place]) {
                let found = f64::from(place.film);
                // Magnus' form is 0.3 % above Buck's at 60 °C, 1.3 % at 80.
                assert!(
                    (found / mass - 1.0).abs() < 0.025,
                    "{warm} °C, {speed} m/s, {second} s: {found} of {mass}"
                );
                let warmed = f64::from(place.excess) / (wall - 20.0);
                assert!(
                    (warmed - 1.0).abs() < 0.025,
                    "{warm} °C: {} of {wall}",
                    place.excess
                );
            }
            eprintln!("{warm} °C, {speed} m/s, {second} s: {mass} kg/m², {wall} °C");
        }
    }
}

/// One frame on walls from cold to as hot as steam, in a puff and in the room, has the flux of the f64 law.
#[test]
fn a_frame_has_the_flux_of_the_f64_law() {
    for wall in [5.0, 20.0, 59.0, 61.0, 95.0] {
        for puff in [true, false] {
            let rig = Rig::new(&[Pose::IDENTITY], 0.002, 12.0, 1.0 / 90.0);
            let glass = vec![[wall as f32, 0.0]; RINGS];
            rig.gpu.write(&rig.buffers[4], &glass).unwrap();
            rig.film(0.010);
            let before = rig.dew()[200].water;
            let mut air = Air {
                temperature: 20.0,
                vapour: 0.5 * saturated(20.0),
                transfer: still(),
            };
            if puff {
                let middle = Vec3::new(0.0, 0.05, 0.0);
                let puff = saturated_puff(middle, 60.0, [0.06, 0.5, 0.0]);
                rig.puffs([puff, Puff::default()]);
                let ratio = f64::from(puff.water) / f64::from(puff.air);
                air.temperature = dew_point(ratio);
                air.vapour = saturated(60.0);
            }
            rig.run(1, false);
            let changed = f64::from(rig.dew()[200].water) - f64::from(before);
            let area = rig.areas[200 / AROUND];
            let expected = -flux(wall, &air) * area / 90.0 / QUANTUM;
            // A frame's quanta, and what f32 leaves of a difference of two logarithms.
            let most = 2.0 + 1e-3 * expected.abs();
            assert!(
                (changed - expected).abs() < most,
                "{wall} °C: {changed} of {expected}"
            );
        }
    }
}

/// 10 g/m² in a room of 20 °C and 50 %: on a wall so thick that it stays as warm, as long as Lewis' relation and the psychrometric table
/// say (17.3 g/m³ saturated). On one of 2 mm, which the film cools, as long as the integration.
#[test]
fn a_film_clears_in_the_time_of_lewis_relation() {
    let clears = |wall: f64, time: f64| {
        let rig = Rig::new(&[Pose::IDENTITY], wall, 12.0, time);
        rig.film(0.010);
        let mut passed = 0.0;
        while rig.dew()[40].water > 0 && passed < 1000.0 {
            rig.run(1, false);
            passed += time;
        }
        assert_eq!(rig.mass(), 0.0);
        passed
    };
    let lewis = 10.0 / (STILL * 0.5 * 17.3);
    let thick = clears(2.0, 1.0);
    eprintln!("{thick} s of {lewis} s");
    assert!((thick / lewis - 1.0).abs() < 0.03, "{thick} s of {lewis} s");
    let (mut left, mut wall, mut integrated) = (0.010, 20.0, 0.0);
    while left > 0.0 {
        let flux = condenses(wall, 0.5 * saturated(20.0), 20.0, STILL);
        left += 0.01 * flux;
        wall += 0.01 * (LATENT * flux - 12.0 * (wall - 20.0)) / (0.002 * GLASS);
        integrated += 0.01;
    }
    let thin = clears(0.002, 1.0);
    eprintln!("{thin} s of {integrated} s");
    assert!(
        (thin / integrated - 1.0).abs() < 0.03,
        "{thin} s of {integrated} s"
    );
    assert!(thin > 1.3 * thick);
}

/// It is where a puff touches the wall, of this vessel and no other, and gone where liquid was; without steam it goes.
#[test]
fn dew_is_where_steam_is_and_liquid_was_not() {
    // Also on a flask that lies on its side.
    let lies = Pose::new(Vec3::new(0.1, 0.05, 0.0), Quat::from_rotation_z(1.5));
    for pose in [at(0.0, 0.0, 0.0), lies] {
        dew_is_where_steam_is(pose);
    }
}

fn dew_is_where_steam_is(pose: Pose) {
    let poses = [pose, at(0.4, 0.0, 0.0)];
    let rig = Rig::new(&poses, 0.002, 12.0, 1.0 / 90.0);
    let radius = 0.02;
    let middle = pose.transform_point(Vec3::new(0.028, 0.06, 0.004));
    rig.puffs([
        saturated_puff(middle, 70.0, [f64::from(radius), 1e-3, 0.3]),
        Puff::default(),
    ]);
    rig.run(30, false);
    let (mut misted, mut clear) = (0, 0);
    let place_of = |place: usize| {
        let angle = std::f32::consts::TAU * ((place % AROUND) as f32 + 0.5) / AROUND as f32;
        let floor = 0.002;
        let height = floor + (0.1 - 0.0) * ((place / AROUND % UP) as f32 + 0.5) / UP as f32;
        pose.transform_point(Vec3::new(0.03 * angle.cos(), height, 0.03 * angle.sin()))
    };
    let dew = rig.dew();
    for (place, found) in dew.iter().enumerate() {
        let near = place < PLACES && place_of(place).distance(middle) < radius;
        assert_eq!(found.water > 0, near, "{place}: {found:?}");
        (misted, clear) = (misted + u32::from(near), clear + u32::from(!near));
    }
    assert!(misted > 25 && clear > 900, "{misted} {clear}");
    // Liquid touches two of the misted places.
    let row = (0..UP).find(|row| dew[row * AROUND].water > 0 && dew[row * AROUND + 1].water > 0);
    let row = row.unwrap();
    let mut wet = [0; 2 * UP];
    wet[row] = 0b11;
    rig.wet(&wet);
    rig.run(1, false);
    let washed = rig.dew();
    for place in 0..PLACES {
        let here = place == row * AROUND || place == row * AROUND + 1;
        assert_eq!(
            washed[place].water > 0,
            dew[place].water > 0 && !here,
            "{place}"
        );
    }
    // The count carries, and those of puffs stay.
    let off: u32 = dew[row * AROUND].water + dew[row * AROUND + 1].water;
    let counts: Vec<u32> = rig.gpu.read(&rig.buffers[8]).unwrap();
    assert_eq!(counts, [7, 7, 7, 7, off - 1, 1]);
    // The bits are of one frame.
    rig.run(1, false);
    assert!(rig.dew()[row * AROUND].water > 0);
    let before = rig.mass();
    rig.puffs([Puff::default(); 2]);
    rig.run(90, false);
    let after = rig.mass();
    assert!(after < 0.999 * before, "{after} of {before}");
}

/// The water on the walls left the puffs, to the last quantum, and its latent heat is in the glass, where none is lost.
#[test]
fn mass_and_heat_are_kept() {
    let rig = Rig::new(&[Pose::IDENTITY], 0.002, 0.0, 1.0 / 90.0);
    let puffs = [
        saturated_puff(Vec3::new(0.01, 0.05, 0.0), 70.0, [0.03, 1e-4, 0.2]),
        saturated_puff(Vec3::new(-0.01, 0.07, 0.01), 60.0, [0.03, 1e-4, 0.3]),
    ];
    rig.puffs(puffs);
    rig.run(1, false);
    let mut taken: Vec<u32> = rig.gpu.read(&rig.buffers[2]).unwrap();
    taken.truncate(2);
    let held: u32 = rig.dew().iter().map(|place| place.water).sum();
    assert!(taken.iter().all(|&quanta| quanta > 1000), "{taken:?}");
    assert_eq!(taken.iter().sum::<u32>(), held);
    rig.run(60, true);
    // A film also dries into the room where a puff has become too dry: not here, in two thirds of a second.
    let mass = rig.mass();
    let left: Vec<Puff> = rig.gpu.read(&rig.buffers[0]).unwrap();
    let water = |puffs: &[Puff]| puffs.iter().map(|puff| f64::from(puff.water)).sum::<f64>();
    let gone = water(&puffs) - water(&left);
    eprintln!("{mass} kg of {} kg", water(&puffs));
    // Each frame rounds what a puff holds to f32, by 6e-8 of it: of what went, a tenth of it in 60 frames, 4e-5.
    assert!((gone / mass - 1.0).abs() < 1e-4, "{gone} of {mass}");
    let heat: f64 = rig
        .dew()
        .iter()
        .enumerate()
        .map(|(place, dew)| rig.areas[place / AROUND] * 0.002 * GLASS * f64::from(dew.excess))
        .sum();
    assert!(
        (heat / (LATENT * mass) - 1.0).abs() < 1e-4,
        "{heat} J of {mass} kg"
    );
    let enthalpy = |puffs: &[Puff]| {
        puffs
            .iter()
            .map(|puff| f64::from(puff.enthalpy))
            .sum::<f64>()
    };
    // Vapour of 20 °C over water of 0 °C: 2538 kJ/kg (steam tables).
    let given = (enthalpy(&puffs) - enthalpy(&left)) / mass;
    assert!((given / 2.538e6 - 1.0).abs() < 2e-3, "{given} J/kg");
}

/// A puff with little air gives no more water than it holds above the cold wall's saturation, however many places it reaches.
#[test]
fn a_puff_gives_what_it_has_and_no_more() {
    let rig = Rig::new(&[Pose::IDENTITY], 0.002, 12.0, 1.0 / 90.0);
    let air = 2e-7;
    let puff = saturated_puff(Vec3::new(0.0, 0.06, 0.0), 70.0, [0.035, air, 0.3]);
    rig.puffs([puff, Puff::default()]);
    rig.run(200, true);
    let left: Vec<Puff> = rig.gpu.read(&rig.buffers[0]).unwrap();
    let pressure = saturated(20.0);
    let held = air * 287.05 / 461.5 * pressure / (101_325.0 - pressure);
    let water = f64::from(left[0].water);
    eprintln!("{water} kg of {} kg left, {held} kg at 20 °C", puff.water);
    assert!((0.99 * held..0.5 * f64::from(puff.water)).contains(&water));
    assert!(rig.mass() < f64::from(puff.water) - 0.99 * held);
}
