//! Pictures to H.264, a frame at a time.
//!
//! Colours: pictures come as sRGB-encoded RGBA and are converted to 4:2:0 with
//! the BT.601 matrix in limited range. That matrix, sRGB's primaries (those of
//! BT.709) and sRGB's transfer curve are written into the stream (H.264
//! Annex E), so that no player has to guess the matrix from the frame's size.

use openh264::OpenH264API;
use openh264::encoder::{
    BitRate, ColorPrimaries, Encoder, EncoderConfig, FrameRate, FrameType, IntraFramePeriod,
    MatrixCoefficients, QpRange, RateControlMode, TransferCharacteristics, VuiConfig,
};
use openh264::formats::{RgbaSliceU8, YUVBuffer};

/// H.264's quantiser, 0 to 51, of a film. At 20 one of 10 s has 2 MB.
const FILM: u8 = 20;

/// That of a live view, which has a line to keep within: text stays readable.
const LIVE: u8 = 28;

/// More bits a second than any film here has (one of 960 × 540 has 1.6 million).
pub(crate) const MOST_BITS: u32 = 100_000_000;

/// A key frame at least every two seconds, so that seeking stays quick.
const SECONDS_BETWEEN_KEY_FRAMES: u32 = 2;

/// An encoder of pictures of one size.
pub struct H264 {
    encoder: Encoder,
    picture: YUVBuffer,
    size: (usize, usize),
    coded: Vec<u8>,
}

/// A coded frame.
#[derive(Debug, Clone, Copy)]
pub struct Coded<'a> {
    /// Annex B: each unit behind a start code; a key frame has its parameter sets before it.
    pub bytes: &'a [u8],
    /// Whether a player can begin with it.
    pub is_key: bool,
}

impl H264 {
    /// Of `width` × `height` pixels at `fps` frames a second.
    ///
    /// # Errors
    /// An error of the encoder.
    pub fn new(size: [u32; 2], fps: u32) -> Result<Self, openh264::Error> {
        Self::with_quantiser(size, fps, FILM)
    }

    /// An encoder for a live view: of `size` (width and height, pixels) at `fps` frames a second, with a coarser quantiser than
    /// [`H264::new`] uses for a film.
    ///
    /// # Errors
    /// An error of the encoder.
    pub fn live(size: [u32; 2], fps: u32) -> Result<Self, openh264::Error> {
        Self::with_quantiser(size, fps, LIVE)
    }

    fn with_quantiser(
        [width, height]: [u32; 2],
        fps: u32,
        quantiser: u8,
    ) -> Result<Self, openh264::Error> {
        let size = (width as usize, height as usize);
        let config = config(fps, quantiser);
        Ok(Self {
            encoder: Encoder::with_api_config(OpenH264API::from_source(), config)?,
            picture: YUVBuffer::new(size.0, size.1),
            size,
            coded: Vec::new(),
        })
    }

    /// The next frame is a key frame, whenever the last one was.
    pub fn begin_anew(&mut self) {
        self.encoder.force_intra_frame();
    }

    /// The next frame, of rows from the top, RGBA; `None` where it has more detail than the stream holds.
    ///
    /// # Errors
    /// An error of the encoder.
    pub fn encode(&mut self, rgba: &[u8]) -> Result<Option<Coded<'_>>, openh264::Error> {
        self.picture.read_rgba8(RgbaSliceU8::new(rgba, self.size));
        let stream = self.encoder.encode(&self.picture)?;
        if matches!(stream.frame_type(), FrameType::Skip) {
            return Ok(None);
        }
        self.coded.clear();
        stream.write_vec(&mut self.coded);
        let is_key = matches!(stream.frame_type(), FrameType::IDR);
        Ok(Some(Coded {
            bytes: &self.coded,
            is_key,
        }))
    }
}

fn config(fps: u32, quantiser: u8) -> EncoderConfig {
    EncoderConfig::new()
        .max_frame_rate(FrameRate::from_hz(fps as f32))
        // One quantiser: a file has no line to keep within, so a splash may
        // cost more bits than still water, and it stays as sharp. Without
        // rate control it would be 26, where what a moving edge leaves
        // behind falls below the quantiser, and stays as dark dots on the
        // wall until the next key frame. This mode heeds the range.
        .rate_control_mode(RateControlMode::Quality)
        .qp(QpRange::new(quantiser, quantiser))
        // So high that no frame is skipped for it. With skipping off, the
        // encoder would print a warning.
        .bitrate(BitRate::from_bps(MOST_BITS))
        .skip_frames(true)
        // It takes such dots for the background, and keeps them too.
        .background_detection(false)
        .intra_frame_period(IntraFramePeriod::from_num_frames(
            fps * SECONDS_BETWEEN_KEY_FRAMES,
        ))
        // The other core belongs to the simulation.
        .num_threads(1)
        .vui(
            VuiConfig::bt601()
                .color_primaries(ColorPrimaries::Bt709)
                .transfer_characteristics(TransferCharacteristics::Srgb)
                .matrix_coefficients(MatrixCoefficients::Smpte170M),
        )
}
