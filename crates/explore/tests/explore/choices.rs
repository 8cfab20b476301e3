//! Which frontier in view is chosen, and how the robot drives up to it.

use explore::{Ending, GiveUp, RapidParams};
use geometry::{Point2, Vector2};
use maps2d::Route;
use probe::VertexId;
use proptest::prelude::*;

use super::heard::Told;
use super::sketch::{Command, Sketch, Spot, play};

fn heading_of(from: Point2, to: Point2) -> f64 {
    (to - from).y.atan2((to - from).x)
}

proptest! {
    #[test]
    fn the_least_change_of_heading_is_chosen(
        bearings_rad in prop::collection::vec(-3.1..3.1_f64, 1..6),
    ) {
        let least_rad = bearings_rad.iter().copied().min_by(|a, b| a.abs().total_cmp(&b.abs()));
        let least_rad = least_rad.expect("there is at least one");
        prop_assume!(least_rad.abs() > 0.02);
        let others = bearings_rad.iter().filter(|other| **other != least_rad);
        for other in others {
            prop_assume!(other.abs() > least_rad.abs() + 1e-6);
        }
        let spots = bearings_rad.iter().map(|&bearing_rad| Spot::towards(bearing_rad, 3.0));
        let played = play(Sketch::new(spots.collect()), RapidParams::default());

        // A scan founds the first vertex; then the robot turns and looks before it drives.
        let [Command::Scan, Command::Turn(turned_rad), Command::Scan, Command::Forward(_), ..] =
            played.robot.commands[..]
        else {
            panic!("{:?}", played.robot.commands)
        };
        prop_assert!((turned_rad - least_rad).abs() < 1e-9);
        prop_assert_eq!(played.ending, Some(Ending::Complete));
        prop_assert_eq!(played.heard.given_up(), vec![]);
    }
}

#[test]
fn a_wider_way_comes_before_a_lesser_change_of_heading() {
    let mut map = Sketch::new(vec![Spot::towards(0.2, 3.0), Spot::towards(-1.0, 3.0)]);
    map.clearance = |from, to| if heading_of(from, to) > 0.0 { 0.2 } else { 0.5 };
    let played = play(map, RapidParams::default());
    let Command::Turn(turned_rad) = played.robot.commands[1] else { panic!("a turn comes first") };
    assert!((turned_rad + 1.0).abs() < 1e-9, "{turned_rad}");
}

#[test]
fn a_goal_ahead_is_driven_to_in_steps_without_a_turn() {
    let played = play(Sketch::new(vec![Spot::new(2.5, 0.0)]), RapidParams::default());
    let expected = [
        Command::Scan,
        Command::Forward(1.0),
        Command::Scan,
        Command::Forward(1.0),
        Command::Scan,
        Command::Forward(0.5),
        Command::Scan,
    ];
    assert_eq!(played.robot.commands, expected);
    assert_eq!(played.ending, Some(Ending::Complete));
    assert_eq!(played.explorer.graph().vertex_count(), 4);
}

#[test]
fn a_narrow_way_is_driven_in_shorter_steps() {
    for (clearance, step_m) in [(0.3, 1.0), (0.2, 0.5), (0.05, 0.25)] {
        let mut map = Sketch::new(vec![Spot::new(1.0, 0.0)]);
        map.clearance = match clearance {
            0.3 => |_, _| 0.3,
            0.2 => |_, _| 0.2,
            _ => |_, _| 0.05,
        };
        let forwards = play(map, RapidParams::default()).robot.forwards();
        assert_eq!(forwards, vec![step_m; (1.0 / step_m) as usize], "clearance {clearance}");
    }
}

/// A frontier round a corner: the straight way is blocked, a point before the frontier is not.
fn round_a_corner() -> Sketch {
    let spot = Spot { normal: Vector2::new(0.0, 1.0), closes_within_m: 1.2, ..Spot::new(3.0, 2.0) };
    let mut map = Sketch::new(vec![spot]);
    map.clearance = |from, to| if from.x < 2.5 && heading_of(from, to) > 0.5 { 0.0 } else { 1.0 };
    map
}

#[test]
fn the_normal_point_is_used_where_the_straight_way_is_blocked() {
    let played = play(round_a_corner(), RapidParams::default());
    let Told::Chose(goal) = played.heard.told[0] else { panic!("{:?}", played.heard.told) };
    assert!((goal - Point2::new(3.0, 1.0)).norm() < 1e-9, "1 m before the frontier: {goal}");
    assert_eq!(played.ending, Some(Ending::Complete));
    assert_eq!(played.heard.given_up(), [], "it was looked at, not given up");
    // To the normal point in steps, and after a look from there up to the frontier.
    let driven_m: f64 = played.robot.forwards().iter().sum();
    assert!((driven_m - (10f64.sqrt() + 1.0)).abs() < 1e-6, "{driven_m}");
}

