//! Videos are what they say they are: by their boxes, and by decoding them again.

use crate::common::{physics, state};
use crate::mp4::{boxes, content, pictures, table, word};
use openh264::{decoder::Decoder, formats::YUVSource};
use phase_model::Vec2;
use phase_render::{Frame, RenderError, SceneRenderer, Style, VideoEncoder, yuv::Planes};
use std::io::{self, Write};

/// Frames of an agent that moves and turns.
fn frames(side: u32, count: usize) -> Vec<Frame> {
    let renderer = SceneRenderer::new(&physics(), Style::with_side(side)).expect("a valid video");
    let step = |k: usize| {
        let mut state = state();
        state.bodies[0].position += Vec2::new(0.05, -0.03) * k as f32;
        state.bodies[0].angle = 0.1 * k as f32;
        renderer.frame(&state, None)
    };
    (0..count).map(step).collect()
}

fn encode(frames: &[Frame], rate: u32) -> Vec<u8> {
    let mut video =
        VideoEncoder::new(Vec::new(), frames[0].width(), frames[0].height(), rate).expect("a valid video");
    for frame in frames {
        video.push(frame).expect("a valid video");
    }
    assert_eq!(video.frame_count(), frames.len());
    video.finish().expect("a valid video")
}

#[test]
fn the_file_starts_fast_and_keeps_time() {
    for (side, count, rate) in [(128, 95, 20), (480, 3, 20), (130, 61, 30), (96, 2, 1)] {
        let mp4 = encode(&frames(side, count), rate);
        let kinds: Vec<String> = boxes(&mp4).into_iter().map(|one| one.kind).collect();
        assert_eq!(kinds, ["ftyp", "moov", "mdat"], "what players need comes first");

        let header = content(&mp4, &["moov", "trak", "mdia", "mdhd"]);
        let timescale = word(header, 12);
        assert_eq!(word(header, 16), timescale / rate * count as u32, "duration");

        let durations = table(&mp4, "stts");
        assert_eq!(word(durations, 4), 1, "all frames last equally long");
        assert_eq!((word(durations, 8), word(durations, 12)), (count as u32, timescale / rate));

        let entry = content(&table(&mp4, "stsd")[8..], &["avc1"]);
        let size = |at: usize| u16::from_be_bytes([entry[at], entry[at + 1]]);
        assert_eq!((u32::from(size(24)), u32::from(size(26))), (side, side));
        let decoder_record = content(&entry[78..], &["avcC"]);
        assert_eq!(decoder_record[1], 66, "baseline profile");
        assert_eq!(decoder_record[2] & 0x40, 0x40, "constrained");

        let keys = table(&mp4, "stss");
        let found: Vec<u32> = (0..word(keys, 4) as usize).map(|k| word(keys, 8 + 4 * k)).collect();
        let expected: Vec<u32> = (1..=count as u32).step_by(2 * rate as usize).collect();
        assert_eq!(found, expected, "a key frame every two seconds");

        let data = &boxes(&mp4)[2];
        assert_eq!(word(table(&mp4, "stco"), 8) as usize, data.start, "samples begin where the data begin");
        let sizes = table(&mp4, "stsz");
        let total: usize = (0..count).map(|k| word(sizes, 12 + 4 * k) as usize).sum();
        assert_eq!((word(sizes, 8) as usize, total), (count, data.content.len()));
    }
}

/// The decoder's output is the input, up to the requested loss.
#[test]
fn decoding_gives_the_frames_back() {
    let frames = frames(480, 45);
    let mp4 = encode(&frames, 20);
    let mut decoder = Decoder::new().unwrap();
    let mut planes = Planes::new(480, 480);
    let mut decoded = 0;
    for (frame, picture) in frames.iter().zip(pictures(&mp4)) {
        let found = decoder.decode(&picture).unwrap().expect("a picture from each sample, without delay");
        planes.read(frame.rgba());
        assert_eq!(found.dimensions(), (480, 480));
        let rows = |bytes: &[u8], stride: usize, width: usize| -> Vec<u8> {
            bytes.chunks(stride).flat_map(|row| row[..width].to_vec()).collect()
        };
        let (luma_stride, blue_stride, red_stride) = found.strides();
        for (found, expected, worst) in [
            (rows(found.y(), luma_stride, 480), planes.luma(), 3.0),
            (rows(found.u(), blue_stride, 240), planes.blue(), 2.0),
            (rows(found.v(), red_stride, 240), planes.red(), 2.0),
        ] {
            assert_eq!(found.len(), expected.len());
            let error = root_mean_square(&found, expected);
            assert!(error < worst, "frame {decoded}: root mean square error {error} of 255");
        }
        decoded += 1;
    }
    assert_eq!(decoded, 45);
}

