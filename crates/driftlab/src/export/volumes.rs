//! The labelled edges of volumes, for drawing.

use formats::log::EdgeLabel;
use geometry::Point2;
use maps2d::relative::VolumeState;
use maps2d::volume::LocalVolume;

/// A drawn edge: both ends in the frame of the volume, metres, and what it is.
pub type LabelledEdge = ([[f64; 2]; 2], EdgeLabel);

fn edge(from: Point2, to: Point2, label: EdgeLabel) -> LabelledEdge {
    ([[from.x, from.y], [to.x, to.y]], label)
}

/// The edges of a view as it was taken: obstacle or frontier.
pub fn edges_of_view(volume: &LocalVolume) -> Vec<LabelledEdge> {
    let obstacles = volume.obstacles.iter().map(|of| edge(of.from, of.to, EdgeLabel::Obstacle));
    let frontier = volume.frontier.iter().map(|of| edge(of.from, of.to, EdgeLabel::Frontier));
    obstacles.chain(frontier).collect()
}

/// The edges of a volume as they are now: parts of its frontier may be free.
pub fn edges_of_volume(state: &VolumeState) -> Vec<LabelledEdge> {
    let obstacles = state.volume.obstacles.iter();
    let mut edges: Vec<LabelledEdge> =
        obstacles.map(|of| edge(of.from, of.to, EdgeLabel::Obstacle)).collect();
    for (of, ledger) in state.volume.frontier.iter().zip(&state.ledgers) {
        let open = ledger.open().map(|span| (span, EdgeLabel::Frontier));
        let closed = ledger.closed().iter().map(|closed| (closed.span, EdgeLabel::Free));
        edges.extend(
            open.chain(closed).map(|(span, label)| edge(of.at(span.from), of.at(span.to), label)),
        );
    }
    edges
}
