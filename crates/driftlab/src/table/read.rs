//! Reading a table back.

use std::fs::File;
use std::path::Path;

use arrow::array::{Array, ArrayRef, AsArray as _};
use arrow::datatypes::{DataType, Float64Type, UInt64Type};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

use super::{Cell, Table, TableError};

/// The table in a Parquet file.
///
/// # Errors
/// A file that cannot be read, is no Parquet file, or has columns of other kinds than ours.
pub(crate) fn read_parquet(path: &Path) -> Result<Table, TableError> {
    let builder = ParquetRecordBatchReaderBuilder::try_new(File::open(path)?)?;
    let names = builder.schema().fields().iter().map(|field| field.name().clone()).collect();
    let mut table = Table { names, rows: Vec::new() };
    for batch in builder.build()? {
        let batch = batch?;
        let columns: Result<Vec<Vec<Cell>>, TableError> = table
            .names
            .iter()
            .zip(batch.columns())
            .map(|(name, array)| cells(name, array))
            .collect();
        let columns = columns?;
        for row in 0..batch.num_rows() {
            table.rows.push(columns.iter().map(|column| column[row].clone()).collect());
        }
    }
    Ok(table)
}

fn cells(name: &str, array: &ArrayRef) -> Result<Vec<Cell>, TableError> {
    let cell = |of: &dyn Fn(usize) -> Cell| -> Vec<Cell> {
        (0..array.len()).map(|i| if array.is_null(i) { Cell::Null } else { of(i) }).collect()
    };
    Ok(match array.data_type() {
        DataType::Boolean => cell(&|i| array.as_boolean().value(i).into()),
        DataType::UInt64 => cell(&|i| array.as_primitive::<UInt64Type>().value(i).into()),
        DataType::Float64 => cell(&|i| array.as_primitive::<Float64Type>().value(i).into()),
        DataType::Utf8 => cell(&|i| array.as_string::<i32>().value(i).into()),
        other => {
            return Err(TableError::Kind { column: name.to_owned(), found: other.to_string() });
        }
    })
}
