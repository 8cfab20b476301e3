//! The paper's first scans, which pin the maps, the starts, the sensor and the coverage rule.

use std::sync::Arc;

use metrics::{Coverage, CoverageParams, Witness};
use sensing::Robot;
use worlds::{RobotParams, SimRobot, World2d, paper};

fn first_scan_cells(world: World2d) -> (usize, usize) {
    let coverage =
        Coverage::new(&world, CoverageParams::default()).expect("the cell size is sound");
    let robot = SimRobot::new(Arc::new(world), RobotParams::default(), 1);
    let mut witness = Witness::new(robot, coverage);
    witness.scan();
    (witness.coverage().cells_seen(), witness.coverage().cells_reachable())
}

#[test]
fn first_scans_see_as_many_cells_as_in_the_paper() {
    assert_eq!(first_scan_cells(paper::open()), (38, 784));
    assert_eq!(first_scan_cells(paper::maze()), (22, 716));
    // The paper's start is lost here, and its first scan saw 30.
    assert_eq!(first_scan_cells(paper::forest_house()), (31, 770));
}
