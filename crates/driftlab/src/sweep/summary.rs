//! The table that an outlier sweep prints.

use std::fmt::Write;

use crate::table::{Cell, Table};

/// What the table tells of one row.
struct Line<'a> {
    graph: &'a str,
    method: &'a str,
    share: f64,
    success: bool,
    rmse: f64,
    precision: f64,
    recall: f64,
    secs: f64,
}

/// One line for each graph and method: for each share the successes, the largest RMSE in percent, the
/// lowest precision and recall, and the mean CPU seconds.
///
/// The rows of both tables belong to the same jobs.
pub(crate) fn markdown(results: &Table, timing: &Table) -> String {
    let rows = lines(results, timing);
    let mut shares: Vec<f64> = Vec::new();
    let mut lines: Vec<(&str, &str)> = Vec::new();
    for row in &rows {
        if !shares.contains(&row.share) {
            shares.push(row.share);
        }
        if !lines.contains(&(row.graph, row.method)) {
            lines.push((row.graph, row.method));
        }
    }
    let mut text = String::from("| graph | method |");
    for share in &shares {
        let _ = write!(text, " {:.0} % wrong |", share * 100.0);
    }
    text.push_str("\n|---|---|");
    text.push_str(&"---|".repeat(shares.len()));
    text.push('\n');
    for (graph, method) in lines {
        let _ = write!(text, "| {graph} | {method} |");
        for &share in &shares {
            let own: Vec<&Line<'_>> = rows
                .iter()
                .filter(|row| row.graph == graph && row.method == method && row.share == share)
                .collect();
            if own.is_empty() {
                text.push_str(" |");
                continue;
            }
            let least = |of: fn(&Line<'_>) -> f64| own.iter().map(|r| of(r)).fold(1.0, f64::min);
            let _ = write!(
                text,
                " {}/{}; {:.2} %; {:.2}, {:.2}; {:.2} s |",
                own.iter().filter(|row| row.success).count(),
                own.len(),
                100.0 * own.iter().map(|row| row.rmse).fold(0.0, f64::max),
                least(|row| row.precision),
                least(|row| row.recall),
                own.iter().map(|row| row.secs).sum::<f64>() / own.len() as f64
            );
        }
        text.push('\n');
    }
    text
}

fn lines<'a>(results: &'a Table, timing: &'a Table) -> Vec<Line<'a>> {
    let columns = ["graph", "method", "share", "success", "rmse", "precision", "recall"]
        .map(|name| results.column(name));
    let secs = timing.column("secs");
    let cell = |row: &'a [Cell], at: usize| columns[at].map_or(&Cell::Null, |column| &row[column]);
    let text = |row: &'a [Cell], at: usize| match cell(row, at) {
        Cell::Text(text) => text.as_str(),
        _ => "",
    };
    let number = |row: &'a [Cell], at: usize| cell(row, at).number().unwrap_or(f64::NAN);
    let rows = results.rows.iter().zip(&timing.rows);
    rows.map(|(row, timing)| Line {
        graph: text(row, 0),
        method: text(row, 1),
        share: number(row, 2),
        success: *cell(row, 3) == Cell::Flag(true),
        rmse: number(row, 4),
        precision: number(row, 5),
        recall: number(row, 6),
        secs: secs.and_then(|column| timing[column].number()).unwrap_or(f64::NAN),
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Row;

    fn row(method: &str, seed: u64, success: bool) -> [Row; 2] {
        let labels: Row = vec![
            ("graph".into(), "ring".into()),
            ("share".into(), 0.3.into()),
            ("seed".into(), seed.into()),
            ("method".into(), method.into()),
        ];
        let results: Row = vec![
            ("success".into(), success.into()),
            ("rmse".into(), (0.001 * seed as f64).into()),
            ("precision".into(), 1.0.into()),
            ("recall".into(), 0.9.into()),
        ];
        let timing: Row = vec![("secs".into(), 0.5.into())];
        [results, timing].map(|own| labels.iter().cloned().chain(own).collect())
    }

    #[test]
    fn seeds_are_summed_up() {
        let rows = [row("pcm", 1, true), row("dcs", 1, false), row("pcm", 2, false)];
        let [results, timing] =
            [0, 1].map(|which: usize| Table::of(rows.iter().map(|row| row[which].clone())));
        let expected = "| graph | method | 30 % wrong |\n|---|---|---|\n\
                        | ring | pcm | 1/2; 0.20 %; 1.00, 0.90; 0.50 s |\n\
                        | ring | dcs | 0/1; 0.10 %; 1.00, 0.90; 0.50 s |\n";
        assert_eq!(markdown(&results, &timing), expected);
    }
}
