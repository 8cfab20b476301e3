//! Tables: named columns of cells, as Parquet, as comma-separated values.
//!
//! | file | what |
//! |---|---|
//! | `cell` | one value, and its exact text |
//! | `rows` | rows of cells that need not have the same names |
//! | `columns` | typed columns to the bytes of a Parquet file |

mod cell;
mod columns;
mod rows;

pub(crate) use cell::Cell;
pub(crate) use columns::Columns;
pub(crate) use rows::{Row, Table};

/// Why a table could not be made or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// The columns do not fit together.
    #[error("columns do not fit together: {0}")]
    Arrow(#[from] arrow::error::ArrowError),
    /// The file is no table, or the writer refused.
    #[error("{0}")]
    Parquet(#[from] parquet::errors::ParquetError),
}