#[test]
fn equal_frames_make_equal_bytes() {
    let frames = frames(160, 50);
    let first = encode(&frames, 20);
    assert_eq!(first, encode(&frames, 20));
    let threads: Vec<Vec<u8>> = std::thread::scope(|scope| {
        let running: Vec<_> = (0..3).map(|_| scope.spawn(|| encode(&frames, 20))).collect();
        running.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(threads.iter().all(|other| *other == first), "whatever else runs at the same time");
    let mut changed = frames.clone();
    changed.swap(3, 30);
    assert_ne!(first, encode(&changed, 20));
}

/// 25 s in which nothing moves are mostly key frames.
#[test]
fn standing_still_costs_little() {
    let still = vec![frames(480, 1).remove(0); 500];
    let size = encode(&still, 20).len();
    assert!(size < 80_000, "{size} bytes");
}

#[test]
fn what_no_video_can_hold_is_refused() {
    for (width, height) in [(481, 480), (480, 481), (1, 1), (99, 33)] {
        match VideoEncoder::new(Vec::new(), width, height, 20).err() {
            Some(RenderError::OddSize { width: w, height: h }) => assert_eq!((w, h), (width, height)),
            other => panic!("{width} x {height} gave {other:?}"),
        }
    }
    for (width, height) in [(0, 0), (14, 480), (480, 2), (2162, 480), (480, u32::MAX - 1)] {
        let refused = VideoEncoder::new(Vec::new(), width, height, 20).err();
        assert!(matches!(refused, Some(RenderError::VideoSize { .. })), "{width} x {height}: {refused:?}");
    }
    for rate in [0, 121, u32::MAX] {
        let refused = VideoEncoder::new(Vec::new(), 480, 480, rate).err();
        assert!(matches!(refused, Some(RenderError::FrameRate(found)) if found == rate));
    }
    let empty = VideoEncoder::new(Vec::new(), 480, 480, 20).unwrap().finish();
    assert!(matches!(empty, Err(RenderError::NoFrames("video"))));
}

#[test]
fn the_smallest_and_the_largest_video_are_made() {
    let renderer = SceneRenderer::new(&physics(), Style::with_side(64)).unwrap();
    assert_eq!(pictures(&encode(&[renderer.frame(&state(), None)], 20)).len(), 1);
    let renderer =
        SceneRenderer::new(&physics(), Style { caption_lines: 1, ..Style::with_side(2000) }).unwrap();
    let frame = renderer.frame(&state(), None);
    assert!(frame.height() > 2000);
    assert_eq!(pictures(&encode(&[frame.clone(), frame], 120)).len(), 2);
}

#[test]
fn a_frame_of_another_size_is_refused_and_the_video_goes_on() {
    let good = frames(128, 2);
    let mut video = VideoEncoder::new(Vec::new(), 128, 128, 20).unwrap();
    video.push(&good[0]).unwrap();
    let refused = video.push(&frames(130, 1)[0]);
    assert!(matches!(refused, Err(RenderError::FrameSize { index: 1, found_width: 130, width: 128, .. })));
    video.push(&good[1]).unwrap();
    assert_eq!(video.finish().unwrap(), encode(&good, 20));
}

/// A disc that is full.
struct Full;

impl Write for Full {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::Error::other("disc full"))
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_writer_that_fails_is_heard() {
    let mut video = VideoEncoder::new(Full, 128, 128, 20).unwrap();
    video.push(&frames(128, 1)[0]).unwrap();
    let error = video.finish().err().expect("nothing was written");
    assert!(error.to_string().contains("disc full"), "{error}");
}

fn root_mean_square(a: &[u8], b: &[u8]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(&a, &b)| (f64::from(a) - f64::from(b)).powi(2)).sum();
    (sum / a.len() as f64).sqrt()
}
