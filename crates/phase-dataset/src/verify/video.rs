//! Whether a video is whole and has as many frames as its event, by the boxes of its container alone. Whether
//! it shows the event takes drawing it again.

use phase_files::{FileError, Problem, checksum::FileEntry, regular};
use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom},
    path::Path,
};

/// The boxes of a file, in order.
const BOXES: [[u8; 4]; 3] = [*b"ftyp", *b"moov", *b"mdat"];
/// The boxes that lead from the description of a file to the sizes of its frames.
const TO_SIZES: [[u8; 4]; 5] = [*b"trak", *b"mdia", *b"minf", *b"stbl", *b"stsz"];
/// Largest description (bytes): that of the longest events has some 20 bytes for each frame.
const LARGEST_DESCRIPTION: u64 = 16 << 20;

/// Checks that a video has so many frames.
pub(super) fn check(folder: &Path, entry: &FileEntry, frames: usize) -> Result<(), FileError> {
    let file = entry.place(folder);
    let fail = |problem| FileError { file: file.clone(), problem };
    let shape = |rule: String| fail(Problem::Shape { what: "video", rule });
    let sizes = frame_sizes(regular::open(&file)?)
        .map_err(|error| fail(Problem::Unreadable(error)))?
        .map_err(shape)?;
    if sizes.len() == frames {
        Ok(())
    } else {
        Err(shape(format!("it has {} frames instead of {frames}, one and those of each step", sizes.len())))
    }
}

/// The sizes of the frames (bytes), which are all that a file holds beside its description; or what is wrong.
fn frame_sizes(mut file: File) -> io::Result<Result<Vec<u32>, String>> {
    let length = file.metadata()?.len();
    let mut at = 0;
    let mut sizes = None;
    for expected in BOXES {
        let Some((name, head, whole)) = head(&mut file, at, length)? else {
            return Ok(Err("it ends too early".into()));
        };
        if name != expected {
            return Ok(Err(format!("its boxes are not {}", BOXES.map(|name| text(&name)).join(", "))));
        }
        let content = whole - head;
        if name == *b"moov" {
            if content > LARGEST_DESCRIPTION {
                return Ok(Err(format!("its description has {content} bytes")));
            }
            let mut bytes = Vec::new();
            file.seek(SeekFrom::Start(at + head))?;
            (&file).take(content).read_to_end(&mut bytes)?;
            sizes = sizes_in(&bytes);
        } else if name == *b"mdat" {
            let sum = sizes.iter().flatten().map(|&size: &u32| u64::from(size)).sum::<u64>();
            if sum != content {
                return Ok(Err(format!("it holds {content} bytes, but its frames have {sum}")));
            }
        }
        at += whole;
    }
    if at != length {
        return Ok(Err(format!("{} bytes follow after its end", length - at)));
    }
    Ok(sizes.ok_or_else(|| "it does not say how large its frames are".into()))
}

/// Name, size of the head and whole size of a box; `None` if it is not within the file.
fn head(file: &mut File, at: u64, length: u64) -> io::Result<Option<([u8; 4], u64, u64)>> {
    let mut bytes = Vec::new();
    file.seek(SeekFrom::Start(at))?;
    file.take(16).read_to_end(&mut bytes)?;
    Ok(parse_head(&bytes).filter(|(_, _, whole)| at.checked_add(*whole).is_some_and(|end| end <= length)))
}

fn parse_head(bytes: &[u8]) -> Option<([u8; 4], u64, u64)> {
    let (size, rest) = bytes.split_first_chunk()?;
    let (name, rest) = rest.split_first_chunk()?;
    let (head, whole) = match u32::from_be_bytes(*size) {
        1 => (16, u64::from_be_bytes(*rest.first_chunk()?)),
        size => (8, u64::from(size)),
    };
    (whole >= head).then_some((*name, head, whole))
}

/// The sizes of the frames in the contents of a description.
fn sizes_in(description: &[u8]) -> Option<Vec<u32>> {
    let mut content = description;
    for wanted in TO_SIZES {
        let mut rest = content;
        content = loop {
            let (name, head, whole) = parse_head(rest)?;
            let (this, after) = rest.split_at_checked(usize::try_from(whole).ok()?)?;
            if name == wanted {
                break this.get(head as usize..)?;
            }
            rest = after;
        };
    }
    // Version and flags; one size for all, which is 0 here; number of frames; their sizes.
    let (fields, sizes) = content.split_at_checked(12)?;
    let field = |k: usize| fields.get(4 * k..)?.first_chunk().map(|bytes| u32::from_be_bytes(*bytes));
    let fits = field(1)? == 0 && u64::from(field(2)?) * 4 == sizes.len() as u64;
    fits.then(|| {
        sizes.chunks_exact(4).filter_map(|it| it.first_chunk()).map(|it| u32::from_be_bytes(*it)).collect()
    })
}

fn text(name: &[u8; 4]) -> String {
    String::from_utf8_lossy(name).into_owned()
}
