//! Colours.

use phase_model::words::Names;

/// An opaque sRGB colour: red, green, blue.
pub type Colour = [u8; 3];

/// Number of shares of a [`Course`](crate::Course).
pub const SHARES: usize = 3;

/// A palette by its name.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum PaletteName {
    /// The colours of the published videos.
    #[default]
    Paper,
    /// Colours that viewers with a colour vision deficiency can tell apart.
    Accessible,
}

impl PaletteName {
    /// All palettes.
    pub const ALL: [Self; 2] = [Self::Paper, Self::Accessible];

    /// The palette's name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Accessible => "accessible",
        }
    }

    /// The colours.
    #[must_use]
    pub const fn palette(self) -> Palette {
        match self {
            Self::Paper => Palette::PAPER,
            Self::Accessible => Palette::ACCESSIBLE,
        }
    }
}

/// The colours of everything drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Palette {
    /// The ground behind everything.
    pub background: Colour,
    /// Inner walls, the arena's boundary and text.
    pub ink: Colour,
    /// Grid lines and frames of samples in a legend.
    pub grid: Colour,
    /// Landmarks by id; paler than bodies so that these stand out on them.
    pub landmarks: [Colour; 4],
    /// Agents 0 and 1.
    pub agents: [Colour; 2],
    /// Objects 0 and 1.
    pub objects: [Colour; 2],
    /// The names of these colours in captions.
    pub names: Names,
    /// The shares friendly, adversarial and neutral of a course.
    pub shares: [Colour; SHARES],
    /// Outlines of bodies.
    pub outline: Colour,
    /// Cover of cells that are not seen in an overlay, half transparent.
    pub unseen: Colour,
    /// Slight tint of cells that are seen in an overlay.
    pub seen: Colour,
    /// Bars behind captions; pale, since text is written over them.
    pub bar: Colour,
}

impl Default for Palette {
    /// [`Palette::PAPER`].
    fn default() -> Self {
        Self::PAPER
    }
}

impl Palette {
    /// Blue, green, red and yellow landmarks; a red and a green agent; a light blue and a pink object. The
    /// landmarks are paler than the published ones.
    pub const PAPER: Self = Self {
        background: [255, 255, 255],
        ink: [0, 0, 0],
        grid: [205, 205, 205],
        landmarks: [
            mix_with_white([45, 45, 180], 50),
            mix_with_white([50, 150, 50], 50),
            mix_with_white([180, 45, 45], 50),
            mix_with_white([180, 180, 45], 50),
        ],
        agents: [[235, 20, 20], [20, 190, 20]],
        objects: [[117, 216, 230], [255, 153, 153]],
        names: Names::PAPER,
        shares: [[111, 173, 101], [204, 97, 85], [190, 190, 190]],
        outline: [40, 40, 40],
        unseen: [110, 110, 120],
        seen: [255, 240, 150],
        bar: [185, 212, 245],
    };

    /// Colours of Okabe and Ito ("Color Universal Design", 2008), some mixed with white or darkened: pale
    /// blue, grey, orange and pale yellow landmarks; a vermilion and a dark blue agent; a sky blue and a
    /// yellow object.
    ///
    /// Bodies, landmarks, walls and floor differ from one another by ΔE\*ab ≥ 18 for normal vision,
    /// protanopia and deuteranopia (simulated after Machado et al. 2009) and by ≥ 9 for tritanopia; agents,
    /// objects and landmarks also differ within their kind by L\* ≥ 9. The test `palettes` computes all of
    /// these figures.
    pub const ACCESSIBLE: Self = Self {
        landmarks: [
            mix_with_white([0, 114, 178], 30),
            mix_with_white([0, 0, 0], 45),
            mix_with_white([213, 94, 0], 60),
            mix_with_white([240, 228, 66], 40),
        ],
        agents: [[213, 94, 0], [0, 80, 125]],
        objects: [[86, 180, 233], [240, 228, 66]],
        names: Names {
            agents: ["vermilion", "blue"],
            objects: ["sky blue", "yellow"],
            landmarks: ["pale blue", "grey", "orange", "pale yellow"],
        },
        // Blue, orange and grey.
        shares: [[0, 114, 178], [230, 159, 0], [190, 190, 190]],
        ..Self::PAPER
    };
}

/// Mixes `percent` hundredths of a colour with white.
const fn mix_with_white(colour: Colour, percent: u16) -> Colour {
    let mut mixed = colour;
    let mut channel = 0;
    while channel < mixed.len() {
        mixed[channel] = 255 - ((255 - colour[channel] as u16) * percent / 100) as u8;
        channel += 1;
    }
    mixed
}
