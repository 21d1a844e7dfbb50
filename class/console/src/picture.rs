//! Coded pictures of a student's view.

use serde::{Deserialize, Serialize};

/// Bytes of a coded picture. Our choice: one of 1920 × 1080 that is hard to code has 1 to 2 million.
pub const MOST_PICTURE: usize = 4 << 20;

/// Bytes before a picture's own on a socket.
pub(crate) const HEAD: usize = 16;

/// JPEG's quality, 1 to 100. Our choice: text on the panel stays readable.
const QUALITY: u8 = 75;

/// How a picture is coded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Codec {
    /// A frame of an H.264 stream, Annex B, parameter sets before each key frame.
    H264,
    /// A JPEG file.
    Jpeg,
}

/// A coded picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EncodedPicture {
    /// How it is coded.
    pub codec: Codec,
    /// Whether a decoder can begin with it.
    pub is_key: bool,
    /// Width and height, pixels.
    pub size: [u16; 2],
    /// Time since the stream's beginning, µs.
    pub time_us: u64,
    /// The encoder's bytes.
    pub bytes: Vec<u8>,
}

/// Why a picture could not be coded as JPEG.
#[derive(Debug, thiserror::Error)]
#[error("a picture could not be coded as JPEG: {0}; it is left out of the live view")]
pub struct JpegError(#[from] jpeg_encoder::EncodingError);

impl EncodedPicture {
    /// A JPEG of `rgba`, rows from the top.
    ///
    /// # Errors
    /// [`JpegError`] where `rgba` does not have 4 bytes for each pixel of `size`, or `size` is empty.
    pub fn jpeg(rgba: &[u8], size: [u16; 2], time_us: u64) -> Result<Self, JpegError> {
        let mut bytes = Vec::new();
        let mut encoder = jpeg_encoder::Encoder::new(&mut bytes, QUALITY);
        // A quarter of the colour samples, as H.264 has here.
        encoder.set_sampling_factor(jpeg_encoder::SamplingFactor::F_2_2);
        encoder.encode(rgba, size[0], size[1], jpeg_encoder::ColorType::Rgba)?;
        Ok(Self {
            codec: Codec::Jpeg,
            is_key: true,
            size,
            time_us,
            bytes,
        })
    }

    /// As a binary message: codec, whether it is a key frame, two bytes of zero, width and height (u16), time (u64,
    /// µs), all little-endian, then the coder's bytes.
    pub(crate) fn to_message(&self) -> Vec<u8> {
        let mut message = Vec::with_capacity(HEAD + self.bytes.len());
        message.push(match self.codec {
            Codec::H264 => 1,
            Codec::Jpeg => 2,
        });
        message.extend([u8::from(self.is_key), 0, 0]);
        message.extend(self.size[0].to_le_bytes());
        message.extend(self.size[1].to_le_bytes());
        message.extend(self.time_us.to_le_bytes());
        message.extend(&self.bytes);
        message
    }

    /// Parses a message of [`Self::to_message`]; `None` of anything else.
    pub(crate) fn from_message(message: &[u8]) -> Option<Self> {
        let (head, bytes) = message.split_first_chunk::<HEAD>()?;
        let &[codec, key, 0, 0, w0, w1, h0, h1, ref time @ ..] = head else {
            return None;
        };
        let codec = match codec {
            1 => Codec::H264,
            2 => Codec::Jpeg,
            _ => return None,
        };
        if key > 1 || bytes.is_empty() || bytes.len() > MOST_PICTURE {
            return None;
        }
        Some(Self {
            codec,
            is_key: key == 1,
            size: [u16::from_le_bytes([w0, w1]), u16::from_le_bytes([h0, h1])],
            time_us: u64::from_le_bytes(*time),
            bytes: bytes.to_vec(),
        })
    }
}
