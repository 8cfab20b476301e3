//! Tables: named columns of cells, as Parquet, as comma-separated values, and back.
//!
//! | file | what |
//! |---|---|
//! | `cell` | one value, and its exact text |
//! | `rows` | rows of cells that need not have the same names |
//! | `columns` | typed columns to the bytes of a Parquet file |
//! | `read` | a Parquet file to rows |

mod cell;
mod columns;
mod read;
mod rows;

pub(crate) use cell::Cell;
pub(crate) use columns::Columns;
pub(crate) use read::read_parquet;
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
    /// The file cannot be read.
    #[error("cannot be read ({0})")]
    Io(#[from] std::io::Error),
    /// A column of a kind that our tables do not have.
    #[error("found column `{column}` of type {found}, expected flags, numbers or text")]
    Kind {
        /// Its name.
        column: String,
        /// What it is.
        found: String,
    },
}
