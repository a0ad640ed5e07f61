//! Draws the 22 base layouts and their mirrors into the .png file given as argument: the picture in
//! `docs/images`.

use phase_render::{Palette, layout_chart};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: layouts FILE.png")?;
    Ok(std::fs::write(path, layout_chart(&Palette::default())?.png()?)?)
}
