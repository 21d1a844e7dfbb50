//! Whether the lengths that a record declares fit into it. mcap 0.26 reserves memory for a text as long as
//! its length says, up to 4 GB, before it looks whether there is any of it.

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

/// Whether all records of a file's chunks that are not compressed end within their chunk. mcap 0.26 subtracts each from what is
/// left of the chunk without looking: a debug build panics, a release build goes on behind the chunk. In a compressed one
/// it looks.
pub(super) fn fit_chunks(file: &[u8]) -> bool {
    let records = Records(file.get(MAGIC.len()..).unwrap_or_default());
    for (opcode, content) in records {
        if opcode != op::CHUNK {
            continue;
        }
        // Times of its first and last message, size, checksum; then the compression's name.
        let mut rest = Rest(content);
        let header = rest.skip(28).and_then(|()| rest.length());
        let Some(name) = header.and_then(|length| rest.take(length)) else {
            return false;
        };
        if !name.is_empty() {
            continue;
        }
        let records = rest.skip(8).map(|()| Records(rest.0));
        let whole = |records: Records<'_>| {
            let walked: usize = records
                .map(|(_, content)| RECORD_HEADER + content.len())
                .sum();
            walked == rest.0.len()
        };
        if !records.is_some_and(whole) {
            return false;
        }
    }
    true
}

/// Of a record, B: its kind and its length.
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

/// What of a record has not been walked over yet.
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
