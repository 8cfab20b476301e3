//! Step 1: free space as tetrahedra that know their neighbours.

use std::collections::BTreeMap;

use solid::bvh::{Aabb, Bvh};
use solid::predicates::{in_envelope, orient3};
use solid::{Label, Point3, Tetrahedra, Vector3};

use super::obstacles::Obstacles;
use crate::Maps3dError;

/// A way out of a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exit {
    /// Through the face that two tetrahedra share: its corners.
    Face([u32; 3]),
    /// From one volume into another that overlaps it: a point that lies in both tetrahedra.
    Overlap(Point3),
}

/// A face that nobody has looked behind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontierFace {
    /// Its volume.
    pub volume: u32,
    /// The face of the volume's polyhedron.
    pub face: u32,
    /// Its corners, counter-clockwise from outside.
    pub corners: [u32; 3],
    /// The tetrahedron inside that has it.
    pub tetrahedron: u32,
}

/// The tetrahedra of one or several volumes in one frame, with what joins them.
///
/// What holds: tetrahedra that share a face know each other, unless the face is obstacle; both sides
/// agree on it. Tetrahedra of different volumes are joined where the middle of one lies in the other.
#[derive(Clone, Debug)]
pub struct Space {
    vertices: Vec<Point3>,
    tetrahedra: Vec<[u32; 4]>,
    /// Where the exits of each tetrahedron start; one more entry than tetrahedra.
    starts: Vec<u32>,
    exits: Vec<(u32, Exit)>,
    frontier: Vec<FrontierFace>,
    obstacles: Obstacles,
    tree: Bvh,
    /// Tetrahedra that another point than their middle stands for, ascending.
    stands: Vec<(u32, Point3)>,
}

/// Volumes that are fans, each around its lens: what is known of them beside their tetrahedra.
pub(crate) struct FansKnown<'a> {
    /// The corner that all tetrahedra of a volume have in common, by volume.
    pub lenses: &'a [Point3],
    /// The tetrahedron of a volume that holds a point, to rounding, if one does.
    pub find: &'a dyn Fn(usize, &Point3) -> Option<u32>,
    /// Points that stand for the tetrahedra that they lie in.
    pub ends: &'a [Point3],
}

impl Space {
    /// The space inside of some volumes, whose points are in one frame. O(n log n).
    ///
    /// Frontier faces whose middle lies inside another volume are not frontier any more, and not in the
    /// way either. Neighbours that do not share a face are not believed.
    ///
    /// # Errors
    /// [`Maps3dError::Tetrahedra`] names what of a volume points at nothing, or is not a number.
    pub fn new(volumes: &[&Tetrahedra]) -> Result<Self, Maps3dError> {
        Self::joined(volumes, None)
    }

    /// The same of fans. All tetrahedra of one meet at its lens: one of them, which the lens stands for, is joined to
    /// all others there. What lies in a fan is found by its direction.
    pub(crate) fn of_fans(
        volumes: &[&Tetrahedra],
        known: &FansKnown<'_>,
    ) -> Result<Self, Maps3dError> {
        Self::joined(volumes, Some(known))
    }

