//! The pictures in an .mp4: where each of them lies in the file, and when it is shown.

use super::VideoError;
use core::iter::repeat_n;
use mp4_atom::{Atom, Avcc, Codec, Header, Moof, Moov, ReadAtom, ReadFrom, Stbl, StszSamples, Trak, Trex};
use phase_track::TrackError;
use std::io::{BufRead, Seek, SeekFrom};

/// Greatest number of pictures: an hour at 240 a second.
const MOST_SAMPLES: usize = 864_000;
/// Greatest size of the boxes that describe pictures (bytes).
const LARGEST_BOX: u64 = 1 << 28;

/// The first video of a file.
pub(super) struct Video {
    /// Its parameter sets.
    pub(super) parameters: Avcc,
    /// Width and height (pixels).
    pub(super) size: (usize, usize),
    /// Units of time a second, at least 1.
    pub(super) timescale: u32,
    /// Its pictures, in the order in which they are decoded.
    pub(super) samples: Vec<Sample>,
}

/// A compressed picture.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    /// Its first byte in the file.
    pub(super) offset: u64,
    /// Its size (bytes).
    pub(super) size: u32,
    /// The time at which it is shown, in units of the video, from 0.
    pub(super) time: i64,
}

/// Reads the description of the first video of a file of some length (bytes).
pub(super) fn read(file: &mut (impl BufRead + Seek), length: u64) -> Result<Video, VideoError> {
    let damaged = |error: mp4_atom::Error| unreadable(format!("as .mp4, {error}"));
    let mut movie: Option<Moov> = None;
    let mut fragments: Vec<(u64, Moof)> = Vec::new();
    let mut at = 0;
    while at < length {
        file.seek(SeekFrom::Start(at))?;
        let header = Header::read_from(file).map_err(damaged)?;
        let body = file.stream_position()?;
        // The last box may say that it ends with the file.
        let size = header.size.map_or(length - body, |size| size as u64);
        let end = body.checked_add(size).filter(|&end| end <= length);
        let end = end.ok_or_else(|| unreadable("it is cut off".into()))?;
        let header = Header { size: usize::try_from(size).ok(), ..header };
        if [Moov::KIND, Moof::KIND].contains(&header.kind) {
            if size > LARGEST_BOX {
                return Err(unreadable("the description of its pictures is too large".into()));
            }
            if header.kind == Moov::KIND {
                movie = Some(Moov::read_atom(&header, file).map_err(damaged)?);
            } else {
                fragments.push((at, Moof::read_atom(&header, file).map_err(damaged)?));
            }
        }
        at = end;
    }
    let movie = movie.ok_or_else(|| unreadable("it has no pictures".into()))?;
    let is_video = |track: &&Trak| track.mdia.hdlr.handler == mp4_atom::FourCC::new(b"vide");
    let track = movie.trak.iter().find(is_video);
    let track = track.ok_or_else(|| unreadable("it has no pictures".into()))?;
    let table = &track.mdia.minf.stbl;
    let (visual, parameters) = match table.stsd.codecs.first() {
        Some(Codec::Avc1(codec)) => (&codec.visual, &codec.avcc),
        Some(Codec::Avc3(codec)) => (&codec.visual, &codec.avcc),
        _ => return Err(unreadable("it is not H.264".into())),
    };
    let mut samples = of_table(table)?;
    let trex = movie.mvex.iter().flat_map(|mvex| &mvex.trex);
    let defaults = trex.into_iter().find(|trex| trex.track_id == track.tkhd.track_id);
    for (start, fragment) in &fragments {
        of_fragment(*start, fragment, track.tkhd.track_id, defaults, &mut samples)?;
    }
    let samples = from_zero(samples);
    let timescale = track.mdia.mdhd.timescale;
    if timescale == 0 {
        return Err(unreadable("its times have no unit".into()));
    }
    let size = (usize::from(visual.width), usize::from(visual.height));
    Ok(Video { parameters: parameters.clone(), size, timescale, samples })
}

pub(super) const fn unreadable(rule: String) -> VideoError {
    VideoError::Unreadable(rule)
}

fn damaged_list() -> VideoError {
    unreadable("the list of its pictures is damaged".into())
}

/// A picture with the time at which it is decoded.
struct Timed {
    sample: Sample,
    /// The time at which the next one is decoded.
    next: i64,
}

