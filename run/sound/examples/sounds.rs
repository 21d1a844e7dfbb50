//! Prints how loud each sound is and how long a second of it takes to render. With a folder it also writes each as a WAV
//! file, to be listened to with headphones: `cargo run --release -p vitriol-sound --example sounds -- FOLDER`.
#![allow(clippy::print_stdout)]

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use glam::Vec3;
use vitriol_sound::{Body, Bubbles, Drops, Event, Glass, Mixer, Onto, Pour, RATE, Sound, Strike};

/// Seconds of each sound.
const SECONDS: usize = 4;

/// A beaker of 250 mL.
const BEAKER: Glass = Glass {
    radius: 0.035,
    wall: 1.4e-3,
    height: 0.095,
    filled: 0.6,
    density: 998.0,
    held: false,
};

fn pour(flow: f32, speed: f32) -> Sound {
    Sound::Pour(Pour {
        flow,
        speed,
        density: 998.0,
        lasts: 3.0,
    })
}

fn boil(subcooling: f32, [departures, collapses, bursts]: [f32; 3]) -> Sound {
    Sound::Bubbles(Bubbles {
        departures,
        collapses,
        bursts,
        radius: 2e-3,
        subcooling,
        depth: 0.04,
        density: 998.0,
        lasts: 3.0,
    })
}

fn blow(impulse: f32, bodies: [Body; 2]) -> Sound {
    Sound::Strike(Strike { impulse, bodies })
}

fn drops(onto: Onto) -> Sound {
    Sound::Drops(Drops {
        count: 4,
        diameter: 3e-3,
        speed: 2.0,
        onto,
    })
}

fn all() -> Vec<(&'static str, Vec<Sound>)> {
    let held = Glass {
        held: true,
        ..BEAKER
    };
    vec![
        ("pour-thin", vec![pour(2e-6, 1.2)]),
        ("pour", vec![pour(2e-5, 1.5)]),
        ("simmer", vec![boil(20.0, [300.0, 300.0, 0.0])]),
        ("boil", vec![boil(0.0, [800.0, 0.0, 800.0])]),
        (
            "glass-on-bench",
            vec![blow(0.03, [Body::Glass(BEAKER), Body::Bench])],
        ),
        ("glass-on-glass", vec![blow(0.005, [Body::Glass(held); 2])]),
        ("break", vec![Sound::Break(BEAKER)]),
        ("drops-bench", vec![drops(Onto::Bench)]),
        ("drops-wet", vec![drops(Onto::Wet)]),
        ("sizzle", vec![Sound::Sizzle(1.0)]),
        ("most", vec![boil(5.0, [3000.0; 3]), pour(1e-3, 3.0)]),
    ]
}

fn main() -> std::io::Result<()> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from);
    println!("sound            peak    rms of what is not silent, dB   ms a second   most voices");
    for (name, sounds) in all() {
        let mut mixer = Mixer::new(1);
        for sound in sounds {
            // A source at the right, half a metre away.
            let position = Vec3::new(0.3, -0.2, -0.35);
            mixer.push(Event {
                time: 0.1,
                emitter: 1,
                position,
                sound,
            });
        }
        let mut heard = vec![[0.0; 2]; SECONDS * RATE as usize];
        let begun = Instant::now();
        let mut voices = 0;
        for block in heard.chunks_mut(480) {
            mixer.render(block);
            voices = voices.max(mixer.voices());
        }
        let spent = begun.elapsed().as_secs_f64() * 1e3 / SECONDS as f64;
        let peak = heard
            .iter()
            .flatten()
            .fold(0.0f32, |peak, it| peak.max(it.abs()));
        let loud = heard.iter().flatten().filter(|it| **it != 0.0);
        let (sum, count) = loud.fold((0.0, 0.0), |(sum, count), it| (sum + it * it, count + 1.0));
        let rms = 10.0 * (sum / count).log10();
        println!("{name:15} {peak:6.3} {rms:8.1} {spent:36.2} {voices:13}");
        if let Some(folder) = &folder {
            write(&folder.join(name).with_extension("wav"), &heard)?;
        }
    }
    Ok(())
}

/// A WAV file of 32-bit floats.
fn write(path: &Path, samples: &[[f32; 2]]) -> std::io::Result<()> {
    let bytes = samples.len() as u32 * 8;
    let mut file = std::io::BufWriter::new(std::fs::File::create(path)?);
    file.write_all(b"RIFF")?;
    file.write_all(&(36 + bytes).to_le_bytes())?;
    file.write_all(b"WAVEfmt ")?;
    file.write_all(&16u32.to_le_bytes())?;
    for number in [3u16, 2] {
        file.write_all(&number.to_le_bytes())?;
    }
    for number in [RATE, RATE * 8] {
        file.write_all(&number.to_le_bytes())?;
    }
    for number in [8u16, 32] {
        file.write_all(&number.to_le_bytes())?;
    }
    file.write_all(b"data")?;
    file.write_all(&bytes.to_le_bytes())?;
    for sample in samples.iter().flatten() {
        file.write_all(&sample.to_le_bytes())?;
    }
    file.flush()
}
