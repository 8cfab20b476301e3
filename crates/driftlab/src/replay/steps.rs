//! `steps.parquet` of a replay: one row per keyframe and map.

use pose::Se2;

use crate::table::{Columns, TableError};

/// What is noted of one keyframe of one map.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayRow {
    /// Keyframe, from 0.
    pub step: u64,
    /// The map.
    pub map: &'static str,
    /// Distance driven by the log's odometry, metres.
    pub distance_m: f64,
    /// Time since the start of the log, seconds.
    pub time_secs: f64,
    /// The vertex that the scan was taken at.
    pub vertex: u64,
    /// The keyframe where the log's odometry has it, from the first on.
    pub odom_from_keyframe: Se2,
    /// Where it is once everything is known.
    pub map_from_keyframe: Se2,
    /// Area seen so far as free, each keyframe where it is once everything is known; square metres.
    pub covered_m2: f64,
    /// Frontier that counts, metres.
    pub frontier_open_m: f64,
    /// Frontier that does not count, metres.
    pub frontier_ignored_m: f64,
    /// Volumes or cells with frontier that counts.
    pub frontier_places: u64,
    /// Vertices of the pose graph.
    pub vertices: u64,
    /// Recognised places that the map was told of.
    pub place_edges: u64,
}

/// A pose of a row.
type PoseOf = fn(&ReplayRow) -> &Se2;

/// The bytes of `steps.parquet`.
///
/// # Errors
/// Only for more rows than memory holds.
pub fn to_parquet(rows: &[ReplayRow]) -> Result<Vec<u8>, TableError> {
    let mut table = Columns::default();
    table.all_counts("step", rows.iter().map(|row| row.step));
    table.all_texts("map", rows.iter().map(|row| row.map));
    table.all_numbers("distance_m", rows.iter().map(|row| row.distance_m));
    table.all_numbers("time_secs", rows.iter().map(|row| row.time_secs));
    table.all_counts("vertex", rows.iter().map(|row| row.vertex));
    let poses: [(&str, PoseOf); 2] =
        [("odom", |row| &row.odom_from_keyframe), ("map", |row| &row.map_from_keyframe)];
    for (name, of) in poses {
        table.all_numbers(&format!("{name}_x_m"), rows.iter().map(|row| of(row).translation.x));
        table.all_numbers(&format!("{name}_y_m"), rows.iter().map(|row| of(row).translation.y));
        table.all_numbers(&format!("{name}_theta_rad"), rows.iter().map(|row| of(row).angle()));
    }
    table.all_numbers("covered_m2", rows.iter().map(|row| row.covered_m2));
    table.all_numbers("frontier_open_m", rows.iter().map(|row| row.frontier_open_m));
    table.all_numbers("frontier_ignored_m", rows.iter().map(|row| row.frontier_ignored_m));
    table.all_counts("frontier_places", rows.iter().map(|row| row.frontier_places));
    table.all_counts("vertices", rows.iter().map(|row| row.vertices));
    table.all_counts("place_edges", rows.iter().map(|row| row.place_edges));
    table.into_parquet()
}
