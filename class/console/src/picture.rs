//! Coded pictures of a student's view.

use serde::{Deserialize, Serialize};

/// Bytes of a coded picture. Our choice: one of 1920 × 1080 that is hard to code has 1 to 2 million.
pub const MOST_PICTURE: usize = 4 << 20;

/// The first byte of a message with a picture for a card.
const CARD_MARK: u8 = 3;
/// That of one with a picture from close to the glass.
const CLOSE_UP_MARK: u8 = 4;

/// Bytes before a picture's own on a socket.
pub(crate) const HEAD: usize = 16;

/// Longest side of a picture for a card of the class, pixels. Our choice: hands and glass are told apart in it.
const CARD_SIDE: u16 = 160;

/// Bytes of a coded picture for a card: 5 bits for each of 160 × 160 pixels. Our choice: white noise has fewer.
pub(crate) const MOST_CARD: usize = 16_000;

/// JPEG's quality, 1 to 100. Our choice: text on the panel stays readable.
const QUALITY: u8 = 75;
/// That of a picture for a card. Our choice: nothing is read in it, and noise stays below [`MOST_CARD`].
const CARD_QUALITY: u8 = 60;

/// How a picture is coded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Codec {
    /// A frame of an H.264 stream, Annex B, parameter sets before each key frame.
    H264,
    /// A JPEG file.
    Jpeg,
    /// A small JPEG file for a card of the class. No page asks for it by name.
    #[serde(skip_deserializing)]
    Card,
    /// A JPEG file of the glass from close by, in place of the student's view.
    CloseUp,
}

