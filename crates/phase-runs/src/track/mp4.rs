//! H.264 in an .mp4.

use super::{Sink, VideoError};
use openh264::{
    OpenH264API,
    decoder::{DecodedYUV, Decoder, DecoderConfig, Flush},
    formats::YUVSource,
};
use phase_track::{MOST_PIXELS_ACROSS, TrackError};
use re_mp4::{Mp4, Sample, TrackKind};
use std::{
    fs::File,
    io::{BufReader, Read, Seek, SeekFrom},
};

/// Greatest size of a compressed picture (bytes).
const LARGEST_SAMPLE: u64 = 1 << 24;
/// Greatest number of pictures: an hour at 240 a second.
const MOST_SAMPLES: usize = 864_000;

/// Decodes the first video of a file.
pub(super) fn decode(file: File, sink: Sink<'_>) -> Result<(), VideoError> {
    let length = file.metadata()?.len();
    let mut file = BufReader::new(file);
    let unreadable = |rule: String| VideoError::Unreadable(rule);
    let mp4 = Mp4::read(&mut file, length).map_err(|error| unreadable(format!("as .mp4, {error}")))?;
    let video = mp4.tracks().values().find(|track| track.kind == Some(TrackKind::Video));
    let video = video.ok_or_else(|| unreadable("it has no pictures".into()))?;
    let size = (usize::from(video.width), usize::from(video.height));
    if size.0.max(size.1) > MOST_PIXELS_ACROSS {
        return Err(TrackError::Size { width: size.0, height: size.1 }.into());
    }
    let is_h264 = video.codec_string(&mp4).is_some_and(|codec| codec.starts_with("avc"));
    let configuration = video.raw_codec_config(&mp4).filter(|_| is_h264);
    let configuration = configuration.ok_or_else(|| unreadable("it is not H.264".into()))?;
    let (parameters, length_size) = parameter_sets(&configuration)
        .ok_or_else(|| unreadable("its H.264 parameters are damaged".into()))?;
    let samples: &[Sample] = &video.samples;
    if samples.is_empty() {
        return Err(unreadable("it has 0 frames".into()));
    }
    if samples.len() > MOST_SAMPLES || video.timescale == 0 {
        return Err(TrackError::Long(3600).into());
    }
    let mut times: Vec<i64> = samples.iter().map(|sample| sample.composition_timestamp).collect();
    times.sort_unstable();
    let mut shown = Shown { sink, times: times.into_iter(), scale: video.timescale as f64, rgb: Vec::new() };
    let failed = |error: openh264::Error| unreadable(format!("a picture cannot be decoded ({error})"));
    let configuration = DecoderConfig::new().flush_after_decode(Flush::NoFlush);
    let mut decoder = Decoder::with_api_config(OpenH264API::from_source(), configuration).map_err(failed)?;
    decoder.decode(&parameters).map_err(failed)?;
    let mut sample = Vec::new();
    let mut packet = Vec::new();
    for Sample { offset, size, .. } in samples {
        if *size > LARGEST_SAMPLE || offset.checked_add(*size).is_none_or(|end| end > length) {
            return Err(unreadable("it ends before its last picture".into()));
        }
        file.seek(SeekFrom::Start(*offset))?;
        sample.resize(*size as usize, 0);
        file.read_exact(&mut sample)?;
        annex_b(&sample, length_size, &mut packet)
            .ok_or_else(|| unreadable("a picture is damaged".into()))?;
        if let Some(picture) = decoder.decode(&packet).map_err(failed)? {
            shown.show(&picture)?;
        }
    }
    for picture in decoder.flush_remaining().map_err(failed)? {
        shown.show(&picture)?;
    }
    if shown.times.next().is_some() {
        return Err(unreadable("not all of its pictures can be decoded".into()));
    }
    Ok(())
}

/// Pictures in the order in which they are shown.
struct Shown<'a> {
    sink: Sink<'a>,
    /// Their times, in units of the file.
    times: std::vec::IntoIter<i64>,
    /// Units a second.
    scale: f64,
    rgb: Vec<u8>,
}

impl Shown<'_> {
    fn show(&mut self, picture: &DecodedYUV<'_>) -> Result<(), VideoError> {
        let (width, height) = picture.dimensions();
        if width.max(height) > MOST_PIXELS_ACROSS {
            return Err(TrackError::Size { width, height }.into());
        }
        let time = self
            .times
            .next()
            .ok_or_else(|| VideoError::Unreadable("it has more pictures than times".into()))?;
        self.rgb.resize(3 * width * height, 0);
        picture.write_rgb8(&mut self.rgb);
        (self.sink)((width, height), &self.rgb, time as f64 / self.scale)
    }
}

/// Parameter sets behind start codes, and the bytes of a length, from an `avcC` box.
fn parameter_sets(configuration: &[u8]) -> Option<(Vec<u8>, usize)> {
    let length_size = usize::from(configuration.get(4)? & 3) + 1;
    let mut sets = Vec::new();
    let mut at = 5;
    for mask in [31, 255] {
        let count = configuration.get(at)? & mask;
        at += 1;
        for _ in 0..count {
            let length =
                usize::from(u16::from_be_bytes([*configuration.get(at)?, *configuration.get(at + 1)?]));
            sets.extend([0, 0, 0, 1]);
            sets.extend(configuration.get(at + 2..at + 2 + length)?);
            at += 2 + length;
        }
    }
    Some((sets, length_size))
}

/// Puts start codes in the places of lengths.
fn annex_b(sample: &[u8], length_size: usize, packet: &mut Vec<u8>) -> Option<()> {
    packet.clear();
    let mut rest = sample;
    while !rest.is_empty() {
        let (length, after) = rest.split_at_checked(length_size)?;
        let length = length.iter().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
        let (unit, after) = after.split_at_checked(length)?;
        packet.extend([0, 0, 0, 1]);
        packet.extend(unit);
        rest = after;
    }
    Some(())
}
