//! The 2-3 flip: a face goes, an edge comes.

use super::goal::Goal;
use super::ring::is_flatter;
use super::state::Work;

impl Work {
    /// Removes the face opposite corner `f` of tetrahedron `t` by joining the two apexes, where the
    /// two tetrahedra are strictly convex together and the goal comes nearer by at least `gain`.
    /// Returns by how much less is in the way. No tetrahedron flatter than `flattest` is made.
    pub(crate) fn flip_face(
        &mut self,
        t: u32,
        f: usize,
        goal: Goal,
        gain: i32,
        flattest: f64,
    ) -> Option<i32> {
        let tet = *self.mesh.tet(t);
        let other = tet.n[f] >> 2;
        let far = *self.mesh.tet(other);
        if tet.is_ghost() || far.is_ghost() {
            return None;
        }
        let [x, y, z] = tet.face(f);
        if self.must.holds_face(x, y, z) {
            return None;
        }
        let u = tet.v[f];
        let v = far.v[(tet.n[f] & 3) as usize];
        let mesh = &self.mesh;
        // u sees x, y, z counter-clockwise, and so v clockwise.
        let new = [[x, y, v, u], [y, z, v, u], [z, x, v, u]];
        for tet in new {
            let [a, b, c, d] = tet;
            let volume = mesh.orient(a, b, c, d);
            if volume <= 0.0 || is_flatter(mesh, volume, tet, flattest) {
                return None;
            }
        }
        let known = &mut self.known;
        let before = known.of_face(mesh, goal, [x, y, z]);
        if before < gain {
            return None;
        }
        let after = known.of_edge(mesh, goal, u, v)
            + [x, y, z].into_iter().map(|w| known.of_face(mesh, goal, [u, v, w])).sum::<i32>();
        if before - after < gain {
            return None;
        }
        self.exchange(&[t, other], &new).then_some(before - after)
    }
}
