//! Folders of PNG pictures.

use super::{Sink, VideoError};
use phase_files::regular;
use phase_track::{MOST_PIXELS_ACROSS, TrackError};
use png::{ColorType, Decoder, Transformations};
use std::{io::BufReader, path::Path};

/// Decodes the pictures of a folder in the order of the numbers in their names.
pub(super) fn decode(folder: &Path, frame_rate: f64, sink: Sink<'_>) -> Result<(), VideoError> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let digits: String = name.chars().rev().take_while(char::is_ascii_digit).collect();
            let number = digits.chars().rev().collect::<String>().parse::<u64>().unwrap_or(0);
            files.push((number, name, path));
        }
    }
    files.sort();
    if files.is_empty() {
        return Err(VideoError::Unreadable("the folder has no .png files".into()));
    }
    let mut rgb = Vec::new();
    for (k, (_, name, path)) in files.iter().enumerate() {
        let failed = |rule: String| VideoError::Unreadable(format!("picture {name}: {rule}"));
        let file = regular::open(path).map_err(|error| failed(error.problem.to_string()))?;
        let size = read(BufReader::new(file), &mut rgb).map_err(|error| match error {
            VideoError::Unreadable(rule) => failed(rule),
            other => other,
        })?;
        sink(size, &rgb, k as f64 / frame_rate)?;
    }
    Ok(())
}

/// Reads a picture as red, green and blue over white.
fn read(file: BufReader<std::fs::File>, rgb: &mut Vec<u8>) -> Result<(usize, usize), VideoError> {
    let failed = |error: png::DecodingError| VideoError::Unreadable(error.to_string());
    let mut decoder = Decoder::new(file);
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(failed)?;
    let [width, height] = [reader.info().width, reader.info().height].map(|side| side as usize);
    if width.max(height) > MOST_PIXELS_ACROSS {
        return Err(TrackError::Size { width, height }.into());
    }
    let Some(length) = reader.output_buffer_size() else {
        return Err(TrackError::Size { width, height }.into());
    };
    let mut bytes = vec![0; length];
    reader.next_frame(&mut bytes).map_err(failed)?;
    let (colour, _) = reader.output_color_type();
    rgb.clear();
    let over_white = |value: u8, alpha: u8| 255 - ((255 - u32::from(value)) * u32::from(alpha) / 255) as u8;
    match colour {
        ColorType::Rgb => rgb.extend(bytes),
        ColorType::Rgba => {
            rgb.extend(bytes.chunks_exact(4).flat_map(|it| [0, 1, 2].map(|k| over_white(it[k], it[3]))))
        }
        ColorType::GrayscaleAlpha => {
            rgb.extend(bytes.chunks_exact(2).flat_map(|it| [over_white(it[0], it[1]); 3]))
        }
        ColorType::Grayscale | ColorType::Indexed => rgb.extend(bytes.iter().flat_map(|it| [*it; 3])),
    }
    Ok((width, height))
}
