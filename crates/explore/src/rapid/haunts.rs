//! Places where the robot has acted so often that others come first.

use pose::Se2;
use posegraph::PoseGraph;
use probe::{EdgeId, IdVec, VertexId};

/// Actions at one haunt before all other places come first.
const ACTIONS: u32 = 40;

/// Actions once no other place has frontier left, until what is left is given up. Every new haunt, which
/// is new ground, begins the count again: behind the last corner, tried for hundreds of actions, may
/// lie all of a maze.
const LAST_ACTIONS: u32 = 3_000;

/// The same for each haunt, where there are few: a body that gets out of nowhere need not try as long
/// as one that has all of a maze to itself.
const LAST_ACTIONS_EACH: u32 = 150;

/// The allowance is doubled so often at most, far more often than it can be reached.
const MOST_DOUBLINGS: u32 = 12;

/// The neighbourhoods that vertices lie in, and how often the robot has acted in each. None are founded,
/// and all places come now, where a map's frontier does not belong to vertices.
///
/// A squeeze between furniture can keep the robot busy for ever: every look leaves slivers that count,
/// and going for them yields the next look. Then places elsewhere, where there is ground to gain,
/// must not wait. A haunt is a vertex and those within a step of it *by the graph*, so there is
/// no global frame here either. Cost: the edges of a new vertex.
#[derive(Clone, Debug, Default)]
pub(crate) struct Haunts {
    /// By vertex: its haunt, and where it lies in the frame of the vertex that founded that.
    of: IdVec<VertexId, (usize, Se2)>,
    actions: Vec<u32>,
    /// How often every place got as much again.
    doubled: u32,
    /// Actions since then, or since a haunt was founded.
    last_actions: u32,
}

impl Haunts {
    /// Takes in a vertex with its edges: into the nearest haunt no farther away than `radius_m`, or a
    /// new one.
    pub fn found(&mut self, graph: &PoseGraph, vertex: VertexId, edges: &[EdgeId], radius_m: f64) {
        let near = edges.iter().filter_map(|edge| {
            let (neighbour, vertex_from_neighbour) = graph.edge(*edge).from_end(vertex);
            let (haunt, founder_from_neighbour) = *self.of.get(neighbour)?;
            Some((haunt, founder_from_neighbour * vertex_from_neighbour.inverse()))
        });
        let nearest = near
            .map(|(haunt, founder_from_vertex)| {
                (founder_from_vertex.translation.norm(), haunt, founder_from_vertex)
            })
            .filter(|(distance_m, ..)| *distance_m <= radius_m)
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let entry = nearest.map_or_else(
            || {
                self.actions.push(0);
                self.last_actions = 0;
                (self.actions.len() - 1, Se2::identity())
            },
            |(_, haunt, founder_from_vertex)| (haunt, founder_from_vertex),
        );
        self.of.push(entry);
    }

    /// Counts an action of the robot at a vertex.
    pub fn acted(&mut self, vertex: VertexId) {
        if let Some((haunt, _)) = self.of.get(vertex) {
            self.actions[*haunt] += 1;
        }
        self.last_actions += u32::from(self.doubled > 0);
    }

    /// Nothing comes of acting at a vertex: others come first now; false where they do already, or
    /// where its last turn is over.
    pub fn tire_of(&mut self, vertex: VertexId) -> bool {
        let (allowed, is_over) = (ACTIONS << self.doubled, self.is_over());
        let Some((haunt, _)) = self.of.get(vertex).filter(|_| !is_over) else { return false };
        let tires = self.actions[*haunt] < allowed;
        self.actions[*haunt] = self.actions[*haunt].max(allowed);
        tires
    }

    /// Whether other places come before this one.
    pub fn can_wait(&self, vertex: VertexId) -> bool {
        self.actions_at(vertex) >= ACTIONS << self.doubled
    }

    /// Whether what is left here is to be given up: it had its turn, and its turns after all others.
    pub fn is_spent(&self, vertex: VertexId) -> bool {
        self.is_over() && self.actions_at(vertex) >= ACTIONS
    }

    /// Whether the last turns of all places are over.
    fn is_over(&self) -> bool {
        let each = LAST_ACTIONS_EACH.saturating_mul(self.actions.len() as u32);
        self.last_actions >= each.min(LAST_ACTIONS)
    }

    fn actions_at(&self, vertex: VertexId) -> u32 {
        self.of.get(vertex).map_or(0, |(haunt, _)| self.actions[*haunt])
    }

