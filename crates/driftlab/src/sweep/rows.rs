//! Rows of a sweep as files and as a table.

use std::fmt::Write;
use std::sync::Arc;

use arrow::array::{ArrayRef, BooleanArray, Float64Array, RecordBatch, StringArray, UInt64Array};
use parquet::arrow::ArrowWriter;
use parquet::basic::Compression;
use parquet::file::properties::WriterProperties;

use super::{OutlierRow, SweepError};

/// The bytes of `results.parquet`.
///
/// # Errors
/// Only for more rows than memory holds.
pub fn to_parquet(rows: &[OutlierRow]) -> Result<Vec<u8>, SweepError> {
    let float = |of: &dyn Fn(&OutlierRow) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(of)))
    };
    let count = |of: &dyn Fn(&OutlierRow) -> u64| -> ArrayRef {
        Arc::new(UInt64Array::from_iter_values(rows.iter().map(of)))
    };
    let graphs: ArrayRef = Arc::new(StringArray::from_iter_values(rows.iter().map(|r| &r.graph)));
    let methods: ArrayRef = Arc::new(StringArray::from_iter_values(rows.iter().map(|r| r.method)));
    let successes: Vec<bool> = rows.iter().map(|row| row.success).collect();
    let successes: ArrayRef = Arc::new(BooleanArray::from(successes));
    let batch = RecordBatch::try_from_iter([
        ("graph", graphs),
        ("dimension", count(&|row| row.dimension)),
        ("share", float(&|row| row.share)),
        ("seed", count(&|row| row.seed)),
        ("method", methods),
        ("success", successes),
        ("rmse", float(&|row| row.rmse)),
        ("precision", float(&|row| row.precision)),
        ("recall", float(&|row| row.recall)),
        ("wrong", count(&|row| row.wrong)),
        ("rejected", count(&|row| row.rejected)),
        ("noise_scale", float(&|row| row.noise_scale)),
        ("iterations", count(&|row| row.iterations)),
        ("secs", float(&|row| row.secs)),
    ])?;
    let properties = WriterProperties::builder()
        .set_created_by("driftlab".into())
        .set_compression(Compression::SNAPPY)
        .build();
    let mut bytes = Vec::new();
    let mut writer = ArrowWriter::try_new(&mut bytes, batch.schema(), Some(properties))?;
    writer.write(&batch)?;
    writer.close()?;
    Ok(bytes)
}

/// The same as comma-separated values, with a header.
pub fn to_csv(rows: &[OutlierRow]) -> String {
    let mut text = String::from(
        "graph,dimension,share,seed,method,success,rmse,precision,recall,wrong,rejected,\
         noise_scale,iterations,secs\n",
    );
    for row in rows {
        let quoted = row.graph.replace('"', "\"\"");
        let _ = writeln!(
            text,
            "\"{quoted}\",{},{},{},{},{},{},{},{},{},{},{},{},{}",
            row.dimension,
            row.share,
            row.seed,
            row.method,
            row.success,
            row.rmse,
            row.precision,
            row.recall,
            row.wrong,
            row.rejected,
            row.noise_scale,
            row.iterations,
            row.secs
        );
    }
    text
}

/// One line for each graph and method: for each share the successes, the largest RMSE in percent, the
/// lowest precision and recall, and the mean seconds.
pub fn markdown(rows: &[OutlierRow]) -> String {
    let mut shares: Vec<f64> = Vec::new();
    let mut lines: Vec<(&str, &str)> = Vec::new();
    for row in rows {
        if !shares.contains(&row.share) {
            shares.push(row.share);
        }
        if !lines.contains(&(&row.graph, row.method)) {
            lines.push((&row.graph, row.method));
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
            let own: Vec<&OutlierRow> = rows
                .iter()
                .filter(|row| row.graph == graph && row.method == method && row.share == share)
                .collect();
            let least = |of: fn(&OutlierRow) -> f64| own.iter().map(|r| of(r)).fold(1.0, f64::min);
            let _ = write!(
                text,
                " {}/{}; {:.2} %; {:.2}, {:.2}; {:.2} s |",
                own.iter().filter(|row| row.success).count(),
                own.len(),
                100.0 * own.iter().map(|row| row.rmse).fold(0.0, f64::max),
                least(|row| row.precision),
                least(|row| row.recall),
                own.iter().map(|row| row.secs).sum::<f64>() / own.len().max(1) as f64
            );
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(method: &'static str, seed: u64, success: bool) -> OutlierRow {
        OutlierRow {
            graph: "ring".into(),
            dimension: 2,
            share: 0.3,
            seed,
            method,
            success,
            rmse: 0.001 * seed as f64,
            precision: 1.0,
            recall: 0.9,
            wrong: 10,
            rejected: 9,
            noise_scale: 0.5,
            iterations: 20,
            secs: 0.5,
        }
    }

    #[test]
    fn seeds_are_summed_up() {
        let rows = [row("pcm", 1, true), row("dcs", 1, false), row("pcm", 2, false)];
        let expected = "| graph | method | 30 % wrong |\n|---|---|---|\n\
                        | ring | pcm | 1/2; 0.20 %; 1.00, 0.90; 0.50 s |\n\
                        | ring | dcs | 0/1; 0.10 %; 1.00, 0.90; 0.50 s |\n";
        assert_eq!(markdown(&rows), expected);
    }

    #[test]
    fn files_hold_every_row() {
        let rows = [row("pcm", 1, true), row("dcs", 1, false)];
        assert!(to_parquet(&rows).unwrap().starts_with(b"PAR1"));
        assert_eq!(to_parquet(&rows).unwrap(), to_parquet(&rows).unwrap());
        let csv = to_csv(&rows);
        assert_eq!(csv.lines().count(), 3);
        assert!(csv.ends_with("\"ring\",2,0.3,1,dcs,false,0.001,1,0.9,10,9,0.5,20,0.5\n"));
    }
}
