//! The same work over many inputs: one row each.

mod outliers;
mod rows;

pub use outliers::{OutlierRow, SweepError, outlier_rows};
pub use rows::{markdown, to_csv, to_parquet};
