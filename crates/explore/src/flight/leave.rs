//! What a body that leaves a vertex may touch where its camera has no eyes (step 2).

use geometry::{Point3, Vector3};
use maps3d::Hovering;
use pose::Se3;
use probe::VertexId;

use super::FlightExplorer;
use super::nearby::nearby;
use super::viewpoint::BLOCKED;

/// How a body that leaves is looked at where its vertex has no eyes: steps and slack in metres, and yaws.
const LEAVE_STEP_M: f64 = 0.1;
const LEAVE_SLACK_M: f64 = 0.03;
const LEAVE_YAWS: usize = 8;
/// A body may come nearer to a ledge by this share of what lies between the two: pixels are apart.
const NEARER_SHARE: f64 = 0.1;

impl FlightExplorer {
    /// Whether a body that leaves a vertex towards a place meets nothing solid that is above or below the images
    /// of the vertex, as far as views around saw it; a place where it does is not asked for again.
    ///
    /// Those views are placed along the graph, so this is not for certain; but noise may have pushed the robot
    /// right under a ledge that it cannot see any more.
    pub(super) fn may_leave(&mut self, at: VertexId, place: &Point3) -> bool {
        let Some(seen) = self.seen.get(at) else { return false };
        let (radius_m, length_m) = (self.params.body_radius_m, place.coords.norm());
        let way = place.coords / length_m.max(1e-9);
        let steps = (self.params.leaving_m.min(length_m) / LEAVE_STEP_M).floor() as usize;
        let mut points: Vec<Point3> = Vec::new();
        for step in 1..=steps {
            let middle = way * (step as f64 * LEAVE_STEP_M);
            for yaw in 0..LEAVE_YAWS {
                let yaw_rad = std::f64::consts::TAU * yaw as f64 / LEAVE_YAWS as f64;
                for elevation_deg in [-90.0_f64, -65.0, -40.0, 40.0, 65.0, 90.0] {
                    let (sin, cos) = elevation_deg.to_radians().sin_cos();
                    let by = Vector3::new(cos * yaw_rad.cos(), cos * yaw_rad.sin(), sin);
                    let point = Point3::from(middle + by * radius_m);
                    // The body is at the start already.
                    let is_new = point.coords.norm() > radius_m + LEAVE_SLACK_M;
                    if is_new && !seen.has_in_view(&point, 0.0) {
                        points.push(point);
                    }
                }
            }
        }
        let hovering = Hovering { vertex: at, vertex_from_body: Se3::identity() };
        let may = (points.is_empty() || !self.maps[0].meets_solid(&hovering, &points))
            && self.keeps_from_ledges(at, place);
        if !may {
            let key = (at, [place.x, place.y, place.z].map(f64::to_bits));
            self.margins_known.insert(key, BLOCKED);
        }
        may
    }

    /// Whether a body that leaves a vertex towards a place gets no nearer to what is above or below its images, as
    /// the looks of vertices around saw it, than it is at the start, or keeps the widest margin.
    ///
    /// A robot that noise pushed against an edge above it touches that edge when it climbs however little.
    /// O(pixels of the looks of the vertices around).
    fn keeps_from_ledges(&self, at: VertexId, place: &Point3) -> bool {
        let Some(seen) = self.seen.get(at) else { return false };
        let widest_m = self.params.margins_m.first().copied().unwrap_or(0.0);
        let keep_m = self.params.body_radius_m + widest_m;
        let length_m = place.coords.norm();
        let end = place.coords * (self.params.leaving_m / length_m.max(1e-9)).min(1.0);
        let squared = end.norm_squared();
        if squared <= 0.0 {
            return true;
        }
        let (mut start_m, mut least_m) = (f64::INFINITY, f64::INFINITY);
        for near in nearby(&self.graph, at, self.params.around_m).iter().skip(1) {
            let Some(other) = self.seen.get(near.vertex) else { continue };
            other.near_points(&near.root_from_vertex, squared.sqrt() + keep_m, |point| {
                if !seen.has_in_view(&point, 0.0) {
                    let along = (point.coords.dot(&end) / squared).clamp(0.0, 1.0);
                    least_m = least_m.min((point.coords - end * along).norm());
                    start_m = start_m.min(point.coords.norm());
                }
            });
        }
        let between_m = (start_m - self.params.body_radius_m).max(0.0);
        least_m >= keep_m || least_m >= start_m - NEARER_SHARE * between_m
    }
}
