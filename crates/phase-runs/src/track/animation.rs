//! Animated GIFs.

use super::{Sink, VideoError};
use gif::{ColorOutput, DecodeOptions, DisposalMethod};
use phase_track::{MOST_PIXELS_ACROSS, TrackError};
use std::{fs::File, io::BufReader};

/// Decodes a GIF.
pub(super) fn decode(file: File, sink: Sink<'_>) -> Result<(), VideoError> {
    let failed = |error: gif::DecodingError| VideoError::Unreadable(format!("as GIF, {error}"));
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut decoder = options.read_info(BufReader::new(file)).map_err(failed)?;
    let [width, height] = [decoder.width(), decoder.height()].map(usize::from);
    if width.max(height) > MOST_PIXELS_ACROSS {
        return Err(TrackError::Size { width, height }.into());
    }
    let mut canvas = vec![255; 3 * width * height];
    let mut hundredths = 0_u64;
    while let Some(frame) = decoder.read_next_frame().map_err(failed)? {
        let before = (frame.dispose == DisposalMethod::Previous).then(|| canvas.clone());
        let [left, top, across] = [frame.left, frame.top, frame.width].map(usize::from);
        let area = frame.buffer.chunks_exact(4).enumerate().map(|(k, pixel)| {
            let x = left + k % across.max(1);
            let y = top + k / across.max(1);
            ((x < width && y < height).then_some(3 * (y * width + x)), pixel)
        });
        for (place, pixel) in area.clone() {
            if let Some(place) = place.filter(|_| pixel[3] > 0) {
                canvas[place..place + 3].copy_from_slice(&pixel[..3]);
            }
        }
        sink((width, height), &canvas, hundredths as f64 / 100.0)?;
        // Browsers show frames without a time for a tenth of a second.
        hundredths += u64::from(if frame.delay == 0 { 10 } else { frame.delay });
        match (frame.dispose, before) {
            (DisposalMethod::Background, _) => {
                for place in area.filter_map(|(place, _)| place) {
                    canvas[place..place + 3].fill(255);
                }
            }
            (_, Some(before)) => canvas = before,
            _ => {}
        }
    }
    Ok(())
}
