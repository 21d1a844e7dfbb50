//! Staging memory of one submission, handed out front to back.

use std::sync::Arc;

use crate::device::Core;
use crate::{Buffer, GpuError};

/// Size of a chunk: large enough for the small uploads of a frame.
const CHUNK_BYTES: u64 = 1 << 20;

#[derive(Default)]
pub(crate) struct Arena {
    chunk: Option<Buffer>,
    used: u64,
}

impl Arena {
    /// A place that holds `data`: a staging buffer and an offset in it. Data that do not fit the chunk get a buffer of their own, which
    /// the caller's submission frees.
    pub(crate) fn place(
        &mut self,
        core: &Arc<Core>,
        data: &[u8],
    ) -> Result<(Buffer, u64), GpuError> {
        let bytes = data.len() as u64;
        if bytes > CHUNK_BYTES - self.used {
            let buffer = Buffer::staging(core, "staging", bytes)?;
            buffer.inner.write_at(0, data)?;
            return Ok((buffer, 0));
        }
        let chunk = match &self.chunk {
            Some(chunk) => chunk.clone(),
            None => {
                let chunk = Buffer::staging(core, "staging", CHUNK_BYTES)?;
                self.chunk.insert(chunk).clone()
            }
        };
        let offset = self.used;
        chunk.inner.write_at(offset, data)?;
        // 16: offsets of copies are multiples of 4, and of image texels.
        self.used = (offset + bytes).next_multiple_of(16).min(CHUNK_BYTES);
        Ok((chunk, offset))
    }

    pub(crate) fn clear(&mut self) {
        self.used = 0;
    }
}
