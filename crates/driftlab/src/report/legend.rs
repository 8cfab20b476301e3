//! The names of a plot's methods, above it, where they hide no point.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::chart::Series;

/// Height of a row, pixels.
const ROW: i32 = 20;

/// Height of the letters, pixels.
const LETTERS: i32 = 14;

/// Width of the sign, and of the gap behind a name, pixels.
const SIGN: i32 = 22;

/// Where each name stands, pixels from the upper left corner, and how many rows that takes.
///
/// Widths of letters are estimated, generously: an SVG file does not know the font it will meet.
fn places(names: &[&str], width: i32) -> (Vec<(i32, i32)>, u32) {
    let mut places = Vec::with_capacity(names.len());
    let (mut x, mut row) = (0, 0);
    for name in names {
        let own = 2 * SIGN + name.chars().count() as i32 * 3 * LETTERS / 5;
        if x > 0 && x + own > width {
            (x, row) = (0, row + 1);
        }
        places.push((x, row * ROW));
        x += own;
    }
    (places, if names.is_empty() { 0 } else { row as u32 + 1 })
}

/// Pixels that the names take below each other.
pub(super) fn height(series: &[Series], width: u32) -> u32 {
    let names: Vec<&str> = series.iter().map(|one| one.name.as_str()).collect();
    places(&names, width as i32).1 * ROW as u32
}

/// Draws the names, each behind its sign: a line, or a point as points are drawn.
pub(super) fn draw<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    series: &[Series],
    colour_of: impl Fn(&Series) -> RGBColor,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let names: Vec<&str> = series.iter().map(|one| one.name.as_str()).collect();
    let (places, _) = places(&names, area.dim_in_pixel().0 as i32);
    let font = ("sans-serif", LETTERS).into_font();
    for (one, (x, y)) in series.iter().zip(places) {
        let colour = colour_of(one);
        let middle = y + ROW / 2;
        if one.bars.is_empty() {
            let ends = vec![(x, middle), (x + 16, middle)];
            area.draw(&PathElement::new(ends, colour.stroke_width(3)))?;
        } else {
            let fill = if one.hollow { WHITE.filled() } else { colour.filled() };
            area.draw(&Circle::new((x + 8, middle), 4, fill))?;
            area.draw(&Circle::new((x + 8, middle), 4, colour.stroke_width(2)))?;
        }
        let name = Text::new(one.name.as_str(), (x + SIGN, middle - LETTERS / 3), font.clone());
        area.draw(&name)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_do_not_fit_go_to_the_next_row() {
        let (at, rows) = places(&["relative", "grid", "grid_corrected", "corrected_polygons"], 300);
        assert_eq!((at[0], rows), ((0, 0), 3));
        assert!(at[1].0 > 80 && at[1].1 == 0, "{at:?}");
        assert_eq!(at[2], (0, ROW));
        assert_eq!(at[3], (0, 2 * ROW));
        assert_eq!(places(&["a name too long for any row"], 10), (vec![(0, 0)], 1));
        assert_eq!(places(&[], 10).1, 0);
    }
}
