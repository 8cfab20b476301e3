//! `steps.parquet`: one row per step and map, the same bytes for the same run.

use std::sync::Arc;

use arrow::array::{ArrayRef, Float64Array, RecordBatch, StringArray, UInt64Array};
use arrow::error::ArrowError;
use parquet::arrow::ArrowWriter;
use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use pose::Se2;

/// What is noted of one step of one map.
#[derive(Clone, Debug, PartialEq)]
pub struct StepRow {
    /// Step of the loop, from 0.
    pub step: u64,
    /// The map that drives.
    pub map: String,
    /// Distance driven, metres.
    pub distance_m: f64,
    /// Simulated time: the distance at 1 m/s, seconds.
    pub sim_time_secs: f64,
    /// What the loop was doing: `reactive`, `deliberate` or `done`.
    pub state: &'static str,
    /// The true pose.
    pub world_from_body: Se2,
    /// The pose as odometry alone has it, from the true start.
    pub odom_from_body: Se2,
    /// Share of the reachable free cells that were really seen.
    pub coverage: f64,
    /// Frontier that counts, metres.
    pub frontier_open_m: f64,
    /// Frontier that does not count, metres.
    pub frontier_ignored_m: f64,
    /// Volumes or cells with frontier that counts.
    pub frontier_places: u64,
    /// Vertices of the pose graph.
    pub vertices: u64,
    /// Place edges in it.
    pub place_edges: u64,
    /// Scans taken.
    pub scans: u64,
    /// Commanded motions that would have touched an obstacle.
    pub collisions: u64,
    /// Motions whose noise pushed the robot into one.
    pub bumps: u64,
}

/// Why the table could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StepsError {
    /// The columns do not fit together.
    #[error("steps.parquet: {0}")]
    Arrow(#[from] ArrowError),
    /// The writer refused.
    #[error("steps.parquet: {0}")]
    Parquet(#[from] ParquetError),
}

/// The bytes of `steps.parquet`.
///
/// # Errors
/// Only for more rows than memory holds.
pub fn to_parquet(rows: &[StepRow]) -> Result<Vec<u8>, StepsError> {
    let batch = columns(rows)?;
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

fn columns(rows: &[StepRow]) -> Result<RecordBatch, ArrowError> {
    let float = |of: &dyn Fn(&StepRow) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(of)))
    };
    let count = |of: &dyn Fn(&StepRow) -> u64| -> ArrayRef {
        Arc::new(UInt64Array::from_iter_values(rows.iter().map(of)))
    };
    let word = |of: &dyn Fn(&StepRow) -> String| -> ArrayRef {
        Arc::new(StringArray::from_iter_values(rows.iter().map(of)))
    };
    RecordBatch::try_from_iter([
        ("step", count(&|row| row.step)),
        ("map", word(&|row| row.map.clone())),
        ("distance_m", float(&|row| row.distance_m)),
        ("sim_time", float(&|row| row.sim_time_secs)),
        ("state", word(&|row| row.state.to_owned())),
        ("true_x_m", float(&|row| row.world_from_body.translation.x)),
        ("true_y_m", float(&|row| row.world_from_body.translation.y)),
        ("true_theta_rad", float(&|row| row.world_from_body.angle())),
        ("odom_x_m", float(&|row| row.odom_from_body.translation.x)),
        ("odom_y_m", float(&|row| row.odom_from_body.translation.y)),
        ("odom_theta_rad", float(&|row| row.odom_from_body.angle())),
        ("coverage", float(&|row| row.coverage)),
        ("frontier_open_m", float(&|row| row.frontier_open_m)),
        ("frontier_ignored_m", float(&|row| row.frontier_ignored_m)),
        ("frontier_places", count(&|row| row.frontier_places)),
        ("vertices", count(&|row| row.vertices)),
        ("place_edges", count(&|row| row.place_edges)),
        ("scans", count(&|row| row.scans)),
        ("collisions", count(&|row| row.collisions)),
        ("bumps", count(&|row| row.bumps)),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};

    fn rows(count: u64) -> Vec<StepRow> {
        let row = |step: u64| StepRow {
            step,
            map: if step.is_multiple_of(2) { "relative".into() } else { "grid".into() },
            distance_m: step as f64 * 0.5,
            sim_time_secs: step as f64 * 0.5,
            state: "reactive",
            world_from_body: Se2::new(1.0, 2.0, 0.5),
            odom_from_body: Se2::identity(),
            coverage: 0.25,
            frontier_open_m: 3.0,
            frontier_ignored_m: 0.0,
            frontier_places: 4,
            vertices: step,
            place_edges: 0,
            scans: step,
            collisions: 0,
            bumps: 0,
        };
        (0..count).map(row).collect()
    }

    #[test]
    fn the_same_rows_give_the_same_bytes_that_read_back() {
        let bytes = to_parquet(&rows(3000)).unwrap();
        assert_eq!(bytes, to_parquet(&rows(3000)).unwrap());
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), &bytes).unwrap();
        let reader = SerializedFileReader::new(file.reopen().unwrap()).unwrap();
        assert_eq!(reader.metadata().file_metadata().num_rows(), 3000);
        let row = reader.get_row_iter(None).unwrap().nth(2).unwrap().unwrap();
        let columns: Vec<String> = row.get_column_iter().map(|(name, _)| name.clone()).collect();
        assert_eq!(columns[..3], ["step", "map", "distance_m"]);
        let value = row.get_column_iter().find(|(name, _)| *name == "true_theta_rad").unwrap();
        assert_eq!(value.1.to_string(), "0.5");
    }

    #[test]
    fn no_row_is_a_table_too() {
        assert!(to_parquet(&[]).unwrap().starts_with(b"PAR1"));
    }
}
