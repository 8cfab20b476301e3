//! Where vertices are drawn: one frame, in which odometry never moves anything.

use maps2d::Standing;
use pose::Se2;
use posegraph::Scope;
use probe::{Id, VertexId};

/// Places of vertices in the belief frame.
///
/// The belief frame is the odometry frame, in which everything in scope is laid around the robot
/// along shortest paths. As long as those do not change, a volume keeps its place there while the
/// robot moves; so the rows of one step repeat those of the step before, which compresses well.
#[derive(Debug, Default)]
pub(super) struct Places {
    odometry: Vec<Se2>,
    /// Where vertices are since the last correction, for maps that have any.
    corrected: Vec<Se2>,
    /// The scope that placed a vertex last, and where.
    placed: Vec<(u32, Se2)>,
    round: u32,
}

impl Places {
    /// Learns the pose of a vertex by odometry alone.
    pub fn learn(&mut self, vertex: VertexId, odom_from_vertex: Se2) {
        if self.odometry.len() <= vertex.index() {
            self.odometry.resize(vertex.index() + 1, Se2::identity());
        }
        // A new vertex lies to the one before it as the wheels said, wherever that one is now.
        if let (Some(last), Some(before)) = (
            self.corrected.last().copied(),
            vertex.index().checked_sub(1).and_then(|i| self.odometry.get(i)).copied(),
        ) && self.corrected.len() == vertex.index()
        {
            self.corrected.push(last * before.inverse_mul(&odom_from_vertex));
        }
        self.odometry[vertex.index()] = odom_from_vertex;
    }

    /// Takes corrected poses.
    pub fn correct(&mut self, map_from_vertex: &[Se2]) {
        self.corrected.clear();
        self.corrected.extend_from_slice(map_from_vertex);
    }

    /// A vertex by odometry alone.
    pub fn by_odometry(&self, vertex: VertexId) -> Se2 {
        self.odometry.get(vertex.index()).copied().unwrap_or_default()
    }

    /// Lays a scope around its root.
    pub fn lay_out(&mut self, scope: &Scope) {
        let Some(root) = scope.root() else { return };
        let belief_from_root = self.by_odometry(root);
        self.round += 1;
        for row in scope.placed() {
            let index = row.vertex.index();
            if self.placed.len() <= index {
                self.placed.resize(index + 1, (0, Se2::identity()));
            }
            self.placed[index] = (self.round, belief_from_root * row.root_from_vertex);
        }
    }

    /// A vertex where the last scope laid it, else where it was corrected to, else by odometry.
    pub fn of(&self, vertex: VertexId) -> Se2 {
        match self.placed.get(vertex.index()) {
            Some((round, place)) if *round == self.round => *place,
            _ => self.corrected.get(vertex.index()).copied().unwrap_or(self.by_odometry(vertex)),
        }
    }

    /// The body where the robot stands.
    pub fn of_body(&self, standing: &Standing) -> Se2 {
        self.of(standing.vertex) * standing.vertex_from_body
    }
}
