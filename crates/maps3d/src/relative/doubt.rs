//! Whether two views contradict each other about where frontier lies: then one is placed wrongly, and closes
//! nothing there.

use nalgebra::{Point3, Vector3};
use pose::Se3;

use super::RelativeParams;
use super::distance::point_triangle;
use super::volume::{LocalVolume, Shape};

/// Places of the image that stand for a surface, across and down.
const LATTICE: [u16; 2] = [16, 14];

/// Evidence counts so near to a face, metres.
const NEAR_M: f64 = 1.0;

/// With fewer points near a face, all that the two views have in common decides.
const LEAST: usize = 4;

/// Points on what is solid in one of two views, in the frame `camera` of the first, each with whether the other
/// says that all about it is free.
#[derive(Clone, Debug, Default)]
pub(super) struct Doubt {
    points: Vec<(Point3<f64>, bool)>,
}

impl Doubt {
    /// Holds the solid surfaces of two views against each other's volumes.
    ///
    /// A point is contradicted where a ball of `contradiction_m` about it lies inside of the other volume;
    /// a view that is off by less contradicts nothing, beside its silhouettes neither. It is confirmed where it
    /// is not, and lies behind the other surface by no more than that; else it is hidden, and left out.
    pub fn take(
        &mut self,
        view: &LocalVolume,
        against: &LocalVolume,
        camera_from_against: &Se3,
        params: &RelativeParams,
    ) {
        self.points.clear();
        let radius_m = params.contradiction_m;
        let against_from_camera = camera_from_against.inverse();
        let mut judge = |in_first: Point3<f64>, in_other: Point3<f64>, other: &LocalVolume| {
            let ways = [Vector3::x(), -Vector3::x(), Vector3::y(), -Vector3::y(), Vector3::z()];
            let is_free = |by: Vector3<f64>| other.contains(&(in_other + by));
            if is_free(Vector3::zeros()) && ways.iter().all(|way| is_free(way * radius_m)) {
                self.points.push((in_first, true));
            } else if other.holds(&in_other, Shape { inset_px: 0.0, shift_m: radius_m }).is_some() {
                self.points.push((in_first, false));
            }
        };
        surface(view, |point| judge(point, against_from_camera.transform(&point), against));
        surface(against, |point| judge(camera_from_against.transform(&point), point, view));
    }

    /// Whether more than the named share of the evidence about a face speaks against the placement.
    pub fn is_about(&self, corners: [Point3<f64>; 3], params: &RelativeParams) -> bool {
        let [a, b, c] = &corners;
        let share_of = |points: &mut dyn Iterator<Item = &(Point3<f64>, bool)>| {
            let (mut all, mut against) = (0, 0);
            for (_, is_against) in points {
                all += 1;
                against += usize::from(*is_against);
            }
            (all, against as f64 > params.contradiction_share * all as f64)
        };
        let (low, high) = (a.inf(b).inf(c), a.sup(b).sup(c));
        let may_be_near = |point: &Point3<f64>| {
            (0..3).all(|i| point[i] >= low[i] - NEAR_M && point[i] <= high[i] + NEAR_M)
        };
        let is_near =
            |point: &Point3<f64>| may_be_near(point) && point_triangle(point, [a, b, c]) <= NEAR_M;
        let (all, is_in_doubt) =
            share_of(&mut self.points.iter().filter(|(point, _)| is_near(point)));
        if all >= LEAST { is_in_doubt } else { share_of(&mut self.points.iter()).1 }
    }
}

/// Calls with points on the obstacle faces of a view, in its frame `camera`.
fn surface(volume: &LocalVolume, mut call: impl FnMut(Point3<f64>)) {
    let [last_column, last_row] = volume.extent().map(f64::from);
    let [columns, rows] = LATTICE.map(f64::from);
    for row in 0..LATTICE[1] {
        for column in 0..LATTICE[0] {
            let place = [
                last_column * (f64::from(column) + 0.5) / columns,
                last_row * (f64::from(row) + 0.5) / rows,
            ];
            if let Some(point) = volume.obstacle_at(place) {
                call(point);
            }
        }
    }
}