    /// Nothing is left elsewhere: every place gets as much again; false where that is over.
    pub fn relent(&mut self) -> bool {
        let may = !self.actions.is_empty() && !self.is_over() && self.doubled < MOST_DOUBLINGS;
        self.doubled += u32::from(may);
        may
    }
}

#[cfg(test)]
mod tests {
    use posegraph::EdgeKind;

    use super::*;

    /// A chain of vertices this far apart, each haunted as the last one says.
    fn chain(count: usize, apart_m: f64, radius_m: f64) -> (PoseGraph, Haunts) {
        let (mut graph, mut haunts) = (PoseGraph::new(), Haunts::default());
        for i in 0..count {
            let vertex = graph.add_vertex();
            let edges: Vec<EdgeId> = (i > 0)
                .then(|| {
                    let step = Se2::new(apart_m, 0.0, 0.0);
                    graph
                        .add_edge(VertexId(i as u32 - 1), vertex, step, EdgeKind::Odometry)
                        .unwrap()
                })
                .into_iter()
                .collect();
            haunts.found(&graph, vertex, &edges, radius_m);
        }
        (graph, haunts)
    }

    fn act(haunts: &mut Haunts, vertex: u32, times: u32) {
        (0..times).for_each(|_| haunts.acted(VertexId(vertex)));
    }

    #[test]
    fn vertices_within_the_radius_of_the_first_share_a_haunt() {
        let (_, mut haunts) = chain(6, 0.4, 1.0);
        // 0, 0.4 and 0.8 m; then 1.2, 1.6 and 2.0 m.
        act(&mut haunts, 1, ACTIONS);
        let waiting: Vec<bool> = (0..6).map(|v| haunts.can_wait(VertexId(v))).collect();
        assert_eq!(waiting, [true, true, true, false, false, false]);
    }

    #[test]
    fn a_recognised_place_brings_a_vertex_into_its_haunt() {
        let (mut graph, mut haunts) = chain(4, 2.0, 1.0);
        let vertex = graph.add_vertex();
        let far = graph.add_edge(VertexId(3), vertex, Se2::new(2.0, 0.0, 0.0), EdgeKind::Odometry);
        let near = graph.add_edge(VertexId(0), vertex, Se2::new(0.5, 0.0, 1.0), EdgeKind::Place);
        haunts.found(&graph, vertex, &[far.unwrap(), near.unwrap()], 1.0);
        act(&mut haunts, vertex.0, ACTIONS);
        assert!(haunts.can_wait(VertexId(0)) && !haunts.can_wait(VertexId(3)));
    }

    #[test]
    fn every_place_gets_as_much_again_when_nothing_is_left_elsewhere_and_then_is_spent() {
        let (_, mut haunts) = chain(20, 2.0, 1.0);
        let here = VertexId(0);
        act(&mut haunts, 0, ACTIONS);
        assert!(haunts.can_wait(here) && haunts.relent() && !haunts.can_wait(here));
        let mut acted = 0;
        while !haunts.is_spent(here) {
            if haunts.can_wait(here) {
                assert!(haunts.relent());
            } else {
                haunts.acted(here);
                acted += 1;
            }
        }
        assert_eq!(acted, LAST_ACTIONS);
        assert!(!haunts.relent() && !haunts.is_spent(VertexId(1)));
    }

    #[test]
    fn where_there_are_few_haunts_the_last_turn_is_shorter() {
        let (_, mut haunts) = chain(2, 2.0, 1.0);
        act(&mut haunts, 0, ACTIONS);
        assert!(haunts.relent());
        act(&mut haunts, 0, 2 * LAST_ACTIONS_EACH - 1);
        assert!(!haunts.is_spent(VertexId(0)));
        act(&mut haunts, 0, 1);
        assert!(haunts.is_spent(VertexId(0)) && !haunts.relent());
    }

    #[test]
    fn new_ground_begins_the_count_again() {
        let (mut graph, mut haunts) = chain(1, 2.0, 1.0);
        assert!(haunts.relent());
        act(&mut haunts, 0, LAST_ACTIONS);
        assert!(haunts.is_spent(VertexId(0)));
        let vertex = graph.add_vertex();
        haunts.found(&graph, vertex, &[], 1.0);
        assert!(!haunts.is_spent(VertexId(0)) && haunts.relent());
    }
}
