//! A withdrawn place edge opens what relied on it, and nothing else.

use maps3d::relative::{OpenPart, RelativeParams};
use maps3d::{Hovering, Map3d};
use pose::Se3;
use posegraph::EdgeKind;
use probe::{Off, VertexId};

use super::scene::{Fed, bare, reduced_to, room_image, vertex_from_camera};

/// Where the views of a walk are: two legs that lead away from each other and meet again.
fn places() -> Vec<Se3> {
    let at = |x: f64, y: f64, yaw: f64| {
        let turn = vertex_from_camera(yaw) * vertex_from_camera(0.0).inverse();
        Se3::new(nalgebra::Vector3::new(x, y, 0.0), turn.rotation)
    };
    vec![
        at(-3.0, -2.0, 0.0),
        at(-3.0, 0.0, 0.5),
        at(-1.0, 1.5, -0.6),
        at(0.5, -1.0, 2.8),
        at(2.5, 2.0, 3.6),
    ]
}

/// The map of the walk; with the place edge from the first to the last, or without.
fn walked(params: &RelativeParams, with_place: bool) -> (Fed, Option<probe::EdgeId>) {
    let mut fed = Fed::new(params.clone());
    let places = places();
    let mut place = None;
    for (i, world_from_vertex) in places.iter().enumerate() {
        let vertex = fed.vertex();
        if let Some(before) = i.checked_sub(1) {
            let before_from = places[before].inverse_mul(world_from_vertex);
            fed.edge(VertexId(before as u32), vertex, before_from, EdgeKind::Odometry);
        }
        if with_place && i + 1 == places.len() {
            let first_from = places[0].inverse_mul(world_from_vertex);
            place = Some(fed.edge(VertexId(0), vertex, first_from, EdgeKind::Place));
        }
        let camera = vertex_from_camera(0.0);
        fed.look(vertex, camera, &room_image(&(*world_from_vertex * camera)));
    }
    (fed, place)
}

fn areas(fed: &Fed) -> Vec<Vec<i64>> {
    let of = |open: &[OpenPart]| open.iter().map(OpenPart::twice_area).collect();
    fed.map.views().iter().map(|state| of(&state.open)).collect()
}

#[test]
fn a_withdrawn_edge_opens_what_relied_on_it() {
    // Short ways only: without the place edge the last view is out of scope of the first.
    let params = RelativeParams { consolidation_radius_m: 7.0, ..bare(120) };
    let (without, _) = walked(&params, false);
    let (mut with, place) = walked(&params, true);
    let place = place.expect("an edge");
    assert!(!with.map.book().relying_on(place).is_empty());
    let before = areas(&with);
    with.graph.withdraw(place).expect("a place edge");
    with.map.edge_withdrawn(&with.graph, place, &mut Off);
    let after = areas(&with);
    assert_ne!(before, after);
    // Rounding on the grid depends on the order of what is taken away: by steps, not by areas.
    for (face, (now, never)) in
        after.iter().flatten().zip(areas(&without).iter().flatten()).enumerate()
    {
        let off = (now - never).abs() as f64 / maps3d::relative::TWICE_AREA as f64;
        assert!(off < 1e-4, "face {face}: {now} {never}");
    }
    for state in with.map.views() {
        for (_, id) in &state.closings {
            let path = with.map.book().closing(*id).path;
            assert!(!with.map.book().edges(path).contains(&place));
        }
    }
}

#[test]
fn paths_lead_from_who_is_closed_to_who_closes() {
    let params = RelativeParams { view: reduced_to(120), ..RelativeParams::default() };
    let (fed, _) = walked(&params, true);
    let mut walked = 0;
    for (view, state) in fed.map.views().iter().enumerate() {
        for (face, id) in &state.closings {
            assert!(usize::from(*face) < state.open.len());
            let closing = fed.map.book().closing(*id);
            assert_eq!(closing.view as usize, view);
            let mut at = state.vertex;
            for edge in fed.map.book().edges(closing.path) {
                at = fed.graph.edge(*edge).from_end(at).0;
                walked += 1;
            }
            assert_eq!(at, fed.map.views()[closing.by as usize].vertex);
        }
    }
    assert!(walked > 20);
}

#[test]
fn what_was_given_up_over_a_withdrawn_edge_is_told_along_other_ways_or_forgotten() {
    for (radius_m, is_reached) in [(7.0, false), (30.0, true)] {
        let params = RelativeParams { consolidation_radius_m: radius_m, ..bare(120) };
        let (mut fed, place) = walked(&params, true);
        let place = place.expect("an edge");
        let here = Hovering { vertex: VertexId(0), vertex_from_body: Se3::identity() };
        // All about the last view.
        let there = places()[0].inverse_mul(&places()[4]).translation;
        fed.map.give_up(&here, &[there.into()], 20.0, true, &mut Off);
        let balls = |fed: &Fed, view: usize| fed.map.views()[view].given_up.clone();
        let (own, last) = (balls(&fed, 0), balls(&fed, 4));
        assert!(own.len() == 1 && own[0].over.is_none());
        let (path, number) = last[0].over.expect("it was told");
        assert!(fed.map.book().edges(path) == [place] && number == 0);
        assert!(fed.map.frontier_at(VertexId(4)) == 0.0);
        fed.graph.withdraw(place).expect("a place edge");
        fed.map.edge_withdrawn(&fed.graph, place, &mut Off);
        assert_eq!(balls(&fed, 0), own);
        let now = balls(&fed, 4);
        assert_eq!(now.len(), usize::from(is_reached));
        assert_eq!(fed.map.frontier_at(VertexId(4)) == 0.0, is_reached);
        for ball in now {
            let (path, number) = ball.over.expect("it was told");
            assert!(number == 0 && fed.map.book().edges(path).len() == 4);
            assert!((ball.place_in_camera - last[0].place_in_camera).norm() < 1e-9);
        }
    }
}
