//! `steps.parquet` of a flight: one row per step and map, the same bytes for the same run.

use pose::Se3;

use crate::table::{Columns, TableError};

/// What is noted of one step of one map.
#[derive(Clone, Debug, PartialEq)]
pub struct FlightRow {
    /// Step of the loop, from 0.
    pub step: u64,
    /// The map.
    pub map: String,
    /// Distance flown, metres.
    pub distance_m: f64,
    /// What the loop was doing: `reactive`, `deliberate` or `done`.
    pub state: &'static str,
    /// The true pose.
    pub world_from_body: Se3,
    /// The pose as odometry alone has it, from the true start.
    pub odom_from_body: Se3,
    /// Share of the voxels that count and were really seen.
    pub coverage: f64,
    /// Frontier that counts, square metres.
    pub frontier_open_m2: f64,
    /// Frontier that does not count, square metres.
    pub frontier_ignored_m2: f64,
    /// Pieces of frontier that count.
    pub frontier_places: u64,
    /// Faces of the map.
    pub map_faces: u64,
    /// Volumes on vertices, or cells.
    pub map_volumes: u64,
    /// Vertices of the pose graph.
    pub vertices: u64,
    /// Place edges in it.
    pub place_edges: u64,
    /// Depth images taken.
    pub looks: u64,
    /// Commanded motions that would have touched a surface.
    pub collisions: u64,
    /// Motions whose noise pushed the robot into one.
    pub bumps: u64,
}

/// The bytes of `steps.parquet`.
///
/// # Errors
/// Only for more rows than memory holds.
pub fn flight_parquet(rows: &[FlightRow]) -> Result<Vec<u8>, TableError> {
    let mut table = Columns::default();
    table.all_counts("step", rows.iter().map(|row| row.step));
    table.all_texts("map", rows.iter().map(|row| row.map.as_str()));
    table.all_numbers("distance_m", rows.iter().map(|row| row.distance_m));
    table.all_texts("state", rows.iter().map(|row| row.state));
    pose_columns(&mut table, "true", rows.iter().map(|row| &row.world_from_body));
    pose_columns(&mut table, "odom", rows.iter().map(|row| &row.odom_from_body));
    table.all_numbers("coverage", rows.iter().map(|row| row.coverage));
    table.all_numbers("frontier_open_m2", rows.iter().map(|row| row.frontier_open_m2));
    table.all_numbers("frontier_ignored_m2", rows.iter().map(|row| row.frontier_ignored_m2));
    table.all_counts("frontier_places", rows.iter().map(|row| row.frontier_places));
    table.all_counts("map_faces", rows.iter().map(|row| row.map_faces));
    table.all_counts("map_volumes", rows.iter().map(|row| row.map_volumes));
    table.all_counts("vertices", rows.iter().map(|row| row.vertices));
    table.all_counts("place_edges", rows.iter().map(|row| row.place_edges));
    table.all_counts("looks", rows.iter().map(|row| row.looks));
    table.all_counts("collisions", rows.iter().map(|row| row.collisions));
    table.all_counts("bumps", rows.iter().map(|row| row.bumps));
    table.into_parquet()
}

/// Position and yaw of poses, a column each.
fn pose_columns<'a>(table: &mut Columns, name: &str, poses: impl Iterator<Item = &'a Se3> + Clone) {
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        table.all_numbers(
            &format!("{name}_{letter}_m"),
            poses.clone().map(|pose| pose.translation[axis]),
        );
    }
    let yaw = poses.map(|pose| pose.rotation.euler_angles().2);
    table.all_numbers(&format!("{name}_yaw_rad"), yaw);
}
