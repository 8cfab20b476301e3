//! MovingAI grid maps (`.map`): Sturtevant's benchmark format.

use crate::FormatError;
use crate::error::{Position, check_size, quote};
use crate::lines::{position, without_mark};

/// A MovingAI map: one byte per tile, row 0 is the top row of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MovingAiMap {
    /// What the `type` line says, as a rule `octile`.
    pub kind: String,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Tiles, row-major from the top row: `.` and `G` ground, `S` swamp, `W` water, `T` trees,
    /// `@` and `O` out of bounds.
    pub tiles: Vec<u8>,
}

impl MovingAiMap {
    /// Whether each tile blocks, row-major from the top row: all but `.`, `G` and `S`.
    ///
    /// Water can be crossed only from water by the format's rules, so that for a robot that starts
    /// on ground it blocks.
    pub fn blocked(&self) -> Vec<bool> {
        self.tiles.iter().map(|tile| !matches!(tile, b'.' | b'G' | b'S')).collect()
    }
}

/// Reads the text of a `.map` file: `type`, `height` and `width` in any order, `map`, then the rows.
///
/// White space at the end of a row and empty lines after the last row are let pass.
///
/// # Errors
/// [`FormatError::Unexpected`] with line and column; [`FormatError::TooLarge`] before allocation.
pub fn read(text: &str) -> Result<MovingAiMap, FormatError> {
    let text = without_mark(text);
    let mut lines = text.lines().enumerate().map(|(index, line)| (index + 1, line));
    let mut kind: Option<String> = None;
    let mut height: Option<(u64, Position)> = None;
    let mut width: Option<(u64, Position)> = None;
    let mut last = 0;
    let map_line = loop {
        let Some((number, line)) = lines.next() else {
            let at = position(last + 1, "", 0);
            return Err(FormatError::unexpected(at, "the end of the file", "a line `map`"));
        };
        last = number;
        let word = line.split_whitespace().next().unwrap_or_default();
        let value = line.trim_start().get(word.len()..).unwrap_or_default().trim();
        let at = position(number, line, line.len() - line.trim_start().len());
        let twice = match word {
            "type" => kind.replace(value.into()).is_some(),
            "height" => height.replace((size(number, line, value)?, at)).is_some(),
            "width" => width.replace((size(number, line, value)?, at)).is_some(),
            "map" if value.is_empty() => break number,
            "" => false,
            _ => {
                let expected = "`type`, `height`, `width` or `map`";
                return Err(FormatError::unexpected(at, quote(line), expected));
            }
        };
        if twice {
            return Err(FormatError::unexpected(at, format!("a second `{word}`"), "each key once"));
        }
    };
    let at_map = position(map_line, "", 0);
    let missing =
        |what: &str| FormatError::unexpected(at_map, "`map`", format!("a line `{what}` before it"));
    let kind = kind.ok_or_else(|| missing("type octile"))?;
    let (rows, _) = height.ok_or_else(|| missing("height N"))?;
    let (columns, at_width) = width.ok_or_else(|| missing("width N"))?;
    let (columns, rows) = check_size(at_width, columns, rows)?;
    if text.len() < columns * rows {
        let found = format!("a file of {} bytes", text.len());
        let expected = format!("{rows} rows of {columns} tiles");
        return Err(FormatError::unexpected(at_map, found, expected));
    }
    let mut tiles = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        let Some((number, line)) = lines.next() else {
            let at = position(map_line + row + 1, "", 0);
            let found = format!("the end of the file after {row} rows");
            return Err(FormatError::unexpected(at, found, format!("{rows} rows")));
        };
        tiles.extend(read_row(number, line, columns)?);
    }
    for (number, line) in lines {
        if !line.trim().is_empty() {
            let expected = format!("the end of the file after {rows} rows");
            return Err(FormatError::unexpected(position(number, "", 0), quote(line), expected));
        }
    }
    Ok(MovingAiMap { kind, columns, rows, tiles })
}

fn size(number: usize, line: &str, value: &str) -> Result<u64, FormatError> {
    value.parse().map_err(|_| {
        let at = position(number, line, line.trim_end().len() - value.len());
        let found = if value.is_empty() { "the end of the line".into() } else { quote(value) };
        FormatError::unexpected(at, found, "a count")
    })
}

