//! What a segment meets.

use super::Solid;
use crate::predicates::{is_collinear, orient3, sign};
use crate::{Point3, Vector3};

/// A place where a segment meets a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The face.
    pub face: u32,
    /// How far along the segment, 0 at its start and 1 at its end.
    pub share: f64,
    /// Where it is, to rounding.
    pub at: Point3,
    /// Whether the segment passes from the outer side of the face to the inner.
    pub enters: bool,
}

/// How a segment passes one face.
pub(super) enum Passage {
    Misses,
    /// Through the inside of the face, properly.
    Through {
        enters: bool,
    },
    /// Through an edge or a corner, or with an end on the face.
    Grazes {
        enters: bool,
    },
    /// The segment lies in the plane of the face and comes near it.
    Along,
}

impl Solid<'_> {
    /// The faces that a segment meets, nearest first; of equal distance in the order of faces.
    ///
    /// Edges and corners count for every face that has them, ends of the segment count; faces in
    /// whose plane the segment lies are left out. Some microseconds for 10,000 faces.
    pub fn segment_hits(&self, from: &Point3, to: &Point3) -> Vec<Hit> {
        let mut hits = Vec::new();
        self.faces.each_on_segment(from, to, |face| {
            if let Passage::Through { enters } | Passage::Grazes { enters } =
                self.passage(face, from, to)
            {
                let share = self.share(face, from, to);
                hits.push(Hit { face, share, at: from + (to - from) * share, enters });
            }
        });
        hits.sort_by(|a, b| a.share.total_cmp(&b.share).then(a.face.cmp(&b.face)));
        hits
    }

    /// The first face that a ray meets within `range_m` along the direction, which need not be a
    /// unit vector but must not be zero.
    pub fn first_hit(&self, from: &Point3, direction: &Vector3, range_m: f64) -> Option<Hit> {
        let to = from + direction.normalize() * range_m;
        self.segment_hits(from, &to).into_iter().next()
    }

    pub(super) fn passage(&self, face: u32, from: &Point3, to: &Point3) -> Passage {
        let [a, b, c] = self.mesh.corners(face as usize);
        let above_from = sign(orient3(a, b, c, from));
        let above_to = sign(orient3(a, b, c, to));
        if above_from == 0 && above_to == 0 {
            // A flat face has no plane; whoever passes it meets the edges of its neighbours.
            return if is_collinear(a, b, c) { Passage::Misses } else { Passage::Along };
        }
        if above_from * above_to > 0 {
            return Passage::Misses;
        }
        let turns = [(a, b), (b, c), (c, a)].map(|(s, t)| sign(orient3(from, to, s, t)));
        if turns.contains(&1) && turns.contains(&-1) {
            return Passage::Misses;
        }
        let enters = above_from > above_to;
        if turns.contains(&0) || above_from == 0 || above_to == 0 {
            Passage::Grazes { enters }
        } else {
            Passage::Through { enters }
        }
    }

    /// How far along the segment its hit with a face lies, to rounding.
    fn share(&self, face: u32, from: &Point3, to: &Point3) -> f64 {
        let a = self.mesh.corners(face as usize)[0];
        let normal = self.mesh.scaled_normal(face as usize);
        let (above_from, above_to) = (normal.dot(&(from - a)), normal.dot(&(to - a)));
        let step = above_from - above_to;
        if step == 0.0 { 0.0 } else { (above_from / step).clamp(0.0, 1.0) }
    }
}
