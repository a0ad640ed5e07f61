//! The look of videos: options shared by several commands.

use crate::named::named;
use clap::Args;
use phase_render::PaletteName;
use phase_runs::picture::{FRAME_RATES, Look, SIZES};

/// Look of videos.
#[derive(Args, Clone, Copy, Debug)]
pub struct LookOptions {
    /// Colours of videos: as in the paper, or distinguishable with a colour vision deficiency
    #[arg(long, value_name = "PALETTE", default_value = PaletteName::Paper.name(),
        value_parser = named(PaletteName::ALL, PaletteName::name))]
    pub palette: PaletteName,
    /// Side of the arena's square in videos, even, 64 to 2000 pixels
    #[arg(long, value_name = "PIXELS", default_value_t = Look::default().size, value_parser = size)]
    pub size: u32,
    /// Frames a second of videos, 1 to 120; at other rates than 20 bodies are interpolated
    #[arg(
        long,
        value_name = "N",
        default_value_t = Look::default().frame_rate,
        value_parser = clap::value_parser!(u32).range(FRAME_RATES.bounds())
    )]
    pub frame_rate: u32,
}

impl From<LookOptions> for Look {
    fn from(options: LookOptions) -> Self {
        let LookOptions { palette, size, frame_rate } = options;
        Self { palette: palette.palette(), size, frame_rate }
    }
}

/// Reads a size.
fn size(text: &str) -> Result<u32, String> {
    let size = text.parse().ok().filter(|size: &u32| size.is_multiple_of(2));
    let size = size.filter(|size| SIZES.check(f64::from(*size)).is_ok());
    size.ok_or_else(|| format!("must be an even number of pixels, {}", SIZES.range()))
}
