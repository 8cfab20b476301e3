//! A table for the terminal.

/// Rows of equal length under a header; the first `names` columns are text, the others numbers.
pub(super) fn table(header: &[&str], rows: &[Vec<String>], names: usize) -> String {
    let count = |text: &str| text.chars().count();
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row.get(column).map_or(0, |cell| count(cell)));
        cells.max().unwrap_or(0).max(count(header[column]))
    };
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let mut out = String::new();
    let head: Vec<String> = header.iter().map(|&cell| cell.to_owned()).collect();
    for row in std::iter::once(&head).chain(rows) {
        let mut line = String::new();
        for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
            let space = " ".repeat(width - count(cell));
            let gap = if column == 0 { "" } else { "  " };
            let (before, after) =
                if column < names { ("", space.as_str()) } else { (space.as_str(), "") };
            line.push_str(&format!("{gap}{before}{cell}{after}"));
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stand_under_each_other() {
        let rows = vec![vec!["relative".into(), "1.0".into()], vec!["grid".into(), "µ".into()]];
        let expected = "map       coverage\nrelative       1.0\ngrid             µ\n";
        assert_eq!(table(&["map", "coverage"], &rows, 1), expected);
    }
}
