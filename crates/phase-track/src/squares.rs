//! Squares of dark lines in a picture, each of which may be the edge of an arena.

use crate::{
    picture::{Picture, darkness},
    view::View,
};
use phase_model::{Vec2, arena};

/// Lines of one direction that may be edges of the arena: half of them from either side.
const MOST_PEAKS: usize = 8;
/// Squares of lines that may be the arena.
const MOST_FRAMES: usize = 16;

/// Squares of long dark lines, the largest first, with half the width of their lines (u).
pub(crate) fn frames_of(picture: &Picture<'_>) -> Vec<(View, f32)> {
    let (width, height) = picture.size();
    let dark = |x: usize, y: usize| darkness(picture.at(x, y));
    // Bars beside or above the picture.
    let mut columns = 0..width;
    let mut rows = 0..height;
    let row_is_bar = |y: usize| (0..width).map(|x| dark(x, y)).sum::<f32>() > 0.7 * width as f32;
    let column_is_bar = |x: usize| (0..height).map(|y| dark(x, y)).sum::<f32>() > 0.7 * height as f32;
    while !rows.is_empty() && row_is_bar(rows.start) {
        rows.start += 1;
    }
    while !rows.is_empty() && row_is_bar(rows.end - 1) {
        rows.end -= 1;
    }
    while !columns.is_empty() && column_is_bar(columns.start) {
        columns.start += 1;
    }
    while !columns.is_empty() && column_is_bar(columns.end - 1) {
        columns.end -= 1;
    }
    if rows.len() < 32 || columns.len() < 32 {
        return Vec::new();
    }
    // A line at the picture's edge may itself be taken for a bar.
    let rows = if rows.start > 0 && rows.start < 8 { 0..height } else { rows };
    let columns = if columns.start > 0 && columns.start < 8 { 0..width } else { columns };
    let of_columns: Vec<f32> = columns.clone().map(|x| rows.clone().map(|y| dark(x, y)).sum()).collect();
    let least = 0.25 * columns.len().min(rows.len()) as f32;
    let mut found = Vec::new();
    for (left, right, wide) in pairs(&of_columns) {
        let inside = columns.start + left as usize..(columns.start + right.ceil() as usize + 1).min(width);
        let of_rows: Vec<f32> = rows.clone().map(|y| inside.clone().map(|x| dark(x, y)).sum()).collect();
        for (top, bottom, high) in pairs(&of_rows) {
            let sides = Vec2::new(right - left, bottom - top);
            let is_square = (sides.x - sides.y).abs() < 0.03 * sides.max_element();
            if !is_square || sides.max_element() < least || sides.x < 60.0 {
                continue;
            }
            let scale = 0.5 * (sides.x + sides.y) / arena::SIDE;
            let corner = Vec2::new(columns.start as f32 + left, rows.start as f32 + top);
            let corner = corner + 0.5 * sides - Vec2::splat(0.5 * arena::SIDE * scale);
            found.push((View { scale, corner }, 0.25 * (wide + high) / scale));
        }
    }
    found.sort_by(|a, b| b.0.scale.total_cmp(&a.0.scale));
    found.truncate(MOST_FRAMES);
    found
}

/// The middles of two of the highest peaks of a profile, and the mean of their widths.
fn pairs(profile: &[f32]) -> Vec<(f32, f32, f32)> {
    let peaks = peaks(profile);
    let pairs = peaks.iter().enumerate().flat_map(|(k, a)| peaks[k + 1..].iter().map(move |b| (a, b)));
    pairs.filter(|(a, b)| b.0 - a.0 > 40.0).map(|(a, b)| (a.0, b.0, 0.5 * (a.1 + b.1))).collect()
}

/// The middles of the highest peaks of a profile, with their widths.
fn peaks(profile: &[f32]) -> Vec<(f32, f32)> {
    let most = profile.iter().copied().fold(0.0, f32::max);
    if most < 20.0 {
        return Vec::new();
    }
    let high = |k: usize| profile[k] > 0.6 * most;
    let starts = (0..profile.len()).filter(|&k| high(k) && (k == 0 || !high(k - 1)));
    let peak = |start: usize| {
        let end = (start..profile.len()).take_while(|&k| high(k)).last().unwrap_or(start);
        let from = start.saturating_sub(2);
        let to = (end + 2).min(profile.len() - 1);
        // Landmarks and bodies make a base below the peak.
        let base = profile[from].max(profile[to]).min(0.4 * most);
        let above = |k: usize| (profile[k] - base).max(0.0);
        let total: f32 = (from..=to).map(above).sum();
        let sum: f32 = (from..=to).map(|k| (k as f32 + 0.5) * above(k)).sum();
        (sum / total, total / (most - base))
    };
    let all: Vec<_> = starts.map(peak).collect();
    let ends = MOST_PEAKS / 2;
    // The arena's edges are the outermost of all lines, or inside of a few others.
    let kept = |k: usize| k < ends || k + ends >= all.len();
    all.iter().enumerate().filter(|(k, _)| kept(*k)).map(|(_, peak)| *peak).collect()
}
