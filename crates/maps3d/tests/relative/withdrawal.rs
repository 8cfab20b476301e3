//! A withdrawn place edge opens what relied on it, and nothing else.

use maps3d::Map3d;
use maps3d::relative::{OpenPart, RelativeParams};
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
