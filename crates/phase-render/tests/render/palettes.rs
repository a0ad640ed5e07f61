//! Which colours viewers can tell apart, with normal colour vision and without.
//!
//! Colour vision deficiency is simulated with the matrices of Machado, Oliveira and Fernandes ("A
//! Physiologically-based Model for Simulation of Color Vision Deficiency", 2009) at severity 1, applied to
//! linear RGB. Differences are Euclidean in CIELAB (D65): ΔE*ab, of which about 2.3 are just noticeable.

use phase_render::{Colour, Palette, PaletteName};

type Matrix = [[f64; 3]; 3];

const NORMAL: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const PROTANOPIA: Matrix =
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]];
const DEUTERANOPIA: Matrix =
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]];
const TRITANOPIA: Matrix =
    [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]];

/// From linear sRGB to CIE XYZ, and the white point D65.
const XYZ: Matrix =
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]];
const D65: [f64; 3] = [0.95047, 1.0, 1.08883];

fn times(matrix: Matrix, vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum())
}

/// L*, a*, b* of a colour as it is seen.
fn lab(colour: Colour, vision: Matrix) -> [f64; 3] {
    let linear = colour.map(|channel| {
        let share = f64::from(channel) / 255.0;
        if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    });
    let xyz = times(XYZ, times(vision, linear).map(|channel| channel.clamp(0.0, 1.0)));
    let [x, y, z] = [0, 1, 2].map(|k| {
        let share = xyz[k] / D65[k];
        if share > 216.0 / 24389.0 { share.cbrt() } else { (24389.0 / 27.0 * share + 16.0) / 116.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn difference(a: Colour, b: Colour, vision: Matrix) -> f64 {
    let a = lab(a, vision);
    let b = lab(b, vision);
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

fn lightness_difference(a: Colour, b: Colour, vision: Matrix) -> f64 {
    (lab(a, vision)[0] - lab(b, vision)[0]).abs()
}

/// All pairs of some colours.
fn pairs(colours: &[Colour]) -> impl Iterator<Item = (Colour, Colour)> {
    colours.iter().enumerate().flat_map(|(k, &a)| colours[k + 1..].iter().map(move |&b| (a, b)))
}

/// Colours that may lie beside one another: bodies, landmarks, walls, the floor.
fn all(palette: &Palette) -> Vec<Colour> {
    [&palette.agents[..], &palette.objects, &palette.landmarks, &[palette.ink, palette.background]].concat()
}

/// A colour under a translucent one, as the overlay draws it.
fn under(colour: Colour, cover: Colour, alpha: u32) -> Colour {
    [0, 1, 2]
        .map(|k| ((u32::from(colour[k]) * (255 - alpha) + u32::from(cover[k]) * alpha + 127) / 255) as u8)
}

#[test]
fn the_conversion_agrees_with_published_values() {
    // sRGB primaries in CIELAB (D65), as tabulated for instance by Lindbloom.
    for (colour, expected) in [
        ([255, 255, 255], [100.0, 0.0, 0.0]),
        ([255, 0, 0], [53.24, 80.09, 67.20]),
        ([0, 255, 0], [87.73, -86.18, 83.18]),
        ([0, 0, 255], [32.30, 79.19, -107.86]),
    ] {
        let found = lab(colour, NORMAL);
        assert!((0..3).all(|k| (found[k] - expected[k]).abs() < 0.05), "{colour:?}: {found:?}");
    }
    for vision in [PROTANOPIA, DEUTERANOPIA, TRITANOPIA] {
        assert!(lab([128; 3], vision)[1..].iter().all(|ab| ab.abs() < 0.5), "grey stays grey");
    }
}

#[test]
fn everything_of_the_accessible_palette_differs_from_everything_else() {
    let palette = PaletteName::Accessible.palette();
    for (vision, least) in [(NORMAL, 18.0), (PROTANOPIA, 18.0), (DEUTERANOPIA, 18.0), (TRITANOPIA, 9.0)] {
        for (a, b) in pairs(&all(&palette)) {
            let found = difference(a, b, vision);
            assert!(found >= least, "{a:?} and {b:?} differ by {found:.1}");
        }
    }
}

#[test]
fn things_of_a_kind_differ_in_lightness_too() {
    let palette = PaletteName::Accessible.palette();
    for vision in [NORMAL, PROTANOPIA, DEUTERANOPIA] {
        for kind in [&palette.agents[..], &palette.objects, &palette.landmarks] {
            for (a, b) in pairs(kind) {
                let found = lightness_difference(a, b, vision);
                assert!(found >= 9.0, "{a:?} and {b:?} differ by L* {found:.1}");
            }
        }
        let floor = palette.background;
        let seen = under(floor, palette.seen, 45);
        let unseen = under(floor, palette.unseen, 120);
        assert!(lightness_difference(seen, unseen, vision) >= 20.0, "in and out of view");
        assert!(lightness_difference(palette.ink, palette.bar, vision) >= 70.0, "text on a bar");
    }
}

/// Why there is a second palette: in the paper's, agents and landmarks are red and green.
#[test]
fn the_palette_of_the_paper_is_not_safe() {
    let palette = PaletteName::Paper.palette();
    let least = |palette: &Palette| {
        pairs(&all(palette)).map(|(a, b)| difference(a, b, DEUTERANOPIA)).fold(f64::INFINITY, f64::min)
    };
    assert!(least(&palette) < 5.0, "{}", least(&palette));
    assert!(difference(palette.agents[0], palette.agents[1], DEUTERANOPIA) < 12.0);
    let accessible = PaletteName::Accessible.palette();
    assert!(difference(accessible.agents[0], accessible.agents[1], DEUTERANOPIA) > 60.0);
}

#[test]
fn the_default_is_the_palette_of_the_paper() {
    assert_eq!(PaletteName::default(), PaletteName::Paper);
    let palette = Palette::default();
    assert_eq!(palette, PaletteName::Paper.palette());
    assert_eq!(palette.agents, [[235, 20, 20], [20, 190, 20]]);
    assert_eq!(palette.objects, [[117, 216, 230], [255, 153, 153]]);
    assert_eq!(palette.landmarks, [[150, 150, 218], [153, 203, 153], [218, 150, 150], [218, 218, 150]]);
    let names = PaletteName::ALL.map(PaletteName::name);
    assert_eq!(names, ["paper", "accessible"]);
}
