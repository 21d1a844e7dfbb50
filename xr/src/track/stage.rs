//! Bytes between a track's writer and its file.

use std::collections::VecDeque;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::sync::{Arc, Mutex, PoisonError};

/// Most bytes that wait for a disk: some 25 minutes of a track at 90 Hz.
const MOST: usize = 32 << 20;

type Bytes = Arc<Mutex<Vec<u8>>>;

/// The output of the container's writer: memory, which never refuses.
///
/// Its own writer cannot be asked to write a chunk again, so a file that refuses one would end the track.
pub(super) struct StagedBytes(Bytes);

impl Write for StagedBytes {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        lock(&self.0).extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Bytes that are not in the file yet.
pub(super) struct Pending {
    file: File,
    staged: Bytes,
    /// Whole chunks that wait, each with the number of frames that the file holds once it is written.
    chunks: VecDeque<(Vec<u8>, u64)>,
    /// Bytes and frames that the file holds.
    whole: u64,
    frames: u64,
}

impl Pending {
    /// The two ends for an empty file.
    pub(super) fn new(file: File) -> (Self, StagedBytes) {
        let staged = Bytes::default();
        let stage = StagedBytes(Arc::clone(&staged));
        let pending = Self {
            file,
            staged,
            chunks: VecDeque::new(),
            whole: 0,
            frames: 0,
        };
        (pending, stage)
    }

    /// Whether no more should be staged.
    pub(super) fn is_full(&self) -> bool {
        self.chunks
            .iter()
            .map(|(bytes, _)| bytes.len())
            .sum::<usize>()
            >= MOST
    }

    /// Bytes that the file holds.
    pub(super) fn bytes(&self) -> u64 {
        self.whole
    }

    /// Frames that the file holds.
    pub(super) fn frames(&self) -> u64 {
        self.frames
    }

    /// Appends all waiting chunks to the file, which holds `frames` frames then. Where the file refuses, it ends with its last whole
    /// chunk, and the rest waits.
    pub(super) fn write_out(&mut self, frames: u64) -> io::Result<()> {
        let staged = std::mem::take(&mut *lock(&self.staged));
        if !staged.is_empty() {
            self.chunks.push_back((staged, frames));
        }
        while let Some((bytes, frames)) = self.chunks.front() {
            if let Err(error) = self.file.write_all(bytes) {
                // Half a chunk would hide the chunks after it. A file that cannot be cut is written over from there on the next time.
                let _ = self.file.set_len(self.whole);
                self.file.seek(SeekFrom::Start(self.whole))?;
                return Err(error);
            }
            self.whole += bytes.len() as u64;
            self.frames = *frames;
            self.chunks.pop_front();
        }
        Ok(())
    }

    /// Waits until all written bytes are on the disk.
    pub(super) fn sync(&self) -> io::Result<()> {
        self.file.sync_all()
    }
}

fn lock(bytes: &Bytes) -> std::sync::MutexGuard<'_, Vec<u8>> {
    bytes.lock().unwrap_or_else(PoisonError::into_inner)
}
