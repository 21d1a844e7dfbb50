//! Steam in the room's air: by the f64 puff, and by the liquid's ledger.

use super::setup::*;
use crate::common::*;
use vitriol_gpu::{Buffer, ComputePipeline, QueueKind};
use vitriol_shaders::layout::Puff as OnDevice;
use vitriol_shaders::{Library, sim};
use vitriol_sim::chemistry::Chemistry;
use vitriol_sim::chemistry::puff::{Puff, Room};
use vitriol_sim::chemistry::table::steam_enthalpy;
use vitriol_sim::pose::Pose;
use vitriol_tests::gpu;

const FRAME: f64 = 1.0 / 90.0;
const STEPS: u32 = 4;

#[test]
fn puffs_rise_and_condense_as_in_f64() {
    let device = gpu::device();
    let room = Room::at(20.0);
    let mut truth: Vec<Puff> = [5e-7, 2e-5, 1e-4]
        .map(|mass| Puff::of_steam(mass, steam_enthalpy(110.0), 0.9, &room))
        .to_vec();
    let start: Vec<OnDevice> = truth
        .iter()
        .map(|puff| OnDevice {
            position: [0.1, puff.height as f32, -0.2],
            radius: puff.radius() as f32,
            air: puff.air as f32,
            water: puff.water as f32,
            enthalpy: puff.enthalpy as f32,
            mist: puff.mist as f32,
            ..OnDevice::default()
        })
        .collect();
    let puffs = Buffer::storage(&device, "puffs", 48 * 3).unwrap();
    device.write(&puffs, &start).unwrap();
    let constants = [
        ("PUFFS", 3.0),
        ("STEPS", f64::from(STEPS)),
        ("STEP_TIME", FRAME / f64::from(STEPS)),
        ("GRAVITY", 9.81),
        ("ROOM_HUMIDITY", room.humidity),
        ("ROOM_ENTHALPY", room.enthalpy),
        ("ROOM_DENSITY", room.density),
    ];
    let library = Library::watching();
    let compiled = library.compile(&sim::RISE, "main", &constants).unwrap();
    let pass = ComputePipeline::new(&device, &compiled).unwrap();
    for frame in 1..=60 {
        let mut rec = device.recorder(QueueKind::Main).unwrap();
        rec.pass(&pass)
            .write("puffs", &puffs)
            .invocations(3)
            .unwrap();
        device.submit(rec).unwrap().wait().unwrap();
        for puff in &mut truth {
            for _ in 0..STEPS {
                puff.advance(&room, 9.81, FRAME / f64::from(STEPS));
            }
        }
        let found: Vec<OnDevice> = device.read(&puffs).unwrap();
        for (found, puff) in found.iter().zip(&truth) {
            // A hundred thousandth a step that f32 rounds, of which there are
            // 240; mist is a small difference of two masses.
            let near = |found: f32, truth: f64, scale: f64| {
                let error = (f64::from(found) - truth).abs() / scale;
                assert!(error < 2e-3, "frame {frame}: {found} for {truth}");
            };
            near(found.position[1], puff.height, puff.height - 0.8);
            near(found.radius, puff.radius(), puff.radius());
            near(found.air, puff.air, puff.air);
            near(found.mist, puff.mist, puff.water);
            assert_eq!([found.position[0], found.position[2]], [0.1, -0.2]);
        }
    }
}

#[test]
fn what_leaves_the_liquid_is_in_the_puffs() {
    let device = gpu::device();
    // With a surface that loses a hundred times what it does, so that there is steam of bubbles and of the surface.
    let mut setup = super::bubbly_liquid::kettle(0.002, 4096);
    let p = setup.parameters.clone();
    if let Some(Chemistry::Physical(law)) = &mut setup.parameters.chemistry {
        law.losses = everything().losses;
    }
    let solver = setup.solver(&device);
    let mut seen = 0;
    for _ in 0..12 {
        frames(&device, &solver, &[Pose::IDENTITY], 2);
        let state = solver.snapshot().unwrap();
        let of_surface = sum(&state.ledger, |[_, steam, ..]| steam);
        let of_bubbles: f64 = state.bubbles().iter().map(|b| f64::from(b.gone[0])).sum();
        let left = (of_surface + of_bubbles) * p.particle_mass();
        let puffs: Vec<OnDevice> = device.read(solver.puffs().unwrap()).unwrap();
        let room = Room::at(20.0);
        let held: f64 = puffs
            .iter()
            .filter(|puff| puff.radius > 0.0)
            .map(|puff| f64::from(puff.water) - f64::from(puff.air) * room.humidity)
            .sum();
        // And on the glass over the liquid, or washed off that.
        let held = held + state.dew_mass() + state.washed_mass();
        // Four workgroups may each wait for another half milligram.
        let waits = 4.0 * 5e-7;
        assert!(held <= left * (1.0 + 1e-5), "{held} of {left}");
        assert!(held > left * (1.0 - 1e-5) - waits, "{held} of {left}");
        seen = puffs.iter().filter(|puff| puff.radius > 0.0).count();
        // They start where the liquid is, and drift on their way up.
        for puff in puffs.iter().filter(|puff| puff.radius > 0.0) {
            let [x, y, z] = puff.position;
            assert!(y > 0.0 && (x.hypot(z) < 0.05 || y > 0.1), "{puff:?}");
        }
    }
    assert!(seen >= 4, "{seen} puffs");
}
