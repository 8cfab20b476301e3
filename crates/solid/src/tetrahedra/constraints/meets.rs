//! Where a segment passes a triangle.

use crate::tetrahedra::mesh::Mesh;

/// How the open segment meets a closed triangle that is not in its plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meets {
    /// Not at all; also where they lie in one plane, or only an end of the segment touches it.
    Not,
    /// In the triangle's interior.
    Inside,
    /// On the edge between these two vertices.
    Edge(u32, u32),
    /// At this vertex.
    Vertex(u32),
}

/// How the open segment from `a` to `b` meets the triangle; exact.
pub(crate) fn meets(mesh: &Mesh, [a, b]: [u32; 2], [x, y, z]: [u32; 3]) -> Meets {
    if [x, y, z].contains(&a) || [x, y, z].contains(&b) {
        return Meets::Not;
    }
    let side_a = mesh.orient(x, y, z, a);
    if side_a == 0.0 {
        return Meets::Not;
    }
    let side_b = mesh.orient(x, y, z, b);
    if side_b == 0.0 || (side_a > 0.0) == (side_b > 0.0) {
        return Meets::Not;
    }
    let turn = if side_a < 0.0 { 1.0 } else { -1.0 };
    let xy = mesh.orient(a, b, x, y) * turn;
    if xy < 0.0 {
        return Meets::Not;
    }
    let yz = mesh.orient(a, b, y, z) * turn;
    if yz < 0.0 {
        return Meets::Not;
    }
    let zx = mesh.orient(a, b, z, x) * turn;
    if zx < 0.0 {
        return Meets::Not;
    }
    match (xy == 0.0, yz == 0.0, zx == 0.0) {
        (false, false, false) => Meets::Inside,
        (true, false, false) => Meets::Edge(x, y),
        (false, true, false) => Meets::Edge(y, z),
        (false, false, true) => Meets::Edge(z, x),
        (true, true, _) => Meets::Vertex(y),
        (_, true, true) => Meets::Vertex(z),
        (true, _, true) => Meets::Vertex(x),
    }
}
