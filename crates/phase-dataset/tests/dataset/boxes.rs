//! The smallest .mp4 that has frames.

fn named(name: &[u8; 4], content: &[u8]) -> Vec<u8> {
    let size = u32::try_from(8 + content.len()).expect("small");
    [&size.to_be_bytes()[..], name, content].concat()
}

/// A file with some frames of one byte.
pub(crate) fn video(frames: usize) -> Vec<u8> {
    let count = u32::try_from(frames).expect("few").to_be_bytes();
    let sizes = [&[0; 8][..], &count, &[0, 0, 0, 1].repeat(frames)].concat();
    let table = named(b"stbl", &[named(b"stts", b"times"), named(b"stsz", &sizes)].concat());
    let track = named(b"trak", &named(b"mdia", &named(b"minf", &table)));
    [
        named(b"ftyp", b"isom"),
        named(b"moov", &[named(b"mvhd", b""), track].concat()),
        named(b"mdat", &vec![0; frames]),
    ]
    .concat()
}
