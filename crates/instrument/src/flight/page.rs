//! The text page of a flight.

use super::FlightOptions;
use crate::Level;

/// What the recording is about, what is shown, how to step, and what the colours mean.
pub(super) fn about(options: &FlightOptions) -> String {
    let mut page = format!("# {}\n\n{}\n", options.name, options.about.trim());
    page.push_str(
        "\n## Step through it\n\n\
         Ctrl + Right and Ctrl + Left go one step on and back, Space plays. The time panel below \
         switches the timeline: `step`, `distance_mm` (flown), and `event`, which counts every event \
         of every algorithm in order. In a view of space: drag to turn it, scroll to zoom, \
         double-click to reset.\n",
    );
    page.push_str("\n## What is shown\n\n");
    for map in &options.maps {
        let belief = match FlightOptions::is_around_robot(map) {
            true => {
                "around the vertex where the robot hovers, which is all that this map claims: every \
                 view in scope is laid out along its shortest path through the pose graph, there is \
                 no global map"
            }
            false if options.has_truth => {
                "in the map's own global frame, laid onto the truth where the robot started"
            }
            false => "in the map's own global frame, which is that of the first image",
        };
        if !options.has_truth {
            page.push_str(&format!(
                "- **{map}**: the belief, {belief}. In tabs or below: the depth image; the last view's \
                 polyhedron; the pose graph. The red line at the last step leads to the nearest \
                 frontier.\n",
            ));
            continue;
        }
        page.push_str(&format!(
            "- **{map}**, left: the true place, the true path, the voxels first seen at this step; no \
             map and no policy ever sees this. Right: the belief, {belief}. In tabs: the depth image; \
             the last view's polyhedron; the pose graph by odometry alone over the true path, whose \
             distance is the drift.\n",
        ));
    }
    page.push_str(
        "\nWalls are drawn from their free side only, so that one looks into a place from outside.\n",
    );
    if options.level == Level::Full {
        page.push_str(
            "Each event stands in the log, in order: from the depth image to the polyhedron, the map, \
             and the plan. In the tab `tetrahedra and A*`, where a way is planned through tetrahedra: grey lines are these, thin blue ones the \
             dual graph, orange points its nodes on frontier; green lines lead to what A* closed so far; then \
             the corridor in pale grey, the way through its nodes in purple, the polyline of the cone programme \
             in red, and in bold green the path as it was verified. `driftlab mesh plan` steps one search node \
             by node.\n",
        );
    }
    page.push_str("\n## Colours\n\n| colour | means |\n|---|---|\n");
    let rows = [
        ("orange face", "frontier: nobody knows what lies behind"),
        ("grey face", "obstacle"),
        ("green points, left", "voxels first seen at this step"),
        ("pale points, left", "voxels that count, thinned"),
        ("orange points", "frontier to be looked at"),
        ("green to yellow points", "places to look from, from the best to the worst"),
        ("red point, red line", "where the robot goes to look; the way to it"),
        ("purple point", "frontier that is given up"),
        ("blue line", "path: true where it lies in the truth, odometry in the pose graph"),
        ("magenta line", "place edge of the pose graph"),
    ];
    for (colour, what) in rows {
        if !options.has_truth && (colour.contains("left") || what.contains("true")) {
            continue;
        }
        page.push_str(&format!("| {colour} | {what} |\n"));
    }
    page
}
