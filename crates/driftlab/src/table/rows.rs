//! Rows of cells, gathered into a table.

use super::{Cell, Columns, TableError};

/// Named cells, in order.
pub(crate) type Row = Vec<(String, Cell)>;

/// Rows under one header.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Table {
    /// The names of the columns.
    pub(crate) names: Vec<String>,
    /// The cells, one for each column.
    pub(crate) rows: Vec<Vec<Cell>>,
}

impl Table {
    /// Rows with the names that any of them has, in the order in which these first come; what a
    /// row does not tell is null.
    pub(crate) fn of(rows: impl IntoIterator<Item = Row>) -> Self {
        let mut table = Self::default();
        for row in rows {
            let mut cells = vec![Cell::Null; table.names.len()];
            for (at, (name, cell)) in row.into_iter().enumerate() {
                // Rows mostly have the same names in the same order.
                let same = table.names.get(at).is_some_and(|known| *known == name);
                let known = if same { Some(at) } else { table.column(&name) };
                match known {
                    Some(column) => cells[column] = cell,
                    None => {
                        table.names.push(name);
                        cells.push(cell);
                    }
                }
            }
            table.rows.push(cells);
        }
        let width = table.names.len();
        table.rows.iter_mut().for_each(|cells| cells.resize(width, Cell::Null));
        table
    }

    /// Where a column stands.
    pub(crate) fn column(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// The bytes of a Parquet file with these rows.
    ///
    /// A column is of the narrowest kind that holds all its cells: flags, counts, numbers, texts.
    ///
    /// # Errors
    /// Where the writer refuses.
    pub(crate) fn to_parquet(&self) -> Result<Vec<u8>, TableError> {
        let mut columns = Columns::default();
        for (at, name) in self.names.iter().enumerate() {
            let cells = || self.rows.iter().map(|row| &row[at]);
            let all =
                |fits: fn(&Cell) -> bool| cells().all(|cell| *cell == Cell::Null || fits(cell));
            if cells().all(|cell| *cell == Cell::Null) {
                columns.numbers(name, cells().map(|_| None));
            } else if all(|cell| matches!(cell, Cell::Flag(_))) {
                let flag =
                    |cell: &Cell| if let Cell::Flag(flag) = cell { Some(*flag) } else { None };
                columns.flags(name, cells().map(flag));
            } else if all(|cell| matches!(cell, Cell::Count(_))) {
                let count =
                    |cell: &Cell| if let Cell::Count(count) = cell { Some(*count) } else { None };
                columns.counts(name, cells().map(count));
            } else if all(|cell| matches!(cell, Cell::Count(_) | Cell::Number(_))) {
                columns.numbers(name, cells().map(Cell::number));
            } else {
                let text = |cell: &Cell| (*cell != Cell::Null).then(|| cell.shown());
                columns.texts(name, cells().map(text));
            }
        }
        columns.into_parquet()
    }

    /// The same as comma-separated values, with a header; texts are quoted, nulls are empty.
    pub(crate) fn to_csv(&self) -> String {
        let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
        let mut text = String::new();
        let mut line = |cells: Vec<String>| {
            text.push_str(&cells.join(","));
            text.push('\n');
        };
        line(self.names.clone());
        for row in &self.rows {
            line(
                row.iter()
                    .map(|cell| match cell {
                        Cell::Text(text) => quoted(text),
                        plain => plain.shown(),
                    })
                    .collect(),
            );
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::super::read_parquet;
    use super::*;

    fn row(cells: &[(&str, Cell)]) -> Row {
        cells.iter().map(|(name, cell)| ((*name).to_owned(), cell.clone())).collect()
    }

    fn table() -> Table {
        Table::of([
            row(&[("name", "a\"b".into()), ("steps", 3_u64.into()), ("share", 1_u64.into())]),
            row(&[("name", "c".into()), ("steps", Cell::Null), ("share", 0.5.into())]),
            row(&[("done", true.into()), ("name", "d".into())]),
        ])
    }

    #[test]
    fn rows_are_gathered_by_name() {
        let table = table();
        assert_eq!(table.names, ["name", "steps", "share", "done"]);
        assert_eq!(table.rows[0][3], Cell::Null);
        assert_eq!(table.rows[2], ["d".into(), Cell::Null, Cell::Null, true.into()]);
        let csv = "name,steps,share,done\n\"a\"\"b\",3,1,\n\"c\",,0.5,\n\"d\",,,true\n";
        assert_eq!(table.to_csv(), csv);
    }

    #[test]
    fn a_file_says_what_the_rows_said() {
        let bytes = table().to_parquet().expect("a table");
        assert_eq!(bytes, table().to_parquet().expect("a table"));
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), bytes).expect("written");
        let mut expected = table();
        // A column has one kind: the widest of its cells.
        expected.rows[0][2] = 1.0.into();
        assert_eq!(read_parquet(file.path()).expect("read"), expected);
    }

    #[test]
    fn no_row_and_no_column_is_a_table_too() {
        assert!(Table::default().to_parquet().expect("empty").starts_with(b"PAR1"));
    }
}
