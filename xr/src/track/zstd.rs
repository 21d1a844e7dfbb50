//! Unpacks chunks in zstd, which other programs write by default. The container's own decoder would bring a C library.

use std::fmt::Display;
use std::io::Read;

use mcap::sans_io::decompressor::{DecompressResult, Decompressor};
use mcap::{McapError, McapResult};
use ruzstd::decoding::errors::{FrameDecoderError, ReadFrameHeaderError};
use ruzstd::decoding::{BlockDecodingStrategy, FrameDecoder};

/// Most bytes of a block with its header and the checksum behind the last one (RFC 8878, 3.1.1.2). A frame's header is shorter.
const BLOCK: usize = 3 + (128 << 10) + 4;

/// Decoder of a chunk. It unpacks one block at a time, and the reader takes all of it before the next, so that it holds no more than a
/// frame's window and a block, whatever a header promises.
pub(super) struct Zstd {
    decoder: FrameDecoder,
    /// Longest window accepted, B.
    window: usize,
    /// Bytes of a skippable frame that come still.
    skip: usize,
}

impl Zstd {
    /// One that accepts a window of at most that many bytes, since a frame's header makes the decoder reserve its window.
    pub(super) fn new(window: usize) -> Self {
        let mut decoder = FrameDecoder::new();
        decoder.set_max_window_size(window as u64);
        Self {
            decoder,
            window,
            skip: 0,
        }
    }

    /// Reads the header of the next frame.
    fn begin(&mut self, rest: &mut &[u8]) -> McapResult<()> {
        match self.decoder.init(rest) {
            Err(FrameDecoderError::ReadFrameHeaderError(ReadFrameHeaderError::SkipFrame {
                length,
                ..
            })) => {
                self.skip = length as usize;
                Ok(())
            }
            begun => begun.map_err(failed),
        }
    }
}

impl Decompressor for Zstd {
    /// A whole block: what is short of one is then a chunk that was cut off.
    fn next_read_size(&self) -> usize {
        BLOCK
    }

    fn decompress(&mut self, src: &[u8], dst: &mut [u8]) -> McapResult<DecompressResult> {
        let wrote = self.decoder.read(dst).map_err(failed)?;
        if wrote > 0 {
            // The next block waits until this one is taken.
            return Ok(DecompressResult { consumed: 0, wrote });
        }
        let mut rest = src;
        if self.skip > 0 {
            let skipped = self.skip.min(src.len());
            self.skip -= skipped;
            rest = &src[skipped..];
        } else if self.decoder.is_finished() {
            self.begin(&mut rest)?;
        } else {
            let one = BlockDecodingStrategy::UptoBlocks(1);
            self.decoder.decode_blocks(&mut rest, one).map_err(failed)?;
        }
        Ok(DecompressResult {
            consumed: src.len() - rest.len(),
            wrote: 0,
        })
    }

    fn reset(&mut self) -> McapResult<()> {
        *self = Self::new(self.window);
        Ok(())
    }

    fn name(&self) -> &'static str {
        "zstd"
    }
}

fn failed(error: impl Display) -> McapError {
    McapError::DecompressionError(error.to_string())
}