/// The tiles of the format.
const TILES: &[u8] = b".GSWT@O";

fn read_row(number: usize, line: &str, columns: usize) -> Result<&[u8], FormatError> {
    if let Some(offset) = line.trim_end().bytes().position(|byte| !TILES.contains(&byte)) {
        // The first byte that is no tile starts a character, as all before it are ASCII.
        let found = line.get(offset..).and_then(|rest| rest.chars().next());
        let found = quote(&found.map(String::from).unwrap_or_default());
        let expected = "a tile, one of . G S W T @ O";
        return Err(FormatError::unexpected(position(number, line, offset), found, expected));
    }
    let tiles = line.trim_end().as_bytes();
    if tiles.len() != columns {
        let at = position(number, line, tiles.len().min(columns));
        let found = format!("a row of {} tiles", tiles.len());
        return Err(FormatError::unexpected(at, found, format!("{columns} tiles")));
    }
    Ok(tiles)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAP: &str = "type octile\nheight 2\nwidth 7\nmap\n.GS@OTW\r\n.......\n\n";

    #[test]
    fn tiles_and_what_blocks() {
        let map = read(MAP).expect("valid");
        assert_eq!((map.kind.as_str(), map.columns, map.rows), ("octile", 7, 2));
        assert_eq!(map.tiles, b".GS@OTW.......");
        let blocked = map.blocked();
        assert_eq!(blocked[..7], [false, false, false, true, true, true, true]);
        assert!(!blocked[7..].contains(&true));
        let swapped = "width 7\nheight 2\ntype octile\nmap\n.GS@OTW  \n.......";
        assert_eq!(read(swapped), Ok(map));
    }

    #[test]
    fn errors_say_where() {
        let cases = [
            ("", "line 1, column 1: found the end of the file, expected a line `map`"),
            (
                "type octile\nheigth 2",
                "line 2, column 1: found `heigth 2`, expected `type`, `height`, `width` or `map`",
            ),
            ("type octile\nheight x\n", "line 2, column 8: found `x`, expected a count"),
            ("height -2\n", "line 1, column 8: found `-2`, expected a count"),
            ("height\n", "line 1, column 7: found the end of the line, expected a count"),
            (
                "width 1\nwidth 1\n",
                "line 2, column 1: found a second `width`, expected each key once",
            ),
            (
                "type octile\nheight 2\nmap\n",
                "line 3, column 1: found `map`, expected a line `width N` before it",
            ),
            (
                "type a\nheight 99999\nwidth 99999\nmap\n",
                "line 3, column 1: found 99999 x 99999 cells, expected at most 268435456 in all",
            ),
            (
                "type a\nheight 99\nwidth 99\nmap\n",
                "line 4, column 1: found a file of 30 bytes, expected 99 rows of 99 tiles",
            ),
            (
                "type a\nheight 2\nwidth 3\nmap\n...\n....\n",
                "line 6, column 4: found a row of 4 tiles, expected 3 tiles",
            ),
            (
                "type a\nheight 2\nwidth 3\nmap\n..\n....\n",
                "line 5, column 3: found a row of 2 tiles, expected 3 tiles",
            ),
            (
                "type a\nheight 2\nwidth 3\nmap\n...\n",
                "line 6, column 1: found the end of the file after 1 rows, expected 2 rows",
            ),
            (
                "type a\nheight 1\nwidth 3\nmap\n...\n...\n",
                "line 6, column 1: found `...`, expected the end of the file after 1 rows",
            ),
            (
                "type a\nheight 1\nwidth 3\nmap\n.ä.\n",
                "line 5, column 2: found `ä`, expected a tile, one of . G S W T @ O",
            ),
            (
                "type a\nheight 2\nwidth 3\nmap\n...\n.#.\n",
                "line 6, column 2: found `#`, expected a tile, one of . G S W T @ O",
            ),
        ];
        for (text, message) in cases {
            assert_eq!(read(text).expect_err(text).to_string(), message);
        }
    }
}
