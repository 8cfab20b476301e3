//! The vertices of a log's graph where odometry alone chains them, and how far was driven until each scan.

use pose::Se2;

use super::PlanarLog;
use super::planar::LoggedStep;

/// What a log's odometry says of its graph.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Chain {
    /// `odom_from_vertex`, by vertex.
    pub vertices: Vec<Se2>,
    /// Distance driven until each scan, metres, by scan.
    pub distances_m: Vec<f64>,
}

impl Chain {
    /// Chains the odometry edges of a log, whose vertices are founded in order.
    ///
    /// The way is that along all scans, also where the robot drove over known vertices and founded none; by
    /// the log's odometry, and where a scan has none by the poses that edges and standings chain.
    pub fn of(log: &PlanarLog, steps: &[LoggedStep]) -> Self {
        let mut chain = Self::default();
        let mut distance_m = 0.0;
        let mut last: Option<(Se2, Option<Se2>)> = None;
        for (scan, step) in log.scans.iter().zip(steps) {
            for batch in step.edges.chunk_by(|one, other| one.b == other.b) {
                let led = batch.iter().find(|edge| !edge.place);
                for edge in batch {
                    chain.found(edge.a, None);
                    chain.found(edge.b, led.map(|led| (led.a, led.a_from_b)));
                }
            }
            let standing = &step.standing;
            chain.found(standing.vertex, None);
            let chained = chain.vertices[standing.vertex as usize] * standing.vertex_from_body;
            let measured = step.has_odometry.then_some(scan.odom_from_sensor);
            if let Some((last_chained, last_measured)) = last {
                let by_odometry = last_measured.zip(measured);
                let (from, to) = by_odometry.unwrap_or((last_chained, chained));
                distance_m += from.inverse_mul(&to).distance();
            }
            last = Some((chained, measured));
            chain.distances_m.push(distance_m);
        }
        chain
    }

    /// Founds a vertex that is not known yet at the end of a step from a known one, else where the last is.
    fn found(&mut self, vertex: u32, led: Option<(u32, Se2)>) {
        while self.vertices.len() <= vertex as usize {
            let last = self.vertices.last().copied().unwrap_or_default();
            let pose = led.map_or(last, |(from, step)| {
                self.vertices.get(from as usize).copied().unwrap_or(last) * step
            });
            self.vertices.push(pose);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use formats::laser::LoggedScan;
    use formats::log::{EdgeMessage, Stamp, StandingMessage};
    use sensing::Scan;

    const STAMP: Stamp = Stamp::from_nanos(0);

    /// Forth over two vertices, and back to the first without founding any.
    fn drive(has_odometry: bool) -> (PlanarLog, Vec<LoggedStep>) {
        let ahead = |metres: f64| Se2::new(metres, 0.0, 0.0);
        let edge = |a: u32, b: u32, place: bool, metres: f64| EdgeMessage {
            stamp: STAMP,
            a,
            b,
            place,
            a_from_b: ahead(metres),
        };
        let step = |vertex: u32, edges: Vec<EdgeMessage>, metres: f64| LoggedStep {
            decisions: Vec::new(),
            edges,
            standing: StandingMessage { stamp: STAMP, vertex, vertex_from_body: ahead(metres) },
            has_odometry,
        };
        let steps = vec![
            step(0, vec![], 0.0),
            step(1, vec![edge(0, 1, false, 2.0)], 0.0),
            // A place edge that comes first does not say where odometry has the vertex.
            step(2, vec![edge(0, 2, true, 4.5), edge(1, 2, false, 2.0)], 0.0),
            step(1, vec![], 0.5),
            step(0, vec![], 0.0),
        ];
        let odometry = [0.0, 2.0, 4.0, 2.5, 0.3];
        let scan = |(index, &metres): (usize, &f64)| LoggedScan {
            stamp_secs: index as f64,
            odom_from_sensor: if has_odometry { ahead(metres) } else { Se2::identity() },
            scan: Scan::new(0.0, 0.1, vec![1.0], 5.0),
        };
        let scans = odometry.iter().enumerate().map(scan).collect();
        (PlanarLog { scans, ..PlanarLog::default() }, steps)
    }

    #[test]
    fn the_way_goes_on_over_known_vertices() {
        let near = |found: &[f64], expected: &[f64]| {
            assert_eq!(found.len(), expected.len());
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-12, "{found} {expected}");
            }
        };
        for (has_odometry, last_m) in [(true, 7.7), (false, 8.0)] {
            let (log, steps) = drive(has_odometry);
            let chain = Chain::of(&log, &steps);
            near(&chain.distances_m, &[0.0, 2.0, 4.0, 5.5, last_m]);
            let x: Vec<f64> = chain.vertices.iter().map(|pose| pose.translation.x).collect();
            near(&x, &[0.0, 2.0, 4.0]);
        }
    }
}
