//! The conversion of red, green and blue to the luma and colour planes of video.

/// A picture as H.264 wants it: a plane of luma and two planes of colour at half the width and height
/// (4:2:0), after BT.709 with luma from 16 to 235.
///
/// Integer arithmetic only: the encoder's own conversion uses the vector instructions of the machine, on
/// which a video should not depend.
#[derive(Clone, Debug)]
pub struct Planes {
    width: usize,
    height: usize,
    luma: Vec<u8>,
    blue: Vec<u8>,
    red: Vec<u8>,
    /// The picture last taken over: most of its rows recur in the next.
    last: Vec<u8>,
}

/// Two are equal if their planes are; the picture last read does not count.
impl PartialEq for Planes {
    fn eq(&self, other: &Self) -> bool {
        (self.width, self.height) == (other.width, other.height)
            && (&self.luma, &self.blue, &self.red) == (&other.luma, &other.blue, &other.red)
    }
}

impl Eq for Planes {}

impl Planes {
    /// Black planes for pictures of a size (pixels); an odd width or height is rounded down.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let width = (width & !1) as usize;
        let height = (height & !1) as usize;
        let quarter = width * height / 4;
        Self {
            width,
            height,
            luma: vec![16; width * height],
            blue: vec![128; quarter],
            red: vec![128; quarter],
            last: Vec::new(),
        }
    }

    /// Takes over a picture given as `width × height` pixels of red, green, blue and alpha, the size being
    /// that of the planes. Alpha is ignored. Pixels that are missing leave the planes as they were.
    pub fn read(&mut self, rgba: &[u8]) {
        if self.width == 0 {
            return;
        }
        let pairs_of_rows = rgba.chunks_exact(8 * self.width);
        let half = self.width / 2;
        let lumas = self.luma.chunks_exact_mut(2 * self.width);
        let colours = self.blue.chunks_exact_mut(half).zip(self.red.chunks_exact_mut(half));
        let mut last = self.last.chunks_exact(8 * self.width);
        for ((rows, luma), (blue, red)) in pairs_of_rows.zip(lumas).zip(colours) {
            if last.next() == Some(rows) {
                continue;
            }
            for (luma, pixel) in luma.iter_mut().zip(rows.chunks_exact(4)) {
                *luma = luma_of(channels(pixel));
            }
            let (upper, lower) = rows.split_at(4 * self.width);
            let blocks = upper.chunks_exact(8).zip(lower.chunks_exact(8));
            for ((above, below), (blue, red)) in blocks.zip(blue.iter_mut().zip(red)) {
                let four = [&above[..4], &above[4..], &below[..4], &below[4..]].map(channels);
                let sum = four.iter().fold([0; 3], |sum, pixel| [0, 1, 2].map(|k| sum[k] + pixel[k]));
                (*blue, *red) = colour_of(sum);
            }
        }
        rgba.clone_into(&mut self.last);
    }

    /// Luma, row by row.
    #[must_use]
    pub fn luma(&self) -> &[u8] {
        &self.luma
    }

    /// Blue minus luma (Cb), row by row at half size.
    #[must_use]
    pub fn blue(&self) -> &[u8] {
        &self.blue
    }

    /// Red minus luma (Cr), row by row at half size.
    #[must_use]
    pub fn red(&self) -> &[u8] {
        &self.red
    }

    /// Width and height of the luma plane (pixels).
    #[must_use]
    pub const fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }
}

/// BT.709's shares of red, green and blue in luma, times 219/255 and 2^16.
const LUMA: [i32; 3] = [11966, 40254, 4064];
/// The shares in blue minus luma and red minus luma, times 224/255 and 2^16; each row sums to 0.
const BLUE: [i32; 3] = [-6596, -22188, 28784];
const RED: [i32; 3] = [28784, -26145, -2639];

fn channels(pixel: &[u8]) -> [i32; 3] {
    [0, 1, 2].map(|k| i32::from(pixel.get(k).copied().unwrap_or(0)))
}

fn weigh(weights: [i32; 3], values: [i32; 3]) -> i32 {
    weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
}

fn luma_of(pixel: [i32; 3]) -> u8 {
    (16 + ((weigh(LUMA, pixel) + (1 << 15)) >> 16)) as u8
}

/// The two colour values of the sum of four pixels.
fn colour_of(sum: [i32; 3]) -> (u8, u8) {
    let scale = |weights| (128 + ((weigh(weights, sum) + (1 << 17)) >> 18)) as u8;
    (scale(BLUE), scale(RED))
}
