//! Any video, decoded by the program `ffmpeg`.

use super::{Sink, VideoError};
use phase_track::{MOST_PIXELS_ACROSS, TrackError};
use std::{
    io::{self, BufRead, BufReader, Read},
    path::Path,
    process::{Child, ChildStdout, Command, Stdio},
};

/// Longest line of a header (bytes).
const LONGEST_LINE: u64 = 1000;

/// Decodes a video that cannot be read otherwise, which `why` explains.
pub(super) fn decode(path: &Path, why: String, sink: Sink<'_>) -> Result<(), VideoError> {
    // A file whose name begins with a dash or a protocol is still a file.
    let file = std::fs::canonicalize(path)?;
    let started = Command::new("ffmpeg")
        .args(["-nostdin", "-loglevel", "error", "-protocol_whitelist", "file", "-i"])
        .arg(&file)
        .args(["-map", "0:v:0", "-f", "yuv4mpegpipe", "-pix_fmt", "yuv444p", "-"])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let mut child = match started {
        Ok(child) => Running(child),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(VideoError::NoFfmpeg(format!("is no video that can be read here: {why}")));
        }
        Err(error) => return Err(error.into()),
    };
    let Some(pipe) = child.0.stdout.take() else { return Err(VideoError::Unreadable(why)) };
    let mut pipe = BufReader::with_capacity(1 << 20, pipe);
    let refused = || VideoError::Unreadable(format!("{why}, and ffmpeg cannot decode it"));
    let header = line(&mut pipe)?.ok_or_else(refused)?;
    let (size, rate) = header_of(&header).ok_or_else(refused)?;
    if size.0.max(size.1) > MOST_PIXELS_ACROSS {
        return Err(TrackError::Size { width: size.0, height: size.1 }.into());
    }
    let area = size.0 * size.1;
    let mut planes = vec![0; 3 * area];
    let mut rgb = vec![0; 3 * area];
    let mut frame = 0;
    while line(&mut pipe)?.is_some_and(|line| line.starts_with("FRAME")) {
        pipe.read_exact(&mut planes)?;
        to_rgb(&planes, &mut rgb);
        sink(size, &rgb, f64::from(frame) / rate)?;
        frame += 1;
    }
    Ok(())
}

/// A program that is stopped when its pictures are no longer wanted.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn line(pipe: &mut BufReader<ChildStdout>) -> io::Result<Option<String>> {
    let mut bytes = Vec::new();
    pipe.take(LONGEST_LINE).read_until(b'\n', &mut bytes)?;
    Ok((!bytes.is_empty()).then(|| String::from_utf8_lossy(&bytes).into_owned()))
}

/// Size (pixels) and frames a second.
fn header_of(header: &str) -> Option<((usize, usize), f64)> {
    let words = header.strip_prefix("YUV4MPEG2 ")?.split_whitespace();
    let of = |letter: char| words.clone().find_map(|word| word.strip_prefix(letter));
    let (number, unit) = of('F')?.split_once(':')?;
    let rate = number.parse::<f64>().ok()? / unit.parse::<f64>().ok()?;
    Some(((of('W')?.parse().ok()?, of('H')?.parse().ok()?), rate))
}

/// BT.601 with luma from 16 to 235. Which of the standards it was matters little: colours only need to
/// differ.
fn to_rgb(planes: &[u8], rgb: &mut [u8]) {
    let area = planes.len() / 3;
    let (luma, colours) = planes.split_at(area);
    let (blue, red) = colours.split_at(area);
    for (((y, u), v), pixel) in luma.iter().zip(blue).zip(red).zip(rgb.chunks_exact_mut(3)) {
        let y = 298 * (i32::from(*y) - 16) + 128;
        let [u, v] = [*u, *v].map(|it| i32::from(it) - 128);
        let channels = [y + 409 * v, y - 100 * u - 208 * v, y + 516 * u];
        for (channel, value) in pixel.iter_mut().zip(channels) {
            *channel = (value >> 8).clamp(0, 255) as u8;
        }
    }
}
