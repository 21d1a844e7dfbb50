//! A still of a bench with a filled beaker and a flask that is being poured
//! from, and how long a frame takes:
//! `cargo run --release -p vitriol-render --example still -- picture.png`
//!
//! The particles stand in a lattice; nothing is simulated here.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::time::{Duration, Instant};

use glam::{Affine3A, Quat, Vec3};
use vitriol_gpu::{Buffer, Gpu, Options, PlainLoader, QueueKind};
use vitriol_render::{
    ColourBy, FrameDesc, ParticleSource, RenderDesc, Renderer, SceneDesc, VesselDesc, View,
};
use vitriol_shaders::Library;

/// Particle spacing, metres.
const SPACING: f32 = 0.0025;
const EXTENT: [u32; 2] = [960, 540];
const TIMED_FRAMES: usize = 40;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "still.png".to_owned());
    let options = Options {
        timestamps: true,
        ..Options::default()
    };
    let gpu = Gpu::open(&mut PlainLoader::default(), &options)?;
    let mut renderer = Renderer::new(&gpu, &Library::watching(), &RenderDesc::film(EXTENT))?;
    renderer.set_scene(&SceneDesc::laboratory(
        vec![erlenmeyer(), beaker()],
        0.75,
        1.0,
    ))?;

    let (positions, velocities) = liquid();
    let upload = |label: &str, data: &[[f32; 4]]| {
        let buffer = Buffer::storage(&gpu, label, size_of_val(data) as u64)?;
        gpu.write(&buffer, data)?;
        Ok::<_, vitriol_gpu::GpuError>(buffer)
    };
    let position_buffer = upload("positions", &positions)?;
    let velocity_buffer = upload("velocities", &velocities)?;

    let views = [View::bench(EXTENT[0] as f32 / EXTENT[1] as f32)];
    let vessels = [
        Affine3A::from_rotation_translation(
            Quat::from_rotation_z(-1.75),
            Vec3::new(-0.025, 0.925, -0.40),
        ),
        Affine3A::from_translation(Vec3::new(0.12, 0.75, -0.40)),
    ];
    let frame = FrameDesc {
        views: &views,
        vessels: &vessels,
        particles: Some(ParticleSource {
            positions: &position_buffer,
            attributes: &velocity_buffer,
            count: positions.len() as u32,
            radius: 0.6 * SPACING,
        }),
        liquid: None,
        steam: None,
        colour_by: ColourBy::Speed(1.2),
        length_scale: 1.0,
    };

    let mut walls = Vec::new();
    let mut passes = Vec::new();
    let mut bytes = Vec::new();
    for _ in 0..TIMED_FRAMES {
        let start = Instant::now();
        let mut rec = gpu.recorder(QueueKind::Main)?;
        renderer.record(&mut rec, &frame)?;
        let picture = renderer.read_back(&mut rec)?;
        let ticket = gpu.submit(rec)?;
        ticket.wait()?;
        bytes = picture.first_view()?;
        walls.push(start.elapsed());
        let picture_pass = ticket
            .timings()?
            .into_iter()
            .find(|timing| timing.label == "picture");
        if let Some(timing) = picture_pass {
            passes.push(Duration::from_nanos(timing.nanoseconds as u64));
        }
    }
    image::save_buffer(&path, &bytes, EXTENT[0], EXTENT[1], image::ColorType::Rgba8)?;
    println!(
        "{path}: {} particles, {}×{}; median of {TIMED_FRAMES}: {:?} a frame with read-back, {:?} the pass alone",
        positions.len(),
        EXTENT[0],
        EXTENT[1],
        median(&mut walls),
        median(&mut passes),
    );
    Ok(())
}

fn median(times: &mut [Duration]) -> Duration {
    times.sort();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

/// A low 250 mL beaker of 2 mm glass.
fn beaker() -> VesselDesc {
    VesselDesc {
        inner: vec![
            [0.0, 0.002],
            [0.031, 0.002],
            [0.033, 0.004],
            [0.033, 0.094],
            [0.0345, 0.096],
        ],
        outer: vec![
            [0.0, 0.0],
            [0.033, 0.0],
            [0.035, 0.002],
            [0.035, 0.094],
            [0.0365, 0.096],
        ],
        marks: vec![0.017, 0.031, 0.046, 0.061],
    }
}

/// A 100 mL Erlenmeyer flask of 2 mm glass.
fn erlenmeyer() -> VesselDesc {
    let inner = [
        [0.029, 0.002],
        [0.031, 0.006],
        [0.013, 0.078],
        [0.012, 0.083],
        [0.012, 0.105],
    ];
    VesselDesc {
        inner: std::iter::once([0.0, 0.002]).chain(inner).collect(),
        outer: std::iter::once([0.0, 0.0])
            .chain(inner.map(|[r, y]| [r + 0.002, if y < 0.003 { 0.0 } else { y }]))
            .collect(),
        marks: Vec::new(),
    }
}

/// Positions and velocities of liquid in the beaker, a stream that falls into
/// it, and a pool on the bench.
fn liquid() -> (Vec<[f32; 4]>, Vec<[f32; 4]>) {
    let (mut positions, mut velocities) = (Vec::new(), Vec::new());
    let mut noise = 1_u32;
    let mut jitter = || {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        ((noise >> 8) as f32 / 16_777_216.0 - 0.5) * 0.5 * SPACING
    };
    let mut add = |at: Vec3, velocity: Vec3| {
        let shaken = at + Vec3::new(jitter(), jitter(), jitter());
        positions.push(shaken.extend(1.0).to_array());
        velocities.push(velocity.extend(0.0).to_array());
    };
    let beaker_axis = Vec3::new(0.12, 0.75, -0.40);
    let entry = beaker_axis + Vec3::new(-0.008, 0.0, 0.0);
    for y in 0..24 {
        for z in -14..=14 {
            for x in -14..=14 {
                let at = Vec3::new(x as f32, y as f32, z as f32) * SPACING;
                if at.with_y(0.0).length() < 0.0318 {
                    let position = beaker_axis + at + Vec3::Y * 0.0035;
                    let speed =
                        0.9 * (-position.with_y(0.0).distance(entry.with_y(0.0)) / 0.015).exp();
                    add(position, Vec3::X * (speed * y as f32 / 24.0));
                }
            }
        }
    }
    // A stream in free fall from the lip at 0.2 m/s.
    let lip = Vec3::new(0.085, 0.898, -0.40);
    for step in 0..120 {
        let time = 0.0013 * step as f32;
        let velocity = Vec3::new(0.20, -9.81 * time, 0.0);
        let centre = lip + Vec3::new(0.20 * time, -0.5 * 9.81 * time * time, 0.0);
        if centre.y < 0.812 {
            break;
        }
        for (y, z) in [(-1, 0), (0, -1), (0, 0), (0, 1), (1, 0)] {
            add(
                centre + Vec3::new(0.0, y as f32, z as f32) * SPACING,
                velocity,
            );
        }
    }
    for z in -8..=8 {
        for x in -10..=10 {
            let at = Vec3::new(x as f32, 0.0, z as f32) * SPACING;
            if at.length() < 0.018 {
                add(Vec3::new(0.03, 0.7513, -0.36) + at, Vec3::ZERO);
            }
        }
    }
    (positions, velocities)
}
