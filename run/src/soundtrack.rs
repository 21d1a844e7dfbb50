//! A film's sound: samples to Opus packets, which wait until the muxer takes them.

use std::io::Write;

use muxide::api::Muxer;
use vitriol_sound::{OPUS_PACKET, Opus, OpusError, RATE};

use crate::film_error::FilmError;

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

    /// Gives what there is to the muxer, and returns its bytes.
    pub(crate) fn give<W: Write>(&mut self, muxer: &mut Muxer<W>) -> Result<u64, FilmError> {
        let mut bytes = 0;
        for (seconds, packet) in self.packets.drain(..) {
            muxer.write_audio(seconds, &packet)?;
            bytes += packet.len() as u64;
        }
        Ok(bytes)
    }

    /// Gives the rest, as far as it is within a film of so many `seconds`: a packet that goes on behind its last picture would make
    /// the film longer than what it shows.
    pub(crate) fn finish<W: Write>(
        mut self,
        muxer: &mut Muxer<W>,
        seconds: f64,
    ) -> Result<(), FilmError> {
        let within = |begin: f64| begin + OPUS_PACKET as f64 / f64::from(RATE) <= seconds + 1e-6;
        self.packets.retain(|(begin, _)| within(*begin));
        self.give(muxer)?;
        let mut packets = Packets::new();
        self.opus.finish(keep(&mut packets))?;
        for (begin, packet) in packets.into_iter().filter(|(begin, _)| within(*begin)) {
            muxer.write_audio(begin, &packet)?;
        }
        Ok(())
    }
}
