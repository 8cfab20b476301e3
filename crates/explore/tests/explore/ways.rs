//! Nothing in view: along the graph to frontier elsewhere, or the end.

use explore::{Ending, GiveUp, RapidParams};
use geometry::Point2;
use maps2d::Route;
use probe::VertexId;

use super::sketch::{Command, Played, Sketch, Spot, play};

const A: VertexId = VertexId(7);
const B: VertexId = VertexId(8);

fn out_of_view(routes: impl IntoIterator<Item = Route>) -> Sketch {
    let mut map = Sketch::new(vec![Spot::new(5.0, 0.0)]);
    map.in_view = false;
    map.routes = routes.into_iter().collect();
    map
}

fn two_legs(teleport: bool) -> Played {
    let route = Route::Repeat(vec![(A, 2.0), (B, 3.0)]);
    play(out_of_view([route]), RapidParams { teleport, ..RapidParams::default() })
}

#[test]
fn a_way_is_repeated_leg_by_leg_with_a_scan_at_each_end() {
    let played = two_legs(false);
    let expected =
        [Command::Scan, Command::Repeat(A), Command::Scan, Command::Repeat(B), Command::Scan];
    assert_eq!(played.robot.commands, expected);
    assert_eq!(played.ending, Some(Ending::Complete), "the map knows no further way");
    assert_eq!(played.explorer.steps(), 4, "the start, two legs, the end");
    assert_eq!(played.explorer.backtracking_share(), 1.0);
}

#[test]
fn teleporting_scans_at_the_end_only_and_is_charged_in_full() {
    let played = two_legs(true);
    let expected = [Command::Scan, Command::Repeat(A), Command::Repeat(B), Command::Scan];
    assert_eq!(played.robot.commands, expected);
    assert_eq!(played.explorer.steps(), 3, "the start, the jump, the end");
    assert_eq!(played.explorer.backtracking_share(), 1.0);
    assert_eq!(played.ending, Some(Ending::Complete));
}

#[test]
fn a_map_that_sends_the_robot_to_where_it_stands_ends_the_run_as_stuck() {
    let played = play(out_of_view([Route::Repeat(Vec::new())]), RapidParams::default());
    assert_eq!(played.ending, Some(Ending::Stuck));
    assert_eq!(played.robot.commands, [Command::Scan]);
}

#[test]
fn a_way_of_straight_legs_is_driven_to_its_farthest_clear_point() {
    let way = vec![Point2::new(1.0, 0.0), Point2::new(2.0, 0.0), Point2::new(2.0, 3.0)];
    let mut map = out_of_view([Route::Drive(way)]);
    // The last leg cannot be cut short.
    map.clearance = |_, to| if to.y > 0.1 { 0.0 } else { 1.0 };
    let played = play(map, RapidParams::default());
    let expected = [Command::Scan, Command::Turn(0.0), Command::Forward(1.0), Command::Scan];
    assert_eq!(played.robot.commands, expected);
    assert_eq!(played.ending, Some(Ending::Complete));
}

#[test]
fn a_way_that_nothing_clears_is_looked_at_and_its_end_is_given_up() {
    let params = RapidParams { turns_at_a_place: 2, ..RapidParams::default() };
    let way = || Route::Drive(vec![Point2::new(0.0, 1.0), Point2::new(5.0, 0.0)]);
    let mut map = out_of_view((0..3).map(|_| way()));
    map.clearance = |_, _| 0.0;
    let played = play(map, params);
    assert_eq!(played.heard.given_up(), [GiveUp::Blocked]);
    assert_eq!(played.robot.forwards(), Vec::<f64>::new());
    let turns = played.robot.commands.iter().filter(|c| matches!(c, Command::Turn(_))).count();
    assert_eq!(turns, 2, "as often as may be looked from one place");
    assert_eq!(played.ending, Some(Ending::Complete));
}