    fn joined(volumes: &[&Tetrahedra], fans: Option<&FansKnown<'_>>) -> Result<Self, Maps3dError> {
        let mut space = Self {
            vertices: Vec::new(),
            tetrahedra: Vec::new(),
            starts: Vec::new(),
            exits: Vec::new(),
            frontier: Vec::new(),
            obstacles: Obstacles::default(),
            tree: Bvh::default(),
            stands: Vec::new(),
        };
        let mut exits: Vec<(u32, u32, Exit)> = Vec::new();
        let mut walls = Vec::new();
        let mut firsts = Vec::new();
        for (volume, one) in volumes.iter().enumerate() {
            check(volume, one)?;
            let (first_vertex, first) =
                (space.vertices.len() as u32, space.tetrahedra.len() as u32);
            firsts.push(first);
            space.vertices.extend(&one.vertices);
            space.tetrahedra.extend(one.tetrahedra.iter().map(|tet| tet.map(|v| v + first_vertex)));
            let mut shut = Vec::new();
            for face in &one.boundary {
                let corners = face.corners.map(|v| v + first_vertex);
                match (face.label, face.tetrahedra) {
                    (Label::Obstacle, sides) => {
                        walls.push(corners.map(|v| space.vertices[v as usize]));
                        if let [Some(a), Some(b)] = sides {
                            shut.push((a.min(b), a.max(b)));
                        }
                    }
                    (Label::Frontier, [Some(inside), None] | [None, Some(inside)]) => {
                        let (volume, tetrahedron) = (volume as u32, inside + first);
                        let frontier =
                            FrontierFace { volume, face: face.face, corners, tetrahedron };
                        space.frontier.push(frontier);
                    }
                    (Label::Frontier, _) => {}
                }
            }
            shut.sort_unstable();
            for (t, neighbours) in one.neighbours.iter().enumerate() {
                for (i, &neighbour) in neighbours.iter().enumerate() {
                    let Some(u) = neighbour else { continue };
                    let t = t as u32;
                    if shut.binary_search(&(t.min(u), t.max(u))).is_ok() {
                        continue;
                    }
                    if let Some(corners) = shared(one, t, i, u) {
                        let corners = corners.map(|v| v + first_vertex);
                        exits.push((t + first, u + first, Exit::Face(corners)));
                    }
                }
            }
        }
        space.obstacles = Obstacles::new(walls);
        let boxes: Vec<Aabb> =
            (0..space.len() as u32).map(|t| Aabb::around(space.corners(t))).collect();
        space.tree = Bvh::new(&boxes);
        firsts.push(space.len() as u32);
        if let Some(fans) = fans {
            space.stand_for(fans, &firsts, &mut exits);
            space.join_fans(fans, &firsts, &mut exits);
        } else if volumes.len() > 1 {
            space.join(&firsts, &mut exits);
        }
        exits.sort_by_key(|&(from, to, _)| (from, to));
        exits.dedup_by_key(|exit| (exit.0, exit.1));
        space.starts = vec![0; space.len() + 1];
        for &(from, ..) in &exits {
            space.starts[from as usize + 1] += 1;
        }
        for t in 0..space.len() {
            space.starts[t + 1] += space.starts[t];
        }
        space.exits = exits.into_iter().map(|(_, to, exit)| (to, exit)).collect();
        Ok(space)
    }

    /// Ends stand for the tetrahedra that they are in, and lenses for one of their fan each, joined to all others.
    fn stand_for(
        &mut self,
        fans: &FansKnown<'_>,
        firsts: &[u32],
        exits: &mut Vec<(u32, u32, Exit)>,
    ) {
        let mut stands: BTreeMap<u32, Point3> = BTreeMap::new();
        for end in fans.ends {
            if let Some(t) = self.locate(end) {
                stands.entry(t).or_insert(*end);
            }
        }
        for (volume, lens) in firsts.windows(2).zip(fans.lenses) {
            let mut all = (volume[0]..volume[1]).filter(|&t| self.holds(t, lens));
            let Some(hub) = all.clone().find(|t| !stands.contains_key(t)).or_else(|| all.next())
            else {
                continue;
            };
            stands.entry(hub).or_insert(*lens);
            let exit = Exit::Overlap(*lens);
            for t in (volume[0]..volume[1]).filter(|&t| t != hub && self.holds(t, lens)) {
                exits.extend([(t, hub, exit), (hub, t, exit)]);
            }
        }
        self.stands = stands.into_iter().collect();
    }

    /// Joins tetrahedra of different fans, each where its point lies in another.
    fn join_fans(&self, fans: &FansKnown<'_>, firsts: &[u32], exits: &mut Vec<(u32, u32, Exit)>) {
        for volume in 0..firsts.len().saturating_sub(1) {
            for t in firsts[volume]..firsts[volume + 1] {
                let middle = self.middle(t);
                for other in (0..firsts.len() - 1).filter(|&other| other != volume) {
                    let Some(u) = (fans.find)(other, &middle) else { continue };
                    let u = u + firsts[other];
                    if u < firsts[other + 1] && self.holds(u, &middle) {
                        let exit = Exit::Overlap(middle);
                        exits.extend([(t, u, exit), (u, t, exit)]);
                    }
                }
            }
        }
    }

    /// Joins tetrahedra of different volumes, and forgets frontier inside another volume.
    fn join(&mut self, firsts: &[u32], exits: &mut Vec<(u32, u32, Exit)>) {
        let volume_of = |t: u32| firsts.partition_point(|&first| first <= t);
        for t in 0..self.len() as u32 {
            let middle = self.middle(t);
            self.each_holding(&middle, |other| {
                if volume_of(other) != volume_of(t) && self.holds(t, &middle) {
                    exits.push((t, other, Exit::Overlap(middle)));
                    exits.push((other, t, Exit::Overlap(middle)));
                }
            });
        }
        let mut frontier = std::mem::take(&mut self.frontier);
        frontier.retain(|face| {
            let [a, b, c] = face.corners.map(|v| self.vertices[v as usize]);
            let middle = middle_of([&a, &b, &c]);
            let mut inside = false;
            self.each_holding(&middle, |t| {
                inside = inside || volume_of(t) != volume_of(face.tetrahedron);
            });
            !inside
        });
        self.frontier = frontier;
    }

