//! The cone programme: the shortest polyline whose knots keep to their places.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT, SolverStatus,
    SupportedConeT,
};
use solid::{Point3, Vector3};

/// The solver ends when the length is known to this share, or to so many metres.
const GAP: f64 = 1e-5;

/// What holds of a point: `normal . point <= limit`, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfSpace {
    pub normal: Vector3,
    pub limit: f64,
}

/// Where a knot may be: in a plane or in space, within half-spaces.
#[derive(Clone, Debug)]
pub(super) struct Room {
    /// A point of the plane or of the part of space.
    pub origin: Point3,
    /// Two directions in the plane, or three.
    pub basis: Vec<Vector3>,
    pub limits: Vec<HalfSpace>,
}

/// The shortest polyline from `from` through the rooms to `to`; a point for each room.
///
/// `apart` are half-spaces for both ends of a segment, by the number of the segment: segment i ends in
/// room i. `None` where the solver gives up: the rooms are then taken to have no polyline.
///
/// One variable for each direction of a room, and one for the length of each segment, whose sum is the
/// least; each segment is a second-order cone of dimension 4.
pub(super) fn shortest(
    from: &Point3,
    to: &Point3,
    rooms: &[Room],
    apart: &[(usize, HalfSpace)],
) -> Option<Vec<Point3>> {
    let mut firsts = Vec::with_capacity(rooms.len());
    let mut columns = 0;
    for room in rooms {
        firsts.push(columns);
        columns += room.basis.len();
    }
    let lengths = columns;
    let variables = lengths + rooms.len() + 1;
    let mut rows = Rows { entries: vec![Vec::new(); variables], right: Vec::new() };
    for (room, &first) in rooms.iter().zip(&firsts) {
        for limit in &room.limits {
            rows.half_space(room, first, limit);
        }
    }
    for (segment, limit) in apart {
        for end in [segment.checked_sub(1), Some(*segment)].into_iter().flatten() {
            if let Some(room) = rooms.get(end) {
                rows.half_space(room, firsts[end], limit);
            }
        }
    }
    let flat = rows.right.len();
    let mut cones: Vec<SupportedConeT<f64>> = Vec::with_capacity(rooms.len() + 2);
    if flat > 0 {
        cones.push(NonnegativeConeT(flat));
    }
    for segment in 0..=rooms.len() {
        rows.add(lengths + segment, -1.0);
        rows.end(0.0);
        let (a, b) = (segment.checked_sub(1), Some(segment).filter(|&b| b < rooms.len()));
        let base = |end: Option<usize>, else_at: &Point3| end.map_or(*else_at, |i| rooms[i].origin);
        let difference = base(b, to) - base(a, from);
        for axis in 0..3 {
            for (end, sign) in [(a, 1.0), (b, -1.0)] {
                let Some(i) = end else { continue };
                for (j, direction) in rooms[i].basis.iter().enumerate() {
                    rows.add(firsts[i] + j, sign * direction[axis]);
                }
            }
            rows.end(difference[axis]);
        }
        cones.push(SecondOrderConeT(4));
    }
    let (matrix, right) = rows.matrix();
    let mut costs = vec![0.0; variables];
    costs[lengths..].fill(1.0);
    let settings = DefaultSettings::<f64> {
        verbose: false,
        max_iter: 60,
        max_threads: 1,
        presolve_enable: false,
        tol_gap_abs: GAP,
        tol_gap_rel: GAP,
        ..DefaultSettings::default()
    };
    let none = CscMatrix::zeros((variables, variables));
    let mut solver = DefaultSolver::new(&none, &costs, &matrix, &right, &cones, settings).ok()?;
    solver.solve();
    let good = matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
    if !good {
        return None;
    }
    let x = &solver.solution.x;
    let points = rooms.iter().zip(&firsts).map(|(room, &first)| {
        let moved = room.basis.iter().zip(&x[first..]).map(|(direction, share)| direction * *share);
        room.origin + moved.sum::<Vector3>()
    });
    Some(points.collect())
}

/// The constraints row by row, kept column by column.
struct Rows {
    entries: Vec<Vec<(usize, f64)>>,
    right: Vec<f64>,
}

impl Rows {
    fn add(&mut self, column: usize, value: f64) {
        if value != 0.0 {
            self.entries[column].push((self.right.len(), value));
        }
    }

    fn end(&mut self, right: f64) {
        self.right.push(right);
    }

    fn half_space(&mut self, room: &Room, first: usize, limit: &HalfSpace) {
        for (j, direction) in room.basis.iter().enumerate() {
            self.add(first + j, limit.normal.dot(direction));
        }
        self.end(limit.limit - limit.normal.dot(&room.origin.coords));
    }

    fn matrix(self) -> (CscMatrix<f64>, Vec<f64>) {
        let columns = self.entries.len();
        let mut starts = Vec::with_capacity(columns + 1);
        let (mut places, mut values) = (Vec::new(), Vec::new());
        starts.push(0);
        for column in self.entries {
            // Rows were ended in order, so each column ascends.
            for (row, value) in column {
                places.push(row);
                values.push(value);
            }
            starts.push(places.len());
        }
        (CscMatrix::new(self.right.len(), columns, starts, places, values), self.right)
    }
}
