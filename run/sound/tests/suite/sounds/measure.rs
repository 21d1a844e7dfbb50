//! The tests' measuring instruments: a mixer that renders events, and measures of a signal.

use glam::Vec3;
use vitriol_sound::{Event, Mixer, Pour, RATE, Sound};

pub const RATE_F: f64 = RATE as f64;

/// An event at `time` from emitter 1, one metre ahead.
pub fn ahead(time: f64, sound: Sound) -> Event {
    Event {
        time,
        emitter: 1,
        position: Vec3::new(0.0, 0.0, -1.0),
        sound,
    }
}

/// 10 mL/s of water that enters at 1.5 m/s.
pub fn pour(lasts: f32) -> Sound {
    Sound::Pour(Pour {
        flow: 1e-5,
        speed: 1.5,
        density: 998.0,
        lasts,
    })
}

/// `seconds` of sound of these events, left and right.
pub fn render(events: &[Event], seconds: f64) -> Vec<[f32; 2]> {
    let mut mixer = Mixer::new(1);
    for event in events {
        mixer.push(*event);
    }
    let mut out = vec![[0.0; 2]; (seconds * RATE_F) as usize];
    mixer.render(&mut out);
    out
}

/// Both ears' mean.
pub fn mono(samples: &[[f32; 2]]) -> Vec<f64> {
    let mean = |it: &[f32; 2]| 0.5 * (f64::from(it[0]) + f64::from(it[1]));
    samples.iter().map(mean).collect()
}

/// Frequency by `periods` of upward crossings of zero, each found between two samples.
pub fn pitch(samples: &[f64], periods: usize) -> f64 {
    let pairs = samples.windows(2).enumerate();
    let crossings = pairs.filter(|(_, pair)| pair[0] < 0.0 && pair[1] >= 0.0);
    let times: Vec<f64> = crossings
        .map(|(index, pair)| index as f64 + pair[0] / (pair[0] - pair[1]))
        .take(periods + 1)
        .collect();
    assert_eq!(times.len(), periods + 1);
    periods as f64 * RATE_F / (times[periods] - times[0])
}

/// Amplitude at `frequency` (Goertzel's sum), of a fading tone in arbitrary units.
pub fn amplitude(samples: &[f64], frequency: f64) -> f64 {
    let step = std::f64::consts::TAU * frequency / RATE_F;
    let sum = samples
        .iter()
        .zip(0..)
        .fold((0.0, 0.0), |sum, (sample, k)| {
            let angle = step * f64::from(k);
            (sum.0 + sample * angle.cos(), sum.1 + sample * angle.sin())
        });
    f64::hypot(sum.0, sum.1)
}

pub fn rms(samples: &[f64]) -> f64 {
    (samples.iter().map(|it| it * it).sum::<f64>() / samples.len() as f64).sqrt()
}

/// Mean frequency of a signal's power: √(Σ(dx)²/Σx²) is 2·sin(πf/rate).
pub fn brightness(samples: &[f64]) -> f64 {
    let steps: f64 = samples.windows(2).map(|it| (it[1] - it[0]).powi(2)).sum();
    let power: f64 = samples.iter().map(|it| it * it).sum();
    RATE_F / std::f64::consts::PI * (0.5 * (steps / power).sqrt()).asin()
}