/// The pictures that the description of a whole video lists.
fn of_table(table: &Stbl) -> Result<Vec<Timed>, VideoError> {
    let (count, sizes) = match &table.stsz.samples {
        StszSamples::Identical { count, size } => (*count as usize, Err(*size)),
        StszSamples::Different { sizes } => (sizes.len(), Ok(sizes)),
    };
    check_count(count)?;
    let mut deltas =
        table.stts.entries.iter().flat_map(|it| repeat_n(it.sample_delta, it.sample_count as usize));
    let shifts = table.ctts.iter().flat_map(|ctts| &ctts.entries);
    let mut shifts = shifts.flat_map(|it| repeat_n(it.sample_offset, it.sample_count as usize));
    let chunks: Vec<u64> = match (&table.stco, &table.co64) {
        (Some(chunks), _) => chunks.entries.iter().map(|&offset| offset.into()).collect(),
        (None, Some(chunks)) => chunks.entries.clone(),
        (None, None) => Vec::new(),
    };
    let mut runs = table.stsc.entries.iter().peekable();
    let mut per_chunk = 0;
    let mut samples: Vec<Timed> = Vec::new();
    for (chunk, mut offset) in (1_u32..).zip(chunks) {
        while let Some(run) = runs.next_if(|run| run.first_chunk <= chunk) {
            per_chunk = run.samples_per_chunk as usize;
        }
        for _ in 0..per_chunk.min(count - samples.len()) {
            let size = match sizes {
                Ok(sizes) => sizes[samples.len()],
                Err(size) => size,
            };
            let decoded = samples.last().map_or(0, |sample| sample.next);
            let delta = deltas.next().ok_or_else(damaged_list)?;
            let shift = if table.ctts.is_some() { shifts.next().ok_or_else(damaged_list)? } else { 0 };
            let time = decoded.checked_add(shift).ok_or_else(damaged_list)?;
            samples.push(Timed { sample: Sample { offset, size, time }, next: decoded + i64::from(delta) });
            offset = offset.checked_add(size.into()).ok_or_else(damaged_list)?;
        }
    }
    if samples.len() < count { Err(damaged_list()) } else { Ok(samples) }
}

/// Adds the pictures of a fragment, whose first byte is at `start`.
fn of_fragment(
    start: u64,
    fragment: &Moof,
    track: u32,
    defaults: Option<&Trex>,
    samples: &mut Vec<Timed>,
) -> Result<(), VideoError> {
    for part in fragment.traf.iter().filter(|part| part.tfhd.track_id == track) {
        let base = part.tfhd.base_data_offset.unwrap_or(start);
        let default_size = part.tfhd.default_sample_size.or(defaults.map(|it| it.default_sample_size));
        let default_delta =
            part.tfhd.default_sample_duration.or(defaults.map(|it| it.default_sample_duration));
        let told = part.tfdt.as_ref().map(|tfdt| i64::try_from(tfdt.base_media_decode_time));
        let mut decoded = match told {
            Some(told) => told.map_err(|_| damaged_list())?,
            None => samples.last().map_or(0, |sample| sample.next),
        };
        let mut offset = base;
        for run in &part.trun {
            check_count(samples.len().saturating_add(run.samples.len()))?;
            if let Some(from_base) = run.data_offset {
                offset = base.checked_add_signed(from_base.into()).ok_or_else(damaged_list)?;
            }
            for sample in run.samples.iter() {
                let size = sample.size.or(default_size).ok_or_else(damaged_list)?;
                let delta = sample.duration.or(default_delta).ok_or_else(damaged_list)?;
                let time = decoded.checked_add(sample.cts.unwrap_or(0)).ok_or_else(damaged_list)?;
                decoded = decoded.checked_add(delta.into()).ok_or_else(damaged_list)?;
                samples.push(Timed { sample: Sample { offset, size, time }, next: decoded });
                offset = offset.checked_add(size.into()).ok_or_else(damaged_list)?;
            }
        }
    }
    Ok(())
}

/// The pictures with times from 0 on: what is decoded before it is shown has later ones.
fn from_zero(samples: Vec<Timed>) -> Vec<Sample> {
    let first = samples.iter().map(|timed| timed.sample.time).min().unwrap_or(0);
    let of = |timed: Timed| Sample { time: timed.sample.time.saturating_sub(first), ..timed.sample };
    samples.into_iter().map(of).collect()
}

fn check_count(count: usize) -> Result<(), VideoError> {
    if count > MOST_SAMPLES { Err(TrackError::Long(3600).into()) } else { Ok(()) }
}
