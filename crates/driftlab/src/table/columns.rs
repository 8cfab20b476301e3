//! Typed columns, and the bytes of a Parquet file that holds them.

use std::sync::Arc;

use arrow::array::{ArrayRef, BooleanArray, Float64Array, RecordBatch, StringArray, UInt64Array};
use arrow::datatypes::{Field, Schema};
use parquet::arrow::ArrowWriter;
use parquet::basic::Compression;
use parquet::file::properties::WriterProperties;

use super::TableError;

/// Columns of one length, in the order in which they were added.
#[derive(Debug, Default)]
pub(crate) struct Columns {
    fields: Vec<Field>,
    arrays: Vec<ArrayRef>,
}

impl Columns {
    /// Adds flags.
    pub(crate) fn flags(&mut self, name: &str, cells: impl Iterator<Item = Option<bool>>) {
        self.add(name, true, Arc::new(cells.collect::<BooleanArray>()));
    }

    /// Adds counts.
    pub(crate) fn counts(&mut self, name: &str, cells: impl Iterator<Item = Option<u64>>) {
        self.add(name, true, Arc::new(cells.collect::<UInt64Array>()));
    }

    /// Adds numbers.
    pub(crate) fn numbers(&mut self, name: &str, cells: impl Iterator<Item = Option<f64>>) {
        self.add(name, true, Arc::new(cells.collect::<Float64Array>()));
    }

    /// Adds texts.
    pub(crate) fn texts(&mut self, name: &str, cells: impl Iterator<Item = Option<String>>) {
        self.add(name, true, Arc::new(cells.collect::<StringArray>()));
    }

    /// Adds counts of which none is missing.
    pub(crate) fn all_counts(&mut self, name: &str, cells: impl Iterator<Item = u64>) {
        self.add(name, false, Arc::new(UInt64Array::from_iter_values(cells)));
    }

    /// Adds numbers of which none is missing.
    pub(crate) fn all_numbers(&mut self, name: &str, cells: impl Iterator<Item = f64>) {
        self.add(name, false, Arc::new(Float64Array::from_iter_values(cells)));
    }

    /// Adds texts of which none is missing.
    pub(crate) fn all_texts<'a>(&mut self, name: &str, cells: impl Iterator<Item = &'a str>) {
        self.add(name, false, Arc::new(StringArray::from_iter_values(cells)));
    }

    fn add(&mut self, name: &str, nullable: bool, array: ArrayRef) {
        self.fields.push(Field::new(name, array.data_type().clone(), nullable));
        self.arrays.push(array);
    }

    /// The bytes of the file: the same for the same columns.
    ///
    /// # Errors
    /// [`TableError::Arrow`] where the columns differ in length.
    pub(crate) fn into_parquet(self) -> Result<Vec<u8>, TableError> {
        let schema = Arc::new(Schema::new(self.fields));
        let batch = if self.arrays.is_empty() {
            RecordBatch::new_empty(schema)
        } else {
            RecordBatch::try_new(schema, self.arrays)?
        };
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
}
