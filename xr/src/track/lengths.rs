//! Checks that the lengths that a record declares fit into it. mcap 0.26 reserves memory for a text of the declared length, up to 4 GB,
//! before it checks that the text is there.

use mcap::MAGIC;
use mcap::records::op;

/// Whether all texts of a schema, channel or metadata record end within it; records of other kinds have none that
/// a track's reader parses.
pub(super) fn fit(opcode: u8, record: &[u8]) -> bool {
    let mut rest = Rest(record);
    let fits = match opcode {
        op::SCHEMA => rest
            .skip(2)
            .and_then(|()| rest.text())
            .and_then(|()| rest.text()),
        op::CHANNEL => rest
            .skip(4)
            .and_then(|()| rest.text())
            .and_then(|()| rest.text())
            .and_then(|()| rest.map()),
        op::METADATA => rest.text().and_then(|()| rest.map()),
        _ => Some(()),
    };
    fits.is_some()
}

/// Where the last chunk begins that is cut off by the end of a file, or else the file's end; `None` where a record of a chunk that is not
/// compressed is longer than its chunk.
///
/// mcap 0.26 subtracts each of these from the rest of the chunk without a check: a debug build panics, a release build goes on behind the
/// chunk. In a compressed chunk it checks. It unpacks a chunk without a checksum before it has the whole of it.
pub(super) fn end_of_whole_chunks(file: &[u8]) -> Option<usize> {
    let mut records = Records(file.get(MAGIC.len()..).unwrap_or_default());
    for (opcode, content) in records.by_ref() {
        if opcode == op::CHUNK && !holds_its_records(content) {
            return None;
        }
    }
    let rest = records.0;
    let is_cut_chunk = rest.first() == Some(&op::CHUNK);
    Some(file.len() - if is_cut_chunk { rest.len() } else { 0 })
}

/// Where a file that has an end ends: behind its footer and the magic number after that.
pub(super) fn end(file: &[u8]) -> Option<usize> {
    let mut records = Records(file.strip_prefix(MAGIC)?);
    records.find(|(opcode, _)| *opcode == op::FOOTER)?;
    let behind = records.0.strip_prefix(MAGIC)?;
    Some(file.len() - behind.len())
}

/// Whether all records of a chunk end within it, as far as that shows before it is unpacked.
fn holds_its_records(chunk: &[u8]) -> bool {
    let mut rest = Rest(chunk);
    // Times of its first and last message, size, checksum; then the compression's name.
    let header = rest.skip(28).and_then(|()| rest.length());
    let Some(name) = header.and_then(|length| rest.take(length)) else {
        return false;
    };
    // The length of its records is there twice: here, which mcap uses, and as the rest of the chunk.
    let Some((length, records)) = rest.0.split_first_chunk::<8>() else {
        return false;
    };
    let walked = Records(records).map(|(_, content)| RECORD_HEADER + content.len());
    let fits = usize::try_from(u64::from_le_bytes(*length)) == Ok(records.len());
    fits && (!name.is_empty() || walked.sum::<usize>() == records.len())
}

/// Size of a record's header, B: its kind and its length.
const RECORD_HEADER: usize = 9;

/// Records, one after the other, as long as they are whole.
struct Records<'a>(&'a [u8]);

impl<'a> Iterator for Records<'a> {
    type Item = (u8, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let (header, behind) = self.0.split_first_chunk::<RECORD_HEADER>()?;
        let [opcode, length @ ..] = *header;
        let length = usize::try_from(u64::from_le_bytes(length)).ok()?;
        let content = behind.get(..length)?;
        self.0 = &behind[length..];
        Some((opcode, content))
    }
}

/// The part of a record that has not been walked over yet.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn take(&mut self, bytes: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(bytes)?;
        self.0 = rest;
        Some(taken)
    }

    fn skip(&mut self, bytes: usize) -> Option<()> {
        self.0 = self.0.get(bytes..)?;
        Some(())
    }

    fn length(&mut self) -> Option<usize> {
        let (length, rest) = self.0.split_first_chunk::<4>()?;
        self.0 = rest;
        usize::try_from(u32::from_le_bytes(*length)).ok()
    }

    fn text(&mut self) -> Option<()> {
        let length = self.length()?;
        self.skip(length)
    }

    /// Pairs of texts, as many as the map's length in bytes holds.
    fn map(&mut self) -> Option<()> {
        let length = self.length()?;
        let end = self.0.len().checked_sub(length)?;
        while self.0.len() > end {
            self.text()?;
            self.text()?;
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(length: u32, bytes: &[u8]) -> Vec<u8> {
        [&length.to_le_bytes()[..], bytes].concat()
    }

    #[test]
    fn a_length_beyond_the_record_is_noticed_wherever_it_is() {
        let (good, long) = (text(2, b"ab"), text(0xbf00_0000, b"ab"));
        let pair = [&good[..], &good[..]].concat();
        let broken = [&good[..], &long[..]].concat();
        let map = |inside: &[u8]| text(inside.len() as u32, inside);
        let cases = [
            (
                op::SCHEMA,
                [&[0; 2], &good[..], &good[..], &[9; 7]].concat(),
                true,
            ),
            (op::SCHEMA, [&[0; 2], &long[..], &good[..]].concat(), false),
            (op::SCHEMA, [&[0; 2], &good[..], &long[..]].concat(), false),
            (
                op::CHANNEL,
                [&[0; 4], &good[..], &good[..], &map(&pair)].concat(),
                true,
            ),
            (
                op::CHANNEL,
                [&[0; 4], &good[..], &long[..], &map(&pair)].concat(),
                false,
            ),
            (
                op::CHANNEL,
                [&[0; 4], &good[..], &good[..], &map(&broken)].concat(),
                false,
            ),
            (op::METADATA, [&good[..], &map(&pair)].concat(), true),
            (op::METADATA, [&good[..], &map(&broken)].concat(), false),
            (op::METADATA, [&good[..], &long[..]].concat(), false),
            (op::METADATA, vec![1, 0], false),
            (op::MESSAGE, vec![0xff; 30], true),
        ];
        for (n, (opcode, record, fits)) in cases.into_iter().enumerate() {
            assert_eq!(fit(opcode, &record), fits, "case {n}");
        }
    }
}
