//! Volume, area by label, bounds.

use super::double::{Double, six_volumes};
use super::{Label, Polyhedron};
use crate::{Point3, Vector3};

/// Area of a surface, split by what its faces are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AreaByLabel {
    /// Area of the obstacle faces, square metres.
    pub obstacle_m2: f64,
    /// Area of the frontier faces, square metres.
    pub frontier_m2: f64,
}

impl AreaByLabel {
    /// The area of one label, square metres.
    pub fn of(&self, label: Label) -> f64 {
        match label {
            Label::Obstacle => self.obstacle_m2,
            Label::Frontier => self.frontier_m2,
        }
    }

    /// The whole area, square metres.
    pub fn total_m2(&self) -> f64 {
        self.obstacle_m2 + self.frontier_m2
    }
}

/// Of a volume that plain doubles give no more than this share may be lost.
const MOST_LOST: f64 = 1e-10;

/// A sum that carries what rounding would drop (Neumaier).
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        self.lost += if self.sum.abs() >= term.abs() {
            (self.sum - sum) + term
        } else {
            (term - sum) + self.sum
        };
        self.sum = sum;
    }

    fn total(self) -> f64 {
        self.sum + self.lost
    }
}

impl Polyhedron {
    /// The signed volume, cubic metres: positive where the faces of a closed mesh look outward.
    ///
    /// For an open mesh it is the volume of the cone from the middle of the bounds, a number without
    /// meaning. Right to 1e-10 of itself: where what the faces add cancels too much for doubles, as in a
    /// needle, it is summed in pairs of them, right to 1e-25 of the volume of the bounds for each face. O(faces).
    pub fn volume_m3(&self) -> f64 {
        let Some((low, high)) = self.bounds() else { return 0.0 };
        let middle = nalgebra::center(&low, &high);
        let (mut six, mut lost) = (Sum::default(), 0.0);
        for face in 0..self.faces().len() {
            let [a, b, c] = self.corners(face).map(|corner| corner - middle);
            six.add(a.dot(&b.cross(&c)));
            let reach = |v: Vector3| v.lp_norm(1);
            // Of each coordinate half a unit in its last place is lost, of each product and sum another.
            lost += 8.0 * f64::EPSILON * reach(a) * reach(b) * reach(c);
        }
        if lost <= MOST_LOST * six.total().abs() {
            return six.total() / 6.0;
        }
        let mut six = Double::default();
        for face in 0..self.faces().len() {
            six = six
                + six_volumes(self.corners(face).map(|corner| Double::between(corner, &middle)));
        }
        six.high / 6.0
    }

    /// Area of the faces of each label. O(faces).
    pub fn area_by_label(&self) -> AreaByLabel {
        let mut sums = [Sum::default(); 2];
        for (face, label) in self.labels().iter().enumerate() {
            sums[label.code() as usize].add(self.face_area_m2(face));
        }
        let [obstacle_m2, frontier_m2] = sums.map(Sum::total);
        AreaByLabel { obstacle_m2, frontier_m2 }
    }

    /// Area of one face, square metres.
    pub fn face_area_m2(&self, face: usize) -> f64 {
        0.5 * self.scaled_normal(face).norm()
    }

    /// The outward normal of a face, as long as twice its area.
    pub fn scaled_normal(&self, face: usize) -> Vector3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(&(c - a))
    }

    /// The lowest and highest coordinates of the vertices that faces use; `None` without faces.
    pub fn bounds(&self) -> Option<(Point3, Point3)> {
        let mut corners =
            self.faces().iter().flatten().map(|&vertex| self.vertices()[vertex as usize]);
        let first = corners.next()?;
        Some(corners.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p))))
    }
}
