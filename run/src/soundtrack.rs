//! A film's sound: samples to Opus packets, which wait until the next picture.

use vitriol_sound::{OPUS_PACKET, Opus, OpusError, RATE};

use crate::film_error::FilmError;
use crate::mp4::Mp4;

/// Packets with their times (s).
type Packets = Vec<(f64, Vec<u8>)>;

/// The encoder and what it has made.
pub(crate) struct Soundtrack {
    opus: Opus,
    packets: Packets,
}

fn keep(packets: &mut Packets) -> impl FnMut(f64, &[u8]) -> Result<(), OpusError> {
    |seconds, packet| {
        packets.push((seconds, packet.to_vec()));
        Ok(())
    }
}

impl Soundtrack {
    pub(crate) fn new() -> Result<Self, FilmError> {
        Ok(Self {
            opus: Opus::new()?,
            packets: Packets::new(),
        })
    }

    /// Encodes the next samples.
    pub(crate) fn push(&mut self, samples: &[[f32; 2]]) -> Result<(), FilmError> {
        Ok(self.opus.push(samples, keep(&mut self.packets))?)
    }

    /// Gives what there is to the film's file.
    pub(crate) fn give(&mut self, film: &mut Mp4) {
        for (_, packet) in self.packets.drain(..) {
            film.add_packet(&packet);
        }
    }

    /// Gives the rest, as far as it is within a film of so many `seconds`: a packet that goes on behind its last picture would make
    /// the film longer than what it shows.
    pub(crate) fn finish(self, film: &mut Mp4, seconds: f64) -> Result<(), FilmError> {
        let Self { opus, mut packets } = self;
        opus.finish(keep(&mut packets))?;
        let within = |begin: f64| begin + OPUS_PACKET as f64 / f64::from(RATE) <= seconds + 1e-6;
        for (_, packet) in packets.iter().filter(|(begin, _)| within(*begin)) {
            film.add_packet(packet);
        }
        Ok(())
    }
}
