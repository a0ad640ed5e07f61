//! The encoder of frames into an .mp4.

use crate::{Frame, RenderError, yuv::Planes};
use muxide::api::{Muxer, MuxerBuilder, VideoCodec};
use openh264::{
    OpenH264API, Timestamp,
    encoder::{
        BitRate, Complexity, Encoder, EncoderConfig, FrameRate, FrameType, IntraFramePeriod, Profile,
        QpRange, RateControlMode, UsageType, VuiConfig,
    },
    formats::YUVSlices,
};
use std::io::Write;

/// Turns frames into an H.264 (constrained baseline, 4:2:0, BT.709) .mp4 that starts playing before it is
/// fully loaded. There is a key frame every two seconds, so that seeking is quick.
///
/// Equal frames give equal bytes: one thread, constant quality, no clock.
///
/// Nothing is written before [`VideoEncoder::finish`]; an encoder that is dropped leaves its writer as it
/// was. Until then the encoded pictures are kept in memory (a few hundred bytes each).
pub struct VideoEncoder<W: Write> {
    encoder: Encoder,
    muxer: Muxer<W>,
    planes: Planes,
    packet: Vec<u8>,
    width: u32,
    height: u32,
    frames_per_second: u32,
    frame_count: usize,
}

/// Quantisation: 0 is lossless, 51 is worst. At 31 edges and eyes are crisp and 25 s of an event take some
/// 290 kB; at 24 they take nearly twice that, and above 31 white ground begins to show off-white blocks.
const QUANTISATION: u8 = 31;
/// Seconds from one key frame to the next; with every second its own, videos grow by a tenth.
const KEY_FRAME_SECONDS: u32 = 2;
/// Bits per second named to the encoder, which takes no notice of it at constant quality.
const BIT_RATE: u32 = 1_000_000;
/// Sides the encoder takes (pixels).
const SIDES: std::ops::RangeInclusive<u32> = 16..=2160;

impl<W: Write> VideoEncoder<W> {
    /// An encoder for frames of one size (pixels), to be played at a constant rate (1 to 120, usually
    /// [`phase_model::arena::FRAMES_PER_SECOND`]).
    ///
    /// # Errors
    /// [`RenderError::OddSize`] if width or height is odd, [`RenderError::VideoSize`] if one is below 16 or
    /// above 2160, [`RenderError::FrameRate`], or an error of the encoder's set-up.
    pub fn new(writer: W, width: u32, height: u32, frames_per_second: u32) -> Result<Self, RenderError> {
        if !width.is_multiple_of(2) || !height.is_multiple_of(2) {
            return Err(RenderError::OddSize { width, height });
        }
        if !SIDES.contains(&width) || !SIDES.contains(&height) {
            return Err(RenderError::VideoSize { width, height });
        }
        if !(1..=120).contains(&frames_per_second) {
            return Err(RenderError::FrameRate(frames_per_second));
        }
        let encoder = Encoder::with_api_config(OpenH264API::from_source(), config(frames_per_second))?;
        let muxer = MuxerBuilder::new(writer)
            .video(VideoCodec::H264, width, height, f64::from(frames_per_second))
            .with_fast_start(true)
            .build()?;
        Ok(Self {
            encoder,
            muxer,
            planes: Planes::new(width, height),
            packet: Vec::new(),
            width,
            height,
            frames_per_second,
            frame_count: 0,
        })
    }

    /// Adds a frame, shown for 1 / frames per second.
    ///
    /// # Errors
    /// [`RenderError::FrameSize`] if the frame is not of the video's size, or an error of the encoder.
    pub fn push(&mut self, frame: &Frame) -> Result<(), RenderError> {
        let index = self.frame_count;
        let width = self.width;
        let height = self.height;
        let found_width = frame.width();
        let found_height = frame.height();
        if (found_width, found_height) != (width, height) {
            return Err(RenderError::FrameSize { index, found_width, found_height, width, height });
        }
        self.planes.read(frame.rgba());
        let source = YUVSlices::new(
            (self.planes.luma(), self.planes.blue(), self.planes.red()),
            self.planes.size(),
            (width as usize, width as usize / 2, width as usize / 2),
        );
        let seconds = index as f64 / f64::from(self.frames_per_second);
        let milliseconds = 1000 * index as u64 / u64::from(self.frames_per_second);
        let encoded = self.encoder.encode_at(&source, Timestamp::from_millis(milliseconds))?;
        let stands_alone = matches!(encoded.frame_type(), FrameType::IDR);
        self.packet.clear();
        encoded.write_vec(&mut self.packet);
        if self.packet.is_empty() {
            return Err(RenderError::SkippedFrame(index));
        }
        self.muxer.write_video(seconds, &self.packet, stands_alone)?;
        self.frame_count += 1;
        Ok(())
    }

    /// Number of frames added so far.
    #[must_use]
    pub const fn frame_count(&self) -> usize {
        self.frame_count
    }

    /// Writes the .mp4 and gives the writer back, not flushed.
    ///
    /// A video of a single frame has no length to speak of (1/90000 s), as there is no second frame to end
    /// it.
    ///
    /// # Errors
    /// [`RenderError::NoFrames`] if no frame was added, [`RenderError::Container`] if the writer fails.
    pub fn finish(mut self) -> Result<W, RenderError> {
        if self.frame_count == 0 {
            return Err(RenderError::NoFrames("video"));
        }
        self.muxer.finish_in_place()?;
        Ok(self.muxer.into_writer())
    }
}

/// Constant quality, regular key frames, and no scene-dependent decisions of the encoder about either.
fn config(frames_per_second: u32) -> EncoderConfig {
    EncoderConfig::new()
        .profile(Profile::Baseline)
        .usage_type(UsageType::CameraVideoRealTime)
        .complexity(Complexity::Low)
        // The other modes trade quality for bits or ignore the range below. This one only follows the
        // receiver's buffer, which is not reported here, so the range decides alone.
        .rate_control_mode(RateControlMode::Bufferbased)
        .qp(QpRange::new(QUANTISATION, QUANTISATION))
        .bitrate(BitRate::from_bps(BIT_RATE))
        .max_frame_rate(FrameRate::from_hz(frames_per_second as f32))
        .intra_frame_period(IntraFramePeriod::from_num_frames(KEY_FRAME_SECONDS * frames_per_second))
        .skip_frames(false)
        .scene_change_detect(false)
        .adaptive_quantization(false)
        .background_detection(false)
        .long_term_reference(false)
        .num_threads(1)
        .vui(VuiConfig::bt709())
}
