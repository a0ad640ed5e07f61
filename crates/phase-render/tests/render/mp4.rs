//! Just enough of the .mp4 format to look inside.

/// A box: its type and what it holds.
pub(crate) struct Mp4Box<'a> {
    pub(crate) kind: String,
    /// Where the content begins in the bytes the box was found in.
    pub(crate) start: usize,
    pub(crate) content: &'a [u8],
}

pub(crate) fn word(bytes: &[u8], at: usize) -> u32 {
    u32::from_be_bytes(bytes[at..at + 4].try_into().expect("an .mp4 has it"))
}

/// The boxes side by side in some bytes; they must fill them exactly.
pub(crate) fn boxes(bytes: &[u8]) -> Vec<Mp4Box<'_>> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let size = word(bytes, at) as usize;
        assert!(size >= 8 && at + size <= bytes.len(), "a box of {size} bytes at {at}");
        let kind = String::from_utf8(bytes[at + 4..at + 8].to_vec()).expect("an .mp4 has it");
        found.push(Mp4Box { kind, start: at + 8, content: &bytes[at + 8..at + size] });
        at += size;
    }
    found
}

/// The content of the box at a path such as `["moov", "mvhd"]`.
pub(crate) fn content<'a>(bytes: &'a [u8], path: &[&str]) -> &'a [u8] {
    path.iter().fold(bytes, |inside, kind| {
        let all = boxes(inside);
        all.iter().find(|one| one.kind == *kind).unwrap_or_else(|| panic!("no {kind} in {path:?}")).content
    })
}

/// A table of the sample tables; `skip` are the bytes before its entries.
pub(crate) fn table<'a>(bytes: &'a [u8], kind: &str) -> &'a [u8] {
    content(bytes, &["moov", "trak", "mdia", "minf", "stbl", kind])
}

/// The encoded pictures, each as a sequence of units that begin with 0, 0, 0, 1.
pub(crate) fn pictures(bytes: &[u8]) -> Vec<Vec<u8>> {
    let sizes = table(bytes, "stsz");
    assert_eq!(word(sizes, 4), 0, "each sample has its own size");
    let mut at = word(table(bytes, "stco"), 8) as usize;
    let mut pictures = Vec::new();
    for k in 0..word(sizes, 8) as usize {
        let size = word(sizes, 12 + 4 * k) as usize;
        let mut sample = &bytes[at..at + size];
        let mut picture = Vec::new();
        while !sample.is_empty() {
            let length = word(sample, 0) as usize;
            picture.extend([0, 0, 0, 1]);
            picture.extend(&sample[4..4 + length]);
            sample = &sample[4 + length..];
        }
        pictures.push(picture);
        at += size;
    }
    pictures
}
