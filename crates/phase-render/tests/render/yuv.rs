//! Colours on their way into video, against BT.709's definition in floating point.

use phase_render::yuv::Planes;
use proptest::prelude::*;

/// Luma, blue minus luma and red minus luma of a colour, in the range video uses.
fn reference([red, green, blue]: [f64; 3]) -> [f64; 3] {
    let luma = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    [
        16.0 + 219.0 / 255.0 * luma,
        128.0 + 224.0 / 255.0 * (blue - luma) / 1.8556,
        128.0 + 224.0 / 255.0 * (red - luma) / 1.5748,
    ]
}

#[test]
fn black_and_white_are_exact() {
    for (level, luma) in [(0, 16), (255, 235)] {
        let mut planes = Planes::new(4, 2);
        planes.read(&[level; 4 * 8]);
        assert_eq!(planes.luma(), [luma; 8]);
        assert_eq!((planes.blue(), planes.red()), ([128; 2].as_slice(), [128; 2].as_slice()));
    }
}

#[test]
fn missing_pixels_and_empty_planes_do_no_harm() {
    let mut planes = Planes::new(4, 2);
    planes.read(&[255; 9]);
    assert_eq!(planes, Planes::new(4, 2));
    let mut nothing = Planes::new(1, 7);
    nothing.read(&[1, 2, 3, 4]);
    assert_eq!((nothing.size(), nothing.luma().len()), ((0, 6), 0));
}

proptest! {
    /// Every value is within half a step of the definition, each pixel in its own place.
    #[test]
    fn planes_follow_the_definition(rgba in prop::collection::vec(any::<u8>(), 4 * 6 * 4)) {
        let mut planes = Planes::new(6, 4);
        planes.read(&rgba);
        let pixel = |x: usize, y: usize| [0, 1, 2].map(|k| f64::from(rgba[4 * (6 * y + x) + k]));
        let near = |found: u8, expected: f64| (f64::from(found) - expected).abs() < 0.51;
        for (x, y) in (0..24).map(|k| (k % 6, k / 6)) {
            prop_assert!(near(planes.luma()[6 * y + x], reference(pixel(x, y))[0]));
        }
        for (x, y) in (0..6).map(|k| (k % 3, k / 3)) {
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| pixel(2 * x + dx, 2 * y + dy));
            let mean = [0, 1, 2].map(|k| four.iter().map(|colour| colour[k]).sum::<f64>() / 4.0);
            prop_assert!(near(planes.blue()[3 * y + x], reference(mean)[1]));
            prop_assert!(near(planes.red()[3 * y + x], reference(mean)[2]));
        }
    }
}