    /// The point, or one next to it that lies in the space: poses round, and a camera hovers at the tip of its
    /// own view. Where nothing is within `near_m`, the middle of the nearest tetrahedron; `None` in no space.
    pub(crate) fn entry(&self, from: &Point3, near_m: f64) -> Option<Point3> {
        if let Some(at) = nudged(from, near_m, |at| self.locate(at).is_some()) {
            return Some(at);
        }
        let middles = (0..self.len() as u32).map(|t| self.middle(t));
        middles.min_by(|a, b| (a - from).norm_squared().total_cmp(&(b - from).norm_squared()))
    }

    /// Whether a straight segment lies in the tetrahedra, whichever they are of, to rounding: the part of it in
    /// each is found by the planes of its faces, and the parts must leave no gap longer than `gap_m`.
    /// O(log n) and the tetrahedra whose boxes it touches.
    pub(crate) fn covers(&self, from: &Point3, to: &Point3, gap_m: f64) -> bool {
        let length_m = (to - from).norm();
        let mut parts: Vec<(f64, f64)> = Vec::new();
        self.tree.each_touching(&Aabb::around([from, to]), |t| {
            parts.extend(self.part_of(t, from, to));
        });
        parts.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let gap = gap_m / length_m.max(gap_m);
        let mut reached = 0.0;
        for (start, end) in parts {
            if start > reached + gap {
                return false;
            }
            reached = end.max(reached);
        }
        reached >= 1.0 - gap
    }

    /// Which part of a segment lies in a tetrahedron, as shares of its length.
    fn part_of(&self, tetrahedron: u32, from: &Point3, to: &Point3) -> Option<(f64, f64)> {
        let [a, b, c, d] = self.corners(tetrahedron);
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for ([p, q, r], inner) in [([b, c, d], a), ([a, c, d], b), ([a, b, d], c), ([a, b, c], d)] {
            let normal = (q - p).cross(&(r - p));
            let sign = normal.dot(&(inner - p)).signum();
            let (above_from, above_to) =
                (sign * normal.dot(&(from - p)), sign * normal.dot(&(to - p)));
            match (above_from >= 0.0, above_to >= 0.0) {
                (true, true) => {}
                (false, false) => return None,
                (true, false) => end = end.min(above_from / (above_from - above_to)),
                (false, true) => start = start.max(above_from / (above_from - above_to)),
            }
        }
        (start <= end).then_some((start, end))
    }

    /// Number of tetrahedra.
    pub fn len(&self) -> usize {
        self.tetrahedra.len()
    }

    /// Whether there is no tetrahedron.
    pub fn is_empty(&self) -> bool {
        self.tetrahedra.is_empty()
    }

    /// The corners of a tetrahedron; seen from the fourth the other three run counter-clockwise.
    pub fn corners(&self, tetrahedron: u32) -> [&Point3; 4] {
        self.tetrahedra[tetrahedron as usize].map(|v| &self.vertices[v as usize])
    }

    /// The tetrahedra that one can go to from one, ascending, and how.
    pub fn exits(&self, tetrahedron: u32) -> &[(u32, Exit)] {
        let t = tetrahedron as usize;
        &self.exits[self.starts[t] as usize..self.starts[t + 1] as usize]
    }

    /// How one gets from a tetrahedron to another, if they are joined.
    pub fn exit(&self, from: u32, to: u32) -> Option<Exit> {
        let exits = self.exits(from);
        exits.binary_search_by_key(&to, |exit| exit.0).ok().map(|at| exits[at].1)
    }

    /// The points of a face.
    pub fn points(&self, face: [u32; 3]) -> [Point3; 3] {
        face.map(|v| self.vertices[v as usize])
    }

    /// The frontier faces, in the order of their volumes and faces.
    pub fn frontier(&self) -> &[FrontierFace] {
        &self.frontier
    }

    /// The obstacle faces of all volumes.
    pub fn obstacles(&self) -> &Obstacles {
        &self.obstacles
    }

    /// Whether a point lies in a tetrahedron or on its border; exact.
    pub fn holds(&self, tetrahedron: u32, point: &Point3) -> bool {
        let [a, b, c, d] = self.corners(tetrahedron);
        orient3(point, b, c, d) >= 0.0
            && orient3(a, point, c, d) >= 0.0
            && orient3(a, b, point, d) >= 0.0
            && orient3(a, b, c, point) >= 0.0
    }

