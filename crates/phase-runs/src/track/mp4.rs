//! H.264 in an .mp4.

use super::{
    Sink, VideoError,
    boxes::{self, Sample, Video, unreadable},
};
use mp4_atom::Avcc;
use openh264::{
    OpenH264API,
    decoder::{DecodedYUV, Decoder, DecoderConfig, Flush},
    formats::YUVSource,
};
use phase_track::{MOST_PIXELS_ACROSS, TrackError};
use std::{
    fs::File,
    io::{BufReader, Read, Seek, SeekFrom},
};

/// Greatest size of a compressed picture (bytes).
const LARGEST_SAMPLE: u32 = 1 << 24;

/// Decodes the first video of a file.
pub(super) fn decode(file: File, sink: Sink<'_>) -> Result<(), VideoError> {
    let length = file.metadata()?.len();
    let mut file = BufReader::new(file);
    let Video { parameters, size: (width, height), timescale, samples } = boxes::read(&mut file, length)?;
    if width.max(height) > MOST_PIXELS_ACROSS {
        return Err(TrackError::Size { width, height }.into());
    }
    if samples.is_empty() {
        return Err(unreadable("it has 0 frames".into()));
    }
    let length_size = usize::from(parameters.length_size);
    let parameters = parameter_sets(&parameters);
    let mut times: Vec<i64> = samples.iter().map(|sample| sample.time).collect();
    times.sort_unstable();
    let mut shown = Shown { sink, times: times.into_iter(), scale: f64::from(timescale), rgb: Vec::new() };
    let failed = |error: openh264::Error| unreadable(format!("a picture cannot be decoded ({error})"));
    let configuration = DecoderConfig::new().flush_after_decode(Flush::NoFlush);
    let mut decoder = Decoder::with_api_config(OpenH264API::from_source(), configuration).map_err(failed)?;
    decoder.decode(&parameters).map_err(failed)?;
    let mut sample = Vec::new();
    let mut packet = Vec::new();
    for Sample { offset, size, .. } in samples {
        if size > LARGEST_SAMPLE || offset.checked_add(size.into()).is_none_or(|end| end > length) {
            return Err(unreadable("it ends before its last picture".into()));
        }
        file.seek(SeekFrom::Start(offset))?;
        sample.resize(size as usize, 0);
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

/// Parameter sets behind start codes.
fn parameter_sets(parameters: &Avcc) -> Vec<u8> {
    let sets = parameters.sequence_parameter_sets.iter().chain(&parameters.picture_parameter_sets);
    sets.flat_map(|set| [0, 0, 0, 1].iter().chain(set)).copied().collect()
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
