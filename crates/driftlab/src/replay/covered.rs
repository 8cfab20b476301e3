//! The area that was seen as free, over the keyframes (after \[ISRR19\] 6.3).

use std::collections::BTreeSet;

use geometry::Point2;
use maps2d::volume::{VolumeParams, build};

use super::course::Course;

/// The area of the cells whose centre some view up to each keyframe saw as free, square metres; by
/// keyframe, each where the optimised graph has it.
///
/// Cost: the cells that all views cover.
pub(super) fn covered(course: &Course, params: &VolumeParams, cell_m: f64) -> Vec<f64> {
    let mut seen: BTreeSet<(i64, i64)> = BTreeSet::new();
    let mut areas = Vec::with_capacity(course.views.len());
    for (samples, pose) in course.views.iter().zip(&course.optimised) {
        if let Ok(volume) = build(samples, params) {
            let polygon = &volume.polygon;
            let cell = |metres: f64| (metres / cell_m).floor() as i64;
            let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
            // A view that looks one way only still reaches back to where it was taken.
            let corners = polygon.vertices().iter().copied().chain([Point2::origin()]);
            for corner in corners.map(|corner| pose.transform(&corner)) {
                low = [low[0].min(corner.x), low[1].min(corner.y)];
                high = [high[0].max(corner.x), high[1].max(corner.y)];
            }
            for row in cell(low[1])..=cell(high[1]) {
                for column in cell(low[0])..=cell(high[0]) {
                    let centre = [column, row].map(|index| (index as f64 + 0.5) * cell_m);
                    let centre = Point2::new(centre[0], centre[1]);
                    if polygon.contains(&pose.inverse_transform(&centre)) {
                        seen.insert((row, column));
                    }
                }
            }
        }
        areas.push(seen.len() as f64 * cell_m * cell_m);
    }
    areas
}