#[test]
fn a_detour_is_used_where_the_normal_point_is_blocked_too() {
    let mut map = round_a_corner();
    // Even the normal point is out of reach now; a point to the right of it is not.
    map.clearance = |from, to| if from.x < 2.5 && heading_of(from, to) > 0.2 { 0.0 } else { 1.0 };
    map.detour = Some(Point2::new(3.0, 0.5));
    let played = play(map, RapidParams::default());
    let Told::Chose(goal) = played.heard.told[0] else { panic!("{:?}", played.heard.told) };
    assert!((goal - Point2::new(3.0, 0.5)).norm() < 1e-9, "{goal}");
    assert_eq!(played.ending, Some(Ending::Complete));
    assert_eq!(played.heard.given_up(), [], "it was looked at, not given up");
}

#[test]
fn without_the_normal_point_the_same_frontier_is_given_up() {
    let params = RapidParams { normal_point_m: Vec::new(), ..RapidParams::default() };
    let played = play(round_a_corner(), params);
    assert_eq!(played.heard.given_up(), [GiveUp::Blocked]);
    assert_eq!(played.robot.forwards(), Vec::<f64>::new());
    assert_eq!(played.ending, Some(Ending::Complete));
}

#[test]
fn a_frontier_behind_walls_is_given_up_without_a_move() {
    let mut map = Sketch::new(vec![Spot::new(2.0, 0.0), Spot::new(0.0, 2.0)]);
    map.clearance = |_, _| 0.01;
    let played = play(map, RapidParams::default());
    assert_eq!(played.heard.given_up(), [GiveUp::Blocked; 2]);
    assert_eq!(played.robot.commands, [Command::Scan]);
    assert_eq!(played.ending, Some(Ending::Complete));
}

#[test]
fn a_frontier_that_looking_does_not_close_is_given_up_on_arrival() {
    let stubborn = Spot { closes_within_m: 0.0, ..Spot::new(2.5, 0.0) };
    let played = play(Sketch::new(vec![stubborn]), RapidParams::default());
    assert_eq!(played.robot.forwards(), [1.0, 1.0, 0.5]);
    assert_eq!(played.heard.given_up(), [GiveUp::NothingNew]);
    assert_eq!(played.ending, Some(Ending::Complete));
}

#[test]
fn a_frontier_that_stays_ahead_is_not_chased_for_ever() {
    let receding = Spot { recedes_m: 0.45, closes_within_m: 0.0, ..Spot::new(0.4, 0.0) };
    let played = play(Sketch::new(vec![receding]), RapidParams::default());
    assert_eq!(played.heard.given_up(), [GiveUp::NothingNew]);
    // Twice the distance in the shortest steps, and four more.
    assert_eq!(played.robot.forwards().len(), 4 + 7);
    assert_eq!(played.ending, Some(Ending::Complete));
}

/// A frontier that is always where the robot is not.
fn fleeing() -> Sketch {
    let spot = Spot { changes_sides: true, closes_within_m: 0.0, ..Spot::new(3.0, 0.0) };
    Sketch::new(vec![spot])
}

#[test]
fn going_to_and_fro_ends_though_the_sum_of_what_is_left_has_other_bits_each_time() {
    let played = play(fleeing(), RapidParams::default());
    assert_eq!(played.heard.given_up(), [GiveUp::NothingNew]);
    assert_eq!(played.ending, Some(Ending::Complete));
}

#[test]
fn a_cycle_that_leaves_more_behind_each_time_ends() {
    let mut map = fleeing();
    map.out_of_view_m = |scans| f64::from(scans / 5);
    let played = play(map, RapidParams::default());
    assert_eq!(played.heard.given_up(), [GiveUp::NothingNew]);
    assert_eq!(played.ending, Some(Ending::Complete));
}

#[test]
fn a_place_that_is_never_done_does_not_keep_the_robot_from_others() {
    let elsewhere = VertexId(0);
    let mut map = fleeing();
    map.out_of_view_m = f64::from;
    map.routes = [Route::Repeat(vec![(elsewhere, 1.0)])].into();
    let played = play(map, RapidParams::default());
    let left = played.robot.commands.iter().position(|c| *c == Command::Repeat(elsewhere));
    assert!(left.is_some_and(|at| at < 200), "{left:?}");
    assert_eq!(played.ending, Some(Ending::Complete));
}

#[test]
fn a_map_without_frontier_by_vertex_is_never_left_while_a_goal_is_in_view() {
    let mut map = fleeing();
    map.by_vertex = false;
    map.out_of_view_m = f64::from;
    map.routes = [Route::Repeat(vec![(VertexId(0), 1.0)])].into();
    let played = play(map, RapidParams::default());
    let given_up = played.heard.given_up();
    assert_eq!(given_up.first(), Some(&GiveUp::NothingNew));
    let repeats = played.robot.commands.iter().position(|c| matches!(c, Command::Repeat(_)));
    assert!(repeats.is_none_or(|at| at > 400), "{repeats:?}");
}
