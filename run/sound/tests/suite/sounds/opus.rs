//! A film's sound is the one that was rendered.

use vitriol_sound::{OPUS_DELAY, OPUS_PACKET, Opus, OpusError};

use crate::sounds::measure::{RATE_F, ahead, amplitude, pour, render, rms};

/// Packets with their times.
fn packets(samples: &[[f32; 2]], at_once: usize) -> Vec<(f64, Vec<u8>)> {
    let mut opus = Opus::new().unwrap();
    let mut packets = Vec::new();
    let mut take = |seconds: f64, packet: &[u8]| {
        packets.push((seconds, packet.to_vec()));
        Ok::<_, OpusError>(())
    };
    for part in samples.chunks(at_once) {
        opus.push(part, &mut take).unwrap();
    }
    opus.finish(&mut take).unwrap();
    packets
}

/// The sound that a player decodes from them.
fn decoded(packets: &[(f64, Vec<u8>)]) -> Vec<[f32; 2]> {
    let mut decoder = ropus::Decoder::new(48_000, ropus::Channels::Stereo).unwrap();
    let mut heard = Vec::new();
    for (_, packet) in packets {
        let mut out = [0.0; 2 * OPUS_PACKET];
        let mode = ropus::DecodeMode::Normal;
        let count = decoder.decode_float(packet, &mut out, mode).unwrap();
        heard.extend(out[..2 * count].chunks(2).map(|it| [it[0], it[1]]));
    }
    heard.drain(..usize::from(OPUS_DELAY));
    heard
}

/// 1 kHz at the left, 3 kHz at the right, and in time.
#[test]
fn a_sine_is_decoded_as_it_was() {
    let sine =
        |frequency: f64, k: u32| (std::f64::consts::TAU * frequency * f64::from(k) / RATE_F).sin();
    let samples =
        (0..48_000).map(|k| [0.5 * sine(1000.0, k) as f32, 0.25 * sine(3000.0, k) as f32]);
    let samples: Vec<_> = samples.collect();
    let heard = decoded(&packets(&samples, 1600));
    assert!(heard.len() >= samples.len());
    for (side, frequency, loud) in [(0, 1000.0, 0.5), (1, 3000.0, 0.25)] {
        let one: Vec<f64> = heard[4800..43_200]
            .iter()
            .map(|it| f64::from(it[side]))
            .collect();
        let found = 2.0 * amplitude(&one, frequency) / one.len() as f64;
        assert!((found / loud - 1.0).abs() < 0.02, "{side}: {found}");
        let original: Vec<f64> = samples[4800..43_200]
            .iter()
            .map(|it| f64::from(it[side]))
            .collect();
        let off: Vec<f64> = one.iter().zip(&original).map(|(a, b)| a - b).collect();
        assert!(rms(&off) < 0.03 * rms(&original), "{side}: {}", rms(&off));
    }
}

/// A packet each 20 ms, at 96 kbit/s; the same bytes however samples come.
#[test]
fn packets_come_each_twenty_milliseconds() {
    let samples = render(&[ahead(0.0, pour(1.0))], 1.0);
    let all = packets(&samples, 1600);
    assert_eq!(all, packets(&samples, 333));
    assert_eq!(all.len(), 51);
    assert!(
        all.iter()
            .zip(0..)
            .all(|((at, _), k)| (at - 0.02 * f64::from(k)).abs() < 1e-9)
    );
    let bits: usize = all.iter().map(|(_, packet)| 8 * packet.len()).sum();
    assert!((60_000..130_000).contains(&bits), "{bits}");
    assert!(packets(&[], 1).is_empty());
}