    /// The tetrahedron of the least number in which a point lies; borders count; exact. O(log n).
    pub fn locate(&self, point: &Point3) -> Option<u32> {
        let mut found: Option<u32> = None;
        if in_envelope(point) {
            self.each_holding(point, |t| found = Some(found.map_or(t, |least| least.min(t))));
        }
        found
    }

    fn each_holding(&self, point: &Point3, mut found: impl FnMut(u32)) {
        self.tree.each_touching(&Aabb::around([point]), |t| {
            if self.holds(t, point) {
                found(t);
            }
        });
    }

    /// A point of the tetrahedron: its centre of gravity (\[Mos15\] eq. 4.2), unless another stands for it, or it is so flat that
    /// doubles have none inside; then a corner. It lies in the closed tetrahedron, exactly.
    pub fn middle(&self, tetrahedron: u32) -> Point3 {
        if let Ok(at) = self.stands.binary_search_by_key(&tetrahedron, |stands| stands.0) {
            return self.stands[at].1;
        }
        let corners = self.corners(tetrahedron);
        let middle = middle_of(corners);
        if self.holds(tetrahedron, &middle) { middle } else { *corners[0] }
    }
}

/// The point, or the first of those around it that is inside, no farther off than `near_m`.
pub(crate) fn nudged(
    from: &Point3,
    near_m: f64,
    is_inside: impl Fn(&Point3) -> bool,
) -> Option<Point3> {
    if is_inside(from) {
        return Some(*from);
    }
    for away_m in [1e-6, 1e-3, 0.01, 0.03].into_iter().filter(|m| *m < near_m).chain([near_m]) {
        for direction in (0..27).filter(|&i| i != 13) {
            let step = [direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1];
            let at = from + Vector3::from(step.map(f64::from)).normalize() * away_m;
            if is_inside(&at) {
                return Some(at);
            }
        }
    }
    None
}

/// The centre of gravity of some points.
pub(super) fn middle_of<const N: usize>(points: [&Point3; N]) -> Point3 {
    let share = 1.0 / N as f64;
    Point3::from(points.iter().fold(nalgebra::Vector3::zeros(), |sum, p| sum + p.coords * share))
}

/// The face opposite corner `i` of `t`, if `u` has it too and knows `t` behind it.
fn shared(one: &Tetrahedra, t: u32, i: usize, u: u32) -> Option<[u32; 3]> {
    let tet = one.tetrahedra[t as usize];
    let other = one.tetrahedra[u as usize];
    let mut rest = [0; 3];
    for (slot, j) in rest.iter_mut().zip((0..4).filter(|&j| j != i)) {
        *slot = tet[j];
    }
    let behind = (0..4).find(|&j| !rest.contains(&other[j]))?;
    let all = rest.iter().all(|v| other.contains(v));
    // The least corner first, so that both sides name the same face the same way.
    rest.sort_unstable();
    (all && one.neighbours[u as usize][behind] == Some(t)).then_some(rest)
}

/// Refuses what points at nothing.
fn check(volume: usize, one: &Tetrahedra) -> Result<(), Maps3dError> {
    let broken = |what, index| Err(Maps3dError::Tetrahedra { volume, what, index });
    if let Some(vertex) = one.vertices.iter().position(|p| !in_envelope(p)) {
        return broken("vertex is no finite point", vertex);
    }
    if one.neighbours.len() != one.tetrahedra.len() {
        return broken("count of neighbours is not that of tetrahedra", one.neighbours.len());
    }
    let (vertices, count) = (one.vertices.len() as u32, one.tetrahedra.len() as u32);
    for (t, tet) in one.tetrahedra.iter().enumerate() {
        if tet.iter().any(|&v| v >= vertices) {
            return broken("tetrahedron has a corner that does not exist", t);
        }
        let [a, b, c, d] = tet.map(|v| &one.vertices[v as usize]);
        if orient3(a, b, c, d) <= 0.0 {
            return broken("tetrahedron is flat or turned over", t);
        }
        if one.neighbours[t].iter().flatten().any(|&u| u >= count) {
            return broken("tetrahedron has a neighbour that does not exist", t);
        }
    }
    for (face, of) in one.boundary.iter().enumerate() {
        if of.corners.iter().any(|&v| v >= vertices)
            || of.tetrahedra.iter().flatten().any(|&t| t >= count)
        {
            return broken("boundary face points at nothing", face);
        }
    }
    Ok(())
}
