//! A film's sound, as a browser that is not ours decodes it.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use vitriol_run::{Film, FilmError};

use crate::{mp4, told};

const SIZE: [u32; 2] = [64, 64];
const FPS: u32 = 30;
const FRAMES: u32 = 60;

/// Samples of a frame.
const SAMPLES: u32 = 48_000 / FPS;

/// Half a second of silence, then 1 kHz at the left and 3 kHz at the right.
fn sample(k: u32) -> [f32; 2] {
    let time = f64::from(k) / 48_000.0;
    let sine = |frequency: f64| (TAU * frequency * time).sin() as f32;
    match time < 0.5 {
        true => [0.0; 2],
        false => [0.5 * sine(1000.0), 0.25 * sine(3000.0)],
    }
}

fn make_film(path: &Path) {
    let mut film = Film::with_sound(path, SIZE, FPS).unwrap();
    let picture = vec![128; (SIZE[0] * SIZE[1] * 4) as usize];
    for frame in 0..FRAMES {
        let samples: Vec<_> = (frame * SAMPLES..(frame + 1) * SAMPLES)
            .map(sample)
            .collect();
        // Sound may come before its picture.
        film.push_sound(&samples).unwrap();
        film.push_rgba(&picture).unwrap();
    }
    film.finish().unwrap();
}

#[test]
fn a_browser_hears_it_in_time() {
    let folder = tempfile::tempdir().unwrap();
    make_film(&folder.path().join("film.mp4"));
    let page = r#"<!doctype html><script>
        const told = (value) => console.log("TOLD " + JSON.stringify(value));
        const request = new XMLHttpRequest();
        request.open("GET", "film.mp4");
        request.responseType = "arraybuffer";
        request.onload = async () => {
          const context = new OfflineAudioContext(2, 48000, 48000);
          const sound = await context.decodeAudioData(request.response);
          const sides = [0, 1].map((side) => [...sound.getChannelData(side)]);
          const loud = (side, frequency) => {
            let [a, b] = [0, 0];
            for (let k = 48000; k < 72000; k++) {
              a += sides[side][k] * Math.cos(2 * Math.PI * frequency * k / 48000);
              b += sides[side][k] * Math.sin(2 * Math.PI * frequency * k / 48000);
            }
            return Math.hypot(a, b) / 12000;
          };
          told({
            rate: sound.sampleRate,
            length: sound.length,
            begin: sides[0].findIndex((it) => Math.abs(it) > 0.1),
            loud: [[0, 1000], [1, 1000], [0, 3000], [1, 3000]].map((it) => loud(...it)),
          });
        };
        request.send();
        </script>"#;
    let Some(told) = told(folder.path(), page) else {
        return;
    };
    assert_eq!(told["rate"], 48_000, "{told}");
    // Two seconds: no longer than the picture, and a player may leave out the encoder's 312 samples.
    let length = told["length"].as_u64().unwrap();
    assert!((96_000 - 960..=96_000).contains(&length), "{told}");
    // 0.1 is reached after 1.5 samples; a player may keep the encoder's 312 samples, 6.5 ms.
    let begin = told["begin"].as_u64().unwrap();
    assert!((23_900..24_400).contains(&begin), "{told}");
    let loud = told["loud"].as_array().unwrap();
    for (found, expected) in loud.iter().zip([0.5, 0.0, 0.0, 0.25]) {
        let off = (found.as_f64().unwrap() - expected).abs();
        assert!(off < 0.01, "{told}");
    }
}

#[test]
fn a_film_without_sound_takes_none() {
    let folder = tempfile::tempdir().unwrap();
    let mut film = Film::create(&folder.path().join("film.mp4"), SIZE[0], SIZE[1], FPS).unwrap();
    assert!(matches!(film.push_sound(&[[0.0; 2]]), Err(FilmError::Mute)));
}

/// Sound that comes behind all its pictures, more than two seconds late, is as long and at the same times as any: a track whose first
/// packet were late would be played early.
#[test]
fn sound_that_comes_late_keeps_its_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    let mut film = Film::with_sound(&path, SIZE, FPS).unwrap();
    let picture = vec![128; (SIZE[0] * SIZE[1] * 4) as usize];
    let frames = FRAMES + 10;
    for _ in 0..frames {
        film.push_rgba(&picture).unwrap();
    }
    let samples: Vec<_> = (0..frames * SAMPLES).map(sample).collect();
    film.push_sound(&samples).unwrap();
    film.finish().unwrap();
    let film = mp4::tracks(&fs::read(&path).unwrap());
    assert_eq!(film.len(), 2);
    let sound = &film[1];
    assert_eq!((sound.handler.as_str(), sound.units), ("soun", 48_000));
    // Whole packets of 20 ms in 70 frames.
    assert_eq!((sound.samples.len(), sound.length), (116, 2320));
    for (packet, (from, lasts, _)) in (0..).zip(&sound.samples) {
        assert_eq!((*from, *lasts), (packet * 960, 960));
    }
}
