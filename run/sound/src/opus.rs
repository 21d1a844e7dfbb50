//! Sound for a film: Opus packets (RFC 6716), which browsers and players take in MP4 and WebM.

use ropus::{Application, Bitrate, Channels, EncodeError, Encoder, EncoderBuildError};

use crate::RATE;

/// Samples of a packet: 20 ms, with which Opus is at its best.
pub const OPUS_PACKET: usize = 960;

/// Samples by which the decoded sound is late: the encoder's own look-ahead. A container states it, so that players skip them (RFC 7845,
/// pre-skip).
pub const OPUS_DELAY: u16 = 312;

/// Bits a second of both channels (Xiph's recommended settings: 96 to 128 kbit/s
/// for stereo music).
const BITS: u32 = 96_000;

/// Longest packet, bytes (RFC 6716, 3.4).
const LONGEST: usize = 1275;

/// Why sound could not be encoded.
#[derive(Debug, thiserror::Error)]
pub enum OpusError {
    /// The encoder cannot be made.
    #[error("the sound's encoder could not be set up; make the film without sound")]
    Begin(#[from] EncoderBuildError),
    /// It refused samples.
    #[error("the sound's encoder failed; make the film without sound")]
    Encode(#[from] EncodeError),
}

/// An encoder. It uses integers only: the same samples give the same bytes on every machine.
pub struct Opus {
    encoder: Encoder,
    waiting: Vec<f32>,
    packet: Vec<u8>,
    packets: u64,
}

impl std::fmt::Debug for Opus {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut it = f.debug_struct("Opus");
        it.field("packets", &self.packets).finish_non_exhaustive()
    }
}

impl Opus {
    /// An encoder at the first sample.
    ///
    /// # Errors
    /// [`OpusError::Begin`].
    pub fn new() -> Result<Self, OpusError> {
        let encoder = Encoder::builder(RATE, Channels::Stereo, Application::Audio)
            .bitrate(Bitrate::Bits(BITS))
            .build()?;
        Ok(Self {
            encoder,
            waiting: Vec::new(),
            packet: vec![0; LONGEST],
            packets: 0,
        })
    }

    /// Takes the next samples, and gives each packet that is full to `take`, with the time (s) of its first sample.
    ///
    /// # Errors
    /// [`OpusError::Encode`], or the error of `take`.
    pub fn push<E: From<OpusError>>(
        &mut self,
        samples: &[[f32; 2]],
        mut take: impl FnMut(f64, &[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.waiting.extend(samples.iter().flatten());
        let whole = self.waiting.len() / (2 * OPUS_PACKET) * (2 * OPUS_PACKET);
        for samples in self.waiting[..whole].chunks_exact(2 * OPUS_PACKET) {
            let coded = self.encoder.encode_float(samples, &mut self.packet);
            let length = coded.map_err(OpusError::Encode)?;
            let seconds = (self.packets * OPUS_PACKET as u64) as f64 / f64::from(RATE);
            self.packets += 1;
            take(seconds, &self.packet[..length])?;
        }
        self.waiting.drain(..whole);
        Ok(())
    }

    /// Gives the last packet to `take`, filled with silence for the packet and the encoder's delay.
    ///
    /// # Errors
    /// As [`Opus::push`].
    pub fn finish<E: From<OpusError>>(
        mut self,
        take: impl FnMut(f64, &[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        let left = self.waiting.len() / 2;
        if self.packets == 0 && left == 0 {
            return Ok(());
        }
        let whole = (left + usize::from(OPUS_DELAY)).next_multiple_of(OPUS_PACKET);
        self.push(&vec![[0.0; 2]; whole - left], take)
    }
}