impl Codec {
    /// Most bytes of a picture of this kind.
    pub(crate) fn most(self) -> usize {
        match self {
            Self::H264 | Self::Jpeg | Self::CloseUp => MOST_PICTURE,
            Self::Card => MOST_CARD,
        }
    }
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
        Ok(Self {
            codec: Codec::Jpeg,
            is_key: true,
            size,
            time_us,
            bytes: coded(rgba, size, QUALITY)?,
        })
    }

    /// A JPEG of `rgba`, rows from the top, which shows the glass from close by.
    ///
    /// # Errors
    /// As for [`Self::jpeg`].
    pub fn close_up(rgba: &[u8], size: [u16; 2], time_us: u64) -> Result<Self, JpegError> {
        Ok(Self {
            codec: Codec::CloseUp,
            ..Self::jpeg(rgba, size, time_us)?
        })
    }

    /// A small JPEG of `rgba`, rows from the top, for a card of the class: its longest side has 160 pixels at most.
    ///
    /// # Errors
    /// [`JpegError`] where `size` is empty. A pixel that is missing at the end of `rgba` is black.
    pub fn card(rgba: &[u8], size: [u16; 2], time_us: u64) -> Result<Self, JpegError> {
        let (small, size) = shrunk(rgba, size);
        Ok(Self {
            codec: Codec::Card,
            is_key: true,
            size,
            time_us,
            bytes: coded(&small, size, CARD_QUALITY)?,
        })
    }

    /// As a binary message: codec, whether it is a key frame, two bytes of zero, width and height (u16), time (u64,
    /// µs), all little-endian, then the coder's bytes.
    pub(crate) fn to_message(&self) -> Vec<u8> {
        let mut message = Vec::with_capacity(HEAD + self.bytes.len());
        message.push(match self.codec {
            Codec::H264 => 1,
            Codec::Jpeg => 2,
            Codec::Card => CARD_MARK,
            Codec::CloseUp => CLOSE_UP_MARK,
        });
        message.extend([u8::from(self.is_key), 0, 0]);
        message.extend(self.size[0].to_le_bytes());
        message.extend(self.size[1].to_le_bytes());
        message.extend(self.time_us.to_le_bytes());
        message.extend(&self.bytes);
        message
    }

    /// As a binary message to a page that shows the class: [`CARD_MARK`], three bytes of zero, the student's number (u32, little-endian),
    /// then the coder's bytes.
    pub(crate) fn to_card(&self, student: u32) -> Vec<u8> {
        let mut message = vec![CARD_MARK, 0, 0, 0];
        message.extend(student.to_le_bytes());
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
            CARD_MARK => Codec::Card,
            CLOSE_UP_MARK => Codec::CloseUp,
            _ => return None,
        };
        if key > 1 || bytes.is_empty() || bytes.len() > codec.most() {
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

/// A JPEG file of `rgba`, rows from the top.
fn coded(rgba: &[u8], size: [u16; 2], quality: u8) -> Result<Vec<u8>, JpegError> {
    let mut bytes = Vec::new();
    let mut encoder = jpeg_encoder::Encoder::new(&mut bytes, quality);
    // A quarter of the colour samples, as H.264 has here.
    encoder.set_sampling_factor(jpeg_encoder::SamplingFactor::F_2_2);
    encoder.encode(rgba, size[0], size[1], jpeg_encoder::ColorType::Rgba)?;
    Ok(bytes)
}

/// `rgba` with its longest side at [`CARD_SIDE`] at most, and its size: each pixel is the mean of those that it stands for.
fn shrunk(rgba: &[u8], size: [u16; 2]) -> (Vec<u8>, [u16; 2]) {
    let longest = size[0].max(size[1]).max(1);
    let small = size.map(|side| {
        let scaled = u32::from(side) * u32::from(CARD_SIDE.min(longest)) / u32::from(longest);
        // A side that is not empty stays so.
        (scaled as u16).max(side.min(1))
    });
    let [wide, high] = size.map(usize::from);
    let [columns, rows] = small.map(usize::from);
    let mut pixels = Vec::with_capacity(4 * columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let across = column * wide / columns..(column + 1) * wide / columns;
            let down = row * high / rows..(row + 1) * high / rows;
            let count = (across.len() * down.len()) as u32;
            let mut sums = [0_u32; 4];
            for y in down {
                let bytes = 4 * (y * wide + across.start)..4 * (y * wide + across.end);
                for pixel in rgba.get(bytes).unwrap_or_default().chunks_exact(4) {
                    for (sum, value) in sums.iter_mut().zip(pixel) {
                        *sum += u32::from(*value);
                    }
                }
            }
            pixels.extend(sums.map(|sum| (sum / count) as u8));
        }
    }
    (pixels, small)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// By hand: 160 : 320 = 80 : 160, and 673 · 160 / 720 = 149.6.
    #[test]
    fn a_card_is_small_and_no_picture_grows() {
        for (size, small) in [
            ([320, 160], [160, 80]),
            ([673, 720], [149, 160]),
            ([3, 2], [3, 2]),
            ([2000, 1], [160, 1]),
            ([0, 7], [0, 7]),
        ] {
            let [wide, high] = size.map(usize::from);
            let grey = vec![77_u8; 4 * wide * high];
            let (pixels, shown) = shrunk(&grey, size);
            assert_eq!(shown, small, "{size:?}");
            let [wide, high] = small.map(usize::from);
            assert_eq!(pixels, vec![77_u8; 4 * wide * high], "{size:?}");
        }
        assert!(EncodedPicture::card(&[], [0, 7], 0).is_err());
    }

    /// A pixel is the mean of the four that it stands for, and left stays left.
    #[test]
    fn a_card_shows_what_the_picture_shows() {
        let line = |values: [u8; 2]| values.map(|it| [it, 0, 0, 255].repeat(160)).concat();
        let rgba = [line([10, 200]), line([30, 220])].concat();
        let (pixels, size) = shrunk(&rgba, [320, 2]);
        assert_eq!(size, [160, 1]);
        let (left, right) = pixels.split_at(4 * 80);
        assert_eq!(left, [20_u8, 0, 0, 255].repeat(80));
        assert_eq!(right, [210_u8, 0, 0, 255].repeat(80));
        // Rows that are missing are black.
        let (pixels, _) = shrunk(&rgba[..4 * 320], [320, 2]);
        assert_eq!(pixels[..4], [5, 0, 0, 127]);
    }

    /// Noise is the hardest picture to code: white noise in each colour, from a linear congruential generator.
    #[test]
    fn no_card_is_too_long() {
        let mut seed = 1_u32;
        let mut noise = || {
            // Numerical Recipes, 7.1.
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 24) as u8
        };
        let side = CARD_SIDE;
        let rgba: Vec<u8> = (0..4 * usize::from(side).pow(2)).map(|_| noise()).collect();
        let picture = EncodedPicture::card(&rgba, [side, side], 0).unwrap();
        assert_eq!(picture.size, [side, side]);
        let bytes = picture.bytes.len();
        assert!(bytes <= MOST_CARD, "{bytes} bytes");
    }

    #[test]
    fn a_card_arrives_as_it_went_and_a_longer_one_does_not() {
        let mut picture = EncodedPicture {
            codec: Codec::Card,
            is_key: true,
            size: [160, 90],
            time_us: 7,
            bytes: vec![1; MOST_CARD],
        };
        let message = picture.to_message();
        assert_eq!(message[0], 3);
        assert_eq!(
            EncodedPicture::from_message(&message),
            Some(picture.clone())
        );
        picture.bytes.push(1);
        assert_eq!(EncodedPicture::from_message(&picture.to_message()), None);
        picture.bytes = vec![9, 8];
        assert_eq!(picture.to_card(258), [3, 0, 0, 0, 2, 1, 0, 0, 9, 8]);
    }
}
