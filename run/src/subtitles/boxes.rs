//! Boxes of an MP4 file (ISO/IEC 14496-12, 4.2): four bytes of size, four of name, and what is in it.

use std::ops::Range;

use super::SubtitlesError;

/// The boxes in these bytes, each with its name and its body; ends at one that is not whole.
pub struct Boxes<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Boxes<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// Where the next body is.
    fn next_range(&mut self) -> Option<([u8; 4], Range<usize>)> {
        let size = u32_at(self.bytes, self.at)? as usize;
        let name = self.bytes.get(self.at + 4..self.at + 8)?.try_into().ok()?;
        let body = self.at + 8..self.at.checked_add(size)?;
        self.bytes.get(body.clone())?;
        self.at = body.end;
        Some((name, body))
    }
}

impl<'a> Iterator for Boxes<'a> {
    type Item = ([u8; 4], &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let (name, body) = self.next_range()?;
        Some((name, &self.bytes[body]))
    }
}

/// Where the body of the first box of that name is.
pub fn find(bytes: &[u8], name: &[u8; 4]) -> Option<Range<usize>> {
    let mut boxes = Boxes::new(bytes);
    while let Some((found, body)) = boxes.next_range() {
        if found == *name {
            return Some(body);
        }
    }
    None
}

/// The number at that byte.
pub fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_be_bytes(four.try_into().ok()?))
}

/// A size or an offset in a file of less than 4 GiB.
pub fn size_of(bytes: usize) -> Result<u32, SubtitlesError> {
    u32::try_from(bytes).map_err(|_| SubtitlesError::TooLarge)
}

/// A box of these parts.
pub fn made(name: &[u8; 4], parts: &[&[u8]]) -> Result<Vec<u8>, SubtitlesError> {
    let length = 8 + parts.iter().map(|part| part.len()).sum::<usize>();
    let mut bytes = Vec::with_capacity(length);
    bytes.extend(size_of(length)?.to_be_bytes());
    bytes.extend(name);
    bytes.extend(parts.concat());
    Ok(bytes)
}

/// Adds `by` to the offsets of the samples in each track of a `moov`; `None` where a track holds no offsets.
pub fn shift_chunks(moov: &mut [u8], by: u32) -> Option<()> {
    let mut boxes = Boxes::new(moov);
    let mut tracks = Vec::new();
    while let Some((name, body)) = boxes.next_range() {
        if &name == b"trak" {
            tracks.push(body);
        }
    }
    for track in tracks {
        let mut within = track;
        for name in [b"mdia", b"minf", b"stbl", b"stco"] {
            let body = find(moov.get(within.clone())?, name)?;
            within = within.start + body.start..within.start + body.end;
        }
        let table = moov.get_mut(within)?;
        let count = u32_at(table, 4)? as usize;
        for entry in table.get_mut(8..8 + 4 * count)?.chunks_exact_mut(4) {
            let moved = u32_at(entry, 0)?.checked_add(by)?;
            entry.copy_from_slice(&moved.to_be_bytes());
        }
    }
    Some(())
}
