//! Pictures that wait for a socket: bounded, and left out so that a decoder never gets a part of a group.

use std::collections::VecDeque;

use axum::body::Bytes;

use crate::picture::{Codec, EncodedPicture};
use crate::port::PICTURES;

/// Pictures without a key frame after which one is asked for again: a second's.
const ASK_AGAIN: u64 = 60;

/// A bounded queue of coded pictures for one socket.
#[derive(Debug, Default)]
pub(crate) struct Pictures {
    queue: VecDeque<Bytes>,
    /// Whether a key frame is needed before any picture of H.264 is of use.
    waits: bool,
    /// Pictures that came since then.
    since: u64,
    /// Number of pictures that were left out.
    pub left_out: u64,
}

impl Pictures {
    /// Empties the queue for a new decoder, which needs a key frame; the caller has to ask for one.
    pub fn restart(&mut self) {
        self.queue.clear();
        self.waits = true;
        self.since = 1;
    }

    /// Queues `message`, which is `picture` as a message, behind a gap in its stream if `gap`. Returns whether a key frame is to be asked
    /// for: at once, and not again for each picture that was under way by then.
    pub fn push(&mut self, gap: bool, picture: &EncodedPicture, message: Bytes) -> bool {
        if picture.codec != Codec::H264 {
            // Each stands alone: only the last one is worth sending.
            self.left_out += self.queue.len() as u64;
            self.queue.clear();
            self.queue.push_back(message);
            return false;
        }
        if picture.is_key {
            self.waits = false;
        } else if gap || self.queue.len() >= PICTURES {
            self.since = if self.waits { self.since } else { 0 };
            self.waits = true;
        }
        if self.waits {
            self.left_out += 1;
            self.since += 1;
            return (self.since - 1).is_multiple_of(ASK_AGAIN);
        }
        if self.queue.len() >= PICTURES {
            // Pictures before a key frame are not needed for it.
            self.left_out += self.queue.len() as u64;
            self.queue.clear();
        }
        self.queue.push_back(message);
        false
    }

    /// Takes the next message.
    pub fn pop(&mut self) -> Option<Bytes> {
        self.queue.pop_front()
    }

    /// How many messages wait.
    pub fn len(&self) -> usize {
        self.queue.len()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn push(pictures: &mut Pictures, codec: Codec, is_key: bool, gap: bool, n: u8) -> bool {
        let picture = EncodedPicture {
            codec,
            is_key,
            size: [1, 1],
            time_us: 0,
            bytes: vec![n],
        };
        pictures.push(gap, &picture, Bytes::from(vec![n]))
    }

    fn rest(pictures: &mut Pictures) -> Vec<u8> {
        std::iter::from_fn(|| pictures.pop())
            .map(|b| b[0])
            .collect()
    }

    #[test]
    fn a_decoder_gets_whole_runs() {
        let mut pictures = Pictures::default();
        let mut h264 = |is_key, gap, n| push(&mut pictures, Codec::H264, is_key, gap, n);
        assert!(!h264(true, false, 0));
        assert!(!h264(false, false, 1));
        assert!(h264(false, true, 2), "behind a gap");
        assert!(!h264(false, false, 3), "it was asked for");
        assert!(!h264(true, false, 4));
        assert!(!h264(false, false, 5));
        assert_eq!(rest(&mut pictures), [0, 1, 4, 5]);
        pictures.restart();
        let asked = (0..120).filter(|_| push(&mut pictures, Codec::H264, false, true, 6));
        assert_eq!(asked.count(), 2, "again where none has come");
        assert_eq!(pictures.left_out, 122);
    }

    #[test]
    fn it_is_bounded() {
        let mut pictures = Pictures::default();
        for n in 0..200 {
            push(&mut pictures, Codec::H264, n % 50 == 0, false, n);
            assert!(pictures.len() <= PICTURES);
        }
        // The last key frame is 150; the pictures that waited before it were dropped.
        let expected: Vec<u8> = (150..150 + PICTURES as u8).collect();
        assert_eq!(rest(&mut pictures), expected);
        for codec in [Codec::Jpeg, Codec::CloseUp] {
            for n in 0..100 {
                push(&mut pictures, codec, true, false, n);
            }
            assert_eq!(rest(&mut pictures), [99]);
        }
    }
}
